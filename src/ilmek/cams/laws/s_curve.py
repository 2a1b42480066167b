"""The S-curve of servo axes: constant jerk, constant acceleration, constant jerk back, cruise, and the same mirrored.

    j = +-J,   J = 1 / (r (r + h) (2 r + h + c)),   4 r + 2 h + c = 1

r, h and c are shares of the time: of each of the four ramps of the acceleration, of each phase of constant
acceleration, and of the cruise. The fastest move within limits of speed, acceleration and jerk is of this form
[`ilmek.timing.s_curve`]. With r = 1/4 and c = 0 it has the least peak jerk of all laws from rest to rest, 32. At every
break the jerk changes by +-J, so that a = J sum(+-(u - t)+), v = J/2 sum(+-(u - t)+^2), s = J/6 sum(+-(u - t)+^3) over
the eight breaks t. [derived: integration of the jerk]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.cams.laws.law import Law, LawFamily
from ilmek.errors import ParameterError

_SIGNS = (1.0, -1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0)
_ROUNDING = 1e-12


@dataclass(frozen=True, slots=True)
class _Ramps:
    breaks: tuple[float, ...]
    jerk: float

    def _sum(self, u: RealField, power: int) -> RealField:
        past = (sign * np.maximum(u - at, 0.0) ** power for sign, at in zip(_SIGNS, self.breaks, strict=True))
        return self.jerk / math.factorial(power) * sum(past, start=0.0 * np.asarray(u))

    def s(self, u: RealField) -> RealField:
        """Displacement."""
        return self._sum(u, 3)

    def v(self, u: RealField) -> RealField:
        """Velocity."""
        return self._sum(u, 2)

    def a(self, u: RealField) -> RealField:
        """Acceleration."""
        return self._sum(u, 1)

    def j(self, u: RealField) -> RealField:
        """Jerk; at a break the mean of both sides."""
        at: FloatArray = np.asarray(u, dtype=float)
        inner = zip(_SIGNS[1:-1], self.breaks[1:-1], strict=True)
        steps = (sign * np.heaviside(at - break_, 0.5) for sign, break_ in inner)
        return np.asarray(self.jerk * sum(steps, start=np.ones_like(at)))


def law(ramp: float, cruise: float) -> Law:
    """The S-curve; ramp: share [-] of the time of each of the four jerk phases; cruise: share [-] at constant velocity.

    Raises ParameterError unless ramp > 0, cruise >= 0 and 4 ramp + cruise <= 1.

    >>> law(0.25, 0.0).jerk_peak, law(0.25, 0.0).acceleration_peak, law(0.25, 0.0).velocity_peak
    (32.0, 8.0, 2.0)
    """
    if not (ramp > 0 and cruise >= 0 and 4 * ramp + cruise <= 1 + _ROUNDING):
        raise ParameterError(
            f"s-curve with ramp={ramp:g}, cruise={cruise:g}",
            allowed="ramp above 0, cruise at least 0, 4 ramp + cruise at most 1",
        )
    hold = max(0.0, (1 - cruise) / 2 - 2 * ramp)
    speeding = 2 * ramp + hold
    first = (0.0, ramp, ramp + hold, speeding)
    curves = _Ramps((*first, *(1 - at for at in reversed(first))), 1 / (ramp * (ramp + hold) * (speeding + cruise)))
    top, speed = curves.jerk * ramp, curves.jerk * ramp * (ramp + hold)
    # While the acceleration falls, x before its end, v a = J x (V - J x^2 / 2).
    x = min(ramp, math.sqrt(2 * speed / (3 * curves.jerk)))
    torque = curves.jerk * x * (speed - curves.jerk * x**2 / 2)
    rms = top * math.sqrt(4 * ramp / 3 + 2 * hold)
    inner = tuple(sorted({at for at in curves.breaks if _ROUNDING < at < 1 - _ROUNDING}))
    given = {"ramp": ramp, "cruise": cruise}
    peaks = speed, top, curves.jerk, torque, rms
    return Law("s-curve", curves.s, curves.v, curves.a, curves.j, *peaks, inner, given)


FAMILY = LawFamily(law, {"ramp": 0.125, "cruise": 0.25})
