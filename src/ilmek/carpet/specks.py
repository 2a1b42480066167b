"""Specks: small patches that belong to no pattern.

A dotted ground has small patches too, and nobody would take them out. A dot of a pattern is one of at least LINE small
patches of its yarn at equal steps on a straight line, in any direction; drawn dots that were resampled lie within one
knot of their place. Steps are at most FARTHEST knots. What remains are specks.

By chance, of n specks of one yarn among N knots about n · 2 FARTHEST² · p · (9 p)^(LINE - 2), p = n / N, begin such a
line: of 800 in a carpet of 135,000 knots one does.
"""

import numpy as np

from ilmek.arrays import BoolArray, Indices, Int64, IntArray
from ilmek.carpet.patches import SmallPatches, small_patches
from ilmek.num.compiled import compiled
from ilmek.progress import SILENT, Progress

LINE = 5
"""Least number of dots in a line of a pattern."""

FARTHEST = 32
"""Longest step between two dots of a pattern, across and along [knots]."""


def specks(knots: Indices, most: int, progress: Progress = SILENT) -> SmallPatches:
    """The patches of at most `most` knots of a chart (rows, columns) that are no dots of a pattern.

    >>> dotted = np.zeros((20, 20), dtype=np.uint8)
    >>> dotted[2::4, 2::4] = 1
    >>> dotted[8, 0] = 2
    >>> specks(dotted, 3).knots.tolist()
    [160]
    """
    patches = small_patches(knots, most, progress.part(0.0, 0.5))
    rows, columns = knots.shape
    if not len(patches.knots):
        return patches
    places = np.stack([patches.knots // columns, patches.knots % columns], axis=-1)
    patch_of = _numbered(places, knots)
    first = np.flatnonzero(np.diff(patch_of, prepend=-1))
    sizes = np.diff(first, append=len(places))
    middles = np.add.reduceat(places, first) // sizes[:, None]
    yarns = knots[places[first, 0], places[first, 1]].astype(np.int64)
    number_at = np.full((rows, columns), -1, dtype=np.int64)
    number_at[middles[:, 0], middles[:, 1]] = np.arange(len(first))
    lone = np.ones(len(first), dtype=bool)
    _leave_out_lines(middles, yarns, number_at, lone)
    kept = lone[patch_of]
    return SmallPatches(
        np.bincount(sizes[lone], minlength=most + 1).astype(np.int64), patches.knots[kept], patches.around[kept]
    )


@compiled
def _numbered(places: Int64[np.ndarray, "knots 2"], knots: Indices) -> IntArray:
    """The number of the patch of each knot, of patches that follow each other.

    A patch lists its knots so that each touches an earlier one, and touches no other patch of its yarn.
    """
    numbers = np.zeros(len(places), dtype=np.int64)
    begun = 0
    for k in range(1, len(places)):
        touches = False
        for earlier in range(begun, k):
            near = max(abs(places[k, 0] - places[earlier, 0]), abs(places[k, 1] - places[earlier, 1])) <= 1
            touches |= near and knots[places[k, 0], places[k, 1]] == knots[places[earlier, 0], places[earlier, 1]]
        if not touches:
            begun = k
        numbers[k] = numbers[k - 1] + (not touches)
    return numbers


@compiled
def _number_near(
    row: int, column: int, yarn: int, yarns: Int64[np.ndarray, " patches"], number_at: Int64[np.ndarray, "rows columns"]
) -> int:
    """The number of a patch of a yarn within one knot of a place, the place itself first; -1: none."""
    number = -1
    for i in range(max(row - 1, 0), min(row + 2, number_at.shape[0])):
        for j in range(max(column - 1, 0), min(column + 2, number_at.shape[1])):
            here = number_at[i, j]
            if here >= 0 and yarns[here] == yarn and (number < 0 or (i == row and j == column)):
                number = here
    return number


@compiled
def _leave_out_lines(
    middles: Int64[np.ndarray, "patches 2"],
    yarns: Int64[np.ndarray, " patches"],
    number_at: Int64[np.ndarray, "rows columns"],
    lone: BoolArray,
) -> None:
    """Make `lone` false for the patches of each line of at least LINE at equal steps; each line is followed down."""
    line = np.empty(LINE, dtype=np.int64)
    rows, columns = number_at.shape
    for start in range(len(middles)):
        row, column = middles[start]
        line[0] = start
        for down in range(min(FARTHEST, rows - 1 - row) + 1):
            for right in range(-FARTHEST if down > 0 else 2, FARTHEST + 1):
                if max(down, abs(right)) < 2 or not 0 <= column + right < columns:
                    continue
                line[1] = number_at[row + down, column + right]
                if line[1] < 0 or yarns[line[1]] != yarns[start]:
                    continue
                for k in range(2, LINE):
                    last, before = middles[line[k - 1]], middles[line[0]]
                    # The mean step so far: steps that are no whole number of knots round differently.
                    line[k] = _number_near(
                        before[0] + round((last[0] - before[0]) * k / (k - 1)),
                        before[1] + round((last[1] - before[1]) * k / (k - 1)),
                        yarns[start], yarns, number_at,
                    )  # fmt: skip
                    if line[k] < 0 or line[k] == line[k - 1]:
                        break
                else:
                    for k in range(LINE):
                        lone[line[k]] = False
