"""Smallest circle that encloses points [Welzl, Smallest enclosing disks, LNCS 555 (1991); move-to-front form]."""

import numpy as np

from ilmek.arrays import ComplexArray

ROUNDING = 1e-12
"""Distance outside the circle, relative to its radius, that counts as on it."""


def enclosing_circle(points: ComplexArray) -> tuple[complex, float]:
    """Centre and radius of the smallest circle around points, shape (points,); one at least. Exact to rounding.

    >>> centre, radius = enclosing_circle(np.array([0j, 2 + 0j, 1 + 0.5j]))
    >>> centre, radius
    ((1+0j), 1.0)
    """
    order = [complex(point) for point in np.random.default_rng(0).permutation(np.unique(points))]
    circle = (order[0], 0.0)
    for i, first in enumerate(order):
        if _outside(circle, first):
            circle = (first, 0.0)
            for j, second in enumerate(order[:i]):
                if _outside(circle, second):
                    circle = ((first + second) / 2, abs(first - second) / 2)
                    for third in order[:j]:
                        if _outside(circle, third):
                            circle = _through(first, second, third)
    return circle


def _outside(circle: tuple[complex, float], point: complex) -> bool:
    return abs(point - circle[0]) > circle[1] * (1 + ROUNDING)


def _through(a: complex, b: complex, c: complex) -> tuple[complex, float]:
    """The circle through three points that are not in line."""
    u, v = b - a, c - a
    centre = (abs(u) ** 2 * v - abs(v) ** 2 * u) / (u.conjugate() * v - u * v.conjugate())
    return a + centre, abs(centre)
