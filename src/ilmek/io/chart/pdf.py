"""Knot charts for the weaver: a PDF of A4 sheets in vector graphics.

The first page shows the whole carpet with the sheets' numbers, then follow the legend (swatch, symbol, name, count) and
the sheets in the order of weaving. A sheet shows each knot as a cell in true proportion with the yarn's colour and
symbol, a bold line every 10 knots, row numbers (from the bottom, as woven) and knot numbers on the edges, arrowheads at
the carpet's middle, and the neighbours' sheet numbers; the 3 knots that belong to the next sheet are shaded. The same
chart gives the same file.
"""

from pathlib import Path

from ilmek.carpet.chart import Chart
from ilmek.io.chart.front_pages import draw_overview
from ilmek.io.chart.grid import draw_sheet
from ilmek.io.chart.inks import Inks
from ilmek.io.chart.legend import draw_legend
from ilmek.io.chart.printing import PLAIN, Printing, printed_file, title_of
from ilmek.io.chart.sheets import SheetLayout, cut
from ilmek.io.chart.symbols import symbols
from ilmek.progress import SILENT, Progress
from ilmek.sentences import Sentence


def write_chart_pdf(path: Path, chart: Chart, progress: Progress = SILENT, *, printing: Printing = PLAIN) -> None:
    """Write the chart to `path`.

    A sheet takes about 0.01 s; `chart_cut` gives the number of sheets.
    """
    plan = chart_cut(chart)
    inks = Inks.of(chart.yarns, symbols(chart.yarns))
    with printed_file(path, Sentence("chart.title", name=title_of(chart, printing)), printing) as canvas:
        draw_overview(canvas, chart, plan)
        draw_legend(canvas, chart, inks, printing)
        for sheet in plan.sheets():
            draw_sheet(canvas, chart, plan, sheet, inks, printing=printing)
            progress(sheet.number / plan.count)


def chart_cut(chart: Chart) -> SheetLayout:
    """The division of the chart into sheets; `.count` is their number."""
    return cut(chart.rows, chart.columns, chart.quality.across / chart.quality.along)
