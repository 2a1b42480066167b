"""Creel of an indexed drawing: each index of its palette is a position of the creel, also where two have one colour.

The designer of an indexed picture numbers the yarns: index 2 is the yarn on position 2, whatever colour is shown. A
chart by colours alone would merge two positions that look alike, and would sort the others by the yarn list.
"""

from dataclasses import replace

import numpy as np

from ilmek.arrays import Indices
from ilmek.carpet.chart import Chart, rearranged
from ilmek.carpet.codes import CODES
from ilmek.carpet.yarn import MOST_YARNS, Yarn

MOST_POSITIONS = 64
"""Largest number of indices that are taken for positions of a creel; pictures with more are reduced photos."""


def in_creel_order(chart: Chart, indices: Indices) -> Chart | None:
    """The chart with a yarn for each index of the picture that it was made from, in the order of the indices.

    indices  of the picture's pixels, a whole number of them along and across each knot
    A yarn that several indices have is there for each of them, under one number; from the second on its name has the
    position. Unused yarns of the list follow, on the positions that are free. None where the
    picture was not read knot by knot or has more than MOST_POSITIONS indices, and where an index has several yarns.

    >>> from ilmek import read_yarns
    >>> made = in_creel_order(Chart([[0, 1], [1, 1]], read_yarns()[:2], "4x4cm", "5x5/dm", "symmetric"),
    ...                       np.array([[7, 0], [2, 0]], dtype=np.uint8))
    >>> made.positions, made.knots.tolist(), [yarn.number for yarn in made.yarns]
    ((0, 2, 7), [[2, 0], [1, 0]], [2, 2, 1])
    """
    scale = indices.shape[0] // chart.rows
    if scale < 1 or chart.reading.kind != "exact" or indices.shape != (scale * chart.rows, scale * chart.columns):
        return None
    indices = indices[::scale, ::scale]
    pairs = np.unique(indices.astype(np.int64) * CODES + chart.knots)
    used, yarn_of = divmod(pairs, CODES)
    if len(np.unique(used)) < len(used) or len(used) > MOST_POSITIONS:
        return None
    order = [*yarn_of.tolist(), *(yarn for yarn in range(len(chart.yarns)) if yarn not in yarn_of)][:MOST_YARNS]
    free = (position for position in range(CODES) if position not in used)
    creel = (*used.tolist(), *(next(free) for _ in order[len(used) :]))
    rank = np.zeros(CODES, dtype=np.uint8)
    rank[used] = np.arange(len(used))
    made = rearranged(chart, order, rank[indices])
    return replace(made, yarns=_named_apart(made.yarns, creel), creel=creel)


def _named_apart(yarns: tuple[Yarn, ...], creel: tuple[int, ...]) -> tuple[Yarn, ...]:
    """The yarns; one that is there again is named by its position."""
    return tuple(
        replace(yarn, name=f"{yarn.name} (creel {position})") if yarn in yarns[:place] else yarn
        for place, (yarn, position) in enumerate(zip(yarns, creel, strict=True))
    )
