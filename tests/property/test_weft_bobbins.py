"""Stops for new bobbins of weft, against a loom that weaves row by row and counts down what is on each bobbin."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.errors import LoomError
from ilmek.loom.bobbins import Bobbin, change_stops, stop_count, stop_time
from ilmek.loom.programme import least_heads, make_programme
from ilmek.loom.times import Times

TIMES = Times(knot=2.0, colour_change=0.5, travel=0.03, weft=12.0)

bobbins = st.lists(st.tuples(st.integers(1, 60), st.floats(0.0, 300.0)), max_size=3).map(
    lambda given: tuple(Bobbin(f"weft {k}", rows, time) for k, (rows, time) in enumerate(given))
)


def simulated(bobbins: tuple[Bobbin, ...], rows: int) -> list[tuple[int, tuple[str, ...], float]]:
    """Every row takes one row's weft from each bobbin; one that is empty is changed before the row begins."""
    left, stops = {one.yarn: one.rows for one in bobbins}, []
    for row in range(rows):
        empty = [one for one in bobbins if left[one.yarn] == 0]
        for one in empty:
            left[one.yarn] = one.rows
        if empty:
            stops.append((row, tuple(one.yarn for one in empty), sum(one.time for one in empty)))
        left = {yarn: rest - 1 for yarn, rest in left.items()}
    return stops


@given(bobbins, st.integers(1, 200))
def test_stops_are_those_of_a_loom_that_weaves_row_by_row(bobbins: tuple[Bobbin, ...], rows: int) -> None:
    stops = change_stops(bobbins, rows)
    assert [(one.row, one.yarns, one.time) for one in stops] == simulated(bobbins, rows)
    assert stop_count(bobbins, rows) == len(stops)
    assert stop_time(bobbins, rows) == pytest.approx(sum(one.time for one in stops))


def test_the_programme_counts_its_stops_and_the_deadline_too() -> None:
    knots = np.zeros((50, 40), np.uint8)
    plain = make_programme(knots, 2, 2, TIMES)
    stopped = make_programme(knots, 2, 2, TIMES, bobbins=(Bobbin("weft", 7, 100.0),))
    assert [one.row for one in stopped.stops] == [7, 14, 21, 28, 35, 42, 49]
    assert stopped.duration == pytest.approx(plain.duration + 700.0)
    assert least_heads(knots, 2, plain.duration, TIMES, 4) == 2
    assert (least_heads(knots, 2, plain.duration, TIMES, 4, bobbins=stopped.bobbins) or 0) > 2
    assert least_heads(knots, 2, stopped.duration, TIMES, 4, bobbins=stopped.bobbins) == 2
    assert least_heads(knots, 2, 900.0 + 700.0, TIMES, 4, bobbins=stopped.bobbins) is None


def test_a_bobbin_for_less_than_a_row_is_refused() -> None:
    with pytest.raises(LoomError, match="a bobbin of weft for 0 rows"):
        Bobbin("weft", 0, 1.0)
