"""The tying order of every part of a carpet: for each head the quickest of a family, by dynamic programming.

The family of a part: both sweeps, and passes (`loom.replay`) with any of these first and last tubes:

    - up to MOST_SHARED tubes that the part shares with its neighbour in time, those at the ends of its row first
    - the least and the greatest tube, where a boundary is not shared

    time of a head = knots t_knot + changes t_change + idle pitches t_travel

    phase = max over heads of their times, to which OWN times the head's own time is added

A head goes to its first knot of a row while the row before ends; farther knots than it reaches by then are not chosen.
A state is the tube in the handler and the column of the head after a part. Every head is planned ROUNDS times, with the
times of the others as planned last; where parts are divided into blocks (`loom.planner`), once and by its own time.
Three shared tubes suffice for the fewest
changes of all passes: whatever the boundaries beside it take, one is left for each. The order of a slice of rows is
planned with the first FORESIGHT rows of the next one; within these it is the quickest of the family.
"""

from typing import TypeAlias

import numpy as np

from ilmek.arrays import FloatArray, IntArray
from ilmek.loom.replay import (
    COUNT,
    LEAST,
    MOST,
    NONE,
    PASSES,
    SWEEP_LEFT,
    SWEEP_RIGHT,
    TUBES,
    Bytes,
    Layout,
    Line,
    extent,
    idle,
    link_costs,
    part_of,
    scan,
    whole,
)
from ilmek.num.compiled import compiled

MOST_SHARED = 4
"""Largest number of shared tubes that are tried at a boundary of two parts."""

FORESIGHT = 8
"""Rows that are planned beyond a slice."""

ROUNDS = 2
"""How often every head is planned: from the second time on with the times of all others."""

OWN = 1e-3
"""Weight of a head's own time beside that of the slowest of a phase."""

_TOO_FAR = 1e12
"""Time [s] that stands for a first knot of a row that is not reached while the row before ends."""

_STATES = 2 * (MOST_SHARED + 1) + 2
"""States after a part: for each last tube two directions of its pass, and two sweeps."""

FourTimes: TypeAlias = tuple[float, float, float, float]
"""Times of a knot, a colour change, an idle pitch, and the end of a row [s]."""

State: TypeAlias = tuple[FloatArray, IntArray, int, bool, float]
"""Costs and columns of the states before and after a part, the row of those after it, whether the head has
not tied in the row, and the time of the slowest of the other heads in it."""

Out: TypeAlias = tuple[Bytes, Bytes, FloatArray]
"""Of each state after a part: the state before, the part's key, its time [s]."""


@compiled
def plan(  # noqa: PLR0917 - the arrays of a kernel
    lines: Bytes, layout: Layout, first: int, commit: int, times: FourTimes, stand: IntArray, keys: Bytes
) -> None:
    """Choose the order of every part of the first `commit` of some rows.

    lines  tubes, uint8 (rows, columns), loom row `first` first
    stand  (heads, 2): tube in line and column before the first row, NONE and any before the carpet; updated to those
           after `commit` rows
    keys   uint8 (commit, parts, 4), see `loom.replay`
    """
    heads, edges = layout
    phases = (edges.shape[0] - 1) // heads
    coupled = heads > 1 and phases == 2
    steps = lines.shape[0] * phases
    spent, others = np.zeros((heads, steps)), np.zeros(steps)
    before = np.zeros((heads, 2), np.int64)
    for head in range(heads):
        before[head, 0], before[head, 1] = stand[head, 0], stand[head, 1]
    for _ in range(ROUNDS if coupled else 1):
        for head in range(heads):
            for step in range(steps):
                others[step] = 0.0
                for other in range(heads):
                    if coupled and other != head:
                        others[step] = max(others[step], spent[other, step])
            of = (head, first, commit, before[head, 0], before[head, 1])
            stand[head, 0], stand[head, 1] = _plan_head(lines, layout, of, times, others, spent[head], keys)


@compiled
def _plan_head(  # noqa: PLR0917 - the arrays of a kernel
    lines: Bytes,
    layout: Layout,
    of: tuple[int, int, int, int, int],
    times: FourTimes,
    others: FloatArray,
    spent: FloatArray,
    keys: Bytes,
) -> tuple[int, int]:
    """Plan a head; returns the tube in line and the column after the committed rows.

    of      head, first row, rows to commit, tube in line and column before
    others  time of the slowest of the other heads at each step, as far as they are planned
    spent   time of each step, written
    """
    head, first, commit, handler, column = of
    steps = others.shape[0]
    phases = steps // lines.shape[0]
    back, chosen = np.zeros((steps, _STATES), np.uint8), np.zeros((steps, _STATES, 4), np.uint8)
    part_times, ended = np.zeros((steps, _STATES)), np.zeros((steps, _STATES), np.int64)
    tables, present = np.zeros((2, 3, TUBES), np.int64), np.zeros((2, TUBES), np.int64)
    shared = np.zeros((2, MOST_SHARED), np.int64)
    cost, end = np.zeros((2, _STATES)), np.zeros((2, _STATES), np.int64)
    cost[1, 1:] = np.inf
    chosen_before = np.zeros((_STATES, 4), np.uint8)
    end[1, 0] = column
    chosen_before[0, 2] = handler
    low, high, line = _bounds(lines, layout, head, first, 0)
    number, runs = scan(line, low, high, tables[0], present[0])
    begins, ends = 0, 0
    if handler != NONE and tables[0, COUNT, handler] > 0:
        shared[0, 0], begins = handler, 1
    free, before = True, chosen_before
    for step in range(steps):
        now, then = step % 2, 1 - step % 2
        free = free or step % phases == 0
        next_number = next_runs = ends = 0
        next_low, next_high, next_line = low, high, line
        if step + 1 < steps:
            next_low, next_high, next_line = _bounds(lines, layout, head, first, step + 1)
            next_number, next_runs = scan(next_line, next_low, next_high, tables[then], present[then])
            hints = (line[high - 1], line[low], next_line[next_low], next_line[next_high - 1])
            ends = _shared(hints, tables[now], tables[then], (number, present[now]), shared[then])
        state = (cost, end, now, free, others[step])
        out = (back[step], chosen[step], part_times[step])
        if number == 0:
            _stands(state, before, out)
        else:
            free = False
            _sweeps(line, (*extent(number, present[now], tables[now]), runs), state, before, times, out)
        if number > 1:
            boundaries = (begins, ends, shared[now], shared[then])
            _passes((number, present[now], tables[now]), boundaries, state, before, times, out)
        ended[step], before = end[now], chosen[step]
        low, high, line, number, runs, begins = next_low, next_high, next_line, next_number, next_runs, ends
    return _trace((head, first, commit), layout, cost[(steps - 1) % 2], (back, chosen, part_times), ended, spent, keys)


@compiled
def _bounds(lines: Bytes, layout: Layout, head: int, first: int, step: int) -> tuple[int, int, Line]:
    """First column, column after the last, and row of a head's part at a step."""
    heads, edges = layout
    phases = (edges.shape[0] - 1) // heads
    row = step // phases
    part = part_of(head, step % phases, phases, (first + row) % 2 == 0)
    return edges[part], edges[part + 1], lines[row]


@compiled
def _shared(
    hints: tuple[int, int, int, int], table: IntArray, after: IntArray, own: tuple[int, IntArray], shared: IntArray
) -> int:
    """Write up to MOST_SHARED tubes that two parts have, the hints among them first; returns their number."""
    number, present = own
    found = 0
    for k in range(4 + number):
        tube = whole(hints[k]) if k < 4 else present[k - 4]
        known = table[COUNT, tube] == 0 or after[COUNT, tube] == 0
        for j in range(found):
            known = known or shared[j] == tube
        if not known:
            shared[found] = tube
            found += 1
            if found == MOST_SHARED:
                break
    return found


@compiled
def _entered(tube: int, column: int, state: State, before: Bytes, times: FourTimes) -> tuple[int, float, int, float]:
    """The states from which a first knot, by its tube and column, is reached at least cost with and without the change
    and travel to it; and the times of these.
    """
    cost, end, now, free, _ = state
    least, best, best_time, least_alone, alone, alone_time = np.inf, 0, 0.0, np.inf, 0, 0.0
    for one in range(_STATES):
        if cost[1 - now, one] >= least and cost[1 - now, one] >= least_alone:
            continue
        spent = 0.0
        if whole(before[one, 2]) != tube and before[one, 2] != NONE:
            spent += times[1]
        distance = idle(column - end[1 - now, one])
        if not free:
            spent += distance * times[2]
        elif distance * times[2] > times[3] and before[one, 2] != NONE:
            spent += _TOO_FAR
        if cost[1 - now, one] + spent < least:
            least, best, best_time = cost[1 - now, one] + spent, one, spent
        if cost[1 - now, one] < least_alone:
            least_alone, alone, alone_time = cost[1 - now, one], one, spent
    return best, best_time, alone, alone_time


@compiled
def _reached(entered: tuple[int, float, int, float], rest: float, state: State) -> tuple[float, int, float]:
    """Least cost after a part of which the entry is open, the state before it, and the time of the part.

    rest  its time without the change and travel to its first knot [s]
    """
    cost, _, now, _, others = state
    best, best_time, alone, alone_time = entered
    one = cost[1 - now, best] + max(best_time + rest, others) + OWN * (best_time + rest)
    two = cost[1 - now, alone] + max(alone_time + rest, others) + OWN * (alone_time + rest)
    if two < one:
        return two, alone, alone_time + rest
    return one, best, best_time + rest


@compiled
def _sweeps(  # noqa: PLR0917 - the arrays of a kernel
    line: Line, part: tuple[int, int, int, int], state: State, before: Bytes, times: FourTimes, out: Out
) -> None:
    """The states after both sweeps; all others are set to infinite cost. part: knots, first and last column, runs."""
    knots, low, last, runs = part
    cost, end, now, _, _ = state
    back, chosen, part_times = out
    for one in range(_STATES):
        cost[now, one] = np.inf
    alone = knots * times[0] + (runs - 1) * times[1] + (last - low + 1 - knots) * times[2]
    for order in (SWEEP_RIGHT, SWEEP_LEFT):
        start, stop = (low, last) if order == SWEEP_RIGHT else (last, low)
        at = _STATES - 2 + order
        entered = _entered(whole(line[start]), start, state, before, times)
        cost[now, at], back[at], part_times[at] = _reached(entered, alone, state)
        end[now, at] = stop
        chosen[at, 0], chosen[at, 1], chosen[at, 2], chosen[at, 3] = order, line[start], line[stop], 0


@compiled
def _stands(state: State, before: Bytes, out: Out) -> None:
    """The states after a part without a knot: those before it."""
    cost, end, now, _, others = state
    back, chosen, part_times = out
    for one in range(_STATES):
        cost[now, one], end[now, one] = cost[1 - now, one] + others, end[1 - now, one]
        back[one], part_times[one] = one, 0.0
        chosen[one, 0], chosen[one, 2] = SWEEP_RIGHT, before[one, 2]


@compiled
def _passes(  # noqa: PLR0917 - the arrays of a kernel
    part: tuple[int, IntArray, IntArray],
    boundaries: tuple[int, int, IntArray, IntArray],
    state: State,
    before: Bytes,
    times: FourTimes,
    out: Out,
) -> None:
    """The states after passes."""
    number, present, table = part
    begins, ends, _, _ = boundaries
    cost, end, now, _, _ = state
    back, chosen, part_times = out
    links = np.empty((2, 2))
    knots = within = 0
    for k in range(number):
        tube = present[k]
        knots += table[COUNT, tube]
        within += table[MOST, tube] - table[LEAST, tube] + 1 - table[COUNT, tube]
    alone = knots * times[0] + (number - 1) * times[1] + within * times[2]
    for i in range(begins + 1):
        for j in range(ends + 1):
            first, last = _pair(i, j, boundaries, number, present)
            if first == last:
                continue
            link_costs(first, last, number, present, table, links)
            for begin in range(2):
                start = table[MOST, first] if begin else table[LEAST, first]
                entered = _entered(first, start, state, before, times)
                for finish in range(2):
                    total, one, spent = _reached(entered, alone + links[begin, finish] * times[2], state)
                    at = 2 * j + finish
                    if total < cost[now, at]:
                        cost[now, at], back[at], part_times[at] = total, one, spent
                        end[now, at] = table[LEAST, last] if finish else table[MOST, last]
                        chosen[at, 0], chosen[at, 1], chosen[at, 2] = PASSES, first, last
                        chosen[at, 3] = begin + 2 * finish


@compiled
def _pair(
    i: int, j: int, boundaries: tuple[int, int, IntArray, IntArray], number: int, present: IntArray
) -> tuple[int, int]:
    """First and last tube: shared ones, or the least and the greatest of the part that is not the other."""
    begins, ends, firsts, lasts = boundaries
    first = firsts[i] if i < begins else present[0]
    last = lasts[j] if j < ends else present[number - 1]
    if first == last:
        if i == begins:
            first = present[1]
        elif j == ends:
            last = present[number - 2]
    return first, last


@compiled
def _trace(  # noqa: PLR0917 - the arrays of a kernel
    of: tuple[int, int, int],
    layout: Layout,
    cost: FloatArray,
    planned: Out,
    ended: IntArray,
    spent: FloatArray,
    keys: Bytes,
) -> tuple[int, int]:
    """Write times and keys of the best path through the states; returns tube and column after the committed rows."""
    head, first, commit = of
    back, chosen, part_times = planned
    phases = (layout.edges.shape[0] - 1) // layout.heads
    state, tube, column = 0, NONE, 0
    for one in range(1, _STATES):
        if cost[one] < cost[state]:
            state = one
    for step in range(back.shape[0] - 1, -1, -1):
        row = step // phases
        spent[step] = part_times[step, state]
        if row < commit:
            if step == commit * phases - 1:
                tube, column = whole(chosen[step, state, 2]), ended[step, state]
            part = part_of(head, step % phases, phases, (first + row) % 2 == 0)
            for k in range(4):
                keys[row, part, k] = chosen[step, state, k]
        state = whole(back[step, state])
    return tube, column
