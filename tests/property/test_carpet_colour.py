"""Colour: inverses, the metric's laws, and the pruned search against the plain one."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from ilmek.carpet.colour import decode, encode, lab_to_srgb, lab_to_xyz, srgb_to_lab, xyz_to_lab
from ilmek.carpet.colour_difference import delta_e_2000, least_square
from ilmek.carpet.nearest_colour import SIDE, cube_bound, nearest

LABS = hnp.arrays(float, (8, 3), elements=st.floats(-128, 128)).map(
    lambda lab: np.stack([np.abs(lab[:, 0]) * 100 / 128, lab[:, 1], lab[:, 2]], axis=-1)
)


def every_colour(step: int) -> np.ndarray:
    codes = np.append(np.arange(0, 256, step), 255).astype(np.uint8)
    return np.stack(np.meshgrid(codes, codes, codes), axis=-1).reshape(-1, 3)


def test_srgb_survives_cielab() -> None:
    codes = every_colour(5)
    assert np.array_equal(lab_to_srgb(srgb_to_lab(codes)), codes)


def test_greys_are_neutral() -> None:
    greys = np.repeat(np.arange(256, dtype=np.uint8)[:, None], 3, axis=1)
    assert np.abs(srgb_to_lab(greys)[:, 1:]).max() < 1e-12


@given(st.floats(0, 1))
def test_transfer_curve_is_inverted(value: float) -> None:
    # Between the two branches the standard leaves a step of 1.4e-8 of light.
    assert float(encode(decode(value))) == pytest.approx(value, abs=3e-7)


@given(LABS)
def test_xyz_survives_cielab(lab: np.ndarray) -> None:
    assert xyz_to_lab(lab_to_xyz(lab)) == pytest.approx(lab, abs=1e-9)


@given(LABS, LABS)
def test_difference_is_symmetric_and_zero_only_at_home(one: np.ndarray, other: np.ndarray) -> None:
    there, back = delta_e_2000(one, other), delta_e_2000(other, one)
    assert there == pytest.approx(back, abs=1e-9)
    assert np.array_equal(delta_e_2000(one, one), np.zeros(8))
    assert np.all((there > 0) | (np.abs(one - other).max(axis=1) < 1e-6))


@given(LABS, LABS)
def test_lower_bound_holds(one: np.ndarray, other: np.ndarray) -> None:
    difference = delta_e_2000(one, other)
    for lab, yarn, found in zip(one.tolist(), other.tolist(), difference.tolist(), strict=True):
        bound = least_square(*lab, *yarn, (np.hypot(*lab[1:]) + np.hypot(*yarn[1:])) / 2)
        assert bound <= found**2 * (1 + 1e-9) + 1e-12


@given(LABS, LABS, LABS)
def test_lower_bound_of_a_cube_holds(middles: np.ndarray, others: np.ndarray, places: np.ndarray) -> None:
    inside = middles + (places - np.array([50.0, 0.0, 0.0])) / np.array([50.0, 130.0, 130.0]) * SIDE / 2
    assert np.abs(inside - middles).max() <= SIDE / 2
    difference = delta_e_2000(inside, others)
    for middle, other, exact in zip(middles.tolist(), others.tolist(), difference.tolist(), strict=True):
        assert cube_bound(*middle, SIDE / 2, *other) <= exact**2 * (1 + 1e-9) + 1e-12


def test_colours_beyond_the_cubes_have_their_nearest() -> None:
    yarns = np.array([[50.0, 0.0, 0.0], [90.0, 160.0, 0.0], [104.0, 0.0, -170.0]])
    colours = np.array([[105.0, 0.0, 0.0], [80.0, 200.0, 5.0], [-3.0, 0.0, 0.0], [100.0, 0.0, -128.5]])
    index, delta = nearest(colours, yarns)
    table = delta_e_2000(colours[:, None], yarns[None])
    assert np.array_equal(index, table.argmin(axis=1))
    assert np.array_equal(delta, table.min(axis=1))


@pytest.mark.parametrize("seed", range(4))
def test_pruned_search_is_exact(seed: int) -> None:
    rng = np.random.default_rng(seed)
    yarns = srgb_to_lab(rng.integers(0, 256, (24, 3), dtype=np.uint8))
    yarns[20:] = yarns[:4]  # equal yarns: the first of the list is to win
    colours = srgb_to_lab(rng.integers(0, 256, (5000, 3), dtype=np.uint8))
    index, delta = nearest(colours, yarns)
    table = delta_e_2000(colours[:, None], yarns[None])
    assert np.array_equal(index, table.argmin(axis=1))
    assert np.array_equal(delta, table.min(axis=1))
