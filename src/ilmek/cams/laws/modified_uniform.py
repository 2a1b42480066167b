"""Modified uniform motion: constant velocity between two parabolas that take the shares b1 and b2 of the time.

    v = V u / b1  (u <= b1),   V,   V (1 - u) / b2  (u >= 1 - b2),     V = 1 / (1 - (b1 + b2)/2)     [thesis, 2.2.2]

The velocity is constant where the work requires it. The acceleration is finite, but it jumps at the ends. With
b1 = b2 = 1/2 it is the parabolic law; as both go to 0 it becomes the uniform law. The velocity falls short of V by
V p / b1 and V q / b2, p = max(b1 - u, 0) and q = max(u - 1 + b2, 0), so one formula serves all three parts.
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import RealField
from ilmek.cams.laws.law import Law, LawFamily
from ilmek.errors import ParameterError

_ROUNDING = 1e-12


@dataclass(frozen=True, slots=True)
class _Blends:
    b1: float
    b2: float
    top: float

    def _short(self, u: RealField) -> tuple[RealField, RealField]:
        """Depth of u inside the first and the last parabola."""
        return np.maximum(self.b1 - u, 0.0), np.maximum(u - (1.0 - self.b2), 0.0)

    def s(self, u: RealField) -> RealField:
        """Displacement."""
        p, q = self._short(u)
        return self.top * (u - 0.5 * self.b1 + 0.5 * p**2 / self.b1 - 0.5 * q**2 / self.b2)

    def v(self, u: RealField) -> RealField:
        """Velocity."""
        p, q = self._short(u)
        return self.top * (1.0 - p / self.b1 - q / self.b2)

    def a(self, u: RealField) -> RealField:
        """Acceleration."""
        p, q = self._short(u)
        return self.top * (np.sign(p) / self.b1 - np.sign(q) / self.b2)

    def j(self, u: RealField) -> RealField:
        """Jerk: 0 between the jumps."""
        return 0.0 * np.asarray(u)


def law(b1: float, b2: float) -> Law:
    """The modified uniform law; b1, b2: shares [-] of the time for the first and the last parabola.

    Raises ParameterError unless both shares are above 0 and their sum is at most 1.

    >>> round(law(0.25, 0.25).velocity_peak, 6)
    1.333333
    """
    if not (b1 > 0 and b2 > 0 and b1 + b2 <= 1 + _ROUNDING):
        raise ParameterError(f"modified-uniform with b1={b1:g}, b2={b2:g}", allowed="above 0, together at most 1")
    top, least = 1 / (1 - 0.5 * (b1 + b2)), min(b1, b2)
    curves = _Blends(b1, b2, top)
    peaks = top, top / least, math.inf, top**2 / least, top * math.sqrt(1 / b1 + 1 / b2)
    breaks = (b1,) if 1 - b1 - b2 < _ROUNDING else (b1, 1 - b2)
    given = {"b1": b1, "b2": b2}
    return Law("modified-uniform", curves.s, curves.v, curves.a, curves.j, *peaks, breaks, given)


FAMILY = LawFamily(law, {"b1": 0.25, "b2": 0.25})
