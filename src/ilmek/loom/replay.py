"""The knots of a part of a row in tying order, from the four numbers that the compiler keeps of it.

A head ties its part of a row in one of three orders:

    SWEEP_RIGHT, SWEEP_LEFT   knot by knot along the part
    PASSES   tube by tube, a pass from one end of its knots to the other: the first tube, the others by number, the last
             tube; the directions of first and last pass are given, those of the others travel least between the passes

The numbers are uint8: order, first tube, last tube, directions: bit 0 of the first pass, bit 1 of the last one; 0 runs
to the right. The last two are of no use for a sweep.
"""

from typing import NamedTuple, TypeAlias

import numpy as np

from ilmek.arrays import FloatArray, IntArray, UInt8
from ilmek.num.compiled import compiled

SWEEP_RIGHT, SWEEP_LEFT, PASSES = 0, 1, 2
NONE = 255
"""No tube: there are at most 255, numbered from 0."""

Line: TypeAlias = UInt8[np.ndarray, " columns"]
"""The tubes of one row of knots, by column."""

Bytes: TypeAlias = UInt8[np.ndarray, "..."]

COUNT, LEAST, MOST = 0, 1, 2
"""Rows of the table of a part by tube: its knots, its first and its last column."""

TUBES = 256


class Layout(NamedTuple):
    """Division of a row: number of heads, edges of the parts (`loom.sharing`)."""

    heads: int
    edges: IntArray


@compiled
def part_of(head: int, phase: int, phases: int, forward: bool) -> int:
    """The part of a head in a phase of a row; the first phase of a forward row is at the left."""
    return head * phases + (phase if forward else phases - 1 - phase)


@compiled
def scan(line: Line, low: int, high: int, table: IntArray, present: IntArray) -> tuple[int, int]:
    """Fill the table of a part and the list of its tubes in ascending order; returns their number and its runs.

    A cell without a knot has the tube NONE; runs go on behind it.
    """
    for one in range(TUBES):
        table[COUNT, one] = 0
    runs, before = 0, -1
    for column in range(low, high):
        tube = line[column]
        if tube == NONE:
            continue
        if table[COUNT, tube] == 0:
            table[LEAST, tube] = column
        table[COUNT, tube] += 1
        table[MOST, tube] = column
        if tube != before:
            runs += 1
            before = tube
    found = 0
    for one in range(TUBES):
        if table[COUNT, one] > 0:
            present[found] = one
            found += 1
    return found, runs


@compiled
def extent(number: int, present: IntArray, table: IntArray) -> tuple[int, int, int]:
    """Knots of a part, and their first and last column, from its table. number: of its tubes, at least 1."""
    knots, least, most = 0, table[LEAST, present[0]], table[MOST, present[0]]
    for k in range(number):
        tube = present[k]
        knots += table[COUNT, tube]
        least = min(least, table[LEAST, tube])
        most = max(most, table[MOST, tube])
    return knots, least, most


@compiled
def idle(distance: int) -> int:
    """Idle pitches of a move: a step to the next knot is part of a knot."""
    return max(abs(distance) - 1, 0)


@compiled
def link(table: IntArray, one: int, direction: int, other: int, other_direction: int) -> int:
    """Idle pitches from the end of a tube's pass to the start of another's."""
    end = table[LEAST, one] if direction else table[MOST, one]
    start = table[MOST, other] if other_direction else table[LEAST, other]
    return idle(start - end)


@compiled
def expand(  # noqa: PLR0917 - the arrays of a kernel
    line: Line, layout: Layout, forward: bool, keys: Bytes, columns: IntArray, counts: IntArray
) -> int:
    """Write the columns of a row in tying order, those of each head one after the other; returns the number of knots.

    keys  uint8 (parts, 4)      columns  int32 (columns,)      counts  knots (heads, phases), written; a phase has one
    part of the layout or several
    """
    heads, edges = layout
    phases = (edges.shape[0] - 1) // heads
    table, present = np.zeros((3, TUBES), np.int64), np.zeros(TUBES, np.int64)
    passes, at = np.zeros((2, TUBES), np.int64), 0
    counts[:] = 0
    for head in range(heads):
        for phase in range(phases):
            part = part_of(head, phase, phases, forward)
            low, high, first = edges[part], edges[part + 1], at
            if keys[part, 0] != PASSES:
                for k in range(high - low):
                    column = low + k if keys[part, 0] == SWEEP_RIGHT else high - 1 - k
                    if line[column] != NONE:
                        columns[at] = column
                        at += 1
            else:
                number, _ = scan(line, low, high, table, present)
                at += extent(number, present, table)[0]
                _directed(keys[part], number, present, table, passes)
                _write(line, (low, high, first, number), passes, table, columns)
            counts[head, phase * counts.shape[1] // phases] += at - first
    return at


@compiled
def _directed(key: Bytes, number: int, present: IntArray, table: IntArray, passes: IntArray) -> None:
    """Fill the tubes of the passes in their order, and the directions that travel least between them."""
    passes[0, 0], passes[0, number - 1] = key[1], key[2]
    at = 1
    for k in range(number):
        if present[k] != whole(key[1]) and present[k] != whole(key[2]):
            passes[0, at] = present[k]
            at += 1
    begin, end = key[3] & 1, key[3] >> 1
    cost, back = np.zeros((number, 2)), np.zeros((number, 2), np.int64)
    cost[0, 1 - begin] = np.inf
    for k in range(1, number):
        for direction in range(2):
            cost[k, direction] = np.inf
            for before in range(2):
                spent = cost[k - 1, before] + link(table, passes[0, k - 1], before, passes[0, k], direction)
                if spent < cost[k, direction]:
                    cost[k, direction], back[k, direction] = spent, before
    passes[1, number - 1] = end
    for k in range(number - 1, 0, -1):
        passes[1, k - 1] = back[k, passes[1, k]]


@compiled
def _write(line: Line, bounds: tuple[int, int, int, int], passes: IntArray, table: IntArray, columns: IntArray) -> None:
    """Write the columns of a part tube by tube.

    bounds  first column, column after the last, index of the first knot, number of passes
    """
    low, high, at, number = bounds
    for k in range(number):  # the table's first rows become the index of a tube's next knot, and the step to its next
        tube = passes[0, k]
        knots = table[COUNT, tube]
        table[LEAST, tube] = at + knots - 1 if passes[1, k] else at
        table[MOST, tube] = -1 if passes[1, k] else 1
        at += knots
    for column in range(low, high):
        tube = line[column]
        if tube != NONE:
            columns[table[LEAST, tube]] = column
            table[LEAST, tube] += table[MOST, tube]


@compiled
def link_costs(  # noqa: PLR0917 - the arrays of a kernel
    first: int, last: int, number: int, present: IntArray, table: IntArray, costs: FloatArray
) -> None:
    """Least idle pitches between the passes of a part, by the directions of the first and of the last one: (2, 2)."""
    for begin in range(2):
        right, left, before = 0.0 if begin == 0 else np.inf, 0.0 if begin == 1 else np.inf, first
        for k in range(number + 1):
            tube = last if k == number else present[k]
            if k < number and tube in (first, last):
                continue
            to_right = min(right + link(table, before, 0, tube, 0), left + link(table, before, 1, tube, 0))
            to_left = min(right + link(table, before, 0, tube, 1), left + link(table, before, 1, tube, 1))
            right, left, before = to_right, to_left, tube
        costs[begin, 0], costs[begin, 1] = right, left


@compiled
def whole(value: int | np.integer) -> int:
    """A byte as an integer: the compiler compares only values of one type."""
    return int(np.int64(value))
