"""Arms along many timed points: planted ones are found, no neighbour is better, the misses are what the arm does."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import least_squares as peer

from ilmek.errors import ParameterError
from ilmek.synthesis.approximation.dyad import dyads_along
from ilmek.synthesis.dyad import TwoLinkArm

U = np.linspace(0, 1, 15)
PATH = 0.04 * U + 0.015j * np.sin(np.pi * U)  # 40 mm long, 15 mm high
ANGLES = np.radians(20 + 70 * U)


def misses(arm: np.ndarray, points: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """By how much each of many arms (pivot x and y, both links) misses each point."""
    pivot, first, second = arm[..., :1] + 1j * arm[..., 1:2], arm[..., 2:3], arm[..., 3:4]
    return np.abs(points - pivot - first * np.exp(1j * angles)) - second


@settings(max_examples=6)
@given(st.integers(0, 2**32 - 1), st.sampled_from(["least squares", "minimax"]))
def test_a_planted_arm_is_found_without_error(seed: int, criterion: str) -> None:
    random = np.random.default_rng(seed)
    th1, th2 = random.uniform(-3, 3, (2, 1)) + np.cumsum(random.uniform(0.1, 0.4, (2, 8)), axis=-1)
    arm = TwoLinkArm(complex(*random.uniform(-1, 1, 2)), 0.0, *random.uniform(0.4, 2, 2).tolist())
    best = dyads_along(arm.end_position(th1, th2), th1, criterion).found[0]
    assert best.worst < 1e-8
    assert abs(best.dyad.pivot - arm.pivot) + abs(best.dyad.first - arm.first) < 1e-5


@pytest.mark.parametrize("criterion", ["least squares", "minimax"])
def test_no_neighbour_and_no_peer_is_better(criterion: str) -> None:
    found = dyads_along(PATH, ANGLES, criterion).found
    random = np.random.default_rng(4)
    size = (
        (lambda e: np.sqrt(np.mean(e**2, axis=-1)))
        if criterion == "least squares"
        else lambda e: np.max(abs(e), axis=-1)
    )
    for one in found:
        arm = np.array([one.dyad.pivot.real, one.dyad.pivot.imag, one.dyad.first, one.dyad.second])
        errors = misses(arm, PATH, ANGLES)
        np.testing.assert_allclose(errors, one.errors, atol=1e-12)
        near = misses(arm + random.normal(size=(400, 4)) * 1e-5, PATH, ANGLES)
        assert one.proven
        assert np.min(size(near)) > size(errors) * (1 - 1e-6)
    if criterion == "least squares":
        starts = random.normal(size=(15, 4)) * 0.05
        ends = [peer(misses, start, args=(PATH, ANGLES), xtol=1e-14, ftol=1e-14, gtol=1e-14) for start in starts]
        assert found[0].rms <= min(np.sqrt(2 * end.cost / 15) for end in ends) * (1 + 1e-6)


def test_each_criterion_is_best_by_its_own_measure() -> None:
    squares, greatest = dyads_along(PATH, ANGLES, "least squares"), dyads_along(PATH, ANGLES)
    through = dyads_along(PATH, ANGLES, "interpolation")
    assert greatest.found[0].worst < squares.found[0].worst
    assert squares.found[0].rms < greatest.found[0].rms
    assert greatest.found[0].bound == pytest.approx(greatest.found[0].worst, rel=1e-7)
    touching = np.abs(greatest.found[0].errors) > greatest.found[0].worst * (1 - 1e-6)
    assert touching.sum() >= 4
    for one in through.found:
        assert np.sum(np.abs(one.errors) < 1e-12) == 4
        assert one.worst >= greatest.found[0].worst


@pytest.mark.parametrize(
    ("points", "angles", "criterion", "words"),
    [
        (PATH[:4], ANGLES[:4], "minimax", "dyads_through_points"),
        (PATH[:3], ANGLES[:3], "interpolation", "3 timed points for interpolation"),
        (PATH, ANGLES[:5], "minimax", "one angle for each point"),
        (PATH, np.degrees(ANGLES), "minimax", "radians"),
        (PATH, ANGLES, "closest", "interpolation, least squares, minimax"),
        (PATH * 0, ANGLES, "minimax", "all timed points are the same"),
        (PATH * np.nan, ANGLES, "minimax", "not finite"),
        (PATH, ANGLES * 0 + 1, "minimax", "family"),
    ],
)
def test_a_wrong_task_is_answered_in_words(points: np.ndarray, angles: np.ndarray, criterion: str, words: str) -> None:
    with pytest.raises(ParameterError, match=words):
        dyads_along(points, angles, criterion)
