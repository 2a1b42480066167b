"""Uniform motion: constant velocity from start to end.

    s = u                                                                          [thesis, 2.2.2; VDI 2143, type G-G]

It has the least peak velocity of all laws. Next to a dwell the velocity jumps, which no follower with a mass can
follow. Between two parts of the same speed it is the law of a constant-speed part.
"""

import math

import numpy as np

from ilmek.arrays import RealField
from ilmek.cams.laws.law import Law


def s(u: RealField) -> RealField:
    """Displacement s [1] at u [1] in [0, 1], from 0 to 1; any shape.

    >>> float(s(0.25))
    0.25
    """
    return 1.0 * np.asarray(u)


def v(u: RealField) -> RealField:
    """Velocity ds/du [1]: 1, at the ends too."""
    return 1.0 + 0.0 * np.asarray(u)


def a(u: RealField) -> RealField:
    """Acceleration d2s/du2 [1]: 0 between the jumps of the velocity."""
    return 0.0 * np.asarray(u)


def j(u: RealField) -> RealField:
    """Jerk d3s/du3 [1]: 0 between the jumps of the velocity."""
    return 0.0 * np.asarray(u)


LAW = Law("uniform", s, v, a, j, 1.0, math.inf, math.inf, math.inf, math.inf)
