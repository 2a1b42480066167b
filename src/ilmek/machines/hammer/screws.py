"""Ball screws of the vertical axes: buckling, static load, critical speed, speed value, and life of the nut.

    P_k = 2 pi^2 E I / l^2          one end clamped, I of the core
    w_k = 3.927^2 sqrt(E I / (rho A)) / l^2 = 3.927^2 (d_k / 4) sqrt(E / rho) / l^2      clamped, hinged [Rao, 8.5]
    L = (C / F_m)^3 10^6 turns,   F_m^3 = sum F^3 |w| dt / sum |w| dt                    [ISO 3408-5]

l is the length between bearing and nut, d_k the core. A screw must keep 80 % of its critical speed, and the product of
its diameter and speed within that of its nut.
"""

import math

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.screws import BALL_FRICTION, CORE, Screw
from ilmek.machines.hammer.params import STEEL, HammerParams
from ilmek.records import record, result
from ilmek.report import Check, at_least, at_most
from ilmek.units import kN, mm, turn

SCREW_ENDS = 0.2
"""Length of a screw beyond its stroke [m]: nut and bearings."""

BUCKLING, STATIC, CRITICAL = 3.0, 2.0, 0.8
"""Required safeties of a screw against buckling and of its nut at rest, and share of the critical speed allowed."""

LOADS = {
    size * mm: (dynamic * kN, static * kN)
    for size, dynamic, static in (
        (12, 2.2, 4), (16, 9, 12), (20, 12, 19), (25, 14, 25), (32, 25, 45), (40, 38, 75), (50, 50, 110), (63, 60, 160),
        (80, 75, 240), (100, 90, 320),
    )
}  # fmt: skip
"""Load ratings C and C0 [N] of nuts by the screw's diameter [m]: values of catalogues, rounded down."""

_ROOT = 3.927


@record
class AxisScrew:
    """A ball screw of a vertical axis under its load."""

    required_life: float
    speed_limit: float
    diameter: float = result("mm", "diameter of a ball screw", name="screw_diameter", least=0.0)
    buckling: float = result("1", "safety of a screw against buckling, Euler", name="buckling_safety")
    static: float = result("1", "safety of a screw's nut at rest, C0 over its largest load", name="screw_static_safety")
    critical: float = result("1", "speed of a screw over its critical speed", name="screw_critical_share")
    speed_value: float = result("m/s", "diameter of a screw times its angular speed", name="screw_speed_value")
    life: float | None = result("h", "life of a screw's nut, ISO 3408-5", name="screw_life", optional=True)


@record
class ScrewLoad:
    """Load of a screw over a turn of the cams: force [N] and angular speed [rad/s] at equal steps; length [m]."""

    force: FloatArray
    speed: FloatArray
    length: float


def screw_for(params: HammerParams, load: ScrewLoad) -> AxisScrew:
    """The screw of the given diameter, or the first of stock whose checks hold, else the largest."""
    offered = (params.screw_diameter,) if params.screw_diameter else tuple(LOADS)
    found = [_screw(params, load, diameter) for diameter in offered]
    return next((one for one in found if all(check.ok for check in screw_checks(one))), found[-1])


def screw_checks(screw: AxisScrew) -> tuple[Check, ...]:
    """Whether a screw and its nut bear their load."""
    more, slower = "set more axes, or a thicker screw_diameter", "set a larger lead, or a lower comb_acceleration"
    rated = "catalogue values, rounded down"
    checks = (
        at_least("buckling of the screws", screw.buckling, BUCKLING, "1", "Euler, one end clamped").with_cure(more),
        at_least("static load of the screws", screw.static, STATIC, "1", f"C0 over the load; {rated}").with_cure(more),
        at_most("critical speed of the screws", screw.critical, CRITICAL, "1", "80 % of the whirl").with_cure(slower),
        at_most(
            "speed value of the screws",
            screw.speed_value,
            screw.speed_limit,
            "m/s",
            "assumed by this project: parameter axis_speed_value",
        ).with_cure(slower),
    )
    if screw.life is None:
        return checks
    source = f"ISO 3408-5, axis_life; {rated}"
    return *checks, at_least("life of the screws", screw.life, screw.required_life, "h", source).with_cure(more)


def _screw(params: HammerParams, load: ScrewLoad, diameter: float) -> AxisScrew:
    # A diameter between those of stock has the ratings of the next smaller one, in proportion to its area below that.
    below = [size for size in LOADS if size <= diameter * (1 + 1e-9)]
    size = max(below) if below else min(LOADS)
    scale = 1.0 if below else (diameter / size) ** 2
    dynamic, static = (rating * scale for rating in LOADS[size])
    ball = Screw(diameter, params.screw_lead, CORE * diameter, BALL_FRICTION)
    force, speed = np.abs(load.force), np.abs(load.speed)
    most, quickest, turned = float(force.max()), float(speed.max()), float(speed.sum())
    mean = float(np.sum(force**3 * speed) / turned) ** (1 / 3) if turned > 0 else 0.0
    whirl = _ROOT**2 * ball.core / 4 * math.sqrt(STEEL.modulus / STEEL.density) / load.length**2
    return AxisScrew(
        required_life=params.axis_life,
        speed_limit=params.axis_speed_value,
        diameter=diameter,
        buckling=ball.buckling_force(load.length, STEEL.modulus) / most if most > 0 else math.inf,
        static=static / most if most > 0 else math.inf,
        critical=quickest / whirl,
        speed_value=diameter * quickest,
        life=(dynamic / mean) ** 3 * 1e6 * turn / float(speed.mean()) if mean > 0 else None,
    )
