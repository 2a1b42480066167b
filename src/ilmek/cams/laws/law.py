"""What a motion law is: a rise of 1 in a time of 1, and its derivatives.

    S = L s(u),   V = L (w/beta) v(u),   A = L (w/beta)^2 a(u),   J = L (w/beta)^3 j(u),   u = theta/beta

L lift, beta cam angle of the rise, w cam speed. A fall is a rise of -L.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ilmek.arrays import RealField

Curve: TypeAlias = Callable[[RealField], RealField]


@dataclass(frozen=True, slots=True)
class Law:
    """A motion law from rest to rest on u in [0, 1].

    s, v, a, j          displacement and its first three derivatives by u
    velocity_peak       largest |v|
    acceleration_peak   largest |a|
    jerk_peak           largest |j|; inf where the acceleration jumps, at the ends (against a dwell) or inside
    breaks              u inside the rise where a or j is not smooth; a and j are one-sided there
    """

    name: str
    s: Curve
    v: Curve
    a: Curve
    j: Curve
    velocity_peak: float
    acceleration_peak: float
    jerk_peak: float
    breaks: tuple[float, ...] = ()


def _still(u: RealField) -> RealField:
    return 0.0 * np.asarray(u)


REST = Law("rest", _still, _still, _still, _still, 0.0, 0.0, 0.0)
"""No motion at all: the law of a dwell."""
