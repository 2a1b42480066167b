"""Recipes: what a file means, and one error with file and line for each fault."""

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from ilmek.carpet.overlay import HALF, JUFTI
from ilmek.carpet.palette_rules import yarn_names
from ilmek.carpet.sizes import CarpetSize
from ilmek.cli import main
from ilmek.errors import IlmekError
from ilmek.io.chart.oxs import write_chart_oxs
from ilmek.io.chart.png import read_chart_png
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.chart import chart_order
from ilmek.jobs.loom import read_loom_order
from ilmek.jobs.order import CarpetOrder, read_order

RED, IVORY, NAVY = (158, 43, 37), (239, 230, 208), (27, 36, 66)
FIELD = 'plain = "ivory"\nsize = "40x60cm"\n'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with some pictures, and a picture beside it."""
    inside = tmp_path / "carpet"
    inside.mkdir()
    noise = np.random.default_rng(5).integers(0, 256, (90, 60, 3), dtype=np.uint8)
    Image.fromarray(noise).save(inside / "photo.png")
    tile = np.full((6, 10, 3), RED, dtype=np.uint8)
    tile[2:4, 4:6] = IVORY
    Image.fromarray(tile).save(inside / "tile.png")
    Image.fromarray(noise).save(tmp_path / "outside.png")
    (inside / "link.png").symlink_to(tmp_path / "outside.png")
    return inside


def order_of(folder: Path, text: str, **options: str) -> CarpetOrder:
    (folder / "carpet.toml").write_text(text)
    return read_order(folder / "carpet.toml", **options)


FAULTS = {
    "unknown key": (FIELD + 'qualty = "25x25/dm"', r"line 3, qualty: .*'quality'"),
    "unknown key of a border": (FIELD + "[[border]]\nwidht = 3\nyarn = 'ivory'", r"line 4, border.0.widht: .*'width'"),
    "nothing": ('size = "40x60cm"', r"line 1: the recipe has no field"),
    "two fields": ('picture = "photo.png"\nplain = "ivory"', r"line 2, plain: the field has a picture already"),
    "missing picture": ('picture = "phto.png"', r"line 1, picture: 'phto.png' is not there"),
    "parent": ('picture = "../outside.png"', r"line 1, picture: '../outside.png' reaches outside"),
    "absolute": ('picture = "/etc/hostname"', r"line 1, picture: '/etc/hostname' reaches outside"),
    "link": ('picture = "link.png"', r"line 1, picture: 'link.png' is a link to a file outside"),
    "folder": ('picture = "."', r"line 1, picture: '.' is no file"),
    "yarn list outside": (FIELD + 'yarns = "../wool.toml"', r"line 3, yarns: '../wool.toml' reaches outside"),
    "edit outside": (
        FIELD + '[[edits]]\ngrid = "100x150"\nlines = ["set 1,1 ivory",\n"set 151,1 ivory"]',
        r"line 6, edits.0.lines.1: knot 151,1 lies outside the carpet; row 1 \(lower edge\) to 150, column 1 .* to 100",
    ),
    "edits on nothing": (
        FIELD + '[[edits]]\non = "bordr"\nlines = ["set 1,1 ivory"]',
        r"line 3, edits.0: 'bordr' is nothing to count on; carpet, picture",
    ),
    "edits on a picture without a grid": (
        FIELD + '[[edits]]\non = "picture"\nlines = ["set 1,1 ivory"]',
        r'edits.0: edits on picture state no grid; give columns x rows, like grid = "300x450"',
    ),
    "edits on a missing picture": (
        FIELD + '[[edits]]\non = "picture"\ngrid = "60x90"\nlines = ["set 1,1 ivory"]',
        r'edits.0.lines.0: the recipe has no picture; write on = "carpet"',
    ),
    "edits on a missing motif": (
        FIELD + '[[edits]]\non = "motif 2"\nlines = ["set 1,1 ivory"]',
        r"edits.0.lines.0: motif 2 is not there; no motif",
    ),
    "a mirror of a motif": (
        FIELD + '[[edits]]\non = "motif 1"\nlines = ["mirror both"]',
        r"edits.0.lines.0: mirror is no edit of a motif",
    ),
    "edits of no grid": (
        FIELD + '[[edits]]\ngrid = "100"\nlines = ["set 1,1 ivory"]',
        r"edits.0: '100' is no grid; columns x rows",
    ),
    "unknown edit": (FIELD + 'edits = ["sett 1,1 ivory"]', r"line 3, edits.0: unknown edit 'sett'; .*'set'"),
    "edit without yarn": (FIELD + 'edits = ["set 1,1"]', r"line 3, edits.0: .* is no edit; write set ROW,COLUMN YARN"),
    "half knot of one yarn": (
        FIELD + 'edits = ["half 5,7 ivory"]',
        r"line 3, edits.0: half 5,7: its cell has this yarn already; another yarn on its right warp",
    ),
    "edit of a number": (FIELD + "edits = [3]", r"line 3, edits.0: 3 is no edit"),
    "unknown yarn of an edit": (FIELD + 'edits = ["set 1,1 ivry"]', r"line 3, edits.0: unknown yarn 'ivry'.*'ivory'"),
    "a yarn that no knot has": (
        FIELD + 'edits = ["set 1,1 gold", "replace rose by gold"]',
        "line 3, edits.1: 'replace rose by gold' changes nothing: no knot in the carpet has the first yarn",
    ),
    "a yarn that no knot has there": (
        FIELD + 'edits = ["half 1,1 gold", "replace gold by rose in 2,2 9,9"]',
        "line 3, edits.1: 'replace gold by rose in 2,2 9,9' changes nothing: no knot there has the first yarn",
    ),
    "two yarns": (FIELD + 'edits = ["replace ivory"]', r"line 3, edits.0: 'ivory' does not name two yarns"),
    "unknown yarn of the field": ('plain = "madder"', r"line 1, plain: unknown yarn 'madder'.*'madder red'"),
    "unknown yarn of a border": (
        FIELD + '[[border]]\nyarn = "indigo"\nwidth = 2',
        r"line 3, border.0: unknown yarn 'indigo'.*'indigo navy'",
    ),
    "wide border": (FIELD + '[[border]]\nyarn = "ivory"\nwidth = 50', r"line 3, border.0: .* take 100 of 150 rows"),
    "border of nothing": (FIELD + "[[border]]\nwidth = 5", r"line 3, border.0: has nothing to be made of"),
    "border without width": (FIELD + '[[border]]\nyarn = "ivory"', r"line 3, border.0: the border has no width"),
    "broken repeat": (
        FIELD + '[[border]]\ntile = "tile.png"',
        r"line 3, border.0: the tile is 10 knots long.* these sizes fit: 40.8x60.8cm, 40.8x56.8cm",
    ),
    "repeat without ground": (
        'size = "40x60cm"\n[repeat]\ntile = "tile.png"\nwidth = 7',
        r"line 2, repeat: whole tiles of 7 × 6 knots do not fill",
    ),
    "motif outside": (
        FIELD + '[[motif]]\npicture = "tile.png"\nposition = [150, 1]',
        r"line 3, motif.0: the motif of 10 × 6 knots with its lower left knot at 150,1 lies outside",
    ),
    "position": (FIELD + '[[motif]]\npicture = "tile.png"\nposition = "centr"', r"line 5, motif.0.position: 'centr'"),
    "size": ('plain = "ivory"\nsize = "40x60"', r"line 2, size: size '40x60' has no unit"),
    "never": (
        FIELD + 'never = ["rose"]\nedits = ["set 1,1 rose"]',
        r"line 4, edits.0: 'rose' is named, and never",
    ),
    "group": (FIELD + "colours = 1", r"line 3, colours: colours=1 is out of bounds"),
    "kind": (FIELD + 'reading = "exat"', r"line 3, reading: .* did you mean exact"),
    "twice": (FIELD + 'reading = "exact"\nread = "exact"', r"reading is given twice"),
    "mirror": (FIELD + 'mirror = "up"', r"line 3, mirror: 'up' is unknown; one of across, along, both"),
    "not TOML": ("plain = ivory", r"carpet.toml, line 1"),
    "too many": (FIELD + "edits = [" + "'set 1,1 ivory'," * 10_001 + "]", r"line 3, edits: has 10,001 edits"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_one_error_with_file_and_line(folder: Path, name: str) -> None:
    text, expected = FAULTS[name]
    with pytest.raises(IlmekError, match=expected) as caught:
        chart_order(order_of(folder, text))
    assert str(caught.value).count("carpet.toml") == 1
    assert "carpet.toml, line " in str(caught.value)


def test_a_setting_of_no_loom_is_an_error_with_its_line(folder: Path) -> None:
    (folder / "carpet.toml").write_text(FIELD + '[loom]\nbeet = "comb"\n')
    result = CliRunner().invoke(main, ["weave", str(folder / "carpet.toml"), "--out", str(folder / "out")])
    assert result.exit_code == 2
    assert "carpet.toml, line 3, loom: unknown parameter 'beet'" in result.stderr
    assert not (folder / "out").exists()


def test_the_keys_of_the_loom_are_those_of_weave_and_options_override_them(folder: Path) -> None:
    keys = 'heads = 3\ndeadline = "90h"\naim = "time"\n[loom]\nbeat = "comb"\nshedding.law = "modified-sine"\n'
    order = order_of(folder, FIELD + keys)
    assert read_loom_order(order).wishes.heads == 3
    made = read_loom_order(order, heads=2, loom={"beat": "travelling"})
    assert (made.wishes.heads, made.deadline, made.params.aim) == (2, 90 * 3600.0, "time")
    assert (made.params.beat, made.given.loom["shedding.law"]) == ("travelling", "modified-sine")


def test_options_override_keys(folder: Path) -> None:
    order = order_of(folder, FIELD + 'quality = "20x20/dm"\ncolours = 5\npile_height = "6mm"\n', quality="30x30/dm")
    assert order.quality is not None
    assert (order.quality.across, order.palette.colours, order.plan.pile_height) == (300.0, 5, 0.006)


def test_edits_in_order(folder: Path) -> None:
    edits = '["line 1,1 1,100 madder red", "fill 2,1 indigo navy", "set 150,1 150,100 gold", "replace gold by ivory"]'
    chart = chart_order(order_of(folder, FIELD + f"edits = {edits}"))[0].chart
    srgb = np.array([yarn.srgb for yarn in chart.yarns])[chart.knots]
    assert (srgb[-1] == RED).all()
    assert (srgb[:-1, 1:-1] == NAVY).all()
    assert (srgb[0, [0, -1]] == IVORY).all()
    assert chart.reading.edited == 15_000 - 2


def test_a_recipe_of_options_is_the_chart_of_the_options(folder: Path) -> None:
    """The recipe that is saved gives the same chart, bit for bit; files beside it are its inputs."""
    run = CliRunner()
    command = ["chart", str(folder / "photo.png"), "--size", "30x45cm", "--colours", "5", "--knot", "asymmetric"]
    first = run.invoke(main, [*command, "--out", str(folder / "a"), "--save-recipe", str(folder / "saved.toml")])
    assert first.exit_code == 0, first.output
    again = run.invoke(main, ["chart", str(folder / "saved.toml"), "--out", str(folder / "b")])
    assert again.exit_code == 0, again.output
    assert (folder / "a/chart.png").read_bytes() == (folder / "b/chart.png").read_bytes()
    assert read_chart_png(folder / "b/chart.png").knot == "asymmetric"
    over = run.invoke(main, ["chart", str(folder / "saved.toml"), "--json", str(folder / "photo.png")])
    assert over.exit_code == 2
    assert "photo.png" in over.stderr


def test_a_recipe_is_not_saved_away_from_its_pictures(folder: Path, tmp_path: Path) -> None:
    command = ["chart", str(folder / "photo.png"), "--size", "30x45cm", "--json", str(tmp_path / "x.json")]
    (tmp_path / "other").mkdir()
    result = CliRunner().invoke(main, [*command, "--save-recipe", str(tmp_path / "other/saved.toml")])
    assert result.exit_code == 2
    assert "save the recipe in" in result.stderr
    assert not (tmp_path / "x.json").exists()


def test_a_drawn_border_round_a_photo_stays_as_it_is_drawn(folder: Path) -> None:
    """Patches are merged in the photo, never in the border; a named yarn is there whatever the rules take."""
    text = (
        'picture = "photo.png"\nsize = "40x56.8cm"\ncolours = 3\nleast_patch = 9\nedits = ["set 71,50 weld yellow"]\n'
    )
    text += '[[border]]\nyarn = "dark green"\nwidth = 2\n'
    tile = '[[border]]\ntile = "tile.png"\nadjust = true\n'
    chart = chart_order(order_of(folder, text + tile))[0].chart
    names = np.array([yarn.name for yarn in chart.yarns])[chart.knots]
    assert (names[:2] == "dark green").all()
    assert (names[:, -2:] == "dark green").all()
    assert chart.reading.kind == "photo"
    assert len(set(names[8:-8, 8:-8].ravel().tolist())) <= 3
    assert names[142 - 71, 49] == "weld yellow"
    dots = names[4:6, 8:-8] == names[4, 13]
    assert 0.15 < dots.mean() < 0.25
    assert (names[2:8] == names[2:8, ::-1]).all()
    assert len(chart.reading.differences) == len(chart.yarns) == 3


def test_an_oxs_chart_is_a_part_as_a_picture_is(folder: Path) -> None:
    made = chart_order(order_of(folder, FIELD))[0].chart
    knots = np.random.default_rng(2).integers(0, 4, (20, 30), dtype=np.uint8)
    write_chart_oxs(
        folder / "motif.oxs", replace(made, knots=knots, yarns=default_yarns()[:4], size=CarpetSize(0.12, 0.08))
    )
    chart = chart_order(order_of(folder, FIELD + '[[motif]]\npicture = "motif.oxs"\nposition = [1, 1]'))[0].chart
    names = np.array([yarn.name for yarn in chart.yarns])
    drawn = np.array([yarn.name for yarn in default_yarns()])[knots]
    assert chart.reading.kind == "exact"
    assert (names[chart.knots[-20:, :30]] == drawn).all()


def test_more_yarns_named_than_colours_is_an_error(folder: Path) -> None:
    text = FIELD + 'colours = 2\nedits = ["set 1,1 gold", "set 1,2 grey"]'
    with pytest.raises(IlmekError, match=r"carpet.toml: colours = 2, and 3 yarns are named: ivory, gold, grey"):
        chart_order(order_of(folder, text))


def test_a_yarn_that_is_replaced_everywhere_is_kept_in_place_of_the_new_one(folder: Path) -> None:
    """Terracotta has 192 knots of the tile; rose, which is near to it, does not take its place in the palette."""
    tile = Path(__file__).parents[2] / "examples/recipes/tiles/kazak-middle.png"
    shutil.copy(tile, folder / "middle.png")
    recipe = 'picture = "middle.png"\nsize = "73.6x48.8cm"\nquality = "25x25/dm"\ncolours = {}\nedits = ["{}"]'
    for colours in (4, 6, 8):
        chart = chart_order(order_of(folder, recipe.format(colours, "replace terracotta by rose")))[0].chart
        counts = {yarn.name: count for yarn, count in zip(chart.yarns, chart.counts, strict=True)}
        assert counts["rose"] == chart.reading.edited >= 192
        assert not counts.get("terracotta", 0)
    chart = chart_order(order_of(folder, recipe.format(8, "replace terracotta by rose in 1,1 61,184")))[0].chart
    assert 0 < chart.reading.edited < 192


def test_a_list_of_names_holds_names_with_commas(folder: Path) -> None:
    order = order_of(folder, FIELD + 'never = ["grey", "No. 7, blue"]')
    assert yarn_names("never", order.palette.never) == ("grey", "No. 7, blue")


def test_a_rule_of_the_palette_that_cannot_be_met_names_the_recipe_not_the_picture(folder: Path) -> None:
    with pytest.raises(IlmekError, match=r"carpet.toml: --keep: the list has no yarn 'golld'; did you mean 'gold'"):
        chart_order(order_of(folder, 'picture = "photo.png"\nsize = "40x60cm"\nkeep = "golld"'))


def test_half_knots_and_jufti_knots_are_marks_that_later_edits_drop(folder: Path) -> None:
    edits = [
        "half 1,1 rose",
        "half 2,2 rose",
        "replace rose by gold",
        "jufti 150,1 150,6",
        "set 150,4 gold",
        "set 2,2 rose",
    ]
    chart = chart_order(order_of(folder, FIELD + f"edits = {edits}"))[0].chart
    marks = {(mark.row, mark.column): (mark.kind, chart.yarns[mark.second].name) for mark in chart.overlay}
    assert marks[149, 0] == (HALF, "gold")
    assert {cell: kind for cell, (kind, _) in marks.items()} == {(149, 0): HALF, (0, 0): JUFTI, (0, 4): JUFTI}


def test_a_jufti_knot_on_two_yarns_is_an_error(folder: Path) -> None:
    with pytest.raises(IlmekError, match=r"line 3, edits.1: jufti 1,1: this cell and the next one are not of one yarn"):
        chart_order(order_of(folder, FIELD + "edits = ['set 1,1 rose', 'jufti 1,1']"))
