"""The tying order against the best of all orders, found by trying them on tiny carpets."""

import itertools
from functools import cache

import numpy as np
from effort import examples
from hypothesis import given
from hypothesis import strategies as st

from ilmek.arrays import Indices
from ilmek.loom.programme import make_programme
from ilmek.loom.times import Times

NEAR = 1.06
"""Largest time of the knots over the least of all orders, 1.053 on 8,000 such carpets, rounded up."""


@st.composite
def tiny(draw: st.DrawFn) -> Indices:
    rows, columns, yarns = draw(st.integers(1, 3)), draw(st.integers(2, 6)), draw(st.integers(1, 4))
    return np.random.default_rng(draw(st.integers(0, 2**31))).integers(0, yarns, (rows, columns)).astype(np.uint8)


def best_time(knots: Indices, times: Times) -> float:
    """The least time of any order of a head that ties a row after the other, by dynamic programming over subsets."""
    ready: dict[int | None, float] = {None: 0.0}
    for line in knots[::-1].tolist():
        after: dict[int | None, float] = {}
        for tube, spent in ready.items():
            for last, more in _row_times(tuple(line), tube, times).items():
                after[last] = min(after.get(last, np.inf), spent + more)
        ready = after
    return min(ready.values())


@cache
def _row_times(line: tuple[int, ...], tube: int | None, times: Times) -> dict[int, float]:
    """Least time of a row by the tube of its last knot."""
    columns = range(len(line))
    cost = {(1 << k, k): times.knot + (tube not in (None, line[k])) * times.colour_change for k in columns}
    for size in range(1, len(line)):
        for chosen in itertools.combinations(columns, size):
            mask = sum(1 << k for k in chosen)
            for k, j in itertools.product(chosen, columns):
                if not mask >> j & 1:
                    idle = (abs(j - k) - 1) * times.travel
                    spent = cost[mask, k] + times.knot + (line[j] != line[k]) * times.colour_change + idle
                    at = (mask | 1 << j, j)
                    cost[at] = min(cost.get(at, np.inf), spent)
    found: dict[int, float] = {}
    for k in columns:
        found[line[k]] = min(found.get(line[k], np.inf), cost[(1 << len(line)) - 1, k])
    return {last: spent + times.weft for last, spent in found.items()}


@given(tiny())
@examples(60)
def test_without_travel_no_order_has_fewer_changes(knots: Indices) -> None:
    times = Times(knot=1.0, colour_change=1.0, travel=0.0, weft=2.0)
    programme = make_programme(knots, 4, 1, times)
    assert abs(programme.duration - best_time(knots, times)) < 1e-9
    assert abs(programme.bound - programme.duration) < 1e-9


@given(tiny(), st.sampled_from([0.01, 0.05, 0.3, 1.0]))
@examples(80)
def test_the_best_order_is_between_the_bound_and_the_chosen_one(knots: Indices, travel: float) -> None:
    times = Times(knot=1.0, colour_change=0.5, travel=travel, weft=20.0)
    programme, best = make_programme(knots, 4, 1, times), best_time(knots, times)
    assert programme.bound <= best * (1 + 1e-12)
    assert best <= programme.duration * (1 + 1e-12)
    wefts = len(knots) * times.weft
    assert programme.duration - wefts <= NEAR * (best - wefts)
