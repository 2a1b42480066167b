"""The shipped picture is what its script draws."""

import runpy
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="module")
def drawn() -> np.ndarray:
    return np.asarray(runpy.run_path(str(EXAMPLES / "draw_medallion.py"))["draw"]())


def test_script_draws_the_shipped_picture(drawn: np.ndarray) -> None:
    with Image.open(EXAMPLES / "medallion.png") as image:
        shipped = np.asarray(image)
    assert shipped.shape == drawn.shape == (1800, 1200, 3)
    # Another release of the drawing library may place an edge otherwise; a motif may not move.
    assert np.mean((shipped != drawn).any(axis=2)) < 1e-3


def test_picture_is_small_enough_to_ship() -> None:
    assert (EXAMPLES / "medallion.png").stat().st_size < 1_200_000


def test_design_is_symmetric_but_its_wool_is_not(drawn: np.ndarray) -> None:
    light = drawn.astype(float)
    difference = np.abs(light - light[:, ::-1]).mean()
    assert 0.5 < difference < 5
