"""The least weaving time of any tying order with the same heads, parts and tubes.

A part of n knots in d tubes is tied in at least d runs, each of one tube. Between two neighbouring knots of a tube with
g knots of other tubes between them, either a run crosses these, g idle pitches, or one more run begins:

    part >= n t_knot + (d - 1 + e) t_change + sum over such gaps of min(g t_travel, t_change)

e is 1 where the part has no tube of the head's part before, else 0. With the row's ends,

    rows >= max( sum over phases of max over heads of their parts,
                 max over heads of ( sum of its parts + least changes at their boundaries ) )

The least changes at the boundaries of a head's parts come from a dynamic programme over the tube with which each part
ends: in a part of two tubes or more that is another one than the first, or one that needs a second run.
"""

import numpy as np

from ilmek.arrays import Indices, IntArray
from ilmek.loom.order import FourTimes
from ilmek.loom.replay import COUNT, LEAST, MOST, NONE, TUBES, Layout, Line, extent, part_of, scan
from ilmek.num.compiled import compiled
from ilmek.records import record


@record
class BoundState:
    """What the bound of a carpet sums up over its rows.

    phases  [s], one number     heads  [s] of each head, without changes at boundaries
    ends    (heads, TUBES): changes at the boundaries so far, where the head's last part ends with a tube; large: never
    """

    phases: np.ndarray
    heads: np.ndarray
    ends: IntArray

    @staticmethod
    def before(heads: int) -> "BoundState":
        """Before the first row."""
        return BoundState(np.zeros(1), np.zeros(heads), np.zeros((heads, TUBES), np.int64))

    def time(self, colour_change: float) -> float:
        """The bound of the rows' phases [s]."""
        return max(float(self.phases[0]), float((self.heads + self.ends.min(axis=1) * colour_change).max()))


def add_rows(lines: Indices, layout: Layout, first: int, times: FourTimes, state: BoundState) -> None:
    """Add rows to a bound.

    lines  tubes, uint8 (rows, columns), loom row `first` first
    """
    _add_rows(lines, layout, first, times, (state.phases, state.heads, state.ends))


_NEVER = 1 << 40


@compiled
def _add_rows(
    lines: Indices, layout: Layout, first: int, times: FourTimes, state: tuple[np.ndarray, np.ndarray, IntArray]
) -> None:
    total, by_head, ends = state
    heads, edges = layout
    phases = (edges.shape[0] - 1) // heads
    table, present = np.zeros((3, TUBES), np.int64), np.zeros(TUBES, np.int64)
    for row in range(lines.shape[0]):
        for phase in range(phases):
            slowest = 0.0
            for head in range(heads):
                part = part_of(head, phase, phases, (first + row) % 2 == 0)
                low, high = edges[part], edges[part + 1]
                number, _ = scan(lines[row], low, high, table, present)
                if number == 0:
                    continue
                least = extent(number, present, table)[0] * times[0] + (number - 1) * times[1]
                least += _gaps(lines[row], low, high, times)
                by_head[head] += least
                entered = _bounded(number, present, table, ends[head])
                slowest = max(slowest, least + times[1] * entered)
            total[0] += slowest


@compiled
def _gaps(line: Line, low: int, high: int, times: FourTimes) -> float:
    """Least time for the gaps between the knots of the same tube."""
    last = np.full(TUBES, -1, np.int64)
    spent = 0.0
    for column in range(low, high):
        tube = line[column]
        if tube == NONE:
            continue
        if last[tube] >= 0 and column - last[tube] > 1:
            spent += min((column - last[tube] - 1) * times[2], times[1])
        last[tube] = column
    return spent


@compiled
def _bounded(number: int, present: IntArray, table: IntArray, ends: IntArray) -> int:
    """Update the least changes at boundaries by the tube with which a part ends; 1 where no tube is shared, else 0.

    A tube whose knots have a gap may begin and end a part: the gap's term pays for its second run.
    """
    least, shared = ends.min(), False
    one = two = _NEVER  # least changes on entering with the best first tube, and with the best other one
    best = -1
    for k in range(number):
        tube = present[k]
        shared = shared or ends[tube] < _NEVER
        spent = min(ends[tube], least + 1)
        if spent < one:
            one, two, best = spent, one, tube
        elif spent < two:
            two = spent
    for tube in range(TUBES):
        ends[tube] = _NEVER
    for k in range(number):
        tube = present[k]
        gap = table[MOST, tube] - table[LEAST, tube] + 1 > table[COUNT, tube]
        ends[tube] = one if number == 1 or tube != best or gap else min(two, one + 1)
    return 0 if shared else 1
