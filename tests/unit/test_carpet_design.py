"""Design: the knot grid, and box averages in linear light."""

import numpy as np
import pytest

from ilmek.carpet.colour import LINEAR, decode, encode
from ilmek.carpet.design import distortion, knot_grid, resampled
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.errors import CarpetError
from ilmek.progress import Progress


def coverage(pixels: int, knots: int) -> np.ndarray:
    """Share of each knot's interval that each pixel covers, by the definition."""
    low, high = np.arange(knots) * pixels / knots, np.arange(1, knots + 1) * pixels / knots
    left, right = np.arange(pixels), np.arange(1, pixels + 1)
    shared = np.minimum(high[:, None], right) - np.maximum(low[:, None], left)
    return np.maximum(shared, 0) * knots / pixels


@pytest.mark.parametrize(
    ("shape", "grid"),
    [((60, 40), (7, 11)), ((7, 11), (60, 40)), ((30, 30), (10, 15)), ((5, 90), (90, 5)), ((1, 1), (3, 4))],
)
def test_equals_the_matrix_of_coverages(shape: tuple[int, int], grid: tuple[int, int]) -> None:
    rgb = np.random.default_rng(1).integers(0, 256, (*shape, 3), dtype=np.uint8)
    light = np.einsum("ry,cx,yxk->rck", coverage(shape[0], grid[0]), coverage(shape[1], grid[1]), LINEAR[rgb])
    expected = 255 * encode(light)
    found = resampled(rgb, *grid)
    # On a tie of two codes either is the nearest.
    assert np.abs(found - expected).max() <= 0.5 + 1e-9


def test_light_is_added_up_not_codes() -> None:
    chequer = (np.indices((8, 8)).sum(axis=0) % 2 * 255).astype(np.uint8)[..., None].repeat(3, axis=2)
    assert np.array_equal(resampled(chequer, 2, 2), np.full((2, 2, 3), 188, dtype=np.uint8))


@pytest.mark.parametrize("code", [0, 1, 7, 100, 254, 255])
def test_flat_colour_stays(code: int) -> None:
    flat = np.full((37, 53, 3), code, dtype=np.uint8)
    assert np.array_equal(resampled(flat, 10, 90), np.full((10, 90, 3), code))


def test_mean_light_is_kept() -> None:
    rgb = np.random.default_rng(3).integers(0, 256, (300, 200, 3), dtype=np.uint8)
    kept = decode(resampled(rgb, 70, 90) / 255).mean(axis=(0, 1))
    assert kept == pytest.approx(LINEAR[rgb].mean(axis=(0, 1)), rel=1e-3)


def test_bands_do_not_show_and_progress_ends_at_one() -> None:
    rgb = np.random.default_rng(4).integers(0, 256, (500, 4, 3), dtype=np.uint8)
    shares: list[float] = []
    tall = resampled(rgb, 300, 4, Progress(lambda _, share: shares.append(share)))
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    assert np.array_equal(tall[:150], resampled(rgb[:250], 150, 4))
    assert np.array_equal(tall[150:], resampled(rgb[250:], 150, 4))


def test_same_grid_is_untouched() -> None:
    rgb = np.random.default_rng(5).integers(0, 256, (6, 9, 3), dtype=np.uint8)
    assert np.array_equal(resampled(rgb, 6, 9), rgb)


def test_knots_need_not_be_square() -> None:
    assert knot_grid(CarpetSize(1.0, 1.0), Quality(260.0, 330.0)) == (330, 260)


@pytest.mark.parametrize(
    ("size", "quality", "said"),
    [
        (CarpetSize(0.01, 1.0), Quality(60.0, 60.0), "at least 2 × 2"),
        (CarpetSize(50.0, 50.0), Quality(500.0, 500.0), "625 million"),
    ],
)
def test_grids_refused(size: CarpetSize, quality: Quality, said: str) -> None:
    with pytest.raises(CarpetError, match=said):
        knot_grid(size, quality)


def test_distortion_is_signed() -> None:
    wide = np.zeros((100, 300, 3), dtype=np.uint8)
    assert distortion(wide, CarpetSize(3.0, 1.0)) == 0.0
    assert distortion(wide, CarpetSize(1.5, 1.0)) == -0.5
