"""Squared paper is read cell by cell: exports, scans and photographs; nothing else is taken for it."""

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import skimage.data
from PIL import Image, ImageDraw, ImageFilter
from sheet_readings import wrong_cells
from sheets import photographed, printed, random_design, random_palette, random_sheet

from ilmek.carpet.paper.placing import RINGS, border_beside
from ilmek.carpet.paper.sheet import PaperReading, read_sheet, squared_paper
from ilmek.errors import CarpetError, PictureError
from ilmek.jobs.chart import chart_order, chart_results, make_charted
from ilmek.jobs.order import read_order
from ilmek.jobs.paper import reading_checks

DATA, EXAMPLES = Path(__file__).parents[1] / "data" / "paper", Path(__file__).parents[2] / "examples"
TRUTH = np.asarray(Image.open(DATA / "cartoon-truth.png")).astype(int)


def same_partition(one, other):
    """Whether two charts have the same areas, whatever the numbers of their colours."""
    assert one.shape == other.shape
    pairs = np.unique(np.stack([one.ravel(), other.ravel()]), axis=1)
    return pairs.shape[1] == len(np.unique(one)) == len(np.unique(other))


def test_an_export_of_a_chart_program_is_read_by_its_cells():
    charted = make_charted(read_order(DATA / "cartoon-grid.png"))
    assert same_partition(charted.chart.knots.astype(int), TRUTH)
    assert chart_results(charted)["paper"] == {"rows": 120, "columns": 100, "doubtful": 0, "cells": []}


@pytest.mark.parametrize(
    "options", [{"line": 170, "heavy": 5}, {"line": 60, "heavy": 0, "letters": True, "numbers": True, "margin": 60}]
)
def test_exports_with_other_lines_letters_and_margins(options):
    rng = np.random.default_rng(5)
    palette, design = random_palette(rng, 5), random_design(rng, 30, 24, 5)
    found = squared_paper(printed(rng, design, palette, 20, **options))
    assert found is not None
    assert same_partition(found.numbers.astype(int), design)
    assert found.doubts == 0


def test_a_scan_to_the_edge_of_the_paper_has_the_corners_of_its_grid():
    order = read_order(DATA / "cartoon-scan.jpg", size="40x48cm", corners="auto")
    assert same_partition(make_charted(order).chart.knots.astype(int), TRUTH)


def test_a_scan_is_read_cell_by_cell():
    charted = make_charted(read_order(DATA / "cartoon-scan.jpg", paper=True))
    assert same_partition(charted.chart.knots.astype(int), TRUTH)
    assert all(check.ok for check in charted.checks)


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize("seed", [101, 102, 104])
def test_photographed_sheets_are_read_and_what_is_wrong_is_doubtful(seed: int) -> None:
    sheet = random_sheet(seed, small=True)
    found = read_sheet(sheet.picture)
    assert found.grid == sheet.truth.shape
    wrong = wrong_cells(found, sheet.truth)
    assert wrong.mean() <= 0.001
    assert not (wrong & ~found.doubtful).any()
    assert all(check.ok for check in reading_checks(found))


@pytest.mark.parametrize(
    ("pitch", "options"), [(15, {"line": 189, "heavy": 5}), (18, {"line": 70, "faded": 0.2, "letters": True})]
)
def test_neither_heavy_lines_nor_letters_are_taken_for_the_lines(pitch: int, options: dict[str, Any]) -> None:
    rng = np.random.default_rng(8)
    palette, design = random_palette(rng, 4), random_design(rng, 40, 35, 4)
    flat = printed(rng, design, palette, pitch, **options)
    found = read_sheet(photographed(rng, flat, perspective=0.1, bend=0.02, turn=0.05, noise=4, blur=0.7, quality=70))
    assert same_partition(found.numbers.astype(int), design)


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize("seed", [71004, 71002])
def test_neither_the_table_nor_lines_at_every_second_place_are_taken_for_the_grid(seed: int) -> None:
    """The table beyond the last line; half the distance of heavy lines."""
    sheet = random_sheet(seed)
    found = read_sheet(sheet.picture)
    assert found.grid == sheet.truth.shape
    assert all(check.ok for check in reading_checks(found))
    assert not (wrong_cells(found, sheet.truth) & ~found.doubtful).any()


def failed(found: PaperReading) -> set[str]:
    """The checks of a sheet that fail, without their common part."""
    checks = reading_checks(found)
    return {check.name.removeprefix("squared paper: ") for check in checks if not check.ok}


def test_a_grid_that_lost_a_column_fails_a_check() -> None:
    sheet = random_sheet(111009)
    found = read_sheet(sheet.picture)
    assert found.grid != sheet.truth.shape
    assert failed(found) == {"lines off their places", "doubtful cells"}


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize("seed", [303012, 304008])
def test_a_border_in_which_no_lines_show_fails_a_check(seed: int) -> None:
    """Its colour is nearly that of the lines: the grid ends before it, and nothing else says so."""
    found = read_sheet(random_sheet(seed).picture)
    assert "colours of the drawing beside the grid" in failed(found)


def test_cells_off_the_course_of_the_others_are_doubtful() -> None:
    sheet = random_sheet(304057)
    found = read_sheet(sheet.picture)
    wrong = wrong_cells(found, sheet.truth)
    assert wrong.any()
    assert not (wrong & ~found.doubtful).any()
    assert found.doubts < 0.1 * sheet.truth.size


@pytest.mark.parametrize("beside", [0, 2])
def test_colours_beside_a_grid(beside: int) -> None:
    """A border of so many cells at the right that is no part of the grid, then paper."""
    rng = np.random.default_rng(4)
    palette, numbers = random_palette(rng, 3), random_design(rng, 20, 16, 3)
    around = np.full((20 + 2 * RINGS, 16 + 2 * RINGS, 3), 252.0)
    around[RINGS:-RINGS, RINGS:-RINGS] = palette[numbers]
    around[RINGS:-RINGS, 16 + RINGS : 16 + RINGS + beside] = palette[1]
    assert border_beside(around, palette, numbers) == (1.0 if beside else 0.0)


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize("seed", [1, 2])
def test_a_strip_of_other_pitch_and_a_drawing_of_double_cells_fail_a_check(seed: int) -> None:
    """Pillow makes a strip of nine columns as wide as ten, as a lattice does that counts one column too few."""
    rng = np.random.default_rng(seed)
    palette, design = random_palette(rng, 4), random_design(rng, 40, 40, 4)
    flat = Image.fromarray(printed(rng, design, palette, 16, margin=40))
    assert failed(read_sheet(np.asarray(flat))) == set()
    strip = flat.crop((200, 0, 200 + 9 * 16, flat.height)).resize((10 * 16, flat.height))
    wide = Image.new("RGB", (flat.width + 16, flat.height))
    wide.paste(flat.crop((0, 0, 200, flat.height)))
    wide.paste(strip, (200, 0))
    wide.paste(flat.crop((200 + 9 * 16, 0, flat.width, flat.height)), (360, 0))
    assert "lines off their places" in failed(read_sheet(np.asarray(wide)))
    double = np.kron(random_design(rng, 20, 20, 4), np.ones((2, 2), dtype=np.int64))
    found = read_sheet(printed(rng, double, palette, 16, margin=40))
    assert failed(found) == {"changes of colour on every second line"}


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize("border", [150, 140])
def test_a_border_in_nearly_the_colour_of_its_lines_belongs_to_the_grid_or_a_check_fails(border: int) -> None:
    rng = np.random.default_rng(9)
    palette, design = random_palette(rng, 4), random_design(rng, 30, 26, 4)
    palette[1] = border
    flat = printed(rng, design, palette, 20, line=140, heavy=0, margin=60)
    found = read_sheet(photographed(rng, flat, perspective=0.1, bend=0.02, noise=2, blur=0.5, quality=80))
    assert all(check.ok for check in reading_checks(found)) == (border != 140)
    assert border == 140 or same_partition(found.numbers.astype(int), design)


def test_rounded_cells_on_a_grid_without_its_last_lines() -> None:
    """Drawn by Pillow alone: the lines go to the right and the lower edge of the cells, where none is across."""
    rng = np.random.default_rng(4)
    design = np.kron(rng.integers(0, 4, (6, 5)), np.ones((5, 5), dtype=int))
    picture = Image.new("RGB", (25 * 18 + 70, 30 * 18 + 90), "#fdfbf3")
    draw = ImageDraw.Draw(picture)
    for (row, column), colour in np.ndenumerate(design):
        x, y = 30 + 18 * column, 40 + 18 * row
        fill = ("#fdfbf3", "#b3402e", "#2e4a7d", "#d9a441")[colour]
        draw.rounded_rectangle((x + 2, y + 2, x + 16, y + 16), 5, fill=fill)
        draw.line((x, y + 18, x, y, x + 18, y), fill="#999999")
    found = read_sheet(np.asarray(picture.filter(ImageFilter.GaussianBlur(0.6))))
    assert same_partition(found.numbers.astype(int), design)
    assert all(check.ok for check in reading_checks(found))


@pytest.mark.parametrize("name", ["astronaut", "brick", "coffee", "grass", "page", "logo", "checkerboard"])
def test_photographs_and_drawings_are_no_squared_paper(name):
    rgb = getattr(skimage.data, name)()[..., :3] if name != "checkerboard" else skimage.data.checkerboard()
    rgb = np.repeat(rgb[..., None], 3, axis=-1) if rgb.ndim == 2 else rgb
    assert squared_paper(np.ascontiguousarray(rgb)) is None


@pytest.mark.parametrize("name", ["medallion.png", "photo.jpg"])
def test_examples_are_no_squared_paper(name):
    assert squared_paper(np.asarray(Image.open(Path("examples") / name).convert("RGB"))) is None


def test_a_photograph_called_paper_is_refused():
    with pytest.raises(PictureError, match="no squared paper is found"):
        read_sheet(skimage.data.coffee())


def test_a_carpet_of_other_knots_than_the_cells_is_refused():
    order = read_order(DATA / "cartoon-scan.jpg", paper=True, size="50x48cm", quality="25x25/dm")
    with pytest.raises(CarpetError, match=r"100 × 120 cells.*125 × 120 knots"):
        make_charted(order)


def test_the_page_shows_the_doubtful_cells(tmp_path):
    rng = np.random.default_rng(3)
    palette, design = random_palette(rng, 4), random_design(rng, 30, 30, 4)
    flat = printed(rng, design, palette, 14).copy()
    flat[14 * 20 : 14 * 21, 14 * 11 : 14 * 12] = (palette[0].astype(int) + palette[1]) // 2  # a cell of no colour
    picture = tmp_path / "sheet.png"
    Image.fromarray(photographed(rng, flat, blur=0.5)).save(picture)
    charted, _ = chart_order(read_order(picture, paper=True), tmp_path / "out")
    shown = json.loads(re.search(r'id="paper-data">(.*?)</script>', (tmp_path / "out/paper.html").read_text(), re.S)[1])
    assert (10, 12) in {(cell["row"], cell["column"]) for cell in shown["cells"]}
    assert {yarn["name"] for yarn in shown["yarns"]} == {charted.chart.yarns[one].name for one in charted.chart.used}
    assert len(shown["cells"]) == chart_results(charted)["paper"]["doubtful"]


def test_a_picture_that_is_no_sheet_fails_a_check_where_it_is_read_as_one() -> None:
    """A photograph of a carpet on a floor: what looks like lines is its fringe."""
    made = make_charted(read_order(EXAMPLES / "photo.jpg", paper=True))
    failed = [check.name for check in made.checks if not check.ok]
    assert "squared paper: doubtful cells" in failed
    shown = make_charted(read_order(DATA / "cartoon-grid.png", paper=True))
    assert [check.name for check in shown.checks if check.name.startswith("squared paper")] == [
        "squared paper: doubtful cells",
        "squared paper: cells beside the grid with lines",
        "squared paper: colours of the drawing beside the grid",
        "squared paper: lines off their places",
        "squared paper: difference of even and odd lines",
        "squared paper: changes of colour on every second line",
    ]
    assert all(check.ok for check in shown.checks)
