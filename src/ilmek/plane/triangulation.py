"""Triangles of a polygon with holes, by ear clipping.

An ear is a corner that turns left and whose triangle contains no other corner.
[Meisters 1975: every polygon has two ears; the library mapbox-earcut clips them]
"""

import itertools
from collections.abc import Sequence
from importlib import import_module

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Int, IntArray
from ilmek.errors import IlmekError
from ilmek.plane.vectors import cross, following

_SAME = 1e-6
"""Difference of areas that counts as rounding, over the area."""

_IN_LINE = 1e-9
"""Distance of a corner from an edge that counts as rounding, over the edge."""


def triangles(
    outline: Complex[np.ndarray, " corners"], holes: Sequence[ComplexArray] = ()
) -> Int[np.ndarray, "triangles 3"]:
    """Triangles, counter-clockwise, of the corners of the outline and then of the holes, numbered in this order.

    outline  counter-clockwise [m]      holes  inside it, clockwise, at a distance from each other [m]
    Two triangles meet along whole edges, and each edge of the polygon is that of one triangle.
    Raises IlmekError where the outline crosses itself or a hole.

    >>> square = np.array([0, 2, 2 + 2j, 2j])
    >>> len(triangles(square)), len(triangles(square, [np.array([0.5 + 0.5j, 0.5 + 1j, 1 + 1j])]))
    (2, 7)
    """
    rings = (outline, *holes)
    points = np.concatenate(rings)
    ends = np.cumsum([len(ring) for ring in rings])
    clip = import_module("mapbox_earcut").triangulate_float64  # a linkage needs no triangles
    clipped = clip(np.stack([points.real, points.imag], axis=1), ends.astype(np.uint32))
    faces = clipped.reshape(-1, 3).astype(np.int64)
    within = sum(float(np.sum(cross(ring, following(ring)))) for ring in rings)
    first, second, third = points[faces].T
    covered = float(np.sum(np.abs(cross(second - first, third - first))))
    if not abs(covered - within) <= _SAME * abs(within):
        raise IlmekError("an outline crosses itself", do="check the plate's outline and its holes")
    number = np.arange(len(points))
    after = np.concatenate([following(part) for part in np.split(number, ends[:-1])])
    return _meeting(points, faces.tolist(), set(zip(number.tolist(), after.tolist(), strict=True)))


def _meeting(points: ComplexArray, faces: list[list[int]], ring: set[tuple[int, int]]) -> IntArray:
    """The triangles, those divided at whose edges a corner lies: ear clipping leaves out corners in line with others.

    ring  edges of the polygon
    """
    edges = {edge for face in faces for edge in _edges(face)}
    single = [edge for edge in edges - ring if edge[::-1] not in edges]
    if not single:
        return np.array(faces)
    loose = np.unique([corner for edge in (*single, *(ring - edges)) for corner in edge])
    on_edge = {edge: _on_edge(points, edge, loose) for edge in single}
    whole: list[list[int]] = []
    while faces:
        face = faces.pop()
        divided = next((edge for edge in _edges(face) if on_edge.get(edge)), None)
        if divided is None:
            whole.append(face)
            continue
        begin, end = divided
        (opposite,) = set(face) - set(divided)
        line = [begin, *on_edge[divided], end]
        faces += [[corner, following, opposite] for corner, following in itertools.pairwise(line)]
    return np.array(whole)


def _edges(face: Sequence[int]) -> list[tuple[int, int]]:
    first, second, third = face
    return [(first, second), (second, third), (third, first)]


def _on_edge(points: ComplexArray, edge: tuple[int, int], corners: IntArray) -> list[int]:
    """Those of some corners that lie between the ends of an edge, in their order along it."""
    begin, end = points[list(edge)]
    along = (points[corners] - begin) / (end - begin)
    near = (np.abs(along.imag) < _IN_LINE) & (along.real >= 0) & (along.real <= 1) & ~np.isin(corners, edge)
    order = np.argsort(along.real[near], kind="stable")
    return [int(corner) for corner in corners[near][order]]
