"""A pair of equal spur gears, one outside the other, on axes at a given distance.

    a cos αw = m z cos α,     x1 + x2 = 2 z (inv αw - inv α) / (2 tan α),     inv α = tan α - α
    σ = F / (b m Y)

a distance of the axes, m module, z teeth of each, α = 20 deg, αw working pressure angle, x profile shifts; F force
along the pitch circle, b width, Y Lewis' form factor, σ bending stress at the root of a tooth with the whole load at
its tip. The profiles are shifted where a is no standard distance m z.     [ISO 21771 for the teeth; Lewis' equation,
Shigley's Mechanical Engineering Design, 14-1: a first estimate, without dynamic load, notch and overlap]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.elements.involute import involute
from ilmek.errors import IlmekError
from ilmek.plane.teeth import PRESSURE_ANGLE
from ilmek.units import format_quantity, mm

MODULES = tuple(module * mm for module in (0.5, 0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0))
"""Preferred modules [m]: series I of ISO 54."""

_TEETH = (12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 24, 26, 28, 30, 34, 38, 43, 50, 60, 75, 100, 150, 300, 400)
_FORM = (0.245, 0.261, 0.277, 0.290, 0.296, 0.303, 0.309, 0.314, 0.322, 0.328, 0.331, 0.337, 0.346, 0.353, 0.359, 0.371,
         0.384, 0.397, 0.409, 0.422, 0.435, 0.447, 0.460, 0.472, 0.480)  # fmt: skip
_RACK = 0.485
"""Lewis' form factor of 20 deg full teeth [Shigley, table 14-2]."""

LEAST_TEETH = 18
"""Least number of teeth without undercut: above 2 / sin² α = 17.1."""


@dataclass(frozen=True, slots=True)
class EqualGears:
    """Two equal spur gears: distance of their axes, module and width [m], teeth of each."""

    distance: float
    module: float
    teeth: int
    width: float

    @property
    def pitch_radius(self) -> float:
        """Radius of the operating pitch circles [m]: half the distance."""
        return self.distance / 2

    @property
    def pressure_angle(self) -> float:
        """Working pressure angle αw [rad]."""
        return math.acos(self.module * self.teeth * math.cos(PRESSURE_ANGLE) / self.distance)

    @property
    def profile_shift(self) -> float:
        """Sum x1 + x2 of the profile shifts, in modules; 0 at the standard distance.

        >>> round(EqualGears(0.075, 0.001, 74, 0.005).profile_shift, 6)
        1.048757
        """
        more = involute(self.pressure_angle) - involute(PRESSURE_ANGLE)
        return self.teeth * more / math.tan(PRESSURE_ANGLE)

    def force(self, torque: float) -> float:
        """Force along the pitch circle [N] of a torque on one wheel [N m]."""
        return abs(torque) / self.pitch_radius

    def separating(self, force: float) -> float:
        """Separating force along the line of centres [N]: F tan αw."""
        return force * math.tan(self.pressure_angle)

    def bending(self, force: float) -> float:
        """Bending stress at the root of a tooth [Pa] under a force along the pitch circle [N]."""
        return force / (self.width * self.module * lewis(self.teeth))


def lewis(teeth: int) -> float:
    """Lewis' form factor Y [1] of 20 deg full teeth, linear in 1 / z between the table's; below 12 teeth that of 12.

    [Shigley, table 14-2]

    >>> lewis(20), round(lewis(200), 3), round(lewis(10**9), 3)
    (0.322, 0.466, 0.485)
    """
    inverse = [0.0, *(1 / number for number in reversed(_TEETH))]
    return float(np.interp(1 / teeth, inverse, [_RACK, *reversed(_FORM)]))


def equal_gears(
    distance: float, torque: float, *, width: float, stress: float, module: float | None = None, standard: bool = False
) -> EqualGears:
    """The finest equal gears that are sufficient for a torque on a wheel [N m], with axes at a distance [m].

    width     of the wheels [m]      stress  allowed bending stress [Pa]      module  [m]; default: the preferred
              modules
    standard  increase the distance to the next standard one, without profile shifts
    If no module is sufficient, the coarsest that fits is chosen; check `bending`. Raises IlmekError if even the finest
    module gives fewer than 18 teeth.

    >>> gears = equal_gears(0.0735, 0.5, width=0.005, stress=20e6, standard=True)
    >>> gears.module, gears.teeth, gears.distance, round(gears.profile_shift, 9)
    (0.0005, 147, 0.0735, 0.0)
    """
    fitting = []
    for one in MODULES if module is None else (module,):
        teeth = math.ceil(distance / one * (1 - 1e-12)) if standard else round(distance / one)
        if teeth >= LEAST_TEETH:
            fitting.append(EqualGears(one * teeth if standard else distance, one, teeth, width))
    if not fitting:
        finest = MODULES[0] if module is None else module
        least = format_quantity(finest * LEAST_TEETH, "mm")
        raise IlmekError(
            f"axes {format_quantity(distance, 'mm')} apart for gears of module {format_quantity(finest, 'mm')}",
            allowed=f"{least} or more: fewer than {LEAST_TEETH} teeth are undercut",
            do="move the axes apart, or use a finer module",
        )
    return next((one for one in fitting if one.bending(one.force(torque)) <= stress), fitting[-1])
