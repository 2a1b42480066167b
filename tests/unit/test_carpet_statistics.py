"""Statistics of a chart, against a count knot by knot."""

import numpy as np
import pytest

from ilmek.arrays import Indices
from ilmek.carpet import design
from ilmek.carpet.statistics import GROUPS, changes_by_row, hardest_rows, patch_groups

KNOTS = np.random.default_rng(7).integers(0, 4, (37, 23), dtype=np.uint8)


def patches_of(knots: Indices) -> list[int]:
    """The sizes of all patches of knots that touch, also at a corner, by a plain fill."""
    left = {(row, column) for row in range(knots.shape[0]) for column in range(knots.shape[1])}
    sizes = []
    while left:
        front = [left.pop()]
        size = 0
        while front:
            row, column = front.pop()
            size += 1
            around = {(row + down, column + right) for down in (-1, 0, 1) for right in (-1, 0, 1)} & left
            same = [knot for knot in around if knots[knot] == knots[row, column]]
            left.difference_update(same)
            front += same
        sizes.append(size)
    return sizes


@pytest.mark.parametrize("most", [1, 50, 1 << 22])
def test_changes_are_counted_from_the_lower_edge(monkeypatch: pytest.MonkeyPatch, most: int) -> None:
    monkeypatch.setattr(design, "_SLICE", most)
    changes = changes_by_row(KNOTS)
    assert changes.tolist() == [sum(row[i] != row[i + 1] for i in range(22)) for row in KNOTS[::-1].tolist()]


def test_the_hardest_rows_have_the_most_changes() -> None:
    changes = changes_by_row(KNOTS)
    hardest = hardest_rows(changes)
    assert changes[[row - 1 for row in hardest]].tolist() == sorted(changes.tolist(), reverse=True)[:5]
    assert hardest_rows(np.zeros(9, dtype=np.int64)) == ()


@pytest.mark.parametrize("yarns", [2, 3, 4])
def test_patches_are_counted_by_size(yarns: int) -> None:
    knots = KNOTS % np.uint8(yarns)
    sizes = patches_of(knots)
    counted = [sum(least <= size <= most for size in sizes) for least, most in GROUPS]
    assert [group.patches for group in patch_groups(knots)] == counted
