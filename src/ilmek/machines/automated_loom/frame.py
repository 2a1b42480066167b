"""The loom's frame: two columns that bear the warps' pull, and beams across: heads' rail, top, bottom.

Columns: the cylinders at their ends are drawn together by all warps, half of the pull on each column, off its axis by
the radius e of the cylinder; half the weight of what the frame carries comes on top, P in all, as if at e too
[`elements.columns`].

The rail: each span between columns and posts simply supported, its own weight and as many heads as find room side by
side in its middle, which is the worst they can do.
Sections are the lightest square hollow ones of a table that keep the limits.
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.elements.beam import uniform
from ilmek.elements.columns import SECTIONS, STEEL, HollowSquare, eccentric, euler
from ilmek.elements.materials import GRAVITY
from ilmek.errors import LoomError
from ilmek.records import computed, record, result
from ilmek.units import mm

STRESS_SAFETY, BUCKLING_SAFETY = 2.0, 4.0
"""Against yield, and against Euler's load; assumed by this project."""

BOW_LIMIT = 1 * mm
"""Of a column [m]: as much as the thesis allows the cylinders that it holds [3.1]."""


@dataclass(frozen=True, slots=True)
class FrameTask:
    """What the frame bears.

    width, height   between the columns, and of them [m]      depth   of the feet [m]
    pull            of all warps [N]                           lever   of the pull off a column's axis [m]
    carried         mass on the columns [kg]
    heads           that ride on the rail                      head_mass, head_width  of one [kg, m]
    rail_spans      of the rail, between columns and posts     sag_limit  of the rail [m]
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

    @property
    def force(self) -> float:
        """Compression of a column [N]."""
        return (self.pull + self.carried * GRAVITY) / 2


@record
class LoomFrame:
    """The frame, designed: sections, stress [Pa] and bow [m] of a column, its safety against buckling, sag [m] of the
    rail.
    """

    task: FrameTask
    column: HollowSquare
    rail: HollowSquare
    column_stress: float
    column_bow: float
    buckling_factor: float
    rail_sag: float
    mass: float = result("kg", "mass of the frame", name="frame_mass")

    frame_column = computed("", "square hollow section of the two columns", lambda it: it.column.name)
    frame_rail = computed("", "square hollow section of the heads' rail", lambda it: it.rail.name)


def frame_for(task: FrameTask) -> LoomFrame:
    """The frame of the lightest sections. Raises LoomError where none of the table is strong or stiff enough."""
    sections = sorted((HollowSquare(*size) for size in SECTIONS), key=lambda section: section.area)
    column = next((section for section in sections if _column_holds(task, section)), None)
    rail = next((section for section in sections if rail_sag(task, section) <= task.sag_limit), None)
    if column is None or rail is None:
        what = "columns" if column is None else "rail"
        raise LoomError(
            f"no section of the table is enough for the frame's {what}",
            allowed=f"up to {sections[-1].name}",
            do="set a lower tension or a narrower carpet"
            if column is None
            else "set a shorter rail_span or a larger rail_sag",
        )
    stress, bow = eccentric(task.force, task.lever, task.height, column)
    upright = column.line_mass * task.height * (2 + 0.5 * (task.rail_spans - 1))  # posts reach to the rail, half-way up
    across = column.line_mass * 2 * (task.width + 2 * task.depth)
    mass = upright + across + rail.line_mass * task.width
    return LoomFrame(
        task, column, rail, stress, bow, euler(task.height, column) / task.force, rail_sag(task, rail), mass
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


def _column_holds(task: FrameTask, section: HollowSquare) -> bool:
    stress, bow = eccentric(task.force, task.lever, task.height, section)
    strong = stress * STRESS_SAFETY <= STEEL.strength and bow <= BOW_LIMIT
    return strong and euler(task.height, section) >= BUCKLING_SAFETY * task.force
