"""Order of the strokes of a colour: from region to region and stroke to stroke the nearest, outlines before rows.

The bound of the travel is the least tree that joins all strokes: no order is shorter. A stroke is left and reached at
its ends, an outline at any of its corners.      [minimum spanning tree, part of the Delaunay triangulation]
"""

from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import minimum_spanning_tree
from scipy.spatial import Delaunay, QhullError

from ilmek.arrays import Complex
from ilmek.weaving.gun.strokes import RegionStrokes

Stroke = Complex[np.ndarray, " points"]

_AROUND = 24
"""Corners of an outline at which a region is reached from another, at most."""

_NONE = 1e-12
"""Length of a link within a stroke [m]: 0 would be no link."""


def in_order(regions: Sequence[RegionStrokes], start: complex) -> list[Stroke]:
    """The strokes of a colour in the order of the gun, which comes from `start`; turned as it runs along them."""
    regions = [region for region in regions if region.outlines]
    reached = np.full((len(regions), _AROUND), np.inf + 0j)
    for own, region in zip(reached, regions, strict=True):
        corners = region.outlines[0][:: -(-len(region.outlines[0]) // _AROUND)]
        own[: len(corners)] = corners
    strokes: list[Stroke] = []
    here = start
    for _ in regions:
        number = int(np.argmin(np.abs(reached - here)) // _AROUND)
        reached[number] = np.inf
        for kind in (regions[number].outlines, regions[number].rows):
            strokes += _nearest_first(kind, here)
            here = complex(strokes[-1][-1])
    return strokes


def _nearest_first(strokes: Sequence[Stroke], here: complex) -> Iterable[Stroke]:
    """Strokes, each the nearest to the end of the one before."""
    ends = np.array([_ends(stroke, here) for stroke in strokes]).reshape(-1, 2)
    for _ in strokes:
        number, side = divmod(int(np.argmin(np.abs(ends - here))), 2)
        ends[number] = np.inf
        stroke = _from(strokes[number], here) if side == 0 else strokes[number][::-1]
        yield stroke
        here = complex(stroke[-1])


def is_closed(stroke: Stroke) -> bool:
    """Whether a stroke ends where it begins."""
    return bool(stroke[0] == stroke[-1])


def _ends(stroke: Stroke, here: complex) -> tuple[complex, complex]:
    """Where a stroke may be begun: at its ends, an outline at its corner that is the nearest."""
    if not is_closed(stroke):
        return complex(stroke[0]), complex(stroke[-1])
    corner = complex(stroke[np.argmin(np.abs(stroke - here))])
    return corner, corner


def _from(stroke: Stroke, here: complex) -> Stroke:
    """An outline from its corner that is the nearest; another stroke as it is."""
    if not is_closed(stroke):
        return stroke
    around = np.roll(stroke[:-1], -int(np.argmin(np.abs(stroke[:-1] - here))))
    return np.append(around, around[0])


def travel_of(strokes: Sequence[Stroke]) -> float:
    """Distance from the end of each stroke to the beginning of the next, in total [m]."""
    return float(sum(abs(after[0] - before[-1]) for before, after in pairwise(strokes)))


def least_travel(strokes: Sequence[Stroke]) -> float:
    """Length of the least tree that joins strokes at the points where they can be left and reached [m].

    >>> least_travel([np.array([0, 1 + 0j]), np.array([1 + 1j, 3 + 1j]), np.array([3 + 3j, 0 + 3j])])
    3.0
    """
    if len(strokes) < 2:
        return 0.0
    joints = [stroke[:-1] if is_closed(stroke) else stroke[[0, -1]] for stroke in strokes]
    points = np.concatenate(joints)
    of_stroke = np.repeat(np.arange(len(joints)), [len(own) for own in joints])
    try:
        corners = Delaunay(np.stack([points.real, points.imag], axis=1)).simplices
    except QhullError:  # all on one line
        order = np.lexsort((points.imag, points.real))
        corners = np.stack([order[:-1], order[1:], order[1:]], axis=1)
    links = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    length = np.abs(points[links[:, 0]] - points[links[:, 1]])
    chain = np.flatnonzero(of_stroke[1:] == of_stroke[:-1])
    links = np.concatenate([np.sort(links, axis=1), np.stack([chain, chain + 1], axis=1)])
    length = np.concatenate([np.maximum(length, _NONE), np.full(len(chain), _NONE)])
    order = np.lexsort((length, links[:, 1], links[:, 0]))  # of a pair that is linked twice the shorter one
    links, length = links[order], length[order]
    first = np.append(True, (links[1:] != links[:-1]).any(axis=1))
    size = (len(points), len(points))
    tree = minimum_spanning_tree(coo_array((length[first], tuple(links[first].T)), shape=size).tocsr())
    return float(tree.data[tree.data > _NONE].sum())
