"""The twin's rules written down plainly: one event after the other from a heap, in Python's own whole numbers."""

import hashlib
import heapq
import struct
from collections import defaultdict
from typing import Any

from ilmek.loom.operations import LoomProgramme, RowOperations
from ilmek.loom.twin.faults import FaultTable

MASK = (1 << 64) - 1
GOLDEN = 0x9E3779B97F4A7C15
LN_2 = 744261118
UNIT, MISS, NO_HEAD = 1024, 2, 0xFFFF


def mixed(h: int) -> int:
    h = ((h ^ (h >> 30)) * 0xBF58476D1CE4E5B9) & MASK
    h = ((h ^ (h >> 27)) * 0x94D049BB133111EB) & MASK
    return h ^ (h >> 31)


def plain_word(seed: int, stream: int, ordinal: int) -> int:
    h = mixed((seed + GOLDEN) & MASK)
    h = mixed((h + stream + GOLDEN) & MASK)
    return mixed((h + ordinal + GOLDEN) & MASK) >> 1


def plain_exponential(drawn: int) -> int:
    m = drawn | 1
    log2 = m.bit_length() - 1
    x = (m << (62 - log2)) >> 32
    for _ in range(24):
        x = (x * x) >> 30
        log2 = 2 * log2 + (x >> 31)
        x >>= x >> 31
    return (((63 << 24) - log2) * LN_2) >> 34


def time_of(mean: int, drawn: int) -> int:
    share = plain_exponential(drawn)
    return (mean >> 20) * share + (((mean & 0xFFFFF) * share) >> 20)


class PlainFaults:
    """The faults of a seed, cause by cause and head by head, in the order of their positions."""

    def __init__(self, table: FaultTable, seed: int) -> None:
        self.table, self.seed = table, seed
        self.passed: dict[tuple[int, int], int] = defaultdict(int)
        self.ordinal: dict[tuple[int, int], int] = defaultdict(int)
        self.position: dict[tuple[int, int], int] = {}

    def draw(self, cause: int, purpose: int, head: int, ordinal: int) -> int:
        return plain_word(self.seed, ((cause * 8 + purpose) << 16) + head, ordinal)

    def within(self, cause: int, head: int, exposure: int) -> list[int]:
        """Ordinals of the faults in the next piece of exposure."""
        key, gap = (cause, head), int(self.table.gaps[cause])
        self.passed[key] += exposure
        if gap == 0:
            return []
        self.position.setdefault(key, time_of(gap, self.draw(cause, 0, head, 0)))
        found = []
        while self.position[key] < self.passed[key]:
            found.append(self.ordinal[key])
            self.ordinal[key] += 1
            self.position[key] += time_of(gap, self.draw(cause, 0, head, self.ordinal[key]))
        return found

    def operator(self, cause: int, head: int, ordinal: int) -> tuple[int, int]:
        """Response and repair."""
        table = self.table
        response = time_of(table.response, self.draw(cause, 1, head, ordinal))
        if self.draw(cause, 2, head, ordinal) >> 31 < table.busy:
            response += time_of(table.queue, self.draw(cause, 3, head, ordinal))
        repair = sum(time_of(int(table.repairs[cause]), self.draw(cause, 4, head, 4 * ordinal + k)) for k in range(4))
        return response, repair >> 2

    def attempts(self, cause: int, head: int, ordinal: int) -> tuple[int, bool]:
        """Attempts of the head after a fault, and whether it calls then."""
        if cause != MISS:
            return 0, True
        for attempt in range(self.table.retries):
            if self.draw(cause, 5, head, 128 * ordinal + attempt) >> 31 >= self.table.fails:
                return attempt + 1, False
        return self.table.retries, True


class PlainTwin:
    """A run of a carpet. `time` and `events` are the result."""

    def __init__(self, programme: LoomProgramme, table: FaultTable, seed: int) -> None:
        self.programme, self.setup, self.table = programme, programme.setup, table
        self.faults = PlainFaults(table, seed)
        times = self.setup.times
        self.knot, self.change, self.travel = (round(1e9 * t) for t in (times.knot, times.colour_change, times.travel))
        self.ends = [round(1e9 * t) for t in times.row_ends]
        self.loaded = self.setup.loading.tolist()
        self.tube: list[int | None] = [None] * self.setup.heads
        self.column: list[int | None] = [None] * self.setup.heads
        self.time = 0
        self.events: list[tuple[int, int, int, int]] = []
        for number in range(self.setup.rows):
            self.row(programme.operations(number))

    @property
    def digest(self) -> str:
        return hashlib.sha256(b"".join(struct.pack("<4q", *event) for event in self.events)).hexdigest()

    def row(self, row: RowOperations) -> None:
        self.column = [None] * self.setup.heads
        for phase in range(row.phases):
            for stop in row.stops:
                if stop.phase == phase:
                    self.stop(row, stop)
            self.phase(row, phase)
        for operation in row.ends:
            self.operation(row, operation)

    def stop(self, row: RowOperations, stop: Any) -> None:
        lasts = [self.setup.wefts[index].time for index in stop.wefts] + [self.setup.times.tube_change] * len(
            stop.tubes
        )
        for number, time in enumerate(lasts):
            end = self.time + round(1e9 * time)
            self.events.append((self.time, end, (row.number << 32) + number, (NO_HEAD << 16) + 16))
            self.time = end
        for change in stop.tubes:
            self.loaded[change.head][change.tube] = change.yarn

    def operation(self, row: RowOperations, operation: int) -> None:
        lasts = self.ends[operation] - (self.ends[operation - 1] if operation else 0)
        causes = {0: (3, 4), 2: (3, 4), 1: (5,), 3: (5,)}.get(operation, ())
        where = (row.number << 32) + operation
        for cause in causes:
            for ordinal in self.faults.within(cause, 0, UNIT):
                self.events.append((self.time, self.time + lasts, where, (NO_HEAD << 16) + 1 + cause))
                self.time += lasts + sum(self.faults.operator(cause, 0, ordinal))
        self.events.append((self.time, self.time + lasts, where, NO_HEAD << 16))
        self.time += lasts

    def knots(self, row: RowOperations, phase: int) -> list[list[dict[str, Any]]]:
        """The knots of each head in a phase, with the time of the first attempt and the faults."""
        starts, found = row.starts.tolist(), []
        for head in range(row.heads):
            begin = starts[head] + int(row.counts[head, :phase].sum())
            own = []
            for k in range(begin, begin + int(row.counts[head, phase])):
                column, tube = int(row.columns[k]), int(row.tubes[k])
                lasts = self.knot + (self.change if self.tube[head] not in (None, tube) else 0)
                last = self.column[head]
                if last is not None:
                    lasts += self.travel * max(abs(column - last) - 1, 0)
                self.column[head], self.tube[head] = column, tube
                yarn = round(1e6 * self.setup.knot_yarn[self.loaded[head][tube]])
                exposures = (yarn, yarn, UNIT)
                faults = [(c, o) for c in range(3) for o in self.faults.within(c, head, exposures[c])]
                own.append(dict(column=column, tube=tube, lasts=lasts, faults=faults))
            found.append(own)
        return found

    def phase(self, row: RowOperations, phase: int) -> None:
        work = [self.attempts(head, knots) for head, knots in enumerate(self.knots(row, phase))]
        made: list[list[tuple[int, int, int, int]]] = [[] for _ in work]
        heap: list[list[int]] = []
        at, free = [0] * len(work), 0
        for head, own in enumerate(work):
            if own:
                heap.append([self.time + own[0][0], head, self.time])
        heapq.heapify(heap)
        last = self.time
        resume = self.time
        while heap:
            end, head, begin = heapq.heappop(heap)
            _, column, tube, outcome, call = work[head][at[head]]
            made[head].append((begin, end, (row.number << 32) + column, (head << 16) + (tube << 8) + outcome))
            last, following = max(last, end), max(end, resume)
            if call and self.table.halts:
                for other in heap:
                    if other[0] > end:
                        other[0] += sum(call)
                        other[2] += sum(call) if other[2] >= end else 0
                heapq.heapify(heap)
                resume = following = max(end, resume) + sum(call)
            elif call:
                free = max(end + call[0], free) + call[1]
                following = free
            at[head] += 1
            if at[head] < len(work[head]):
                heapq.heappush(heap, [following + work[head][at[head]][0], head, following])
        self.time = last
        self.events += [event for own in made for event in own]

    def attempts(self, head: int, knots: list[dict[str, Any]]) -> list[tuple[int, int, int, int, Any]]:
        """Time, column, tube, outcome of each attempt of a head, and the operator's times where he is called."""
        found = []
        for one in knots:
            column, tube, lasts = one["column"], one["tube"], one["lasts"]
            for cause, ordinal in one["faults"]:
                again, calls = self.faults.attempts(cause, head, ordinal)
                failed = again + calls
                for number in range(failed):
                    call = self.faults.operator(cause, head, ordinal) if calls and number == failed - 1 else None
                    found.append((lasts, column, tube, 1 + cause, call))
                    lasts = self.knot
            found.append((lasts, column, tube, 0, None))
        return found
