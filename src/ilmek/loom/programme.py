"""The loom's programme: which head ties which colour at which warp pair, in which order, and how long it takes.

    time = sum over rows of ( wefts + sum over halves of max over heads of their part's time )

Rows are woven from the carpet's bottom edge upward: loom row 0 is the chart's last row.
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray, Indices, IntArray, UInt8
from ilmek.errors import LoomError
from ilmek.loom.row import KnotRow
from ilmek.loom.schedule import ByteTable, Layout, ScheduleResult, schedule
from ilmek.loom.sharing import halves, share
from ilmek.records import record
from ilmek.units import format_number, hour

MOST_YARNS = 255
_ROUNDING = 1 + 1e-9
"""A deadline is met up to the rounding of a sum over many rows."""


@dataclass(frozen=True, slots=True)
class Times:
    """What each act of the loom takes [s].

    knot           one turn of a head's cam shaft, with the step to the next warp pair
    colour_change  the head stands while the tube of another colour comes in line
    travel         each knot pitch that the carriage moves beyond that step
    weft           the two wefts and beats after a row of knots

    Raises LoomError where a time is negative or not finite, or the knot takes none.
    """

    knot: float
    colour_change: float
    travel: float
    weft: float

    def __post_init__(self) -> None:
        for name, value in zip(self.__slots__, self.as_tuple(), strict=True):
            if not (math.isfinite(value) and value >= 0) or (name == "knot" and value == 0):
                raise LoomError(
                    f"time of {name.replace('_', ' ')} {value:g} s", allowed="a finite time, above 0 s a knot"
                )

    def as_tuple(self) -> tuple[float, float, float, float]:
        """(knot, colour change, travel, weft) as the kernels take them."""
        return float(self.knot), float(self.colour_change), float(self.travel), float(self.weft)


@record
class HeadWork:
    """What each head does over the whole carpet: arrays over the heads.

    changes  colour changes    travel  knot pitches moved    passes  parts tied colour by colour    busy  [s]
    """

    knots: IntArray
    changes: IntArray
    travel: IntArray
    passes: IntArray
    busy: FloatArray


@record
class Programme:
    """A carpet as a loom weaves it.

    knots      chart, row 0 = top          yarns  length of the yarn list        edges  see `loom.sharing`
    keys       uint8 (rows, parts, 3), loom row first: order, first and last colour, see `loom.schedule`
    row_times  of each loom row, wefts included [s]
    """

    knots: Indices
    yarns: int
    heads: int
    times: Times
    edges: IntArray
    keys: UInt8[np.ndarray, "rows parts 3"]
    row_times: FloatArray
    work: HeadWork

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
        """Weaving time of the whole carpet [s]."""
        return float(self.row_times.sum())

    def row(self, number: int) -> KnotRow:
        """Loom row `number`, 0 at the carpet's bottom edge. Raises LoomError beyond the carpet."""
        if not 0 <= number < self.rows:
            raise LoomError(f"row {number}", allowed=f"rows 0 to {self.rows - 1}")
        return KnotRow(number, self.knots[self.rows - 1 - number], self.keys[number], self.edges, self.heads)


def make_programme(knots: Indices, yarns: int, heads: int, times: Times) -> Programme:
    """The programme of a chart of indices below `yarns`, for a number of heads.

    Raises LoomError for an empty chart, more than 255 yarns, a knot of no yarn, or more heads than half the knots.
    """
    _require_chart(knots, yarns)
    edges = share(knots.shape[1], heads)
    keys = np.zeros((knots.shape[0], len(edges) - 1, 3), np.uint8)
    outcome, _ = _run(knots, Layout(yarns, heads, edges), times, keys, math.inf)
    counted = outcome.work
    work = HeadWork(counted[:, 0], counted[:, 1], counted[:, 2], counted[:, 3], outcome.busy)
    return Programme(knots, yarns, heads, times, edges, keys, outcome.row_times, work)


def weaving_time(knots: Indices, yarns: int, heads: int, times: Times, deadline: float = math.inf) -> float:
    """Weaving time [s] without the programme; where it exceeds the deadline, some lower bound above the deadline."""
    _require_chart(knots, yarns)
    layout = Layout(yarns, heads, share(knots.shape[1], heads))
    return _run(knots, layout, times, np.zeros((0, 1, 3), np.uint8), deadline)[1]


def least_time(rows: int, columns: int, heads: int, times: Times) -> float:
    """The time without any colour change or idle move [s]: no chart of this size is woven sooner."""
    return rows * _least_row(share(columns, heads), heads, times)


def heads_for(knots: Indices, yarns: int, deadline: float, times: Times, heads_max: int) -> int:
    """The smallest number of heads, up to `heads_max`, that weaves the chart within the deadline [s].

    Numbers whose least time is too long are passed over without a look at the knots; a trial is given up as soon as
    the rows left cannot make good what it lost. Raises LoomError saying why no number does.
    """
    _require_chart(knots, yarns)
    rows, columns = knots.shape
    _require_wefts(rows, deadline, times)
    for heads in range(1, heads_max + 1):
        if least_time(rows, columns, heads, times) > deadline * _ROUNDING:
            continue
        if weaving_time(knots, yarns, heads, times, deadline) <= deadline * _ROUNDING:
            return heads
    reached = weaving_time(knots, yarns, heads_max, times)
    raise LoomError(
        f"the deadline of {_hours(deadline)} cannot be met",
        allowed=f"{heads_max} heads are all that fit this width; they weave it in {_hours(reached)}",
        do="give more time, a coarser quality, a quicker knot or narrower heads",
    )


def _run(
    knots: Indices, layout: Layout, times: Times, keys: ByteTable, deadline: float
) -> tuple[ScheduleResult, float]:
    heads = layout.heads
    outcome = ScheduleResult(keys, np.zeros(knots.shape[0]), np.zeros((heads, 4), np.int64), np.zeros(heads))
    limits = (deadline * _ROUNDING, _least_row(layout.edges, heads, times))
    total = schedule(np.ascontiguousarray(knots), layout, times.as_tuple(), limits, outcome)
    return outcome, float(total)


def _least_row(edges: IntArray, heads: int, times: Times) -> float:
    """Wefts and the widest part of each half, knots only [s]."""
    widest = np.diff(edges).reshape(heads, halves(heads)).max(axis=0)
    return times.weft + float(widest.sum()) * times.knot


def _require_chart(knots: Indices, yarns: int) -> None:
    if knots.size == 0:
        raise LoomError("a chart without knots", allowed="at least one row of one knot")
    if not 1 <= yarns <= MOST_YARNS:
        raise LoomError(f"{yarns} yarns", allowed=f"1 to {MOST_YARNS}")
    if int(knots.max()) >= yarns:
        raise LoomError(f"a knot of yarn {int(knots.max())}", allowed=f"the list has yarns 0 to {yarns - 1}")


def _require_wefts(rows: int, deadline: float, times: Times) -> None:
    wefts = rows * times.weft
    if wefts >= deadline:
        raise LoomError(
            f"the deadline of {_hours(deadline)} cannot be met by any number of heads",
            allowed=f"the wefts and beats of {rows} rows alone take {_hours(wefts)}",
            do="give more time, fewer rows or quicker wefts",
        )


def _hours(seconds: float) -> str:
    return f"{format_number(seconds / hour, 3)} h"
