"""The loom's frame: two columns that bear the warps' pull, and beams across: heads' rail, top, bottom.

Columns: the cylinders at their ends are drawn together by all warps, in the worst of their three cases half of the pull
on each column, off its axis by the radius e of the cylinder; half the weight of what the frame carries comes on top, P
in all, as if at e too [`elements.columns`]. The beats of the loom stand on posts of their own (`supports`). A column
finds room between the bearings of the cylinders; where none of that room bears the load, a side has several, welded
together side by side, which share P and bend as one: each has the stress and the bow of P over their number.

The rail: each span between its supports simply supported, its own weight, what lies along it [`on_rail`] and as many
heads as find room side by side in its middle, which is the worst they can do. A support between the ends stands a
before the rail, so that the heads pass: the load R that it bears twists the rail by R a l / (2 G J), a thin-walled tube
between its neighbours, and lets it sink by a of that [Bredt; Timoshenko, Strength of Materials II, 58].
Sections are the lightest square hollow ones of a table that keep the limits, the largest where none does.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import chain
from typing import TypeAlias

import numpy as np

from ilmek.elements.beam import uniform
from ilmek.elements.beam.model import Beam
from ilmek.elements.columns import STEEL, HollowSquare, ascending, eccentric, euler
from ilmek.elements.materials import GRAVITY
from ilmek.elements.whirl import Mass, frequencies
from ilmek.errors import LoomError
from ilmek.machines.arrangement.side_view import RETREAT
from ilmek.machines.automated_loom.feet import FEET, Foot
from ilmek.machines.weaver.head_shape import RAIL_AXIS
from ilmek.part.part import LASER_CUT, Part
from ilmek.part.shapes import box, square_tube
from ilmek.records import computed, record, result
from ilmek.report import Alternative, Check, Choice, at_least, at_most, choose
from ilmek.units import mm, turn

EULER = "Euler's load; assumed by this project: parameter buckling_safety"


MOST_COLUMNS = 4
"""Columns of a side at most; assumed by this project."""

ROOM = 3 * mm
"""Least room between a column's sides and what stands beside it [m]; assumed by this project."""

RAIL_POST = 120 * mm
"""Room for a post of the heads' rail [m]; assumed by this project."""


def part_id(name: str) -> str:
    """Id of a part or body of the loom itself."""
    return f"automated-loom/{name}"


def member(name: str, title: str, section: HollowSquare, length: float) -> Part:
    """A piece of square hollow section, cut to length and welded."""
    shape = square_tube(section.side, section.wall, length)
    return Part(part_id(name), title, "welded frame", shape, STEEL)


END_PLATE = 10 * mm
"""Thickness of the plate that is welded before the end of a hollow section and has the threads there [m]; assumed."""


CARRIAGE = (60 * mm, 70 * mm, 24 * mm)
"""Length along its axis, width over that, height [m] of a carriage of the rail's retreat: makers' usual sizes."""

BEYOND = 1 * mm
"""Of the rail beyond what lies along it, at both ends [m]."""

CARRIED = BEYOND + END_PLATE + CARRIAGE[2]
"""From what lies along the rail to the axis at its end [m]."""

EAR = 20 * mm
"""Of an end plate beyond its section on both sides, where screws are reached beside it [m]; assumed by this project."""


def end_plate(name: str, title: str, section: HollowSquare, ear: float = 0.0) -> Part:
    """The plate before the end of a section, as large as that, along x with ears [m], from z = 0."""
    shape = box(section.side + 2 * ear, section.side, END_PLATE)
    return Part(part_id(name), title, LASER_CUT, shape=shape, material=STEEL)


_COLUMN = (part_id("column"),)


def welded_to(frame: "LoomFrame", depth: float) -> HollowSquare:
    """Section of the spacer between a column and a bracket of a height [m]: the largest up to both."""
    return max((own for own in ascending() if own.side <= min(frame.column.side, depth)), key=lambda own: own.side)


@dataclass(frozen=True, slots=True)
class RailTask:
    """What the heads' rail bears.

    width      of the rail [m]                      spans      of it, between columns and posts
    heads      that ride on it                      head_mass, head_width  of one [kg, m]
    sag_limit  of the rail [m]                      drop       of a support before the rail, below it [m]
    frequency  least natural frequency [Hz]         least      side of its section at least [m]
    cargo      by the side of the rail [m]: mass of a length of what lies along it [kg/m]
    """

    width: float
    spans: int
    heads: int
    head_mass: float
    head_width: float
    sag_limit: float
    drop: float = 0.0
    frequency: float = 0.0
    least: float = 0.0
    cargo: Callable[[float], float] = lambda _side: 0.0

    def rail_mass(self, section: HollowSquare) -> float:
        """Mass of a length of the rail of a section, with what it carries beside the heads [kg/m]."""
        return section.line_mass + self.cargo(section.side)


@dataclass(frozen=True, slots=True)
class FrameTask:
    """What the frame bears.

    height          of the columns [m]     depth   of the feet [m]
    pull            of all warps, worst case [N]               lever   of the pull off a column's axis [m]
    carried         mass on the columns [kg]
    stress_safety, buckling_safety   of a column, against yield and Euler's load      bow_limit  of a column [m]
    room            for the side of a column [m]               rail    of the heads; None: there is none
    """

    height: float
    depth: float
    pull: float
    lever: float
    carried: float
    stress_safety: float
    buckling_safety: float
    bow_limit: float
    room: float = math.inf
    rail: RailTask | None = None

    @property
    def force(self) -> float:
        """Compression of the columns of a side [N]."""
        return (self.pull + self.carried * GRAVITY) / 2


@record
class LoomFrame:
    """The frame, designed: choice of its sections, sections, columns of a side, stress [Pa] and bow [m] of a column,
    its safety against buckling; levelling foot. rail: section of the heads' rail, None where there is none.
    """

    task: FrameTask
    choices: tuple[Choice, ...]
    column: HollowSquare
    rail: HollowSquare | None
    number: int
    column_stress: float
    column_bow: float
    buckling_factor: float
    foot: Foot = FEET[0]
    foot_load: float = result("N", "load of a levelling foot, where two bear the loom", default=math.nan)
    mass: float = result("kg", "mass of the frame with its brackets and its rail", name="frame_mass", default=math.nan)

    frame_column = computed("", "square hollow section of the columns", lambda it: it.column.name)
    columns_of_a_side = computed("1", "columns of a side of the frame, side by side", lambda it: it.number)
    frame_rail = computed(
        "", "square hollow section of the heads' rail", lambda it: it.rail and it.rail.name, optional=True
    )

    @property
    def guide(self) -> tuple[HollowSquare, RailTask]:
        """Section of the heads' rail, and what it bears. Raises LoomError where there is none."""
        if self.rail is None or self.task.rail is None:
            raise LoomError("no rail of heads", allowed="a loom whose knots heads tie")
        return self.rail, self.task.rail

    def beside(self, face: float) -> tuple[float, ...]:
        """Axes of the columns of a side, the inmost first, from the middle of the width [m]; face  of that one [m]."""
        return tuple(face + (k + 0.5) * self.column.side for k in range(self.number))

    @property
    def checks(self) -> tuple[Check, ...]:
        """Strength and stiffness of the columns and of the heads' rail."""
        of_columns = column_checks(self.task, self.column, self.number)
        return of_columns if self.rail is None else (*of_columns, *rail_checks(self.guide[1], self.rail))


_Columns: TypeAlias = tuple[int, HollowSquare]
"""Number of columns of a side, and their section."""


def frame_for(
    task: FrameTask,
    sway: Callable[["LoomFrame"], Iterable[Check]] = lambda _frame: (),
    fails: Callable[["LoomFrame"], bool] = lambda _frame: False,
) -> LoomFrame:
    """The frame of the lightest sections that keep their checks; of the largest where none of the table does.

    A side has one column if any has room that keeps its checks, else the least number of them. Where none is as stiff
    as required, the columns are those that strength, bow and buckling need, and the frame fails the checks of its sway.

    sway   frame -> checks of its stiffness as a whole, of which those after one that fails are not computed
    fails  frame -> whether one of them fails, where that is known sooner
    """
    sections = ascending()
    narrow = tuple(section for section in sections if section.side <= task.room) or sections[:1]
    columns = [(number, section) for number in range(1, MOST_COLUMNS + 1) for section in narrow]
    rail, of_rail = (None, ()) if task.rail is None else rail_for(task.rail)

    def framed(column: _Columns, *choices: Choice) -> LoomFrame:
        number, section = column
        stress, bow = column_load(task, section, number)
        factor = number * euler(task.height, section) / task.force
        return LoomFrame(task, choices, section, rail, number, stress, bow, factor)

    def strength(column: _Columns) -> tuple[Check, ...]:
        return column_checks(task, column[1], column[0])

    def stiffness(column: _Columns) -> Iterator[Check]:
        own = strength(column)
        yield from own
        if all(check.ok for check in own):
            yield from sway(framed(column))

    def lasts(column: _Columns) -> bool:
        return all(check.ok for check in strength(column)) and not fails(framed(column))

    stiff = next((number for number, column in enumerate(columns) if lasts(column)), len(columns))
    column, of_column = _chosen("columns", (columns[max(stiff - 1, 0) :], stiffness), (columns, strength))
    return framed(column, of_column, *of_rail)


@lru_cache(maxsize=16)
def rail_for(task: RailTask) -> tuple[HollowSquare, tuple[Choice, ...]]:
    """The lightest section of the heads' rail that keeps its checks, and the choice of it."""
    high = [(1, square) for square in ascending() if square.side >= task.least]
    (_, rail), choice = _chosen("rail", (high, lambda column: rail_checks(task, column[1])))
    return rail, (choice,)


def _chosen(
    name: str, *rules: tuple[Sequence[_Columns], Callable[[_Columns], Iterable[Check]]]
) -> tuple[_Columns, Choice]:
    """The first number and section, of those offered, that keep the checks of a rule: of the first rule that any keeps,
    or the last one offered.
    """

    def label(number: int, section: HollowSquare) -> str:
        return section.name if number == 1 else f"{number} x ({section.name})"

    for offered, checks_of in rules:
        smaller: tuple[str, Iterable[Check]] | None = None
        for columns in offered:
            checks = iter(checks_of(columns))
            judged = list(_to_failure(checks))
            if all(check.ok for check in judged):
                last = [Alternative(size, tuple(own)) for size, own in ([smaller] if smaller else [])]
                return columns, choose(f"frame_{name}", [*last, Alternative(label(*columns), tuple(judged))])[1]
            smaller = label(*columns), chain(judged, checks)
    return offered[-1], Choice(f"frame_{name}", label(*offered[-1]), "the largest that has room")


def _to_failure(checks: Iterator[Check]) -> Iterator[Check]:
    """The checks up to the first that fails: others are not computed."""
    for check in checks:
        yield check
        if not check.ok:
            return


def column_load(task: FrameTask, section: HollowSquare, number: int = 1) -> tuple[float, float]:
    """Greatest stress [Pa] and bow [m] of each of some columns of a side; inf at or above Euler's load."""
    return eccentric(task.force / number, task.lever, task.height, section)


def column_checks(task: FrameTask, section: HollowSquare, number: int = 1) -> tuple[Check, ...]:
    """Stress, bow and buckling of a column of a section, one of some of a side."""
    (stress, bow), limit = column_load(task, section, number), STEEL.strength / task.stress_safety
    cure, factor = "set a lower tension, or a narrower carpet", number * euler(task.height, section)
    return (
        at_most("frame: stress of a column", stress, limit, "MPa", "yield of S235 over column_safety").with_cure(
            cure, *_COLUMN
        ),
        at_most("frame: bow of a column", bow, task.bow_limit, "mm", "column_bow").with_cure(cure, *_COLUMN),
        at_least("frame: against buckling", factor / task.force, task.buckling_safety, "1", EULER).with_cure(
            cure, *_COLUMN
        ),
    )


def rail_checks(task: RailTask, section: HollowSquare) -> tuple[Check, Check]:
    """Sag and natural frequency of the heads' rail of a section."""
    cure, parts = "set a shorter rail_span or a larger rail_sag", (part_id("rail"),)
    return (
        at_most("frame: sag of the heads' rail", rail_sag(task, section), task.sag_limit, "mm", "rail_sag").with_cure(
            cure, *parts
        ),
        at_least(
            "frame: heads' rail bends: natural frequency",
            rail_frequency(task, section),
            task.frequency,
            "Hz",
            "least that the drives allow; assumed by this project",
        ).with_cure("set a shorter rail_span, or a slower knot_cycle", *parts),
    )


@lru_cache(maxsize=64)
def rail_frequency(task: RailTask, section: HollowSquare) -> float:
    """Lowest natural frequency of the rail on its supports [Hz], the heads that find room on a span in the middle of
    the first.
    """
    span = task.width / task.spans
    mass = min(task.heads, math.ceil(span / task.head_width)) * task.head_mass
    beam = Beam(task.width, tuple(np.linspace(0.0, task.width, task.spans + 1).tolist()))
    stiffness = STEEL.modulus * section.inertia
    lowest = frequencies(beam, stiffness, task.rail_mass(section), (Mass(span / 2, mass),), count=1)[0]
    return float(lowest) / turn


def rail_sag(task: RailTask, section: HollowSquare) -> float:
    """Deflection [m] in the middle of a span of the rail under its own weight, its cargo and the heads, spread over
    their width there, and what a support between the ends lets it sink.

    Of a load w over the middle b of a span l: w b (8 l^3 - 4 l b^2 + b^3) / (384 E I); for b = l the whole span's.
    """
    span, stiff = task.width / task.spans, STEEL.modulus * section.inertia
    own = uniform.deflection_max(task.rail_mass(section) * GRAVITY, span, STEEL.modulus, section.inertia)
    number = min(task.heads, math.ceil(span / task.head_width))
    wide = min(number * task.head_width, span)
    force = number * task.head_mass * GRAVITY
    bent = float(np.add(own, force * (8 * span**3 - 4 * span * wide**2 + wide**3) / (384 * stiff)))
    if task.spans == 1:
        return bent
    twist = section.twist(rail_support_load(task, section) * rail_ahead(section, task.drop) / 2, span)
    return bent + rail_ahead(section, task.drop) * twist


def rail_support_load(task: RailTask, section: HollowSquare, spans: int = 2) -> float:
    """Greatest load of a support of the rail [N]: half of the spans beside it, and all heads that find room on them."""
    span = task.width / task.spans
    number = min(task.heads, math.ceil(spans * span / task.head_width))
    return (task.rail_mass(section) * spans * span / 2 + number * task.head_mass) * GRAVITY


def rail_ahead(section: HollowSquare, drop: float) -> float:
    """From the back of the rail to the axis of a support before it [m], in the side view.

    The support's axis lies along the retreat, so that the rail passes under it, its upper front edge nearest; and its
    post stands before the rail that has retreated.

    drop  of the support's axis below that of the rail [m]
    """
    across = 1j * RETREAT
    edge = section.side * (1 + 0.5j)
    past = ((edge + 1j * drop) * np.conj(across)).real + RAIL_AXIS / 2 + ROOM
    return float(max(past / across.real, section.side + RAIL_POST / 2 + ROOM))
