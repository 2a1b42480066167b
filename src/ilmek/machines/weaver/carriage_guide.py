"""The guide of a head's carriage: a rail along the row and the carriages on it, by life and static safety.

    P = (m g + 2 m g e / w + 6 m a (e + h) / L) / n,      life 50 km (C / P)³     [ISO 14728-1; rigid carriage, derived]

n carriages of the length L on a rail of the width w bear the head of the mass m, whose centre, taken in the middle of
its case, is e behind the rail and h from its height; a is the acceleration of a step. The balls at both sides of the
rail share a moment about it by its width, those along a carriage a moment across it linearly.
"""

from ilmek.elements.linear_guides import LINEAR_GUIDES, LinearGuide
from ilmek.elements.materials import GRAVITY
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.head_shape import RAIL_AXIS
from ilmek.machines.weaver.parts import BEARING_LIFE
from ilmek.machines.weaver.tool_parts import part_id
from ilmek.machines.weaver.widths import case_width
from ilmek.part import guides
from ilmek.part.placement import ALONG_WIDTH, placement
from ilmek.part.tree import Occurrence
from ilmek.report import Check, at_least
from ilmek.units import mm, turn

GUIDE_CARRIAGE = part_id("guide-carriage")
"""Id of the part."""

LEAST_AXIS = 10 * mm
"""Depth of the axis with the heads' belts behind the rail, at least [m]; assumed by this project."""

BALLS = 0.6
"""Length of the rows of balls over that of a carriage; usual."""

STATIC_SAFETY = 2.0
"""Least static load rating over the load: usual practice."""

_NOMINAL = 50e3
"""Life at the dynamic load rating [m]: ISO 14728-1."""

ON_RAIL = ALONG_WIDTH.after(placement(about=(0.0, 0.0, 1.0), angle=turn / 2))
"""A rail along the width whose carriages are towards the warps."""


def carriages(weaver: Weaver, row: LinearGuide) -> int:
    """Carriages under a head: two where its case is so wide."""
    return 2 if case_width(weaver.params) >= 2 * row.block_length else 1


def guide_load(weaver: Weaver, mass: float, row: LinearGuide, acceleration: float) -> float:
    """Equivalent load of a carriage under a head of a mass [kg] at an acceleration [m/s²] [N]."""
    shape = weaver.shape
    case = shape.body + shape.size / 2
    behind, aside = shape.front - case.real, abs(shape.rail - case.imag)
    step = mass * acceleration * (behind + aside)
    rolling = 2 * mass * GRAVITY * behind / row.rail
    across = 6 * step / (BALLS * row.block_length)
    return (mass * GRAVITY + rolling + across) / carriages(weaver, row)


def _stepping(weaver: Weaver, mass: float, row: LinearGuide) -> float:
    """Equivalent load of a carriage in a step [N]."""
    return guide_load(weaver, mass, row, weaver.params.carriage_acceleration)


def required_travel(weaver: Weaver) -> float:
    """Way of a head in the life of its bearings [m]: along the row knot by knot, and back."""
    return 2 * BEARING_LIFE * weaver.params.cloth.knot_pitch


def offered_guides() -> tuple[LinearGuide, ...]:
    """Those that have room on the rail, in ascending order of their height."""
    return tuple(row for row in LINEAR_GUIDES if row.height <= RAIL_AXIS - LEAST_AXIS)


def guide_for(weaver: Weaver, mass: float) -> LinearGuide:
    """The lowest guide that lasts under a head of a mass [kg]; the highest that has room where none does."""
    lasting = (row for row in offered_guides() if life(weaver, mass, row) >= required_travel(weaver))
    return next(lasting, offered_guides()[-1])


def life(weaver: Weaver, mass: float, row: LinearGuide) -> float:
    """Life of the guide under a head of a mass [kg] [m]."""
    return _NOMINAL * (row.dynamic / _stepping(weaver, mass, row)) ** 3


def guide_carriages(weaver: Weaver, row: LinearGuide) -> Occurrence:
    """The carriages on the head's bracket, side by side, in the axes of the head."""
    part = guides.guide_block(GUIDE_CARRIAGE, "carriage of the head's guide", row)
    number, base = carriages(weaver, row), weaver.shape.front + row.height
    starts = (row.block_length * (k - number / 2) for k in range(number))
    return Occurrence(part, tuple(placement(x, weaver.shape.rail, base).after(ON_RAIL) for x in starts))


def guide_checks(weaver: Weaver, mass: float, row: LinearGuide) -> tuple[Check, ...]:
    """Life and static safety of the guide under a head of a mass [kg]."""
    cure, parts = "set lighter tools, or fewer colours", (GUIDE_CARRIAGE,)
    return (
        at_least(
            "life of the head's guide",
            life(weaver, mass, row),
            required_travel(weaver),
            "m",
            f"ISO 14728-1, {row.name}; {BEARING_LIFE:.0e} knots, assumed by this project",
        ).with_cure(cure, *parts),
        at_least(
            "static safety of the head's guide",
            row.static / _stepping(weaver, mass, row),
            STATIC_SAFETY,
            "1",
            f"static load rating of {row.name}; usual practice",
        ).with_cure(cure, *parts),
    )
