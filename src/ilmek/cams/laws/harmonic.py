"""Simple harmonic motion: the projection of a point that moves uniformly on a circle of diameter L.

    s = (1 - cos pi u) / 2                                                            [thesis, 2.2.2, eq. 2.47-2.51]

It starts smoothly and its velocity is low, but next to a dwell the acceleration jumps from 0 to pi^2/2. Eq. 2.47
prints cos theta for cos(pi theta/beta); eq. 2.49 prints L/[2(1 - cos)] for (L/2)(1 - cos).
"""

import math

import numpy as np

from ilmek.arrays import RealField
from ilmek.cams.laws.law import Law, LawValues


def s(u: RealField) -> RealField:
    """Displacement s [1] at u [1] in [0, 1], from 0 to 1; any shape.

    >>> float(s(1.0))
    1.0
    """
    return np.sin(0.5 * math.pi * u) ** 2


def v(u: RealField) -> RealField:
    """Velocity ds/du [1]."""
    return 0.5 * math.pi * np.sin(math.pi * u)


def a(u: RealField) -> RealField:
    """Acceleration d2s/du2 [1]."""
    return 0.5 * math.pi**2 * np.cos(math.pi * u)


def j(u: RealField) -> RealField:
    """Jerk d3s/du3 [1] inside the rise."""
    return -0.5 * math.pi**3 * np.sin(math.pi * u)


def motion(u: RealField) -> LawValues:
    """s, v, a and j [1] at u, from one sine and one cosine."""
    turned = math.pi * u
    sin, cos = np.sin(turned), np.cos(turned)
    return LawValues(0.5 - 0.5 * cos, 0.5 * math.pi * sin, 0.5 * math.pi**2 * cos, -0.5 * math.pi**3 * sin)


_LARGEST = math.pi**2 / 2

LAW = Law(
    "harmonic", s, v, a, j, math.pi / 2, _LARGEST, math.inf, math.pi**3 / 8, _LARGEST / math.sqrt(2), at_once=motion
)
