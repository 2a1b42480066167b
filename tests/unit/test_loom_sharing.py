"""How heads share a row."""

import math

import numpy as np
import pytest

from ilmek.errors import LoomError
from ilmek.loom.sharing import heads_that_fit, least_distance, share


@pytest.mark.parametrize(("columns", "heads"), [(300, 1), (300, 4), (301, 7), (7, 3), (2, 1), (4000, 13)])
def test_parts_are_balanced_and_cover_the_row(columns: int, heads: int) -> None:
    widths = np.diff(share(columns, heads))
    assert widths.sum() == columns
    assert widths.max() - widths.min() <= 1
    assert len(widths) == (1 if heads == 1 else 2 * heads)


@pytest.mark.parametrize("columns", [5, 40, 299, 300, 1000])
@pytest.mark.parametrize("head_width", [0.004, 0.03, 0.08, 0.2])
def test_the_most_heads_keep_their_distance_and_one_more_does_not(columns: int, head_width: float) -> None:
    pitch = 0.004
    most = heads_that_fit(columns, pitch, head_width)
    assert least_distance(share(columns, most), most, pitch) >= head_width - 1e-12
    if columns >= 2 * (most + 1):
        assert columns // (2 * (most + 1)) + 1 < head_width / pitch + 1e-9 or head_width <= 2 * pitch


def test_a_single_head_meets_nobody() -> None:
    assert least_distance(share(10, 1), 1, 0.004) == math.inf
    assert heads_that_fit(3, 0.004, 5.0) == 1


@pytest.mark.parametrize(("columns", "heads"), [(5, 3), (10, 0), (10, -1)])
def test_heads_that_cannot_share(columns: int, heads: int) -> None:
    with pytest.raises(LoomError, match="head"):
        share(columns, heads)
