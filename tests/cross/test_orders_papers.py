"""Mounting sheet and wages in the languages of weavers, as another library reads them back."""

import re
from pathlib import Path

import numpy as np
import pypdfium2
import pytest

from ilmek.carpet.chart import Chart
from ilmek.carpet.mounting import mounting
from ilmek.carpet.price_rules import WageRules
from ilmek.io.chart.legend import mounting_lines
from ilmek.io.selling.mounting_sheet import write_mounting
from ilmek.io.selling.wage_sheet import WageSheet, write_wages
from ilmek.io.yarn_file import default_yarns
from ilmek.sentences import LANGUAGES, WEAVERS, Name, catalogue_of, in_language

FOREIGN = [language for language in WEAVERS if language not in LANGUAGES]
CHART = Chart(np.zeros((75, 50), np.uint8), default_yarns()[:2], "20x30cm", "25x25/dm", "symmetric")


NAME = Name("A 12")
"""A name keeps its digits, those of a word of digits alone too."""


def bare(text: str) -> str:
    """Without blanks, brackets, which a right to left line mirrors, and what a shaping leaves out."""
    return re.sub(r"[\s\u200c\u202f\ufffe\u00a0()]", "", text)


def papers(language: str, folder: Path) -> list[str]:
    rules = WageRules(3.2, 1000, 1, 0.02, 0.2, 25)
    sheet = WageSheet(rules, "﷼", 75, 2, rules.payments([(0, 50)] * 5 + [(50, 0)] * 70, 2), 30)
    with in_language(language):
        write_mounting(folder / "mounting.pdf", NAME, CHART, mounting(CHART))
        write_wages(folder / "wages.pdf", NAME, sheet)
    return [
        "\n".join(page.get_textpage().get_text_range() for page in pypdfium2.PdfDocument(folder / name))
        for name in ("mounting.pdf", "wages.pdf")
    ]


@pytest.mark.parametrize("language", FOREIGN)
def test_no_english_and_no_latin_digit_is_left(language: str, tmp_path: Path) -> None:
    for text in papers(language, tmp_path):
        assert not re.findall(r"[A-Za-z]{2,}", text)
        assert len(re.findall(r"[0-9]+", text)) == len(re.findall("A 12|12 A", text)) == 2  # pdfium may turn words


@pytest.mark.parametrize("language", FOREIGN)
def test_each_text_is_read_back_in_logical_order(language: str, tmp_path: Path) -> None:
    shown, wages = (bare(text) for text in papers(language, tmp_path))
    catalogue, digits = catalogue_of(language), str.maketrans("0123456789", WEAVERS[language].digits)
    for key in ("mounting", "warp-beam", "cloth-beam", "size", "knot"):
        assert bare(catalogue[f"order.{key}"].translate(digits)) in shown, key
    for key in ("wages", "rate", "supplement", "wage", "advance", "due", "payments", "flat", "flat-rate", "paid"):
        assert bare(catalogue[f"order.{key}"]) in wages, key
    done = catalogue["order.woven-text"].format(done=30, rows=75).translate(digits)
    begin = catalogue["order.begin-row"].translate(digits)
    for text, page in ((done, wages), (begin, shown)):  # pdfium moves a number at the begin of a line
        assert all(bare(word) in page for word in text.replace(":", " ").split()), text


def test_words_and_marks_of_the_mounting_are_lengths_on_the_loom() -> None:
    """The middle of 500 rows is half of what 50 marks measure, and the rows of a decimetre are counted there too."""
    chart = Chart(np.zeros((500, 288), np.uint8), default_yarns()[:1], "115.2x200cm", "25x25/dm", "symmetric")
    made = mounting(chart)
    said = dict(mounting_lines(chart, made))
    row, knot, dense = (str(said[f"{name}"]) for name in ("middle row", "middle knot", "in a decimetre"))
    assert float(re.findall(r"([\d.]+) cm", row)[0]) == pytest.approx(100 * made.row_mark * 25, abs=0.06)
    assert float(re.findall(r"([\d.]+) cm", knot)[0]) == pytest.approx(100 * made.knot_mark * 14.4, abs=0.06)
    knots, rows = map(float, re.findall(r"[\d.]+", dense))
    assert (knots, rows) == (pytest.approx(1 / made.knot_mark, abs=0.06), pytest.approx(1 / made.row_mark, abs=0.06))
    assert made.row_mark > 10 / 250  # the warps are stretched
