"""Tally: numbers of a whole chart."""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Indices, IntArray
from ilmek.carpet.codes import CODES, NO_KNOT
from ilmek.carpet.design import PART, bands
from ilmek.carpet.patches import count_patches, is_lone
from ilmek.num.compiled import uncounted
from ilmek.num.threads import in_threads
from ilmek.progress import SILENT, Progress

SMALL_PATCH = 3
"""Knots of the largest patch that is counted as small."""


@dataclass(frozen=True, slots=True)
class Tally:
    """Numbers of a chart.

    counts  knots of each yarn          changes        of yarn along the rows
    lone    knots without a like one    small_patches  patches of at most SMALL_PATCH knots
    """

    counts: tuple[int, ...]
    changes: int
    lone: int
    small_patches: int

    @property
    def knots(self) -> int:
        """Cells with a knot."""
        return sum(self.counts)


@uncounted
def _count(knots: Indices, first: int, stop: int, counts: IntArray) -> tuple[int, int]:
    """Changes and lone knots of some rows; the knots of each yarn are added to `counts`."""
    changes, lone = 0, 0
    for row in range(first, stop):
        before = knots[row, 0]
        for column in range(knots.shape[1]):
            yarn = knots[row, column]
            counts[yarn] += 1
            lone += is_lone(knots, row, column)
            if yarn != NO_KNOT:
                changes += yarn != before != NO_KNOT
                before = yarn
    return changes, lone


def tally_of(knots: Indices, yarns: int, progress: Progress = SILENT) -> Tally:
    """The tally of a chart (rows, columns) of a number of yarns."""
    knots = np.ascontiguousarray(knots)

    def count(band: slice) -> tuple[IntArray, int, int]:
        counts = np.zeros(CODES, dtype=np.int64)  # every uint8 is inside
        changes, lone = _count(knots, band.start, band.stop, counts)
        return counts[:yarns], int(changes), int(lone)

    counts, changes, lone = np.zeros(yarns, dtype=np.int64), 0, 0
    for band, (some, changed, alone) in in_threads(count, bands(knots.shape[0], knots.shape[1], PART)):
        counts, changes, lone = counts + some, changes + changed, lone + alone
        progress(0.6 * band.stop / len(knots))
    return Tally(tuple(counts.tolist()), changes, lone, count_patches(knots, SMALL_PATCH, progress.part(0.6, 1.0)))
