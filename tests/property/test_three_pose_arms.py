"""Arms through three poses by the batch: planted ones found, nothing invented or dropped, every bad root told."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from ilmek.errors import ParameterError
from ilmek.num.pencil2 import roots2
from ilmek.synthesis.dyad import PoseArms, RootKind, arms_through_poses, dyads_through_poses

PLANTED = 1000


def planted(random: np.random.Generator) -> tuple[np.ndarray, ...]:
    """Ground, first and second links of random arms, their poses, and the angle of the ray."""
    ground, first, second = random.uniform(0.2, 3, (3, PLANTED)) * random.choice([-1, 1], (3, PLANTED))
    th0 = random.uniform(-np.pi, np.pi, PLANTED)
    th1, th2 = (
        random.uniform(-np.pi, np.pi, (PLANTED, 1)) + np.cumsum(random.uniform(0.1, 1.2, (PLANTED, 3)), axis=-1) * way
        for way in random.choice([-1, 1], (2, PLANTED, 1))
    )
    arm = (part[:, None] * np.exp(1j * angle) for part, angle in ((ground, th0[:, None]), (first, th1), (second, th2)))
    return ground, np.abs(first), second, sum(arm), th2, th0


def roots_of(points, angles, ground_angle, start=0j) -> tuple[list[RootKind], PoseArms]:
    arms = arms_through_poses(np.asarray(points, dtype=complex), np.asarray(angles, dtype=float), ground_angle, start)
    return [RootKind(int(one)) for one in arms.found], arms


def test_a_thousand_planted_arms_are_all_found_and_every_arm_closes() -> None:
    ground, first, second, points, th2, th0 = planted(np.random.default_rng(30))
    arms = arms_through_poses(points, th2, th0)
    there = arms.found == RootKind.ARM
    assert set(np.unique(arms.found)) == {RootKind.ARM}  # one root is planted, so the other is real too
    apart = [np.abs(one - sought[:, None]) for one, sought in zip((arms.ground, arms.first, arms.second),
                                                                (ground, first, second), strict=True)]  # fmt: skip
    off = np.min(sum(apart), axis=-1)
    assert np.mean(off <= 1e-9) >= 0.995
    assert np.max(off) < 1e-5
    reach = np.abs(points[:, None] - arms.pivot[..., None] - arms.second[..., None] * np.exp(1j * th2)[:, None])
    size = np.maximum(arms.first, np.maximum(np.abs(arms.ground), np.abs(arms.second)))
    assert np.max((np.ptp(reach, axis=-1) / size)[there]) < 1e-9
    np.testing.assert_allclose(arms.pivot, arms.ground * np.exp(1j * th0)[:, None], atol=1e-12 * np.max(size))


def test_the_batch_is_every_task_by_itself() -> None:
    _, _, _, points, th2, th0 = planted(np.random.default_rng(31))
    whole = arms_through_poses(points[:40].reshape(8, 5, 3), th2[:40].reshape(8, 5, 3), th0[:40].reshape(8, 5))
    for k in range(40):
        alone = dyads_through_poses(points[k], th2[k], float(th0[k]))
        np.testing.assert_array_equal([arm.ground for arm in alone], whole.ground.reshape(-1, 2)[k])
        np.testing.assert_array_equal([arm.second for arm in alone], whole.second.reshape(-1, 2)[k])


@given(
    st.floats(1e-3, 1e3),
    st.floats(-np.pi, np.pi),
    st.complex_numbers(max_magnitude=50),
    st.floats(-20, 20),
)
def test_turned_scaled_and_moved_poses_have_turned_scaled_and_moved_arms(factor, turned, moved, along) -> None:
    points, th2, th0 = np.array([0, 25 + 15j, 30 + 1j]), np.array([0.1745, 0.0524, -0.4363]), 4.8
    e = np.exp(1j * turned)
    one = dyads_through_poses(points, th2, th0)
    other = dyads_through_poses(factor * e * points + moved, th2 + turned, th0 + turned, complex(moved))
    slid = dyads_through_poses(points + along * np.exp(1j * th0), th2, th0)
    assert len(one) == len(other) == len(slid) == 2
    for a, b, c in zip(one, other, slid, strict=True):
        lengths = np.array([a.ground, a.first, a.second])
        np.testing.assert_allclose([b.ground, b.first, b.second], factor * lengths, rtol=1e-9, atol=1e-9 * factor)
        assert abs(b.pivot - (factor * e * a.pivot + moved)) < 1e-9 * (factor * abs(a.pivot) + abs(moved) + factor)
        np.testing.assert_allclose([c.ground, c.first, c.second], lengths + np.array([along, 0, 0]), atol=1e-8)


@given(st.floats(-3, 3), st.floats(0.2, 3), st.floats(-3, 3), st.floats(0.3, 2.0))
def test_a_pin_on_a_straight_line_across_the_ray_is_told_by_a_pivot_infinitely_far(th0, step, second, turned) -> None:
    th2 = np.array([0.2, 0.2 + turned, -0.5])
    pins = (0.7 + 1j * step * np.array([0.0, 1.0, -1.6])) * np.exp(1j * th0)
    assume(np.min(np.abs(np.diff(np.cos(th2 - th0)))) > 0.05)
    kinds, arms = roots_of(pins + second * np.exp(1j * th2), th2, th0)
    assert RootKind.FAR_PIVOT in kinds
    assert arms.second[kinds.index(RootKind.FAR_PIVOT)] == pytest.approx(second, abs=1e-6)
    assert arms.ground[kinds.index(RootKind.FAR_PIVOT)] == np.inf


@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(-2, 2))
def test_a_line_through_the_pivot_is_told_by_an_elbow_infinitely_far(th0, ground, aside) -> None:
    th2, slid = np.array([0.2, 1.0, -0.4]), np.array([0.3, 1.2, -0.5])
    assume(np.min(np.abs(np.diff(np.cos(th2 - th0)))) > 0.05)
    points = ground * np.exp(1j * th0) + (aside + 1j * slid) * np.exp(1j * th2)
    kinds, arms = roots_of(points, th2, th0)
    assert RootKind.FAR_ELBOW in kinds
    at = kinds.index(RootKind.FAR_ELBOW)
    assert arms.ground[at] == pytest.approx(ground, abs=1e-6)
    assert arms.second[at] == arms.first[at] == np.inf


@pytest.mark.parametrize(
    ("points", "angles", "ground_angle", "said"),
    [
        ([1 + 1j, 2 + 1j, 2.5 + 3j], [0.3, 0.3, 0.3], 0.2, [RootKind.ARM, RootKind.FAR_BOTH]),
        ([1 + 1j, 1 + 2j, 1 + 4j], [0.3, 0.3, 0.3], 0.0, [RootKind.FAR_PIVOT, RootKind.FAR_PIVOT]),
        ([0, 1 + 1j, 2 + 0.3j], [0.8, 0.2, 0.8], 0.5, [RootKind.ARM, RootKind.FAR_BOTH]),
        ([0, 3, 5], [0, 0.4, -0.2], np.pi / 2, [RootKind.ARM, RootKind.FAR_PIVOT]),
        ([0, 1, 2j], [0, 1, np.nan], 0.0, [RootKind.FAMILY, RootKind.FAMILY]),
        ([0, 1, 1], [0, 1, 1], 0.5, [RootKind.FAMILY, RootKind.FAMILY]),
        ([0, 0, 0], [0, 0, 0], 0.5, [RootKind.FAMILY, RootKind.FAMILY]),
    ],
    ids=["shifted only", "shifted across the ray", "one angle to the ray", "a straight path across the ray",
         "no number", "equal poses", "no task"],
)  # fmt: skip
def test_every_bad_root_is_told(points, angles, ground_angle, said) -> None:
    kinds, arms = roots_of(points, angles, ground_angle)
    assert kinds == said
    assert all(kind.words for kind in kinds)
    assert np.isfinite(arms.pivot[arms.found == RootKind.ARM]).all()


def test_places_equally_far_from_the_origin_are_an_arm_without_ground_and_second_link() -> None:
    """The elimination by hand divides by both."""
    points = 2 * np.exp(1j * np.array([0.1, 0.9, 2.0]))
    found = dyads_through_poses(points, np.array([0.4, 1.0, 0.2]), 0.7)
    assert len(found) == 2
    assert (found[0].ground, found[0].first, found[0].second) == pytest.approx((0, 2, 0), abs=1e-12)


def test_poses_that_no_real_arm_takes_have_none() -> None:
    points, th2 = np.array([0, 25 + 15j, 30 + 1j]), np.radians([10.0, 3.0, -25.0])
    kinds, arms = roots_of(points, th2, np.radians(40.0))
    assert kinds == [RootKind.COMPLEX, RootKind.COMPLEX]
    assert np.isnan(arms.first).all()
    assert dyads_through_poses(points, th2, np.radians(40.0)) == ()


def test_one_rotation_about_a_place_of_the_ray_leaves_a_length_free() -> None:
    th2 = np.array([0.0, 0.7, 1.5])
    points = 2 * np.exp(0.5j) + np.exp(1j * (th2 + 0.9))
    with pytest.raises(ParameterError, match="a family"):
        dyads_through_poses(points, th2, 0.5)


def test_angles_in_degrees_are_told() -> None:
    with pytest.raises(ParameterError, match=r"-25 deg would be -0\.436|45 deg would be 0\.785"):
        dyads_through_poses(np.array([0, 25 + 15j, 30 + 1j]), np.array([10.0, 3.0, -25.0]), 4.8)


@given(st.lists(st.floats(-5, 5), min_size=2, max_size=2, unique=True))
def test_both_roots_of_a_small_pencil_are_where_it_is_singular(values: list[float]) -> None:
    assume(abs(values[0] - values[1]) > 1e-3)
    left, right = np.random.default_rng(3).normal(size=(2, 2, 2))
    A, B = left @ np.diag(values) @ right, -left @ right
    found = roots2(A, B)
    assert found.real.all()
    assert np.sort(found.numerator / found.denominator) == pytest.approx(sorted(values), abs=1e-9)
    rows = found.denominator[:, None, None] * A + found.numerator[:, None, None] * B
    np.testing.assert_allclose(np.einsum("nij,nj->ni", rows, found.vectors), 0, atol=1e-12)
    assert not roots2(np.array([[0.0, 1.0], [-1.0, 0.0]]), np.eye(2)).real.any()
