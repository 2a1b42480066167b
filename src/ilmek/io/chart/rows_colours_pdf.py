"""Rows split by colours as PDF: of each row every yarn once, with the number of its knots and their cells."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from reportlab.lib.pagesizes import A4

from ilmek.carpet.chart import Chart
from ilmek.carpet.rows import Run, directions, row_codes, runs_of, span_text, spans_by_yarn
from ilmek.io.chart.inks import Inks
from ilmek.io.chart.legend import draw_legend
from ilmek.io.chart.lettering import cut_line, is_plain
from ilmek.io.chart.printing import PLAIN, PrintCanvas, Printing, printed_file, title_of
from ilmek.io.chart.symbols import ADVANCE, SIGNS, STRONG, TEXT, symbols
from ilmek.progress import SILENT, Progress
from ilmek.sentences import Sentence

_LEFT, _TOP, _LOW = 42.0, 800.0, 40.0
_SIZE, _LINE = 7.0, 9.0
_CELLS_AT = 118.0
"""Where the cells of a yarn begin, from the left edge [pt]."""

_CHARACTERS = int((A4[0] - 2 * _LEFT - _CELLS_AT) / (ADVANCE * _SIZE))
"""Characters of a line of cells."""

_LINES = int((_TOP - 30.0 - _LOW) / _LINE)
"""Lines of a page, gaps between rows included."""

_BAND = 1 << 18
_GREY = (0.36, 0.40, 0.44)


@dataclass(frozen=True, slots=True)
class ColourLine:
    """A line of a page: the heading of a row (yarn None), a yarn with its knots, or more of its cells (knots 0)."""

    text: str
    yarn: int | None = None
    knots: int = 0


def _row_lines(number: int, runs: tuple[Run, ...], columns: int, direction: str) -> Iterator[ColourLine]:
    for rightward in directions(number, direction):
        yield ColourLine(Sentence("rows.row", number=number, arrow="→" if rightward else "←"))
        for yarn, spans in spans_by_yarn(runs).items():
            words = [span_text(span, columns, rightward) for span in (spans if rightward else spans[::-1])]
            knots, line = sum(span.knots for span in spans), ""
            for word in words:
                if line and len(line) + 2 + len(word) > _CHARACTERS:
                    yield ColourLine(line, yarn, knots)
                    knots, line = 0, ""
                line += f"{'  ' if line else ''}{word}"
            yield ColourLine(line, yarn, knots)


def colour_pages(chart: Chart, direction: str) -> Iterator[list[ColourLine]]:
    """The lines of each page; a row that fits a page is not divided."""
    page: list[ColourLine] = []
    for first in range(0, chart.rows, step := max(1, _BAND // chart.columns)):
        for row, codes in enumerate(row_codes(chart, first, min(first + step, chart.rows)), start=first + 1):
            lines = list(_row_lines(row, runs_of(codes), chart.columns, direction))
            if page and len(page) + len(lines) > _LINES:
                yield page
                page = []
            while len(lines) > _LINES:
                yield lines[:_LINES]
                lines = lines[_LINES:]
            page += lines
    yield page


def write_colours_pdf(
    path: Path, chart: Chart, direction: str, pages: int, progress: Progress = SILENT, *, printing: Printing = PLAIN
) -> None:
    """Write the rows of a chart, split by colours, to `path`.

    pages  their number, of `colour_pages`
    """
    inks = Inks.of(chart.yarns, symbols(chart.yarns))
    halves = Sentence("rows.half-cells") if chart.overlay.halves else ""
    juftis = Sentence("rows.jufti-cells") if chart.overlay.juftis else ""
    about = Sentence("rows.cells", marks=Sentence("rows.marks", halves=halves, juftis=juftis))
    with printed_file(path, Sentence("rows.title", name=title_of(chart, printing)), printing) as canvas:
        draw_legend(canvas, chart, inks, printing)
        for number, lines in enumerate(colour_pages(chart, direction), start=1):
            canvas.setFillGray(0.1)
            canvas.setFont(STRONG, 11)
            canvas.write(_LEFT, _TOP, Sentence("rows.colours"))
            canvas.setFont(TEXT, 7)
            canvas.setFillColorRGB(*_GREY)
            page = Sentence("rows.page", name=title_of(chart, printing), page=number, pages=pages)
            canvas.write_to(A4[0] - _LEFT, _TOP, page)
            canvas.write(_LEFT, _TOP - 12.0, about)
            for line, text in enumerate(lines):
                _draw_line(canvas, text, chart, inks, _TOP - 30.0 - line * _LINE)
            canvas.showPage()
            progress(number / pages)


def _draw_line(canvas: PrintCanvas, line: ColourLine, chart: Chart, inks: Inks, y: float) -> None:
    canvas.setFillGray(0.1)
    if line.yarn is None:
        canvas.setStrokeGray(0.75)
        canvas.setLineWidth(0.4)
        canvas.line(_LEFT, y + 7.0, A4[0] - _LEFT, y + 7.0)
        canvas.setStrokeGray(0.2)
        canvas.rect(canvas.side(_LEFT, 6.5), y - 0.8, 6.5, 6.5, stroke=1, fill=0)
        canvas.setFont(STRONG, 8)
        canvas.write(_LEFT + 12.0, y, line.text)
        return
    if line.knots:
        canvas.setFillColorRGB(*inks.fills[line.yarn])
        canvas.setStrokeGray(0.4)
        canvas.setLineWidth(0.3)
        canvas.rect(canvas.side(_LEFT + 12.0, 12.0), y - 1.2, 12.0, 7.4, stroke=1, fill=1)
        canvas.setFillGray(0.1)
        canvas.setFont(SIGNS, _SIZE)
        canvas.draw_letters(canvas.side(_LEFT + 28.0, ADVANCE * _SIZE), y, inks.symbols[line.yarn])
        canvas.write_to(_LEFT + _CELLS_AT - 8.0, y, str(line.knots))
        name = canvas.name_of(chart.yarns[line.yarn].name)
        canvas.write_name(_LEFT + 36.0, y, cut_line(name, 6.0, 50.0), 6.0)
    canvas.setFont(SIGNS, _SIZE)
    x = _LEFT + _CELLS_AT
    for word in (
        [line.text] if not canvas.leftward and is_plain(canvas.numerals(line.text), SIGNS) else line.text.split()
    ):
        canvas.write(x, y, word.replace("-", "–") if canvas.leftward else word)
        x += ADVANCE * _SIZE * (len(word) + 2)
