"""The loom's programme: tube and warp pair of every knot of every head, in order, and the weaving time.

    time = sum over rows of ( wefts + sum over phases of max over heads of their part's time ) + stops

Rows are woven from the carpet's bottom edge upward: loom row 0 is the chart's last row. Tubes and stops come first
(`loom.tube_plan`), then the order of every part (`loom.order`); the time is that of the explicit operations
(`loom.account`).
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ilmek.arrays import FloatArray, Indices, IntArray, UInt8
from ilmek.carpet.design import MOST_KNOTS
from ilmek.carpet.quality import FINEST
from ilmek.carpet.sizes import LARGEST
from ilmek.carpet.yarn import MOST_YARNS
from ilmek.errors import LoomError
from ilmek.loom.account import HeadWork
from ilmek.loom.bobbins import Bobbin, stop_time
from ilmek.loom.operations import EMPTY, Stop
from ilmek.loom.planner import ROUNDING, CarpetPlanner, has_bare, knots_in_turn
from ilmek.loom.sharing import MOST_HEADS, require_whole, share
from ilmek.loom.times import Times
from ilmek.loom.tube_plan import TubePlan, YarnSupply, most_colours, plan_tubes
from ilmek.progress import SILENT, Progress
from ilmek.records import record

MOST_PER_SIDE = round(LARGEST * FINEST)
"""Largest number of rows, and of knots in a row: the largest carpet in the finest quality."""


@record
class Naive:
    """The order without a choice, row by row as the chart has them: its time with all stops [s] and colour changes."""

    time: float
    changes: int


@record
class Programme:
    """The programme of a carpet.

    knots      chart, row 0 = top          yarns  length of the yarn list        edges  see `loom.sharing`
    keys       uint8 (rows, blocks, 4), loom row first: the order of every block of a part, see `loom.replay`
    blocks     in which every part is divided
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
    keys: UInt8[np.ndarray, "rows blocks 4"]
    blocks: int
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

    knots    indices of yarns, below `yarns`, EMPTY: no knot, (rows, columns), row 0 = top
    bobbins  of weft
    supply   tubes and packages of the heads; default: a tube for each yarn, with packages that never run out
    Raises LoomError for an empty chart, one of another kind than uint8 or of more than MOST_KNOTS knots or
    MOST_PER_SIDE on a side, more than 255 yarns, an index of no yarn, more heads than half the knots of a row, and as
    `plan_tubes`.
    """
    _require_chart(knots, yarns)
    tubes = plan_tubes(knots, heads, supply or YarnSupply.endless(yarns), bobbins)
    making = CarpetPlanner(knots, heads, times, tubes, compared=True)
    for share_done in making.slices(math.inf):
        progress(share_done)
    stops = _stop_time(tubes, bobbins, knots.shape[0], tube_change)
    ends = knots.shape[0] * times.weft
    return Programme(
        knots,
        yarns,
        heads,
        times,
        making.parts.edges,
        making.keys,
        making.blocks,
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
    making = CarpetPlanner(knots, heads, times, tubes, compared=False)
    for share_done in making.slices(deadline - stops):
        progress(share_done)
    return stops + making.total


def least_time(rows: int, columns: int, heads: int, times: Times, bobbins: Sequence[Bobbin] = ()) -> float:
    """Weaving time [s] without colour changes and idle travel: the lower bound for a chart of this size."""
    return least_times(rows, columns, heads, (times,), bobbins)[0]


def least_times(
    rows: int, columns: int, heads: int, times: Sequence[Times], bobbins: Sequence[Bobbin] = ()
) -> list[float]:
    """The same with each of some times."""
    knots, stops = knots_in_turn(share(columns, heads), heads), stop_time(bobbins, rows)
    return [rows * (each.weft + knots * each.knot) + stops for each in times]


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
    (rows, columns), full = knots.shape, not has_bare(knots)
    for heads in range(1, heads_max + 1):
        if full and least_time(rows, columns, heads, times, bobbins) > deadline * ROUNDING:
            continue
        trial = progress.part((heads - 1) / heads_max, heads / heads_max)
        more: Any = {"bobbins": bobbins, "supply": supply, "tube_change": tube_change, "progress": trial}
        if weaving_time(knots, yarns, heads, times, deadline, **more) <= deadline * ROUNDING:
            return heads
    return None


def _stop_time(tubes: TubePlan, bobbins: Sequence[Bobbin], rows: int, tube_change: float) -> float:
    """Time of all stops [s]."""
    return stop_time(bobbins, rows) + len(tubes.changes) * tube_change


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
    most = int(knots.max(initial=0, where=knots != EMPTY))
    if most >= yarns:
        raise LoomError(f"a knot of yarn {most}", allowed=f"the list has yarns 0 to {yarns - 1}")
