"""A programme row by row, in the arrays of the kernels: what a run of one seed and the runs of many have in common."""

from collections.abc import Iterator

import numpy as np

from ilmek.arrays import IntArray
from ilmek.loom.operations import EMPTY, LoomProgramme, LoomSetup, RowEnd, RowOperations, Stop
from ilmek.loom.twin.durations import Durations, durations_of
from ilmek.loom.twin.faults import CAUSES, OF_A_HEAD, UNIT
from ilmek.loom.twin.kernel import LoomEnd
from ilmek.loom.twin.phase import PhaseTimes, RowKnots, time_knots
from ilmek.progress import SILENT, Progress

WEFTS, BEATS = (3, 5), (5, 6)
"""Causes that interrupt a weft, and a beat: the first, and the one after the last."""

_INTERRUPTED = {
    RowEnd.STRAIGHT_WEFT: WEFTS,
    RowEnd.SINUOUS_WEFT: WEFTS,
    RowEnd.FIRST_BEAT: BEATS,
    RowEnd.SECOND_BEAT: BEATS,
}


class Walk:
    """A walk over the rows of a programme.

    passed   exposures so far to each cause, (causes, heads); those of the whole loom under head 0
    yarns    pile yarn of a knot from each tube of each head [um]; loaded: yarn of each tube
    tied     knots from each tube since its package was put on
    """

    def __init__(self, programme: LoomProgramme) -> None:
        self.programme, self.setup = programme, programme.setup
        self.durations: Durations = durations_of(self.setup.times)
        heads = self.setup.heads
        self.times = (self.durations.knot, self.durations.colour_change, self.durations.travel)
        self.loaded = np.array(self.setup.loading, np.uint8)
        self.yarns = _yarns(self.setup, self.loaded)
        self.tied = np.zeros(self.loaded.shape, np.int64)
        self.passed = np.zeros((len(CAUSES), heads), np.int64)
        self._states = np.full((heads, 2), -1, np.int64)
        self._heads = np.zeros((4, heads), np.int64)
        self._ends = {end: LoomEnd(self.durations.of_end(end), *_INTERRUPTED.get(end, (0, 0))) for end in RowEnd}

    def rows(self, progress: Progress = SILENT) -> Iterator[tuple[RowOperations, RowKnots]]:
        """The rows in order, with their knots. `phase` and `end` are to be called for each phase and operation."""
        for number in range(self.setup.rows):
            row = self.programme.operations(number)
            counts = np.ascontiguousarray(row.counts, np.int64)
            first = row.starts[:-1, None] + np.cumsum(counts, axis=1) - counts
            self._states[:, 0] = -1
            columns, tubes = np.ascontiguousarray(row.columns, np.int32), np.ascontiguousarray(row.tubes, np.uint8)
            yield row, RowKnots(columns, tubes, np.ascontiguousarray(first, np.int64), counts, self.yarns)
            progress((number + 1) / self.setup.rows)

    def phase(self, row: RowKnots, phase: int) -> PhaseTimes:
        """The times of a phase. `passed` has the exposures before it until `pass_phase` is called."""
        base, yarn, changes, idle = self._heads
        out = PhaseTimes(np.empty(len(row.columns), np.int64), base, yarn, changes, idle, self.tied)
        time_knots(row, phase, self.times, self._states, out)
        return out

    def pass_phase(self, row: RowKnots, phase: int, out: PhaseTimes) -> None:
        """Add a phase to the exposures."""
        knots = UNIT * row.counts[:, phase]
        for cause, exposures in zip(range(OF_A_HEAD), (out.yarn, out.yarn, knots), strict=True):
            self.passed[cause] += exposures

    def end(self, operation: RowEnd) -> LoomEnd:
        """An operation after the knots; its exposures are added."""
        end = self._ends[operation]
        for cause in range(end.first, end.last):
            self.passed[cause, 0] += UNIT
        return end

    def change(self, stop: Stop) -> None:
        """Put new packages on tubes."""
        for tube in stop.tubes:
            self.loaded[tube.head, tube.tube] = tube.yarn
            self.yarns[tube.head, tube.tube] = yarn_of_a_knot(self.setup, tube.yarn)
            self.tied[tube.head, tube.tube] = 0


def stops_before(row: RowOperations, phase: int) -> tuple[Stop, ...]:
    """The stops of a row before a phase."""
    return tuple(stop for stop in row.stops if stop.phase == phase)


def yarn_of_a_knot(setup: LoomSetup, yarn: int) -> int:
    """Pile yarn of a knot of a yarn [um]; 0 for none."""
    return 0 if yarn == EMPTY else round(1e6 * setup.knot_yarn[yarn])


def _yarns(setup: LoomSetup, loaded: IntArray) -> IntArray:
    lengths = np.zeros(256, np.int64)
    lengths[: len(setup.knot_yarn)] = [round(1e6 * length) for length in setup.knot_yarn]
    return np.ascontiguousarray(lengths[loaded])
