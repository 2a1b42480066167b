"""Parabolic motion: constant acceleration to the middle, constant deceleration to the end.

    s = 2 u^2  (u <= 1/2),   s = 1 - 2 (1 - u)^2  (u >= 1/2)                              [thesis, 2.2.2, Fig. 2.7]

It has the least peak acceleration of all laws from rest to rest. The acceleration jumps at both ends and in the middle.
With d = u - 1/2, one formula serves both halves: s = 1/2 + 2 d (1 - |d|).
"""

import math

import numpy as np

from ilmek.arrays import RealField
from ilmek.cams.laws.law import Law


def s(u: RealField) -> RealField:
    """Displacement s [1] at u [1] in [0, 1], from 0 to 1; any shape.

    >>> float(s(0.25)), float(s(0.75))
    (0.125, 0.875)
    """
    d = u - 0.5
    return 0.5 + 2.0 * d * (1.0 - np.abs(d))


def v(u: RealField) -> RealField:
    """Velocity ds/du [1]."""
    return 2.0 - 4.0 * np.abs(u - 0.5)


def a(u: RealField) -> RealField:
    """Acceleration d2s/du2 [1]: +4, then -4; at u = 1/2 their mean, 0."""
    return -4.0 * np.sign(u - 0.5)


def j(u: RealField) -> RealField:
    """Jerk d3s/du3 [1]: 0 between the jumps."""
    return 0.0 * np.asarray(u)


LAW = Law("parabolic", s, v, a, j, 2.0, 4.0, math.inf, 8.0, 4.0, breaks=(0.5,))
