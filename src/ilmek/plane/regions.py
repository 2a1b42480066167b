"""Regions of the plane from their signed distance: area with an error bound, and outline.

    f(z) <= 0 inside,    |f(z) - f(w)| <= |z - w|

A square is entirely inside or outside if |f| at its centre is large enough; other squares are divided into four. So
only squares along the edge are refined, and no detail larger than the smallest squares is missed. In these the edge is
a chord between the roots of f on their sides [marching squares; Lorensen, Cline 1987]. For a smooth edge the error of
the area falls with the square of their size.
"""

from collections.abc import Callable, Iterator
from typing import TypeAlias

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Float, Int
from ilmek.plane.vectors import cross
from ilmek.records import record

Distance: TypeAlias = Callable[[Complex[np.ndarray, " points"]], Float[np.ndarray, " points"]]
"""Points [m] -> signed distance from the region [m], above 0 outside; inside, its magnitude is a lower bound."""

Crossing: TypeAlias = tuple[tuple[int, int], tuple[int, int]]
"""A side of a small square: its two nodes on the grid, in order."""


@record
class Region:
    """Area and outline of a region.

    area     [m^2]            bound  of the area's error [m^2]: the area of the small squares on the edge
    outline  closed polygons [m]: outer ones counter-clockwise, holes clockwise, the largest first
    """

    area: float
    bound: float
    outline: tuple[ComplexArray, ...]


def region(f: Distance, corner: complex, side: float, *, cells: int) -> Region:
    """The region f <= 0 in the square at `corner` (its lower left) [m].

    f  signed distance, see `Distance`      side  of the square [m]      cells  across the side, a power of 2


    >>> disc = region(lambda z: np.abs(z) - 1, -2 - 2j, 4.0, cells=128)
    >>> round(disc.area, 3), round(disc.bound, 1), len(disc.outline)
    (3.141, 0.3, 1)
    """
    nodes, size = _edge_squares(f, corner, side, cells), side / cells
    ends = (nodes[:, None, :] + np.array([[0, 0], [1, 0], [1, 1], [0, 1]])).reshape(-1, 2)
    unique, where = np.unique(ends, axis=0, return_inverse=True)
    values = f(corner + size * (unique[:, 0] + 1j * unique[:, 1]))
    of_corner = values[where.ravel()].reshape(-1, 4)
    crossed = np.flatnonzero((of_corner.min(axis=1) <= 0) & (of_corner.max(axis=1) > 0))
    middles = f(corner + size * (nodes[crossed, 0] + 0.5 + 1j * (nodes[crossed, 1] + 0.5)))
    positions: dict[Crossing, complex] = {}
    following = dict(
        chord
        for square, at, middle in zip(nodes[crossed], of_corner[crossed], middles, strict=True)
        for chord in _chords(square, at, bool(middle > 0), positions)
    )
    loops = [corner + size * np.array([positions[one] for one in loop]) for loop in _loops(following)]
    areas = [0.5 * float(np.sum(cross(loop, np.roll(loop, -1)))) for loop in loops]
    order = sorted(range(len(loops)), key=lambda k: -abs(areas[k]))
    return Region(float(sum(areas)), len(crossed) * size**2, tuple(loops[k] for k in order))


def _edge_squares(f: Distance, corner: complex, side: float, cells: int) -> Int[np.ndarray, "squares 2"]:
    """The smallest squares that may contain the edge, by their lower left nodes."""
    across = min(16, cells)
    squares = np.stack(np.meshgrid(np.arange(across), np.arange(across), indexing="ij"), axis=-1).reshape(-1, 2)
    while True:
        size = side / across
        at = f(corner + size * (squares[:, 0] + 0.5 + 1j * (squares[:, 1] + 0.5)))
        squares = np.asarray(squares[np.abs(at) <= 1.001 * np.sqrt(0.5) * size])
        if across == cells:
            return squares
        across *= 2
        squares = (2 * squares[:, None, :] + np.array([[0, 0], [1, 0], [1, 1], [0, 1]])).reshape(-1, 2)


def _chords(
    square: Int[np.ndarray, " 2"], at: Float[np.ndarray, " 4"], middle_outside: bool, positions: dict[Crossing, complex]
) -> Iterator[tuple[Crossing, Crossing]]:
    """The edge's chords in a square, with the region on their left: pairs of sides where they leave and enter it."""
    i, j = int(square[0]), int(square[1])
    corners = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
    leaving: list[tuple[int, Crossing]] = []
    entering: list[tuple[int, Crossing]] = []
    for k in range(4):
        start_node, end_node = corners[k], corners[(k + 1) % 4]
        if (at[k] <= 0) != (at[(k + 1) % 4] <= 0):
            share = float(at[k] / (at[k] - at[(k + 1) % 4]))
            key = (start_node, end_node) if start_node < end_node else (end_node, start_node)
            positions[key] = complex(*start_node) + share * (complex(*end_node) - complex(*start_node))
            (leaving if at[k] <= 0 else entering).append((k, key))
    for k, key in leaving:
        if middle_outside:  # the inner corner is cut off
            yield key, min(entering, key=lambda other: (k - other[0]) % 4)[1]
        else:
            yield key, min(entering, key=lambda other: (other[0] - k) % 4)[1]


def _loops(following: dict[Crossing, Crossing]) -> Iterator[list[Crossing]]:
    """Closed polygons of chords."""
    left = dict(following)
    while left:
        start, at = next(iter(left.items()))
        loop = [start]
        del left[start]
        while at != start and at in left:
            loop.append(at)
            at = left.pop(at)
        if at == start and len(loop) > 2:
            yield loop
