"""The runs of a carpet for many seeds, side by side: the programme is read once, and faults alone are looked at.

A phase without a fault takes its known time; the position of the next fault is known ahead. Times and counts are those
of the run of each seed by itself, to the nanosecond.
"""

from collections.abc import Sequence

import numpy as np

from ilmek.arrays import IntArray
from ilmek.loom.operations import LoomProgramme
from ilmek.loom.twin.durations import stop_duration
from ilmek.loom.twin.faults import CAUSES, FaultTable
from ilmek.loom.twin.kernel import SUM_COLUMNS, TIME, Seeds, seeds_end, seeds_phase
from ilmek.loom.twin.phase import begin_positions
from ilmek.loom.twin.walk import Walk, stops_before
from ilmek.progress import SILENT, Progress

MOST_SEEDS = 1_000_000
"""Largest number of seeds."""


def run_seeds(
    programme: LoomProgramme, table: FaultTable, seeds: Sequence[int], *, progress: Progress = SILENT
) -> IntArray:
    """The sums of each seed's run, (seeds, SUM_COLUMNS), as of `ilmek.loom.twin.kernel`.

    Raises the errors of the programme; Cancelled.
    """
    walk = Walk(programme)
    shape = (len(seeds), len(CAUSES), walk.setup.heads)
    runs = Seeds(
        np.array(seeds, np.int64), np.zeros(shape, np.int64), np.zeros(shape, np.int64),
        np.zeros((len(seeds), SUM_COLUMNS), np.int64),
    )  # fmt: skip
    for index, seed in enumerate(seeds):
        begin_positions(table, seed, runs.positions[index], runs.ordinals[index])
    for row, knots in walk.rows(progress):
        for phase in range(row.phases):
            for stop in stops_before(row, phase):
                runs.sums[:, TIME] += stop_duration(stop, walk.setup)
                walk.change(stop)
            out = walk.phase(knots, phase)
            seeds_phase(knots, phase, out, walk.passed, table, walk.durations.knot, runs)
            walk.pass_phase(knots, phase, out)
        for operation in row.ends:
            seeds_end(walk.end(operation), walk.passed, table, runs)
    return runs.sums
