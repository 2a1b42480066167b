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
from ilmek.viz.carpet_picture import carpet_picture, close_up, pile_part, write_carpet_png

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
    image = opened(carpet_picture(made, longest=700))
    assert max(image.size) <= 700
    assert max(image.size) >= 500
    width, height = image.size
    upper = mean(image, (width // 4, height // 3, 3 * width // 4, height // 3 + 30))
    lower = mean(image, (width // 4, 2 * height // 3 - 30, 3 * width // 4, 2 * height // 3))
    assert upper == pytest.approx(RED, abs=22)
    assert lower == pytest.approx(BLUE, abs=22)


def test_keeps_the_proportions_of_the_carpet() -> None:
    """Rows twice as high as knots are wide: a piece of 120 x 90 knots is 24 x 36 cm, with fringes 13.4 cm longer."""
    width, height = opened(carpet_picture(chart(90, 120, 500.0, 250.0))).size
    assert height / width == pytest.approx((0.36 + 2 * (0.055 + 0.012)) / (0.24 + 2 * 0.008), rel=0.01)


def test_close_up_draws_knots_in_proportion() -> None:
    assert opened(close_up(chart(90, 120, 500.0, 250.0))).size == (960, 30 * 48)
    assert opened(close_up(chart(10, 12, 250.0, 250.0))).size == (12 * 24, 10 * 24)


def test_a_seed_gives_one_picture() -> None:
    made = chart(60, 40, 250.0, 250.0)
    assert carpet_picture(made, 400) == carpet_picture(made, 400)
    assert carpet_picture(made, 400) != carpet_picture(made, 400, seed=2)


def test_the_smallest_carpet_is_one_too() -> None:
    assert max(opened(carpet_picture(chart(3, 2, 20.0, 20.0), 300)).size) <= 300


@pytest.mark.parametrize("width", [None, 100, 333])
def test_the_file_has_the_width_and_shows_the_yarns_in_the_pile(tmp_path: Path, width: int | None) -> None:
    made = chart(90, 60, 250.0, 250.0)
    write_carpet_png(tmp_path / "carpet.png", made, width)
    image = opened((tmp_path / "carpet.png").read_bytes())
    if width is None:
        assert 1395 <= max(image.size) <= 1400
    else:
        assert abs(image.width - width) <= 3
    pile = pile_part(made)
    left, top = pile.left * image.width, pile.top * image.height
    right, bottom = left + pile.width * image.width, top + pile.height * image.height
    inside = mean(image, (int(left) + 9, int(top) + 9, int(right) - 9, int((top + bottom) / 2) - 9))
    assert inside == pytest.approx(RED, abs=22)


def test_a_width_out_of_bounds_is_refused(tmp_path: Path) -> None:
    made = chart(90, 60, 250.0, 250.0)
    for width in (99, 20_001):
        with pytest.raises(CarpetError, match="--carpet-width"):
            write_carpet_png(tmp_path / "carpet.png", made, width)
    runner = chart(3000, 60, 250.0, 250.0)
    with pytest.raises(CarpetError, match=r"100 to [\d,]+ pixels"):
        write_carpet_png(tmp_path / "carpet.png", runner, 5000)
    assert list(tmp_path.iterdir()) == []


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


def test_a_given_width_is_kept(tmp_path: Path) -> None:
    for width in (301, 1999):
        write_carpet_png(tmp_path / "carpet.png", chart(90, 60, 250.0, 250.0), width)
        with Image.open(tmp_path / "carpet.png") as picture:
            assert picture.width == width
