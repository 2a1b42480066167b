"""Edits of which the carpet shows a part: a design that is cropped and enlarged by repeating its knots, counted knot by
knot.
"""

from pathlib import Path

import numpy as np
import pytest
from effort import examples
from hypothesis import given
from hypothesis import strategies as st

from ilmek.carpet.fitting import Fit
from ilmek.carpet.recipe.carried import Carried
from ilmek.carpet.recipe.carry import carry
from ilmek.carpet.recipe.edits import Edit, apply_edit, parse_edit
from ilmek.carpet.recipe.layout import CarpetLayout
from ilmek.carpet.recipe.recipe import Recipe
from ilmek.carpet.recipe.structure import DesignStructure, GridRelation, relate

ROWS, COLUMNS = 12, 14
YARN = 201
"""No knot of a design has it."""

DESIGN = np.arange(ROWS * COLUMNS, dtype=np.uint8).reshape(ROWS, COLUMNS)
"""Every knot has its own number."""

RECIPE = Recipe(Path("carpet.toml"), Path("picture.png"))
Crop = tuple[int, int, int, int]


def relation_of(crop: Crop, times: int) -> GridRelation:
    """A picture of which the carpet shows rows top to before bottom and columns left to before right, enlarged."""
    top, bottom, left, right = crop
    grid, new = (ROWS, COLUMNS), ((bottom - top) * times, (right - left) * times)
    shown = Fit(shown=(left / COLUMNS, top / ROWS, right / COLUMNS, bottom / ROWS))
    structures = [
        DesignStructure(RECIPE, sides, CarpetLayout((), (0, 0), sides), fit)
        for sides, fit in ((grid, Fit()), (new, shown))
    ]
    return relate(*structures)


def carried_on(design: np.ndarray, edit: Edit, crop: Crop, times: int) -> tuple[Carried, np.ndarray]:
    """What became of an edit, and the knots that come out."""
    top, bottom, left, right = crop
    knots = np.kron(design[top:bottom, left:right], np.ones((times, times), dtype=np.uint8))
    yarns = (int(design[0, 0]), YARN) if edit.kind == "replace" else (YARN,)
    carried = carry(edit, relation_of(crop, times), design, knots, yarns)
    for one in carried.edits:
        apply_edit(knots, one, yarns)
    return carried, knots


@st.composite
def crops(draw: st.DrawFn) -> Crop:
    top, left = draw(st.integers(0, ROWS - 3)), draw(st.integers(0, COLUMNS - 3))
    return top, draw(st.integers(top + 2, ROWS)), left, draw(st.integers(left + 2, COLUMNS))


knots_of_design = st.tuples(st.integers(1, ROWS), st.integers(1, COLUMNS)).map(lambda knot: f"{knot[0]},{knot[1]}")


def inside(cell: int, crop: Crop) -> bool:
    row, column = divmod(cell, COLUMNS)
    return crop[0] <= row < crop[1] and crop[2] <= column < crop[3]


def in_rectangle(edit: Edit, first: int = 0) -> list[int]:
    """The cells between two corners of an edit, row by row."""
    (row, column), (other_row, other_column) = edit.knots[first : first + 2]
    return [
        down * COLUMNS + across
        for down in range(ROWS)
        for across in range(COLUMNS)
        if min(row, other_row) <= ROWS - down <= max(row, other_row)
        and min(column, other_column) <= across + 1 <= max(column, other_column)
    ]


def check(edit: Edit, crop: Crop, times: int, kept: dict[int, bool], design: np.ndarray = DESIGN) -> None:
    """Cells that are kept are as after the edit, the others as before; the share of the latter is what is lost."""
    after = design.copy()
    apply_edit(after, edit, (int(design[0, 0]), YARN) if edit.kind == "replace" else (YARN,))
    for cell, is_kept in kept.items():
        if not is_kept:
            after.flat[cell] = design.flat[cell]
    top, bottom, left, right = crop
    expected = np.kron(after[top:bottom, left:right], np.ones((times, times), dtype=np.uint8))
    carried, knots = carried_on(design, edit, crop, times)
    assert np.array_equal(knots, expected)
    assert carried.lost == pytest.approx(list(kept.values()).count(False) / len(kept))
    assert bool(carried.reason) == (not all(kept.values()))
    assert bool(carried.edits) == any(kept.values())


@examples(60)
@given(crops(), st.integers(1, 3), st.sampled_from(("set", "line", "stroke 1", "stroke 3")), st.data())
def test_of_knots_those_that_are_cropped_are_lost(crop: Crop, times: int, kind: str, data: st.DataObject) -> None:
    edit = parse_edit(f"{kind} {data.draw(knots_of_design)} {data.draw(knots_of_design)} gold")
    drawn = np.zeros((ROWS, COLUMNS), dtype=np.uint8)
    apply_edit(drawn, edit, (YARN,))
    cells = np.flatnonzero(drawn).tolist()
    check(edit, crop, times, {cell: inside(cell, crop) for cell in cells})


@examples(60)
@given(crops(), st.integers(1, 3), st.sampled_from(("across", "along", "both")), knots_of_design, knots_of_design)
def test_a_reflection_is_kept_where_all_its_knots_are_shown(
    crop: Crop, times: int, way: str, first: str, last: str
) -> None:
    edit = parse_edit(f"mirror {way} in {first} {last}")
    cells = in_rectangle(edit)
    rows, columns = ({divmod(cell, COLUMNS)[axis] for cell in cells} for axis in (0, 1))

    def reflected(cell: int) -> list[int]:
        row, column = divmod(cell, COLUMNS)
        others = [min(rows) + max(rows) - row] if way in ("along", "both") else []
        sides = [min(columns) + max(columns) - column] if way in ("across", "both") else []
        return [down * COLUMNS + across for down in (row, *others) for across in (column, *sides)]

    kept = {cell: all(inside(one, crop) for one in reflected(cell)) for cell in cells}
    check(edit, crop, times, kept)


@examples(80)
@given(
    crops(),
    st.integers(1, 3),
    st.sampled_from(("", " mirrored across", " mirrored along")),
    st.sampled_from(("", " turned 90deg", " turned 180deg")),
    st.lists(knots_of_design, min_size=3, max_size=3),
)
def test_a_copy_is_kept_where_both_its_places_are_shown(
    crop: Crop, times: int, way: str, turn: str, knots: list[str]
) -> None:
    edit = parse_edit(f"copy {knots[0]} {knots[1]} to {knots[2]}{turn}{way}")
    sources = DESIGN.copy()
    apply_edit(sources, edit, ())
    height, width = (int(np.ptp([knot[axis] for knot in edit.knots[:2]])) + 1 for axis in (0, 1))
    if "90deg" in turn:
        height, width = width, height
    row, column = edit.knots[2]
    corner = min(row + height - 1, ROWS), min(column + width - 1, COLUMNS)
    cells = in_rectangle(parse_edit(f"repeat {row},{column} {corner[0]},{corner[1]}"))
    kept = {cell: inside(cell, crop) and inside(int(sources.flat[cell]), crop) for cell in cells}
    check(edit, crop, times, kept)


@examples(40)
@given(crops(), st.integers(1, 3), st.lists(knots_of_design, min_size=4, max_size=4))
def test_a_tile_is_repeated_if_it_is_shown_whole(crop: Crop, times: int, knots: list[str]) -> None:
    edit = parse_edit(f"repeat {knots[0]} {knots[1]} in {knots[2]} {knots[3]}")
    is_whole = all(inside(cell, crop) for cell in in_rectangle(edit))
    cells = in_rectangle(edit, 2)
    check(edit, crop, times, {cell: is_whole and inside(cell, crop) for cell in cells})


@examples(40)
@given(crops(), st.integers(1, 3), st.integers(1, 3), knots_of_design, knots_of_design)
def test_a_side_of_a_border_that_is_cropped_is_not_drawn_at_the_edge(
    crop: Crop, times: int, width: int, first: str, last: str
) -> None:
    edit = parse_edit(f"border {width} gold in {first} {last}")
    rectangle = in_rectangle(edit)
    rows, columns = ([divmod(cell, COLUMNS)[axis] for cell in rectangle] for axis in (0, 1))
    cells = [
        cell
        for cell, row, column in zip(rectangle, rows, columns, strict=True)
        if min(row - min(rows), max(rows) - row, column - min(columns), max(columns) - column) < width
    ]
    check(edit, crop, times, {cell: inside(cell, crop) for cell in cells})


@examples(60)
@given(crops(), st.integers(1, 3), st.integers(0, 999), st.sampled_from(("fill", "replace")), st.data())
def test_of_an_area_all_that_is_shown_is_changed(
    crop: Crop, times: int, seed: int, kind: str, data: st.DataObject
) -> None:
    """Also where the crop leaves several parts of it."""
    design = np.random.default_rng(seed).integers(0, 2, (ROWS, COLUMNS), dtype=np.uint8)
    first = data.draw(knots_of_design)
    if kind == "fill":
        edit = parse_edit(f"fill {first} gold")
        filled = design.copy()
        apply_edit(filled, edit, (YARN,))
        cells = np.flatnonzero(filled == YARN).tolist()
    else:
        edit = parse_edit(f"replace rose by gold in {first} {data.draw(knots_of_design)}")
        cells = in_rectangle(edit)
    check(edit, crop, times, {cell: inside(cell, crop) for cell in cells}, design)


@examples(40)
@given(st.integers(2, 3), st.lists(knots_of_design, min_size=1, max_size=12))
def test_of_details_below_a_knot_the_share_is_listed(times: int, knots: list[str]) -> None:
    """Groups of neighbours, counted one by one, on a grid that is several times coarser."""
    new = -(-ROWS // times), -(-COLUMNS // times)
    old = new[0] * times, new[1] * times
    relation = relate(*(DesignStructure(RECIPE, sides, CarpetLayout((), (0, 0), sides), Fit()) for sides in (old, new)))
    edit = parse_edit(f"set {' '.join(knots)} gold")
    left, groups = set(edit.knots), []
    while left:
        group, near = set(), {next(iter(left))}
        while near:
            group |= near
            left -= near
            near = {knot for knot in left if any(max(abs(knot[0] - r), abs(knot[1] - c)) == 1 for r, c in group)}
        groups.append(group)
    small = [
        group
        for group in groups
        if max(np.ptp([knot[axis] for knot in group]) + 1 for axis in (0, 1)) < times and len(group) < times * times / 2
    ]
    carried = carry(edit, relation, None, np.zeros(new, dtype=np.uint8), (YARN,))
    assert carried.details == (len(groups), len(small))
    assert carried.lost == pytest.approx(sum(map(len, small)) / len(set(edit.knots)))
    rest = {knot for group in groups if group not in small for knot in group}
    tied = {(-(-row // times), -(-column // times)) for row, column in rest}
    assert {knot for one in carried.edits for knot in one.knots} == tied
