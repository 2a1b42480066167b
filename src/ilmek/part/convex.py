"""Convex bodies that contain a shape, for distances: of polygons, of prisms over them, of turned profiles."""

import cmath
import itertools
import math
from collections.abc import Iterator, Sequence
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


def convex_pieces(
    outline: Complex[np.ndarray, " corners"], holes: Sequence[ComplexArray] = ()
) -> tuple[ComplexArray, ...]:
    """Convex polygons that together are a polygon, counter-clockwise, with holes, clockwise [m].

    Its triangles, two joined across a common edge where the whole stays convex at both ends of the edge.
    [Hertel and Mehlhorn 1983: without holes at most four times as many as the fewest]

    >>> ell = np.array([0, 2, 2 + 1j, 1 + 1j, 1 + 2j, 2j])
    >>> len(convex_pieces(ell)), len(convex_pieces(ell[:3]))
    (2, 1)
    """
    if not holes and (len(outline) == 3 or _is_convex(outline)):
        return (outline,)
    corners = np.concatenate([outline, *holes]).tolist()
    faces: dict[int, list[int]] = dict(enumerate(triangles(outline, holes).tolist()))
    beside = {edge: number for number, face in faces.items() for edge in _edges(face)}
    for begin, end in [edge for edge in beside if edge[0] < edge[1] and edge[::-1] in beside]:
        first, other = beside[begin, end], beside[end, begin]
        if first == other:
            continue
        face, rest = _turned(faces[first], end), _turned(faces[other], begin)  # from `end` round to `begin`, and back
        if _turns_left(corners, face[-2:], rest[1]) and _turns_left(corners, rest[-2:], face[1]):
            faces[first] = [*face, *rest[1:-1]]
            del faces[other]
            beside |= dict.fromkeys(_edges(faces[first]), first)
    return tuple(np.array([corners[corner] for corner in face]) for face in faces.values())


def _edges(face: list[int]) -> Iterator[tuple[int, int]]:
    return zip(face[-1:] + face[:-1], face, strict=True)


def _turned(face: list[int], first: int) -> list[int]:
    """The corners of a face from one of them on."""
    begin = face.index(first)
    return face[begin:] + face[:begin]


def _turns_left(corners: list[complex], edge: list[int], beyond: int) -> bool:
    """Whether the way along an edge and on to a corner turns left, or goes straight on."""
    before, middle = (corners[corner] for corner in edge)
    turn = cmath.phase((corners[beyond] - middle) / (middle - before))
    return -_IN_LINE < turn < math.pi - _IN_LINE


def _is_convex(corners: ComplexArray) -> bool:
    """Whether a counter-clockwise polygon turns left, or goes straight on, at every corner, and once round in all."""
    edges = np.roll(corners, -1) - corners
    turns = np.angle(np.roll(edges, -1) / edges)
    return bool(np.all(turns > -_IN_LINE) and np.sum(turns) < 2 * np.pi + 0.1)


_IN_LINE = 1e-9
"""Turn to the right that counts as rounding [rad]."""


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
