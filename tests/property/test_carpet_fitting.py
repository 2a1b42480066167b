"""Fitting keeps centres and proportions, and turns exactly by right angles."""

import math

import numpy as np
import pytest
from effort import examples
from fitted_picture import fit_picture
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.carpet.chart_making import make_chart
from ilmek.carpet.design import distortion
from ilmek.carpet.fitting import Fit, FitParams, border_colour
from ilmek.carpet.projection import inner_rectangle, outer_rectangle
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.errors import ParameterError, PictureError
from ilmek.io.yarn_file import default_yarns
from ilmek.units import deg

SIDES = st.integers(20, 90)
SIZES = st.builds(CarpetSize, st.floats(0.5, 4.0), st.floats(0.5, 4.0))


def noise(height: int, width: int, seed: int = 1) -> np.ndarray:
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3), dtype=np.uint8)


def mirrored(height: int, width: int) -> np.ndarray:
    """Noise that is its own mirror image, left to right and top to bottom."""
    rgb = noise(height, width)
    rgb = np.maximum(rgb, rgb[:, ::-1])
    return np.maximum(rgb, rgb[::-1])


@given(SIDES, SIDES, SIZES, st.sampled_from(["crop", "pad"]))
@examples(60)
def test_crop_and_pad_keep_the_centre_and_give_the_proportions(
    height: int, width: int, size: CarpetSize, fit: str
) -> None:
    made, done = fit_picture(mirrored(height, width), size, FitParams(fit=fit))
    assert np.array_equal(made, made[:, ::-1])
    assert np.array_equal(made, made[::-1])
    assert abs(distortion(made, size)) <= 1.5 / min(made.shape[:2])
    area = made.shape[0] * made.shape[1] / (height * width)
    assert (done.cropped, done.padded) == (
        pytest.approx((1 - area, 0.0)) if fit == "crop" else pytest.approx((0.0, 1 - 1 / area))
    )


@given(SIDES, SIDES, SIZES)
@examples(60)
def test_auto_stretches_up_to_two_per_cent_and_crops_the_rest(height: int, width: int, size: CarpetSize) -> None:
    rgb = noise(height, width)
    made, done = fit_picture(rgb, size)
    if abs(distortion(rgb, size)) <= 0.02:
        assert made is rgb
        assert done.kind in ("stretch", "whole")
        assert done.stretch == distortion(rgb, size)
    else:
        assert done.kind == ("crop" if made.shape != rgb.shape else "stretch")
        assert min(height - made.shape[0], width - made.shape[1]) == 0


@given(SIDES, SIDES, st.integers(-4, 4))
@settings(max_examples=30, deadline=None)
def test_right_angles_turn_exactly(height: int, width: int, quarters: int) -> None:
    rgb = noise(height, width)
    size = CarpetSize(1.0, 1.0)
    once = FitParams(fit="stretch", turn=quarters * 90 * deg)
    made, done = fit_picture(rgb, size, once)
    assert np.array_equal(made, np.rot90(rgb, -quarters))
    assert done.turned == pytest.approx((quarters % 4) * math.pi / 2)
    for _ in range(3):
        made, _ = fit_picture(made, size, once)
    assert np.array_equal(made, rgb)


def test_a_quarter_is_clockwise() -> None:
    rgb = noise(30, 20)
    made, _ = fit_picture(rgb, CarpetSize(1.0, 1.0), FitParams(fit="stretch", turn=90 * deg))
    assert np.array_equal(made[0, -1], rgb[0, 0])


def test_fit_turn_turns_only_what_suits_better() -> None:
    lying, standing = noise(40, 60), noise(60, 40)
    size = CarpetSize(1.0, 1.5)
    made, done = fit_picture(lying, size, FitParams(fit="turn"))
    assert np.array_equal(made, np.rot90(lying, -1))
    assert (done.kind, done.cropped, done.turned) == ("whole", 0.0, math.pi / 2)
    made, done = fit_picture(standing, size, FitParams(fit="turn"))
    assert made is standing
    assert done.turned == 0.0


def test_a_picture_with_the_grid_of_the_knots_is_left_as_it_is() -> None:
    rgb = noise(90, 30)
    for fit in ("auto", "crop", "pad", "stretch", "turn"):
        made, done = fit_picture(rgb, CarpetSize(1.2, 1.8), FitParams(fit=fit), grid=(90, 30))
        assert made is rgb
        assert (done.kind, done.stretch, done.cropped) == ("whole", 0.0, 0.0)


@given(st.floats(1.0, 89.0), st.integers(40, 120), st.integers(40, 120))
@examples(80)
def test_the_inner_rectangle_lies_in_the_turned_picture_and_no_larger_one_of_its_shape_does(
    angle: float, width: int, height: int
) -> None:
    high, wide = inner_rectangle(width, height, angle * deg)
    c, s = math.cos(angle * deg), math.sin(angle * deg)

    def fits(scale: float) -> bool:
        u, v = scale * wide / 2, scale * high / 2
        across, along = u * c + v * s, u * s + v * c
        return across <= width / 2 + 1e-6 and along <= height / 2 + 1e-6

    assert fits(1.0)
    assert not fits(1 + 2.5 / min(wide, high))


@pytest.mark.parametrize("angle", [3.0, -17.0, 45.0, 120.0])
def test_turning_resamples_about_the_centre(angle: float) -> None:
    """A smooth picture, turned, has the value of the point that lands there."""
    height, width = 90, 120
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    rgb = np.stack([x * 2, y * 2, x + y], axis=-1).astype(np.uint8)
    made, done = fit_picture(rgb, CarpetSize(1.0, 1.0), FitParams(fit="stretch", turn=angle * deg))
    assert made.shape[:2] == inner_rectangle(width, height, angle * deg)
    u = np.arange(made.shape[1]) + 0.5 - made.shape[1] / 2
    v = np.arange(made.shape[0])[:, None] + 0.5 - made.shape[0] / 2
    c, s = math.cos(angle * deg), math.sin(angle * deg)
    back = np.stack([2 * (width / 2 + c * u + s * v), 2 * (height / 2 - s * u + c * v)], axis=-1)
    assert np.abs(made[..., :2] - back).max() < 2.5
    assert 0 < done.cropped < 0.9


def test_pad_keeps_the_corners_of_a_turned_picture() -> None:
    rgb = np.full((60, 80, 3), 200, dtype=np.uint8)
    made, done = fit_picture(rgb, CarpetSize(1.0, 1.0), FitParams(fit="pad", turn=30 * deg, ground="#102030"))
    assert made.shape[0] == made.shape[1] >= max(outer_rectangle(80, 60, 30 * deg))
    assert made[0, 0].tolist() == [16, 32, 48]
    shown = np.count_nonzero(made[..., 0] > 150)
    assert shown == pytest.approx(60 * 80, rel=0.03)
    assert done.padded == pytest.approx(1 - 60 * 80 / (made.shape[0] * made.shape[1]))
    assert done.border == "#102030"


def test_the_border_takes_the_colour_of_the_picture_or_white() -> None:
    rgb = noise(40, 60)
    assert border_colour(rgb) == (255, 255, 255)
    rgb[:2] = rgb[-2:] = (180, 20, 30)
    rgb[:, :2] = rgb[:, -2:] = (180, 20, 30)
    rgb[0, ::9] = 0
    assert border_colour(rgb) == (180, 20, 30)
    assert fit_picture(rgb, CarpetSize(1.0, 1.0), FitParams(fit="pad"))[1].border == "#b4141e"


@pytest.mark.parametrize(
    ("text", "part"),
    [("10,5 40,25", (5, 25, 10, 40)), ("40,25 10,5", (5, 25, 10, 40)), ("10%,50% 60,100%", (20, 40, 6, 60))],
)
def test_crop_takes_two_opposite_corners(text: str, part: tuple[int, int, int, int]) -> None:
    rgb = noise(40, 60)
    made, done = fit_picture(rgb, CarpetSize(1.0, 1.0), FitParams(fit="stretch", crop=text))
    top, bottom, left, right = part
    assert np.array_equal(made, rgb[top:bottom, left:right])
    assert done.cropped == pytest.approx(1 - made.shape[0] * made.shape[1] / 2400)


@pytest.mark.parametrize(
    ("text", "message"), [("0,0 61,40", "reaches outside"), ("5,5 5.2,30", "no pixel"), ("-1,0 10,10", "outside")]
)
def test_a_part_that_is_not_there_is_refused(text: str, message: str) -> None:
    with pytest.raises(PictureError, match=message):
        fit_picture(noise(40, 60), CarpetSize(1.0, 1.0), FitParams(crop=text))


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"crop": "10,10"}, "1 point; 2 points"),
        ({"crop": "ten,ten"}, "no list of points"),
        ({"crop": "1,2 3,4 5,6"}, "3 points"),
        ({"crop": "1,2 " * 200}, "too long"),
        ({"ground": "reddish"}, "no colour"),
    ],
)
def test_texts_that_are_no_points_or_colours_are_refused(wrong: dict[str, str], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        FitParams(**wrong)


def test_a_border_has_bounded_size(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ilmek.carpet.fitting.MOST_PADDED", 4000)
    with pytest.raises(PictureError, match="with its border"):
        fit_picture(noise(20, 80), CarpetSize(1.0, 1.5), FitParams(fit="pad"))


def test_the_fit_is_told_in_words() -> None:
    assert Fit().words == "whole picture"
    done = Fit("crop", -0.013, 0.25, turned=90 * deg)
    assert done.words == "turned by 90 deg, cropped, 25% of the picture is not shown, drawn 1.3% narrower"


def test_an_even_border_makes_no_drawing_of_a_photo() -> None:
    """Noise alone is a photo; with a white border around it, it stays one."""
    rgb = noise(60, 60)
    size, quality = CarpetSize(0.5, 1.0), Quality(100.0, 100.0)
    yarns = default_yarns()
    for fit in ("crop", "pad"):
        assert make_chart(rgb, size, quality, yarns, fit=FitParams(fit=fit)).reading.kind == "photo"
