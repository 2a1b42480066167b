"""Blends: the knots of a photo on its edges, which are the mean of the two sides and no shade of their own.

A knot is a blend if its colour lies between those of the two REACH knots beside it, in row or column: in each channel
up to SLACK codes, a tenth or more of the way from either, and these differ by CONTRAST or more.
"""

import numpy as np

from ilmek.arrays import Int64, IntArray, Rgb
from ilmek.carpet.palette import Colours
from ilmek.num.compiled import compiled, uncounted

CONTRAST, SLACK = 60, 6
"""Codes of a channel."""

MOST_KNOTS = 250_000
"""Number of knots above which rows are left out."""

REACH = 2
"""Knots to either side of a smoothed edge."""


@uncounted
def _is_between(rgb: Rgb, y: int, x: int, down: int, right: int) -> bool:
    """Whether a knot is a blend along one direction."""
    widest, first, second = 0, 0, 0
    for channel in range(3):
        one, own = int(np.int64(rgb[y - down, x - right, channel])), int(np.int64(rgb[y, x, channel]))
        other = int(np.int64(rgb[y + down, x + right, channel]))
        if own < min(one, other) - SLACK or own > max(one, other) + SLACK:
            return False
        widest = max(widest, abs(other - one))
        first, second = first + abs(own - one), second + abs(other - own)
    return widest >= CONTRAST and 9 * min(first, second) >= max(first, second)


@compiled
def _count_blends(rgb: Rgb, index: IntArray, step: int, out: IntArray) -> None:
    """Add the blends of each colour in every `step`-th row, for all of these rows."""
    rows, columns = rgb.shape[:2]
    for y in range(step // 2, rows, step):
        for x in range(columns):
            across = REACH <= x < columns - REACH and _is_between(rgb, y, x, 0, REACH)
            if across or (REACH <= y < rows - REACH and _is_between(rgb, y, x, REACH, 0)):
                code = np.int32(rgb[y, x, 0]) << 16 | np.int32(rgb[y, x, 1]) << 8 | rgb[y, x, 2]
                out[index[code] - 1] += step


def blends(design: Rgb, colours: Colours) -> Int64[np.ndarray, " colours"]:
    """The number of knots of each distinct colour that are blends, about.

    >>> from ilmek.carpet.palette import distinct_colours
    >>> edge = np.array([[[255] * 3, [255] * 3, [140] * 3, [0] * 3, [0] * 3]], dtype=np.uint8)
    >>> blends(edge, distinct_colours(edge)).tolist()
    [0, 1, 0]
    """
    found = np.zeros(len(colours.counts), dtype=np.int64)
    step = max(1, design.shape[0] * design.shape[1] // MOST_KNOTS)
    _count_blends(np.ascontiguousarray(design), colours.index, step, found)
    return np.asarray(np.minimum(found, colours.counts))
