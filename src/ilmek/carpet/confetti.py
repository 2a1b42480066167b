"""Lone knots: a knot unlike its neighbours left, right, above and below (fewer at an edge)."""

import numpy as np

from ilmek.arrays import Indices
from ilmek.carpet.design import bands
from ilmek.num.compiled import compiled
from ilmek.progress import SILENT, Progress


@compiled
def is_lone(knots: Indices, row: int, column: int) -> bool:
    """Whether a knot has neighbours and differs from all of them."""
    yarn = knots[row, column]
    last_row, last_column = knots.shape[0] - 1, knots.shape[1] - 1
    return bool(
        (column == 0 or knots[row, column - 1] != yarn)
        and (column == last_column or knots[row, column + 1] != yarn)
        and (row == 0 or knots[row - 1, column] != yarn)
        and (row == last_row or knots[row + 1, column] != yarn)
        and (last_row > 0 or last_column > 0)
    )


@compiled
def _count_lone(knots: Indices, first: int, stop: int) -> int:
    lone = 0
    for row in range(first, stop):
        for column in range(knots.shape[1]):
            lone += is_lone(knots, row, column)
    return lone


def count_lone(knots: Indices, progress: Progress = SILENT) -> int:
    """Number of lone knots of a chart (rows, columns)."""
    knots = np.ascontiguousarray(knots)
    lone = 0
    for band in bands(*knots.shape):
        lone += int(_count_lone(knots, band.start, band.stop))
        progress(band.stop / len(knots))
    return lone
