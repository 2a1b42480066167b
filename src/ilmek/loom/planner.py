"""Plans the rows of a carpet slice by slice: the order of every part, and the time of the explicit operations.

A part of a row may be divided into blocks of equal width, which its head ties one after the other in the direction of
the row; each has an order of its own, a sweep or passes (`loom.order`). In a wide part passes travel less so. The
number of blocks is that of the least time on a sample of the rows.
"""

import math
from collections.abc import Iterator

import numpy as np

from ilmek.arrays import FloatArray, Indices, IntArray
from ilmek.loom.account import HeadWork, account_row
from ilmek.loom.bound import BoundState, add_rows
from ilmek.loom.order import FORESIGHT, plan
from ilmek.loom.replay import NONE, SWEEP_LEFT, SWEEP_RIGHT, Bytes, Layout, expand
from ilmek.loom.sharing import halves, share
from ilmek.loom.times import Times
from ilmek.loom.tube_plan import TubePlan
from ilmek.num.compiled import compiled

_SLICE = 500_000
"""Knots that the kernels plan in one call: about 0.1 s, so that it can be cancelled."""

ROUNDING = 1 + 1e-9
"""A deadline is met up to the rounding of a sum over many rows."""


BLOCKS = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32)
"""Numbers of blocks of a part that are tried."""

_NARROWEST = 6
"""Least width of a block, in knots."""

_SAMPLE, _SPANS = 200_000, 4
"""Knots of the sample on which numbers of blocks are compared, and the spans of rows in which it is taken."""


class CarpetPlanner:
    """Plans a carpet slice by slice.

    compared  whether the bound and the naive order are computed beside the planned one
    total     time of the rows so far [s]; beyond a deadline, a lower bound that exceeds it
    """

    def __init__(self, knots: Indices, heads: int, times: Times, tubes: TubePlan, *, compared: bool) -> None:
        rows, columns = knots.shape
        self._knots, self._times, self._tubes, self._compared = knots, times, tubes, compared
        self.parts = Layout(heads, share(columns, heads))
        self.blocks = chosen_blocks(knots, self.parts, times, tubes)
        self.layout = Layout(heads, divided(self.parts.edges, self.blocks))
        self.keys = np.zeros((rows if compared else 0, len(self.layout.edges) - 1, 4), np.uint8)
        self._tube, self._naive_tube = np.full(heads, -1, np.int64), np.full(heads, -1, np.int64)
        self._busy, self._counted = np.zeros(heads), np.zeros((heads, 4), np.int64)
        self.row_times, self.naive_times = np.zeros(rows), np.zeros(rows)
        self.naive_work, self.bound = np.zeros((heads, 4), np.int64), BoundState.before(heads)
        self.total = 0.0
        self._phases = halves(heads)

    @property
    def work(self) -> HeadWork:
        """The work of the heads so far."""
        knots, changes, travel, passes = self._counted.T
        return HeadWork(knots, changes, travel, passes, self._busy)

    def slices(self, deadline: float) -> Iterator[float]:
        """Plan all rows, or until they cannot be woven within the deadline [s]; yields the share that is planned."""
        rows, columns = self._knots.shape
        least = float(least_row(self.parts.edges, int(self.parts.heads), self._times))
        least = self._times.weft if has_bare(self._knots) else least
        stand = np.full((int(self.layout.heads), 2), NONE, np.int64)
        loaded = self._tubes.loading.copy()
        step = max(FORESIGHT, _SLICE // columns)
        for first in range(0, rows, step):
            last = min(first + step, rows)
            ahead = self._tubes.lines(self._knots, first, min(last + FORESIGHT, rows), loaded.copy())
            lines = self._tubes.lines(self._knots, first, last, loaded)
            keys = np.zeros((last - first, len(self.layout.edges) - 1, 4), np.uint8)
            plan(ahead, self.layout, first, last - first, self._times.as_tuple(), stand, keys)
            self._account(lines, first, keys)
            self.total += float(self.row_times[first:last].sum())
            if self._compared:
                self.keys[first:last] = keys
                self._compare(lines, first)
            if self.total + (rows - last) * least > deadline * ROUNDING:
                self.total += (rows - last) * least
                return
            yield last / rows

    def _account(self, lines: Bytes, first: int, keys: Bytes) -> None:
        sums = (self._tube, self._counted, self._busy)
        _account(lines, self.layout, first, keys, self._phases, self._times.as_tuple(), sums, self.row_times)

    def _compare(self, lines: Bytes, first: int) -> None:
        """Add rows to the bound, and to the time of the naive order."""
        add_rows(lines, self.parts, first, self._times.as_tuple(), self.bound)
        rows, parts = len(lines), len(self.parts.edges) - 1
        keys = np.zeros((rows, parts, 4), np.uint8)
        keys[:, :, 0] = np.where((first + np.arange(rows)) % 2 == 0, SWEEP_RIGHT, SWEEP_LEFT)[:, None]
        sums = (self._naive_tube, self.naive_work, self._busy.copy())
        _account(lines, self.parts, first, keys, self._phases, self._times.as_tuple(), sums, self.naive_times)


def divided(edges: IntArray, blocks: int) -> IntArray:
    """Edges of the blocks of parts, from the edges of the parts.

    >>> divided(np.array([0, 4, 9]), 2).tolist()
    [0, 2, 4, 6, 9]
    """
    widths, steps = np.diff(edges), np.arange(blocks)
    return np.append((edges[:-1, None] + widths[:, None] * steps // blocks).ravel(), edges[-1]).astype(np.int64)


def chosen_blocks(knots: Indices, parts: Layout, times: Times, tubes: TubePlan) -> int:
    """The number of blocks of a part with the least time on a sample of the rows."""
    (rows, columns), widest = knots.shape, int(np.diff(parts.edges).min())
    step = max(FORESIGHT, _SAMPLE // _SPANS // columns)
    firsts = np.linspace(0, max(rows - step, 0), _SPANS).astype(int).tolist()
    spans = [(first, min(first + step, rows)) for first in firsts]
    if rows * columns <= _SAMPLE:
        spans = [(0, rows)]
    lines = [tubes.lines(knots, first, last, tubes.loaded(first * tubes.phases - 1)) for first, last in spans]
    best, least = 1, math.inf
    for blocks in BLOCKS:
        if blocks > 1 and widest < blocks * _NARROWEST:
            break
        layout = Layout(parts.heads, divided(parts.edges, blocks))
        spent = sum(_sampled(one, parts, layout, first, times) for one, (first, _) in zip(lines, spans, strict=True))
        if spent < least:
            best, least = blocks, spent
    return best


def _sampled(lines: Bytes, parts: Layout, layout: Layout, first: int, times: Times) -> float:
    """Time of some rows with the layout of their blocks [s]."""
    heads = int(parts.heads)
    keys = np.zeros((len(lines), len(layout.edges) - 1, 4), np.uint8)
    plan(lines, layout, first, len(lines), times.as_tuple(), np.full((heads, 2), NONE, np.int64), keys)
    row_times = np.zeros(first + len(lines))
    sums = (np.full(heads, -1, np.int64), np.zeros((heads, 4), np.int64), np.zeros(heads))
    _account(lines, layout, first, keys, halves(heads), times.as_tuple(), sums, row_times)
    return float(row_times.sum())


def has_bare(knots: Indices) -> bool:
    """Whether a cell of a chart has no knot."""
    return bool((knots == NONE).any())


def least_row(edges: IntArray, heads: int, times: Times) -> float:
    """Least time of a row [s]: wefts, and the knots of the widest part of each half."""
    return times.weft + knots_in_turn(edges, heads) * times.knot


def knots_in_turn(edges: IntArray, heads: int) -> float:
    """Knots of a row that are tied one after the other: those of the widest part of each half."""
    return float(np.diff(edges).reshape(heads, halves(heads)).max(axis=0).sum())


@compiled
def _account(  # noqa: PLR0917 - the arrays of a kernel
    lines: Bytes,
    layout: Layout,
    first: int,
    keys: Bytes,
    phases: int,
    times: tuple[float, float, float, float],
    sums: tuple[IntArray, IntArray, FloatArray],
    row_times: FloatArray,
) -> None:
    """Times of rows by their explicit operations; adds to the work of the heads."""
    columns, tubes = np.empty(lines.shape[1], np.int32), np.empty(lines.shape[1], np.uint8)
    counts = np.zeros((layout.heads, phases), np.int64)
    acts = (times[0], times[1], times[2])
    for row in range(lines.shape[0]):
        number = first + row
        knots = expand(lines[row], layout, number % 2 == 0, keys[row], columns, counts)
        for k in range(knots):
            tubes[k] = lines[row, columns[k]]
        row_times[number] = times[3] + account_row(columns[:knots], tubes, counts, acts, sums[0], sums[1], sums[2])
