"""Time and work of a programme, from its explicit operations.

    phase = max over heads of sum over its knots of
            t_knot + (t_change where the tube is not that of the head's knot before) + t_travel max(|d| - 1, 0)
    row   = sum of its phases + end of the row
    total = sum of rows + sum of stops

d: knot pitches from the head's knot before. A head begins a row at its first knot of the row, and the carpet with the
tube of its first knot in line.
"""

import numpy as np

from ilmek.arrays import FloatArray, IntArray
from ilmek.loom.bobbins import Bobbin
from ilmek.loom.operations import OperationTimes, RowOperations, Stop
from ilmek.num.compiled import compiled
from ilmek.records import record

_NO_TUBE = -1


@record
class HeadWork:
    """Work of each head over the whole carpet, arrays (heads,).

    knots  knots tied    changes  of the tube    travel  knot pitches travelled
    passes  phases of a row that are not swept knot by knot in one direction    busy  working time [s]
    """

    knots: IntArray
    changes: IntArray
    travel: IntArray
    passes: IntArray
    busy: FloatArray


class ProgrammeAccount:
    """Sums up rows of explicit operations, given in their order.

    >>> account = ProgrammeAccount(1, OperationTimes(2.0, 0.5, 0.1, (3.0, 4.0, 5.0, 6.0, 10.0), 60.0))
    >>> columns, tubes = np.array([0, 1, 4], np.int32), np.array([0, 1, 1], np.uint8)
    >>> account.add(RowOperations(0, columns, tubes, np.array([[3]])))
    16.7
    """

    def __init__(self, heads: int, times: OperationTimes) -> None:
        self._times = (float(times.knot), float(times.colour_change), float(times.travel))
        self._end = float(times.row_ends[-1])
        self._tube = np.full(heads, _NO_TUBE, np.int64)
        self._work, self._busy = np.zeros((heads, 4), np.int64), np.zeros(heads)

    def add(self, row: RowOperations) -> float:
        """Time of the next row with its end, without stops [s]."""
        counts = np.ascontiguousarray(row.counts, np.int64)
        columns, tubes = np.ascontiguousarray(row.columns, np.int32), np.ascontiguousarray(row.tubes, np.uint8)
        return self._end + float(account_row(columns, tubes, counts, self._times, self._tube, self._work, self._busy))

    @property
    def work(self) -> HeadWork:
        """The work of the heads in the rows so far."""
        knots, changes, travel, passes = self._work.T.copy()
        return HeadWork(knots, changes, travel, passes, self._busy.copy())


def stop_duration(stop: Stop, wefts: tuple[Bobbin, ...], tube_change: float) -> float:
    """Time of a stop [s]: an operator changes its packages one after the other.

    tube_change  time to change a package of pile yarn [s]
    """
    return sum(wefts[index].time for index in stop.wefts) + len(stop.tubes) * tube_change


@compiled
def account_row(  # noqa: PLR0917 - the arrays of a kernel
    columns: IntArray,
    tubes: IntArray,
    counts: IntArray,
    times: tuple[float, float, float],
    tube: IntArray,
    work: IntArray,
    busy: FloatArray,
) -> float:
    """Time of the phases of a row [s]; adds to the heads' work.

    columns, tubes, counts  as in `RowOperations`          times  (knot, colour change, travel) [s]
    tube  (heads,): of each head's last knot, updated      work   (heads, 4): knots, changes, pitches, passes
    """
    heads, phases = counts.shape
    at, column = np.zeros(heads, np.int64), np.zeros(heads, np.int64)
    first = 0
    for head in range(heads):
        at[head] = first
        column[head] = columns[first] if first < columns.shape[0] else 0
        for phase in range(phases):
            first += counts[head, phase]
    total = 0.0
    for phase in range(phases):
        slowest = 0.0
        for head in range(heads):
            begin, end = at[head], at[head] + counts[head, phase]
            changes, idle, travel, swept = 0, 0, 0, True
            for k in range(begin, end):
                moved = abs(columns[k] - column[head])
                travel += moved
                idle += max(moved - 1, 0)
                if tubes[k] != tube[head]:
                    changes += tube[head] != _NO_TUBE
                    tube[head] = tubes[k]
                swept = swept and (k < begin + 2 or columns[k] - columns[k - 1] == columns[begin + 1] - columns[begin])
                swept = swept and (k == begin or moved == 1)
                column[head] = columns[k]
            at[head] = end
            spent = (end - begin) * times[0] + changes * times[1] + idle * times[2]
            slowest = max(slowest, spent)
            work[head, 0] += end - begin
            work[head, 1] += changes
            work[head, 2] += travel
            work[head, 3] += not swept
            busy[head] += spent
        total += slowest
    return total
