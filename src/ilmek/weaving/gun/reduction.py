"""A chart reduced to what a tufting gun can make: every region open to a disk of the smallest feature.

The opening of a region is the union of all disks in it [Serra 1982]. Cells outside the openings take the colour of the
nearest cell that is in one, until every cell is, or nothing changes. The outline of the carpet stays as it is.
"""

import numpy as np
from scipy.ndimage import distance_transform_edt

from ilmek.arrays import BoolArray, Int, UInt8

OUTSIDE = 255
"""Label of cells outside of the carpet's shape, and beyond its edge."""

_PASSES = 6
"""Most passes; the second already changes less than a thousandth of the cells."""


def disk(diameter: int) -> Int[np.ndarray, "cells 2"]:
    """Cells of a disk [cells], as steps from its first row and column, (cells, 2).

    >>> len(disk(1)), len(disk(2)), len(disk(4))
    (1, 4, 12)
    """
    steps = np.arange(diameter) - (diameter - 1) / 2
    row, column = np.nonzero(steps[:, None] ** 2 + steps[None, :] ** 2 <= (diameter / 2) ** 2)
    return np.stack([row, column], axis=1)


def opened(labels: UInt8[np.ndarray, "rows columns"], diameter: int) -> BoolArray:
    """Cells that are in a disk of their own label, whole within the field.

    >>> opened(np.array([[0, 0, 1], [0, 0, 0]], dtype=np.uint8), 2).tolist()
    [[True, True, False], [True, True, False]]
    """
    rows, columns = labels.shape
    wide = np.pad(labels, ((0, diameter), (0, diameter)), constant_values=OUTSIDE)
    cells = disk(diameter).tolist()
    first = wide[cells[0][0] :, cells[0][1] :][:rows, :columns]
    whole = np.ones((rows, columns), dtype=bool)
    for row, column in cells:
        whole &= wide[row : row + rows, column : column + columns] == first
    kept = np.zeros(wide.shape, dtype=bool)
    for row, column in cells:
        kept[row : row + rows, column : column + columns] |= whole
    return kept[:rows, :columns]


def reduced(labels: UInt8[np.ndarray, "rows columns"], diameter: int) -> UInt8[np.ndarray, "rows columns"]:
    """Labels of which every cell is in a disk of its own label; unchanged where nothing is as wide as the disk."""
    inside = labels != OUTSIDE
    for _ in range(_PASSES):
        kept = opened(labels, diameter) & inside
        if np.array_equal(kept, inside) or not kept.any():
            break
        row, column = distance_transform_edt(~kept, return_distances=False, return_indices=True)
        nearest = np.where(inside, labels[row, column], OUTSIDE)
        if np.array_equal(nearest, labels):
            break
        labels = nearest
    return labels
