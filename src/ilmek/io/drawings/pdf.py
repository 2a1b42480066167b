"""Drawing sheets as one PDF: vector lines in true size, arcs as Bézier curves, fonts embedded.

An arc of the sweep s <= 90° is a cubic curve whose handles are 4/3 tan(s/4) radii long: off by R/3700 at most.
"""

import math
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np
from reportlab.lib.units import mm as point_per_mm
from reportlab.pdfgen.pathobject import PDFPathObject

from ilmek.io.chart.printing import PrintCanvas, printed_file, write_stamp
from ilmek.io.chart.symbols import STRONG, TEXT
from ilmek.plane.contours import STRAIGHT, arc_centre
from ilmek.report.sheet import LINE_DASHES, LINE_WIDTHS, DrawingSheet, LineKind, SheetLine, SheetText, arrowhead
from ilmek.sentences import translated

CAPITAL = 0.729
"""Height of a capital over the size of DejaVu Sans."""

DECIMALS = 4
"""Of coordinates [mm]."""

_MOVE, _DRAW, _CURVE = "%.8g %.8g m", "%.8g %.8g l", "%.8g %.8g %.8g %.8g %.8g %.8g c"


def write_sheets_pdf(path: Path, sheets: Iterable[DrawingSheet], title: str) -> None:
    """Write sheets as the pages of a file. Sentences in the language that is spoken. The same sheets give the same
    bytes. Raises OSError.
    """
    with printed_file(path, title) as canvas:
        for sheet in sheets:
            canvas.setPageSize((sheet.width * point_per_mm, sheet.height * point_per_mm))
            canvas.bookmarkPage(f"{sheet.number}-{sheet.page}")
            canvas.addOutlineEntry(f"{sheet.number} {translated(sheet.title)}", f"{sheet.number}-{sheet.page}")
            _draw(canvas, sheet)
            canvas.showPage()


def _draw(canvas: PrintCanvas, sheet: DrawingSheet) -> None:
    canvas.scale(point_per_mm, point_per_mm)
    canvas.setLineJoin(1)
    if sheet.stamp:
        write_stamp(canvas, translated(sheet.stamp), sheet.width, sheet.height)
    kinds: dict[object, list[SheetLine]] = {}
    for line in (*sheet.lines, *(line for dimension in sheet.dimensions for line in dimension.lines)):
        kinds.setdefault(line.kind, []).append(line)
    for kind, lines in kinds.items():
        canvas.setLineWidth(LINE_WIDTHS[kind])  # type: ignore[index]
        canvas.setDash(list(LINE_DASHES.get(kind, ())))  # type: ignore[call-overload]
        canvas.setLineCap(0 if kind in LINE_DASHES else 1)
        canvas.drawPath(_path(lines), stroke=1, fill=0)
    arrows = (arrowhead(*arrow) for dimension in sheet.dimensions for arrow in dimension.arrows)
    heads = [SheetLine(LineKind.DIMENSION, np.array(corners), closed=True) for corners in arrows]
    if heads:
        canvas.drawPath(_path(heads), stroke=0, fill=1)
    for text in (*sheet.texts, *(dimension.text for dimension in sheet.dimensions)):
        _write(canvas, text)


def _write(canvas: PrintCanvas, text: SheetText) -> None:
    canvas.saveState()
    canvas.setFont(STRONG if text.bold else TEXT, text.height / CAPITAL)
    canvas.setFillGray(0.35 if text.light else 0.0)
    canvas.translate(text.position.real, text.position.imag)
    if text.angle:
        canvas.rotate(math.degrees(text.angle))
    draw = {"left": canvas.drawString, "center": canvas.drawCentredString, "right": canvas.drawRightString}
    draw[text.anchor](0, 0, translated(text.words))
    canvas.restoreState()


def _path(lines: Sequence[SheetLine]) -> PDFPathObject:
    """Lines as a path: its operators are written at once, many times as quickly as one by one by the library."""
    operators, points = ["n"], list[complex]()
    for line in lines:
        _trace(line, operators, points)
    numbers = np.array(points, dtype=complex).view(float).round(DECIMALS) + 0.0
    return PDFPathObject([" ".join(operators) % tuple(numbers.tolist())])


def _trace(line: SheetLine, operators: list[str], drawn: list[complex]) -> None:
    """Add the operators of a line, and the points that they draw to."""
    points = line.points.tolist()
    ends = [*points[1:], points[0]] if line.closed else points[1:]
    bulges = [0.0] * len(ends) if line.bulges is None else line.bulges.tolist()
    operators.append(_MOVE)
    drawn.append(points[0])
    for start, end, bulge in zip(points, ends, bulges, strict=False):
        if abs(bulge) < STRAIGHT:
            operators.append(_DRAW)
            drawn.append(end)
            continue
        centre, sweep = arc_centre(start, end, bulge), 4 * math.atan(bulge)
        pieces = math.ceil(abs(sweep) / (math.pi / 2) - 1e-9)
        step = sweep / pieces
        turn = complex(math.cos(step), math.sin(step))
        handle = 4 / 3 * math.tan(step / 4)
        arm = start - centre
        for _ in range(pieces):
            after = arm * turn
            operators.append(_CURVE)
            drawn += (centre + arm * (1 + 1j * handle), centre + after * (1 - 1j * handle), centre + after)
            arm = after
    if line.closed:
        operators.append("h")
