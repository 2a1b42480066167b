"""The simulated carpet: right colours, right proportions, the same each time."""

import io
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from ilmek.carpet.chart import Chart
from ilmek.carpet.overlay import HALF, JUFTI, KnotMark, overlay_of
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.errors import CarpetError
from ilmek.viz.carpet_picture import LONGEST, close_up, draw_carpet

RED, BLUE = (150, 30, 40), (20, 40, 110)


def chart(rows: int, columns: int, across: float, along: float) -> Chart:
    """Red above, blue below, in the size that the densities give."""
    knots = np.zeros((rows, columns), dtype=np.uint8)
    knots[rows // 2 :] = 1
    yarns = tuple(Yarn(name, srgb, (0.0, 0.0, 0.0), 4.0, 2) for name, srgb in (("red", RED), ("blue", BLUE)))
    return Chart(knots, yarns, CarpetSize(columns / across, rows / along), Quality(across, along), "symmetric")


def opened(picture: bytes) -> Image.Image:
    image = Image.open(io.BytesIO(picture))
    image.load()
    return image


def mean(image: Image.Image, box: tuple[int, int, int, int]) -> list[float]:
    return np.asarray(image.crop(box), dtype=float).mean(axis=(0, 1)).tolist()


@pytest.mark.parametrize(
    ("rows", "columns", "across", "along"),
    [(150, 100, 250.0, 250.0), (60, 40, 250.0, 250.0), (1800, 1600, 1800.0, 1800.0), (90, 120, 500.0, 250.0)],
    ids=["tufts", "few", "more-knots-than-pixels", "not-square"],
)
def test_shows_the_yarns_where_they_lie(rows: int, columns: int, across: float, along: float) -> None:
    made = chart(rows, columns, across, along)
    image = draw_carpet(made, longest=700).image
    assert max(image.size) <= 700
    assert max(image.size) >= 500
    width, height = image.size
    upper = mean(image, (width // 4, height // 3, 3 * width // 4, height // 3 + 30))
    lower = mean(image, (width // 4, 2 * height // 3 - 30, 3 * width // 4, 2 * height // 3))
    assert upper == pytest.approx(RED, abs=22)
    assert lower == pytest.approx(BLUE, abs=22)


def test_keeps_the_proportions_of_the_carpet() -> None:
    """Rows twice as high as knots are wide: a piece of 120 x 90 knots is 24 x 36 cm, with fringes 13.4 cm longer."""
    width, height = draw_carpet(chart(90, 120, 500.0, 250.0)).image.size
    assert height / width == pytest.approx((0.36 + 2 * (0.055 + 0.012)) / (0.24 + 2 * 0.008), rel=0.01)


def test_close_up_draws_knots_in_proportion() -> None:
    assert opened(close_up(chart(90, 120, 500.0, 250.0))).size == (960, 30 * 48)
    assert opened(close_up(chart(10, 12, 250.0, 250.0))).size == (12 * 24, 10 * 24)


def test_a_seed_gives_one_picture() -> None:
    made = chart(60, 40, 250.0, 250.0)
    assert draw_carpet(made, longest=400).jpeg == draw_carpet(made, longest=400).jpeg
    assert draw_carpet(made, longest=400).jpeg != draw_carpet(made, longest=400, seed=2).jpeg


def test_the_smallest_carpet_is_one_too() -> None:
    assert max(draw_carpet(chart(3, 2, 20.0, 20.0), longest=300).image.size) <= 300


@pytest.mark.parametrize("width", [None, 100, 333])
def test_the_file_has_the_width_and_shows_the_yarns_in_the_pile(tmp_path: Path, width: int | None) -> None:
    made = chart(90, 60, 250.0, 250.0)
    drawn = draw_carpet(made, width)
    drawn.write_png(tmp_path / "carpet.png")
    image = opened((tmp_path / "carpet.png").read_bytes())
    if width is None:
        assert 1395 <= max(image.size) <= 1400
    else:
        assert abs(image.width - width) <= 3
    pile = drawn.pile
    left, top = pile.left * image.width, pile.top * image.height
    right, bottom = left + pile.width * image.width, top + pile.height * image.height
    inside = mean(image, (int(left) + 9, int(top) + 9, int(right) - 9, int((top + bottom) / 2) - 9))
    assert inside == pytest.approx(RED, abs=22)


def test_a_width_out_of_bounds_is_refused() -> None:
    made = chart(90, 60, 250.0, 250.0)
    for width in (99, 20_001):
        with pytest.raises(CarpetError, match="--carpet-width"):
            draw_carpet(made, width)
    runner = chart(3000, 60, 250.0, 250.0)
    with pytest.raises(CarpetError, match=r"100 to [\d,]+ pixels"):
        draw_carpet(runner, 5000)


def test_half_knots_and_jufti_knots_are_tufts_of_their_own() -> None:
    """The right half of a red cell is blue, its left half red; a jufti knot joins the tufts of two cells."""
    plain = chart(10, 10, 250.0, 250.0)
    half = replace(plain, overlay=overlay_of([KnotMark(2, 4, HALF, second=1)]))
    cell = np.asarray(opened(close_up(half)).convert("RGB"))[56:64, 96:120].astype(int)
    left, right = cell[:, 3:9].mean(axis=(0, 1)), cell[:, 15:21].mean(axis=(0, 1))
    assert left[0] > 2 * left[2]
    assert right[2] > 2 * right[0]
    jufti = replace(plain, overlay=overlay_of([KnotMark(2, 4, JUFTI)]))
    changed = np.any(np.asarray(opened(close_up(jufti))) != np.asarray(opened(close_up(plain))), axis=2)
    rows, columns = np.nonzero(changed)
    assert 24 <= rows.min() <= rows.max() < 5 * 24
    assert 2 * 24 <= columns.min() <= columns.max() < 8 * 24


def test_a_given_width_is_kept() -> None:
    for width in (301, 1999):
        assert draw_carpet(chart(90, 60, 250.0, 250.0), width).image.width == width


def test_a_page_takes_the_picture_of_the_file_reduced_to_its_size() -> None:
    """A picture that is too small for a page is not taken: the page draws its own."""
    made = chart(90, 60, 250.0, 250.0)
    large = draw_carpet(made, 1999).of_page()
    assert large is not None
    assert max(large.image.size) == LONGEST
    assert large.image.width / large.image.height == pytest.approx(0.256 / 0.494, rel=0.02)
    whole = draw_carpet(made)
    assert whole.of_page() is whole
    assert draw_carpet(made, 301).of_page() is None
