"""The printed chart, read back: pages, titles, legend, symbols, overlap."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pypdf import PdfReader

from ilmek.carpet.chart import Chart
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.io.chart.pdf import chart_cut, write_chart_pdf
from ilmek.io.chart.sheets import OVERLAP, cut
from ilmek.io.chart.symbols import SYMBOLS, symbols
from ilmek.progress import Progress


def chart(rows: int, columns: int, yarns: int, along: float = 250.0) -> Chart:
    rng = np.random.default_rng(5)
    colours = rng.integers(0, 256, (yarns, 3)).tolist()
    threads = tuple(Yarn(f"yarn-{n}", (r, g, b), (0.0, 0.0, 0.0), 4.0) for n, (r, g, b) in enumerate(colours))
    knots = rng.integers(0, yarns, (rows, columns), dtype=np.uint8)
    size = CarpetSize(columns / 250.0, rows / along, "seccade")
    return Chart(knots, threads, size, Quality(250.0, along), "symmetric")


def written(path: Path, made: Chart) -> PdfReader:
    write_chart_pdf(path / "chart.pdf", made)
    return PdfReader(path / "chart.pdf")


def text_of(reader: PdfReader, page: int) -> str:
    return re.sub(r"[ \t]+", " ", reader.pages[page].extract_text())


def test_pages_and_titles(tmp_path: Path) -> None:
    """130 rows x 70 knots: sheets of 40 x 70, twice two of them, after overview and legend."""
    made = chart(130, 70, 5)
    plan = chart_cut(made)
    reader = written(tmp_path, made)
    assert (plan.sheet_columns, plan.sheet_rows, plan.count) == (40, 70, 4)
    assert len(reader.pages) == 2 + 4
    assert "Knot chart: seccade" in text_of(reader, 0)
    assert "70 knots × 130 rows: 9\u202f100 knots in 5 colours on 4 sheets" in text_of(reader, 0)
    titles = [text_of(reader, page) for page in range(2, 6)]
    for number, title in enumerate(
        ("rows 1–70, knots 1–40", "rows 1–70, knots 41–70", "rows 71–130, knots 1–40", "rows 71–130, knots 41–70"), 1
    ):
        assert title in titles[number - 1]
        assert f"sheet {number} of 4" in titles[number - 1]
    assert "right: sheet 2" in titles[0]
    assert "above: sheet 3" in titles[0]
    assert "left: sheet 3" in titles[3]
    assert "below: sheet 2" in titles[3]
    assert reader.metadata is not None
    assert reader.metadata.title == "Knot chart: seccade"


def test_legend_counts_are_the_charts(tmp_path: Path) -> None:
    made = chart(60, 60, 90)
    reader = written(tmp_path, made)
    legend = "\n".join(text_of(reader, page) for page in (1, 2, 3))
    for place, count in enumerate(made.counts):
        assert re.search(rf"\n{100 * count / 3600:.1f} %\n{count}\s+yarn-{place}\b", legend), place
    assert len(reader.pages) == 1 + 3 + chart_cut(made).count


def test_long_names_keep_their_ends(tmp_path: Path) -> None:
    made = chart(20, 20, 80)
    names = [f"a name of {'very ' * 30}many words, the {place}th" for place in range(80)]
    named = replace(made, yarns=tuple(replace(yarn, name=name) for yarn, name in zip(made.yarns, names, strict=True)))
    legend = text_of(written(tmp_path, named), 1)
    assert all(f"the {place}th" in legend for place in range(36))
    assert "…" in legend
    assert "< 0.1 %" not in legend


def test_a_yarn_of_few_knots_has_a_share(tmp_path: Path) -> None:
    made = chart(60, 60, 2)
    knots = np.zeros_like(made.knots)
    knots[0, 0] = 1
    legend = text_of(written(tmp_path, replace(made, knots=knots)), 1)
    assert "< 0.1 %" in legend
    assert "100.0 %" in legend


def test_legend_leaves_out_yarns_without_knots(tmp_path: Path) -> None:
    made = chart(20, 20, 3)
    made.knots[made.knots == 1] = 2
    legend = text_of(written(tmp_path, made), 1)
    assert "yarn-0" in legend
    assert "yarn-1" not in legend
    assert "Legend: 2 colours, 400 knots" in legend


@pytest.mark.parametrize("yarns", [2, 40, 255])
def test_every_knot_has_its_symbol_where_it_lies(tmp_path: Path, yarns: int) -> None:
    """The symbols of a sheet, sorted by their places on the paper, are the knots from the bottom row up."""
    made = chart(24, 18, yarns)
    plan = chart_cut(made)
    found: dict[tuple[int, int], str] = {}
    low = 800.0 - 42.0 - plan.rows * plan.cell_height

    def visit(text: str, cm: list[float], tm: list[float], font: object, size: float) -> None:
        if not (isinstance(font, dict) and "Mono" in str(font.get("/BaseFont", "")) and text.strip("\n")):
            return
        x, y = tm[4] + cm[4], tm[5] + cm[5]
        row, first = int((y - low) / plan.cell_height), round((x - 54.0) / plan.cell_width - 0.3)
        for shift, sign in enumerate(text.strip("\n")):
            if sign != " ":
                found[row, first + shift] = sign

    reader = written(tmp_path, made)
    reader.pages[-1].extract_text(visitor_text=visit)
    wanted = {
        (row, column): SYMBOLS[made.knots[made.rows - 1 - row, column]]
        for row in range(made.rows)
        for column in range(made.columns)
    }
    seen = "".join(found.values())
    assert {sign: seen.count(sign) for sign in set(seen)} == {
        sign: count for sign, count in zip(symbols(made.yarns), made.counts, strict=True) if count
    }
    if yarns <= 40:
        assert sum(found.get(place) == sign for place, sign in wanted.items()) == made.knots.size


def test_sheets_share_three_knots_and_cover_the_chart_once() -> None:
    plan = cut(450, 300, 1.0)
    owners = np.zeros((450, 300), dtype=int)
    shown = np.zeros((450, 300), dtype=int)
    for sheet in plan.sheets():
        owners[sheet.low : sheet.high, sheet.left : sheet.right] += 1
        shown[sheet.low : sheet.shown_high, sheet.left : sheet.shown_right] += 1
        assert (sheet.shown_right - sheet.right, sheet.shown_high - sheet.high) == (
            OVERLAP if sheet.neighbours["right"] else 0,
            OVERLAP if sheet.neighbours["above"] else 0,
        )
    assert np.all(owners == 1)
    assert np.array_equal(np.flatnonzero(shown[0] == 2)[:3], [60, 61, 62])


@pytest.mark.parametrize("proportion", [0.25, 0.79, 1.0, 1.6, 4.0])
@pytest.mark.parametrize(("rows", "columns"), [(1, 1), (10, 900), (450, 300), (2000, 37)])
def test_cells_keep_their_proportion_and_the_paper(rows: int, columns: int, proportion: float) -> None:
    plan = cut(rows, columns, proportion)
    assert plan.cell_height / plan.cell_width == pytest.approx(proportion)
    for sheet in (plan.sheet(1), plan.sheet(plan.count)):
        assert (sheet.shown_right - sheet.left) * plan.cell_width <= 482.0 + 1e-6
        assert (sheet.shown_high - sheet.low) * plan.cell_height <= 694.0 + 1e-6
    if plan.across > 1:
        assert plan.sheet_columns % 10 == 0
    if plan.up > 1:
        assert plan.sheet_rows % 10 == 0


def test_progress_ends_at_one_and_the_file_is_the_same_each_time(tmp_path: Path) -> None:
    told: list[float] = []
    made = chart(130, 70, 5)
    write_chart_pdf(tmp_path / "a.pdf", made, progress=Progress(lambda _, share: told.append(share)))
    write_chart_pdf(tmp_path / "b.pdf", made)
    assert told == sorted(told)
    assert told[-1] == 1.0
    assert (tmp_path / "a.pdf").read_bytes() == (tmp_path / "b.pdf").read_bytes()


def test_symbols_are_distinct() -> None:
    assert len(SYMBOLS) == 255
    assert len(set(SYMBOLS)) == 255
    assert not set("IOQ01l |") & set(SYMBOLS)
