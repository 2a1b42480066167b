"""Margins of points and links against regions of the plane: boxes and polygons; compiled kernels."""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.num.compiled import compiled
from ilmek.plane import vectors

NONE = 1.0
"""Margin of a limit that is not given."""

cross = compiled(vectors.cross)


@compiled
def box_margin(point: complex, box: FloatArray) -> float:
    """Distance of a point inside a box from its nearest side, negative outside."""
    return float(min(point.real - box[0], box[1] - point.real, point.imag - box[2], box[3] - point.imag))


@compiled
def polygon_margin(point: complex, corners: ComplexArray) -> float:
    """Distance of a point inside a polygon from its nearest side, negative outside; `NONE` for an empty polygon."""
    count = len(corners)
    if count == 0:
        return NONE
    inside, nearest = False, np.inf
    for at in range(count):
        one, other = corners[at], corners[(at + 1) % count]
        nearest = min(nearest, segment_square(point, one, other))
        if (one.imag > point.imag) != (other.imag > point.imag):
            along = (point.imag - one.imag) / (other.imag - one.imag)
            if point.real < one.real + along * (other.real - one.real):
                inside = not inside
    return float(np.sqrt(nearest) if inside else -np.sqrt(nearest))


@compiled
def segment_square(point: complex, one: complex, other: complex) -> float:
    """Squared distance of a point from a segment."""
    x, y = other.real - one.real, other.imag - one.imag
    u, v = point.real - one.real, point.imag - one.imag
    square, along = x * x + y * y, u * x + v * y
    if along > 0:
        share = min(along, square) / square
        u, v = u - share * x, v - share * y
    return u * u + v * v


@compiled
def region_margin(point: complex, box: FloatArray, corners: ComplexArray) -> float:
    """Least margin of a point in a box and a polygon."""
    return min(box_margin(point, box), polygon_margin(point, corners), NONE)


@compiled
def circle_about(corners: ComplexArray) -> tuple[complex, float]:
    """Middle and radius of a circle about a polygon."""
    middle, radius = 0j, 0.0
    for corner in corners:
        middle += corner / len(corners)
    for corner in corners:
        radius = max(radius, abs(corner - middle))
    return middle, radius


@compiled
def clearance(one: complex, other: complex, corners: ComplexArray, circle: tuple[complex, float]) -> float:
    """Distance of a segment from a polygon; where they touch, minus the depth at which it is found in the polygon.

    circle  about the polygon: outside it the result is the distance from the circle, which is less
    """
    count = len(corners)
    around = segment_square(circle[0], one, other)
    if around > circle[1] * circle[1]:
        return float(np.sqrt(around)) - circle[1]
    nearest, touches = np.inf, False
    for at in range(count):
        first, last = corners[at], corners[(at + 1) % count]
        sides = float(cross(other - one, first - one) * cross(other - one, last - one))
        ends = float(cross(last - first, one - first) * cross(last - first, other - first))
        touches = touches or (sides <= 0 and ends < 0) or (sides < 0 and ends <= 0)
        near = min(segment_square(one, first, last), segment_square(other, first, last))
        nearest = min(nearest, near, segment_square(first, one, other))
    deep = polygon_margin(one, corners)
    if not touches and deep < 0:
        return float(np.sqrt(nearest))
    for step in range(1, 9):
        deep = max(deep, polygon_margin(one + 0.125 * step * (other - one), corners))
    return -max(deep, 0.0) - 1e-6


@compiled
def swept_clearance(
    pivots: ComplexArray, a: ComplexArray, b: ComplexArray, p: ComplexArray, keep: ComplexArray
) -> float:
    """Least distance of crank, rocker and coupler from a polygon over the positions of A, B and P; negative inside."""
    clear, circle = np.inf, circle_about(keep)
    for at in range(len(a)):
        for one, other in ((pivots[0], a[at]), (pivots[1], b[at]), (a[at], b[at]), (a[at], p[at]), (b[at], p[at])):
            clear = min(clear, clearance(one, other, keep, circle))
    return clear
