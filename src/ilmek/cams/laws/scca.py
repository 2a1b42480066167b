"""The SCCA family (sine, constant, cosine acceleration): one formula for most cam laws.

The acceleration rises along a quarter sine wave, stays constant, and falls along a quarter cosine wave to the middle;
the deceleration mirrors it. b (sine), c (constant) and d (cosine) are the shares of the time of both halves together.
The remaining time, 1 - b - c - d, is at constant velocity about the middle.  [Norton, Cam Design and Manufacturing, 3]

    parabolic (0, 1, 0)              harmonic (0, 0, 1)             cycloidal (1/2, 0, 1/2)
    modified trapezoid (1/4, 1/2, 1/4)                              modified sine (1/4, 0, 3/4)

With b + c + d = 1 the peak is Ca = 4 pi^2 / ((pi^2 - 8)(b^2 - d^2) - 2 pi (pi - 2) b + pi^2).

From the middle outwards, h = |u - 1/2| passes the lengths E (constant velocity), D = d/2, C = c/2 and B = b/2; x1 and
x3 are its parts within E and C. With p = 2D/pi and q = 2B/pi, the angle y grows from 0 to pi/2 along the cosine, stays
constant, and grows to pi along the sine, so one formula serves all zones:

    |a| = Ca sin y,    v = Ca (p max(cos y, 0) + C - x3 + q (1 + min(cos y, 0)))
    |s - 1/2| = Ca ((p + C + q) x1 + x3 (C + q - x3/2) + w),
    w = p ((C + q) y + p sin y) up to y = pi/2, then q^2 (y + sin y) plus a constant that makes it continuous
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ilmek.arrays import RealField
from ilmek.cams.laws.law import Law, LawFamily, LawValues, Parameters
from ilmek.errors import ParameterError

_ROUNDING = 1e-12
_BY_ANGLE = 2.0 / math.pi
_QUARTER = 0.5 * math.pi


class _Zones(NamedTuple):
    """Position of u: side of the middle, parts of the lengths E and C, and the angle y."""

    side: RealField
    x1: RealField
    x3: RealField
    y: RealField


@dataclass(frozen=True, slots=True)
class _Waves:
    """The lengths E, D, C, B from the middle to the end, and the peak Ca."""

    even: float
    cosine: float
    constant: float
    sine: float
    peak: float

    @property
    def p(self) -> float:
        """Length over angle of the cosine."""
        return _BY_ANGLE * self.cosine

    @property
    def q(self) -> float:
        """Length over angle of the sine."""
        return _BY_ANGLE * self.sine

    def zones(self, u: RealField) -> _Zones:
        """Position of each u in the zones."""
        d = np.asarray(u - 0.5)
        x = np.abs(d)
        x1: RealField = 0.0
        if self.even > 0:
            x1 = np.minimum(x, self.even)
            x = x - x1
        y = np.minimum(x, self.cosine) / self.p if self.p > 0 else _QUARTER * (x > 0)
        x = np.maximum(x - self.cosine, 0.0)
        x3 = np.minimum(x, self.constant) if self.constant > 0 else 0.0
        if self.q > 0:
            y = y + (x - x3) / self.q
        return _Zones(np.sign(d), x1, x3, y)

    def s(self, u: RealField) -> RealField:
        """Displacement."""
        at = self.zones(u)
        return self._s(at, np.sin(at.y))

    def v(self, u: RealField) -> RealField:
        """Velocity."""
        at = self.zones(u)
        return self._v(at, np.cos(at.y))

    def a(self, u: RealField) -> RealField:
        """Acceleration."""
        at = self.zones(u)
        return -self.peak * at.side * np.sin(at.y)

    def j(self, u: RealField) -> RealField:
        """Jerk."""
        at = self.zones(u)
        return self._j(at, np.cos(at.y))

    def motion(self, u: RealField) -> LawValues:
        """s, v, a and j at u, from one sine and one cosine."""
        at = self.zones(u)
        sin, cos = np.sin(at.y), np.cos(at.y)
        return LawValues(self._s(at, sin), self._v(at, cos), -self.peak * at.side * sin, self._j(at, cos))

    def _s(self, at: _Zones, sin: RealField) -> RealField:
        p, q, hold = self.p, self.q, self.constant + self.q
        join = p * hold * _QUARTER + p**2 - q**2 * (_QUARTER + 1.0)
        rise = np.where(at.y > _QUARTER, q**2 * (at.y + sin) + join, p * hold * at.y + p**2 * sin)
        if self.even > 0:
            rise = rise + (p + hold) * at.x1
        if self.constant > 0:
            rise = rise + at.x3 * (hold - 0.5 * at.x3)
        return 0.5 + self.peak * at.side * rise

    def _v(self, at: _Zones, cos: RealField) -> RealField:
        slowing = self.p * np.maximum(cos, 0.0) + self.q * (1.0 + np.minimum(cos, 0.0))
        return self.peak * (slowing + (self.constant - at.x3))

    def _j(self, at: _Zones, cos: RealField) -> RealField:
        before = -self.peak / self.p if self.p > 0 else 0.0
        after = -self.peak / self.q if self.q > 0 else 0.0
        rate = np.where(at.y > _QUARTER, after, before)
        if self.even > 0:
            rate = rate * (at.y > 0)
        return rate * cos


def family(name: str, b: float, c: float, d: float, parameters: Parameters) -> Law:
    """The SCCA law with the shares b, c, d [-] of the time, under the given name and parameters.

    Raises ParameterError unless each share is at least 0 and their sum is above 0 and at most 1.
    """
    if not (min(b, c, d) >= 0 and 0 < b + c + d <= 1 + _ROUNDING):
        raise ParameterError(
            f"{name} with b={b:g}, c={c:g}, d={d:g}", allowed="each at least 0, their sum above 0 and at most 1"
        )
    even = max(0.5 * (1.0 - b - c - d), 0.0)
    even = even if even > _ROUNDING else 0.0
    peak = _peak(even, 0.5 * d, 0.5 * c, 0.5 * b)
    waves = _Waves(even, 0.5 * d, 0.5 * c, 0.5 * b, peak)
    least = min(b, d)
    jerk = math.pi * peak / least if least > 0 else math.inf
    peaks = _top(waves), peak, jerk, _torque(waves), peak * math.sqrt(0.5 * b + c + 0.5 * d)
    return Law(name, waves.s, waves.v, waves.a, waves.j, *peaks, _breaks(waves), parameters, at_once=waves.motion)


def law(b: float, c: float, d: float) -> Law:
    """The SCCA law with the shares b (sine), c (constant), d (cosine) [-] of the time; the rest at constant velocity.

    Raises ParameterError unless each share is at least 0 and their sum is above 0 and at most 1.

    >>> round(law(0.25, 0.5, 0.25).acceleration_peak, 6)
    4.888124
    """
    return family("scca", b, c, d, {"b": b, "c": c, "d": d})


def _peak(even: float, cosine: float, constant: float, sine: float) -> float:
    """Ca, for which the rise from the middle to the end is 1/2."""
    p, q = _BY_ANGLE * cosine, _BY_ANGLE * sine
    hold = constant + q
    rise = (p + hold) * even + hold * cosine + p**2 + constant * (hold - 0.5 * constant) + q * sine - q**2
    return 0.5 / rise


def _top(waves: _Waves) -> float:
    return waves.peak * (_BY_ANGLE * (waves.cosine + waves.sine) + waves.constant)


def _torque(waves: _Waves) -> float:
    """Largest |v a|, in the cosine's zone: Ca^2 (p cos y + C + q) sin y, stationary at 2 p cos^2 y + ... = p."""
    p, hold = _BY_ANGLE * waves.cosine, waves.constant + _BY_ANGLE * waves.sine
    cos = 2.0 * p / (hold + math.sqrt(hold**2 + 8.0 * p**2))
    return waves.peak**2 * (p * cos + hold) * math.sqrt(1.0 - cos**2)


def _breaks(waves: _Waves) -> tuple[float, ...]:
    """Borders of the zones inside the rise; the middle too, where the acceleration jumps there."""
    bend = waves.even + waves.cosine
    borders = {waves.even, bend, bend + waves.constant} - ({0.0} if waves.cosine > 0 else set())
    inside = {0.5 + side * border for border in borders for side in (-1, 1) if border < 0.5 - _ROUNDING}
    return tuple(sorted(inside))


FAMILY = LawFamily(law, {"b": 0.25, "c": 0.25, "d": 0.5})
