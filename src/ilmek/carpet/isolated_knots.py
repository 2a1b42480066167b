"""Lone knots: a knot unlike all its neighbours (left, right, above, below; fewer at an edge).

A lone knot is not visible on the carpet and costs two yarn changes. It takes the yarn of the neighbour whose colour is
nearest to the knot's own.

One pass from the top is sufficient. A lone knot shares its yarn with no neighbour, so changing it makes no neighbour
lone, and after the change it shares the yarn of one. A knot that is not lone shares its yarn with a neighbour that is
not lone either and is never changed. So no lone knot remains. (A chart of one knot has no lone knot.)
"""

import numpy as np

from ilmek.arrays import FloatArray, Indices, IntArray, Rgb, UInt8
from ilmek.carpet.colour_difference import ciede2000
from ilmek.carpet.design import bands
from ilmek.carpet.palette import Colours
from ilmek.num.compiled import compiled
from ilmek.progress import SILENT, Progress

_SLICE = 1 << 17
"""Knots of one call of the kernel, which computes up to four differences for each."""


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


@compiled
def _best_neighbour(
    knots: Indices, row: int, column: int, lab: FloatArray, yarns: FloatArray
) -> tuple[UInt8[np.ndarray, ""], float]:
    best, least = knots[row, column], np.inf
    for step in range(4):
        y = row + (step == 3) - (step == 0)
        x = column + (step == 2) - (step == 1)
        if 0 <= y < knots.shape[0] and 0 <= x < knots.shape[1]:
            yarn = knots[y, x]
            difference = ciede2000(lab[0], lab[1], lab[2], yarns[yarn, 0], yarns[yarn, 1], yarns[yarn, 2])
            if difference < least:
                best, least = yarn, difference
    return best, least


@compiled
def _merge(  # noqa: PLR0917
    knots: Indices,
    rgb: Rgb,
    index: IntArray,
    labs: FloatArray,
    yarns: FloatArray,
    before: FloatArray,
    rows: tuple[int, int],
    so_far: tuple[int, float],
) -> tuple[int, float]:
    merged, added = so_far
    for row in range(rows[0], rows[1]):
        for column in range(knots.shape[1]):
            if is_lone(knots, row, column):
                code = np.int32(rgb[row, column, 0]) << 16 | np.int32(rgb[row, column, 1]) << 8 | rgb[row, column, 2]
                colour = index[code] - 1
                knots[row, column], difference = _best_neighbour(knots, row, column, labs[colour], yarns)
                added += difference - before[colour]
                merged += 1
    return merged, added


def count_lone(knots: Indices, progress: Progress = SILENT) -> int:
    """Number of lone knots of a chart (rows, columns)."""
    knots = np.ascontiguousarray(knots)
    lone = 0
    for band in bands(*knots.shape):
        lone += int(_count_lone(knots, band.start, band.stop))
        progress(band.stop / len(knots))
    return lone


def merge_lone(
    knots: Indices,
    rgb: Rgb,
    colours: Colours,
    yarn_labs: FloatArray,
    difference: FloatArray,
    *,
    progress: Progress = SILENT,
) -> tuple[int, float]:
    """Give every lone knot the yarn of its best neighbour; `knots` is modified.

    rgb         picture on the knot grid               colours     its distinct colours
    yarn_labs   CIELAB of the yarns, (yarns, 3)        difference  CIEDE2000 of each colour to its yarn, (colours,)
    Returns the number of changed knots and the sum of CIEDE2000 that the changes add.
    """
    rgb = np.ascontiguousarray(rgb)
    found = (0, 0.0)
    rows, columns = knots.shape
    for band in bands(rows, columns, _SLICE):
        merged, added = _merge(
            knots, rgb, colours.index, colours.labs, yarn_labs, difference, (band.start, band.stop), found
        )
        found = int(merged), float(added)
        progress(band.stop / rows)
    return found
