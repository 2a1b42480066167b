"""Cycloidal motion (inclined sine): the path of a point on a circle of radius L/2pi that rolls along a line.

    s = u - sin(2 pi u) / (2 pi)                                                      [thesis, 2.2.2, eq. 2.52-2.56]

The acceleration starts and ends at 0, so the law joins a dwell without a jump. The jerk is finite (4 pi^2), although
the thesis calls the law "jerk-free". Eq. 2.55 and 2.56 print the bracket with the trigonometric function under the
fraction bar; it belongs above it.
"""

import math

import numpy as np

from ilmek.arrays import RealField
from ilmek.cams.laws.law import Law, LawValues

_TURN = 2.0 * math.pi


def s(u: RealField) -> RealField:
    """Displacement s [1] at u [1] in [0, 1], from 0 to 1; any shape.

    >>> float(s(0.5))
    0.5
    """
    return u - np.sin(_TURN * u) / _TURN


def v(u: RealField) -> RealField:
    """Velocity ds/du [1]."""
    return 2.0 * np.sin(0.5 * _TURN * u) ** 2


def a(u: RealField) -> RealField:
    """Acceleration d2s/du2 [1]."""
    return _TURN * np.sin(_TURN * u)


def j(u: RealField) -> RealField:
    """Jerk d3s/du3 [1]."""
    return _TURN**2 * np.cos(_TURN * u)


def motion(u: RealField) -> LawValues:
    """s, v, a and j [1] at u, from one sine and one cosine."""
    turned = _TURN * u
    sin, cos = np.sin(turned), np.cos(turned)
    return LawValues(u - sin / _TURN, 1.0 - cos, _TURN * sin, _TURN**2 * cos)


LAW = Law(
    "cycloidal", s, v, a, j, 2.0, _TURN, _TURN**2, 1.5 * math.sqrt(3) * math.pi, _TURN / math.sqrt(2), at_once=motion
)
