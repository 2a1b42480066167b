"""Programmes worked out by hand, and charts and deadlines that no loom can weave."""

import numpy as np
import pytest
from small_programme import head_knots, rows_of, small_programme

from ilmek.arrays import Indices
from ilmek.errors import LoomError
from ilmek.loom.programme import least_heads, make_programme, weaving_time
from ilmek.loom.times import Times
from ilmek.units import hour

TIMES = Times(knot=2.0, colour_change=1.0, travel=0.1, weft=10.0)


def chart(*rows: str) -> Indices:
    return np.array([[int(knot) for knot in row] for row in rows], np.uint8)


def test_the_bottom_row_is_woven_first() -> None:
    programme = make_programme(chart("0011", "2222"), 3, 1, TIMES)
    first, second = (head_knots(row, 0) for row in rows_of(programme))
    assert first[1] == [2, 2, 2, 2]
    assert sorted(second[0]) == [0, 1, 2, 3]
    # 4 knots; then a change to 1 or 0, one to the other, 4 knots.
    assert programme.row_times.tolist() == [18.0, 20.0]
    assert programme.work.changes.tolist() == [2]


def test_passes_where_they_are_quicker() -> None:
    # Sweep: 7 changes = 7 s. Passes: 0 at 0 2 4 6 (3 idle), then 1 at 7 5 3 1 (3 idle): 1 change + 0.6 s.
    programme = make_programme(chart("01010101"), 2, 1, TIMES)
    assert programme.work.passes.tolist() == [1]
    assert programme.duration == pytest.approx(10 + 8 * 2 + 1 + 0.6)
    assert programme.naive.time == 10 + 8 * 2 + 7


def test_passes_begin_with_the_tube_in_line_and_end_with_one_of_the_next_row() -> None:
    programme = make_programme(chart("22221111", "02010201"), 3, 1, TIMES)
    tubes = [head_knots(row, 0)[1] for row in rows_of(programme)]
    assert tubes[0][-1] == tubes[1][0]
    assert programme.work.changes.tolist() == [3]


def test_sweep_where_moving_costs_more_than_changing() -> None:
    slow = Times(knot=2.0, colour_change=0.01, travel=1.0, weft=10.0)
    assert make_programme(chart("01010101"), 2, 1, slow).work.passes.tolist() == [0]


def test_two_heads_wait_for_each_other_at_the_halves() -> None:
    # Halves of two knots. First halves: head 0 takes 4 s, head 1 takes 5 s; second halves: 5 s and 4 s.
    programme = make_programme(chart("00010100"), 2, 2, TIMES)
    assert programme.duration == 10 + 5 + 5
    # Each head begins with the tube of its first knot; head 1 ends its first half with the other tube.
    assert programme.work.changes.tolist() == [1, 1]


def test_one_knot() -> None:
    programme = make_programme(chart("0"), 1, 1, TIMES)
    assert (programme.duration, rows_of(programme)[0].columns.tolist()) == (12.0, [0])


@pytest.mark.parametrize("number", [-1, 6, 99])
def test_rows_beyond_the_carpet(number: int) -> None:
    with pytest.raises(LoomError, match="rows 0 to 5"):
        small_programme().operations(number)


@pytest.mark.parametrize(
    ("knots", "yarns", "heads", "said"),
    [
        (chart("0123"), 3, 1, "a knot of yarn 3; the list has yarns 0 to 2"),
        (chart("0123"), 256, 1, "256 yarns; 1 to 255"),
        (chart("0123"), 4, 3, "at most 2 heads"),
        (chart("0123"), 4, 0, "0 heads"),
        (np.zeros((0, 5), np.uint8), 2, 1, "without knots"),
    ],
    ids=["yarn not in the list", "too many yarns", "too many heads", "no head", "empty"],
)
def test_charts_that_cannot_be_woven(knots: Indices, yarns: int, heads: int, said: str) -> None:
    with pytest.raises(LoomError, match=said):
        make_programme(knots, yarns, heads, TIMES)


@pytest.mark.parametrize("times", [(0.0, 1, 1, 1), (-1, 1, 1, 1), (1, 1, 1, float("nan")), (1, float("inf"), 1, 1)])
def test_times_that_are_none(times: tuple[float, ...]) -> None:
    with pytest.raises(LoomError, match="a finite time"):
        Times(*times)


def test_a_deadline_shorter_than_the_wefts() -> None:
    knots = np.zeros((450, 300), np.uint8)
    assert knots.shape[0] * TIMES.weft == 1.25 * hour
    assert least_heads(knots, 1, 1 * hour, TIMES, 7) is None


def test_a_deadline_beyond_the_heads_that_fit() -> None:
    knots = np.zeros((450, 300), np.uint8)
    assert least_heads(knots, 1, 15 * hour, TIMES, 4) is None
    assert 19.95 * hour <= weaving_time(knots, 1, 4, TIMES) < 20.05 * hour
    assert least_heads(knots, 1, 20.1 * hour, TIMES, 4) == 4
    assert least_heads(knots, 1, 100 * hour, TIMES, 4) == 1
