"""Involute spur gears: circles, teeth, undercut and outline of one gear.

    inv α = tan α - α,   rb = r cos α,   ra = m (z / 2 + 1 + x),   rf = m (z / 2 - 1.25 + x)
    s(R) = 2 R (π / 2 z + 2 x tan α / z + inv α - inv αR),   cos αR = rb / R

m module, z teeth, x profile shift in modules, α = 20 deg.             [ISO 21771; ISO 53, basic rack A]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, RealField
from ilmek.errors import ParameterError
from ilmek.plane.teeth import PRESSURE_ANGLE

DEDENDUM = 1.25


def involute(angle: float) -> float:
    """Inv α = tan α - α of an angle [rad]."""
    return math.tan(angle) - angle


def involute_angle(value: float) -> float:
    """The angle α [rad] with inv α = `value`, 0 or more, by Newton's method from Cheng's series.

    >>> round(involute_angle(involute(0.4)), 12)
    0.4
    """
    angle = (3 * value) ** (1 / 3)
    angle = angle - 2 * value / 5 if value < 1.8 else math.atan(value + math.pi / 2)
    for _ in range(20):
        tangent = math.tan(angle)
        if tangent == 0:
            return 0.0
        angle -= (tangent - angle - value) / tangent**2
    return angle


def least_shift(teeth: int) -> float:
    """Profile shift [modules] below which a rack cutter undercuts: 1 - z sin² α / 2; 0 at 17.1 teeth."""
    return 1 - teeth * math.sin(PRESSURE_ANGLE) ** 2 / 2


@dataclass(frozen=True, slots=True)
class Gear:
    """A spur gear: module [m], teeth, profile shift [modules]. Raises ParameterError for less than 5 teeth.

    >>> gear = Gear(0.002, 20)
    >>> round(gear.pitch_radius, 6), round(gear.tip_radius, 6), gear.undercut
    (0.02, 0.022, False)
    """

    module: float
    teeth: int
    shift: float = 0.0

    def __post_init__(self) -> None:
        if self.teeth < 5 or not self.module > 0:
            raise ParameterError(
                f"a gear of {self.teeth} teeth and module {self.module:g} m",
                allowed="5 teeth or more, a module above 0",
            )

    @property
    def pitch_radius(self) -> float:
        """Reference radius m z / 2 [m]."""
        return self.module * self.teeth / 2

    @property
    def base_radius(self) -> float:
        """Radius of the base circle [m]."""
        return self.pitch_radius * math.cos(PRESSURE_ANGLE)

    @property
    def tip_radius(self) -> float:
        """Tip radius of a single gear [m]; in a pair with shifts it is shortened (`gear_pair`)."""
        return self.pitch_radius + self.module * (1 + self.shift)

    @property
    def root_radius(self) -> float:
        """Root radius [m]."""
        return self.pitch_radius - self.module * (DEDENDUM - self.shift)

    @property
    def undercut(self) -> bool:
        """Whether a rack cutter undercuts the flank."""
        return self.shift < least_shift(self.teeth) - 1e-12

    def half_thickness(self, radius: RealField) -> FloatArray:
        """Half the angle [rad] of a tooth at a radius outside the base circle [m]; negative beyond its point."""
        cosine = np.minimum(self.base_radius / np.asarray(radius, dtype=float), 1.0)
        angle = np.arccos(cosine)
        at_pitch = (math.pi / 2 + 2 * self.shift * math.tan(PRESSURE_ANGLE)) / self.teeth
        return np.asarray(at_pitch + involute(PRESSURE_ANGLE) - (np.tan(angle) - angle))


def outline(gear: Gear, tip_radius: float | None = None, points: int = 9) -> ComplexArray:
    """The gear's closed outline about its centre [m], with a tooth on the real axis, without root fillets.

    points  on each flank; below the base circle the flank is drawn radially
    """
    tip = gear.tip_radius if tip_radius is None else tip_radius
    radius = np.linspace(max(gear.base_radius, gear.root_radius), tip, points)
    half = np.maximum(gear.half_thickness(radius), 0.0)
    flank = np.concatenate(([gear.root_radius], radius)) * np.exp(1j * np.concatenate((half[:1], half)))
    arc = np.linspace(half[-1], -half[-1], 5)[1:-1]
    tooth = np.concatenate((flank.conj(), tip * np.exp(-1j * arc), flank[::-1]))
    turns = np.exp(2j * math.pi * np.arange(gear.teeth) / gear.teeth)
    return np.asarray(np.outer(turns, tooth).ravel())
