"""Forces between block magnets: two cuboids with parallel sides, both magnetised along z, evenly.

    F = B1 B2 / (4 pi mu0) sum (-1)^(i+j+k+l+p+q) phi(u, v, w),      i, j, k, l, p, q of 0 and 1,  r² = u² + v² + w²
    u = dx + (-1)^j A - (-1)^i a,   v = dy + (-1)^l B - (-1)^k b,   w = dz + (-1)^q C - (-1)^p c
    phi_x = (v² - w²)/2 ln(r - u) + u v ln(r - v) + v w atan(u v / (r w)) + r u / 2
    phi_z = -u w ln(r - u) - v w ln(r - v) + u v atan(u v / (r w)) - r w

a, b, c and A, B, C are half the sides of the first and the second magnet, (dx, dy, dz) leads from the centre of the
first to that of the second, F acts on the second. Each magnet is two sheets of charge at its ends along z.
[Akoun and Yonnet, 3D analytical calculation of the forces exerted between two cuboidal magnets, IEEE Transactions on
Magnetics 20(5), 1984, 1962-1964]
"""

import math
from itertools import product

import numpy as np

from ilmek.arrays import FloatArray, RealField

PERMEABILITY = 4e-7 * math.pi
"""Of the vacuum [N/A²]."""

REMANENCE = 1.28
"""Remanence of sintered neodymium magnets of grade N42, the least of the grade [T]; IEC 60404-8-1, makers' data."""

_SIGNS = np.array(list(product((1, -1), repeat=6)), dtype=float)
_TINY = 1e-30
"""Added under the logarithms [m]: on the line of an edge their factors vanish."""


def block_forces(
    first: tuple[float, float, float],
    second: tuple[float, float, float],
    offset: tuple[RealField, RealField, RealField],
    remanence: float = REMANENCE,
) -> tuple[FloatArray, FloatArray]:
    """Forces on the second magnet along x and z [N], of the shape of the offsets.

    first, second  sides of the magnets [m]      offset  of their centres [m], so that they do not overlap
    remanence      of both [T]
    Equal poles face each other, or differ, as the magnets are turned: with both along +z they attract along z.

    >>> _, pull = block_forces((0.01, 0.01, 0.01), (0.01, 0.01, 0.01), (0.0, 0.0, 0.2))
    >>> dipoles = -3 * (REMANENCE * 1e-6) ** 2 / (2 * math.pi * PERMEABILITY * 0.2**4)
    >>> round(float(pull) / dipoles, 2)
    1.0
    """
    i, j, k, n, p, q = _SIGNS.T
    along, across, apart = (np.asarray(one, dtype=float)[..., None] for one in offset)
    u = along + (j * second[0] - i * first[0]) / 2
    v = across + (n * second[1] - k * first[1]) / 2
    w = apart + (q * second[2] - p * first[2]) / 2
    r = np.sqrt(u**2 + v**2 + w**2)
    sign = i * j * k * n * p * q
    log_u, log_v = np.log(r - u + _TINY), np.log(r - v + _TINY)
    angle = np.arctan(u * v / (r * w))
    shear = (v**2 - w**2) / 2 * log_u + u * v * log_v + v * w * angle + r * u / 2
    pull = -u * w * log_u - v * w * log_v + u * v * angle - r * w
    share = remanence**2 / (4 * math.pi * PERMEABILITY)
    return share * np.sum(sign * shear, axis=-1), share * np.sum(sign * pull, axis=-1)
