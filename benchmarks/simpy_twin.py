"""The whole carpet as processes of SimPy: heads, loom and operator, on the same operations and the same faults."""

from collections.abc import Generator
from typing import Any

import numpy as np
import simpy

from ilmek.arrays import IntArray
from ilmek.loom.operations import LoomProgramme
from ilmek.loom.twin.durations import stop_duration
from ilmek.loom.twin.faults import CAUSES, FaultTable
from ilmek.loom.twin.kernel import end_faults, find_faults
from ilmek.loom.twin.phase import CALLS, HEAD, KNOT, REPAIRS, RESPONDS, RETRIES, RowKnots, begin_positions
from ilmek.loom.twin.walk import Walk, stops_before

Process = Generator[Any, Any, None]


class SimpyTwin:
    """A loom whose other heads finish their phase while one waits; `time` [ns] and `events` are the result."""

    def __init__(self, programme: LoomProgramme, table: FaultTable, seed: int) -> None:
        self.walk, self.table, self.seed = Walk(programme), table, seed
        shape = (len(CAUSES), programme.setup.heads)
        self.positions, self.ordinals = np.zeros(shape, np.int64), np.zeros(shape, np.int64)
        begin_positions(table, seed, self.positions, self.ordinals)
        self.env = simpy.Environment()
        self.operator = simpy.Resource(self.env, capacity=1)
        self.events = 0
        self.env.run(self.env.process(self.loom()))
        self.time = int(self.env.now)

    def loom(self) -> Process:
        for row, knots in self.walk.rows():
            for phase in range(row.phases):
                for stop in stops_before(row, phase):
                    yield self.env.timeout(stop_duration(stop, self.walk.setup))
                    self.walk.change(stop)
                yield self.phase(knots, phase)
            for operation in row.ends:
                yield from self.end(operation)

    def phase(self, knots: RowKnots, phase: int) -> simpy.Event:
        walk = self.walk
        out = walk.phase(knots, phase)
        faults = find_faults(knots, phase, out, walk.passed, self.positions, self.ordinals, self.table, self.seed)
        walk.pass_phase(knots, phase, out)
        heads = []
        for head in range(walk.setup.heads):
            first = int(knots.first[head, phase])
            lasts = out.lasts[first : first + int(knots.counts[head, phase])].tolist()
            heads.append(self.env.process(self.head(lasts, faults[faults[:, HEAD] == head])))
        return self.env.all_of(heads)

    def head(self, lasts: list[int], faults: IntArray) -> Process:
        waiting = faults.tolist()
        for number, time in enumerate(lasts):
            yield from self.attempt(time)
            while waiting and waiting[0][KNOT] == number:
                fault = waiting.pop(0)
                for _ in range(fault[RETRIES]):
                    yield from self.attempt(self.walk.durations.knot)
                if fault[CALLS]:
                    yield from self.call(fault[RESPONDS], fault[REPAIRS])
                    yield from self.attempt(self.walk.durations.knot)

    def attempt(self, time: int) -> Process:
        self.events += 1
        yield self.env.timeout(time)

    def call(self, responds: int, repairs: int) -> Process:
        """The operator comes after his response, or when he has ended the repair before."""
        called = self.env.now
        with self.operator.request() as request:
            yield request
            yield self.env.timeout(max(called + responds - self.env.now, 0) + repairs)

    def end(self, operation: Any) -> Process:
        end = self.walk.end(operation)
        found = end_faults(end, self.walk.passed, self.positions, self.ordinals, self.table, self.seed)
        for _, responds, repairs in found.tolist():
            yield from self.attempt(end.lasts)
            yield from self.call(responds, repairs)
        yield from self.attempt(end.lasts)
