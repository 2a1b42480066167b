"""The bracket of a head: a tube from the carriage to the case, bent by the head's weight and by the carriage's step.

    M = m g e,   M' = m a e                            at the carriage; m of the head, e to the middle of its case
    f = M0 l^2 / (2 E I) + m g l^3 / (3 E I),   s = M0 l / (E I) + m g l^2 / (2 E I),   M0 = m g (e - l)
    f + s d                                            sag of the tools, d before the bracket's end

l is the bracket's length, a the acceleration of the step. Case, carriage and rail count as rigid.   [beam, cantilever]
"""

from ilmek.elements.materials import GRAVITY
from ilmek.machines.weaver.carriage_drive import drive_checks
from ilmek.machines.weaver.carriage_guide import guide_checks
from ilmek.machines.weaver.case import ALUMINIUM, BRACKET, BRACKET_WALL
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.head_shape import RAIL_AXIS
from ilmek.machines.weaver.tree import carriage_guide, drive_of, head_mass
from ilmek.machines.weaver.widths import case_width
from ilmek.records import record
from ilmek.report import Check, at_most

SAG = 0.1
"""Allowed sag of the tools over the pitch of the warps; assumed by this project."""

STRESS = (ALUMINIUM.fatigue or 0.0) / 2
"""Allowed stress [Pa]: fatigue limit over 2; assumed by this project."""


@record
class BracketReach:
    """Distances [m]: length of the bracket, carriage to the middle of the case, end of the bracket to the tools."""

    length: float
    centre: float
    tools: float


@record
class BracketLoad:
    """Stress of the bracket at the carriage [Pa], and sag of the tools [m]."""

    stress: float
    sag: float


def bracket_load(
    mass: float, acceleration: float, section: tuple[float, float, float], reach: BracketReach
) -> BracketLoad:
    """Load by a head of a mass [kg] whose carriage has an acceleration [m/s^2].

    section  width, height and wall of the tube [m]
    """
    wide, high, wall = section
    upright, sideways = _inertia(wide, high, wall), _inertia(high, wide, wall)
    weight, length = mass * GRAVITY, reach.length
    bending = weight * (reach.centre - length), ALUMINIUM.modulus * upright
    sag = (bending[0] * length**2 / 2 + weight * length**3 / 3) / bending[1]
    slope = (bending[0] * length + weight * length**2 / 2) / bending[1]
    stress = mass * reach.centre * (GRAVITY * high / 2 / upright + acceleration * wide / 2 / sideways)
    return BracketLoad(stress, sag + slope * reach.tools)


def _inertia(wide: float, high: float, wall: float) -> float:
    """Second moment of area of a rectangular tube about its horizontal axis [m^4]."""
    return (wide * high**3 - (wide - 2 * wall) * (high - 2 * wall) ** 3) / 12


def bracket_checks(weaver: Weaver) -> tuple[Check, ...]:
    """Stress of the bracket, sag of the tools, and the guide of the carriage."""
    shape, params, wide = weaver.shape, weaver.params, case_width(weaver.params)
    rear = shape.body + shape.size
    reach = BracketReach(shape.front - rear.real, shape.front - rear.real + shape.size.real / 2, rear.real)
    section = wide, RAIL_AXIS, min(BRACKET_WALL, wide / 4)
    load = bracket_load(head_mass(weaver), params.carriage_acceleration, section, reach)
    source, cure = (
        f"{ALUMINIUM.name}, fatigue limit over 2; assumed by this project",
        "set lighter tools, or fewer colours",
    )
    tenth = "a tenth of the warp pitch; assumed by this project"
    pitch = params.cloth.warp_pitch
    return (
        at_most("stress of the head's bracket", load.stress, STRESS, "MPa", source).with_cure(cure, BRACKET),
        at_most("sag of the head at its tools", load.sag, SAG * pitch, "mm", tenth).with_cure(cure, BRACKET),
        *guide_checks(weaver, head_mass(weaver), carriage_guide(weaver)),
        *drive_checks(weaver, drive_of(weaver)),
    )
