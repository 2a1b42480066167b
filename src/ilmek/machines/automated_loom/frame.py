"""The loom's frame: two columns that bear the warps' pull, and beams across: heads' rail, top, bottom.

Columns: the cylinders at their ends are drawn together by all warps, in the worst of their three cases half of the pull
on each column, off its axis by the radius e of the cylinder; half the weight of what the frame carries comes on top, P
in all, as if at e too [`elements.columns`]. A force along the columns would add
to P; one F across, at half height, half of it on each column, gives stress F h c / (8 I) and bow F h^3 / (96 E I) more,
magnified by the compression by 1 / (1 - P / Euler's load) [Timoshenko and Gere, Theory of Elastic Stability, 1.11]. The
beats of the loom stand on posts of their own (`supports`).

The rail: each span between columns and posts simply supported, its own weight and as many heads as find room side by
side in its middle, which is the worst they can do.
Sections are the lightest square hollow ones of a table that keep the limits, the largest where none does.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ilmek.elements.beam import uniform
from ilmek.elements.columns import STEEL, HollowSquare, ascending, eccentric, euler
from ilmek.elements.materials import GRAVITY
from ilmek.part.part import Part
from ilmek.part.shapes import square_tube
from ilmek.records import computed, record, result
from ilmek.report import Alternative, Check, Choice, at_least, at_most, choose
from ilmek.units import mm

EULER = "Euler's load; assumed by this project: parameter buckling_safety"


LEVELLING, PAD = (20 * mm, 40 * mm), (80 * mm, 15 * mm)
"""Diameter and length of a levelling foot's screw, and of its pad [m]: M20; makers differ by some millimetres."""

FOOT = LEVELLING[1] + PAD[1]
"""Height of the frame over the floor, on its levelling feet [m]."""


def part_id(name: str) -> str:
    """Id of a part or body of the loom itself."""
    return f"automated-loom/{name}"


def member(name: str, title: str, section: HollowSquare, length: float) -> Part:
    """A piece of square hollow section, cut to length and welded."""
    shape = square_tube(section.side, section.wall, length)
    return Part(part_id(name), title, "welded frame", section.name, shape, STEEL)


_COLUMN = (part_id("column"),)


@dataclass(frozen=True, slots=True)
class FrameTask:
    """What the frame bears.

    width, height   between the columns, and of them [m]      depth   of the feet [m]
    pull            of all warps, worst case [N]               lever   of the pull off a column's axis [m]
    across, along   force of the beat on the frame, across and along the columns [N]
    carried         mass on the columns [kg]
    heads           that ride on the rail                      head_mass, head_width  of one [kg, m]
    rail_spans      of the rail, between columns and posts     sag_limit  of the rail [m]
    stress_safety, buckling_safety   of a column, against yield and Euler's load      bow_limit  of a column [m]
    """

    width: float
    height: float
    depth: float
    pull: float
    lever: float
    carried: float
    heads: int
    head_mass: float
    head_width: float
    rail_spans: int
    sag_limit: float
    stress_safety: float
    buckling_safety: float
    bow_limit: float
    across: float = 0.0
    along: float = 0.0

    @property
    def force(self) -> float:
        """Compression of a column [N]."""
        return (self.pull + self.carried * GRAVITY + self.along) / 2


@record
class LoomFrame:
    """The frame, designed: choice of its sections, sections, stress [Pa] and bow [m] of a column, its safety against
    buckling, sag [m] of the rail.
    """

    task: FrameTask
    choices: tuple[Choice, ...]
    column: HollowSquare
    rail: HollowSquare
    column_stress: float
    column_bow: float
    buckling_factor: float
    rail_sag: float
    mass: float = result("kg", "mass of the frame with its brackets and its rail", name="frame_mass", default=math.nan)

    frame_column = computed("", "square hollow section of the two columns", lambda it: it.column.name)
    frame_rail = computed("", "square hollow section of the heads' rail", lambda it: it.rail.name)

    @property
    def checks(self) -> tuple[Check, ...]:
        """Strength and stiffness of the columns and of the heads' rail."""
        return (*column_checks(self.task, self.column), *rail_checks(self.task, self.rail))


def frame_for(task: FrameTask) -> LoomFrame:
    """The frame of the lightest sections that keep their checks; of the largest where none of the table does."""
    (column, of_column), (rail, of_rail) = _chosen(task, "columns", column_checks), _chosen(task, "rail", rail_checks)
    stress, bow = column_load(task, column)
    factor, sag = euler(task.height, column) / task.force, rail_sag(task, rail)
    return LoomFrame(task, (of_column, of_rail), column, rail, stress, bow, factor, sag)


def _chosen(
    task: FrameTask, name: str, checks_of: Callable[[FrameTask, HollowSquare], tuple[Check, ...]]
) -> tuple[HollowSquare, Choice]:
    """The lightest section that keeps its checks, or the largest, and the choice."""
    sections = ascending()
    candidates = [Alternative(section.name, checks_of(task, section)) for section in sections]
    index, choice = choose(f"frame_{name}", candidates)
    if not candidates[index].failed:
        return sections[index], choice
    return sections[-1], Choice(choice.name, sections[-1].name, "the largest of the table")


def column_load(task: FrameTask, section: HollowSquare) -> tuple[float, float]:
    """Greatest stress [Pa] and bow [m] of a column; inf at or above Euler's load."""
    stress, bow = eccentric(task.force, task.lever, task.height, section)
    if not math.isfinite(stress):
        return stress, bow
    share = task.across / 2 / (1 - task.force / euler(task.height, section))
    bent = share * task.height * section.side / 2 / (4 * section.inertia)
    return stress + bent, bow + share * task.height**3 / (48 * STEEL.modulus * section.inertia)


def column_checks(task: FrameTask, section: HollowSquare) -> tuple[Check, ...]:
    """Stress, bow and buckling of a column of a section."""
    (stress, bow), limit = column_load(task, section), STEEL.strength / task.stress_safety
    cure, factor = "set a lower tension, or a narrower carpet", euler(task.height, section)
    return (
        at_most(
            "frame: stress of a column",
            stress,
            limit,
            "MPa",
            "yield of S235 over column_safety",
            cure=cure,
            parts=_COLUMN,
        ),
        at_most("frame: bow of a column", bow, task.bow_limit, "mm", "column_bow", cure=cure, parts=_COLUMN),
        at_least(
            "frame: against buckling", factor / task.force, task.buckling_safety, "1", EULER, cure=cure, parts=_COLUMN
        ),
    )


def rail_checks(task: FrameTask, section: HollowSquare) -> tuple[Check]:
    """Sag of the heads' rail of a section."""
    cure, sag = "set a shorter rail_span or a larger rail_sag", rail_sag(task, section)
    return (
        at_most(
            "frame: sag of the heads' rail", sag, task.sag_limit, "mm", "rail_sag", cure=cure, parts=(part_id("rail"),)
        ),
    )


def rail_sag(task: FrameTask, section: HollowSquare) -> float:
    """Deflection [m] in the middle of the rail under its own weight and the heads, spread over their width there.

    Of a load w over the middle b of a span l: w b (8 l^3 - 4 l b^2 + b^3) / (384 E I); for b = l the whole span's.
    """
    span, stiff = task.width / task.rail_spans, STEEL.modulus * section.inertia
    own = uniform.deflection_max(section.line_mass * GRAVITY, span, STEEL.modulus, section.inertia)
    number = min(task.heads, math.ceil(span / task.head_width))
    wide = min(number * task.head_width, span)
    force = number * task.head_mass * GRAVITY
    return float(np.add(own, force * (8 * span**3 - 4 * span * wide**2 + wide**3) / (384 * stiff)))
