"""Uniform motion: constant velocity from the first moment to the last.

    s = u                                                                          [thesis, 2.2.2; VDI 2143, type G-G]

The least velocity a rise can have. Against a dwell the velocity jumps, so no follower of any mass can do it; between
two parts of the same speed it is the law of a constant-speed part.
"""

import math

import numpy as np

from ilmek.arrays import RealField
from ilmek.cams.laws.law import Law


def s(u: RealField) -> RealField:
    """Displacement over u in [0, 1], from 0 to 1.

    >>> float(s(0.25))
    0.25
    """
    return 1.0 * np.asarray(u)


def v(u: RealField) -> RealField:
    """Velocity ds/du: 1 throughout, the ends among it."""
    return 1.0 + 0.0 * np.asarray(u)


def a(u: RealField) -> RealField:
    """Acceleration d2s/du2: nothing between the jumps of the velocity."""
    return 0.0 * np.asarray(u)


def j(u: RealField) -> RealField:
    """Jerk d3s/du3: nothing between the jumps of the velocity."""
    return 0.0 * np.asarray(u)


LAW = Law("uniform", s, v, a, j, 1.0, math.inf, math.inf, math.inf, math.inf)
