"""Programmes against a plain account of the same rules, knot by knot."""

import math
from itertools import pairwise

import numpy as np
import pytest
from effort import examples
from hypothesis import given
from hypothesis import strategies as st
from small_programme import head_knots, rows_of

from ilmek.arrays import Indices
from ilmek.loom.programme import Programme, least_heads, least_time, make_programme, weaving_time
from ilmek.loom.sharing import least_distance
from ilmek.loom.times import Times

TIMES = Times(knot=2.0, colour_change=0.5, travel=0.03, weft=12.0)


@st.composite
def charts(draw: st.DrawFn) -> tuple[Indices, int, int]:
    """A chart with runs of colour, its number of yarns, and a number of heads that can share it."""
    rows, columns, yarns = draw(st.integers(1, 6)), draw(st.integers(1, 40)), draw(st.integers(1, 9))
    heads = draw(st.integers(1, max(1, columns // 2)))
    seed, grain = draw(st.integers(0, 2**31)), draw(st.integers(1, 12))
    coarse = np.random.default_rng(seed).integers(0, yarns, (rows, -(-columns // grain)))
    return np.repeat(coarse, grain, axis=1)[:, :columns].astype(np.uint8), yarns, heads


def account(programme: Programme) -> tuple[float, list[int], list[int]]:
    """Time, changes and pitches moved, from the explicit operations and the rules alone."""
    times, heads = programme.times, programme.heads
    changes, travel, total = [0] * heads, [0] * heads, 0.0
    tube: list[int | None] = [None] * heads
    for row in rows_of(programme):
        knots = [list(zip(*head_knots(row, head), strict=True)) for head in range(heads)]
        at = [ones[0][0] for ones in knots]  # a head begins a row at its first knot
        for phase in range(row.phases):
            slowest = 0.0
            for head in range(heads):
                first = int(row.counts[head, :phase].sum())
                spent = 0.0
                for column, used in knots[head][first : first + int(row.counts[head, phase])]:
                    changed = tube[head] not in (None, used)
                    distance = abs(column - at[head])
                    spent += times.knot + changed * times.colour_change + max(distance - 1, 0) * times.travel
                    changes[head], travel[head] = changes[head] + changed, travel[head] + distance
                    tube[head], at[head] = used, column
                slowest = max(slowest, spent)
            total += slowest
        total += times.weft
    return total, changes, travel


@given(charts())
@examples(100)
def test_the_time_is_that_of_the_explicit_operations(case: tuple[Indices, int, int]) -> None:
    knots, yarns, heads = case
    programme = make_programme(knots, yarns, heads, TIMES)
    total, changes, travel = account(programme)
    assert programme.duration == pytest.approx(total, rel=1e-12)
    assert programme.work.changes.tolist() == changes
    assert programme.work.travel.tolist() == travel
    assert weaving_time(knots, yarns, heads, TIMES) == pytest.approx(total, rel=1e-12)
    assert programme.bound <= programme.duration * (1 + 1e-12)


@given(charts())
@examples(100)
def test_every_knot_is_tied_once_by_its_head_in_its_colour(case: tuple[Indices, int, int]) -> None:
    knots, yarns, heads = case
    programme = make_programme(knots, yarns, heads, TIMES)
    loading = programme.tubes.loading
    for number, row in enumerate(rows_of(programme)):
        assert sorted(row.columns.tolist()) == list(range(knots.shape[1]))
        for head in range(heads):
            columns, tubes = head_knots(row, head)
            assert loading[head, tubes].tolist() == knots[knots.shape[0] - 1 - number, columns].tolist()


@given(charts())
@examples(60)
def test_a_head_reaches_its_first_knot_of_a_row_while_the_row_before_ends(case: tuple[Indices, int, int]) -> None:
    knots, yarns, heads = case
    times = Times(knot=2.0, colour_change=0.5, travel=0.3, weft=1.0)
    rows = rows_of(make_programme(knots, yarns, heads, times))
    for before, row in pairwise(rows):
        for head in range(heads):
            distance = abs(head_knots(before, head)[0][-1] - head_knots(row, head)[0][0])
            assert max(distance - 1, 0) * times.travel <= times.weft


@given(charts())
@examples(80)
def test_the_order_is_never_slower_than_sweeping_a_part_with_the_same_handler(case: tuple[Indices, int, int]) -> None:
    knots, yarns, _ = case
    times = Times(knot=1.0, colour_change=1.0, travel=0.01, weft=0.0)
    programme = make_programme(knots[:1], yarns, 1, times)
    runs = 1 + int(np.count_nonzero(np.diff(knots[0])))
    assert programme.duration <= knots.shape[1] + (runs - 1) + 1e-9


@given(charts(), st.floats(1.0, 3.0))
@examples(80)
def test_deadline_gives_the_smallest_number_of_heads(case: tuple[Indices, int, int], slack: float) -> None:
    knots, yarns, heads_max = case
    durations = [make_programme(knots, yarns, heads, TIMES).duration for heads in range(1, heads_max + 1)]
    deadline = min(durations) * slack + 0.01
    smallest = next(heads for heads, duration in enumerate(durations, start=1) if duration <= deadline)
    assert least_heads(knots, yarns, deadline, TIMES, heads_max) == smallest


@given(charts())
@examples(60)
def test_no_chart_is_woven_sooner_than_the_least_time(case: tuple[Indices, int, int]) -> None:
    knots, yarns, heads = case
    rows, columns = knots.shape
    assert make_programme(knots, yarns, heads, TIMES).duration >= least_time(rows, columns, heads, TIMES) - 1e-6


def test_a_trial_is_given_up_above_the_deadline() -> None:
    knots = np.zeros((40, 30), np.uint8)
    assert weaving_time(knots, 1, 1, TIMES, 10.0) > 10.0
    assert weaving_time(knots, 1, 1, TIMES, math.inf) == pytest.approx(40 * (12 + 60))


@given(charts())
@examples(60)
def test_heads_keep_their_distance_in_every_phase(case: tuple[Indices, int, int]) -> None:
    knots, yarns, heads = case
    programme = make_programme(knots, yarns, heads, TIMES)
    least = least_distance(programme.edges, heads, 1.0)
    for row in rows_of(programme):
        for phase in range(row.phases):
            tied = []
            for head in range(heads):
                first = int(row.counts[head, :phase].sum())
                tied.append(head_knots(row, head)[0][first : first + int(row.counts[head, phase])])
            assert all(min(right) - max(left) >= least for left, right in pairwise(tied))
