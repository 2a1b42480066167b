"""Slits and joins of a kilim on a printed chart: a thick line along a slit, teeth along a dovetail, a wave along an
interlock.
"""

from dataclasses import replace
from typing import Any

import numpy as np

from ilmek.arrays import BoolArray, Indices
from ilmek.carpet.kilim import DOVETAIL, INTERLOCK, SLIT, KilimParams, borders, joined
from ilmek.carpet.kilim_cloth import KilimCloth
from ilmek.carpet.mounting import mounting
from ilmek.io.chart.printing import Printing
from ilmek.io.chart.sheets import ChartSheet, SheetLayout
from ilmek.records import record
from ilmek.sentences import Sentence

_LINES = ((1.0, 2.2), (0.0, 1.2))
"""Grey and width of the two lines of a mark, one over the other, so that it is seen on every colour [pt]."""


@record
class KilimMarks:
    """The borders of a chart that are slits, and those that are joined; both (rows, columns - 1), row 0 the top."""

    slits: BoolArray
    joints: BoolArray
    join: str

    def draw(self, canvas: Any, rows: int, plan: SheetLayout, sheet: ChartSheet) -> None:
        """Draw the marks of a sheet; the origin is the lower left corner of its cells.

        rows  of the whole chart
        """
        shown = slice(rows - sheet.shown_high, rows - sheet.low), slice(sheet.left, sheet.shown_right - 1)
        wide, high = plan.cell_width, plan.cell_height
        for borders_of, join in ((self.slits, SLIT), (self.joints, self.join)):
            lines: list[tuple[float, float, float, float]] = []
            for row, column in np.argwhere(borders_of[shown][::-1]).tolist():
                lines += mark((column + 1) * wide, row * high, (wide, high), join)
            for grey, width in _LINES:
                canvas.setStrokeGray(grey)
                canvas.setLineWidth(width if join == SLIT else width / 2)
                canvas.lines(lines)


def kilim_printing(cloth: KilimCloth, digits: str, language: str) -> Printing:
    """What the chart of a kilim has beside its cells: its legend, the mounting, slits and joins."""
    chart = cloth.chart
    note = Sentence("kilim.marks", picks=cloth.params.step, bobbins=cloth.work.bobbins.max())
    warps = mounting(chart, replace(cloth.ground, selvedge_warps=0))
    marks = kilim_marks(chart.knots, cloth.params).draw
    return Printing(digits, None, warps, language, marks=marks, notes=(note,), technique="kilim")


def kilim_marks(chart_knots: Indices, params: KilimParams) -> KilimMarks:
    """The marks of a chart."""
    joints = joined(chart_knots, params)
    return KilimMarks(borders(chart_knots) & ~joints, joints, params.join)


def mark(x: float, y: float, cell: tuple[float, float], join: str) -> list[tuple[float, float, float, float]]:
    """The lines of a mark along the left edge of a cell whose lower left corner is given [pt].

    >>> mark(0.0, 0.0, (8.0, 4.0), SLIT)
    [(0.0, 0.0, 0.0, 4.0)]
    """
    wide, high = cell
    tooth = {SLIT: 0.0, DOVETAIL: wide / 4, INTERLOCK: wide / 8}[join]
    if join == DOVETAIL:
        return [
            (x - tooth, y + high / 4, x + tooth, y + high / 4),
            (x - tooth, y + 3 * high / 4, x + tooth, y + 3 * high / 4),
        ]
    if join == INTERLOCK:
        return [(x - tooth, y, x + tooth, y + high / 2), (x + tooth, y + high / 2, x - tooth, y + high)]
    return [(x, y, x, y + high)]
