"""Knot charts for the weaver: a PDF of A4 sheets in vector graphics.

The first page shows the whole carpet with the sheets' numbers, then follow the legend (swatch, symbol, name, count) and
the sheets in the order of weaving. A sheet shows each knot as a cell in true proportion with the yarn's colour and
symbol, a bold line every 10 knots, row numbers (from the bottom, as woven) and knot numbers on the edges, arrowheads at
the carpet's middle, and the neighbours' sheet numbers; the 3 knots that belong to the next sheet are shaded. The same
chart gives the same file.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from reportlab import rl_config
from reportlab.lib.pagesizes import A4
from reportlab.pdfgen.canvas import Canvas

from ilmek.carpet.chart import Chart
from ilmek.io.chart.front_pages import draw_legend, draw_overview
from ilmek.io.chart.grid import draw_sheet
from ilmek.io.chart.inks import Inks
from ilmek.io.chart.sheets import SheetLayout, cut
from ilmek.io.chart.symbols import register_fonts, symbols
from ilmek.progress import SILENT, Progress


def write_chart_pdf(path: Path, chart: Chart, progress: Progress = SILENT, title: str = "") -> None:
    """Write the chart to `path`.

    A sheet takes about 0.01 s; `chart_cut` gives the number of sheets.
    """
    register_fonts()
    plan = chart_cut(chart)
    inks = Inks.of(chart.yarns, symbols(chart.yarns))
    name = title or chart.size.name or f"{chart.columns} × {chart.rows} knots"
    with plain_streams():
        canvas = Canvas(str(path), pagesize=A4, pageCompression=1, invariant=1)
        canvas.setTitle(f"Knot chart: {name}")
        canvas.setCreator("ilmek")
        draw_overview(canvas, chart, plan, name)
        draw_legend(canvas, chart, inks)
        for sheet in plan.sheets():
            draw_sheet(canvas, chart, plan, sheet, inks)
            progress(sheet.number / plan.count)
        canvas.save()


def chart_cut(chart: Chart) -> SheetLayout:
    """The division of the chart into sheets; `.count` is their number."""
    return cut(chart.rows, chart.columns, chart.quality.across / chart.quality.along)


@contextmanager
def plain_streams() -> Iterator[None]:
    """Write streams as bytes, not as base-85 text: smaller, and several times faster."""
    config: Any = rl_config
    before = config.useA85
    config.useA85 = 0
    try:
        yield
    finally:
        config.useA85 = before
