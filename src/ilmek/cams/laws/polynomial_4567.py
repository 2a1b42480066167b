"""The 4-5-6-7 polynomial: position, velocity, acceleration and jerk given at both ends.

    s = 35 u^4 - 84 u^5 + 70 u^6 - 20 u^7                                  [Norton, Cam Design and Manufacturing, 4]

The jerk joins a dwell without a jump, but the acceleration is a third larger than that of 3-4-5. With w = u (1 - u) the
derivatives are 140 w^3, 420 w^2 (1 - 2 u) and 840 w (1 - 5 w). Exact peaks: 35/16, 84 sqrt(5)/25, 105/2; printed
tables that give 7.526 for the second are rounded.
"""

import math

from ilmek.arrays import RealField
from ilmek.cams.laws.law import Law


def s(u: RealField) -> RealField:
    """Displacement s [1] at u [1] in [0, 1], from 0 to 1; any shape.

    >>> s(0.5)
    0.5
    """
    return u**4 * (35.0 - u * (84.0 - u * (70.0 - 20.0 * u)))


def v(u: RealField) -> RealField:
    """Velocity ds/du [1]."""
    return 140.0 * (u * (1.0 - u)) ** 3


def a(u: RealField) -> RealField:
    """Acceleration d2s/du2 [1]."""
    return 420.0 * (u * (1.0 - u)) ** 2 * (1.0 - 2.0 * u)


def j(u: RealField) -> RealField:
    """Jerk d3s/du3 [1]."""
    w = u * (1.0 - u)
    return 840.0 * w * (1.0 - 5.0 * w)


_TORQUE = 58800 / 1024 * (10 / 11) ** 5 / math.sqrt(11)

LAW = Law("4-5-6-7", s, v, a, j, 35 / 16, 84 * math.sqrt(5) / 25, 52.5, _TORQUE, math.sqrt(280 / 11))
