"""The rows among the files of `ilmek chart`: written, left out with a note, and the same chart as chart.png."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from benchmarks.rows_reading import read_rows
from click.testing import CliRunner
from pypdf import PdfReader

from ilmek.cli import main
from ilmek.io.chart import wall
from ilmek.io.chart.png import read_chart_png
from ilmek.io.chart.symbols import symbols
from ilmek.jobs import rows as rows_job

MEDALLION = str(Path(__file__).parents[2] / "examples" / "medallion.png")


def chart(folder: Path, *options: str) -> tuple[Any, str, set[str]]:
    words = ["chart", MEDALLION, "--size", "20x30cm", "--quality", "20x20/dm", "--out", str(folder), "--json", "-"]
    result = CliRunner().invoke(main, [*words, *options])
    assert result.exit_code in (0, 3), result.stderr
    names = {path.name for path in folder.iterdir()} - {".ilmek"}
    found = json.loads(result.stdout)
    assert names == {Path(file).name for file in found["files"]}
    return found, result.stderr, names


def test_rows_are_written_by_default_and_are_the_chart(tmp_path: Path) -> None:
    found, _, names = chart(tmp_path / "out")
    assert {"rows.txt", "rows.pdf"} <= names
    assert "wall.pdf" not in names
    read, made = read_rows(tmp_path / "out/rows.txt"), read_chart_png(tmp_path / "out/chart.png")
    assert np.array_equal(read.knots, made.knots)
    assert read.names == tuple(yarn.name for yarn in made.yarns)
    assert (found["half_knots"], found["jufti_knots"]) == (0, 0)
    assert {name: found["parameters"][name] for name in ("rows", "rows_direction", "wall")} == {
        "rows": None,
        "rows_direction": "both",
        "wall": False,
    }


def test_rows_by_colours_and_no_rows(tmp_path: Path) -> None:
    _, _, names = chart(tmp_path / "colours", "--rows", "colours", "--rows-direction", "alternate")
    assert {"rows.txt", "rows.pdf"} <= names
    read = read_rows(tmp_path / "colours/rows.txt")
    assert (read.split, read.direction) == ("colours", "alternate")
    assert np.array_equal(read.knots, read_chart_png(tmp_path / "colours/chart.png").knots)
    _, said, names = chart(tmp_path / "none", "--rows", "none")
    assert not {"rows.txt", "rows.pdf"} & names
    assert "rows" not in said
    _, _, names = chart(tmp_path / "text", "--no-pdf")
    assert "rows.txt" in names
    assert not {"rows.pdf", "chart.pdf"} & names


def test_what_is_left_out_is_noted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rows_job, "MOST_ROW_KNOTS", 100)
    _, said, names = chart(tmp_path / "many")
    assert "the rows of 2,400 knots are left out; --rows runs writes them" in said
    assert "rows.txt" not in names
    monkeypatch.setattr(rows_job, "MOST_SHEETS", 1)
    monkeypatch.setattr(rows_job, "MOST_PRINTED", 2)
    for split in ("runs", "colours"):
        _, said, names = chart(tmp_path / split, "--rows", split)
        assert "rows.pdf would have more than 2 pages and is left out; at most 2 are written" in said
        assert "rows.txt" in names
        assert "rows.pdf" not in names


def test_the_wall_chart_is_one_page_of_the_whole_chart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _, said, names = chart(tmp_path / "out", "--wall")
    assert "wall.pdf" in names
    reader = PdfReader(tmp_path / "out/wall.pdf")
    made = read_chart_png(tmp_path / "out/chart.png")
    (page,) = reader.pages
    sheet = wall.wall_sheet(made)
    assert [float(side) for side in page.mediabox[2:]] == pytest.approx([sheet.width, sheet.height], abs=0.01)
    assert f"wall.pdf is {100 * sheet.lengths[0]:.1f} × {100 * sheet.lengths[1]:.1f} cm" in said
    shown: list[str] = []

    def visit(text: str, cm: list[float], tm: list[float], font: object, size: float) -> None:
        if isinstance(font, dict) and "Mono" in str(font.get("/BaseFont", "")) and 5.0 < size < 6.0:
            shown.append(text)

    text = page.extract_text(visitor_text=visit)
    signs = "".join("".join(shown).split())
    assert {sign: signs.count(sign) for sign in set(signs)} == {
        sign: count for sign, count in zip(symbols(made.yarns), made.counts, strict=True) if count
    }
    assert all(made.yarns[yarn].name in text for yarn in made.used)
    assert "60" in text
    assert page.user_unit == 1
    monkeypatch.setattr(wall, "MOST_UNITS", 300)
    wall.write_wall_pdf(tmp_path / "small.pdf", made)
    (small,) = PdfReader(tmp_path / "small.pdf").pages
    assert small.user_unit == 3
    assert float(small.mediabox[2]) * 3 == pytest.approx(sheet.width, abs=0.01)
