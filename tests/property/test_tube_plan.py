"""Tubes over the whole carpet: every knot has its yarn, and no other plan has fewer changes or fewer stops."""

import itertools
from collections.abc import Iterable

import numpy as np
import pytest
from effort import examples
from hypothesis import given
from hypothesis import strategies as st
from small_programme import TIMES, small_programme

from ilmek.arrays import Indices
from ilmek.errors import LoomError
from ilmek.loom.bobbins import Bobbin
from ilmek.loom.operations import EMPTY
from ilmek.loom.programme import make_programme, weaving_time
from ilmek.loom.sharing import halves
from ilmek.loom.times import Times
from ilmek.loom.tube_plan import YarnSupply, join_changes, most_colours, plan_tubes

WEFTS = (Bobbin("straight weft", 3, 90.0),)


@st.composite
def charts(draw: st.DrawFn) -> tuple[Indices, int, YarnSupply]:
    """A chart, a number of heads, and a supply whose tubes are enough for every part."""
    heads, yarns = draw(st.integers(1, 2)), draw(st.integers(2, 5))
    rows, columns = draw(st.integers(1, 9)), draw(st.integers(2 * heads, 8))
    knots = np.random.default_rng(draw(st.integers(0, 2**31))).integers(0, yarns, (rows, columns)).astype(np.uint8)
    tubes = draw(st.integers(most_colours(knots, yarns, heads), yarns))
    least = columns * 0.04
    return knots, heads, YarnSupply(tubes, (draw(st.floats(least * 1.01, 20 * least)),) * yarns, (0.04,) * yarns)


def parts_of(knots: Indices, heads: int, head: int) -> Iterable[list[int]]:
    """The yarns of the knots of a head's parts, in order of time."""
    phases = halves(heads)
    edges = np.arange(heads * phases + 1) * knots.shape[1] // (heads * phases)
    for number, line in enumerate(knots[::-1]):
        for phase in range(phases):
            part = head * phases + (phase if number % 2 == 0 else phases - 1 - phase)
            yield line[edges[part] : edges[part + 1]].tolist()


@given(charts())
@examples(80)
def test_every_part_has_its_yarns_and_enough_of_them(case: tuple[Indices, int, YarnSupply]) -> None:
    knots, heads, supply = case
    plan = plan_tubes(knots, heads, supply, WEFTS)
    stops = {stop.row * plan.phases + stop.phase: stop for stop in plan.stops(WEFTS, len(knots))}
    assert all(stop.wefts or stop.tubes for stop in stops.values())
    for head in range(heads):
        yarns, left = plan.loading[head].tolist(), plan.packages[head].tolist()
        assert [length == 0 for length in left] == [yarn == EMPTY for yarn in yarns]
        for point, part in enumerate(parts_of(knots, heads, head)):
            for change in stops[point].tubes if point in stops else ():
                if change.head == head:
                    yarns[change.tube], left[change.tube] = change.yarn, change.length
            for yarn in part:
                left[yarns.index(yarn)] -= 0.04
            assert min(left) >= -1e-9


@given(charts())
@examples(80)
def test_no_plan_has_fewer_changes_of_colour(case: tuple[Indices, int, YarnSupply]) -> None:
    knots, heads, supply = case
    endless = YarnSupply(supply.tubes, (1e9,) * len(supply.packages), supply.knot_yarn)
    plan = plan_tubes(knots, heads, endless)
    for head in range(heads):
        needed = [set(part) for part in parts_of(knots, heads, head)]
        loadings = [set(one) for one in itertools.combinations(range(len(supply.packages)), supply.tubes)]
        cost = {tuple(one): 0 for one in loadings}
        for colours in needed:
            kept = [one for one in loadings if colours <= one]
            cost = {tuple(one): min(cost[other] + len(one - set(other)) for other in cost) for one in kept}
        assert int(np.count_nonzero(plan.changes[:, 1] == head)) == min(cost.values())


@given(st.lists(st.tuples(st.integers(0, 9), st.integers(0, 4)), max_size=6), st.sets(st.integers(1, 13), max_size=3))
@examples(80)
def test_no_choice_of_points_has_fewer_stops(given_windows: list[tuple[int, int]], fixed: set[int]) -> None:
    windows = np.array([(low, low + length, 0, index, 0) for index, (low, length) in enumerate(given_windows)], int)
    windows = windows.reshape(-1, 5)
    points = sorted(fixed)
    made = join_changes(windows, np.array(points, int))
    by_tube = {tube: point for point, _, tube, _ in made.tolist()}
    assert all(low <= by_tube[tube] <= high for low, high, _, tube, _ in windows.tolist())
    more = len(set(by_tube.values()) - fixed)
    for number in range(more):
        for chosen in itertools.combinations(range(14), number):
            met = [any(low <= one <= high for one in (*points, *chosen)) for low, high, *_ in windows.tolist()]
            assert not all(met)


def test_a_part_of_more_colours_than_tubes_is_refused() -> None:
    knots = np.array([[0, 1, 2, 0]], np.uint8)
    times, supply = Times(2.0, 0.5, 0.01, 12.0), YarnSupply(2, (100.0,) * 3, (0.04,) * 3)
    with pytest.raises(LoomError, match="3 colours in a part of a row for 2 tubes of a head; .* more heads"):
        make_programme(knots, 3, 1, times, supply=supply)
    assert weaving_time(knots, 3, 1, times, supply=supply) == np.inf
    assert weaving_time(knots, 3, 2, times, supply=supply) < 60.0


def test_a_package_that_is_too_small_for_a_part_is_refused() -> None:
    knots, supply = np.zeros((2, 10), np.uint8), YarnSupply(1, (0.3,), (0.04,))
    with pytest.raises(LoomError, match="more yarn than a package has"):
        plan_tubes(knots, 1, supply)


def test_the_changes_are_in_the_time_and_join_the_stops_for_weft() -> None:
    few, all_of_them = (small_programme(40, 30, 2, 6, tubes=tubes) for tubes in (5, 6))
    assert few.setup.tubes == 5
    rows = [few.operations(number) for number in range(40)]
    stops = [stop for row in rows for stop in row.stops]
    changes = sum(len(stop.tubes) for stop in stops)
    assert changes > 0
    assert any(stop.wefts and stop.tubes for stop in stops)
    assert TIMES.tube_change * changes > 0
    whole = [all_of_them.operations(number) for number in range(40)]
    assert not any(stop.tubes for row in whole for stop in row.stops)
