"""Kernels of a phase: the knots' times without faults, the faults that fall into it, and how they delay it.

Whole numbers alone: times in ns, positions of faults as in `FaultTable`. A phase begins at 0.
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import Int32, IntArray, UInt8
from ilmek.loom.twin.faults import OF_A_HEAD, UNIT, FaultTable
from ilmek.loom.twin.random import erlang_time, exponential, exponential_time, happens, scaled, word
from ilmek.num.compiled import compiled

NEVER = 1 << 62
"""Position of a fault that does not happen."""

GAP, RESPONSE, QUEUE, WAITS, REPAIR, RETRY = range(6)
"""What a random number is for: the streams of a cause."""

HEAD, KNOT, CAUSE, ORDINAL, END, RETRIES, CALLS, RESPONDS, REPAIRS, CALL, WAIT = range(11)
"""Columns of the faults of a phase.

END       of the knot's first attempt, without faults        RETRIES   attempts of the head after a miss
CALLS     1: the operator is called                         RESPONDS, REPAIRS  his times
CALL      when he is called                                 WAIT      from then to the end of his repair
"""

FAULT_COLUMNS = 11

_MISS = 2
_COLUMN, _TUBE = 0, 1


class RowKnots(NamedTuple):
    """Knots of a row in tying order, head by head, and of each phase of each head the first index and the number.

    yarns  pile yarn of a knot from each tube of each head [um]
    """

    columns: Int32[np.ndarray, " knots"]
    tubes: UInt8[np.ndarray, " knots"]
    first: IntArray
    counts: IntArray
    yarns: IntArray


class PhaseTimes(NamedTuple):
    """A phase without faults.

    lasts    time of each knot of the row [ns]; filled where the phase has knots
    base     time of each head            yarn   pile yarn of each head [um]
    changes  colour changes of each head  idle   its pitches of travel that take time
    tied     knots from each tube of each head since its package was put on: counted up
    """

    lasts: IntArray
    base: IntArray
    yarn: IntArray
    changes: IntArray
    idle: IntArray
    tied: IntArray


@compiled
def time_knots(row: RowKnots, phase: int, times: tuple[int, int, int], states: IntArray, out: PhaseTimes) -> None:
    """Fill the times of a phase's knots, by the rules of time.

    times   of a knot, a colour change, a pitch of travel [ns]
    states  (heads, 2): last column (-1: the row begins) and last tube (-1: the carpet begins) of each head; moved on
    """
    for head in range(row.counts.shape[0]):
        column, tube = states[head, _COLUMN], states[head, _TUBE]
        base = yarn = changes = idle = 0
        begin = row.first[head, phase]
        for k in range(begin, begin + row.counts[head, phase]):
            to, using = np.int64(row.columns[k]), np.int64(row.tubes[k])
            lasts = times[0]
            if tube not in (using, -1):
                lasts += times[1]
                changes += 1
            if column >= 0 and abs(to - column) > 1:
                lasts += times[2] * (abs(to - column) - 1)
                idle += abs(to - column) - 1
            column, tube = to, using
            out.lasts[k] = lasts
            out.tied[head, using] += 1
            base += lasts
            yarn += row.yarns[head, using]
        states[head, _COLUMN], states[head, _TUBE] = column, tube
        out.base[head], out.yarn[head], out.changes[head], out.idle[head] = base, yarn, changes, idle


@compiled
def stream(cause: int, purpose: int, head: int) -> int:
    """The stream of random numbers of a cause, a purpose and a head; of the whole loom: head 0."""
    return ((cause * 8 + purpose) << 16) + head


@compiled
def distance(table: FaultTable, cause: int, head: int, seed: int, ordinal: int) -> int:
    """Distance of a fault from the one before."""
    if table.gaps[cause] == 0:
        return NEVER
    return scaled(table.gaps[cause], exponential(word(seed, stream(cause, GAP, head), ordinal)))


@compiled
def begin_positions(table: FaultTable, seed: int, positions: IntArray, ordinals: IntArray) -> None:
    """Positions of the first fault of each cause and head: (causes, heads)."""
    for cause in range(positions.shape[0]):
        for head in range(positions.shape[1]):
            positions[cause, head] = distance(table, cause, head, seed, 0)
            ordinals[cause, head] = 0


@compiled
def exposure(cause: int, head: int, row: RowKnots, phase: int, out: PhaseTimes) -> int:
    """Exposure of a head to a cause in a phase."""
    return int(UNIT * row.counts[head, phase] if cause == _MISS else out.yarn[head])


@compiled
def count_faults(  # noqa: PLR0917
    row: RowKnots, phase: int, out: PhaseTimes, passed: IntArray, positions: IntArray, ordinals: IntArray,
    table: FaultTable, seed: int,
) -> int:  # fmt: skip
    """Number of faults of the heads in a phase. passed: exposures before it, (causes, heads)."""
    found = 0
    for head in range(row.counts.shape[0]):
        for cause in range(OF_A_HEAD):
            position, ordinal = positions[cause, head], ordinals[cause, head]
            until = passed[cause, head] + exposure(cause, head, row, phase, out)
            while position < until:
                found += 1
                ordinal += 1
                position += distance(table, cause, head, seed, ordinal)
    return found


@compiled
def take_faults(  # noqa: PLR0917
    row: RowKnots, phase: int, out: PhaseTimes, passed: IntArray, positions: IntArray, ordinals: IntArray,
    table: FaultTable, seed: int, faults: IntArray,
) -> None:  # fmt: skip
    """Fill the faults of a phase by head and knot, in the order of causes, and move the positions on."""
    n = 0
    for head in range(row.counts.shape[0]):
        begin = n
        for cause in range(OF_A_HEAD):
            until = passed[cause, head] + exposure(cause, head, row, phase, out)
            while positions[cause, head] < until:
                ordinal = ordinals[cause, head]
                _locate(row, phase, out, positions[cause, head] - passed[cause, head], head, cause, faults[n])
                faults[n, ORDINAL] = ordinal
                _draw(table, seed, faults[n])
                ordinals[cause, head] = ordinal + 1
                positions[cause, head] += distance(table, cause, head, seed, ordinal + 1)
                n += 1
        _sort(faults[begin:n])


@compiled
def _locate(  # noqa: PLR0917
    row: RowKnots, phase: int, out: PhaseTimes, position: int, head: int, cause: int, fault: IntArray
) -> None:
    """Fill head, cause and knot of a fault at a position of the phase, and the end of the knot's first attempt."""
    begin = row.first[head, phase]
    before = end = k = 0
    while True:
        end += out.lasts[begin + k]
        before += UNIT if cause == _MISS else row.yarns[head, row.tubes[begin + k]]
        if position < before:
            break
        k += 1
    fault[HEAD], fault[KNOT], fault[CAUSE], fault[END] = head, k, cause, end


@compiled
def _draw(table: FaultTable, seed: int, fault: IntArray) -> None:
    """Fill what follows from a fault: attempts of the head, and the operator's times if he is called."""
    cause, head, ordinal = fault[CAUSE], fault[HEAD], fault[ORDINAL]
    tried, calls = 0, 1
    if cause == _MISS:
        while tried < table.retries and calls == 1:
            drawn = word(seed, stream(cause, RETRY, head), 128 * ordinal + tried)
            calls = 1 if happens(drawn, table.fails) else 0
            tried += 1
    fault[RETRIES], fault[CALLS] = tried, calls
    fault[RESPONDS] = responds(table, seed, cause, head, ordinal) if calls else 0
    fault[REPAIRS] = erlang_time(table.repairs[cause], seed, stream(cause, REPAIR, head), ordinal) if calls else 0


@compiled
def responds(table: FaultTable, seed: int, cause: int, head: int, ordinal: int) -> int:
    """Time from a call until the operator comes, with his work at other looms."""
    time = exponential_time(table.response, seed, stream(cause, RESPONSE, head), ordinal)
    if happens(word(seed, stream(cause, QUEUE, head), ordinal), table.busy):
        time += exponential_time(table.queue, seed, stream(cause, WAITS, head), ordinal)
    return time


@compiled
def _sort(faults: IntArray) -> None:
    """Sort the faults of a head by knot, keeping the order of causes and ordinals: they are few."""
    for i in range(1, len(faults)):
        j = i
        while j > 0 and faults[j - 1, KNOT] > faults[j, KNOT]:
            for column in range(FAULT_COLUMNS):
                faults[j - 1, column], faults[j, column] = faults[j, column], faults[j - 1, column]
            j -= 1


@compiled
def delay_phase(faults: IntArray, base: IntArray, knot: int, halts: int) -> tuple[int, int, int]:
    """When the phase ends: without faults, with the heads' further attempts, and with all waits.

    The calls are served in the order of their times; of two at one time, that of the lower head first. If the loom
    halts, all heads stand still from a call to the end of the repair; CALL and the ends of knots are then times of
    production. Fills CALL and WAIT.
    """
    heads = len(base)
    extra, tries, at = np.zeros(heads, np.int64), np.zeros(heads, np.int64), np.zeros(heads, np.int64)
    for i in range(len(faults) - 1, -1, -1):
        at[faults[i, HEAD]] = i
    halted = free = 0
    while True:
        called, least = -1, NEVER
        for head in range(heads):
            i = _next_call(faults, head, at, extra, tries, knot)
            if i >= 0 and faults[i, END] + extra[head] + knot * faults[i, RETRIES] < least:
                called, least = i, faults[i, END] + extra[head] + knot * faults[i, RETRIES]
        if called < 0:
            break
        fault = faults[called]
        head, tried = fault[HEAD], knot * (fault[RETRIES] + 1)
        fault[CALL] = least
        if halts:
            fault[WAIT] = fault[RESPONDS] + fault[REPAIRS]
            halted += fault[WAIT]
        else:
            free = max(least + fault[RESPONDS], free) + fault[REPAIRS]
            fault[WAIT] = free - least
            extra[head] += fault[WAIT]
        extra[head] += tried
        tries[head] += tried
        at[head] += 1
    return int(np.max(base)), int(np.max(base + tries)), int(np.max(base + extra) + halted)


@compiled
def _next_call(faults: IntArray, head: int, at: IntArray, extra: IntArray, tries: IntArray, knot: int) -> int:  # noqa: PLR0917
    """Index of the next fault of a head for which it calls, -1: none; adds the further attempts of those before."""
    i = at[head]
    while i < len(faults) and faults[i, HEAD] == head:
        if faults[i, CALLS]:
            at[head] = i
            return int(i)
        extra[head] += knot * faults[i, RETRIES]
        tries[head] += knot * faults[i, RETRIES]
        i += 1
    at[head] = i
    return -1
