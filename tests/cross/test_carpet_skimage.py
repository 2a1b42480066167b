"""Colour against scikit-image, which has its own CIEDE2000 and its own sRGB matrix (of four to six digits)."""

import numpy as np
import pytest
from skimage.color import deltaE_ciede2000, rgb2lab

from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000


def test_ciede2000_on_random_lab() -> None:
    rng = np.random.default_rng(7)
    one, other = (rng.uniform((0, -120, -120), (100, 120, 120), (50_000, 3)) for _ in range(2))
    assert np.abs(delta_e_2000(one, other) - deltaE_ciede2000(one, other)).max() < 1e-9


def test_ciede2000_of_near_colours() -> None:
    rng = np.random.default_rng(8)
    one = rng.uniform((0, -60, -60), (100, 60, 60), (50_000, 3))
    other = one + rng.normal(scale=0.5, size=one.shape)
    assert np.abs(delta_e_2000(one, other) - deltaE_ciede2000(one, other)).max() < 1e-6


def test_cielab_of_srgb() -> None:
    rng = np.random.default_rng(9)
    codes = rng.integers(0, 256, (20_000, 3), dtype=np.uint8)
    assert srgb_to_lab(codes) == pytest.approx(rgb2lab(codes), abs=0.03)
