"""Names of yarns in all scripts on the printed pages, judged by pypdf (the text) and by fontTools (the glyphs)."""

import re
from pathlib import Path

import numpy as np
import pypdf
import pytest
from fontTools.ttLib import TTFont
from reportlab.pdfbase import pdfmetrics

from ilmek.carpet.chart import Chart
from ilmek.io.chart import lettering
from ilmek.io.chart.pdf import write_chart_pdf
from ilmek.io.chart.rows_colours_pdf import write_colours_pdf
from ilmek.io.chart.rows_pdf import write_rows_pdf
from ilmek.io.chart.symbols import ARABIC, DEVANAGARI, HEBREW
from ilmek.io.yarn_file import read_yarns
from ilmek.viz.font import FONTS

DATA = Path(__file__).parents[1] / "data"
LISTS = {
    "names.csv": (DATA / "names.csv").read_text(encoding="utf-8"),
    "bazaar.csv": "name,srgb\nسرمه\u200cای (نیلی),#1e2f52\nأحمر قرمزي,#ad4430\n"
    "گہرا نیلا ٹھوس,#304a7a\nאדום לכיש,#8a2030\n",
    "east.csv": "name,srgb\nगहरा लाल क्ष,#a03020\n茜色の羊毛,#b04050\n자주색 양모,#7a3060\n朱紅,#c03020\n",
}


@pytest.fixture(params=LISTS)
def chart(request: pytest.FixtureRequest, tmp_path: Path) -> Chart:
    """A small chart with every yarn of a list."""
    path = tmp_path / request.param
    path.write_text(LISTS[request.param], encoding="utf-8")
    yarns = read_yarns(path)
    knots = np.arange(100).reshape(10, 10) % len(yarns)
    return Chart(knots, yarns, "4x4cm", "25x25/dm", "symmetric")


def words(text: str) -> set[str]:
    return set(re.findall(r"[\w\u200c]+", text))


@pytest.mark.parametrize("kind", ["chart", "rows", "colours"])
def test_names_are_read_back(chart: Chart, kind: str, tmp_path: Path) -> None:
    file = tmp_path / "made.pdf"
    if kind == "chart":
        write_chart_pdf(file, chart)
    elif kind == "rows":
        write_rows_pdf(file, chart)
    else:
        write_colours_pdf(file, chart, "both", 1)
    text = "\n".join(page.extract_text() for page in pypdf.PdfReader(file).pages[:2])
    for yarn in chart.yarns:
        assert words(yarn.name) <= words(text), yarn.name


@pytest.mark.parametrize(
    "text", [yarn for rows in LISTS.values() for yarn in re.findall(r"^(?!name)(.+),#", rows, re.MULTILINE)]
)
def test_no_glyph_is_a_box(text: str) -> None:
    assert not lettering.missing_letters(text)
    for part in lettering._parts(text):
        glyphs = [pdfmetrics.getFont(part.font).face.charToGlyph[ord(code)] for code in part.glyphs]
        assert min(glyphs) > 0


def forms(font: TTFont, feature: str) -> dict[str, str]:
    """The single substitutions of a feature of a font."""
    table = font["GSUB"].table
    numbers = {
        n for row in table.FeatureList.FeatureRecord if row.FeatureTag == feature for n in row.Feature.LookupListIndex
    }
    found: dict[str, str] = {}
    for number in numbers:
        for sub in table.LookupList.Lookup[number].SubTable:
            found |= getattr(getattr(sub, "ExtSubTable", sub), "mapping", {})
    return found


@pytest.mark.parametrize("letter", "بپسعفگکيہھٹ")
def test_letters_join_from_right_to_left(letter: str) -> None:
    """Three letters: final, medial and initial form from left to right, as the tables of the font have them."""
    font = TTFont(FONTS / "NotoNaskhArabic-Regular.ttf")
    plain = font.getBestCmap()[ord(letter)]
    (part,) = lettering._parts(letter * 3)
    face = pdfmetrics.getFont(ARABIC).face
    drawn = [font.getGlyphName(face.charToGlyph[ord(code)]) for code in part.glyphs]
    expected = [forms(font, feature).get(plain, plain) for feature in ("fina", "medi", "init")]
    assert drawn == expected
    assert len(set(drawn)) == 3


def test_fonts_of_scripts() -> None:
    fonts = {part.font for part in lettering._parts("سرمه क्ष אדום 12")}
    assert {ARABIC, DEVANAGARI, HEBREW} <= fonts
    (conjunct,) = lettering._parts("क्ष")
    assert len(conjunct.glyphs) == 1  # one conjunct of three characters


def test_width_is_the_sum_of_the_advances() -> None:
    assert lettering.line_width("madder", 9.0) == pytest.approx(pdfmetrics.stringWidth("madder", "ilmek-text", 9.0))
    assert lettering.line_width("لاکی", 18.0) == pytest.approx(2 * lettering.line_width("لاکی", 9.0))


@pytest.mark.parametrize(
    "name", ["a long name of a yarn 2026/11-A", "یک نام بسیار بلند برای نخ پشم", "羊毛白羊毛白羊毛白羊毛白"]
)
def test_long_names_are_cut_in_the_middle(name: str) -> None:
    room = 0.6 * lettering.line_width(name, 6.0)
    shown = lettering.cut_line(name, 6.0, room)
    assert lettering.line_width(shown, 6.0) <= room
    assert shown[0] == name[0]
    assert shown[-1] == name[-1]
    assert "…" in shown
