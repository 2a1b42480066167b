"""A carpet without a size takes the shape of its picture, and its size does not change how the picture is read."""

import itertools
import math

import numpy as np
import pytest
from effort import examples
from hypothesis import given
from hypothesis import strategies as st

from ilmek.arrays import Rgb
from ilmek.carpet.chart_making import make_chart
from ilmek.carpet.design import knot_grid
from ilmek.carpet.fitting import FitParams
from ilmek.carpet.quality import Quality
from ilmek.carpet.size_of_picture import USUAL_SIZE, size_of_picture
from ilmek.carpet.sizes import STANDARD_SIZES, CarpetSize
from ilmek.errors import CarpetError
from ilmek.io.yarn_file import default_yarns

SHAPES = st.floats(math.log(1 / 8), math.log(8)).map(math.exp)
QUALITIES = st.builds(Quality, st.integers(80, 800).map(float), st.integers(80, 800).map(float))
YARNS = default_yarns()


def off(size: CarpetSize, proportions: float) -> float:
    return abs(size.width / size.length / proportions - 1)


@given(SHAPES, QUALITIES)
@examples(200)
def test_the_size_has_the_pictures_shape_and_about_the_usual_area(proportions: float, quality: Quality) -> None:
    size = size_of_picture(proportions, quality)
    assert off(size, proportions) <= 0.0201
    if size.name:
        assert sorted((size.width, size.length)) == sorted(
            (STANDARD_SIZES[size.name].width, STANDARD_SIZES[size.name].length)
        )
    else:
        assert 1 / 1.2 <= size.area / USUAL_SIZE.area <= 1.2


@given(SHAPES, QUALITIES)
@examples(100)
def test_a_picture_that_is_turned_has_the_turned_size(proportions: float, quality: Quality) -> None:
    size = size_of_picture(proportions, quality)
    turned = size_of_picture(1 / proportions, Quality(quality.along, quality.across))
    assert (turned.width, turned.length) == pytest.approx((size.length, size.width))


@given(SHAPES)
@examples(50)
def test_sides_are_whole_centimetres_and_knots_where_both_can_be(proportions: float) -> None:
    for knots in (250.0, 400.0, 500.0):
        size = size_of_picture(proportions, Quality(knots, knots))
        for side in (size.width, size.length):
            assert 100 * side == pytest.approx(round(100 * side), abs=1e-6)
            assert knots * side == pytest.approx(round(knots * side), abs=1e-6)


@given(SHAPES, QUALITIES, st.floats(0.3, 4.0))
@examples(100)
def test_one_side_gives_the_other(proportions: float, quality: Quality, side: float) -> None:
    by_width = size_of_picture(proportions, quality, width=side)
    by_length = size_of_picture(proportions, quality, length=side)
    assert (by_width.width, by_length.length) == (side, side)
    assert max(off(by_width, proportions), off(by_length, proportions)) <= 0.0201


@pytest.mark.parametrize(
    ("width", "height", "size"),
    [
        (1200, 1800, "seccade, 120 × 180 cm"),
        (1800, 1200, "seccade, 180 × 120 cm"),
        (1300, 2000, "seccade-large, 130 × 200 cm"),
        (1500, 2200, "karyola, 150 × 220 cm"),
        (1600, 1200, "168 × 126 cm"),
        (1080, 1920, "108 × 192 cm"),
        (1920, 1200, "186 × 116 cm"),  # 5 : 8 upright is a cushion of 25 × 40 cm, which nobody means
    ],
)
def test_usual_pictures(width: int, height: int, size: str) -> None:
    assert str(size_of_picture(width / height, Quality(250.0, 250.0))) == size


def test_no_carpet_is_a_thread() -> None:
    with pytest.raises(CarpetError, match="would be"):
        size_of_picture(40_000.0, Quality(250.0, 250.0))


def noise(height: int, width: int) -> Rgb:
    return np.random.default_rng(5).integers(0, 256, (height, width, 3), dtype=np.uint8)


@given(st.integers(20, 120), st.integers(20, 120), st.none() | st.floats(0.2, 0.6))
@examples(6)
def test_nothing_is_cut_where_a_side_is_open(height: int, width: int, side: float | None) -> None:
    quality = Quality(50.0, 50.0)
    chart = make_chart(noise(height, width), None, quality, YARNS, fit=FitParams(width=side))
    fit = chart.reading.fit
    assert fit.kind in ("whole", "stretch")
    assert (fit.cropped, fit.padded, fit.shown) == (0.0, 0.0, (0.0, 0.0, 1.0, 1.0))
    assert abs(fit.stretch) <= 0.0201
    assert chart.knots.shape == knot_grid(chart.size, quality)


def poster() -> Rgb:
    """Stripes of three colours in the middle of noise: a photo, whose middle alone would be a drawing."""
    rgb = noise(90, 270)
    rgb[:, 90:180] = np.uint8([[200, 30, 40], [240, 230, 200], [20, 40, 110]])[np.arange(90) // 15 % 3][:, None]
    return rgb


def banner() -> Rgb:
    """A drawing: a disc on stripes."""
    rows, columns = np.mgrid[:120, :240]
    numbers = np.where((rows - 60) ** 2 + (columns - 150) ** 2 < 45**2, 3, columns // 60 % 3)
    return np.uint8([[200, 30, 40], [240, 230, 200], [20, 40, 110], [230, 180, 40]])[numbers]


def sky() -> Rgb:
    """A photo: a slope of light with grain."""
    rows, columns = np.mgrid[:100, :160]
    light = 60 + rows + 0.4 * columns + np.random.default_rng(2).normal(0, 6, rows.shape)
    return np.clip(np.stack([0.5 * light, 0.7 * light, light], axis=-1), 0, 255).astype(np.uint8)


@pytest.mark.parametrize(("picture", "kind"), [(poster, "photo"), (banner, "flat"), (sky, "photo")])
def test_the_reading_does_not_depend_on_the_size(picture: object, kind: str) -> None:
    assert callable(picture)
    rgb, quality = picture(), Quality(40.0, 40.0)
    sizes = [None, CarpetSize(0.3, 0.9), CarpetSize(0.5, 0.5), CarpetSize(0.9, 0.3), CarpetSize(0.2, 0.3)]
    fits = ["auto", "pad", "turn"]
    cases = itertools.product(sizes, fits)
    kinds = {make_chart(rgb, size, quality, YARNS, fit=FitParams(fit=fit)).reading.kind for size, fit in cases}
    assert kinds == {kind}
