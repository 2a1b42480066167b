"""What may be asked of a tufting needle mechanism."""

from dataclasses import dataclass
from typing import Any

from ilmek.params import Params, param
from ilmek.units import deg, mm, rpm, turn

SMALL, LARGE = 1e-4, 5.0
"""Lengths that are taken for meant [m]."""


def _length(default: float, alias: str, doc: str) -> Any:
    return param(default, unit="mm", at_least=SMALL, at_most=LARGE, doc=doc, symbol=alias, alias=alias)


def _distance(default: float, alias: str, doc: str) -> Any:
    return param(default, unit="mm", at_least=-LARGE, at_most=LARGE, doc=doc, symbol=alias, alias=alias)


def _mass(default: float, alias: str, doc: str) -> Any:
    return param(default, unit="kg", at_least=0.0, at_most=1e4, doc=doc, symbol=alias, alias=alias)


def _moment(default: float, alias: str, doc: str) -> Any:
    return param(default, unit="kg*m^2", at_least=0.0, at_most=1e3, doc=doc, symbol=alias, alias=alias)


@dataclass(frozen=True, slots=True)
class TuftingParams(Params):
    """What may be asked of a needle mechanism; the defaults are the paper's (its Table 1), the aliases its symbols.

    Masses and moments of inertia do not follow the lengths: give them too where the links are others.
    """

    crank: float = _length(15 * mm, "l1", "crank on the main shaft, O to A")
    coupler: float = _length(138 * mm, "l2", "coupler, A to B")
    rocker: float = _length(115 * mm, "l3", "rocker on the driven shaft, C to B")
    arm: float = _length(125 * mm, "l4", "arm on the driven shaft, C to D")
    rod: float = _length(120 * mm, "l5", "rod, D to E")
    needle: float = _length(440 * mm, "l6", "needle bar, E to the needle's point F")
    shaft_distance: float = _distance(70 * mm, "x1", "driven shaft C beside the main shaft O")
    shaft_height: float = _distance(155 * mm, "H1", "driven shaft C above the main shaft O")
    needle_distance: float = _distance(100 * mm, "x2", "needle's line beside the driven shaft C")
    arm_angle: float = param(
        168 * deg,
        unit="deg",
        at_least=-turn,
        at_most=turn,
        doc="from the rocker C-B to the arm C-D, counter-clockwise",
        symbol="β1",
        alias="beta1",
    )
    crank_mass: float = _mass(3.07, "m1", "mass of the crank")
    coupler_mass: float = _mass(3.79, "m2", "mass of the coupler")
    rocker_mass: float = _mass(2.96, "m3", "mass of the rocker")
    arm_mass: float = _mass(1.74, "m4", "mass of the arm")
    rod_mass: float = _mass(0.36, "m5", "mass of the rod")
    needle_mass: float = _mass(1.47, "m6", "mass of needle bar and needles")
    crank_inertia: float = _moment(4.34e-3, "J1", "moment of inertia of the crank about its middle")
    coupler_inertia: float = _moment(26.99e-3, "J2", "moment of inertia of the coupler about its middle")
    rocker_inertia: float = _moment(10.77e-3, "J3", "moment of inertia of the rocker about its middle")
    arm_inertia: float = _moment(6.69e-3, "J4", "moment of inertia of the arm about its middle")
    rod_inertia: float = _moment(0.91e-3, "J5", "moment of inertia of the rod about its middle")
    speed: float = param(160 * rpm, unit="rpm", above=0.0, at_most=1e4, doc="speed of the main shaft", symbol="ω1")
    friction_force: float = param(
        1000.0,
        unit="N",
        at_least=0.0,
        at_most=1e6,
        doc="friction of the backing on the needles, against their motion",
        symbol="Fr",
        alias="Fr",
    )
    friction: str = param(
        "window",
        choices=("window", "always"),
        doc="when the friction acts: from entry to exit, or all the time (the paper's words allow both)",
    )
    entry: float = param(
        22 * deg, unit="deg", at_least=-turn, at_most=turn, doc="crank angle at which needles enter the backing"
    )
    exit: float = param(
        194 * deg, unit="deg", at_least=-turn, at_most=turn, doc="crank angle at which needles leave the backing"
    )
    gravity: float = param(9.81, unit="m/s^2", at_least=0.0, at_most=1e3, doc="free fall, downward", symbol="g")
    stroke: float = param(
        32.5 * mm, unit="mm", above=0.0, at_most=LARGE, doc="stroke that is wanted at least; the paper: about 33 mm"
    )
    bars: int = param(1, at_least=1, at_most=64, doc="such mechanisms side by side on the main shaft")
    phase: float = param(
        0.0, unit="deg", at_least=-turn, at_most=turn, doc="angle by which each crank runs behind the one before"
    )
    link_width: float = param(
        30 * mm, unit="mm", at_least=SMALL, at_most=LARGE, doc="width of the links' plates; masses do not follow"
    )
    link_thickness: float = param(
        10 * mm, unit="mm", at_least=SMALL, at_most=LARGE, doc="thickness of the links' plates; masses do not follow"
    )
    crank_angle: float | None = param(
        None,
        unit="deg",
        at_least=-2 * turn,
        at_most=2 * turn,
        doc="crank angle at which to report forces; where they jump, just after",
        symbol="θ1",
    )
