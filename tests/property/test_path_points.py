"""Four-bars through three to five timed points: planted ones are found again and move through the points in time."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from ilmek.errors import ParameterError
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.synthesis.burmester.links import GuideKind
from ilmek.synthesis.dyad import RootKind, TwoLinkArm, arms_through_points, dyads_through_points
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.path.points import (
    CrankKind,
    TimedCrank,
    cranks_through_five_points,
    timed_curve,
    timed_four_bars,
)
from ilmek.units import deg

EXACT = 1e-10

lengths = st.floats(0.4, 2.0)


@st.composite
def planted(draw: st.DrawFn, count: int) -> tuple[FourBar, np.ndarray, np.ndarray]:
    """A four-bar, its crank angles and the tracer's points there, on one branch."""
    crank, coupler, rocker = draw(lengths), draw(lengths), draw(lengths)
    cranks = draw(st.floats(0, 6)) + np.cumsum([draw(st.floats(0.25, 0.9)) for _ in range(count)])
    pin = crank * np.exp(1j * cranks)
    across = 1 - pin
    assume(np.all(np.abs(across) > abs(coupler - rocker) + 0.1) and np.all(np.abs(across) < coupler + rocker - 0.1))
    along = 0.5 + 0.5 * (coupler**2 - rocker**2) / np.abs(across) ** 2
    end = pin + (along + 1j * np.sqrt((coupler / np.abs(across)) ** 2 - along**2)) * across
    assume(np.min(np.abs(np.diff(end))) > 0.05)
    angles = np.angle(end - pin)
    assume(np.ptp(angles) > 0.2)
    points = pin + complex(draw(st.floats(0.2, 1)), draw(st.floats(-1, 1))) * np.exp(1j * angles)
    assume(np.min(np.abs(np.diff(points))) > 0.05)
    return FourBar(0j, 1 + 0j, complex(pin[0]), complex(end[0]), complex(points[0])), points, cranks


def spread(crank: TimedCrank, points: np.ndarray, angles: np.ndarray) -> float:
    size = max(float(np.ptp(np.abs(points - points[0]))), abs(crank.pivot), abs(crank.arm))
    return float(np.ptp(crank.reach(points, angles))) / size


def off(one: FourBar, other: FourBar) -> float:
    """How far two four-bars lie apart."""
    return max(abs(getattr(one, name) - getattr(other, name)) for name in ("a0", "b0", "a", "b"))


@settings(max_examples=40, deadline=None)
@given(planted(5))
def test_a_planted_four_bar_is_among_those_of_five_of_its_timed_points(task) -> None:
    drawn, points, angles = task
    for crank in cranks_through_five_points(points, angles):
        if crank.kind is CrankKind.CRANK:
            assert spread(crank, points, angles) < EXACT
    found = timed_four_bars(points, angles)
    assert min(off(one.four_bar, drawn) for one in found if one.four_bar) < 1e-4
    assert len(found) <= 12


def test_the_four_bars_of_five_timed_points_move_through_them_in_time() -> None:
    angles = np.array([0.2, 0.7, 1.3, 1.8, 2.4])
    points = np.array([0.0, 0.3 + 0.4j, 0.9 + 0.5j, 1.4 + 0.3j, 1.6 - 0.2j])
    found = [one for one in timed_four_bars(points, angles) if one.four_bar]
    assert len(found) >= 2
    for one in found:
        drawn = one.four_bar
        ways = []
        for branch in (+1, -1):
            motion = solve(plan(drawn.mechanism(branch)), drawn.crank_angle + angles - angles[0])
            ways.append(np.abs(np.asarray(motion.point("coupler", "P").position) - points))
        # Each point is met on one branch or the other: which, and whether that will do, a candidate tells.
        assert np.nanmax(np.fmin(*ways)) < 1e-6 * max(drawn.lengths)


@settings(max_examples=25, deadline=None)
@given(planted(4))
def test_four_timed_points_have_a_curve_of_cranks_with_those_of_given_angle_on_it(task) -> None:
    drawn, points, angles = task
    arms = dyads_through_points(points, angles)
    assert min(abs(one.pivot - drawn.a0) + abs(one.first - abs(drawn.a)) for one in arms) < 1e-5
    curve = timed_curve(points, angles, 60)
    pivots = np.concatenate([branch.points for branch in curve.centre_branches])
    vectors = np.concatenate([branch.points for branch in curve.circle_branches])
    assert len(pivots) == len(vectors) == 60 * len(curve.loops)
    # The same crank in both: as its pivot, and as a vector.
    for guide in curve.guides()[::7]:
        if guide.kind is GuideKind.CRANK:
            size = curve.circle_frame.size
            vector = (guide.pin - curve.centre_frame.origin) / curve.centre_frame.size * size
            assert spread(TimedCrank(CrankKind.CRANK, guide.pivot, vector), points, angles) < EXACT


def test_four_timed_points_are_met_by_the_links_along_the_second_curve() -> None:
    angles = np.array([0.2, 0.7, 1.3, 1.8])
    points = np.array([0.0, 0.3 + 0.4j, 0.9 + 0.5j, 1.4 + 0.3j])
    arms = dyads_through_points(points, angles)
    found = timed_four_bars(points, angles, samples=16)
    assert {one.crank.kind for one in found} == {CrankKind.CRANK}
    pivots = {one.crank.pivot for one in found}
    assert len(pivots) == len(arms)
    drawn = [one.four_bar for one in found if one.four_bar and max(one.four_bar.lengths) < 20]
    assert len(drawn) > 10
    for one in drawn:
        turned = one.crank_angle + angles - angles[0]
        assert np.sin(one.crank_angle - angles[0]) == pytest.approx(0, abs=1e-9)  # a1 < 0: it points away
        ways = [
            np.abs(np.asarray(solve(plan(one.mechanism(way)), turned).point("coupler", "P").position) - points)
            for way in (+1, -1)
        ]
        assert np.nanmax(np.fmin(*ways)) < 1e-6 * max(one.lengths)


@settings(max_examples=25, deadline=None)
@given(planted(3))
def test_three_timed_points_and_two_pivots_are_one_four_bar(task) -> None:
    drawn, points, angles = task
    (found,) = timed_four_bars(points, angles, pivots=(drawn.a0, drawn.b0))
    assert spread(found.crank, points, angles) < EXACT
    assert found.four_bar is not None
    assert off(found.four_bar, drawn) < 1e-5


TURNS = np.array([0.1, 0.6, 1.1, 1.7, 2.4])


def test_points_on_a_line_are_told() -> None:
    points = np.array([0, 1, 2.5, 3, 4]) + 1j
    kinds = [one.kind for one in cranks_through_five_points(points, TURNS)]
    assert CrankKind.LINE in kinds
    assert any("lie on a line" in one.description for one in timed_four_bars(points, TURNS))
    arms = arms_through_points(points[:4], TURNS[:4])
    line = int(np.flatnonzero(arms.found == RootKind.LINE)[0])
    assert (arms.first[line], arms.second[line]) == (0, np.inf)
    assert abs(arms.pivot[line].real) < 1e-9  # the direction at right angles to the line


def test_points_on_a_circle_are_told() -> None:
    points = 1 + 2j + np.exp(1j * np.array([0, 0.5, 1.4, 2.2, 3.0]))
    still = next(one for one in cranks_through_five_points(points, TURNS) if one.kind is CrankKind.STILL)
    assert still.pivot == pytest.approx(1 + 2j)
    assert any("lie on a circle" in one.description for one in timed_four_bars(points, TURNS))
    assert any("lie on a circle" in one.description for one in timed_four_bars(points[:4], TURNS[:4]))


def test_a_pivot_infinitely_far_is_told() -> None:
    """The arm p = W e^{i th} + s t with the pivot moving on a line: the second link is infinitely long."""
    points = 0.5 * np.exp(1j * TURNS[:4]) + np.array([0, 0.4, 1.3, 1.1]) * np.exp(0.3j)
    arms = arms_through_points(points, TURNS[:4])
    (far,) = np.flatnonzero(arms.found == RootKind.FAR_PIVOT)
    assert arms.first[far] == pytest.approx(0.5)
    assert abs((arms.pivot[far] * np.exp(-0.3j)).real) < 1e-9
    assert len(dyads_through_points(points, TURNS[:4])) in {0, 2}
    assert any("pivot is infinitely far" in one.description for one in timed_four_bars(points, TURNS[:4]))


def test_equal_radii_and_a_path_along_x_are_tasks_like_any_other() -> None:
    """Where the elimination by hand divides by zero: all |p| equal, and n1 = n4 = n5 = 0.  [thesis 2.40, 2.44]"""
    random = np.random.default_rng(5)
    planted_arm = TwoLinkArm(0.3 + 0.2j, abs(0.3 + 0.2j), 0.8, 0.6)
    th1 = np.sort(random.uniform(0, 2.5, size=4))
    points = planted_arm.end_position(th1, np.array([0.4, 1.5, 1.1, 2.9]))
    centre = circle_centre(points[:3])
    moved = points - centre  # three of the radii are equal now
    found = dyads_through_points(moved, th1)
    assert min(abs(one.pivot + centre - planted_arm.pivot) for one in found) < 1e-9
    along = arms_through_points(np.array([0, 0.5, 0.9, 1.6]) + 0j, TURNS[:4])
    assert RootKind.LINE in along.found


def circle_centre(points: np.ndarray) -> complex:
    a, b, c = points
    w = (c - a) / (b - a)
    return complex((b - a) * (w - abs(w) ** 2) / (2j * w.imag) + a)


def test_a_batch_is_its_tasks_one_by_one() -> None:
    random = np.random.default_rng(9)
    points = random.normal(size=(3, 50, 4)) + 1j * random.normal(size=(3, 50, 4))
    angles = random.uniform(-3, 3, size=(3, 50, 4))
    points[0, 0] = np.nan
    points[1, 1] = 1 + np.exp(1j * angles[1, 1])
    arms = arms_through_points(points, angles)
    assert arms.pivot.shape == arms.first.shape == (3, 50, 3)
    assert set(arms.found[0, 0]) == set(arms.found[1, 1]) == {RootKind.FAMILY}
    for at in [(0, 1), (1, 7), (2, 49)]:
        one = dyads_through_points(points[at], angles[at])
        real = arms.found[at] == RootKind.ARM
        np.testing.assert_allclose([arm.pivot for arm in one], arms.pivot[at][real], rtol=1e-9)
        np.testing.assert_allclose([arm.first for arm in one], arms.first[at][real], rtol=1e-9)
    real = arms.found == RootKind.ARM
    ends = points[..., None, :] - arms.pivot[..., None] - arms.first[..., None] * np.exp(1j * angles[..., None, :])
    uneven = np.ptp(np.abs(ends), axis=-1) / np.maximum(1, np.abs(arms.first) + np.abs(arms.pivot))
    assert np.max(uneven[real]) < 1e-9


def test_a_hundredth_of_the_benchmark_is_met_to_the_last_digits() -> None:
    random = np.random.default_rng(1)
    count = 1000
    pivot = random.uniform(-1, 1, count) + 1j * random.uniform(-1, 1, count)
    first, second = random.uniform(0.3, 2, (2, count))
    th1, th2 = np.cumsum(random.uniform(0.2, 1, (2, count, 4)), axis=-1) + random.uniform(-3, 3, (2, count, 1))
    points = pivot[:, None] + first[:, None] * np.exp(1j * th1) + second[:, None] * np.exp(1j * th2)
    arms = arms_through_points(points, th1)
    apart = np.abs(arms.pivot - pivot[:, None]) + np.abs(arms.first - first[:, None])
    assert np.mean(np.nanmin(apart + np.abs(arms.second - second[:, None]), axis=-1) <= 1e-9) >= 0.999


FIVE = np.array([0, 1, 1 + 1j, 2j, 3 + 1j])


@pytest.mark.parametrize(
    ("method", "points", "angles", "said"),
    [
        (cranks_through_five_points, FIVE[:4], TURNS[:4], "4 timed points; exactly 5; for 4: dyads_through_points"),
        (timed_curve, FIVE, TURNS, "5 timed points; exactly 4; for 5: cranks_through_five_points"),
        (timed_four_bars, FIVE[:2], TURNS[:2], "3 to 5 points for an exact solution; give more points"),
        (timed_four_bars, np.arange(6) + 1j, np.arange(6) / 2, "for more points use approximate synthesis"),
        (timed_four_bars, FIVE[:3], TURNS[:3], "do not determine the pivots"),
        (timed_four_bars, FIVE, TURNS / deg, "angles are in radians"),
        (timed_four_bars, FIVE[[0, 1, 2, 1]], TURNS[[0, 1, 2, 1]], "timed points 2 and 4 are the same"),
        (cranks_through_five_points, FIVE, 0 * TURNS, "the crank has the same angle at all points"),
        (timed_curve, FIVE[:4], 0 * TURNS[:4], "the crank has the same angle at all points"),
        (
            timed_four_bars,
            1j + np.exp(1j * TURNS),
            TURNS,
            "follow the rotation of the crank, so that a crank of any length",
        ),
        (timed_curve, 1j + np.exp(1j * TURNS[:4]), TURNS[:4], "follow the rotation of the crank"),
    ],
)
def test_what_is_no_timed_path(method, points, angles, said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        method(points, angles)
