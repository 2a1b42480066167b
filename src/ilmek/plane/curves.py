"""Plane curves: curvature [do Carmo, Differential Geometry of Curves and Surfaces, 1-5], crossings, convex hull."""

import numpy as np

from ilmek.arrays import Complex, ComplexField, Int, RealField
from ilmek.plane.vectors import cross


def curvature(first: ComplexField, second: ComplexField) -> RealField:
    """Curvature [1/m] of z(u) from z' and z'': z' x z'' / |z'|^3, above 0 to the left; NaN where z' = 0.

    first, second  z' and z'' by the same parameter u [m/u, m/u²], any shapes that broadcast

    >>> float(curvature(2j, -2 + 0j))
    0.5
    """
    bend: RealField = cross(first, second) / np.abs(first) ** 3
    return bend


def crossing_segments(points: Complex[np.ndarray, " points"], closed: bool) -> Int[np.ndarray, "pairs 2"]:
    """Pairs of segments of a polyline that cross, (pairs, 2), without neighbours; segment k is from point k to k + 1.

    closed  the last point equals the first
    Two segments cross where each has the other's ends on different sides.

    >>> crossing_segments(np.array([0, 2 + 2j, 2 + 0j, 0 + 2j]), closed=False).tolist()
    [[0, 2]]
    """
    start, chord = points[:-1], np.diff(points)
    count = len(chord)
    pairs = []
    for rows in np.array_split(np.arange(count), max(1, count // 256)):
        base = start[rows, None]
        before = cross(chord[rows, None], start[None, :] - base)
        after = cross(chord[rows, None], points[None, 1:] - base)
        own = cross(chord[None, :], base - start[None, :])
        other = cross(chord[None, :], points[rows + 1, None] - start[None, :])
        separation = np.arange(count)[None, :] - rows[:, None]
        far = (separation > 1) & ~((separation == count - 1) & closed)
        found = np.argwhere((before * after < 0) & (own * other < 0) & far)
        found[:, 0] += rows[0]
        pairs.append(found)
    return np.concatenate(pairs)


def hull(points: Complex[np.ndarray, " points"]) -> Complex[np.ndarray, " corners"]:
    """Corners [m] of the convex hull, counter-clockwise from the leftmost; two for collinear, one for equal points.

    [`hull_indices`]

    >>> hull(np.array([0, 1, 1 + 1j, 1j, 0.5 + 0.5j]))
    array([0.+0.j, 1.+0.j, 1.+1.j, 0.+1.j])
    """
    distinct = np.array(list(dict.fromkeys(points.tolist())), dtype=complex)
    return distinct[hull_indices(distinct)] if len(distinct) > 1 else distinct


def hull_indices(points: Complex[np.ndarray, " points"]) -> Int[np.ndarray, " corners"]:
    """Indices of the points on the convex hull, counter-clockwise from the leftmost.      [Andrew's monotone chain]

    points  two or more; of collinear points only the two ends are on the hull

    >>> hull_indices(np.array([0j, 1 + 0j, 0.5 + 0.1j, 1j])).tolist()
    [0, 1, 3]
    """
    order = np.lexsort((points.imag, points.real)).tolist()
    plane = points.tolist()
    return np.array(_chain(plane, order)[:-1] + _chain(plane, order[::-1])[:-1])


def _chain(plane: list[complex], order: list[int]) -> list[int]:
    """The lower chain of the hull of points in this order."""
    chain: list[int] = []
    for index in order:
        while len(chain) > 1 and cross(plane[chain[-1]] - plane[chain[-2]], plane[index] - plane[chain[-2]]) <= 0:
            chain.pop()
        chain.append(index)
    return chain
