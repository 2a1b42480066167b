"""The loom's programme: tube and warp pair of every knot of every head, in order, and the weaving time.

    time = sum over rows of ( wefts + sum over phases of max over heads of their part's time ) + stops

Rows are woven from the carpet's bottom edge upward: loom row 0 is the chart's last row. Tubes and stops come first
(`loom.tube_plan`), then the order of every part (`loom.order`); the time is that of the explicit operations
(`loom.account`).
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ilmek.arrays import FloatArray, Indices, Int64, IntArray, UInt8
from ilmek.carpet.design import MOST_KNOTS
from ilmek.carpet.quality import FINEST
from ilmek.carpet.sizes import LARGEST
from ilmek.carpet.yarn import MOST_YARNS
from ilmek.errors import LoomError
from ilmek.loom.account import HeadWork, account_row
from ilmek.loom.bobbins import Bobbin, stop_time
from ilmek.loom.bound import BoundState, add_rows
from ilmek.loom.operations import Stop
from ilmek.loom.order import FORESIGHT, plan
from ilmek.loom.replay import NONE, SWEEP_LEFT, SWEEP_RIGHT, Bytes, Layout, expand
from ilmek.loom.sharing import MOST_HEADS, halves, require_whole, share
from ilmek.loom.tube_plan import TubePlan, YarnSupply, most_colours, plan_tubes
from ilmek.num.compiled import compiled
from ilmek.progress import SILENT, Progress
from ilmek.records import record

MOST_PER_SIDE = round(LARGEST * FINEST)
"""Largest number of rows, and of knots in a row: the largest carpet in the finest quality."""

LONGEST_TIME = 1e9
"""Largest time of an operation of the loom [s], 32 years: sums over the largest carpet stay exact to 1 ms."""

_SLICE = 500_000
"""Knots that the kernels plan in one call: about 0.1 s, so that it can be cancelled."""

_ROUNDING = 1 + 1e-9
"""A deadline is met up to the rounding of a sum over many rows."""


@dataclass(frozen=True, slots=True)
class Times:
    """Times of the loom's operations [s].

    knot           one turn of a head's cam shaft, including the step to the next warp pair
    colour_change  standstill of the head while the tube of another colour is aligned
    travel         travel by one knot pitch beyond that step
    weft           the two wefts and beats after a row of knots

    Raises LoomError for a time that is negative or above LONGEST_TIME, and for a knot time of 0.
    """

    knot: float
    colour_change: float
    travel: float
    weft: float

    def __post_init__(self) -> None:
        for name, value in zip(self.__slots__, self.as_tuple(), strict=True):
            if not 0 <= value <= LONGEST_TIME or (name == "knot" and value == 0):
                raise LoomError(
                    f"time of {name.replace('_', ' ')} {value:g} s",
                    allowed=f"a finite time up to {LONGEST_TIME:g} s, above 0 s for a knot",
                )

    def as_tuple(self) -> tuple[float, float, float, float]:
        """(knot, colour change, travel, weft) [s]."""
        return float(self.knot), float(self.colour_change), float(self.travel), float(self.weft)


@record
class Naive:
    """The order without a choice, row by row as the chart has them: its time with all stops [s] and colour changes."""

    time: float
    changes: int


@record
class Programme:
    """The programme of a carpet.

    knots      chart, row 0 = top          yarns  length of the yarn list        edges  see `loom.sharing`
    keys       uint8 (rows, parts, 4), loom row first: the order of every part, see `loom.replay`
    row_times  of each loom row, wefts included [s]
    bobbins    of weft: when each is changed
    tubes      which yarn is in which tube of a head when
    tube_change  time to change a package of pile yarn in a stop [s]
    bound      least time of any order with the same parts and tubes, with all stops [s]
    """

    knots: Indices
    yarns: int
    heads: int
    times: Times
    edges: IntArray
    keys: UInt8[np.ndarray, "rows parts 4"]
    row_times: FloatArray
    work: HeadWork
    bobbins: tuple[Bobbin, ...]
    tubes: TubePlan
    tube_change: float
    bound: float
    naive: Naive

    @property
    def rows(self) -> int:
        """Rows of knots."""
        return int(self.knots.shape[0])

    @property
    def columns(self) -> int:
        """Knots in a row."""
        return int(self.knots.shape[1])

    @property
    def stop_time(self) -> float:
        """Time of all stops [s]."""
        return _stop_time(self.tubes, self.bobbins, self.rows, self.tube_change)

    @property
    def duration(self) -> float:
        """Weaving time of the whole carpet [s], stops included."""
        return float(self.row_times.sum()) + self.stop_time

    @property
    def stops(self) -> tuple[Stop, ...]:
        """The stops in which bobbins of weft and packages of pile yarn are changed."""
        return self.tubes.stops(self.bobbins, self.rows)


def make_programme(
    knots: Indices,
    yarns: int,
    heads: int,
    times: Times,
    *,
    bobbins: Sequence[Bobbin] = (),
    supply: YarnSupply | None = None,
    tube_change: float = 0.0,
    progress: Progress = SILENT,
) -> Programme:
    """The programme of a chart for a number of heads.

    knots    indices of yarns, below `yarns`, (rows, columns), row 0 = top
    bobbins  of weft
    supply   tubes and packages of the heads; default: a tube for each yarn, with packages that never run out
    Raises LoomError for an empty chart, one of another kind than uint8 or of more than MOST_KNOTS knots or
    MOST_PER_SIDE on a side, more than 255 yarns, an index of no yarn, more heads than half the knots of a row, and as
    `plan_tubes`.
    """
    _require_chart(knots, yarns)
    tubes = plan_tubes(knots, heads, supply or YarnSupply.endless(yarns), bobbins)
    making = _Making(knots, heads, times, tubes, compared=True)
    for share_done in making.slices(math.inf):
        progress(share_done)
    stops = _stop_time(tubes, bobbins, knots.shape[0], tube_change)
    ends = knots.shape[0] * times.weft
    return Programme(
        knots,
        yarns,
        heads,
        times,
        making.layout.edges,
        making.keys,
        making.row_times,
        making.work,
        tuple(bobbins),
        tubes,
        tube_change,
        ends + making.bound.time(times.colour_change) + stops,
        Naive(float(making.naive_times.sum()) + stops, int(making.naive_work[:, 1].sum())),
    )


def weaving_time(
    knots: Indices,
    yarns: int,
    heads: int,
    times: Times,
    deadline: float = math.inf,
    *,
    bobbins: Sequence[Bobbin] = (),
    supply: YarnSupply | None = None,
    tube_change: float = 0.0,
    progress: Progress = SILENT,
) -> float:
    """Weaving time [s], stops included, without the programme; inf where a part has more colours than a head tubes.

    Beyond the deadline [s], a lower bound that exceeds the deadline. Raises LoomError as `make_programme`.
    """
    _require_chart(knots, yarns)
    supply = supply or YarnSupply.endless(yarns)
    if supply.tubes < yarns and most_colours(knots, yarns, heads) > supply.tubes:
        return math.inf
    tubes = plan_tubes(knots, heads, supply, bobbins)
    stops = _stop_time(tubes, bobbins, knots.shape[0], tube_change)
    making = _Making(knots, heads, times, tubes, compared=False)
    for share_done in making.slices(deadline - stops):
        progress(share_done)
    return stops + making.total


def least_time(rows: int, columns: int, heads: int, times: Times, bobbins: Sequence[Bobbin] = ()) -> float:
    """Weaving time [s] without colour changes and idle travel: the lower bound for a chart of this size."""
    return rows * _least_row(share(columns, heads), heads, times) + stop_time(bobbins, rows)


def least_heads(
    knots: Indices,
    yarns: int,
    deadline: float,
    times: Times,
    heads_max: int,
    *,
    bobbins: Sequence[Bobbin] = (),
    supply: YarnSupply | None = None,
    tube_change: float = 0.0,
    progress: Progress = SILENT,
) -> int | None:
    """The smallest number of heads, up to `heads_max`, that weaves the chart within the deadline [s], stops included.

    Numbers whose least time exceeds the deadline are skipped. A trial ends as soon as its remaining rows cannot meet
    the deadline. None: no number meets it.
    """
    _require_chart(knots, yarns)
    require_whole("heads", heads_max, MOST_HEADS)
    rows, columns = knots.shape
    for heads in range(1, heads_max + 1):
        if least_time(rows, columns, heads, times, bobbins) > deadline * _ROUNDING:
            continue
        trial = progress.part((heads - 1) / heads_max, heads / heads_max)
        more: Any = {"bobbins": bobbins, "supply": supply, "tube_change": tube_change, "progress": trial}
        if weaving_time(knots, yarns, heads, times, deadline, **more) <= deadline * _ROUNDING:
            return heads
    return None


class _Making:
    """Plans a carpet slice by slice.

    compared  whether the bound and the naive order are computed beside the planned one
    total     time of the rows so far [s]; beyond a deadline, a lower bound that exceeds it
    """

    def __init__(self, knots: Indices, heads: int, times: Times, tubes: TubePlan, *, compared: bool) -> None:
        rows, columns = knots.shape
        self._knots, self._times, self._tubes, self._compared = knots, times, tubes, compared
        self.layout = Layout(heads, share(columns, heads))
        self.keys = np.zeros((rows if compared else 0, len(self.layout.edges) - 1, 4), np.uint8)
        self._tube, self._naive_tube = np.full(heads, -1, np.int64), np.full(heads, -1, np.int64)
        self._busy, self._counted = np.zeros(heads), np.zeros((heads, 4), np.int64)
        self.row_times, self.naive_times = np.zeros(rows), np.zeros(rows)
        self.naive_work, self.bound = np.zeros((heads, 4), np.int64), BoundState.before(heads)
        self.total = 0.0

    @property
    def work(self) -> HeadWork:
        """The work of the heads so far."""
        knots, changes, travel, passes = self._counted.T
        return HeadWork(knots, changes, travel, passes, self._busy)

    def slices(self, deadline: float) -> Iterator[float]:
        """Plan all rows, or until they cannot be woven within the deadline [s]; yields the share that is planned."""
        rows, columns = self._knots.shape
        least_row = float(_least_row(self.layout.edges, int(self.layout.heads), self._times))
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
            if self.total + (rows - last) * least_row > deadline * _ROUNDING:
                self.total += (rows - last) * least_row
                return
            yield last / rows

    def _account(self, lines: Bytes, first: int, keys: Bytes) -> None:
        of_row = row_counts(self.layout.edges, self.layout.heads)
        times = self._times.as_tuple()
        _account(
            lines, self.layout, first, keys, of_row, times, (self._tube, self._counted, self._busy), self.row_times
        )

    def _compare(self, lines: Bytes, first: int) -> None:
        """Add rows to the bound, and to the time of the naive order."""
        add_rows(lines, self.layout, first, self._times.as_tuple(), self.bound)
        rows, parts = len(lines), len(self.layout.edges) - 1
        keys = np.zeros((rows, parts, 4), np.uint8)
        keys[:, :, 0] = np.where((first + np.arange(rows)) % 2 == 0, SWEEP_RIGHT, SWEEP_LEFT)[:, None]
        of_row, sums = row_counts(self.layout.edges, self.layout.heads), (self._naive_tube, self.naive_work)
        _account(
            lines,
            self.layout,
            first,
            keys,
            of_row,
            self._times.as_tuple(),
            (*sums, self._busy.copy()),
            self.naive_times,
        )


def row_counts(edges: IntArray, heads: int) -> Int64[np.ndarray, "2 heads phases"]:
    """Knots of each head in each phase of an even row, and of an odd one."""
    widths = np.diff(edges).reshape(heads, halves(heads))
    return np.ascontiguousarray(np.stack([widths, widths[:, ::-1]]), np.int64)


@compiled
def _account(  # noqa: PLR0917 - the arrays of a kernel
    lines: Bytes,
    layout: Layout,
    first: int,
    keys: Bytes,
    of_row: IntArray,
    times: tuple[float, float, float, float],
    sums: tuple[IntArray, IntArray, FloatArray],
    row_times: FloatArray,
) -> None:
    """Times of rows by their explicit operations; adds to the work of the heads."""
    columns, tubes = np.empty(lines.shape[1], np.int32), np.empty(lines.shape[1], np.uint8)
    acts = (times[0], times[1], times[2])
    for row in range(lines.shape[0]):
        number = first + row
        expand(lines[row], layout, number % 2 == 0, keys[row], columns)
        for k in range(columns.shape[0]):
            tubes[k] = lines[row, columns[k]]
        phases = account_row(columns, tubes, of_row[number % 2], acts, sums[0], sums[1], sums[2])
        row_times[number] = times[3] + phases


def _stop_time(tubes: TubePlan, bobbins: Sequence[Bobbin], rows: int, tube_change: float) -> float:
    """Time of all stops [s]."""
    return stop_time(bobbins, rows) + len(tubes.changes) * tube_change


def _least_row(edges: IntArray, heads: int, times: Times) -> float:
    """Least time of a row [s]: wefts, and the knots of the widest part of each half."""
    widest = np.diff(edges).reshape(heads, halves(heads)).max(axis=0)
    return times.weft + float(widest.sum()) * times.knot


def _require_chart(knots: Indices, yarns: int) -> None:
    if knots.dtype != np.uint8 or knots.ndim != 2:
        raise LoomError(
            f"a chart of {knots.ndim} dimensions of {knots.dtype}", allowed="indices of yarns, uint8 (rows, columns)"
        )
    if knots.size == 0:
        raise LoomError("a chart without knots", allowed="at least one knot")
    if max(knots.shape) > MOST_PER_SIDE or knots.size > MOST_KNOTS:
        raise LoomError(
            f"a chart of {knots.shape[1]} x {knots.shape[0]} knots",
            allowed=f"at most {MOST_PER_SIDE} on a side and {MOST_KNOTS // 1_000_000} million in all",
        )
    require_whole("yarns", yarns, MOST_YARNS)
    if int(knots.max()) >= yarns:
        raise LoomError(f"a knot of yarn {int(knots.max())}", allowed=f"the list has yarns 0 to {yarns - 1}")
