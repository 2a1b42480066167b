"""Two-link arms through poses and timed points: planted mechanisms are found again, all solutions close."""

import numpy as np
import pytest
from benchmarks.pencil import real_roots, roots
from hypothesis import assume, given
from hypothesis import strategies as st

from ilmek.errors import ParameterError
from ilmek.synthesis.dyad import TwoLinkArm, dyads_through_points, dyads_through_poses, four_bar
from ilmek.units import deg, mm

angles = st.floats(-np.pi, np.pi)
steps = st.floats(0.3, 1.5)
lengths = st.floats(0.2, 3.0)


@st.composite
def places_of(draw: st.DrawFn, count: int) -> tuple[TwoLinkArm, np.ndarray, np.ndarray, float]:
    """An arm, well separated angles of its two links, and the angle of its ground."""
    th0, ground = draw(angles), draw(lengths)
    th1, elbow = (draw(angles) + np.cumsum([draw(steps) for _ in range(count)]) for _ in range(2))
    arm = TwoLinkArm(ground * complex(np.exp(1j * th0)), ground, draw(lengths), draw(lengths))
    return arm, th1, th1 + elbow, th0


def nearest(found: tuple[TwoLinkArm, ...], planted: TwoLinkArm) -> float:
    return min(
        abs(x.pivot - planted.pivot) + abs(x.first - planted.first) + abs(x.second - planted.second) for x in found
    )


@given(places_of(4))
def test_a_planted_arm_is_among_those_through_four_timed_points(task) -> None:
    planted, th1, th2, _ = task
    points = planted.end_position(th1, th2)
    found = dyads_through_points(points, th1)
    for arm in found:
        closed = arm.end_position(th1, arm.second_angles(points, th1))
        np.testing.assert_allclose(closed, points, atol=1e-6 * max(1.0, abs(arm.first), arm.ground))
    assert nearest(found, planted) < 1e-4
    assert len(found) <= 3


@given(places_of(3))
def test_a_planted_arm_is_among_those_through_three_poses(task) -> None:
    planted, th1, th2, th0 = task
    points = planted.end_position(th1, th2)
    found = dyads_through_poses(points, th2, th0)
    for arm in found:
        assert abs(arm.pivot - arm.ground * np.exp(1j * th0)) < 1e-9 * max(1.0, abs(arm.ground))
        closed = arm.end_position(arm.first_angles(points, th2), th2)
        np.testing.assert_allclose(closed, points, atol=1e-6 * max(1.0, abs(arm.second), abs(arm.ground)))
    assert nearest(found, planted) < 1e-4
    assert len(found) <= 2


def test_most_random_tasks_have_one_or_three_arms() -> None:
    random = np.random.default_rng(2)
    counted = [
        len(
            dyads_through_points(
                random.normal(size=4) + 1j * random.normal(size=4), random.uniform(-np.pi, np.pi, size=4)
            )
        )
        for _ in range(200)
    ]
    assert set(counted) == {1, 3}


def test_turning_and_scaling_the_task_turns_and_scales_its_arms() -> None:
    points, th1 = np.array([0.1, 0.4 + 0.2j, 0.5 - 0.1j, 0.2 - 0.4j]), np.array([0.1, 0.9, 1.7, 2.9])
    factor, turned, moved = 250.0, 0.7, 3 - 2j
    found = dyads_through_points(points, th1)
    other = dyads_through_points(points * factor * np.exp(1j * turned) + moved, th1 + turned)
    assert len(found) == len(other)
    for one, two in zip(found, other, strict=True):
        assert two.pivot == pytest.approx(one.pivot * factor * np.exp(1j * turned) + moved, rel=1e-8)
        assert (two.first, two.second) == pytest.approx((factor * one.first, factor * one.second), rel=1e-8)


def test_points_on_a_line_have_fewer_arms_and_none_with_a_pivot_at_infinity() -> None:
    found = dyads_through_points(np.array([0.0, 1.0, 2.5, 3.0]) + 0j, np.array([0.0, 0.4, 1.3, 2.0]))
    assert all(np.isfinite(arm.pivot) and abs(arm.pivot) < 1e6 for arm in found)


def test_points_on_a_circle_are_told_by_an_arm_without_a_first_link() -> None:
    points = 2 + 1j + 0.5 * np.exp(1j * np.array([0.0, 0.7, 1.9, 3.3]))
    found = dyads_through_points(points, np.array([0.3, 0.2, 1.4, 2.0]))
    still = min(found, key=lambda arm: abs(arm.first))
    assert still.first == pytest.approx(0, abs=1e-9)
    assert still.pivot == pytest.approx(2 + 1j)
    assert still.second == pytest.approx(0.5)


def test_the_knotting_report_s_example() -> None:
    """Section 2: (0, 0), (25, 15), (30, 1) mm at 10, 3, -25 deg; the report's own arms miss by 10 to 29 mm."""
    points, th2 = np.array([0, 25 + 15j, 30 + 1j]) * mm, np.array([10, 3, -25]) * deg
    short, long = dyads_through_poses(points, th2, 275 * deg)
    assert (short.ground / mm, short.first / mm, short.second / mm) == pytest.approx(
        (1.255712017, 17.16552771, 17.22932881)
    )
    assert (long.ground / mm, long.first / mm, long.second / mm) == pytest.approx(
        (23.28552206, 37.52517660, 31.52594265)
    )
    assert short.first_angles(points, th2) / deg == pytest.approx([-174.1791206, 63.40440539, 33.73276562])
    assert long.first_angles(points, th2) / deg == pytest.approx([151.8174272, 103.1110900, 90.91871318])
    found = np.array(four_bar(short, long)) / mm
    assert found == pytest.approx([22.02981005, 17.16552771, 14.29661384, 37.52517660])


@pytest.mark.parametrize(
    ("points", "th1", "said"),
    [
        ([0, 1, 2j, np.nan], [0, 1, 2, 3], "not finite"),
        ([1, 1, 1, 1], [0, 1, 2, 3], "all points"),
        ([0, 1, 2j, 2j], [0, 1, 2, 2], "timed points 3 and 4 are the same"),
        (np.exp(1j * np.arange(4)), [0, 1, 2, 3], "a family"),
        ([0, 1, 2j], [0, 1, 2], "given 3 timed points; exactly 4; for 3: crank_of_pivot"),
        ([0, 1, 2j, 3], [0, 20, 45, 80], "angles are in radians: 80 deg would be 1.39626"),
    ],
)
def test_what_is_no_task(points: list[complex], th1: list[float], said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        dyads_through_points(np.array(points, dtype=complex), np.array(th1, dtype=float))


@pytest.mark.parametrize("second_angles", [[1.0, 2.0, 2.0], [1.0, 2.0, 3.0]], ids=["equal poses", "never bends"])
def test_poses_that_leave_a_length_free(second_angles) -> None:
    th2 = np.array(second_angles)
    points = TwoLinkArm(0.5j, 0.5, 1.0, 0.7).end_position(th2 - 0.5, th2)
    with pytest.raises(ParameterError, match="a family"):
        dyads_through_poses(points, th2, np.pi / 2)


@given(st.lists(st.floats(-5, 5), min_size=3, max_size=3, unique=True))
def test_the_roots_of_a_pencil_are_where_it_is_singular(values: list[float]) -> None:
    assume(min(abs(a - b) for i, a in enumerate(values) for b in values[:i]) > 1e-2)
    left, right = np.random.default_rng(3).normal(size=(2, 3, 3))
    A, B = left @ np.diag(values) @ right, -left @ right
    found = real_roots(A, B)
    assert [root.value for root in found] == pytest.approx(sorted(values), abs=1e-6)
    for root in found:
        assert np.linalg.norm((A + root.value * B) @ root.vector) < 1e-6


def test_infinite_and_absent_roots_are_left_out() -> None:
    assert roots(np.eye(2), np.zeros((2, 2))).size == 0
    assert roots(np.diag([1.0, 0.0]), np.diag([1.0, 0.0])).size == 0
    assert len(real_roots(np.array([[0.0, 1.0], [-1.0, 0.0]]), np.eye(2))) == 0
