"""The whole chart on one large sheet, wall.pdf: cells as on chart.pdf, with row and knot numbers, and the legend below.

The least side of a cell is WALL_CELL. A page of PDF may have 14,400 units of length; where the sheet is larger, a unit
is a whole number of points (UserUnit, ISO 32000-1, 7.7.3.3 and annex C.2). A viewer that ignores it shows the sheet
smaller by this number.
"""

import math
from dataclasses import dataclass
from pathlib import Path

from reportlab.pdfbase.pdfdoc import PDFPage

from ilmek.carpet.chart import Chart
from ilmek.io.chart.grid import draw_cells
from ilmek.io.chart.inks import Inks
from ilmek.io.chart.legend import draw_entry
from ilmek.io.chart.printing import PLAIN, PrintCanvas, Printing, printed_file, quality_of, size_of, title_of
from ilmek.io.chart.sheets import SheetLayout, require_wall
from ilmek.io.chart.symbols import STRONG, TEXT, symbols
from ilmek.progress import SILENT, Progress
from ilmek.sentences import Sentence, noun
from ilmek.units import format_number

WALL_CELL = 7.4
"""Least side of a knot's cell [pt]: 2.6 mm, as on chart.pdf."""

MOST_UNITS = 14_400
"""Largest side of a page of PDF, in its units of length."""

_SIDE, _HEAD, _FOOT = 54.0, 84.0, 40.0
_ENTRY, _LINE = 250.0, 19.0
_INCH = 72.0
_METRE = 0.0254


@dataclass(frozen=True, slots=True)
class WallSheet:
    """Size of the sheet: width and height [pt], points in a unit of length of the file, and the cells."""

    width: float
    height: float
    unit: int
    cells: SheetLayout

    @property
    def lengths(self) -> tuple[float, float]:
        """Width and height [m]."""
        return self.width / _INCH * _METRE, self.height / _INCH * _METRE


def wall_sheet(chart: Chart) -> WallSheet:
    """The sheet of a chart. Raises CarpetError as `require_wall`."""
    require_wall(chart.knots.size)
    proportion = chart.quality.across / chart.quality.along
    cell = WALL_CELL * max(1.0, 1.0 / proportion)
    cells = SheetLayout(chart.rows, chart.columns, 1, 1, chart.columns, chart.rows, cell, cell * proportion)
    width = max(600.0, chart.columns * cell + 2 * _SIDE)
    lines = math.ceil(len(chart.used) / _entries(width))
    height = chart.rows * cells.cell_height + _HEAD + _FOOT + 30.0 + lines * _LINE
    return WallSheet(width, height, max(1, math.ceil(max(width, height) / MOST_UNITS)), cells)


def _entries(width: float) -> int:
    """Entries of the legend in a line."""
    return max(1, int((width - 2 * _SIDE) // _ENTRY))


def write_wall_pdf(path: Path, chart: Chart, progress: Progress = SILENT, *, printing: Printing = PLAIN) -> None:
    """Write the chart as one sheet to `path`. Raises CarpetError as `wall_sheet`."""
    sheet = wall_sheet(chart)
    inks = Inks.of(chart.yarns, symbols(chart.yarns))
    page, title = (
        (sheet.width / sheet.unit, sheet.height / sheet.unit),
        Sentence("chart.title", name=title_of(chart, printing)),
    )
    with printed_file(path, title, printing, pagesize=page, pdfVersion=(1, 6)) as canvas:
        canvas.unit = sheet.unit
        canvas.scale(1 / sheet.unit, 1 / sheet.unit)
        _write_head(canvas, chart, sheet)
        canvas.saveState()
        canvas.translate(
            (sheet.width - chart.columns * sheet.cells.cell_width) / 2,
            sheet.height - _HEAD - chart.rows * sheet.cells.cell_height,
        )
        draw_cells(canvas, chart, sheet.cells, sheet.cells.sheet(1), inks)
        canvas.restoreState()
        progress(0.6)
        tied, across = chart.tied, _entries(sheet.width)
        total = tied.total
        top = sheet.height - _HEAD - chart.rows * sheet.cells.cell_height - 44.0
        for place, index in enumerate(chart.used):
            line, column = divmod(place, across)
            box = (_SIDE + column * _ENTRY, top - line * _LINE, _ENTRY - 20.0)
            draw_entry(canvas, chart, inks, (index, tied.of(index), total), box)
        canvas.showPage()
        _set_unit(canvas, sheet.unit)
    progress(1.0)


def _write_head(canvas: PrintCanvas, chart: Chart, sheet: WallSheet) -> None:
    canvas.setFillGray(0.1)
    canvas.setFont(STRONG, 16)
    canvas.write(_SIDE, sheet.height - 34.0, Sentence("chart.title", name=title_of(chart, canvas.printing)))
    canvas.setFont(TEXT, 9)
    width, length = (format_number(side * 100, 4) for side in sheet.lengths)
    carpet = {"size": size_of(chart.size), "quality": quality_of(chart.quality), "knot": noun(chart.knot)}
    canvas.write(_SIDE, sheet.height - 50.0, Sentence("chart.wall", **carpet, width=width, length=length))


def _set_unit(canvas: PrintCanvas, unit: int) -> None:
    """State the unit of length of the pages, which reportlab has no name for."""
    if unit > 1:
        for page in canvas._doc.idToObject.values():
            if isinstance(page, PDFPage):
                page.__Defaults__ = {**page.__Defaults__, "UserUnit": unit}
