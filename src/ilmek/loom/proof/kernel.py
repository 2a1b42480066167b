"""The rules of the knots of a row, in a compiled loop over every knot.

each knot of the chart once      its yarn in the tube      yarn enough      heads apart      time of the phases
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import Int32, Int64, IntArray, UInt8
from ilmek.num.compiled import compiled

OUTSIDE, TWICE, NO_TUBE, EMPTY_TUBE, OTHER_YARN, YARN_ENDS, TOO_FAR, MEETING = range(8)
"""Kinds of faults: the first number of a row of `ProofFindings.faults`."""

NO_KNOT = -1
"""Index of a knot, column or tube that there is not."""

_EMPTY = 255

CHANGES, IDLE, MOVED = range(3)
"""Rows of `ProofState.sums`."""


class ProofTable(NamedTuple):
    """The knots of a row, head by head, and its chart.

    offsets  index of each head's first knot of each phase, and the index behind its last: (heads, phases + 1)
    """

    row: int
    columns: Int32[np.ndarray, " knots"]
    tubes: UInt8[np.ndarray, " knots"]
    offsets: Int64[np.ndarray, "heads bounds"]
    chart: UInt8[np.ndarray, " columns"]


class ProofState(NamedTuple):
    """State of the heads, changed by each phase.

    column  of the last knot, NO_KNOT before the first              tube  of it
    loading yarn in each tube      left  knots that its package still gives, both (heads, tubes)
    tied    row in which each column was last tied, -1: none        sums  see CHANGES: (3, heads)
    """

    column: Int64[np.ndarray, " heads"]
    tube: Int64[np.ndarray, " heads"]
    loading: UInt8[np.ndarray, "heads tubes"]
    left: Int64[np.ndarray, "heads tubes"]
    tied: Int32[np.ndarray, " columns"]
    sums: Int64[np.ndarray, "3 heads"]


class ProofRules(NamedTuple):
    """Least distance of two neighbouring heads [knots], times [ns], and the time of a row's end [ns]."""

    spacing: int
    knot: int
    colour_change: int
    travel: int
    row_end: int


class ProofFindings(NamedTuple):
    """Faults found: (kind, head, first and last knot, two numbers of the kind), and how many there are."""

    faults: Int64[np.ndarray, "most 6"]
    total: Int64[np.ndarray, "1"]


@compiled
def begin_row(table: ProofTable, state: ProofState, rules: ProofRules, found: ProofFindings) -> None:
    """Move every head that ties in the row to its first knot, within the time of the row's end."""
    offsets = table.offsets
    for head in range(offsets.shape[0]):
        first = offsets[head, 0]
        if first == offsets[head, offsets.shape[1] - 1]:
            continue
        column = int(np.int64(table.columns[first]))
        before = state.column[head]
        if before >= 0:
            idle = max(abs(column - before) - 1, 0)
            if idle * rules.travel > rules.row_end:
                _note(found, (TOO_FAR, head, first, first, before, column))
        state.column[head] = column


@compiled
def prove_phases(
    table: ProofTable, phases: tuple[int, int], state: ProofState, rules: ProofRules, found: ProofFindings
) -> int:
    """Prove the knots of successive phases, and return their time [ns].

    phases  the first, and the one behind the last
    """
    heads = table.offsets.shape[0]
    spans = np.empty((4, heads), np.int64)
    total = 0
    for phase in range(phases[0], phases[1]):
        slowest = 0
        for head in range(heads):
            slowest = max(slowest, _tie(table, (head, phase), (state, rules, found), spans))
        _compare(spans, rules.spacing, table.chart.shape[0], found)
        total += slowest
    return total


@compiled
def _tie(
    table: ProofTable, part: tuple[int, int], proof: tuple[ProofState, ProofRules, ProofFindings], spans: IntArray
) -> int:
    """Tie the knots of a head in a phase; returns their time [ns] and writes its span of columns."""
    (head, phase), (state, rules, found) = part, proof
    columns, tubes, chart, tied = table.columns, table.tubes, table.chart, state.tied
    loading, left = state.loading[head], state.left[head]
    low = high = column = int(state.column[head])
    low_knot = high_knot = NO_KNOT
    aligned, latest = int(state.tube[head]), np.full(2, -1, np.int64)
    changes, idle, moved = 0, 0, 0
    first, last = table.offsets[head, phase], table.offsets[head, phase + 1]
    for k in range(first, last):
        before, column, tube = column, int(np.int64(columns[k])), int(np.int64(tubes[k]))
        changes += aligned >= 0 and tube != aligned
        aligned = tube
        distance = abs(column - before)
        moved += distance
        idle += max(distance - 1, 0)
        if k == first or column < low:
            low, low_knot = column, k
        if k == first or column > high:
            high, high_knot = column, k
        # An empty tube agrees with no yarn of the chart.
        inside = 0 <= column < chart.shape[0] and tube < loading.shape[0]
        if inside and tied[column] != table.row and loading[tube] == chart[column] and left[tube] > 0:
            tied[column] = table.row
            left[tube] -= 1
        else:
            _note_knot(table, (head, k, column, tube), state, found, latest)
    if first == last:  # it stands aside, with room for it
        low = high = NO_KNOT
    spans[0, head], spans[1, head], spans[2, head], spans[3, head] = low, high, low_knot, high_knot
    state.column[head], state.tube[head] = column, aligned
    state.sums[CHANGES, head] += changes
    state.sums[IDLE, head] += idle
    state.sums[MOVED, head] += moved
    return int((last - first) * rules.knot + changes * rules.colour_change + idle * rules.travel)


@compiled
def _note_knot(
    table: ProofTable, knot: tuple[int, int, int, int], state: ProofState, found: ProofFindings, latest: IntArray
) -> None:
    """Note the faults of a knot. latest: of a column and of a yarn the last fault, which the next knot may extend."""
    head, k, column, tube = knot
    inside = 0 <= column < table.chart.shape[0]
    if k > 0 and abs(column - table.columns[k - 1]) != 1:
        latest[:] = -1
    if not inside:
        _extend(found, (OUTSIDE, head, k, k, 0, 0), latest, 0)
    elif state.tied[column] == table.row:
        _extend(found, (TWICE, head, k, k, 0, 0), latest, 0)
    else:
        state.tied[column] = table.row
    if tube >= state.loading.shape[1]:
        _extend(found, (NO_TUBE, head, k, k, tube, 0), latest, 1)
        return
    yarn = int(np.int64(state.loading[head, tube]))
    if yarn == _EMPTY:
        _extend(found, (EMPTY_TUBE, head, k, k, tube, 0), latest, 1)
        return
    if inside and yarn != table.chart[column]:
        _extend(found, (OTHER_YARN, head, k, k, tube * 256 + yarn, int(np.int64(table.chart[column]))), latest, 1)
    state.left[head, tube] -= 1
    if state.left[head, tube] == -1:
        _note(found, (YARN_ENDS, head, k, k, tube, yarn))


@compiled
def _compare(spans: IntArray, spacing: int, columns: int, found: ProofFindings) -> None:
    """Prove that the spans of all heads that tie are apart, with room for those that do not, within the row."""
    before = -1
    for head in range(spans.shape[1]):
        if spans[0, head] < 0:
            continue
        if before >= 0 and spans[0, head] - spans[1, before] < (head - before) * spacing:
            distance = spans[0, head] - spans[1, before]
            _note(found, (MEETING, before, spans[3, before], spans[2, head], head, distance))
        if before < 0 and spans[0, head] < head * spacing:
            _note(found, (MEETING, 0, NO_KNOT, spans[2, head], head, spans[0, head]))
        before = head
    last = spans.shape[1] - 1
    if 0 <= before < last and columns - 1 - spans[1, before] < (last - before) * spacing:
        _note(found, (MEETING, before, spans[3, before], NO_KNOT, last, columns - 1 - spans[1, before]))


@compiled
def _extend(found: ProofFindings, fault: tuple[int, int, int, int, int, int], latest: IntArray, which: int) -> None:
    """Note a fault of a knot, or extend the same fault of the knot before."""
    at = latest[which]
    if 0 <= at < found.faults.shape[0]:
        old = found.faults[at]
        if old[0] == fault[0] and old[3] + 1 == fault[2] and old[4] == fault[4] and old[5] == fault[5]:
            old[3] = fault[3]
            return
    latest[which] = found.total[0]
    _note(found, fault)


@compiled
def _note(found: ProofFindings, fault: tuple[int, int, int, int, int, int]) -> None:
    at = found.total[0]
    if at < found.faults.shape[0]:
        for index in range(6):
            found.faults[at, index] = fault[index]
    found.total[0] += 1
