"""The run of a carpet for one seed: every operation as an event, its digest, and what the time was used for."""

import hashlib
from collections.abc import Callable

import numpy as np

from ilmek.arrays import IntArray
from ilmek.loom.operations import LoomProgramme, RowOperations, Stop
from ilmek.loom.twin.durations import change_durations
from ilmek.loom.twin.faults import CAUSES, FaultTable
from ilmek.loom.twin.kernel import (
    ALL_CALLS,
    CHANGED,
    COUNTS,
    FAILED,
    NO_HEAD,
    STOPPED,
    SUM_COLUMNS,
    TIME,
    TRIED,
    WORK,
    LoomEnd,
    end_faults,
    find_faults,
    tie_events,
)
from ilmek.loom.twin.packages import Packages
from ilmek.loom.twin.phase import (
    CALL,
    CALLS,
    CAUSE,
    HEAD,
    KNOT,
    REPAIRS,
    RESPONDS,
    RETRIES,
    WAIT,
    PhaseTimes,
    RowKnots,
    begin_positions,
    delay_phase,
)
from ilmek.loom.twin.walk import Walk, stops_before
from ilmek.progress import SILENT, Progress
from ilmek.records import record

BINS = 240
"""Largest number of spans of rows in which the use of the heads' time is kept."""

TYING, CHANGING, TRAVELLING, RETRYING, OPERATOR, WAITING, ROW_END, PLANNED = range(8)
"""What a head's time is used for: knots, colour changes, travel, further attempts, waiting for the operator, for slower
heads, operations after the knots, planned stops."""

USES = ("tying", "changing", "travelling", "retrying", "stopped", "waiting", "row_ends", "planned")

LONGEST_DETAIL = 200_000
"""Largest number of events of a row that are kept to draw it."""

MOST_FAULTS = 200_000
"""Largest number of faults that are kept one by one; all are counted."""

FAULT_FIELDS = ("row", "head", "column", "tube", "cause", "attempts", "call", "wait")
"""Columns of `CarpetRun.faults`: failed attempts; time of the call [ns] (of a fault without one: -1), and wait [ns]."""


@record
class CarpetRun:
    """A carpet woven once.

    time       from the first knot to the end of the last row [ns]
    digest     SHA-256 of all events, as little-endian words
    rows       (rows, 4): end, time of knots, standstill for the operator, planned stops of each row [ns]
    uses       (bins, heads, uses): time of each head by use, over spans of `rows_per_bin` rows [ns]
    last       how often each head was the last of a phase     base      time without faults [ns]
    changes    colour changes of each head                     sums      as of `ilmek.loom.twin.kernel`
    lost       standstill of the loom by cause [ns]            faults    the first MOST_FAULTS: FAULT_FIELDS
    packages   use of the pile yarn
    slowest    row that took longest, its begin [ns], and its events (none if there are more than LONGEST_DETAIL)
    """

    seed: int
    time: int
    base: int
    knots: int
    digest: str
    rows: IntArray
    uses: IntArray
    rows_per_bin: int
    last: IntArray
    changes: IntArray
    sums: IntArray
    lost: IntArray
    faults: IntArray
    packages: Packages
    slowest: tuple[int, int, IntArray]


def run_carpet(
    programme: LoomProgramme,
    table: FaultTable,
    seed: int,
    *,
    waste: float = 0.0,
    take: Callable[[RowOperations, IntArray], None] | None = None,
    progress: Progress = SILENT,
) -> CarpetRun:
    """Weave a carpet.

    waste  pile yarn lost by a repair at a head [m]
    take   is given the events of each row, (events, 4)
    Raises the errors of the programme; Cancelled.
    """
    weaving = _Weaving(programme, table, seed, waste)
    for row, knots in weaving.walk.rows(progress):
        events = weaving.weave(row, knots)
        if take is not None:
            take(row, events)
    return weaving.result()


class _Weaving:
    """The state of a run: the loom's clock, the faults to come, and the accounts."""

    def __init__(self, programme: LoomProgramme, table: FaultTable, seed: int, waste: float) -> None:
        self.walk, self.table, self.seed = Walk(programme), table, seed
        setup = self.walk.setup
        self.heads, self.now, self.base = setup.heads, 0, 0
        shape = (len(CAUSES), self.heads)
        self.positions, self.ordinals = np.zeros(shape, np.int64), np.zeros(shape, np.int64)
        begin_positions(table, seed, self.positions, self.ordinals)
        self.per_bin = -(-setup.rows // BINS)
        self.uses = np.zeros((-(-setup.rows // self.per_bin), self.heads, len(USES)), np.int64)
        self.rows = np.zeros((setup.rows, 4), np.int64)
        self.sums, self.lost = np.zeros(SUM_COLUMNS, np.int64), np.zeros(len(CAUSES), np.int64)
        self.last, self.changes = np.zeros(self.heads, np.int64), np.zeros(self.heads, np.int64)
        self.packages = Packages(setup, waste)
        self.faults: list[tuple[int, ...]] = []
        self.digest, self.knots = hashlib.sha256(), 0
        self.slowest: tuple[int, int, IntArray] = (0, 0, np.empty((0, 4), np.int64))
        self._longest = -1

    def weave(self, row: RowOperations, knots: RowKnots) -> IntArray:
        """Weave a row; its events."""
        began, found = self.now, []
        use = self.uses[row.number // self.per_bin]
        for phase in range(row.phases):
            found += [self._stop(stop, use) for stop in stops_before(row, phase)]
            found.append(self._phase(row.number, knots, phase, use))
        found.append(self._ends(row, use))
        events = np.concatenate(found)
        self.digest.update(events.astype("<i8", copy=False).tobytes())
        self.knots += len(row.columns)
        self.rows[row.number, 0] = self.now
        if self.now - began > self._longest:
            self._longest = self.now - began
            self.slowest = (row.number, began, events if len(events) <= LONGEST_DETAIL else events[:0])
        return events

    def _stop(self, stop: Stop, use: IntArray) -> IntArray:
        """The planned changes, one after the other."""
        lasts = change_durations(stop, self.walk.setup)
        self.packages.change(stop, self.walk)
        self.walk.change(stop)
        ends = self.now + np.cumsum([0, *lasts])
        events = [(ends[n], ends[n + 1], (stop.row << 32) + n, (NO_HEAD << 16) + CHANGED) for n in range(len(lasts))]
        self._advance(int(ends[-1]) - self.now)
        self.base += sum(lasts)
        self.rows[stop.row, 3] += sum(lasts)
        use[:, PLANNED] += sum(lasts)
        return np.array(events, np.int64).reshape(-1, 4)

    def _phase(self, number: int, knots: RowKnots, phase: int, use: IntArray) -> IntArray:
        """The knots of a phase."""
        walk, table = self.walk, self.table
        out = walk.phase(knots, phase)
        faults = find_faults(knots, phase, out, walk.passed, self.positions, self.ordinals, table, self.seed)
        walk.pass_phase(knots, phase, out)
        knot, base = walk.durations.knot, int(np.max(out.base))
        tried = ended = base
        if len(faults):
            _, tried, ended = delay_phase(faults, out.base, knot, table.halts)
        events: IntArray = tie_events(knots, phase, number, out, faults, self.now, knot, table.halts)
        self._book(number, knots, phase, out, faults, use, ended)
        self.sums[TRIED] += tried - base
        self.sums[STOPPED] += ended - tried
        self.rows[number, 1] += tried
        self.rows[number, 2] += ended - tried
        self._advance(ended)
        self.base += base
        return events

    def _book(  # noqa: PLR0917
        self, number: int, knots: RowKnots, phase: int, out: PhaseTimes, faults: IntArray, use: IntArray, ended: int
    ) -> None:
        """Add a phase to the accounts of the heads; a head that has ended waits for the slowest."""
        durations, counts = self.walk.durations, knots.counts[:, phase]
        tries, waits = np.zeros(self.heads, np.int64), np.zeros(self.heads, np.int64)
        for fault, late in zip(faults, self._standstills(faults), strict=True):
            tries[fault[HEAD]] += durations.knot * (fault[RETRIES] + fault[CALLS])
            waits[slice(None) if self.table.halts else fault[HEAD]] += fault[WAIT]
            self._note(number, knots, phase, fault, self.now + int(fault[CALL]) + late)
        use[:, TYING] += durations.knot * counts
        use[:, CHANGING] += durations.colour_change * out.changes
        use[:, TRAVELLING] += durations.travel * out.idle
        use[:, RETRYING] += tries
        use[:, OPERATOR] += waits
        busy = out.base + tries + waits
        use[:, WAITING] += ended - busy
        self.changes += out.changes
        self.last[int(np.argmax(busy))] += 1
        self._attribute(faults, ended - int(np.max(out.base + tries)), int(np.argmax(busy)))

    def _attribute(self, faults: IntArray, lost: int, last: int) -> None:
        """Standstill of the loom by cause: if it halts, each its own; else the longest wait of the last head has it."""
        if self.table.halts:
            np.add.at(self.lost, faults[:, CAUSE], faults[:, WAIT])
        elif lost > 0:
            own = faults[faults[:, HEAD] == last]
            self.lost[own[np.argmax(own[:, WAIT]), CAUSE]] += lost

    def _standstills(self, faults: IntArray) -> list[int]:
        """Standstill of a loom that halts before each fault of a phase [ns]; calls are served by time, then by head."""
        late = np.zeros(len(faults), np.int64)
        if self.table.halts:
            order = np.lexsort((faults[:, HEAD], faults[:, CALL]))
            late[order] = np.cumsum(faults[order, WAIT]) - faults[order, WAIT]
        return [int(one) for one in late]

    def _note(self, number: int, knots: RowKnots, phase: int, fault: IntArray, called: int) -> None:
        """Add a fault of a head to the lists."""
        head, cause, calls = int(fault[HEAD]), int(fault[CAUSE]), int(fault[CALLS])
        at = int(knots.first[head, phase] + fault[KNOT])
        tube, attempts = int(knots.tubes[at]), int(fault[RETRIES] + calls)
        self.packages.lose(self.walk, head, tube, attempts, calls)
        call = called if calls else -1
        self._keep((number, head, int(knots.columns[at]), tube, cause, attempts, call, int(fault[WAIT])))
        self._count(cause, attempts, calls, int(fault[RESPONDS] + fault[REPAIRS]))

    def _keep(self, fault: tuple[int, ...]) -> None:
        if len(self.faults) < MOST_FAULTS:
            self.faults.append(fault)

    def _count(self, cause: int, attempts: int, calls: int, work: int) -> None:
        self.sums[FAILED] += attempts if cause < 3 else 0
        self.sums[COUNTS + cause] += 1
        self.sums[ALL_CALLS + cause] += calls
        self.sums[WORK + cause] += work

    def _ends(self, row: RowOperations, use: IntArray) -> IntArray:
        """Wefts, beats and take-up; a weft that breaks is laid again, a beat with a broken warp is beaten again."""
        events = []
        for operation in row.ends:
            end = self.walk.end(operation)
            where, what = (row.number << 32) + int(operation), NO_HEAD << 16
            for cause, responds, repairs in self._faults_of(end):
                events.append((self.now, self.now + end.lasts, where, what + 1 + cause))
                wait = responds + repairs
                self._keep((row.number, -1, -1, -1, cause, 1, self.now + end.lasts, wait))
                self._count(cause, 1, 1, wait)
                self.sums[TRIED] += end.lasts
                self.sums[STOPPED] += wait
                self.lost[cause] += wait
                self.rows[row.number, 2] += wait
                use[:, RETRYING] += end.lasts
                use[:, OPERATOR] += wait
                self._advance(end.lasts + wait)
            events.append((self.now, self.now + end.lasts, where, what))
            use[:, ROW_END] += end.lasts
            self._advance(end.lasts)
            self.base += end.lasts
        return np.array(events, np.int64).reshape(-1, 4)

    def _faults_of(self, end: LoomEnd) -> list[list[int]]:
        """Cause, response and repair of the faults of an operation after the knots."""
        causes = range(end.first, end.last)
        if all(self.positions[cause, 0] >= self.walk.passed[cause, 0] for cause in causes):
            return []
        found = end_faults(end, self.walk.passed, self.positions, self.ordinals, self.table, self.seed)
        return [[int(number) for number in fault] for fault in found]

    def _advance(self, time: int) -> None:
        self.now += time
        self.sums[TIME] = self.now

    def result(self) -> CarpetRun:
        self.packages.finish(self.walk)
        return CarpetRun(
            seed=self.seed,
            time=self.now,
            base=self.base,
            knots=self.knots,
            digest=self.digest.hexdigest(),
            rows=self.rows,
            uses=self.uses,
            rows_per_bin=self.per_bin,
            last=self.last,
            changes=self.changes,
            sums=self.sums,
            lost=self.lost,
            faults=np.array(self.faults, np.int64).reshape(-1, len(FAULT_FIELDS)),
            packages=self.packages,
            slowest=self.slowest,
        )
