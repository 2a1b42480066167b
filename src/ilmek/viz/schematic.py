"""Diagrams of circuits, as large as they are on paper."""

import math

from ilmek.report.sheet import LINE_DASHES, LINE_WIDTHS, Schematic
from ilmek.viz.drawings.picture import CAPITAL, SheetPicture, line_points
from ilmek.viz.sheet import Sheet

MM = 72 / 25.4
"""Points in a millimetre."""

_EDGE = 2.0
"""Room round a diagram [mm]."""


def draw_schematic(figure: Schematic) -> Sheet:
    """The diagram on a sheet of its size."""
    left, low, right, high = SheetPicture(figure.lines, figure.texts, ()).box
    corner = complex(left - _EDGE, low - _EDGE)
    sheet = Sheet((right - left + 2 * _EDGE) * MM, (high - low + 2 * _EDGE) * MM)
    for line in figure.lines:
        width = LINE_WIDTHS[line.kind]
        dashes = [length / width for length in LINE_DASHES.get(line.kind, ())]
        sheet.line((line_points(line) - corner) * MM, linewidth=round(width * MM, 3), dashes=dashes)
    for text in figure.texts:
        sheet.text(
            (text.position - corner) * MM,
            text.words,
            fontsize=round(text.height / CAPITAL * MM, 2),
            ha=text.anchor,
            bold=text.bold,
            rotation=math.degrees(text.angle),
        )
    return sheet
