"""Programmes worked out by hand, and charts and deadlines that no loom can weave."""

import numpy as np
import pytest

from ilmek.arrays import Indices
from ilmek.errors import LoomError
from ilmek.loom.programme import Times, least_heads, make_programme, weaving_time
from ilmek.units import hour

TIMES = Times(knot=2.0, colour_change=1.0, travel=0.1, weft=10.0)


def chart(*rows: str) -> Indices:
    return np.array([[int(knot) for knot in row] for row in rows], np.uint8)


def test_the_bottom_row_is_woven_first_and_the_next_one_back() -> None:
    programme = make_programme(chart("0011", "2222"), 3, 1, TIMES)
    first, second = programme.row(0), programme.row(1)
    assert first.ties_of(0).colours.tolist() == [2, 2, 2, 2]
    assert first.ties_of(0).pairs.tolist() == [0, 1, 2, 3]
    assert second.ties_of(0).pairs.tolist() == [3, 2, 1, 0]
    # 4 knots; then a change to 1, one to 0, 4 knots.
    assert programme.row_times.tolist() == [18.0, 20.0]
    assert programme.work.changes.tolist() == [2]


def test_passes_where_they_are_quicker() -> None:
    # Sweep: 7 changes = 7 s. Passes: 0 at 0 2 4 6 (3 idle), then 1 at 7 5 3 1 (3 idle): 1 change + 0.6 s.
    row = make_programme(chart("01010101"), 2, 1, TIMES).row(0)
    assert row.passes(0) == (True,)
    assert row.ties_of(0).pairs.tolist() == [0, 2, 4, 6, 7, 5, 3, 1]


def test_passes_begin_with_the_colour_in_the_handler_and_end_with_the_next() -> None:
    # Row 1 is swept back and begins with yarn 1 at the right: so row 0 ends with yarn 1.
    programme = make_programme(chart("22221111", "02010201"), 3, 1, TIMES)
    colours = programme.row(0).ties_of(0).colours.tolist()
    assert colours == [0, 0, 0, 0, 2, 2, 1, 1]
    assert programme.work.changes.tolist() == [3]


def test_sweep_where_moving_costs_more_than_changing() -> None:
    slow = Times(knot=2.0, colour_change=0.01, travel=1.0, weft=10.0)
    assert make_programme(chart("01010101"), 2, 1, slow).row(0).passes(0) == (False,)


def test_two_heads_wait_for_each_other_at_the_halves() -> None:
    # Halves of two knots. First halves: head 0 takes 4 s, head 1 takes 5 s; second halves: 5 s and 4 s.
    programme = make_programme(chart("00010100"), 2, 2, TIMES)
    assert programme.duration == 10 + 5 + 5
    # Each head was threaded with its first colour.
    assert programme.work.busy.tolist() == [9.0, 10.0]


def test_one_knot() -> None:
    programme = make_programme(chart("0"), 1, 1, TIMES)
    assert (programme.duration, programme.row(0).ties_of(0).pairs.tolist()) == (12.0, [0])


@pytest.mark.parametrize("number", [-1, 2, 99])
def test_rows_beyond_the_carpet(number: int) -> None:
    with pytest.raises(LoomError, match="rows 0 to 1"):
        make_programme(chart("01", "01"), 2, 1, TIMES).row(number)


def test_heads_beyond_the_loom() -> None:
    with pytest.raises(LoomError, match="heads 0 to 0"):
        make_programme(chart("01"), 2, 1, TIMES).row(0).ties_of(1)


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
