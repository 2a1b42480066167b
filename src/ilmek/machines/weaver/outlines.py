"""Outlines and shapes that the head's parts share."""

import math

import numpy as np

from ilmek.part.profile import Profile
from ilmek.part.shapes import Turned, stepped
from ilmek.plane.contours import polygon
from ilmek.report import Contour


def hull_of_circles(first: float, other: float, apart: complex) -> Contour:
    """The hull of a circle about the origin and of one at a place, by their radii [m], as a polygon on both.

    >>> from ilmek.plane.contours import bounds
    >>> round(bounds(hull_of_circles(2.0, 1.0, 5 + 0j))[1].real, 6)
    6.0
    """
    length = abs(apart)
    lean = math.asin(min(max((first - other) / length, -1.0), 1.0))
    wide = math.pi / 2 - lean
    number = 2 * math.ceil(48 * wide / math.pi) + 1, 2 * math.ceil(48 * (1 - wide / math.pi)) + 1
    end, root = np.linspace(-wide, wide, number[0]), np.linspace(wide, 2 * math.pi - wide, number[1])
    return polygon(apart / length * np.concatenate([length + other * np.exp(1j * end), first * np.exp(1j * root)]))


def bored(bore: float, *steps: tuple[float, float]) -> Turned:
    """Turned steps from z = 0, diameter and length of each, with a bore through all [m].

    >>> round(bored(6.0, (8.0, 1.0), (12.0, 2.0)).moments.zeroth / math.pi, 6)
    61.0
    """
    points = stepped(*steps).profile.outline.points
    return Turned(Profile(polygon(np.where(points.imag > 0, points, points + 0.5j * bore))))
