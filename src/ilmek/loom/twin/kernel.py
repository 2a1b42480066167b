"""Kernels of the run of a carpet: the events of its operations for one seed, and the sums of many seeds.

An event is four whole numbers of 64 bits:

    start [ns]    end [ns]    row * 2^32 + column    head * 2^16 + tube * 2^8 + outcome

Operations of the whole loom have head NO_HEAD and, as column and tube, the number of the operation (`RowEnd`) or of the
change in its stop. The order is that of the programme: row by row, phase by phase, head by head, knot by knot.
"""

from typing import NamedTuple, TypeAlias

import numpy as np

from ilmek.arrays import IntArray
from ilmek.loom.twin.faults import FaultTable
from ilmek.loom.twin.phase import (
    CALL,
    CALLS,
    CAUSE,
    FAULT_COLUMNS,
    HEAD,
    KNOT,
    REPAIR,
    REPAIRS,
    RESPONDS,
    RETRIES,
    WAIT,
    PhaseTimes,
    RowKnots,
    count_faults,
    delay_phase,
    distance,
    responds,
    stream,
    take_faults,
)
from ilmek.loom.twin.random import erlang_time
from ilmek.num.compiled import compiled

Whole: TypeAlias = int | np.int64

NO_HEAD = 0xFFFF
DONE, CHANGED = 0, 16
"""Outcomes: a knot tied or an operation done, a package changed. That of a fault is 1 + its index in `CAUSES`."""

START, FINISH, WHERE, WHAT = range(4)
"""Columns of an event."""

TIME, TRIED, STOPPED, FAILED, COUNTS, ALL_CALLS, WORK = 0, 1, 2, 3, 4, 10, 16
"""Columns of the sums of a seed: the carpet's time, time of further attempts, standstill, and failed attempts; then for
each cause the faults, the calls of the operator and his time from call to repair."""

SUM_COLUMNS = 22


@compiled
def count_failed(faults: IntArray) -> int:
    """Failed attempts of the faults of a phase."""
    failed = 0
    for i in range(len(faults)):
        failed += faults[i, RETRIES] + faults[i, CALLS]
    return failed


@compiled
def tie_events(  # noqa: PLR0917
    row: RowKnots, phase: int, number: int, out: PhaseTimes, faults: IntArray, start: int, knot: int, halts: int
) -> IntArray:
    """The events of a phase of a row that begins at `start`. faults: as `delay_phase` left them."""
    events = np.empty((np.sum(row.counts[:, phase]) + count_failed(faults), 4), np.int64)
    n = i = 0
    for head in range(row.counts.shape[0]):
        end = np.int64(0)
        first = row.first[head, phase]
        for k in range(row.counts[head, phase]):
            at = first + k
            where = (number << 32) + row.columns[at]
            what = (head << 16) + (np.int64(row.tubes[at]) << 8)
            begin, end = end, end + out.lasts[at]
            while i < len(faults) and faults[i, HEAD] == head and faults[i, KNOT] == k:
                outcome, calls = what + 1 + faults[i, CAUSE], faults[i, CALLS]
                for _ in range(faults[i, RETRIES] + calls):
                    _write(events[n], begin, end, where, outcome)
                    n += 1
                    begin, end = end, end + knot
                if calls and not halts:
                    begin, end = begin + faults[i, WAIT], end + faults[i, WAIT]
                i += 1
            _write(events[n], begin, end, where, what)
            n += 1
    if halts and len(faults):
        _halt(events, faults)
    events[:, START] += start
    events[:, FINISH] += start
    return events


@compiled
def _write(event: IntArray, begin: Whole, end: Whole, where: Whole, what: Whole) -> None:
    event[START], event[FINISH], event[WHERE], event[WHAT] = begin, end, where, what


@compiled
def _halt(events: IntArray, faults: IntArray) -> None:
    """Delay events in times of production by the standstills before them."""
    for n in range(len(events)):
        begin, end = events[n, START], events[n, FINISH]
        for i in range(len(faults)):
            if faults[i, CALLS]:
                events[n, START] += faults[i, WAIT] if faults[i, CALL] <= begin else 0
                events[n, FINISH] += faults[i, WAIT] if faults[i, CALL] < end else 0


@compiled
def find_faults(  # noqa: PLR0917
    row: RowKnots, phase: int, out: PhaseTimes, passed: IntArray, positions: IntArray, ordinals: IntArray,
    table: FaultTable, seed: int,
) -> IntArray:  # fmt: skip
    """The faults of a phase of a seed, without their calls and waits. The positions are moved on."""
    n = count_faults(row, phase, out, passed, positions, ordinals, table, seed)
    faults = np.zeros((n, FAULT_COLUMNS), np.int64)
    if n:
        take_faults(row, phase, out, passed, positions, ordinals, table, seed, faults)
    return faults


class LoomEnd(NamedTuple):
    """An operation after the knots: its time [ns]; of the causes that interrupt it the first, and that after them."""

    lasts: int
    first: int
    last: int


@compiled
def end_faults(  # noqa: PLR0917
    end: LoomEnd, passed: IntArray, positions: IntArray, ordinals: IntArray, table: FaultTable, seed: int
) -> IntArray:
    """Faults of an operation after the knots: cause, response and repair of each. The positions are moved on.

    passed  exposures of each cause after the operation
    """
    n = 0
    found = np.empty((0, 3), np.int64)
    for cause in range(end.first, end.last):
        while positions[cause, 0] < passed[cause, 0]:
            ordinal = ordinals[cause, 0]
            if n == len(found):
                grown = np.empty((2 * n + 4, 3), np.int64)
                grown[:n] = found
                found = grown
            found[n, 0] = cause
            found[n, 1] = responds(table, seed, cause, 0, ordinal)
            found[n, 2] = erlang_time(table.repairs[cause], seed, stream(cause, REPAIR, 0), ordinal)
            ordinals[cause, 0] = ordinal + 1
            positions[cause, 0] += distance(table, cause, 0, seed, ordinal + 1)
            n += 1
    return found[:n]


class Seeds(NamedTuple):
    """Runs of many seeds side by side: seeds (n), positions and ordinals (n, causes, heads), sums (n, SUM_COLUMNS)."""

    seeds: IntArray
    positions: IntArray
    ordinals: IntArray
    sums: IntArray


@compiled
def seeds_phase(  # noqa: PLR0917
    row: RowKnots, phase: int, out: PhaseTimes, passed: IntArray, table: FaultTable, knot: int, runs: Seeds
) -> None:
    """Add a phase to the sums of all seeds."""
    base = np.max(out.base)
    for s in range(len(runs.seeds)):
        sums, positions, ordinals, seed = runs.sums[s], runs.positions[s], runs.ordinals[s], runs.seeds[s]
        n = count_faults(row, phase, out, passed, positions, ordinals, table, seed)
        if n == 0:
            sums[TIME] += base
            continue
        faults = np.zeros((n, FAULT_COLUMNS), np.int64)
        take_faults(row, phase, out, passed, positions, ordinals, table, seed, faults)
        _, tried, ended = delay_phase(faults, out.base, knot, table.halts)
        sums[TIME] += ended
        sums[TRIED] += tried - base
        sums[STOPPED] += ended - tried
        sums[FAILED] += count_failed(faults)
        for i in range(n):
            cause = faults[i, CAUSE]
            sums[COUNTS + cause] += 1
            sums[ALL_CALLS + cause] += faults[i, CALLS]
            sums[WORK + cause] += faults[i, RESPONDS] + faults[i, REPAIRS]


@compiled
def seeds_end(end: LoomEnd, passed: IntArray, table: FaultTable, runs: Seeds) -> None:
    """Add an operation after the knots to the sums of all seeds."""
    for s in range(len(runs.seeds)):
        sums, positions = runs.sums[s], runs.positions[s]
        sums[TIME] += end.lasts
        due = False
        for cause in range(end.first, end.last):
            due = due or positions[cause, 0] < passed[cause, 0]
        if due:
            found = end_faults(end, passed, positions, runs.ordinals[s], table, runs.seeds[s])
            for i in range(len(found)):
                cause, work = found[i, 0], found[i, 1] + found[i, 2]
                sums[TIME] += end.lasts + work
                sums[TRIED] += end.lasts
                sums[STOPPED] += work
                sums[COUNTS + cause] += 1
                sums[ALL_CALLS + cause] += 1
                sums[WORK + cause] += work
