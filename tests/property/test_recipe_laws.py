"""Recipes: mirrors are exact, borders turn their corners, tiles repeat, a saved recipe is the same carpet."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from effort import examples
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.carpet.quality import Quality, parse_quality
from ilmek.carpet.recipe.border import draw_border, edges, repeat_lines
from ilmek.carpet.recipe.composition import compose
from ilmek.carpet.recipe.edits import apply_edit, line_knots, parse_edit
from ilmek.carpet.recipe.mirror import MIRRORS, complete, part_grid
from ilmek.carpet.recipe.recipe import ORDERS, POSITIONS, Border, Breadth, Motif, Recipe, Repeat
from ilmek.carpet.recipe.repeat import repeated
from ilmek.carpet.sizes import CarpetSize, parse_size
from ilmek.errors import CarpetError
from ilmek.io.recipe_file import LoomKeys, RecipeFile, read_recipe
from ilmek.io.recipe_text import recipe_text
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.order import recipe_parameters

SIDE = st.integers(2, 40)
YARNS = tuple(yarn.name for yarn in default_yarns())


def noise(seed: int, *shape: int) -> np.ndarray:
    return np.random.default_rng(seed).integers(0, 256, (*shape, 3), dtype=np.uint8)


@given(SIDE, SIDE, st.sampled_from(MIRRORS), st.integers(0, 99))
def test_a_mirror_is_exact_on_any_grid(rows: int, columns: int, mirror: str, seed: int) -> None:
    area = noise(seed, rows, columns)
    part = part_grid(mirror, (rows, columns))
    before = area[: part[0], : part[1]].copy()
    complete(area, mirror)
    assert (area[: part[0], : part[1]] == before).all()
    assert mirror == "along" or (area == area[:, ::-1]).all()
    assert mirror == "across" or (area == area[::-1]).all()


@given(st.integers(1, 60), st.integers(1, 12), st.integers(1, 12), st.integers(0, 9), st.sampled_from((1, 2)))
def test_a_side_has_every_line_of_its_tile_in_order(
    extra: int, units: int, part: int, before: int, motifs: int
) -> None:
    """Lines ascend within a motif, from the first to the last, and a motif that fits is the tile itself."""
    units += motifs == 2 and units % 2 == 0
    length, tile = units * part, motifs * part
    lines = repeat_lines(length, units, tile, before, motifs)
    assert (lines == np.arange(-before, (length + 1) // 2) % tile).all()
    longer = repeat_lines(length + extra, units, tile, 0, motifs)
    steps = np.diff(longer)
    assert ((steps == 0) | (steps == 1) | (longer[1:] % part == 0)).all()
    whole = np.concatenate([longer, longer[: (length + extra) // 2][::-1]])
    assert len(whole) == length + extra


@examples(60)
@given(st.integers(1, 8), st.integers(1, 9), st.integers(1, 6), st.integers(1, 6), st.integers(0, 99))
def test_a_border_of_whole_repeats_tiles_its_sides_and_turns_its_corners(
    breadth: int, length: int, across: int, along: int, seed: int
) -> None:
    tile = noise(seed, breadth, length)
    area = noise(seed + 1, along * length + 2 * breadth, across * length + 2 * breadth)
    inside = area[breadth:-breadth, breadth:-breadth].copy()
    draw_border(area, (tile, np.swapaxes(tile, 0, 1)), (across, along))
    assert (area[breadth:-breadth, breadth:-breadth] == inside).all()
    corner = area[:breadth, :breadth]
    assert (corner == np.swapaxes(corner, 0, 1)).all()
    for number in range(across // 2):
        first = breadth + number * length
        assert (area[:breadth, first : first + length] == tile).all()
    for number in range(along // 2):
        first = breadth + number * length
        assert (area[first : first + length, :breadth] == np.swapaxes(tile, 0, 1)).all()
    for side in edges(*area.shape[:2], (breadth, breadth)):
        assert (area[side] == area[:, ::-1][side]).all()
        assert (area[side] == area[::-1][side]).all()


@given(st.integers(3, 30), st.integers(3, 30), st.integers(1, 2), st.integers(1, 2))
def test_the_sides_of_a_border_cover_each_knot_once(rows: int, columns: int, high: int, wide: int) -> None:
    high, wide = min(high, (rows - 1) // 2), min(wide, (columns - 1) // 2)
    count = np.zeros((rows, columns), dtype=int)
    for side in edges(rows, columns, (high, wide)):
        count[side] += 1
    inner = count[high : rows - high, wide : columns - wide]
    assert inner.sum() == 0
    assert count.sum() == count.size - inner.size
    assert count.max() == 1


@settings(max_examples=40, deadline=None)
@given(st.integers(2, 9), st.integers(2, 40), st.booleans(), st.integers(200, 900), st.integers(100, 500))
def test_the_sizes_and_qualities_that_are_offered_fit(
    breadth: int, length: int, alternate: bool, width: int, density: int
) -> None:
    border = Border(tile=Path("tile.png"), alternate=alternate and length % 2 == 0)
    recipe = Recipe(Path("carpet.toml"), plain="ivory", borders=(Border(yarn="gold", width=Breadth(2)), border))
    size, quality = CarpetSize(width / 1000, 1.5 * width / 1000), Quality(density, density * 1.1)
    pictures = {Path("tile.png"): noise(3, breadth, 2 * length)}
    error = fault(lambda: compose(recipe, size, quality, default_yarns(), pictures))
    if error is None or "make them narrower" in str(error):
        return
    offered = re.findall(r"[\d.]+x[\d.]+cm", error.allowed)
    assert offered
    for text in offered:
        compose(recipe, parse_size(text), quality, default_yarns(), pictures)
    compose(recipe, size, parse_quality(error.allowed.rpartition("quality: ")[2]), default_yarns(), pictures)


def fault(work: Callable[[], object]) -> CarpetError | None:
    try:
        work()
    except CarpetError as error:
        return error
    return None


@given(st.integers(1, 9), st.integers(1, 9), SIDE, SIDE, st.sampled_from(ORDERS))
def test_a_cut_repeat_fills_its_area_and_whole_tiles_are_whole(
    height: int, width: int, rows: int, columns: int, order: str
) -> None:
    tile = np.arange(1, height * width + 1, dtype=np.uint8).reshape(height, width, 1).repeat(3, axis=2)
    cut = np.zeros((rows, columns, 3), dtype=np.uint8)
    assert repeated(tile, cut, order, cut=True)
    assert cut.all()
    if height <= rows and width <= columns:
        whole = np.zeros((rows, columns, 3), dtype=np.uint8)
        filled = repeated(tile, whole, order, cut=False)
        found = np.bincount(whole[..., 0].ravel(), minlength=256)[1 : height * width + 1]
        assert found.min() == found.max() > 0
        assert filled == bool(whole.all())


@given(*4 * [st.integers(0, 30)])
def test_a_line_is_8_connected_from_either_end(top: int, left: int, bottom: int, right: int) -> None:
    rows, columns = line_knots((top, left), (bottom, right))
    assert {(top, left), (bottom, right)} <= set(zip(rows.tolist(), columns.tolist(), strict=True))
    assert max(abs(np.diff(rows)).max(initial=0), abs(np.diff(columns)).max(initial=0)) <= 1
    again = line_knots((bottom, right), (top, left))
    assert (rows == again[0]).all()
    assert (columns == again[1]).all()


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 999))
def test_a_fill_is_the_connected_area(seed: int) -> None:
    generator = np.random.default_rng(seed)
    knots = generator.integers(0, 2, generator.integers(1, 14, 2), dtype=np.uint8)
    row, column = (int(generator.integers(0, side)) for side in knots.shape)
    expected, stack = {(row, column)}, [(row, column)]
    while stack:
        i, j = stack.pop()
        for near in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
            inside = 0 <= near[0] < knots.shape[0] and 0 <= near[1] < knots.shape[1]
            if inside and near not in expected and knots[near] == knots[i, j]:
                expected.add(near)
                stack.append(near)
    filled = knots.copy()
    apply_edit(filled, parse_edit(f"fill {len(knots) - row},{column + 1} gold"), (2,))
    assert set(map(tuple, np.argwhere(filled == 2).tolist())) == expected
    assert (filled[filled != 2] == knots[filled != 2]).all()


def recipe_of(seed: int, folder: Path) -> Recipe:
    """A recipe of a carpet of 40 x 60 cm at 25 knots per dm."""
    generator = np.random.default_rng(seed)

    def one_of(*choices: Any) -> Any:
        return choices[int(generator.integers(len(choices)))]

    def yarn() -> str:
        return str(one_of(*YARNS))

    tile = folder / "tile.png"
    borders = tuple(
        one_of(
            Border(tile=tile, adjust=True, alternate=one_of(True, False)),
            Border(yarn=yarn(), width=one_of(Breadth(3), Breadth(None, 0.012))),
            Border(teeth=(yarn(), yarn()), width=Breadth(one_of(2, 4)), adjust=True),
        )
        for _ in range(one_of(0, 1, 3))
    )
    field = one_of("picture", "plain", "repeat")
    motifs = tuple(
        Motif(tile, one_of(*POSITIONS, (30, 20)), one_of("", *MIRRORS), transparent=one_of("", "#9e2b25"))
        for _ in range(one_of(0, 1, 2))
    )
    lines = ("set 1,1 2,2 gold", "line 1,1 150,100 ivory", "fill 75,50 rose", "replace rose by camel in 1,1 99,99")
    return Recipe(
        folder / "carpet.toml",
        folder / "photo.png" if field == "picture" else None,
        "" if field == "picture" else yarn(),
        Repeat(tile, order=one_of(*ORDERS), cut=one_of(True, False)) if field == "repeat" else None,
        one_of("", *MIRRORS),
        borders,
        motifs,
        tuple(parse_edit(one_of(*lines, "half 3,3 rose", "jufti 9,9")) for _ in range(one_of(0, 2))),
    )


def test_a_saved_recipe_reads_as_the_same_carpet(tmp_path: Path) -> None:
    """Records and composed colours are the same, for random recipes."""
    for name in ("photo.png", "tile.png"):
        (tmp_path / name).write_bytes(b"not opened")
    size, quality, yarns = CarpetSize(0.4, 0.6), Quality(250.0, 250.0), default_yarns()
    pictures = {tmp_path / "photo.png": noise(1, 90, 60), tmp_path / "tile.png": noise(2, 6, 10)}

    @settings(max_examples=40, deadline=None)
    @given(st.integers(0, 10**6), st.sampled_from((None, "asymmetric")))
    def check(seed: int, knot: str | None) -> None:
        recipe = recipe_of(seed, tmp_path)
        made = RecipeFile(recipe, size, quality, knot, None, None, None, {"least_patch": 2}, LoomKeys(heads=3))
        (tmp_path / "carpet.toml").write_text(recipe_text(made, tmp_path), encoding="utf-8")
        read = read_recipe(tmp_path / "carpet.toml", recipe_parameters())
        assert (read.size, read.quality, read.knot) == (size, quality, knot)
        assert (read.settings, read.loom.heads) == ({"least_patch": 2}, 3)
        assert read.recipe.as_dict() == recipe.as_dict()
        first, second = (compose(one, size, quality, yarns, pictures) for one in (recipe, read.recipe))
        assert (first.design.colours == second.design.colours).all()

    check()
