"""The loom's programme: head, colour and warp pair of every knot, in order, and the weaving time.

    time = sum over rows of ( wefts + sum over halves of max over heads of their part's time ) + stops

Stops: changes of the bobbins of weft (`loom.bobbins`).

Rows are woven from the carpet's bottom edge upward: loom row 0 is the chart's last row.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray, Indices, IntArray, UInt8
from ilmek.carpet.design import MOST_KNOTS
from ilmek.carpet.quality import FINEST
from ilmek.carpet.sizes import LARGEST
from ilmek.carpet.yarn import MOST_YARNS
from ilmek.errors import LoomError
from ilmek.loom.account import HeadWork
from ilmek.loom.bobbins import Bobbin, ChangeStop, change_stops, stop_time
from ilmek.loom.row import KnotRow
from ilmek.loom.schedule import NONE, ByteTable, Layout, RowSpan, ScheduleResult, schedule
from ilmek.loom.sharing import MOST_HEADS, halves, require_whole, share
from ilmek.progress import SILENT, Progress
from ilmek.records import record

MOST_PER_SIDE = round(LARGEST * FINEST)
"""Largest number of rows, and of knots in a row: the largest carpet in the finest quality."""

LONGEST_TIME = 1e9
"""Largest time of an operation of the loom [s], 32 years: sums over the largest carpet stay exact to 1 ms."""

_SLICE = 4_000_000
"""Knots, and colours of parts, that the kernel counts in one call: about 0.1 s, so that it can be cancelled."""

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
        """(knot, colour change, travel, weft) [s], for the compiled functions."""
        return float(self.knot), float(self.colour_change), float(self.travel), float(self.weft)


@record
class Programme:
    """The programme of a carpet.

    knots      chart, row 0 = top          yarns  length of the yarn list        edges  see `loom.sharing`
    keys       uint8 (rows, parts, 3), loom row first: order, first and last colour, see `loom.schedule`
    row_times  of each loom row, wefts included [s]
    bobbins    of weft: when each is changed
    """

    knots: Indices
    yarns: int
    heads: int
    times: Times
    edges: IntArray
    keys: UInt8[np.ndarray, "rows parts 3"]
    row_times: FloatArray
    work: HeadWork
    bobbins: tuple[Bobbin, ...] = ()

    @property
    def rows(self) -> int:
        """Rows of knots."""
        return int(self.knots.shape[0])

    @property
    def columns(self) -> int:
        """Knots in a row."""
        return int(self.knots.shape[1])

    @property
    def duration(self) -> float:
        """Weaving time of the whole carpet [s], stops included."""
        return float(self.row_times.sum()) + stop_time(self.bobbins, self.rows)

    @property
    def stops(self) -> tuple[ChangeStop, ...]:
        """The stops in which bobbins of weft are changed."""
        return change_stops(self.bobbins, self.rows)

    def row(self, number: int) -> KnotRow:
        """Loom row `number`, 0 at the carpet's bottom edge. Raises LoomError beyond the carpet."""
        if not 0 <= number < self.rows:
            raise LoomError(f"row {number}", allowed=f"rows 0 to {self.rows - 1}")
        return KnotRow(number, self.knots[self.rows - 1 - number], self.keys[number], self.edges, self.heads)


def make_programme(
    knots: Indices,
    yarns: int,
    heads: int,
    times: Times,
    *,
    bobbins: Sequence[Bobbin] = (),
    progress: Progress = SILENT,
) -> Programme:
    """The programme of a chart for a number of heads.

    knots    indices of yarns, below `yarns`, (rows, columns), row 0 = top
    bobbins  of weft
    Raises LoomError for an empty chart, one of another kind than uint8 or of more than MOST_KNOTS knots or
    MOST_PER_SIDE on a side, more than 255 yarns, an index of no yarn, and more heads than half the knots of a row.
    """
    _require_chart(knots, yarns)
    edges = share(knots.shape[1], heads)
    keys = np.zeros((knots.shape[0], len(edges) - 1, 3), np.uint8)
    outcome, _ = _run(knots, Layout(yarns, heads, edges), times, keys, math.inf, progress=progress)
    counted = outcome.work
    work = HeadWork(counted[:, 0], counted[:, 1], counted[:, 2], counted[:, 3], outcome.busy)
    return Programme(knots, yarns, heads, times, edges, keys, outcome.row_times, work, tuple(bobbins))


def weaving_time(
    knots: Indices,
    yarns: int,
    heads: int,
    times: Times,
    deadline: float = math.inf,
    *,
    bobbins: Sequence[Bobbin] = (),
    progress: Progress = SILENT,
) -> float:
    """Weaving time [s], stops included, without the programme.

    Beyond the deadline [s], a lower bound that exceeds the deadline.
    """
    _require_chart(knots, yarns)
    layout = Layout(yarns, heads, share(knots.shape[1], heads))
    stops = stop_time(bobbins, knots.shape[0])
    return stops + _run(knots, layout, times, np.zeros((0, 1, 3), np.uint8), deadline - stops, progress=progress)[1]


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
    progress: Progress = SILENT,
) -> int | None:
    """The smallest number of heads, up to `heads_max`, that weaves the chart within the deadline [s], stops included.

    Numbers whose least time exceeds the deadline are skipped. A trial ends as soon as its remaining rows cannot meet
    the deadline. None: no number meets it.
    """
    _require_chart(knots, yarns)
    require_whole("heads", heads_max, MOST_HEADS)
    rows, columns = knots.shape
    left = deadline - stop_time(bobbins, rows)
    for heads in range(1, heads_max + 1):
        if least_time(rows, columns, heads, times) > left * _ROUNDING:
            continue
        trial = progress.part((heads - 1) / heads_max, heads / heads_max)
        if weaving_time(knots, yarns, heads, times, left, progress=trial) <= left * _ROUNDING:
            return heads
    return None


def _run(
    knots: Indices, layout: Layout, times: Times, keys: ByteTable, deadline: float, *, progress: Progress
) -> tuple[ScheduleResult, float]:
    """The filled result and the weaving time [s]; beyond the deadline, a lower bound that exceeds it."""
    (rows, columns), heads = knots.shape, int(layout.heads)
    layout = Layout(int(layout.yarns), heads, layout.edges)
    work, handler = np.zeros((heads, 4), np.int64), np.full(heads, NONE, np.int64)
    outcome = ScheduleResult(keys, np.zeros(rows), work, np.zeros(heads), handler)
    latest, least_row = deadline * _ROUNDING, float(_least_row(layout.edges, heads, times))
    chart, total = np.ascontiguousarray(knots), 0.0
    step = max(1, _SLICE // (columns + len(layout.edges) * layout.yarns))
    for first in range(0, rows, step):
        last = min(first + step, rows)
        span = RowSpan(first, last, total, latest, least_row)
        total = float(schedule(chart, layout, times.as_tuple(), span, outcome))
        if total > latest:
            break
        progress(last / rows)
    return outcome, total


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
