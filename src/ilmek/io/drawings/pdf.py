"""Drawing sheets as one PDF: vector lines in true size, arcs as Bézier curves, fonts embedded.

An arc of the sweep s <= 90° is a cubic curve whose handles are 4/3 tan(s/4) radii long: off by R/3700 at most.
"""

import math
from collections.abc import Iterable
from pathlib import Path

from reportlab.lib.units import mm as point_per_mm
from reportlab.pdfgen.pathobject import PDFPathObject

from ilmek.io.chart.printing import PrintCanvas, printed_file, write_stamp
from ilmek.io.chart.symbols import STRONG, TEXT
from ilmek.plane.contours import STRAIGHT, arc_centre
from ilmek.report.sheet import LINE_DASHES, LINE_WIDTHS, DrawingSheet, SheetLine, SheetText, arrowhead
from ilmek.sentences import translated

CAPITAL = 0.729
"""Height of a capital over the size of DejaVu Sans."""


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
    for line in (*sheet.lines, *(line for one in sheet.dimensions for line in one.lines)):
        kinds.setdefault(line.kind, []).append(line)
    for kind, lines in kinds.items():
        canvas.setLineWidth(LINE_WIDTHS[kind])  # type: ignore[index]
        canvas.setDash(list(LINE_DASHES.get(kind, ())))  # type: ignore[call-overload]
        canvas.setLineCap(0 if kind in LINE_DASHES else 1)
        through = canvas.beginPath()
        for line in lines:
            _trace(through, line)
        canvas.drawPath(through, stroke=1, fill=0)
    heads = canvas.beginPath()
    for tip, direction in (arrow for one in sheet.dimensions for arrow in one.arrows):
        corners = arrowhead(tip, direction)
        heads.moveTo(corners[0].real, corners[0].imag)
        for corner in corners[1:]:
            heads.lineTo(corner.real, corner.imag)
        heads.close()
    canvas.drawPath(heads, stroke=0, fill=1)
    for text in (*sheet.texts, *(one.text for one in sheet.dimensions)):
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


def _trace(through: PDFPathObject, line: SheetLine) -> None:
    points = line.points.tolist()
    through.moveTo(points[0].real, points[0].imag)
    ends = [*points[1:], points[0]] if line.closed else points[1:]
    bulges = [0.0] * len(ends) if line.bulges is None else line.bulges.tolist()
    for start, end, bulge in zip(points, ends, bulges, strict=False):
        if abs(bulge) < STRAIGHT:
            through.lineTo(end.real, end.imag)
            continue
        centre, sweep = arc_centre(start, end, bulge), 4 * math.atan(bulge)
        pieces = math.ceil(abs(sweep) / (math.pi / 2) - 1e-9)
        step = sweep / pieces
        turn = complex(math.cos(step), math.sin(step))
        handle = 4 / 3 * math.tan(step / 4)
        arm = start - centre
        for _ in range(pieces):
            after = arm * turn
            first, second, last = centre + arm * (1 + 1j * handle), centre + after * (1 - 1j * handle), centre + after
            through.curveTo(first.real, first.imag, second.real, second.imag, last.real, last.imag)
            arm = after
    if line.closed:
        through.close()
