"""Edits belong to the design: editing and enlarging commute; there and back is the same edit."""

from pathlib import Path

import numpy as np
from effort import examples
from hypothesis import given
from hypothesis import strategies as st

from ilmek.carpet.fitting import Fit
from ilmek.carpet.recipe.axis import Tiling, old_tiles, tiled
from ilmek.carpet.recipe.carry import carry
from ilmek.carpet.recipe.edits import Edit, apply_edit, parse_edit
from ilmek.carpet.recipe.layout import CarpetLayout
from ilmek.carpet.recipe.recipe import Recipe
from ilmek.carpet.recipe.structure import DesignStructure, GridRelation, relate

YARN = 3


def relation_of(old: tuple[int, int], new: tuple[int, int], recipe: Recipe | None = None) -> GridRelation:
    """The relation of two grids of a carpet without borders."""
    recipe = recipe or Recipe(Path("carpet.toml"), Path("picture.png"))
    one, other = (DesignStructure(recipe, grid, CarpetLayout((), (0, 0), grid), Fit()) for grid in (old, new))
    return relate(one, other)


@st.composite
def edited_designs(draw: st.DrawFn) -> tuple[np.ndarray, list[Edit]]:
    rows, columns, seed = draw(st.integers(3, 14)), draw(st.integers(3, 14)), draw(st.integers(0, 999))
    design = np.random.default_rng(seed).integers(0, 3, (rows, columns), dtype=np.uint8)

    def knot() -> str:
        return f"{draw(st.integers(1, rows))},{draw(st.integers(1, columns))}"

    turns = st.sampled_from(("", " turned 90deg", " turned 180deg"))
    reflections = st.sampled_from(("", " mirrored across", " mirrored along"))
    forms = (
        lambda: f"set {knot()} {knot()} gold",
        lambda: f"line {knot()} {knot()} gold",
        lambda: f"fill {knot()} gold",
        lambda: "replace rose by gold",
        lambda: f"replace rose by gold in {knot()} {knot()}",
        lambda: f"mirror {draw(st.sampled_from(('across', 'along', 'both')))}",
        lambda: f"mirror both in {knot()} {knot()}",
        lambda: f"repeat {knot()} {knot()}",
        lambda: f"repeat {knot()} {knot()} in {knot()} {knot()}",
        lambda: f"stroke {draw(st.integers(1, 5))} {knot()} {knot()} {knot()} gold",
        lambda: f"copy {knot()} {knot()} to {knot()}{draw(turns)}{draw(reflections)}",
        lambda: f"move {knot()} {knot()} to {knot()}{draw(turns)}{draw(reflections)} gold",
        lambda: f"border {draw(st.integers(1, 3))} gold",
        lambda: f"border 1 gold in {knot()} {knot()}",
    )
    lines = [draw(st.sampled_from(forms))() for _ in range(draw(st.integers(1, 4)))]
    return design, [parse_edit(line) for line in lines]


def yarns_of(edit: Edit) -> tuple[int, ...]:
    return (1, YARN) if edit.kind == "replace" else (YARN,)


@examples(80)
@given(edited_designs(), st.integers(2, 3), st.integers(2, 3))
def test_editing_and_enlarging_commute(made: tuple[np.ndarray, list[Edit]], down: int, across: int) -> None:
    """The factor of a border's width is one for both directions, so borders are tried on like factors alone; parts that
    are turned, too.
    """
    small, edits = made
    if any(edit.kind == "border" or edit.turned % 2 for edit in edits):
        across = down
    times = np.ones((down, across), dtype=np.uint8)
    large = np.kron(small, times)
    relation = relation_of(small.shape, large.shape)
    for edit in edits:
        carried = carry(edit, relation, small, large, yarns_of(edit))
        assert (bool(carried.edits), carried.reason) == (True, "")
        for one in carried.edits:
            apply_edit(large, one, yarns_of(edit))
        apply_edit(small, edit, yarns_of(edit))
    assert np.array_equal(large, np.kron(small, times))


@examples(80)
@given(edited_designs(), st.integers(2, 4))
def test_there_and_back_is_the_same_edit(made: tuple[np.ndarray, list[Edit]], times: int) -> None:
    """For knots, lines, rectangles and areas, whose knots are found again, each once."""
    design, edits = made
    grid, large = design.shape, (times * design.shape[0], times * design.shape[1])
    enlarged = np.kron(design, np.ones((times, times), dtype=np.uint8))
    for edit in edits:
        (there,) = carry(edit, relation_of(grid, large), design, enlarged, yarns_of(edit)).edits
        (back,) = carry(there, relation_of(large, grid), enlarged, design, yarns_of(edit)).edits
        first, second = design.copy(), design.copy()
        apply_edit(first, edit, yarns_of(edit))
        apply_edit(second, back, yarns_of(edit))
        assert np.array_equal(first, second)
        assert back.width == edit.width


@given(st.integers(2, 12), st.integers(1, 9), st.integers(1, 9))
def test_a_line_stays_in_one_piece_on_any_smaller_grid(rows: int, columns: int, seed: int) -> None:
    generator = np.random.default_rng(seed)
    begin, end = (f"{generator.integers(1, 61)},{generator.integers(1, 41)}" for _ in range(2))
    carried = carry(
        parse_edit(f"line {begin} {end} gold"), relation_of((60, 40), (rows, columns)), None,
        np.zeros((rows, columns), dtype=np.uint8), (YARN,),
    )  # fmt: skip
    if not carried.edits:
        assert carried.reason
        return
    left = set(carried.edits[0].knots)
    stack = [left.pop()]
    while stack:
        row, column = stack.pop()
        near = {(row + down, column + across) for down in (-1, 0, 1) for across in (-1, 0, 1)} & left
        left -= near
        stack += near
    assert not left


@given(st.integers(1, 9), st.integers(1, 60), st.integers(1, 60), st.booleans())
def test_each_old_tile_is_found_once_from_its_edge(side: int, old: int, new: int, turned: bool) -> None:
    def tiling(span: int) -> Tiling:
        return Tiling((0, span), side, (span - span // side * side) // 2, True)

    before, after = tiling(old), tiling(new)
    numbers = np.arange(*after.numbers)
    found, known = old_tiles(before, after, numbers)
    tiles = found[known].tolist()
    assert len(set(tiles)) == len(tiles) == min(old // side, new // side)
    axis = tiled(before, after, mirrored=turned)
    assert ((axis.last - axis.first) <= 1).all()
    if old == new:
        assert axis.first.tolist() == list(range(old))
