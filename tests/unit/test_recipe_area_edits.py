"""Edits of whole areas: mirror, repeat and border, of the carpet and of a part."""

import numpy as np
import pytest

from ilmek.arrays import Indices
from ilmek.carpet.recipe.edits import apply_edit, parse_edit
from ilmek.errors import CarpetError


def _knots(rows: int = 6, columns: int = 7) -> Indices:
    return np.arange(rows * columns, dtype=np.uint8).reshape(rows, columns)


def _edited(text: str, yarn: int = 99) -> Indices:
    knots = _knots()
    apply_edit(knots, parse_edit(text), (yarn,))
    return knots


@pytest.mark.parametrize(("direction", "axes"), [("across", (1,)), ("along", (0,)), ("both", (0, 1))])
def test_a_mirrored_carpet_is_symmetric_and_keeps_its_given_part(direction: str, axes: tuple[int, ...]) -> None:
    knots = _edited(f"mirror {direction}")
    for axis in axes:
        assert np.array_equal(knots, np.flip(knots, axis))
    assert np.array_equal(knots[:3, :4], _knots()[:3, :4])


def test_a_mirror_of_a_part_leaves_the_rest() -> None:
    knots, before = _edited("mirror across in 1,1 2,4"), _knots()
    assert knots[-1].tolist() == [35, 36, 36, 35, 39, 40, 41]
    assert np.array_equal(knots[:4], before[:4])


def test_a_repeat_fills_the_carpet_and_the_tile_stays() -> None:
    knots, before = _edited("repeat 3,3 4,5"), _knots()
    tile = before[2:4, 2:5]
    assert np.array_equal(knots[2:4, 2:5], tile)
    assert np.array_equal(knots[:2, 2:5], tile)
    assert np.array_equal(knots[2:4, 5:7], tile[:, :2])
    assert np.array_equal(knots[2:4, :2], tile[:, 1:])


def test_a_repeat_within_a_part_counts_from_its_tile() -> None:
    knots, before = _edited("repeat 1,1 1,2 in 3,1 3,7"), _knots()
    assert knots[3].tolist() == [35, 36, 35, 36, 35, 36, 35]
    assert np.array_equal(knots[4:], before[4:])


def test_a_border_lies_inside_the_edge() -> None:
    knots = _edited("border 2 madder red")
    assert np.array_equal(knots[2:4, 2:5], _knots()[2:4, 2:5])
    assert np.count_nonzero(knots == 99) == 6 * 7 - 6
    assert np.count_nonzero(_edited("border 1 ivory in 2,2 4,5") == 99) == 10
    assert (_edited("border 9 ivory") == 99).all()


@pytest.mark.parametrize(
    "text",
    ["mirror", "mirror up", "mirror across in 1,1", "mirror across ivory", "repeat", "repeat 1,1",
     "repeat 1,1 2,2 ivory", "repeat 1,1 2,2 in 3,3", "border ivory", "border 3", "border 0 ivory",
     "border 3 ivory in 2,2"],
)  # fmt: skip
def test_a_broken_edit_is_refused_with_its_form(text: str) -> None:
    with pytest.raises(CarpetError) as refused:
        parse_edit(text)
    assert f"write {text.partition(' ')[0]} " in refused.value.do
