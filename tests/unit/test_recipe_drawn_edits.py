"""Edits that are drawn by hand: strokes of a brush, and parts that are copied and moved."""

from itertools import pairwise

import numpy as np
import pytest
from PIL import Image
from scipy import ndimage

from ilmek.arrays import Indices
from ilmek.carpet.recipe.copies import WIDEST_BRUSH, brush_spans
from ilmek.carpet.recipe.edits import apply_edit, line_knots, parse_edit
from ilmek.errors import CarpetError


def _knots(rows: int = 6, columns: int = 7) -> Indices:
    return np.arange(rows * columns, dtype=np.uint8).reshape(rows, columns)


def _edited(text: str, yarn: int = 99, knots: Indices | None = None) -> Indices:
    edited = _knots() if knots is None else knots.copy()
    apply_edit(edited, parse_edit(text), (yarn,))
    return edited


@pytest.mark.parametrize("width", [1, 2, 3, 5, 9, 24, WIDEST_BRUSH])
def test_a_brush_is_a_disc(width: int) -> None:
    middle, side = (width - 1) / 2, width + 4
    down, across = np.mgrid[:side, :side] - 2 - middle
    disc = down**2 + across**2 <= (width / 2) ** 2
    blank = np.zeros((side, side), dtype=np.uint8)
    row, column = side - 2 - (width - 1) // 2, 3 + (width - 1) // 2
    assert np.array_equal(_edited(f"stroke {width} {row},{column} ivory", 1, blank) == 1, disc)
    assert sum(right - left for _, (left, right) in brush_spans(width)) == disc.sum()


def test_a_stroke_is_its_lines_widened_by_the_brush() -> None:
    blank = np.zeros((40, 50), dtype=np.uint8)
    points = [(5, 6), (30, 20), (30, 44), (2, 40)]
    text = " ".join(f"{row},{column}" for row, column in points)
    thin = blank.copy()
    for (row, column), (to, at) in pairwise(points):
        thin[line_knots((40 - row, column - 1), (40 - to, at - 1))] = 1
    assert np.array_equal(_edited(f"stroke 1 {text} ivory", 1, blank), thin)
    disc = np.ones((5, 5), dtype=bool)
    disc[::4, ::4] = False
    wide = _edited(f"stroke 5 {text} ivory", 1, blank)
    assert np.array_equal(wide == 1, ndimage.binary_dilation(thin, disc))
    assert np.array_equal(np.flip(wide, 1), _edited(_reflected(text, 50), 1, blank))


def _reflected(text: str, columns: int) -> str:
    points = [tuple(map(int, point.split(","))) for point in text.split()]
    return f"stroke 5 {' '.join(f'{row},{columns + 1 - column}' for row, column in points)} ivory"


def test_a_stroke_beyond_the_edge_is_cut() -> None:
    assert np.count_nonzero(_edited("stroke 5 1,1 ivory") == 99) == 8
    assert np.count_nonzero(_edited("stroke 99 3,3 ivory") == 99) == 42


@pytest.mark.parametrize("mirrored", ["", " mirrored across", " mirrored along"])
@pytest.mark.parametrize("turned", ["", " turned 90deg", " turned 180deg", " turned 270deg"])
def test_a_copy_is_the_picture_of_its_part(turned: str, mirrored: str) -> None:
    before = _knots(9, 12)
    made = _edited(f"copy 1,2 3,3 to 5,6{turned}{mirrored}", knots=before)
    picture = Image.fromarray(before[-3:, 1:3])
    if mirrored:
        flip = Image.Transpose.FLIP_LEFT_RIGHT if "across" in mirrored else Image.Transpose.FLIP_TOP_BOTTOM
        picture = picture.transpose(flip)
    picture = picture.rotate(-int(turned[8:-3] or 0), expand=True)
    wide, high = picture.size
    assert np.array_equal(made[9 - 4 - high : 9 - 4, 5 : 5 + wide], np.asarray(picture))
    made[9 - 4 - high : 9 - 4, 5 : 5 + wide] = before[9 - 4 - high : 9 - 4, 5 : 5 + wide]
    assert np.array_equal(made, before)


def test_a_move_leaves_its_yarn_and_a_copy_is_cut_at_the_edge() -> None:
    before = _knots()
    made = _edited("move 1,1 2,2 to 2,2 ivory")
    assert np.array_equal(made[3:5, 1:3], before[4:, :2])
    assert made[5].tolist() == [99, 99, *before[5, 2:]]
    assert made[4, 0] == 99
    cut = _edited("copy 1,1 3,3 to 5,6")
    assert np.array_equal(cut[:2, 5:], before[4:, :2])
    assert np.count_nonzero(cut != before) == 4


@pytest.mark.parametrize(
    "text",
    ["stroke 3 ivory", "stroke 1,1 ivory", "stroke 0 1,1 ivory", "stroke 100 1,1 ivory", "stroke 3 1,1",
     "copy 1,1 2,2", "copy 1,1 2,2 to", "copy 1,1 to 3,3", "copy 1,1 2,2 to 3,3 ivory",
     "copy 1,1 2,2 to 3,3 turned 45deg", "copy 1,1 2,2 to 3,3 mirrored both", "move 1,1 2,2 to 3,3",
     "copy 1,1 2,2 ivory to 3,3", "move 1,1 2,2 to 3,3 turned 90deg"],
)  # fmt: skip
def test_a_broken_edit_is_refused_with_its_form(text: str) -> None:
    with pytest.raises(CarpetError) as refused:
        parse_edit(text)
    assert f"write {text.partition(' ')[0]} " in refused.value.do


def test_a_yarn_may_begin_like_a_turn() -> None:
    edit = parse_edit("move 1,1 2,2 to 3,3 turned 270deg  mirrored along  dark red")
    assert (edit.yarns, edit.turned, edit.direction) == ("dark red", 3, "along")
    assert parse_edit("move 1,1 2,2 to 3,3 mirrored blue").yarns == "mirrored blue"
