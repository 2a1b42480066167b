"""Screws: force and torque with friction in both directions, buckling.

    T = F d/2 tan(λ + ρ),   η = tan λ / tan(λ + ρ);   back-driven:  T' = F d/2 tan(λ - ρ),   η' = tan(λ - ρ) / tan λ
    tan λ = P / (π d),   tan ρ = μ / cos α

d pitch diameter, P lead, λ lead angle, μ friction, α half the thread's angle (15° trapezoidal, 0 square; a ball screw
has an effective μ of 0.003 to 0.01). The force turns the nut or screw only for λ > ρ, the torque gives a
thrust only for λ + ρ < 90°; in between the screw can be driven in both directions.
                                                                         [Shigley, 8-2; ISO 2904 for the thread's sizes]
"""

import math
from dataclasses import dataclass

from ilmek.errors import ParameterError
from ilmek.units import deg, format_quantity, mm


@dataclass(frozen=True, slots=True)
class Screw:
    """A screw: pitch diameter, lead, core diameter [m], coefficient of friction, half of the thread's angle [rad].

    >>> ball = Screw(0.02, 0.005, 0.0171, 0.005)
    >>> round(ball.efficiency, 3), round(ball.back_driving_efficiency, 3), ball.self_locking
    (0.941, 0.937, False)
    """

    diameter: float
    lead: float
    core: float
    friction: float
    flank: float = 0.0

    def __post_init__(self) -> None:
        if not (self.diameter > 0 and self.lead > 0 and self.friction >= 0):
            raise ParameterError(
                f"a screw of diameter {self.diameter:g} m, lead {self.lead:g} m and friction {self.friction:g}",
                allowed="diameter and lead above 0, friction 0 or more",
            )

    @property
    def lead_angle(self) -> float:
        """λ [rad]."""
        return math.atan2(self.lead, math.pi * self.diameter)

    @property
    def friction_angle(self) -> float:
        """ρ [rad]."""
        return math.atan(self.friction / math.cos(self.flank))

    @property
    def self_locking(self) -> bool:
        """Whether a force along the axis cannot turn it: λ <= ρ."""
        return self.lead_angle <= self.friction_angle

    @property
    def jams(self) -> bool:
        """Whether a torque gives no thrust: λ + ρ >= 90°."""
        return self.lead_angle + self.friction_angle >= math.pi / 2

    @property
    def efficiency(self) -> float:
        """Efficiency η from torque to thrust; 0 where it jams."""
        return 0.0 if self.jams else math.tan(self.lead_angle) / math.tan(self.lead_angle + self.friction_angle)

    @property
    def back_driving_efficiency(self) -> float:
        """Efficiency η' from thrust to torque; 0 where it is self-locking."""
        return max(0.0, math.tan(self.lead_angle - self.friction_angle) / math.tan(self.lead_angle))

    def torque(self, force: float) -> float:
        """Torque [N m] for a thrust [N]: F d/2 tan(λ + ρ); inf where it jams."""
        turned = self.lead_angle + self.friction_angle
        return math.inf if self.jams else force * self.diameter / 2 * math.tan(turned)

    def holding_torque(self, force: float) -> float:
        """Torque [N m] produced by a force [N]: F d/2 tan(λ - ρ); below 0 for a self-locking screw: to lower it."""
        return force * self.diameter / 2 * math.tan(self.lead_angle - self.friction_angle)

    def buckling_force(self, length: float, modulus: float, ends: str = "clamped-hinged") -> float:
        """Euler's buckling force of the core [N]: c π² E I / l² [Shigley, 4-12].

        length  [m]      modulus  E [Pa]      ends  of `END_FIXITY`. Raises ParameterError for others
        Valid for stresses below half the yield strength.
        """
        if ends not in END_FIXITY:
            raise ParameterError(f"ends {ends!r}", allowed="one of " + ", ".join(END_FIXITY))
        inertia = math.pi * self.core**4 / 64
        return END_FIXITY[ends] * math.pi**2 * modulus * inertia / length**2


END_FIXITY = {"clamped-free": 0.25, "hinged": 1.0, "clamped-hinged": 2.0, "clamped": 4.0}
"""Euler's c by the ends [theory; designers use 1.2 for elastic clamped ends]."""


CORE, BALL_FRICTION = 0.85, 0.005
"""Core diameter of a ball screw over the nominal one, and its friction."""


_TRAPEZOIDAL = {8: 1.5, 10: 2, 12: 3, 14: 3, 16: 4, 18: 4, 20: 4, 24: 5, 28: 5, 32: 6, 36: 6, 40: 7, 44: 7, 50: 8}
"""Preferred pitch [mm] of each nominal diameter [mm], ISO 2902 and 2904."""


def trapezoidal(nominal: float, starts: int = 1, friction: float = 0.12) -> Screw:
    """The Tr screw of a nominal diameter [m] with one start or more; default friction: steel on bronze in oil.

    Raises ParameterError with the nearest preferred diameter for another one.

    d2 = d - P / 2,   d3 = d - P - 2 ac, ac = 0.15 mm for P 1.5, 0.25 mm up to 5, 0.5 mm above [ISO 2904]
    >>> screw = trapezoidal(0.020)
    >>> round(screw.diameter, 6), round(screw.core, 6), screw.self_locking
    (0.018, 0.0155, True)
    """
    size = min(_TRAPEZOIDAL, key=lambda one: abs(one * mm - nominal))
    if abs(size * mm - nominal) > 1e-6:
        raise ParameterError(
            f"no trapezoidal screw of {format_quantity(nominal, 'mm')} in the table",
            allowed=f"the nearest offered is Tr {size}",
            do="use it, or one of " + " ".join(map(str, _TRAPEZOIDAL)),
        )
    pitch = _TRAPEZOIDAL[size]
    clearance = 0.15 if pitch < 2 else 0.25 if pitch <= 5 else 0.5
    return Screw((size - pitch / 2) * mm, starts * pitch * mm, (size - pitch - 2 * clearance) * mm, friction, 15 * deg)
