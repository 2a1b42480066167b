"""The SCCA family (sine, constant, cosine acceleration): one formula for most laws that cams are cut to.

The acceleration climbs along a quarter sine wave, stays, and falls along a quarter cosine wave to the middle; the way
down mirrors it. The waves together take the shares b (sine), c (constant), d (cosine) of the time; what b + c + d
leaves over is run at constant velocity about the middle.                [Norton, Cam Design and Manufacturing, 3]

    parabolic (0, 1, 0)              harmonic (0, 0, 1)             cycloidal (1/2, 0, 1/2)
    modified trapezoid (1/4, 1/2, 1/4)                              modified sine (1/4, 0, 3/4)

With b + c + d = 1 the peak is Ca = 4 pi^2 / ((pi^2 - 8)(b^2 - d^2) - 2 pi (pi - 2) b + pi^2).

Counted from the middle, h = |u - 1/2| runs through the lengths E (even), D = d/2, C = c/2 and B = b/2; x1..x4 are its
parts within each. With p = 2D/pi and q = 2B/pi one formula serves all zones:

    |a| = Ca sin(x2/p) cos(x4/q)
     v  = Ca (p sin((D - x2)/p) + C - x3 + q (1 - cos((B - x4)/q)))
    |s - 1/2| = Ca ((p + C + q) x1 + (C + q) x2 + p^2 sin(x2/p) + x3 (C + q - x3/2) + q x4 - q^2 (1 - cos(x4/q)))
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import RealField
from ilmek.cams.laws.law import Family, Law, Parameters
from ilmek.errors import ParameterError

_ROUNDING = 1e-12


@dataclass(frozen=True, slots=True)
class _Waves:
    """The lengths E, D, C, B from the middle to the end, and the peak Ca."""

    even: float
    cosine: float
    constant: float
    sine: float
    peak: float

    def _parts(self, u: RealField) -> tuple[RealField, RealField, RealField, RealField]:
        """Parts of |u - 1/2| within the four zones."""
        h = np.abs(u - 0.5)
        bend = h - self.even
        hold = bend - self.cosine
        return np.minimum(h, self.even), _within(bend, self.cosine), _within(hold, self.constant), _ramp(hold, self)

    def s(self, u: RealField) -> RealField:
        """Displacement."""
        x1, x2, x3, x4 = self._parts(u)
        p, q = _TO_ANGLE * self.cosine, _TO_ANGLE * self.sine
        hold = self.constant + q
        way = (p + hold) * x1 + hold * x2 + x3 * (hold - 0.5 * x3) + q * x4
        if p > 0:
            way = way + p**2 * np.sin(x2 / p)
        if q > 0:
            way = way - 2.0 * q**2 * np.sin(0.5 * x4 / q) ** 2
        return 0.5 + np.sign(u - 0.5) * self.peak * way

    def v(self, u: RealField) -> RealField:
        """Velocity."""
        _, x2, x3, x4 = self._parts(u)
        p, q = _TO_ANGLE * self.cosine, _TO_ANGLE * self.sine
        rate = self.constant - x3
        if p > 0:
            rate = rate + p * np.sin((self.cosine - x2) / p)
        if q > 0:
            rate = rate + 2.0 * q * np.sin(0.5 * (self.sine - x4) / q) ** 2
        return self.peak * rate

    def a(self, u: RealField) -> RealField:
        """Acceleration."""
        _, x2, _, x4 = self._parts(u)
        p, q = _TO_ANGLE * self.cosine, _TO_ANGLE * self.sine
        size = np.sin(x2 / p) if p > 0 else self._beyond_even(u)
        if q > 0:
            size = size * np.cos(x4 / q)
        return -self.peak * np.sign(u - 0.5) * size

    def j(self, u: RealField) -> RealField:
        """Jerk."""
        _, x2, _, x4 = self._parts(u)
        p, q = _TO_ANGLE * self.cosine, _TO_ANGLE * self.sine
        size = 0.0 * np.asarray(u)
        if p > 0:
            size = size - np.cos(x2 / p) * (self._beyond_even(u) if self.even > 0 else 1.0) / p
        if q > 0:
            size = size + np.sin(x4 / q) / q
        return self.peak * size

    def _beyond_even(self, u: RealField) -> RealField:
        """1 where the velocity changes, 0 where it does not."""
        return np.maximum(np.sign(np.abs(u - 0.5) - self.even), 0.0)


_TO_ANGLE = 2.0 / math.pi


def _within(x: RealField, length: float) -> RealField:
    return np.minimum(np.maximum(x, 0.0), length)


def _ramp(hold: RealField, waves: _Waves) -> RealField:
    """The last zone has no upper bound: u ends with it."""
    return np.maximum(hold - waves.constant, 0.0)


def family(name: str, b: float, c: float, d: float, parameters: Parameters) -> Law:
    """The member of the family with the shares b, c, d, under a name of its own.

    Raises ParameterError unless they are at least 0, together above 0 and at most 1.
    """
    if not (min(b, c, d) >= 0 and 0 < b + c + d <= 1 + _ROUNDING):
        raise ParameterError(
            f"{name} with b={b:g}, c={c:g}, d={d:g}", allowed="none below 0, together above 0 and at most 1"
        )
    even = max(0.5 * (1.0 - b - c - d), 0.0)
    even = even if even > _ROUNDING else 0.0
    peak = _peak(even, 0.5 * d, 0.5 * c, 0.5 * b)
    waves = _Waves(even, 0.5 * d, 0.5 * c, 0.5 * b, peak)
    least = min(b, d)
    jerk = math.pi * peak / least if least > 0 else math.inf
    peaks = _top(waves), peak, jerk, _torque(waves), peak * math.sqrt(0.5 * b + c + 0.5 * d)
    return Law(name, waves.s, waves.v, waves.a, waves.j, *peaks, _breaks(waves), parameters)


def law(b: float, c: float, d: float) -> Law:
    """The law with the shares b, c, d of sine, constant and cosine; the rest of the time runs evenly.

    >>> round(law(0.25, 0.5, 0.25).acceleration_peak, 6)
    4.888124
    """
    return family("scca", b, c, d, {"b": b, "c": c, "d": d})


def _peak(even: float, cosine: float, constant: float, sine: float) -> float:
    """Ca: what makes the way from the middle to the end 1/2."""
    p, q = _TO_ANGLE * cosine, _TO_ANGLE * sine
    hold = constant + q
    way = (p + hold) * even + hold * cosine + p**2 + constant * (hold - 0.5 * constant) + q * sine - q**2
    return 0.5 / way


def _top(waves: _Waves) -> float:
    return waves.peak * (_TO_ANGLE * (waves.cosine + waves.sine) + waves.constant)


def _torque(waves: _Waves) -> float:
    """Largest |v a|, in the cosine's zone: Ca^2 (p cos y + C + q) sin y, stationary at 2 p cos^2 y + ... = p."""
    p, hold = _TO_ANGLE * waves.cosine, waves.constant + _TO_ANGLE * waves.sine
    cos = 2.0 * p / (hold + math.sqrt(hold**2 + 8.0 * p**2))
    return waves.peak**2 * (p * cos + hold) * math.sqrt(1.0 - cos**2)


def _breaks(waves: _Waves) -> tuple[float, ...]:
    """Borders of the zones inside the rise; the middle too, where the acceleration jumps there."""
    bend = waves.even + waves.cosine
    borders = {waves.even, bend, bend + waves.constant} - ({0.0} if waves.cosine > 0 else set())
    inside = {0.5 + side * border for border in borders for side in (-1, 1) if border < 0.5 - _ROUNDING}
    return tuple(sorted(inside))


FAMILY = Family(law, {"b": 0.25, "c": 0.25, "d": 0.5})
