"""Specks are the small patches that belong to no pattern: of drawn grounds, and of grounds beside real grain."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import ndimage

from ilmek.carpet.patches import small_patches
from ilmek.carpet.specks import FARTHEST, specks


def _dotted(step: tuple[float, float], dot: int, shift: float = 0.0) -> np.ndarray:
    """A ground of dots, each a square of knots; every other row is moved by a share of the step."""
    knots = np.zeros((150, 120), dtype=np.uint8)
    for number, row in enumerate(np.arange(3, 146, step[0])):
        for column in np.arange(3 + shift * step[1] * (number % 2), 116, step[1]):
            knots[round(row) : round(row) + dot, round(column) : round(column) + dot] = 1
    return knots


@pytest.mark.parametrize("step", [(5, 5), (7.4, 6.3), (20, 12), (4.5, 9.7)])
@pytest.mark.parametrize("shift", [0.0, 0.5])
def test_a_dotted_ground_has_no_specks(step: tuple[float, float], shift: float) -> None:
    knots = _dotted(step, 2, shift)
    assert small_patches(knots, 4).sizes.sum() > 50
    assert specks(knots, 4).sizes.sum() == 0


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 10**6), number=st.integers(1, 12))
def test_specks_on_a_dotted_ground_are_all_found(seed: int, number: int) -> None:
    knots, rng = _dotted((8, 10), 1), np.random.default_rng(seed)
    knots[rng.integers(0, 150, number), rng.integers(0, 120, number)] = 2
    labels, count = ndimage.label(knots == 2, np.ones((3, 3)))
    small = sum(size <= 3 for size in np.bincount(labels.ravel())[1 : count + 1])
    assert specks(knots, 3).sizes[1:4].sum() == small


def test_the_grain_of_a_picture_stays_specks() -> None:
    rng = np.random.default_rng(8)
    knots = np.zeros((300, 450), dtype=np.uint8)
    knots.ravel()[rng.choice(knots.size, 800, replace=False)] = 1
    every = int(small_patches(knots, 3).sizes.sum())
    assert 0.99 * every <= specks(knots, 3).sizes.sum() <= every


def test_few_or_distant_dots_are_specks() -> None:
    few, distant = np.zeros((60, 60), dtype=np.uint8), np.zeros((40, 8 * FARTHEST), dtype=np.uint8)
    few[10, 5:41:9] = 1
    assert specks(few, 1).sizes.sum() == 4
    distant[10, 3 :: FARTHEST + 1] = 1
    assert specks(distant, 1).sizes[1] == np.count_nonzero(distant)
