"""A part of a chart as a chart of its own: the strike-off, a sample that is woven before the carpet.

The sample is cut where the design's colours meet: of all windows the one with the most yarns, of these the one with
the most knots beside one of another yarn.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ilmek.arrays import IntArray
from ilmek.carpet.chart import Chart
from ilmek.carpet.overlay import no_overlay
from ilmek.carpet.sizes import CarpetSize

SAMPLE = 0.30
"""Side of a strike-off [m]."""

_STEPS = 48
"""Windows along each side that are compared, at most."""


class SampleWindow(NamedTuple):
    """A part of a chart: its first row from the top and first column, its rows and columns."""

    top: int
    left: int
    rows: int
    columns: int


def strike_off_window(chart: Chart, width: float = SAMPLE, length: float = SAMPLE) -> SampleWindow:
    """Where the colours of a chart meet, as a window of a width and a length [m], cut off at the chart's edges.

    >>> from ilmek import read_yarns
    >>> knots = [[0] * 12 for _ in range(12)]
    >>> knots[9][10] = 1
    >>> strike_off_window(Chart(knots, read_yarns()[:2], "12x12cm", "10x10/dm", "symmetric"), 0.04, 0.04)
    SampleWindow(top=7, left=8, rows=4, columns=4)
    """
    rows, columns = (
        max(2, min(whole, round(side * density)))
        for side, whole, density in (
            (length, chart.rows, chart.quality.along),
            (width, chart.columns, chart.quality.across),
        )
    )
    tops, lefts = _starts(chart.rows - rows), _starts(chart.columns - columns)
    present = sum((_sums(chart.knots == yarn, tops, lefts, rows, columns) > 0 for yarn in chart.used), start=0)
    edges = np.zeros(chart.knots.shape, dtype=np.uint8)
    tied = chart.knots < len(chart.yarns)
    edges[:, 1:] += (chart.knots[:, 1:] != chart.knots[:, :-1]) & tied[:, 1:] & tied[:, :-1]
    edges[1:] += (chart.knots[1:] != chart.knots[:-1]) & tied[1:] & tied[:-1]
    score = np.asarray(present, dtype=np.int64) * (2 * rows * columns + 1)
    score += _sums(edges, tops, lefts, rows, columns)
    top, left = np.unravel_index(int(score.argmax()), score.shape)
    return SampleWindow(int(tops[top]), int(lefts[left]), rows, columns)


def _starts(last: int) -> IntArray:
    return np.unique(np.linspace(0, last, min(last + 1, _STEPS)).round().astype(np.int64))


def _sums(cells: np.ndarray, tops: IntArray, lefts: IntArray, rows: int, columns: int) -> IntArray:
    """The sum of the cells in each window."""
    table = np.zeros((cells.shape[0] + 1, cells.shape[1] + 1), dtype=np.int64)
    np.cumsum(np.cumsum(cells, axis=0, dtype=np.int64), axis=1, out=table[1:, 1:])
    low, right = np.ix_(tops + rows, lefts), np.ix_(tops, lefts + columns)
    whole: IntArray = (
        table[np.ix_(tops + rows, lefts + columns)] - table[low] - table[right] + table[np.ix_(tops, lefts)]
    )
    return whole


def part_of(chart: Chart, window: SampleWindow, name: str = "") -> Chart:
    """The part of a chart in a window, without half knots and jufti knots; name: of its size."""
    top, left, rows, columns = window
    size = CarpetSize(columns / chart.quality.across, rows / chart.quality.along, name)
    inside = np.s_[top : top + rows, left : left + columns]
    knots = np.ascontiguousarray(chart.knots[inside])
    cells = None if chart.cells is None else replace(chart.cells, index=chart.cells.index[inside]).merged()
    reading = replace(chart.reading, matches=(), lost=(), differences=(), proposed=(), edits=(), edges_kept=None)
    return replace(
        chart, knots=knots, size=size, overlay=no_overlay(), cells=cells, reading=replace(reading, detail_kept=None)
    )
