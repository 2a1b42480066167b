"""A motion law: a rise of 1 in a time of 1, and its derivatives.

    S = L s(u),   V = L (w/beta) v(u),   A = L (w/beta)^2 a(u),   J = L (w/beta)^3 j(u),   u = theta/beta

L lift [m; rad], beta cam angle of the rise [rad], w cam speed [rad/s]; u, s, v, a and j have no unit. A fall is a rise
of -L.                                                                          [chain rule; normalised as in VDI 2143]
"""

from collections.abc import Callable, Mapping
from dataclasses import field
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

import numpy as np

from ilmek.arrays import RealField
from ilmek.records import record

Curve: TypeAlias = Callable[[RealField], RealField]


Parameters: TypeAlias = Mapping[str, float | tuple[float, ...]]
"""Parameters of a law by name: numbers and rows of numbers."""

NONE: Parameters = MappingProxyType({})
"""The parameters of a law that has none."""


class LawValues(NamedTuple):
    """Displacement and its first three derivatives at the same u, arrays of one shape."""

    s: RealField
    v: RealField
    a: RealField
    j: RealField


@record
class Law:
    """A motion law on u in [0, 1]: from rest at 0 to rest at 1, unless its module states otherwise.

    s, v, a, j          displacement and its first three derivatives by u, arrays of any shape
    velocity_peak       largest |v|
    acceleration_peak   largest |a|; inf where the velocity jumps against a dwell
    jerk_peak           largest |j|; inf where the acceleration jumps, at the ends (against a dwell) or inside
    torque_peak         largest |v a|: the share of the inertia in the cam torque
    acceleration_rms    root mean square of a: it sets the heat in a motor that moves an inertia
    breaks              u inside the rise where a or j is not smooth; a and j are one-sided there
    parameters          the law's parameters; `law_of(name, parameters)` builds it again
    lowest, highest     bounds of s: a law that overshoots leaves [0, 1]
    first, last         s at u = 0 and u = 1
    at_once             all four curves in one call, where that is faster
    """

    name: str
    s: Curve
    v: Curve
    a: Curve
    j: Curve
    velocity_peak: float
    acceleration_peak: float
    jerk_peak: float
    torque_peak: float
    acceleration_rms: float
    breaks: tuple[float, ...] = ()
    parameters: Parameters = field(default_factory=dict, hash=False)
    lowest: float = 0.0
    highest: float = 1.0
    first: float = 0.0
    last: float = 1.0
    at_once: Callable[[RealField], LawValues] | None = None

    def motion(self, u: RealField) -> LawValues:
        """s, v, a and j at u in [0, 1], an array of any shape."""
        if self.at_once is not None:
            return self.at_once(u)
        return LawValues(self.s(u), self.v(u), self.a(u), self.j(u))


class LawFamily(NamedTuple):
    """A law with parameters: the function that builds it, and the default parameters."""

    make: Callable[..., Law]
    defaults: Parameters = NONE


def fixed(law: Law) -> LawFamily:
    """The family of a law that has no parameters."""
    return LawFamily(lambda: law)


def _still(u: RealField) -> RealField:
    return 0.0 * np.asarray(u)


REST = Law("rest", _still, _still, _still, _still, 0.0, 0.0, 0.0, 0.0, 0.0)
"""The law of a dwell: no motion."""
