"""Parameters of a tufting needle mechanism."""

from dataclasses import dataclass
from typing import Any

from ilmek.machines.tufting.penetration import PenetrationParams
from ilmek.machines.tufting.strength_params import NeedleStrengthParams
from ilmek.params import Params, kind, nested
from ilmek.units import deg, mm, rpm, turn

SMALL, LARGE = 1e-4, 5.0
"""Plausible range of lengths [m]."""


def _length(default: float, symbol: str, doc: str, *, least: float = SMALL) -> Any:
    return kind.length(default, at_least=least, at_most=LARGE, doc=doc, symbol=symbol, alias=symbol)


def _mass(default: float, symbol: str, doc: str) -> Any:
    return kind.mass(default, at_least=0.0, at_most=1e4, doc=doc, symbol=symbol, alias=symbol)


def _inertia(default: float, symbol: str, body: str) -> Any:
    doc = f"moment of inertia of the {body} about its middle"
    return kind.inertia(default, at_least=0.0, at_most=1e3, doc=doc, symbol=symbol, alias=symbol)


@dataclass(frozen=True, slots=True)
class TuftingParams(Params):
    """A needle mechanism, its masses and loads; the defaults are the paper's (its Table 1), the aliases its symbols.

    Masses and moments of inertia do not follow the lengths: give them too where the links are others.
    """

    crank: float = _length(15 * mm, "l1", "crank on the main shaft, O to A")
    coupler: float = _length(138 * mm, "l2", "coupler, A to B")
    rocker: float = _length(115 * mm, "l3", "rocker on the driven shaft, C to B")
    arm: float = _length(125 * mm, "l4", "arm on the driven shaft, C to D")
    rod: float = _length(120 * mm, "l5", "rod, D to E")
    needle: float = _length(440 * mm, "l6", "needle bar, E to the needle's point F")
    shaft_distance: float = _length(70 * mm, "x1", "driven shaft C beside the main shaft O", least=-LARGE)
    shaft_height: float = _length(155 * mm, "H1", "driven shaft C above the main shaft O", least=-LARGE)
    needle_distance: float = _length(100 * mm, "x2", "needle's line beside the driven shaft C", least=-LARGE)
    arm_angle: float = kind.angle(
        168 * deg,
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
    link_mass: str = kind.choice(
        "paper",
        ("paper", "made"),
        doc="mass of the links in the forces: the masses given, the paper's, or that of the links as made",
    )
    crank_inertia: float = _inertia(4.34e-3, "J1", "crank")
    coupler_inertia: float = _inertia(26.99e-3, "J2", "coupler")
    rocker_inertia: float = _inertia(10.77e-3, "J3", "rocker")
    arm_inertia: float = _inertia(6.69e-3, "J4", "arm")
    rod_inertia: float = _inertia(0.91e-3, "J5", "rod")
    speed: float = kind.angular_speed(160 * rpm, above=0.0, at_most=1e4, doc="speed of the main shaft", symbol="ω1")
    friction_force: float = kind.force(
        1000.0,
        at_least=0.0,
        at_most=1e6,
        doc="friction of the backing on the needles, against their motion",
        symbol="Fr",
        alias="Fr",
    )
    friction: str = kind.choice(
        "window",
        ("window", "always", "depth"),
        doc="when the friction acts: from entry to exit, or all the time (the paper's words allow both); or by depth",
    )
    penetration: PenetrationParams = nested(PenetrationParams, doc="force of the backing over depth, friction=depth")
    entry: float = kind.angle(22 * deg, at_least=-turn, at_most=turn, doc="crank angle of entry into the backing")
    exit: float = kind.angle(194 * deg, at_least=-turn, at_most=turn, doc="crank angle of exit from the backing")
    gravity: float = kind.acceleration(9.81, at_least=0.0, at_most=1e3, doc="gravity, downwards", symbol="g")
    stroke: float = kind.length(32.5 * mm, above=0.0, at_most=LARGE, doc="required stroke; the paper: about 33 mm")
    bars: int = kind.count(1, at_least=1, at_most=64, doc="such mechanisms side by side on the main shaft")
    phase: float = kind.angle(0.0, at_least=-turn, at_most=turn, doc="lag of each crank behind the one before")
    link_width: float | None = kind.length(
        None, at_least=SMALL, at_most=LARGE, doc="width of the links' plates; default: by their masses"
    )
    link_thickness: float | None = kind.length(
        None, at_least=SMALL, at_most=LARGE, doc="thickness of the links' plates; default: by their masses"
    )
    strength: NeedleStrengthParams = nested(NeedleStrengthParams, doc="what links, pins and shafts bear")
    crank_angle: float | None = kind.angle(
        None,
        at_least=-2 * turn,
        at_most=2 * turn,
        doc="crank angle at which to report forces; where they jump, just after",
        symbol="θ1",
    )
