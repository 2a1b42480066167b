"""Creel of an indexed drawing: each index of its palette is a position of the creel, also where two have one colour.

The designer of an indexed picture numbers the yarns: index 2 is the yarn on position 2, whatever colour is shown. A
chart by colours alone would merge two positions that look alike, and would sort the others by the yarn list.
"""

from dataclasses import replace

import numpy as np

from ilmek.arrays import Indices
from ilmek.carpet.chart import Chart, rearranged
from ilmek.carpet.codes import CODES, pairs_of_codes, recoded
from ilmek.carpet.design import bands
from ilmek.carpet.yarn import MOST_YARNS, Yarn

MOST_POSITIONS = 64
"""Largest number of indices that are taken for positions of a creel; pictures with more are reduced photos."""


def in_creel_order(chart: Chart, indices: Indices, obstacle: str = "") -> Chart | str:
    """The chart with a yarn for each index of the picture that it was made from, in the order of the indices; or why
    the indices are not the positions of the creel, "" where the picture has more than MOST_POSITIONS.

    indices   of the picture's pixels, a whole number of them along and across each knot
    obstacle  why they cannot be kept whatever the chart is
    A yarn that several indices have is there for each of them, under one number; from the second on its name has the
    position. Unused yarns of the list follow, on the positions that are free.

    >>> from ilmek import read_yarns
    >>> made = in_creel_order(Chart([[0, 1], [1, 1]], read_yarns()[:2], "4x4cm", "5x5/dm", "symmetric"),
    ...                       np.array([[7, 0], [2, 0]], dtype=np.uint8))
    >>> made.positions, made.knots.tolist(), [yarn.number for yarn in made.yarns]
    ((0, 2, 7), [[2, 0], [1, 0]], [2, 2, 1])
    """
    scale = indices.shape[0] // chart.rows
    if not obstacle and chart.reading.kind != "exact":
        obstacle = f"the picture is read as {chart.reading.kind}, not knot by knot"
    if not obstacle and (scale < 1 or indices.shape != (scale * chart.rows, scale * chart.columns)):
        obstacle = "the knots are not its pixels"
    if obstacle:
        counts = sum(np.bincount(indices[band].ravel(), minlength=CODES) for band in bands(*indices.shape))
        return obstacle if np.count_nonzero(counts) <= MOST_POSITIONS else ""
    indices = np.ascontiguousarray(indices[::scale, ::scale])
    used, yarn_of = pairs_of_codes(indices, chart.knots).T
    positions = len(np.unique(used))
    if positions > MOST_POSITIONS:
        return ""
    if positions < len(used):
        return "knots of one index have several yarns"
    order = [*yarn_of.tolist(), *(yarn for yarn in range(len(chart.yarns)) if yarn not in yarn_of)][:MOST_YARNS]
    free = (position for position in range(CODES) if position not in used)
    creel = (*used.tolist(), *(next(free) for _ in order[len(used) :]))
    rank = np.zeros(CODES, dtype=np.uint8)
    rank[used] = np.arange(len(used))
    made = rearranged(chart, order, recoded(indices, rank))
    return replace(made, yarns=_named_apart(made.yarns, creel), creel=creel)


def _named_apart(yarns: tuple[Yarn, ...], creel: tuple[int, ...]) -> tuple[Yarn, ...]:
    """The yarns; one that is there again is named by its position."""
    return tuple(
        replace(yarn, name=f"{yarn.name} (creel {position})") if yarn in yarns[:place] else yarn
        for place, (yarn, position) in enumerate(zip(yarns, creel, strict=True))
    )
