"""Formats of the chart are one table: a format that a test adds by one row is charted, called, read and taken."""

import json
import shutil
from pathlib import Path

import pytest
from processes import ended, python

from ilmek.errors import CarpetError, OutputError
from ilmek.io.chart.formats import FORMATS, format_by_ending, format_of
from ilmek.jobs.carpet_files import FILES
from ilmek.jobs.order import GROUPS
from ilmek.params import declared

ONE_ROW = """
import json, sys
from pathlib import Path
import numpy as np
from ilmek.carpet.chart import Chart
from ilmek.carpet.yarn import Yarn
from ilmek.io.chart import formats

def write(path, chart, progress):
    yarns = [[yarn.name, yarn.srgb, yarn.lab, None, 1, None, yarn.number] for yarn in chart.yarns]
    data = [chart.knots.tolist(), yarns, str(chart.size), str(chart.quality), chart.knot]
    path.write_text("weave " + json.dumps(data), encoding="utf-8")

def read(path, size, quality, progress, ground):
    knots, yarns, *rest = json.loads(path.read_text(encoding="utf-8").removeprefix("weave "))
    return Chart(np.array(knots), [Yarn(*yarn) for yarn in yarns], *rest), ("of a test",)

formats.FORMATS["knots"] = formats.ChartFormat(
    "knots", "the chart of a test", "a chart of numbers", write, lambda begin: begin.startswith(b"weave "), read,
    picture=False, most=5000,
)
"""
"""A format in a file of its own, and its row."""


USED = """
import contextlib, io
import ilmek
from ilmek.cli import main
from ilmek.jobs.recipe import picture_pixels
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.project.pictures import UploadRequest, upload_picture
from ilmek.progress import SILENT

def printed(*arguments):
    with contextlib.redirect_stdout(io.StringIO()) as shown:
        main([*arguments], standalone_mode=False)
    return shown.getvalue()

less = ("--no-pdf", "--rows", "none")
printed("chart", "medallion.png", "--size", "20x30cm", "--quality", "10x10/dm", *less, "--knots", "--out", "first")
printed("chart", "first/chart.knots", *less, "--out", "second")
Path("carpet.toml").write_text("picture = 'medallion.png'\\nsize = '20x30cm'\\nquality = '10x10/dm'\\nknots = true")
printed("chart", "carpet.toml", "--out", "third")
chart = ilmek.read_chart("first/chart.knots")
ilmek.write_chart("again.knots", chart)
Path("project").mkdir()
upload = UploadRequest("drawn by hand.dat", Path("again.knots").read_bytes())
print(json.dumps({
    "option": "--knots" in printed("chart", "--help"),
    "same knots": np.array_equal(chart.knots, ilmek.read_chart("first/chart.png").knots),
    "same calls": printed("call", "first/chart.knots") == printed("call", "first/chart.png") != "",
    "upload": upload_picture(upload, Context("project")).path,
    "tile": picture_pixels(Path("again.knots"), 1, SILENT)[0].shape,
}))
"""
"""The format as every user of the table sees it."""


def test_a_format_is_one_row(tmp_path: Path) -> None:
    shutil.copy(Path(__file__).parents[2] / "examples/medallion.png", tmp_path)
    shown = ended(python("-c", ONE_ROW + USED), cwd=tmp_path)
    assert shown.returncode == 0, shown.stderr
    assert json.loads(shown.stdout) == {
        "option": True,
        "same knots": True,
        "same calls": True,
        "upload": "pictures/drawn-by-hand.knots",
        "tile": [30, 20, 3],
    }
    first, second = (json.loads((tmp_path / name / "chart.json").read_text()) for name in ("first", "second"))
    assert (second["reading"], second["knots"]) == ("exact", 600)
    assert "of a test" in second["notes"]
    assert [yarn["knots"] for yarn in first["yarn"]] == [yarn["knots"] for yarn in second["yarn"]]
    assert "the chart of a test" in (tmp_path / "first/report.html").read_text(encoding="utf-8")
    written = [(tmp_path / name / "chart.knots").read_bytes() for name in ("first", "third")]
    assert written == [(tmp_path / "again.knots").read_bytes()] * 2


@pytest.mark.parametrize("name", FORMATS)
def test_options_and_notes_follow_from_the_table(name: str) -> None:
    row = FORMATS[name]
    assert [note.meaning for note in FILES if note.name == row.file] == [row.note]
    assert (name in {parameter.name for parameter in declared(GROUPS["files"])}) == row.by_option
    assert format_by_ending(Path(f"a{row.suffix.upper()}")) is row


def test_another_ending_and_another_file_are_none_of_them(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"one of \.png, \.bmp, \.tiff, \.oxs, \.wif, \.pdf"):
        format_by_ending(Path("chart.jpg"))
    (tmp_path / "a.png").write_bytes(b"GIF89a")
    assert format_of(tmp_path / "a.png") is None
    assert format_of(tmp_path / "missing.png") is None
    assert format_of(tmp_path / "missing.oxs") is FORMATS["oxs"]


def test_too_many_knots_are_refused_by_the_row() -> None:
    FORMATS["png"].require(10**9)
    with pytest.raises(CarpetError, match="--oxs: the chart has 4,000,001 knots; at most 4,000,000"):
        FORMATS["oxs"].require(4_000_001)
