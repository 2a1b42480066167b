"""A carpet photographed at an angle comes back straight, and its outline is found where it is clear."""

import math
import re
from collections.abc import Callable
from pathlib import Path

import effort
import numpy as np
import photographs
import pytest
from carpet_photographs import WOODS, kilim, medallion, random_photograph
from effort import examples
from fitted_picture import fit_picture
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from ilmek.arrays import Rgb
from ilmek.carpet.design import resampled
from ilmek.carpet.fitting import FitParams
from ilmek.carpet.outline import find_outline
from ilmek.carpet.projection import onto_corners
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.straightening import true_proportions
from ilmek.errors import ParameterError, PictureError

SIZE = CarpetSize(1.0, 1.5)
ACROSS, ALONG, SQUARE = 20, 30, 10
"""Squares of the checkerboard, and knots along the side of a square: 200 × 300 knots."""

SHIFTS = st.tuples(*[st.floats(-90, 90)] * 8)
IN_PHOTO = Path(__file__).parents[1] / "data" / "carpet-in-photo.jpg"
UPRIGHT = np.array([(250.0, 120.0), (650.0, 120.0), (650.0, 780.0), (250.0, 780.0)])


def moved(shifts: tuple[float, ...]) -> np.ndarray:
    return UPRIGHT + np.array(shifts).reshape(4, 2)


def wrong_knots(rgb: Rgb, off: int) -> int:
    """Knots that are not those of the checkerboard, of all that are `off` knots from the sides of a square."""
    design = resampled(rgb, ALONG * SQUARE, ACROSS * SQUARE)
    truth = photographs.checkerboard(ACROSS, ALONG, SQUARE)
    x, y = np.arange(ACROSS * SQUARE) % SQUARE, np.arange(ALONG * SQUARE)[:, None] % SQUARE
    inner = (np.minimum(x, SQUARE - 1 - x) >= off) & (np.minimum(y, SQUARE - 1 - y) >= off)
    return int(np.count_nonzero(inner & ((design[..., 2] > design[..., 0]) != (truth[..., 2] > truth[..., 0]))))


def text(quad: np.ndarray) -> str:
    return " ".join(f"{x:.3f},{y:.3f}" for x, y in quad)


@given(SHIFTS)
@settings(max_examples=12, deadline=None)
def test_a_photographed_checkerboard_is_straight_to_a_knot(shifts: tuple[float, ...]) -> None:
    quad = moved(shifts)
    board = Image.fromarray(photographs.checkerboard(ACROSS, ALONG, 24))
    photo = np.asarray(photographs.projected_by_pillow(board, quad.tolist(), (900, 900)))
    made, done = fit_picture(photo, SIZE, FitParams(fit="stretch", corners=text(quad)))
    assert np.abs(np.array(done.corners) - quad).max() < 1e-3
    assert wrong_knots(made, 1) == 0


@given(SHIFTS, st.floats(1, 500), st.floats(1, 500))
@examples(50)
def test_the_homography_takes_corners_to_corners_and_lines_to_lines(
    shifts: tuple[float, ...], width: float, height: float
) -> None:
    quad, m = moved(shifts), onto_corners(width, height, moved(shifts))
    for (u, v), corner in zip([(0, 0), (width, 0), (width, height), (0, height)], quad, strict=True):
        x, y, z = m @ (u, v, 1.0)
        assert (x / z, y / z) == pytest.approx(tuple(corner), abs=1e-7)
    back = photographs.perspective(quad.tolist(), width, height)
    x, y, z = m @ (0.3 * width, 0.8 * height, 1.0)
    q = back[6] * x / z + back[7] * y / z + 1
    found = ((back[0] * x + back[1] * y) / z + back[2]) / q, ((back[3] * x + back[4] * y) / z + back[5]) / q
    assert found == pytest.approx((0.3 * width, 0.8 * height), rel=1e-7)


@given(st.floats(-0.6, 0.6), st.floats(-0.6, 0.6), st.floats(-0.5, 0.5), st.floats(0.6, 1.5), st.floats(0.4, 2.5))
@examples(100)
def test_the_corners_give_the_true_proportions(
    yaw: float, pitch: float, roll: float, focal: float, proportions: float
) -> None:
    """A camera turned about three axes; where two sides are parallel in the picture the usual lens is taken."""
    if min(abs(yaw), abs(pitch)) < 0.02:
        focal = 0.8
    c, s = math.cos, math.sin
    about_x = np.array([[1, 0, 0], [0, c(pitch), -s(pitch)], [0, s(pitch), c(pitch)]])
    about_y = np.array([[c(yaw), 0, s(yaw)], [0, 1, 0], [-s(yaw), 0, c(yaw)]])
    about_z = np.array([[c(roll), -s(roll), 0], [s(roll), c(roll), 0], [0, 0, 1]])
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * (proportions / 2, 0.5)
    seen = np.column_stack([corners, np.zeros(4)]) @ (about_x @ about_y @ about_z).T + (0, 0, 4)
    picture = 1600 * focal * seen[:, :2] / seen[:, 2:] + (800, 600)
    assert true_proportions(picture, 1600, 1200) == pytest.approx(proportions, rel=0.03)


QUADS = {
    "upright": [(330, 130), (860, 130), (860, 800), (330, 800)],
    "from below": [(420, 130), (800, 130), (960, 800), (250, 800)],
    "turned": [(520, 70), (960, 240), (720, 850), (280, 640)],
    "aslant": [(315, 135), (862, 180), (975, 787), (225, 735)],
}


FLOORS = {
    "upright": ((95, 95, 100), 25.0),
    "from below": ((89, 102, 213), 8.0),
    "turned": ((64, 100, 64), 25.0),
    "aslant": ((150, 120, 90), 12.0),
}
"""Colours and grain; the fringe stands out from the blue and the green floor as much as the carpet does."""


def carpet() -> Rgb:
    """A carpet with three frames and a checkerboard of its field's colours, also one near the floor's."""
    rgb = np.empty((720, 480, 3), dtype=np.uint8)
    for inset, colour in ((0, (150, 30, 35)), (12, (30, 40, 90)), (36, (200, 180, 140)), (48, (150, 120, 95))):
        rgb[inset : 720 - inset, inset : 480 - inset] = colour
    rgb[60:-60, 60:-60] = photographs.checkerboard(18, 30, 20)
    return rgb


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize("name", QUADS)
def test_the_outline_on_a_floor_is_found(name: str) -> None:
    """To half a pixel; two knots are four."""
    floor, noise = FLOORS[name]
    photo = photographs.photograph(carpet(), QUADS[name], floor=floor, noise=noise)
    found, clearness = find_outline(photo)
    assert np.abs(found - np.array(QUADS[name])).max() < 0.5
    assert clearness > 0.75


TAKEN = [(11, "light", "none"), (9, "mid", "dense"), (22, "dark", "sparse")]


def off(corners: np.ndarray, truth: np.ndarray) -> float:
    """Largest distance of two outlines' corners, whichever corner is the first [pixels]."""
    return min(float(np.hypot(*(np.roll(corners, k, axis=0) - truth).T).max()) for k in range(4))


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize(("seed", "wood", "fringe"), TAKEN)
def test_the_outline_in_shadow_and_vignetting_is_found(seed: int, wood: str, fringe: str) -> None:
    taken = random_photograph(seed, (750, 1000), wood=wood, fringe=fringe)
    corners, _ = find_outline(taken.rgb)
    assert off(corners, taken.corners) < 1.0


@pytest.mark.skipif(effort.SEED is None, reason="random photographs of 1,600 pixels: make campaigns")
def test_the_outlines_of_random_photographs_are_found_or_refused() -> None:
    """None is wrong, by 6 pixels of 1,600; one in twenty may be refused."""
    refused, seeds = 0, effort.seeds(1, 60)
    for seed in seeds:
        taken = random_photograph(seed)
        try:
            corners, _ = find_outline(taken.rgb)
        except PictureError:
            refused += 1
            continue
        assert off(corners, taken.corners) < 6.0, seed
    assert refused <= len(seeds) / 20


def test_the_outline_in_a_small_cropped_photograph_is_found() -> None:
    with Image.open(IN_PHOTO) as photo:
        corners, clearness = find_outline(np.asarray(photo))
    assert off(corners, np.array([(306.3, 15.1), (579.9, 34.5), (610.5, 409.1), (146.7, 352.1)])) < 1.0
    assert clearness > 0.9


IN_QUADS = [
    [(612.2, 30.2), (1158.6, 69.0), (1220.0, 818.1), (293.2, 704.1)],
    [(180.0, 90.0), (900.0, 60.0), (1010.0, 640.0), (90.0, 690.0)],
    [(420.0, 60.0), (830.0, 50.0), (930.0, 780.0), (380.0, 800.0)],
]


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize("quad", IN_QUADS)
def test_a_frame_of_few_pixels_beside_a_light_stripe_belongs_to_the_carpet(quad: photographs.Quad) -> None:
    photo = photographs.photograph(medallion(600), quad, (848, 1259), floor=(190, 165, 130), noise=4.0, fringe=0)
    corners, _ = find_outline(photo)
    assert off(corners, np.array(quad)) < 1.5


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize(("seed", "wood", "fringe"), [(1, "mid", "none"), (3, "dark", "none"), (9, "mid", "dense")])
def test_the_stripes_at_the_ends_of_a_kilim_are_no_fringe(seed: int, wood: str, fringe: str) -> None:
    """A cream stripe is as light as threads; a fringe beside it is none of the kilim."""
    taken = random_photograph(seed, (750, 1000), kilim, wood=wood, fringe=fringe)
    corners, _ = find_outline(taken.rgb)
    assert off(corners, taken.corners) < 1.0


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize("seed", [102, 524])
def test_a_dark_frame_on_a_black_floor_is_found_or_refused(seed: int) -> None:
    taken = random_photograph(seed, (600, 800), wood="black", fringe="none")
    try:
        corners, _ = find_outline(taken.rgb)
    except PictureError:
        return
    assert off(corners, taken.corners) < 2.0


def divided(width: int) -> Rgb:
    """A red carpet with light ends, and across it a stripe in the colour of a floor of mid wood."""
    rgb = np.full((width * 3 // 2, width, 3), (150, 32, 38), dtype=np.uint8)
    rgb[: width // 8] = rgb[-(width // 8) :] = (225, 210, 170)
    rgb[int(0.45 * width) : int(0.84 * width)] = WOODS["mid"]
    return rgb


def framed_in_black(width: int) -> Rgb:
    """The medallion in a frame that is nearly as dark as a black floor."""
    rgb, frame = medallion(width).copy(), width // 24
    for side in (np.s_[:frame], np.s_[-frame:], np.s_[:, :frame], np.s_[:, -frame:]):
        rgb[side] = np.array(WOODS["black"]) + 4
    return rgb


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize(
    ("carpet", "seed", "wood"),
    [
        (divided, 1, {"wood": "mid"}),
        (divided, 2, {"wood": "mid"}),
        (framed_in_black, 6, {"wood": "black", "fringe": "dense"}),
    ],
)
def test_a_carpet_with_the_colour_of_the_floor_in_it_is_found_or_refused(
    carpet: Callable[[int], Rgb], seed: int, wood: dict[str, str]
) -> None:
    """Of the divided carpet half was taken, of the frame one side left out, by 524 and 23 pixels."""
    taken = random_photograph(seed, (900, 1200), carpet, **wood)
    try:
        corners, _ = find_outline(taken.rgb)
    except PictureError:
        return
    assert off(corners, taken.corners) < 2.0


def test_a_refusal_shows_the_corners_so_that_they_can_be_pasted() -> None:
    photo = photographs.photograph(carpet(), QUADS["aslant"], floor=(165, 55, 50))
    with pytest.raises(PictureError) as refused:
        find_outline(photo)
    pasted = re.search('--corners "(.+)"', str(refused.value))
    assert pasted is not None
    _, done = fit_picture(photo, SIZE, FitParams(fit="stretch", corners=pasted[1]))
    assert np.array(done.corners).shape == (4, 2)


def test_auto_is_straight_to_two_knots() -> None:
    photo = photographs.photograph(carpet(), QUADS["aslant"])
    made, done = fit_picture(photo, SIZE, FitParams(corners="auto", fit="stretch"))
    assert done.clearness is not None
    field = resampled(made, 300, 200)
    rows, columns = np.arange(300)[:, None], np.arange(200)
    inset = np.minimum(np.minimum(rows, 299 - rows), np.minimum(columns, 199 - columns))
    blue = np.abs(field.astype(int) - (30, 40, 90)).max(axis=-1) < 25
    assert blue[(inset >= 7) & (inset < 13)].mean() > 0.99
    assert not blue[inset < 3].any()


def cut() -> Rgb:
    return photographs.photograph(carpet(), [(-60, 180), (750, 200), (850, 780), (-100, 740)])


UNCLEAR = {
    "noise": lambda: np.random.default_rng(1).integers(0, 256, (300, 400, 3), dtype=np.uint8),
    "one colour": lambda: np.full((300, 400, 3), 120, dtype=np.uint8),
    "a carpet that is not whole": cut,
    "a floor of the carpet's colour": lambda: photographs.photograph(carpet(), QUADS["aslant"], floor=(165, 55, 50)),
    "a round carpet": lambda: np.where(
        np.hypot(np.arange(400) - 200, np.arange(300)[:, None] - 150)[..., None] < 100, 40, 200
    ).astype(np.uint8).repeat(3, axis=2),
    "a small thing": lambda: np.where(
        (abs(np.arange(400) - 200) < 20) & (abs(np.arange(300)[:, None] - 150) < 20), 40, 200
    )[..., None].astype(np.uint8).repeat(3, axis=2),
}  # fmt: skip


@pytest.mark.matrix(light=3)
@pytest.mark.parametrize("name", UNCLEAR)
def test_an_outline_that_is_not_clear_is_refused(name: str) -> None:
    with pytest.raises(PictureError, match="outline of the carpet is not clear.*give (the corners|them): --corners"):
        find_outline(UNCLEAR[name]())


@pytest.mark.parametrize(
    ("corners", "message"),
    [
        ("0,0 100,0 100,100 101,50", "cross, or a corner points inwards"),
        ("0,0 100,100 100,0 0,100", "cross"),
        ("0,0 0,100 100,100 100,0", "anticlockwise"),
        ("0,0 50,50 100,100 0,100", "lie on one line"),
        ("0,0 0,0 100,100 0,100", "are one point"),
        ("0,0 100,0 100,300 0,100", "reaches outside"),
        ("-1,0 100,0 100,100 0,100", "reaches outside"),
    ],
)
def test_corners_of_no_carpet_are_refused(corners: str, message: str) -> None:
    with pytest.raises(PictureError, match=message):
        fit_picture(np.zeros((120, 120, 3), np.uint8), SIZE, FitParams(corners=corners))


@pytest.mark.parametrize(("corners", "message"), [("1,1 2,2 3,3", "3 points; 4 points"), ("automatic", "no list")])
def test_texts_that_are_no_four_corners_are_refused(corners: str, message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        FitParams(corners=corners)
