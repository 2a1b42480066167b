"""Rows to weave by as PDF, rows.pdf: the legend, then each row as a strip of cells on one line, row 1 first.

A page tells how it is read; each row has a box to tick, its number at both ends, counts and symbols of its runs, the
numbers of the knots, and the knots of each yarn. The same chart gives the same file.
"""

from collections.abc import Iterator
from pathlib import Path

from ilmek.carpet.chart import Chart
from ilmek.carpet.rows import directions, row_codes, runs_of
from ilmek.io.chart.inks import Inks
from ilmek.io.chart.legend import draw_legend
from ilmek.io.chart.lettering import draw_line
from ilmek.io.chart.printing import PLAIN, PrintCanvas, Printing, printed_file, title_of
from ilmek.io.chart.rows_layout import FOOT, HEAD, LEFT, MARGIN, RIGHT, RULER, SMALLEST, RowsLayout, rows_layout
from ilmek.io.chart.rows_strip import Strip, Typesetter, draw_strip, knots_in_words
from ilmek.io.chart.symbols import SIGNS, STRONG, TEXT, symbols
from ilmek.progress import SILENT, Progress
from ilmek.sentences import Sentence

_GREY = (0.36, 0.40, 0.44)
_BAND = 1 << 20


def chart_rows_layout(chart: Chart, direction: str = "both") -> RowsLayout:
    """The layout of a chart's rows; `.count` is the number of pages with strips."""
    rulers = 2 if direction == "both" else 1
    return rows_layout(chart.rows, chart.columns, marked=len(chart.overlay) > 0, rulers=rulers)


def write_rows_pdf(
    path: Path, chart: Chart, direction: str = "both", progress: Progress = SILENT, *, printing: Printing = PLAIN
) -> None:
    """Write the rows of a chart to `path`, each as one strip where it fits the paper.

    direction  of `carpet.rows.DIRECTIONS`: from which edges the knots are numbered
    A page takes about 0.02 s; `chart_rows_layout` gives their number.
    """
    plan = chart_rows_layout(chart, direction)
    inks = Inks.of(chart.yarns, symbols(chart.yarns))
    with printed_file(path, Sentence("rows.title", name=title_of(chart, printing)), printing) as canvas:
        draw_legend(canvas, chart, inks, printing)
        setter = Typesetter(canvas, plan.size)
        page: list[Strip] = []
        number, marks = 0, _about_marks(chart)
        for strip in _strips(chart, plan):
            page.append(strip)
            if len(page) == plan.lines or (strip.number == chart.rows and strip.stop == chart.columns):
                number += 1
                _draw_page(setter, page, plan, (number, title_of(chart, printing), direction, marks), inks)
                page = []
                progress(number / plan.count)


def _strips(chart: Chart, plan: RowsLayout) -> Iterator[Strip]:
    step = max(1, _BAND // chart.columns)
    for first in range(0, chart.rows, step):
        codes = row_codes(chart, first, min(first + step, chart.rows))
        for row, line in enumerate(codes, start=first + 1):
            runs = runs_of(line)
            for part in range(plan.parts):
                begin = part * plan.part_columns
                label = Sentence("rows.part", part=part + 1, parts=plan.parts) if plan.parts > 1 else ""
                yield Strip(row, runs, begin, min(begin + plan.part_columns, plan.columns), label)


def _draw_page(
    setter: Typesetter, strips: list[Strip], plan: RowsLayout, titles: tuple[int, str, str, str], inks: Inks
) -> None:
    """Draw a page of strips; titles: number of the page, name of the carpet, direction, about marks."""
    canvas = setter.canvas
    number, name, direction, marks = titles
    canvas.setPageSize((plan.width, plan.height))
    rows = {"first": strips[0].number, "last": strips[-1].number}
    canvas.bookmarkPage(f"rows-{number}")
    canvas.addOutlineEntry(canvas.numerals(Sentence("rows.some", **rows)), f"rows-{number}", 0)
    page = Sentence("rows.page", name=name, page=number, pages=plan.count)
    _write_head(canvas, plan, (Sentence("rows.some-of", **rows, rows=plan.rows), page), direction, marks)
    top = plan.height - MARGIN - HEAD
    wide = plan.width - 2 * MARGIN - LEFT - RIGHT
    for line, strip in enumerate(strips):
        reading = direction
        if direction == "alternate":
            reading = "right" if next(directions(strip.number, direction)) else "left"
        low = top - (line + 1) * plan.pitch
        below = plan.rulers * RULER + 7.5
        canvas.saveState()
        canvas.translate(MARGIN + LEFT, low + below)
        draw_strip(setter, strip, plan, inks, reading)
        canvas.setFillColorRGB(*_GREY)
        if strip.stop == plan.columns:
            counts = knots_in_words(strip, inks, wide, canvas.numerals)
            draw_line(canvas, 0.0, -below + 0.3, counts, SMALLEST, base=SIGNS, rightward=True)
        canvas.restoreState()
    canvas.showPage()


def _about_marks(chart: Chart) -> str:
    """How the half knots and jufti knots of a chart are written; "" where it has none."""
    half = Sentence("rows.half") if chart.overlay.halves else ""
    jufti = Sentence("rows.jufti") if chart.overlay.juftis else ""
    return Sentence("chart.two", first=half, second=jufti) if half and jufti else half or jufti


def _write_head(canvas: PrintCanvas, plan: RowsLayout, titles: tuple[str, str], direction: str, marks: str) -> None:
    top = plan.height - MARGIN
    canvas.setFillGray(0.1)
    canvas.setFont(STRONG, 12)
    canvas.write(MARGIN, top - 11.0, titles[0])
    canvas.setFont(TEXT, 8)
    canvas.setFillColorRGB(*_GREY)
    canvas.write_to(plan.width - MARGIN, top - 11.0, titles[1])
    canvas.setFont(TEXT, 7)
    canvas.write(MARGIN, top - 24.0, Sentence("rows.how", reading=Sentence(f"rows.{direction}")))
    canvas.write(MARGIN, top - 33.0, marks)
    canvas.write_to(plan.width - MARGIN, MARGIN - FOOT / 2, Sentence("rows.below"))
