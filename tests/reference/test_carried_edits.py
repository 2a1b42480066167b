"""Edits on a carpet of another size: knots that were computed by hand, and areas that the picture itself shows."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from ilmek.carpet.chart import Chart
from ilmek.cli import main
from ilmek.jobs.chart import ChartResult, make_charted
from ilmek.jobs.order import read_order
from ilmek.jobs.recipe import chart_of_recipe, saved_recipe

RED, IVORY, NAVY = (158, 43, 37), (239, 230, 208), (27, 36, 66)


def charted(folder: Path, text: str, **options: str) -> ChartResult:
    (folder / "carpet.toml").write_text(text)
    return make_charted(read_order(folder / "carpet.toml", **options))


def tied_in(chart: Chart, yarn: str) -> set[tuple[int, int]]:
    """Rows and columns, as edits count them, of the knots of a yarn."""
    index = [one.name for one in chart.yarns].index(yarn)
    return {(chart.rows - row, column + 1) for row, column in np.argwhere(chart.knots == index).tolist()}


def block(rows: range, columns: range) -> set[tuple[int, int]]:
    return {(row, column) for row in rows for column in columns}


def recipe(layout: str, *lines: str, anchor: str = 'grid = "100x150"') -> str:
    """A recipe with edits that were made at 40 × 60 cm."""
    listed = "".join(f"    {line!r},\n" for line in lines)
    return f"{layout}\n[[edits]]\n{anchor}\nlines = [\n{listed}]\n"


STRIPE = 'plain = "ivory"\nsize = "60x90cm"\n[[border]]\nyarn = "dark red"\nwidth = 3\n'
# Field 94 x 144 knots of the old carpet, 144 x 219 of the new one: 1.532 and 1.521 times.


@pytest.mark.parametrize(
    ("line", "rows", "columns"),
    [
        ("set 1,1 gold", range(1, 2), range(1, 2)),  # a corner stays a corner
        ("set 150,100 gold", range(225, 226), range(150, 151)),
        ("set 2,50 gold", range(2, 3), range(74, 76)),  # in depth by the breadth, along 73.5 to 75.0 by the field
        ("set 75,50 gold", range(112, 114), range(74, 76)),
        ("set 4,4 gold", range(4, 6), range(4, 6)),  # the lower left knot of the field, 1.53 x 1.52 knots
        ("line 4,10 4,20 gold", range(4, 6), range(13, 30)),  # 9.19 to 26.04 knots from the field's left edge
    ],
)
def test_knots_by_hand(tmp_path: Path, line: str, rows: range, columns: range) -> None:
    assert tied_in(charted(tmp_path, recipe(STRIPE, line)).chart, "gold") == block(rows, columns)


def tile(folder: Path) -> None:
    pixels = np.full((6, 10, 3), RED, dtype=np.uint8)
    pixels[2:4, 4:6] = IVORY
    Image.fromarray(pixels).save(folder / "tile.png")


@pytest.mark.parametrize(("column", "found"), [(3, 3), (48, 48), (53, 63), (98, 108)])
def test_tiles_are_counted_from_the_nearer_edge(tmp_path: Path, column: int, found: int) -> None:
    """Ten tiles became eleven: the left five are counted from the left, the right five from the right."""
    tile(tmp_path)
    layout = 'plain = "ivory"\nsize = "44x60cm"\n[repeat]\ntile = "tile.png"\n'
    assert tied_in(charted(tmp_path, recipe(layout, f"set 5,{column} gold")).chart, "gold") == {(5, found)}


def test_a_row_of_tiles_keeps_its_shift(tmp_path: Path) -> None:
    """In brick order: the knot has the same place in its tile, that is on the same drawn colour, at every size."""
    tile(tmp_path)
    layout = 'plain = "navy"\nsize = "{}"\n[repeat]\ntile = "tile.png"\norder = "brick"\n'.replace(
        "navy", "indigo navy"
    )
    for row in (9, 147):  # row 9 lies in a shifted row of tiles
        line = f"set {row},16 {row},11 gold"
        first = charted(tmp_path, recipe(layout.format("40x60cm"), line)).chart
        plain = charted(tmp_path, layout.format("40x60cm")).chart
        drawn = [plain.yarns[plain.knots[150 - row, column - 1]].name for column in (11, 16)]
        for size in ("44x62.4cm", "52x69.6cm"):
            other, bare = (charted(tmp_path, text.format(size)).chart for text in (recipe(layout, line), layout))
            places = sorted(tied_in(other, "gold"))
            assert len(places) == len(tied_in(first, "gold"))
            assert [bare.yarns[bare.knots[bare.rows - at[0], at[1] - 1]].name for at in places] == drawn


MOTIF = 'plain = "ivory"\nsize = "{}"\n[[motif]]\npicture = "tile.png"\nposition = "{}"\n'


def test_a_motif_takes_its_edits_along(tmp_path: Path) -> None:
    """The motif of 10 × 6 knots stands from column 46 and row 73, then from column 71 and row 111."""
    tile(tmp_path)
    text = recipe(MOTIF.format("60x90cm", "centre"), "set 73,46 gold", "set 78,55 gold")
    at = tied_in(charted(tmp_path, text).chart, "gold")
    assert at == {(111, 71), (116, 80)}


def test_edits_on_a_motif_are_in_each_of_its_copies(tmp_path: Path) -> None:
    tile(tmp_path)
    for size, rows, columns in (("40x60cm", 150, 100), ("28x36cm", 90, 70)):
        text = recipe(MOTIF.format(size, "corners"), "set 6,1 gold", "fill 4,5 rose", anchor='on = "motif 1"')
        chart = charted(tmp_path, text).chart
        assert tied_in(chart, "gold") == {(1, 1), (1, columns), (rows, 1), (rows, columns)}
        assert len(tied_in(chart, "rose")) == 4 * 4


def drawing(folder: Path) -> None:
    """A drawing with a red block and one of navy, not in its middle."""
    pixels = np.full((180, 120, 3), IVORY, dtype=np.uint8)
    pixels[40:80, 30:60] = RED
    pixels[120:130, 80:100] = NAVY
    Image.fromarray(pixels).save(folder / "drawing.png")


@pytest.mark.parametrize("size", ["160x240cm", "80x90cm", "60x120cm", "20x30cm", "33x47cm"])
@pytest.mark.parametrize("anchor", ["carpet", "picture"])
def test_a_fill_finds_its_area_at_every_size_and_crop(tmp_path: Path, size: str, anchor: str) -> None:
    """The judge is the drawing: what was red is gold, what was navy is rose, and nothing else."""
    drawing(tmp_path)
    layout = f'picture = "drawing.png"\nsize = "{size}"\nread = "flat"\n'
    plain = charted(tmp_path, layout).chart
    names = [yarn.name for yarn in plain.yarns]
    red = plain.knots[plain.rows * 60 // 180, plain.columns * 45 // 120]
    navy = names.index("indigo navy")
    lines = {
        # 80 x 120 cm: 200 x 300 knots, 0.6 pixels each; row 200 is 60 pixels from the top
        "carpet": recipe(layout, "fill 200,75 gold", "fill 92,150 rose", anchor='grid = "200x300"'),
        "picture": recipe(layout, "fill 120,45 gold", "fill 55,90 rose", anchor='on = "picture"\ngrid = "120x180"'),
    }
    made = charted(tmp_path, lines[anchor])
    edited = [made.chart.yarns[knot].name for knot in made.chart.knots.ravel()]
    expected = [{int(red): "gold", navy: "rose"}.get(int(knot), names[knot]) for knot in plain.knots.ravel()]
    assert edited == expected
    assert all(check.ok for check in made.checks)


def test_a_fill_on_the_half_of_a_mirrored_picture(tmp_path: Path) -> None:
    drawing(tmp_path)
    layout = 'picture = "drawing.png"\nmirror = "across"\nsize = "{}"\nread = "flat"\n'
    line = {"anchor": 'on = "picture"\ngrid = "120x180"'}
    for size in ("80x60cm", "160x120cm"):
        chart = charted(tmp_path, recipe(layout.format(size), "fill 120,45 gold", **line)).chart
        plain = charted(tmp_path, layout.format(size)).chart
        gold = [yarn.name for yarn in chart.yarns].index("gold")
        assert np.array_equal(chart.knots == gold, (chart.knots == gold)[:, ::-1])
        red = plain.knots[plain.rows * 60 // 180, plain.columns * 45 // 240]
        assert np.array_equal(chart.knots == gold, plain.knots == red)


@pytest.mark.parametrize("size", ["160x240cm", "40x60cm"])
def test_a_size_beside_the_recipe_carries_edits_without_a_grid(tmp_path: Path, size: str) -> None:
    """They count the knots of the carpet that the file states."""
    drawing(tmp_path)
    text = 'picture = "drawing.png"\nsize = "80x120cm"\nread = "flat"\nedits = ["fill 200,75 gold"]\n'
    at_home, made = charted(tmp_path, text).chart, charted(tmp_path, text, size=size)
    away = made.chart
    assert any('write [[edits]] with grid = "200x300"' in note for note in made.notes)
    times = away.rows / at_home.rows
    assert len(tied_in(away, "gold")) == pytest.approx(len(tied_in(at_home, "gold")) * times * times, rel=0.05)


def results(folder: Path, text: str, *options: str) -> tuple[int, dict[str, Any]]:
    (folder / "carpet.toml").write_text(text)
    done = CliRunner().invoke(main, ["chart", str(folder / "carpet.toml"), *options, "--json", "-"])
    return done.exit_code, json.loads(done.stdout)


SMALL = 'picture = "drawing.png"\nsize = "20x30cm"\nread = "flat"\n'


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        (SMALL + 'edits = ["set 156,88 gold"]\n', "knot 156,88 lies outside the carpet; it states no grid"),
        (recipe(SMALL, "set 156,88 gold", anchor='grid = "200x300"'), "it is smaller than a knot there"),
        (
            recipe(SMALL, "set 156,88 gold", anchor='on = "knots"\ngrid = "200x300"'),
            "its knots are those of a carpet of 200x300 knots",
        ),
        (
            recipe(
                'picture = "drawing.png"\nsize = "80x60cm"\nread = "flat"\n',
                "set 299,9 gold",
                anchor='grid = "200x300"',
            ),
            "the carpet shows nothing of its place",
        ),
    ],
)
def test_what_has_no_place_is_left_out_with_a_list_and_never_the_chart(tmp_path: Path, text: str, reason: str) -> None:
    drawing(tmp_path)
    code, answer = results(tmp_path, text)
    made = answer["results"]
    (edit,) = made["edits"]
    assert (code, made["edited_knots"], edit["knots"], edit["rows"]) == (3, 0, 0, None)
    assert edit["reason"] == reason
    failed = [check for check in answer["checks"] if not check["ok"]]
    assert [(check["name"], check["value"]) for check in failed] == [("recipe: edits left out, whole or in part", 1.0)]
    assert any(reason in note and edit["edit"] in note for note in answer["notes"])


def test_a_part_of_an_edit_that_has_no_place_is_counted(tmp_path: Path) -> None:
    """At half the size a knot is smaller than a knot, and two side by side are a half."""
    drawing(tmp_path)
    layout = 'picture = "drawing.png"\nsize = "40x60cm"\nread = "flat"\n'
    code, answer = results(tmp_path, recipe(layout, "set 10,11 10,12 50,51 gold", anchor='grid = "200x300"'))
    (edit,) = answer["results"]["edits"]
    assert (code, edit["details"], edit["left_out"], edit["rows"], edit["columns"]) == (3, 2, 1, [5, 5], [6, 6])
    assert edit["lost"] == pytest.approx(1 / 3)
    told = "left out of it: 1 of 2 details, 33.3% of its knots: it is smaller than a knot there"
    assert any(note.endswith(told) for note in answer["notes"])


@pytest.mark.parametrize(
    ("line", "lost"),
    [
        ("line 150,1 150,200 gold", 0.25),  # columns 26 to 175 are shown, 150 of 200
        ("replace ivory by gold in 1,1 300,40", 25 / 40),
        ("mirror across in 100,11 110,50", 30 / 40),  # about column 30.5: 26 to 35 have both halves
        ("border 1 gold in 100,20 109,29", 20 / 36),  # the left side, and 5 knots more of two others
        ("copy 100,20 109,29 to 50,100", 0.6),
        ("fill 200,20 gold", None),
    ],
)
def test_what_is_cropped_is_told_in_percent_and_fails_a_check(tmp_path: Path, line: str, lost: float | None) -> None:
    """A drawing of 2 : 3 on a carpet of 1 : 2, on which a quarter of its width is cropped."""
    drawing(tmp_path)
    layout = 'picture = "drawing.png"\nsize = "60x120cm"\nread = "flat"\n'
    code, answer = results(tmp_path, recipe(layout, line, anchor='grid = "200x300"'))
    (edit,) = answer["results"]["edits"]
    if lost is None:  # the ground: what is cropped of the drawing, but for its red and navy parts
        pixels = np.asarray(Image.open(tmp_path / "drawing.png"))
        ground = (pixels == IVORY).all(axis=-1)
        lost = 1 - np.count_nonzero(ground[:, 15:105]) / np.count_nonzero(ground)
    assert edit["lost"] == pytest.approx(lost, abs=0.006)
    assert (code, edit["reason"]) == (3, "the carpet does not show all of its place")
    assert any("left out of it" in note and f"{100 * edit['lost']:.3g}%" in note for note in answer["notes"])


def test_half_knots_and_jufti_knots_are_carried(tmp_path: Path) -> None:
    layout = 'plain = "ivory"\nsize = "80x120cm"\n'
    chart = charted(tmp_path, recipe(layout, "half 12,40 gold", "jufti 30,20")).chart
    halves = {(chart.rows - mark.row, mark.column + 1) for mark in chart.overlay if mark.kind == 1}
    juftis = {(chart.rows - mark.row, mark.column + 1) for mark in chart.overlay if mark.kind == 2}
    assert halves == block(range(23, 25), range(79, 81))
    assert juftis == {(row, column) for row in (59, 60) for column in (39, 41)}


def test_a_saved_recipe_states_the_grid_and_is_the_same_carpet(tmp_path: Path) -> None:
    drawing(tmp_path)
    text = 'picture = "drawing.png"\nsize = "80x120cm"\nread = "flat"\nedits = ["fill 200,75 gold", "set 9,9 rose"]\n'
    (tmp_path / "carpet.toml").write_text(text)
    for size, grid in ((None, "200x300"), ("160x240cm", "200x300")):
        order = read_order(tmp_path / "carpet.toml", size=size)
        made = chart_of_recipe(order)
        saved = saved_recipe(made.order, made.chart, tmp_path)
        assert f'[[edits]]\ngrid = "{grid}"' in saved
        (tmp_path / "saved.toml").write_text(saved)
        again = chart_of_recipe(read_order(tmp_path / "saved.toml"))
        assert np.array_equal(again.chart.knots, made.chart.knots)
        assert not any("without a grid" in note for note in again.notes)
