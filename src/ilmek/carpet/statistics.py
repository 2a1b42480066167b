"""Statistics of a chart, from which a weaver judges the work: changes of colour in each row, the hardest rows, and
small patches by their size.

Rows are counted as they are woven and printed: row 1 is the lower edge of the picture.
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ilmek.arrays import Indices, Int64
from ilmek.carpet.codes import NO_KNOT
from ilmek.carpet.design import bands
from ilmek.carpet.patches import patch_sizes
from ilmek.records import record

if TYPE_CHECKING:
    from ilmek.carpet.chart import Chart

HARDEST = 5
"""Number of the hardest rows."""

GROUPS = ((1, 1), (2, 3), (4, 10), (11, 30))
"""Sizes of the groups of small patches: least and most knots."""


class PatchGroup(NamedTuple):
    """Number of the patches of `least` to `most` knots."""

    least: int
    most: int
    patches: int


@record
class ChartStatistics:
    """Statistics of a chart.

    changes  changes of colour in each row, of row 1 first
    hardest  numbers of the rows with the most changes, the most first; of equal ones the lower first
    patches  small patches by size: 8-connected knots of one yarn
    """

    changes: Int64[np.ndarray, " rows"]
    hardest: tuple[int, ...]
    patches: tuple[PatchGroup, ...]

    @property
    def mean_changes(self) -> float:
        """Mean number of changes in a row."""
        return float(self.changes.sum()) / len(self.changes)

    def of_row(self, number: int) -> int:
        """Changes in a row, by its number from 1."""
        return int(self.changes[number - 1])


def chart_statistics(chart: "Chart") -> ChartStatistics:
    """The statistics of a chart."""
    changes = changes_by_row(chart.knots)
    return ChartStatistics(changes, hardest_rows(changes), patch_groups(chart.knots))


def changes_by_row(knots: Indices) -> Int64[np.ndarray, " rows"]:
    """Changes of colour along each row of a chart (rows, columns) whose row 0 is the top; of the lowest row first.

    >>> changes_by_row(np.array([[0, 1, 0], [2, 2, 2]], dtype=np.uint8)).tolist()
    [0, 2]
    """
    changes = np.empty(len(knots), dtype=np.int64)
    for band in bands(*knots.shape):
        part = knots[band]
        changes[band] = np.count_nonzero(part[:, 1:] != part[:, :-1], axis=1)
        for row in np.flatnonzero((part == NO_KNOT).any(axis=1)).tolist():
            changes[band.start + row] = np.count_nonzero(np.diff(part[row][part[row] != NO_KNOT]))
    return changes[::-1].copy()


def patch_groups(knots: Indices) -> tuple[PatchGroup, ...]:
    """The small patches in the groups of `GROUPS`.

    >>> [group.patches for group in patch_groups(np.array([[1, 0, 0, 2], [0, 1, 0, 2]], dtype=np.uint8))]
    [0, 2, 1, 0]
    """
    sizes = patch_sizes(knots, GROUPS[-1][1])
    return tuple(PatchGroup(least, most, int(sizes[least : most + 1].sum())) for least, most in GROUPS)


def hardest_rows(changes: Int64[np.ndarray, " rows"], most: int = HARDEST) -> tuple[int, ...]:
    """The numbers of the rows with the most changes, at most `most`; rows without a change are none of them.

    >>> hardest_rows(np.array([0, 4, 9, 4]), most=2)
    (3, 2)
    """
    order = np.argsort(-changes, kind="stable")[:most]
    return tuple(int(row) + 1 for row in order if changes[row])
