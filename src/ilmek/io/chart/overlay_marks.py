"""Half knots and jufti knots on a printed chart.

A cell of half knots is divided upright, each half with the colour and symbol of its yarn; a jufti knot has a bar over
its two cells.
"""

from ilmek.carpet.chart import Chart
from ilmek.carpet.overlay import HALF, KnotMark
from ilmek.io.chart.inks import Inks
from ilmek.io.chart.printing import PrintCanvas
from ilmek.io.chart.sheets import ChartSheet, SheetLayout
from ilmek.io.chart.symbols import SIGNS


def draw_marks(canvas: PrintCanvas, chart: Chart, plan: SheetLayout, sheet: ChartSheet, inks: Inks) -> None:
    """Draw the marks of a sheet's cells; the origin is the lower left corner of its cells."""
    if not len(chart.overlay):
        return
    canvas.saveState()
    for mark in chart.overlay.between(chart.rows - sheet.shown_high, chart.rows - sheet.low):
        y = (chart.rows - 1 - mark.row - sheet.low) * plan.cell_height
        if mark.kind == HALF and sheet.left <= mark.column < sheet.shown_right:
            _draw_half(canvas, chart, plan, inks, (mark, (mark.column - sheet.left) * plan.cell_width, y))
        elif mark.kind != HALF and sheet.left - 1 <= mark.column < sheet.shown_right:
            begin, end = max(mark.column, sheet.left), min(mark.column + 2, sheet.shown_right)
            canvas.setFillGray(1.0 if inks.white[chart.knots[mark.row, mark.column]] else 0.0)
            x = (begin - sheet.left + 0.2) * plan.cell_width
            wide = (end - begin - 0.4) * plan.cell_width
            canvas.rect(x, y + 0.07 * plan.cell_height, wide, 0.09 * plan.cell_height, stroke=0, fill=1)
    canvas.restoreState()


def _draw_half(
    canvas: PrintCanvas, chart: Chart, plan: SheetLayout, inks: Inks, at: tuple[KnotMark, float, float]
) -> None:
    mark, x, y = at
    size = min(0.5 * plan.cell_height, 0.75 * plan.cell_width)
    half = plan.cell_width / 2
    canvas.setFont(SIGNS, size)
    for side, yarn in enumerate((int(chart.knots[mark.row, mark.column]), mark.second)):
        canvas.setFillColorRGB(*inks.fills[yarn])
        canvas.rect(x + side * half, y, half, plan.cell_height, stroke=0, fill=1)
        canvas.setFillGray(1.0 if inks.white[yarn] else 0.0)
        canvas.draw_sign(x + (side + 0.5) * half, y + (plan.cell_height - 0.72 * size) / 2, inks.symbols[yarn])
    canvas.setStrokeGray(0.25)
    canvas.setLineWidth(0.3)
    canvas.line(x + half, y, x + half, y + plan.cell_height)
