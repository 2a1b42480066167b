"""Numbers of the printed files in the digits of a script, read back by pypdf; symbols keep theirs."""

import re
from pathlib import Path

import numpy as np
import pypdf
import pytest
from click.testing import CliRunner

from ilmek.carpet.chart import Chart
from ilmek.cli import main
from ilmek.io.chart.pdf import write_chart_pdf
from ilmek.io.chart.printing import DIGITS, Printing
from ilmek.io.chart.rows_colours_pdf import write_colours_pdf
from ilmek.io.chart.rows_pdf import write_rows_pdf
from ilmek.io.chart.symbols import SYMBOLS
from ilmek.io.chart.wall import write_wall_pdf
from ilmek.io.yarn_file import read_yarns


@pytest.fixture
def chart(tmp_path: Path) -> Chart:
    """A chart with a yarn whose symbol is a digit."""
    path = tmp_path / "two.csv"
    place = SYMBOLS.index("7") + 1
    path.write_text(f"name,srgb,number\nlot 12,#93272c,{place}\nivory,#ebdcc3,3\n", encoding="utf-8")
    return Chart(np.indices((30, 40)).sum(0) // 5 % 2, read_yarns(path), "16x12cm", "25x25/dm", "symmetric")


def text_of(path: Path) -> str:
    return "\n".join(page.extract_text() for page in pypdf.PdfReader(path).pages)


@pytest.mark.parametrize("digits", DIGITS)
def test_all_numbers_and_no_symbols(chart: Chart, digits: str, tmp_path: Path) -> None:
    write_chart_pdf(tmp_path / "chart.pdf", chart, printing=Printing(digits))
    write_rows_pdf(tmp_path / "rows.pdf", chart, printing=Printing(digits))
    write_colours_pdf(tmp_path / "colours.pdf", chart, "both", 2, printing=Printing(digits))
    write_wall_pdf(tmp_path / "wall.pdf", chart, printing=Printing(digits))
    native = str.maketrans("0123456789", DIGITS[digits])
    for file, numbers in {
        "chart.pdf": ("30", "25", "1", "20"), "rows.pdf": ("30", "29", "40"), "colours.pdf": ("Row 30", "20"),
        "wall.pdf": ("30", "16 × 12 cm"),
    }.items():  # fmt: skip
        text = text_of(tmp_path / file)
        joined = re.sub(r"\s+", "", text)  # where the font changes pypdf begins a new line
        assert all(re.sub(r"\s+", "", number.translate(native)) in joined for number in numbers), file
        if digits != "latin":
            latin = set(re.findall(r"[0-9]+", text.replace("lot 12", "")))
            assert latin <= {run for run in latin if set(run) == {"7"}}, file
        assert "7" in text
        assert file == "wall.pdf" or "lot 12" in text or file == "rows.pdf"


def test_the_option(tmp_path: Path) -> None:
    picture = Path(__file__).parents[1] / "data" / "two-indices.bmp"
    made = CliRunner().invoke(main, ["chart", str(picture), "--digits", "fa", "--wall", "--out", str(tmp_path / "out")])
    assert made.exit_code == 0, made.stderr
    for file in ("chart.pdf", "rows.pdf", "wall.pdf"):
        assert "۳۶" in text_of(tmp_path / "out" / file), file
    wrong = CliRunner().invoke(main, ["chart", str(picture), "--digits", "roman"])
    assert wrong.exit_code == 2
    assert "latin" in wrong.stderr
