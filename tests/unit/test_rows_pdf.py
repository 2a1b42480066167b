"""The printed rows, read back: a row of 480 knots on one line of one page, in type of 6 points or more."""

import itertools
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pypdf import PdfReader

from ilmek.carpet.chart import Chart
from ilmek.carpet.overlay import HALF, JUFTI, KnotMark, overlay_of
from ilmek.carpet.quality import Quality
from ilmek.carpet.rows import row_runs, spans_by_yarn
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.io.chart.inks import Inks
from ilmek.io.chart.rows_colours_pdf import colour_pages, write_colours_pdf
from ilmek.io.chart.rows_layout import LABEL_GAP, LEAST_CELL, SMALLEST, rows_layout
from ilmek.io.chart.rows_pdf import chart_rows_layout, write_rows_pdf
from ilmek.io.chart.rows_strip import Strip, levels_of, strip_labels
from ilmek.io.chart.symbols import symbols


def chart(rows: int, columns: int, yarns: int, marks: tuple[KnotMark, ...] = (), seed: int = 5) -> Chart:
    rng = np.random.default_rng(seed)
    threads = tuple(Yarn(f"yarn-{n}", (n, 99, 255 - n), (0.0, 0.0, 0.0), 4.0) for n in range(yarns))
    knots = rng.integers(0, yarns, (rows, columns), dtype=np.uint8)
    for mark in marks:
        knots[mark.row, mark.column : mark.column + 2] = 0
    size = CarpetSize(max(0.01, columns / 250.0), max(0.01, rows / 250.0))
    return Chart(knots, threads, size, Quality(250.0, 250.0), "symmetric", overlay=overlay_of(marks))


def shown(path: Path, page: int) -> list[tuple[str, float, float, float, str]]:
    """Every text of a page: text, x, y, size of type, font."""
    found: list[tuple[str, float, float, float, str]] = []

    def visit(text: str, cm: list[float], tm: list[float], font: object, size: float) -> None:
        if text.strip() and isinstance(font, dict):
            x = tm[4] * cm[0] + tm[5] * cm[2] + cm[4]
            y = tm[4] * cm[1] + tm[5] * cm[3] + cm[5]
            found.append((text.strip("\n"), x, y, size, str(font.get("/BaseFont", ""))))

    PdfReader(path).pages[page].extract_text(visitor_text=visit)
    return found


def test_480_knots_are_one_line_of_one_page(tmp_path: Path) -> None:
    """The hardest row: 480 runs of one knot. Every symbol is there in its order, in type of 6 pt or more."""
    made = chart(12, 480, 16)
    made.knots[:, 1::2] = (made.knots[:, 1::2] % 8) + 8
    made.knots[:, ::2] %= 8
    plan = chart_rows_layout(made)
    assert (plan.parts, plan.width) == (1, pytest.approx(1190.55))
    write_rows_pdf(tmp_path / "rows.pdf", made)
    reader = PdfReader(tmp_path / "rows.pdf")
    assert len(reader.pages) == 1 + plan.count
    assert [float(side) for side in reader.pages[1].mediabox[2:]] == pytest.approx([plan.width, plan.height], abs=0.01)
    texts = shown(tmp_path / "rows.pdf", 1)
    assert min(size for *_, size, _ in texts) >= SMALLEST
    low = {number: plan.height - 24 - 44 - number * plan.pitch for number in range(plan.lines + 1)}
    row = [
        (x, text)
        for text, x, y, _, font in texts
        if "Mono" in font and low[1] + 32.0 < y < low[0] and len(text.strip()) == 1
    ]
    expected = "".join(symbols(made.yarns)[yarn] for yarn in made.knots[-1])
    assert "".join(text.strip() for _, text in sorted(row)) == expected
    first, *_, last = sorted(row)
    assert 24.0 < first[0] < last[0] < plan.width - 24.0
    assert "Rows 1–" in reader.pages[1].extract_text()


@pytest.mark.parametrize("seed", range(6))
def test_labels_never_meet(seed: int) -> None:
    """On the levels that a page has space for, no two labels are closer than their gap, and each is over its run."""
    rng = np.random.default_rng(seed)
    marks = [KnotMark(1, column, HALF if rng.random() < 0.5 else JUFTI, 1) for column in range(0, 478, 3 + seed)]
    made = chart(2, 480 if seed < 4 else 1200, 3, tuple(marks) if seed % 2 else (), seed)
    plan = chart_rows_layout(made)
    inks = Inks.of(made.yarns, symbols(made.yarns))
    for part in range(plan.parts):
        begin = part * plan.part_columns
        strip = Strip(1, row_runs(made, 1), begin, min(begin + plan.part_columns, plan.columns))
        labels = strip_labels(strip, plan, inks)
        levels = levels_of(labels)
        assert max(levels) < plan.levels
        for level in set(levels):
            beside = sorted(one.middle for one, at in zip(labels, levels, strict=True) if at == level)
            widths = {one.middle: one.width for one in labels}
            for left, right in itertools.pairwise(beside):
                assert right - left >= (widths[left] + widths[right]) / 2 + LABEL_GAP - 1e-6


@pytest.mark.parametrize("columns", [2, 50, 300, 324, 480, 487, 488, 2400, 250_000])
def test_strips_keep_the_paper(columns: int) -> None:
    plan = rows_layout(450, columns)
    assert plan.cell >= LEAST_CELL
    assert plan.part_columns * plan.cell <= plan.width - 2 * 24 - 62 - 36 + 1e-6
    assert (plan.parts - 1) * plan.part_columns < columns <= plan.parts * plan.part_columns
    assert plan.lines * plan.pitch <= plan.height - 2 * 24 - 44 - 16
    assert plan.size >= SMALLEST
    assert (plan.parts == 1) == (columns <= 486)


def test_counts_marks_and_knots_of_each_yarn_are_printed(tmp_path: Path) -> None:
    marks = (KnotMark(1, 2, HALF, 2), KnotMark(0, 4, JUFTI))
    made = chart(2, 10, 3, marks)
    knots = np.array([[1, 1, 1, 1, 0, 0, 2, 2, 2, 2], [0, 0, 0, 1, 1, 1, 1, 1, 1, 1]], dtype=np.uint8)
    made = replace(made, knots=knots)
    write_rows_pdf(tmp_path / "rows.pdf", made)
    text = re.sub(r"[ \n]+", " ", PdfReader(tmp_path / "rows.pdf").pages[1].extract_text())
    for part in ("A2 AC1½ B7", "A 3 B 7 C 1", "B4 A1j C4", "A 1 B 4 C 4"):
        assert "".join(part.split()) in "".join(text.split()), part


def test_a_run_over_the_end_of_a_strip_has_its_whole_count(tmp_path: Path) -> None:
    made = chart(2, 1000, 2)
    made = replace(made, knots=np.zeros((2, 1000), dtype=np.uint8))
    plan = chart_rows_layout(made)
    inks = Inks.of(made.yarns, symbols(made.yarns))
    counts = [
        [
            label.knots
            for label in strip_labels(Strip(1, row_runs(made, 1), at, min(at + plan.part_columns, 1000)), plan, inks)
        ]
        for at in range(0, 1000, plan.part_columns)
    ]
    assert counts == [["1000→"], ["→"], ["→"]]


def test_rows_by_colours_are_printed_whole(tmp_path: Path) -> None:
    made = chart(30, 200, 6, (KnotMark(3, 7, HALF, 2), KnotMark(4, 4, JUFTI)))
    pages = list(colour_pages(made, "alternate"))
    write_colours_pdf(tmp_path / "rows.pdf", made, "alternate", len(pages))
    reader = PdfReader(tmp_path / "rows.pdf")
    assert len(reader.pages) == 1 + len(pages)
    lines = [line for page in pages for line in page]
    tied = [sum(line.knots for line in lines if line.yarn == yarn) for yarn in range(6)]
    assert tied == [made.tied.of(yarn) for yarn in range(6)]
    words = sum(len(line.text.split()) for line in lines if line.yarn is not None)
    assert words == sum(len(spans) for row in range(30) for spans in spans_by_yarn(row_runs(made, row + 1)).values())
    text = reader.pages[1].extract_text()
    assert "Row 1 →" in text
    assert "Row 2 ←" in text


def test_the_same_chart_gives_the_same_file(tmp_path: Path) -> None:
    made, done = chart(30, 60, 5), []
    write_rows_pdf(tmp_path / "a.pdf", made, progress=done.append)
    write_rows_pdf(tmp_path / "b.pdf", made)
    assert (tmp_path / "a.pdf").read_bytes() == (tmp_path / "b.pdf").read_bytes()
    assert done == sorted(done)
    assert done[-1] == 1.0


@pytest.mark.parametrize(("marks", "words"), [
    ([], ()), ([KnotMark(0, 0, HALF, 1)], ("half knots",)), ([KnotMark(1, 0, JUFTI)], ("jufti knots",)),
    ([KnotMark(0, 0, HALF, 1), KnotMark(1, 0, JUFTI)], ("half knots", "jufti knots")),
])  # fmt: skip
def test_only_the_marks_that_are_there_are_explained(
    marks: list[KnotMark], words: tuple[str, ...], tmp_path: Path
) -> None:
    made = chart(4, 4, yarns=2)
    made = replace(made, knots=np.zeros_like(made.knots), overlay=overlay_of(marks))
    write_rows_pdf(tmp_path / "rows.pdf", made)
    write_colours_pdf(tmp_path / "colours.pdf", made, "both", 1)
    for file in ("rows.pdf", "colours.pdf"):
        text = " ".join(page.extract_text() for page in PdfReader(tmp_path / file).pages)
        assert [word for word in ("half knots", "jufti knots") if word in text] == list(words)
