"""Programmes against a plain account of the same rules, knot by knot."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.arrays import Indices
from ilmek.loom.programme import Programme, Times, least_heads, least_time, make_programme, weaving_time
from ilmek.loom.sharing import halves, least_distance

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
    """Time, changes and pitches moved, from the replayed order and the definition alone."""
    times, parts = programme.times, halves(programme.heads)
    changes, travel, total = [0] * programme.heads, [0] * programme.heads, 0.0
    handler: list[int | None] = [None] * programme.heads
    for number in range(programme.rows):
        row = programme.row(number)
        spent = np.zeros((parts, programme.heads))
        for head, ties in enumerate(row.ties()):
            edges = row.edges[head * parts : (head + 1) * parts + 1]
            place = int(ties.pairs[0])  # a head begins a row at its first knot
            for pair, colour in zip(ties.pairs.tolist(), ties.colours.tolist(), strict=True):
                part = int(np.searchsorted(edges, pair, side="right")) - 1
                half = part if row.forward else parts - 1 - part
                change = handler[head] not in (None, colour)
                handler[head] = colour
                changes[head] += change
                travel[head] += abs(pair - place)
                idle = max(abs(pair - place) - 1, 0)
                spent[half, head] += times.knot + change * times.colour_change + idle * times.travel
                place = pair
        total += times.weft + spent.max(axis=1).sum()
    return total, changes, travel


@given(charts())
@settings(max_examples=150)
def test_the_replayed_order_costs_what_the_programme_says(case: tuple[Indices, int, int]) -> None:
    knots, yarns, heads = case
    programme = make_programme(knots, yarns, heads, TIMES)
    total, changes, travel = account(programme)
    assert programme.duration == pytest.approx(total, rel=1e-12)
    assert programme.work.changes.tolist() == changes
    assert programme.work.travel.tolist() == travel
    assert weaving_time(knots, yarns, heads, TIMES) == pytest.approx(total, rel=1e-12)


@given(charts())
@settings(max_examples=100)
def test_every_knot_is_tied_once_by_its_head_in_its_colour(case: tuple[Indices, int, int]) -> None:
    knots, yarns, heads = case
    programme = make_programme(knots, yarns, heads, TIMES)
    for number in range(programme.rows):
        tied = programme.row(number).ties()
        pairs = np.concatenate([ties.pairs for ties in tied])
        assert sorted(pairs.tolist()) == list(range(knots.shape[1]))
        assert [ties.pairs.min() for ties in tied] == sorted(ties.pairs.min() for ties in tied)
        for ties in tied:
            assert ties.colours.tolist() == knots[knots.shape[0] - 1 - number, ties.pairs].tolist()


@given(charts())
@settings(max_examples=80)
def test_the_order_is_never_slower_than_sweeping_a_part_with_the_same_handler(case: tuple[Indices, int, int]) -> None:
    knots, yarns, _ = case
    times = Times(knot=1.0, colour_change=1.0, travel=0.01, weft=0.0)
    programme = make_programme(knots[:1], yarns, 1, times)
    runs = 1 + int(np.count_nonzero(np.diff(knots[0])))
    assert programme.duration <= knots.shape[1] + (runs - 1) + 1e-9


@given(charts(), st.floats(1.0, 3.0))
@settings(max_examples=80)
def test_deadline_gives_the_smallest_number_of_heads(case: tuple[Indices, int, int], slack: float) -> None:
    knots, yarns, heads_max = case
    durations = [make_programme(knots, yarns, heads, TIMES).duration for heads in range(1, heads_max + 1)]
    deadline = min(durations) * slack + 0.01
    smallest = next(heads for heads, duration in enumerate(durations, start=1) if duration <= deadline)
    assert least_heads(knots, yarns, deadline, TIMES, heads_max) == smallest


@given(charts())
@settings(max_examples=60)
def test_no_chart_is_woven_sooner_than_the_least_time(case: tuple[Indices, int, int]) -> None:
    knots, yarns, heads = case
    assert make_programme(knots, yarns, heads, TIMES).duration >= least_time(*knots.shape, heads, TIMES) - 1e-6


def test_a_trial_is_given_up_above_the_deadline() -> None:
    knots = np.zeros((40, 30), np.uint8)
    assert weaving_time(knots, 1, 1, TIMES, 10.0) > 10.0
    assert weaving_time(knots, 1, 1, TIMES, math.inf) == pytest.approx(40 * (12 + 60))


@given(charts())
@settings(max_examples=80)
def test_heads_keep_their_distance_in_both_halves(case: tuple[Indices, int, int]) -> None:
    knots, yarns, heads = case
    programme = make_programme(knots, yarns, heads, TIMES)
    least = least_distance(programme.edges, heads, 1.0)
    for number in range(programme.rows):
        row = programme.row(number)
        middles = row.edges[1::2]
        for side in (True, False):
            places = [t.pairs[(t.pairs < m) == side] for t, m in zip(row.ties(), middles, strict=False)]
            for left, right in pairwise(places[: heads if heads > 1 else 0]):
                assert right.min() - left.max() >= least
