"""Blue noise: a square of thresholds whose points are evenly spread at every share, without a visible period.

Void and cluster: with the sum of a Gaussian over the points, the tightest cluster is where it is greatest among the
points and the largest void where it is least among the others. From a begin of one tenth of the points, made even by
moving the tightest cluster into the largest void, points are removed and added one by one; the order is the threshold.

Source: R. Ulichney, The void-and-cluster method for dither array generation, Proc. SPIE 1913 (1993) 332-343.
"""

from functools import cache

import numpy as np

from ilmek.arrays import BoolArray, Int64, IntArray
from ilmek.num.compiled import compiled

SIDE = 64
"""Cells along a side of the square, which is repeated; a power of two."""

_SPREAD = 1.5
"""Standard deviation of the Gaussian, in cells, as in the paper."""


@compiled
def _put(field: IntArray, bell: IntArray, cell: int, sign: int) -> None:
    row, column = divmod(cell, SIDE)
    for i in range(SIDE):
        for j in range(SIDE):
            field[i * SIDE + j] += sign * bell[(i - row) & SIDE - 1, (j - column) & SIDE - 1]


@compiled
def _extreme(field: IntArray, on: BoolArray, cluster: bool) -> int:
    """The tightest cluster or the largest void; of equal ones the first."""
    best = -1
    for cell in range(len(field)):
        if on[cell] == cluster and (best < 0 or (field[cell] > field[best] if cluster else field[cell] < field[best])):
            best = cell
    return best


@compiled
def _order(on: BoolArray, bell: IntArray, rank: IntArray) -> None:
    field = np.zeros(len(on), dtype=np.int64)
    for cell in range(len(on)):
        if on[cell]:
            _put(field, bell, cell, 1)
    cluster, void = -1, -2
    while cluster != void:
        cluster = _extreme(field, on, True)
        on[cluster] = False
        _put(field, bell, cluster, -1)
        void = _extreme(field, on, False)
        on[void] = True
        _put(field, bell, void, 1)
    begun, points = on.copy(), 0
    kept = field.copy()
    for cell in range(len(on)):
        points += on[cell]
    for number in range(points - 1, -1, -1):
        cell = _extreme(field, on, True)
        on[cell] = False
        _put(field, bell, cell, -1)
        rank[cell] = number
    on[:], field[:] = begun, kept
    for number in range(points, len(on)):
        cell = _extreme(field, on, False)
        on[cell] = True
        _put(field, bell, cell, 1)
        rank[cell] = number


@cache
def blue_noise() -> Int64[np.ndarray, "side side"]:
    """The order, 0 to SIDE² - 1, in which the cells of the square are set; the same on every machine.

    >>> sorted(blue_noise().ravel().tolist()) == list(range(SIDE**2))
    True
    """
    away = np.minimum(np.arange(SIDE), SIDE - np.arange(SIDE))
    bell = np.rint((1 << 30) * np.exp(-np.add.outer(away**2, away**2) / (2 * _SPREAD**2))).astype(np.int64)
    on, rank = np.zeros(SIDE**2, dtype=bool), np.empty(SIDE**2, dtype=np.int64)
    on[(np.arange(SIDE**2 // 10) * 2531 + 7) % SIDE**2] = True  # 2531 is odd: no cell twice
    _order(on, bell, rank)
    return rank.reshape(SIDE, SIDE)
