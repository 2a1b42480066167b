"""Dye lots: how many a yarn needs, and the rows in which a new one begins.

Two lots of one colour never match exactly. The field should come from one; where it cannot, the weaver knows the rows
beforehand and blends there: a row of the old lot, a row of the new one, by turns.
"""

import math

import numpy as np

from ilmek.arrays import Indices
from ilmek.carpet.design import bands


def whole(share: float) -> int:
    """The least whole number that is not below `share`, but for rounding.

    >>> whole(3.0000000000004), whole(3.01)
    (3, 4)
    """
    return math.ceil(share - 1e-9 * max(1.0, share))


def rows_of_new_lots(knots: Indices, yarn: int, knots_per_lot: float, lots: int) -> tuple[int, ...]:
    """Rows, from 1 at the lower edge, in which the 2nd to the last lot of a yarn begin.

    knots  yarn of each knot, row 0 at the upper edge      yarn  index of the yarn
    A lot of `knots_per_lot` knots ends within the row before, or within the row itself.

    >>> rows_of_new_lots(np.zeros((10, 4), dtype=np.uint8), 0, 14.0, 3)
    (4, 8)
    """
    if lots == 1:
        return ()
    in_rows = np.concatenate([np.count_nonzero(knots[band] == yarn, axis=1) for band in bands(*knots.shape)])
    tied = np.cumsum(in_rows[::-1])
    ends = knots_per_lot * np.arange(1, lots)
    rows = np.searchsorted(tied, ends, side="right")
    return tuple((np.minimum(rows, len(tied) - 1) + 1).tolist())
