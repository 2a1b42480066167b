"""Sheets of own mechanisms as a toolmaker reads them: his twenty points, by readers of another make."""

import json
from pathlib import Path

import ezdxf
import pypdfium2 as pdfium
import pytest
from click.testing import CliRunner
from tests.unit.test_drawing_sheets import points_of

from ilmek.cli import main

EXAMPLES = Path(__file__).parents[2] / "examples"
NAMES = ("klann_leg", "quick_return", "slider_crank_press", "stephenson_dwell", "tufting_needle", "jansen_leg")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.one_in(3)
def test_a_toolmaker_finds_his_points_on_every_sheet(name: str, tmp_path: Path) -> None:
    folder = tmp_path / "parts"
    arguments = ["mechanism", str(EXAMPLES / f"{name}.toml"), "--workshop", str(folder), "--issue", "A,2026-11-30"]
    done = CliRunner().invoke(main, arguments)
    assert done.exit_code == 0, done.output
    index = json.loads((folder / "workshop.json").read_text(encoding="utf-8"))
    names = [entry["file"] for entry in index["files"] if entry["kind"] == "sheet"]
    book = pdfium.PdfDocument(folder / "drawings.pdf")
    pages = [book[number].get_textpage().get_text_range() for number in range(len(book))]
    assert len(names) > 10 or name == "slider_crank_press"
    for sheet, page in zip(names, pages[len(pages) - len(names) :], strict=True):
        document = ezdxf.readfile(folder / sheet)
        points = points_of(document, page.replace("\r", ""))
        missing = [point for point, there in points.items() if not there]
        assert len(missing) <= 1, f"{sheet}: {missing}"
        assert not document.audit().errors
