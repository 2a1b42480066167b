"""Complete four-bar synthesis: equations, shipped start solutions, and what a task must be."""

import numpy as np
import pytest
from benchmarks.monodromy import all_solutions, task_with_solution

from ilmek.errors import ParameterError
from ilmek.synthesis.alt_burmester import start_sets
from ilmek.synthesis.alt_burmester.equations import linearised, products
from ilmek.synthesis.alt_burmester.homotopy import random_task, repeated, solution_keys, track
from ilmek.synthesis.alt_burmester.start_sets import CLASSES, pose_mask, start_set
from ilmek.synthesis.alt_burmester.task import FOUR_BARS, PosesAndPoints

CURVE = np.exp(2j * np.pi * np.arange(9) / 9) * (1 + 0.2 * np.arange(9))


def residuals(u: np.ndarray, T: np.ndarray, task: np.ndarray) -> np.ndarray:
    """|d + T x - A|² - |x - A|² of both links and all positions, by definition."""
    A, A1, x, x1, B, B1, y, y1 = u.T[:, :, None]
    d, d1 = task[:2]
    first = (d + T * x - A) * (d1 + x1 / T - A1) - (x - A) * (x1 - A1)
    return np.stack([first, (d + T * y - B) * (d1 + y1 / T - B1) - (y - B) * (y1 - B1)], -1)


@pytest.mark.parametrize("poses", CLASSES)
def test_shipped_solutions_are_as_many_as_in_the_literature(poses):
    found = start_set(poses)
    assert len(found.unknowns) == CLASSES[poses]
    assert (3 if poses == 1 else 1) * CLASSES[poses] == FOUR_BARS[poses, 10 - 2 * poses]
    assert not repeated(found.keys()).any()
    size = 1 + np.abs(found.unknowns).max(axis=1)[:, None, None] ** 2
    spread = np.abs(np.log(np.abs(found.rotations))).max(axis=1)[:, None, None]
    assert np.max(np.abs(residuals(found.unknowns, found.rotations, found.task)) / (size * np.exp(spread))) < 1e-11


def test_a_damaged_file_of_start_solutions_is_reported(monkeypatch):
    monkeypatch.setattr(start_sets, "CHECKSUM", "0" * 64)
    with pytest.raises(ParameterError, match="install ilmek again"):
        start_sets.start_set.__wrapped__(4)


def test_monodromy_finds_all_solutions_of_another_task():
    begin = task_with_solution(np.random.default_rng(7), pose_mask(4))
    assert len(all_solutions(begin, 3).unknowns) == 30


def test_the_made_task_has_its_solution():
    for poses in CLASSES:
        made = task_with_solution(np.random.default_rng(poses), pose_mask(poses))
        assert np.max(np.abs(residuals(made.unknowns, made.rotations, made.task))) < 1e-12


@pytest.mark.parametrize("poses", [5, 3, 1])
def test_the_matrix_of_newton_s_method_is_the_derivative(poses):
    rng, pose = np.random.default_rng(3), pose_mask(poses)
    task, count = random_task(rng, pose), len(pose)
    u, T = rng.normal(size=8) + 1j * rng.normal(size=8), task[2]
    p, e = np.empty((2, count, 2), complex), np.empty((2, count, 2), complex)
    matrix, weights = np.empty((8, 8), complex), np.empty((count, 2), complex)
    products(u, T, task[0], task[1], p, e)
    linearised(u, T, pose, task[0], task[1], p, e, matrix, weights)

    def rate(du: np.ndarray, turn: np.ndarray, h: float = 1e-6) -> np.ndarray:
        ahead = residuals((u + h * du)[None], T * np.exp(h * turn), task)[0]
        return (ahead - residuals((u - h * du)[None], T * np.exp(-h * turn), task)[0]) / (2 * h)

    assert rate(np.zeros(8), np.ones(count)) == pytest.approx(weights, rel=1e-7, abs=1e-7)
    for column in range(8):
        both = rate(np.eye(8)[column], np.zeros(count))
        rows = []
        for j in range(count):
            rows += list(both[j]) if pose[j] else [both[j, 0] * weights[j, 1] - both[j, 1] * weights[j, 0]]
        assert matrix[:, column] == pytest.approx(np.array(rows), rel=1e-6, abs=1e-6)


def test_paths_lead_back_to_their_beginning():
    begin = start_set(3)
    there = track(begin, random_task(np.random.default_rng(1), begin.pose))
    back = track(there.solved, begin.task)
    assert there.good.all()
    assert back.good.all()
    assert np.max(np.abs(back.solved.keys() / begin.keys() - 1)) < 1e-9


def test_cognates_and_exchanged_links_have_one_key():
    found = start_set(1)
    A, A1, x, x1, B, B1, y, y1 = found.unknowns.T
    z, z1 = -x / (y - x), -x1 / (y1 - x1)
    C, C1 = A + z * (B - A), A1 + z1 * (B1 - A1)
    other = np.stack([A, A1, A - x, A1 - x1, C, C1, C + z * (y - B), C1 + z1 * (y1 - B1)], axis=1)
    exchanged = found.unknowns[:, [4, 5, 6, 7, 0, 1, 2, 3]]
    for variant in (other, exchanged):
        assert np.max(np.abs(solution_keys(variant, True) / found.keys() - 1)) < 1e-8
    rotations = start_sets.rotations_of(other, found.task, found.pose)
    scale = (1 + np.abs(other).max(axis=1)[:, None] ** 2) * (np.abs(rotations) + 1 / np.abs(rotations))
    assert np.max(np.abs(residuals(other, rotations, found.task)) / scale[..., None]) < 1e-9


@pytest.mark.parametrize(
    ("points", "angles", "words"),
    [
        (CURVE[:8], np.full(8, np.nan), "1 and 8"),
        (CURVE, np.zeros(9), "9 poses"),
        (np.r_[CURVE[:8], CURVE[3]], np.full(9, np.nan), "points 4 and 9 are the same"),
        (np.arange(9) * (1 + 2j), np.full(9, np.nan), "straight line"),
        (np.r_[CURVE[:8], np.inf], np.full(9, np.nan), "not finite"),
        (CURVE[:6], np.r_[0, 30, 60, 90, np.nan, np.nan], "radians"),
        (CURVE[:6], np.zeros(5), "one angle"),
    ],
)
def test_a_task_that_no_method_takes_is_one_clear_error(points, angles, words):
    with pytest.raises(ParameterError, match=words):
        PosesAndPoints(points, angles)


def test_the_mixes_of_the_literature_are_taken():
    for poses, points in FOUR_BARS:
        angles = np.r_[0.1 * np.arange(poses), np.full(points, np.nan)][::-1]
        task = PosesAndPoints(CURVE[: poses + points], angles)
        assert (task.poses, len(task.pose)) == (poses, poses + points - 1)
        assert task.pose.sum() == poses - 1
        assert task.scaled[0] == pytest.approx(np.conj(task.scaled[1]))
