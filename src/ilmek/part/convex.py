"""Convex bodies that contain a shape, for distances: of polygons, of prisms over them, of turned profiles."""

import itertools
import math
from typing import TypeAlias

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Float
from ilmek.plane.triangulation import triangles
from ilmek.report import Contour

Points: TypeAlias = Float[np.ndarray, "points 3"]

_WIDEST = math.pi / 3
"""Greatest angle of an arc between two tangents of the polygon about it [rad]."""

_FEWEST = 8
"""Corners of the coarsest ring."""


def circumscribed(contour: Contour, deviation: float) -> ComplexArray:
    """Corners of a polygon that contains all within a counter-clockwise contour, and exceeds it by a deviation [m].

    About an arc that turns left, tangents: they meet R (1 / cos(half) - 1) outside of it, `half` the half of the angle
    between two that follow one another. Of an arc that turns right, chords, R (1 - cos(half)) outside.
    """
    corners: list[complex] = []
    following = np.roll(contour.points, -1)
    for start, end, bulge in zip(contour.points.tolist(), following.tolist(), contour.bulges.tolist(), strict=True):
        corners.append(start)
        if bulge == 0 or start == end:
            continue
        sweep = 4 * math.atan(abs(bulge))
        radius = abs(end - start) * (1 + bulge**2) / (4 * abs(bulge))
        number = max(math.ceil(sweep / (2 * math.acos(1 / (1 + deviation / radius)))), math.ceil(sweep / _WIDEST))
        arm = (end - start) / (np.exp(4j * math.atan(bulge)) - 1)  # from the centre to the start
        step = math.copysign(sweep / number, bulge)
        if bulge > 0:
            outside = arm / math.cos(step / 2) * np.exp(1j * step * (np.arange(number) + 0.5))
        else:
            outside = arm * np.exp(1j * step * np.arange(1, number))
        corners += (start - arm + outside).tolist()
    return np.array(corners)


def convex_pieces(corners: Complex[np.ndarray, " corners"]) -> tuple[ComplexArray, ...]:
    """Convex polygons that together are a counter-clockwise polygon [m].

    Its triangles, two joined along a common edge as long as the whole stays convex.
    [Hertel and Mehlhorn 1983: at most four times as many as the fewest]

    >>> ell = np.array([0, 2, 2 + 1j, 1 + 1j, 1 + 2j, 2j])
    >>> len(convex_pieces(ell)), len(convex_pieces(ell[:3]))
    (2, 1)
    """
    if len(corners) == 3 or _is_convex(corners):
        return (corners,)
    faces: list[list[int]] = triangles(corners).tolist()
    while (pair := _joinable(corners, faces)) is not None:
        first, other, whole = pair
        faces = [face for k, face in enumerate(faces) if k not in {first, other}] + [whole]
    return tuple(corners[face] for face in faces)


def _is_convex(corners: ComplexArray) -> bool:
    """Whether a counter-clockwise polygon turns left, or goes straight on, at every corner, and once round in all."""
    edges = np.roll(corners, -1) - corners
    turns = np.angle(np.roll(edges, -1) / edges)
    return bool(np.all(turns > -_IN_LINE) and np.sum(turns) < 2 * np.pi + 0.1)


_IN_LINE = 1e-9
"""Turn to the right that counts as rounding [rad]."""


def _joinable(corners: ComplexArray, faces: list[list[int]]) -> tuple[int, int, list[int]] | None:
    """Numbers of two faces that are convex together, and the face that they make; None: there are none."""
    beside = {(face[j - 1], face[j]): (k, j) for k, face in enumerate(faces) for j in range(len(face))}
    for (begin, end), (k, j) in beside.items():
        if (end, begin) in beside:
            other, i = beside[end, begin]
            face = [*faces[k][j:], *faces[k][:j]]  # from `end` round to `begin`
            rest = [*faces[other][i:], *faces[other][:i]]  # from `begin` round to `end`
            whole = [*face, *rest[1:-1]]
            if _is_convex(corners[whole]):
                return k, other, whole
    return None


def prism_corners(section: ComplexArray, length: float) -> Points:
    """Corners of the prism over a convex section, from z = 0 to its length [m]."""
    flat = np.stack([section.real, section.imag, np.zeros(len(section))], axis=1)
    return np.concatenate([flat, flat + np.array([0.0, 0.0, length])])


def frustums(profile: ComplexArray, deviation: float) -> tuple[Points, ...]:
    """Corners of frustums that contain a turned profile z + i r [m]: over its outer line, bores filled.

    Their rings are polygons about the circles, which exceed them by the deviation.
    """
    start, end = profile, np.roll(profile, -1)
    low, high = np.minimum(start.real, end.real), np.maximum(start.real, end.real)
    stations = np.unique(profile.real)
    pieces = []
    for bottom, top in itertools.pairwise(stations.tolist()):
        over = (low <= bottom) & (high >= top) & (high > low)
        slope = (end.imag - start.imag)[over] / (end.real - start.real)[over]
        radii = start.imag[over][:, None] + slope[:, None] * (np.array([bottom, top]) - start.real[over][:, None])
        outer = radii[np.argmax(radii.sum(axis=1))]
        pieces.append(np.concatenate([_ring(z, r, deviation) for z, r in zip((bottom, top), outer, strict=True)]))
    return tuple(pieces)


def _ring(height: float, radius: float, deviation: float) -> Points:
    number = ring_corners(radius, deviation)
    around = radius / math.cos(math.pi / number) * np.exp(2j * np.pi * np.arange(number) / number)
    return np.stack([around.real, around.imag, np.full(number, height)], axis=1)


def ring_corners(radius: float, deviation: float) -> int:
    """Corners of a polygon about or in a circle that is nowhere farther from it than the deviation [m]."""
    if radius <= 0:
        return 3
    return max(_FEWEST, math.ceil(math.pi / math.acos(1 / (1 + deviation / radius))))
