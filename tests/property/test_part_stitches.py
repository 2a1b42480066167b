"""Part stitches of cross-stitch charts are half knots, and cells without a stitch are told, never tied in silence."""

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.carpet.cells import PLAIN
from ilmek.carpet.chart import Chart
from ilmek.carpet.overlay import HALF, KnotMark, overlay_of
from ilmek.cli import main
from ilmek.errors import CarpetError, PictureError
from ilmek.io.chart.oxs import write_chart_oxs
from ilmek.io.chart.oxs_reading import read_chart_oxs
from ilmek.io.yarn_file import default_yarns

DATA = Path(__file__).parents[1] / "data"
CASE = DATA / "part-stitches.oxs"
COLOURS = {1: "2C3225", 2: "A26D20", 3: "F0E8D0"}


def oxs(columns: int, rows: int, stitches: str, parts: str) -> str:
    items = "".join(f'<palette_item index="{n}" name="thread {n}" color="{code}"/>' for n, code in COLOURS.items())
    return (
        f'<chart><properties chartwidth="{columns}" chartheight="{rows}"/><palette>'
        f'<palette_item index="0" name="cloth"/>{items}</palette>'
        f"<fullstitches>{stitches}</fullstitches><partstitches>{parts}</partstitches></chart>"
    )


def tied(chart: Chart) -> list[list[tuple[str, str]]]:
    """The colours on the left and right warp of each cell."""
    seconds = {(mark.row, mark.column): mark.second for mark in chart.overlay if mark.kind == HALF}
    return [
        [(chart.yarns[yarn].hex, chart.yarns[seconds.get((row, column), yarn)].hex) for column, yarn in enumerate(line)]
        for row, line in enumerate(chart.knots.tolist())
    ]


def bare_part(left: int, right: int) -> str:
    """What of a cell has no stitch."""
    return "" if left and right else "half" if left or right else "whole"


CELLS = st.tuples(st.integers(0, 3), st.integers(0, 4), st.integers(0, 3), st.integers(0, 3))


@given(st.lists(CELLS, min_size=12, max_size=12), st.sampled_from(["#ffffff", "#a26d20", "#123456"]))
@settings(max_examples=100, deadline=None)
def test_each_half_of_a_cell_has_the_colour_of_its_stitch(
    tmp_path_factory: pytest.TempPathFactory, cells: list[tuple[int, int, int, int]], ground: str
) -> None:
    """Any mixture of full, three-quarter and half stitches; expected: by the words of the format's specification."""
    full, part, expected = "", "", []
    for place, (whole, direction, one, two) in enumerate(cells):
        y, x = divmod(place, 4)
        full += f'<stitch x="{x}" y="{y}" palindex="{whole}"/>'
        left = right = whole
        if direction:
            part += f'<partstitch x="{x}" y="{y}" palindex1="{one}" palindex2="{two}" direction="{direction}"/>'
            left, right = (one or left, two or right) if direction < 3 else (one or left, one or right)
        shown = {0: ground, **{n: f"#{code.lower()}" for n, code in COLOURS.items()}}
        expected.append((shown[left], shown[right], bare_part(left, right)))
    path = tmp_path_factory.mktemp("parts") / "design.oxs"
    path.write_text(oxs(4, 3, full, part), encoding="utf-8")
    chart, _ = read_chart_oxs(path, ground=ground)
    assert [cell for line in tied(chart) for cell in line] == [(left, right) for left, right, _ in expected]
    bare, halves = sum(bool(one) for *_, one in expected), sum(one == "half" for *_, one in expected)
    if halves:
        with pytest.raises(PictureError, match=f"{halves} of its 12 cells have a stitch on one half"):
            read_chart_oxs(path)
    elif bare == 12:
        with pytest.raises(CarpetError, match="without a knot"):
            read_chart_oxs(path)
    elif bare:
        chart, notes = read_chart_oxs(path)
        assert chart.cells is not None
        assert np.flatnonzero(chart.cells.are(PLAIN)).tolist() == [at for at, one in enumerate(expected) if one[2]]
        assert "flat weave" in notes[0]


def test_the_case_of_another_program() -> None:
    flat, about = read_chart_oxs(CASE)
    assert flat.cells is not None
    assert (flat.cells.number(PLAIN), flat.tied.whole, flat.tied.half) == (42, (2, 3), (1, 1))
    assert "42 cells without a stitch: flat weave; --ground makes them knots" in about
    chart, notes = read_chart_oxs(CASE, ground="#ffffff")
    assert list(chart.overlay) == [KnotMark(4, 4, HALF, 1)]
    assert chart.yarns[chart.knots[4, 4]].name == "DMC 310 Black"
    assert chart.yarns[1].name == "DMC 321 Red"
    assert {yarn.name for yarn in chart.yarns} == {"DMC 310 Black", "DMC 321 Red", "ground"}
    assert chart.tied.whole == (2, 3, 42)
    assert "part" not in notes[0]


def test_the_command_says_what_to_do() -> None:
    flat = CliRunner().invoke(main, ["chart", str(CASE), "--json", "-"])
    assert flat.exit_code == 0, flat.stderr
    assert '"knots": 6,' in flat.stdout
    made = CliRunner().invoke(main, ["chart", str(CASE), "--ground", "#ffffff", "--json", "-"])
    assert made.exit_code == 0, made.stderr
    assert '"half_knots": 2' in made.stdout


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=20, deadline=None)
def test_half_knots_come_back_and_other_programs_see_them(tmp_path_factory: pytest.TempPathFactory, seed: int) -> None:
    rng = np.random.default_rng(seed)
    knots = rng.integers(0, 4, (6, 8), dtype=np.uint8)
    places = rng.permutation(48)[:9].tolist()
    marks = [KnotMark(place // 8, place % 8, HALF, (int(knots.flat[place]) + 1) % 4) for place in places]
    made = Chart(knots, default_yarns()[:4], "4x3cm", "20x20/dm", "symmetric", overlay=overlay_of(marks))
    path = tmp_path_factory.mktemp("halves") / "chart.oxs"
    write_chart_oxs(path, made)
    back, notes = read_chart_oxs(path)
    assert (back.overlay.equals(made.overlay), np.array_equal(back.knots, knots), notes) == (True, True, ())
    root = ET.parse(path).getroot()
    assert len(root.findall(".//stitch")) == 48 - len(marks)
    seen = {
        (int(one.get("y")), int(one.get("x"))): (one.get("palindex1"), one.get("palindex2"))
        for one in root.iter("partstitch")
    }  # type: ignore[arg-type]
    assert seen == {(m.row, m.column): (str(knots[m.row, m.column] + 1), str(m.second + 1)) for m in marks}
    for facts in root.iter("ilmek"):  # another program leaves ilmek's own data out
        facts.attrib.clear()
    ET.ElementTree(root).write(path)
    assert tied(read_chart_oxs(path)[0]) == tied(made)
