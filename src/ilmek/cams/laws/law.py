"""What a motion law is: a rise of 1 in a time of 1, and its derivatives.

    S = L s(u),   V = L (w/beta) v(u),   A = L (w/beta)^2 a(u),   J = L (w/beta)^3 j(u),   u = theta/beta

L lift, beta cam angle of the rise, w cam speed. A fall is a rise of -L.
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
"""What a law is made with, by name: numbers and rows of numbers."""

NONE: Parameters = MappingProxyType({})
"""Of a law without parameters."""


class LawValues(NamedTuple):
    """A law and its derivatives at the same places."""

    s: RealField
    v: RealField
    a: RealField
    j: RealField


@record
class Law:
    """A motion law on u in [0, 1]: from rest at 0 to rest at 1, unless its file says otherwise.

    s, v, a, j          displacement and its first three derivatives by u, arrays of any shape
    velocity_peak       largest |v|
    acceleration_peak   largest |a|; inf where the velocity jumps against a dwell
    jerk_peak           largest |j|; inf where the acceleration jumps, at the ends (against a dwell) or inside
    torque_peak         largest |v a|: the inertia's part of the cam torque
    acceleration_rms    root of the mean square of a: heating of a motor that moves an inertia
    breaks              u inside the rise where a or j is not smooth; a and j are one-sided there
    parameters          what the law was made with; `law_of(name, parameters)` makes it again
    lowest, highest     bounds of s: a law that overshoots leaves [0, 1]
    first, last         s at u = 0 and u = 1
    at_once             all four curves by one call, where that is quicker
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
        """s, v, a and j at u of any shape."""
        if self.at_once is not None:
            return self.at_once(u)
        return LawValues(self.s(u), self.v(u), self.a(u), self.j(u))


class LawFamily(NamedTuple):
    """A law that takes parameters: how it is made, and what it is made with where nothing is said."""

    make: Callable[..., Law]
    defaults: Parameters = NONE


def fixed(law: Law) -> LawFamily:
    """A law without parameters, as a family of one."""
    return LawFamily(lambda: law)


def _still(u: RealField) -> RealField:
    return 0.0 * np.asarray(u)


REST = Law("rest", _still, _still, _still, _still, 0.0, 0.0, 0.0, 0.0, 0.0)
"""No motion at all: the law of a dwell."""
