"""A crop keeps the subject: brute force over all parts, by Pillow and by hand."""

import numpy as np
import pytest
from effort import examples
from fitted_picture import fit_picture
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image, ImageDraw, ImageFilter

from ilmek.arrays import Rgb
from ilmek.carpet.fitting import FitParams
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.subject import subject_start

WIDE, HIGH, PART = 180, 90, 60
"""A lying picture of which an upright part of 2 : 3 is shown."""


def scene(x: int, y: int, radius: int = 18) -> Image.Image:
    """A red disc with a cross on an even ground with grain."""
    grain = np.random.default_rng(3).normal(0, 2, (HIGH, WIDE, 1))
    picture = Image.fromarray(np.clip(np.array([150, 160, 140]) + grain, 0, 255).astype(np.uint8))
    draw = ImageDraw.Draw(picture)
    draw.ellipse((x - radius, y - radius, x + radius, y + radius), fill=(190, 40, 30))
    draw.line((x - 10, y, x + 10, y), fill=(250, 240, 220), width=4)
    draw.line((x, y - 10, x, y + 10), fill=(250, 240, 220), width=4)
    return picture


def rgb_of(picture: Image.Image) -> Rgb:
    return np.asarray(picture)


@given(st.integers(24, WIDE - 24))
@examples(20)
def test_an_object_anywhere_is_shown_whole(x: int) -> None:
    left = subject_start(rgb_of(scene(x, 45)), PART, across=True)
    assert left <= x - 17
    assert x + 17 <= left + PART
    turned = scene(x, 45).transpose(Image.Transpose.ROTATE_270)
    assert subject_start(rgb_of(turned), PART, across=False) == pytest.approx(left, abs=1)


@given(st.integers(20, WIDE - 20), st.integers(20, WIDE - 20))
@examples(15)
def test_a_mirrored_picture_has_the_mirrored_part(first: int, second: int) -> None:
    picture = Image.blend(scene(first, 40), scene(second, 50), 0.4)
    mirrored = picture.transpose(Image.Transpose.FLIP_LEFT_RIGHT)
    left = subject_start(rgb_of(picture), PART, across=True)
    assert subject_start(rgb_of(mirrored), PART, across=True) == pytest.approx(WIDE - PART - left, abs=1)


@pytest.mark.parametrize("x", [25, 60, 90, 140])
def test_no_part_has_many_more_edges_by_pillow(x: int) -> None:
    picture = scene(x, 45, 12)
    edges = np.asarray(picture.convert("L").filter(ImageFilter.FIND_EDGES), dtype=float)[1:-1, 1:-1]
    shown = [edges[:, left : left + PART].sum() for left in range(edges.shape[1] - PART + 1)]
    left = subject_start(rgb_of(picture), PART, across=True)
    assert edges[:, max(left - 1, 0) : left - 1 + PART].sum() >= 0.9 * max(shown)


def test_an_even_picture_is_cropped_about_its_centre() -> None:
    grey = np.full((HIGH, WIDE, 3), 128, dtype=np.uint8)
    assert subject_start(grey, PART, across=True) == (WIDE - PART) // 2


def test_the_frame_is_that_of_what_is_shown() -> None:
    rgb = rgb_of(scene(150, 45))
    made, fit = fit_picture(rgb, CarpetSize(0.4, 0.6), FitParams())
    assert fit.kind == "crop"
    left, top, right, bottom = (round(one * side) for one, side in zip(fit.shown, 2 * (WIDE, HIGH), strict=True))
    assert np.array_equal(made, rgb[top:bottom, left:right])
    assert fit.cropped == pytest.approx(1 - made.shape[0] * made.shape[1] / (HIGH * WIDE))
    assert left <= 132
    assert right >= 168
