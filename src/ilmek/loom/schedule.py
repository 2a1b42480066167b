"""The tying order, in a compiled loop over every knot of a carpet.

A head ties its part of a row in the faster of two orders:

    sweep    knot by knot along the row, in alternate directions from row to row, with a change at every new colour
    passes   colour by colour: first the colour in the handler, then the others by number, last the first
             colour of the next part; each pass runs from the nearer end of its colour to the other

    time = knots * t_knot + changes * t_change + idle pitches * t_travel

A move to the next warp pair is part of the knot; of a move of d pitches, d - 1 are idle. A key of three bytes per part
(order, first colour, last colour) suffices to replay the order.
"""

from typing import NamedTuple, TypeAlias

import numpy as np

from ilmek.arrays import FloatArray, Indices, IntArray, UInt8
from ilmek.num.compiled import compiled

Line: TypeAlias = UInt8[np.ndarray, " columns"]
"""The colours of one row of knots."""

FourTimes: TypeAlias = tuple[float, float, float, float]
"""Seconds of a knot, a colour change, an idle pitch, and the wefts of a row."""

ByteTable: TypeAlias = UInt8[np.ndarray, "..."]

SWEEP, PASSES = 0, 1
NONE = 255
"""No colour: there are at most 255 yarns, numbered from 0."""

_COUNT, _LEAST, _MOST, _SEQUENCE, _FILL, _STEP = 0, 1, 2, 3, 4, 5
# Rows of a scratch table by colour: its knots, its first and last column; the colours in the order of their passes; the
# index at which the next knot of a colour is written, and the step to the next index.


class Layout(NamedTuple):
    """Division of a row: number of yarns, number of heads, edges of the parts (`loom.sharing`)."""

    yarns: int
    heads: int
    edges: IntArray


class ScheduleResult(NamedTuple):
    """Arrays that `schedule` fills.

    keys       uint8 (rows, parts, 3), loom row first; 0 rows where only the time is required
    row_times  float (rows,) [s]
    work       int (heads, 4): knots, changes, pitches, parts in passes
    busy       float (heads,): working time of each head [s]
    handler    int (heads,): colour in each head's handler after the last row; NONE before the first
    """

    keys: ByteTable
    row_times: FloatArray
    work: IntArray
    busy: FloatArray
    handler: IntArray


class RowSpan(NamedTuple):
    """The rows of one call of `schedule`.

    first, last  loom rows: the first, and the one after the last
    spent        time of the rows before [s]
    deadline     stop as soon as the carpet cannot be finished by then [s]
    least_row    least time of a row [s]
    """

    first: int
    last: int
    spent: float
    deadline: float
    least_row: float


@compiled
def schedule(knots: Indices, layout: Layout, times: FourTimes, span: RowSpan, outcome: ScheduleResult) -> float:
    """Choose the order of every part of some rows and sum the times, from the carpet's bottom edge upward.

    knots   chart, uint8 (rows, columns), row 0 = top
    times   (knot, colour change, idle pitch, wefts of a row) [s]

    Fills the rows of `outcome` and returns the time up to their end [s]; after a stop, a lower bound of the time of the
    carpet that exceeds the deadline.
    """
    yarns, heads, edges = layout
    keys, row_times, work, busy, handler = outcome
    rows, halves = knots.shape[0], (edges.shape[0] - 1) // heads
    by_colour = np.zeros((6, yarns), np.int64)
    column = np.zeros(heads, np.int64)
    begin, finish, total, deadline, least_row = span
    for row in range(begin, finish):
        line, forward, row_time = knots[rows - 1 - row], row % 2 == 0, times[3]
        for half in range(halves):
            slowest = 0.0
            for head in range(heads):
                part = _part(head, half, halves, forward)
                low, high = edges[part], edges[part + 1]
                if half == 0:
                    column[head] = _begins(low, high, forward)
                aim = _next_colour(knots, layout, head, row, half)
                order, first, last, end, changes, idle, travel = _choose(
                    line, (low, high, forward), (handler[head], column[head], aim, half == 0), times, by_colour
                )
                spent = (high - low) * times[0] + changes * times[1] + idle * times[2]
                slowest = max(slowest, spent)
                handler[head], column[head] = last, end
                _book(work[head], high - low, changes, travel, order)
                busy[head] += spent
                if keys.shape[0] > 0:
                    keys[row, part, 0], keys[row, part, 1], keys[row, part, 2] = order, first, last
            row_time += slowest
        row_times[row] = row_time
        total += row_time
        rest: float = (rows - 1 - row) * least_row
        if total + rest > deadline:
            return total + rest
    return total


@compiled
def replay(line: Line, layout: Layout, forward: bool, keys: ByteTable, out: IntArray) -> None:
    """Write the columns of a row in tying order, those of each head within its own edges.

    line  colours of the row    forward  the row runs from column 0    keys  uint8 (parts, 3)    out  int (columns,)
    """
    yarns, heads, edges = layout
    halves = (edges.shape[0] - 1) // heads
    by_colour = np.zeros((6, yarns), np.int64)
    for head in range(heads):
        at = edges[head * halves]
        part = _part(head, 0, halves, forward)
        column = _begins(edges[part], edges[part + 1], forward)
        for half in range(halves):
            part = _part(head, half, halves, forward)
            low, high = edges[part], edges[part + 1]
            if keys[part, 0] == SWEEP:
                at = _write_sweep(low, high, forward, out, at)
            else:
                _scan(line, low, high, by_colour)
                passes = _sequence(_whole(keys[part, 1]), _whole(keys[part, 2]), by_colour)
                at = _write_passes(line, (low, high, passes), (at, column), by_colour, out)
            column = out[at - 1]


@compiled
def _part(head: int, half: int, halves: int, forward: bool) -> int:
    """The part of a head in a half of the row's time; the first half is at the start of the sweep."""
    return head * halves + (half if forward else halves - 1 - half)


@compiled
def _begins(low: int, high: int, forward: bool) -> int:
    """First column of a sweep of a part."""
    return low if forward else high - 1


@compiled
def _next_colour(knots: Indices, layout: Layout, head: int, row: int, half: int) -> int:
    """First colour of a sweep of the head's next part; NONE after the last."""
    edges = layout.edges
    rows, halves = knots.shape[0], (edges.shape[0] - 1) // layout.heads
    row, half = (row, half + 1) if half + 1 < halves else (row + 1, 0)
    if row == rows:
        return NONE
    forward = row % 2 == 0
    part = _part(head, half, halves, forward)
    return _whole(knots[rows - 1 - row, _begins(edges[part], edges[part + 1], forward)])


@compiled
def _choose(
    line: Line, bounds: tuple[int, int, bool], state: tuple[int, int, int, bool], times: FourTimes, by_colour: IntArray
) -> tuple[int, int, int, int, int, int, int]:
    """The faster order of a part: (order, first colour, last colour, last column, changes, idle pitches, pitches).

    bounds first column, column after the last, forward
    state  colour in the handler, column of the head, first colour of its next part, whether it begins a row: then it
           stands at its first knot
    """
    low, high, forward = bounds
    handler, column, aim, begins = state
    runs = _scan(line, low, high, by_colour)
    start = _begins(low, high, forward)
    end = low + high - 1 - start
    first, last = _whole(line[start]), _whole(line[end])
    changes, idle = runs - _ready(handler, first), _idle(start - column)
    ready = handler if handler != NONE and by_colour[_COUNT, handler] > 0 else first
    passes = _sequence(ready, aim, by_colour)
    fewer = passes - _ready(handler, ready)
    if fewer < changes:
        more_idle, travel, final = _walk(passes, by_colour, column, begins)
        if fewer * times[1] + more_idle * times[2] < changes * times[1] + idle * times[2]:
            return PASSES, ready, by_colour[_SEQUENCE, passes - 1], final, fewer, more_idle, travel
    return SWEEP, first, last, end, changes, idle, abs(start - column) + high - low - 1


@compiled
def _ready(handler: int, colour: int) -> int:
    """1 where no change is needed for a colour: the handler has it, or is threaded before the carpet begins."""
    return 1 if handler in (colour, NONE) else 0


@compiled
def _idle(distance: int) -> int:
    """Pitches of a move beyond the one of the knot."""
    return max(abs(distance) - 1, 0)


@compiled
def _scan(line: Line, low: int, high: int, by_colour: IntArray) -> int:
    """Runs of equal colour in line[low:high]; fills count, first and last column by colour."""
    by_colour[_COUNT, :] = 0
    runs, before = 0, -1
    for column in range(low, high):
        colour = int(line[column])
        if colour != before:
            runs += 1
            before = colour
            if by_colour[_COUNT, colour] == 0:
                by_colour[_LEAST, colour] = column
        by_colour[_COUNT, colour] += 1
        by_colour[_MOST, colour] = column
    return runs


@compiled
def _sequence(first: int, last: int, by_colour: IntArray) -> int:
    """Write the colours of a part in the order of their passes: `first` (which occurs), the others, `last`."""
    by_colour[_SEQUENCE, 0] = first
    passes = 1
    for colour in range(by_colour.shape[1]):
        if by_colour[_COUNT, colour] > 0 and colour not in (first, last):
            by_colour[_SEQUENCE, passes] = colour
            passes += 1
    if last not in (first, NONE) and by_colour[_COUNT, last] > 0:
        by_colour[_SEQUENCE, passes] = last
        passes += 1
    return passes


@compiled
def _walk(passes: int, by_colour: IntArray, column: int, begins: bool) -> tuple[int, int, int]:
    """Idle pitches, pitches and last column of the passes, begun at `column`, or at their first knot."""
    idle = travel = 0
    for k in range(passes):
        colour = by_colour[_SEQUENCE, k]
        near, far, _ = _ends(colour, by_colour, column)
        column = near if begins and k == 0 else column
        idle += _idle(near - column) + abs(far - near) - (by_colour[_COUNT, colour] - 1)
        travel += abs(near - column) + abs(far - near)
        column = far
    return idle, travel, column


@compiled
def _book(work: IntArray, knots: int, changes: int, travel: int, order: int) -> None:
    """Add a part to a head's work."""
    work[0] += knots
    work[1] += changes
    work[2] += travel
    work[3] += order


@compiled
def _write_sweep(low: int, high: int, forward: bool, out: IntArray, at: int) -> int:
    """Write the columns of a part in the direction of the sweep; returns the next free index."""
    for k in range(high - low):
        out[at + k] = low + k if forward else high - 1 - k
    return at + high - low


@compiled
def _write_passes(
    line: Line, bounds: tuple[int, int, int], state: tuple[int, int], by_colour: IntArray, out: IntArray
) -> int:
    """Write the columns of a part colour by colour; returns the next free index.

    bounds  first column, column after the last, number of passes    state  next free index, column of the head
    """
    low, high, passes = bounds
    at, position = state
    for k in range(passes):
        colour = by_colour[_SEQUENCE, k]
        _, far, back = _ends(colour, by_colour, position)
        knots, position = by_colour[_COUNT, colour], far
        by_colour[_FILL, colour] = at + knots - 1 if back else at
        by_colour[_STEP, colour] = -1 if back else 1
        at += knots
    for column in range(low, high):
        colour = line[column]
        out[by_colour[_FILL, colour]] = column
        by_colour[_FILL, colour] += by_colour[_STEP, colour]
    return at


@compiled
def _ends(colour: int, by_colour: IntArray, column: int) -> tuple[int, int, bool]:
    """The end of a colour nearer to `column`, the other end, and whether the pass runs back."""
    least, most = by_colour[_LEAST, colour], by_colour[_MOST, colour]
    if abs(column - most) < abs(column - least):
        return most, least, True
    return least, most, False


@compiled
def _whole(value: int | np.integer) -> int:
    """A byte as an integer: the compiler compares only values of one type."""
    return int(np.int64(value))
