"""Cubic motion (2-3 polynomial): the lowest polynomial from rest to rest.

    s = 3 u^2 - 2 u^3                                                      [Norton, Cam Design and Manufacturing, 4]

It has the least rms acceleration of all laws from rest to rest, so a motor that moves an inertia heats least. Next to a
dwell the acceleration jumps from 0 to 6.
"""

import math

import numpy as np

from ilmek.arrays import RealField
from ilmek.cams.laws.law import Law


def s(u: RealField) -> RealField:
    """Displacement s [1] at u [1] in [0, 1], from 0 to 1; any shape.

    >>> s(0.5)
    0.5
    """
    return u**2 * (3.0 - 2.0 * u)


def v(u: RealField) -> RealField:
    """Velocity ds/du [1]."""
    return 6.0 * u * (1.0 - u)


def a(u: RealField) -> RealField:
    """Acceleration d2s/du2 [1]."""
    return 6.0 * (1.0 - 2.0 * u)


def j(u: RealField) -> RealField:
    """Jerk d3s/du3 [1] inside the rise."""
    return -12.0 + 0.0 * np.asarray(u)


LAW = Law("cubic", s, v, a, j, 1.5, 6.0, math.inf, 2 * math.sqrt(3), 2 * math.sqrt(3))
