"""One sheet of a knot chart: cells, symbols, lines, numbers, marks."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ilmek.arrays import Indices
from ilmek.carpet.cells import OUTSIDE
from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import CODES
from ilmek.io.chart.inks import Inks
from ilmek.io.chart.overlay_marks import draw_marks
from ilmek.io.chart.printing import PrintCanvas, Printing
from ilmek.io.chart.sheets import ChartSheet, SheetLayout
from ilmek.io.chart.symbols import ADVANCE, SIGNS, STRONG, TEXT
from ilmek.sentences import Name, Sentence

_LEFT, _TOP = 54.0, 800.0
"""Left edge of the cells and baseline of the title [pt]."""

_HATCH = 6.0
"""Distance of the lines in what is cut away, along an edge [pt]."""

_GREY, _LIGHT = (0.36, 0.40, 0.44), (0.55, 0.58, 0.62)


def draw_sheet(
    canvas: PrintCanvas, chart: Chart, plan: SheetLayout, sheet: ChartSheet, inks: Inks, *, printing: Printing
) -> None:
    """Draw a sheet on a page of its own, with the marks that are printed."""
    canvas.bookmarkPage(f"sheet-{sheet.number}")
    entry = Sentence("chart.sheet", number=sheet.number, title=sheet.title)
    canvas.addOutlineEntry(canvas.numerals(entry), f"sheet-{sheet.number}", 1)
    canvas.saveState()
    canvas.translate(_LEFT, _TOP - 42.0 - (sheet.shown_high - sheet.low) * plan.cell_height)
    draw_cells(canvas, chart, plan, sheet, inks)
    if printing.marks is not None:
        printing.marks(canvas, chart.rows, plan, sheet)
    canvas.restoreState()
    _write_title(canvas, plan, sheet)
    canvas.showPage()


def draw_cells(canvas: PrintCanvas, chart: Chart, plan: SheetLayout, sheet: ChartSheet, inks: Inks) -> None:
    """Draw the knots of a sheet with their symbols, marks, lines and numbers; the origin is their lower left corner."""
    rows = slice(chart.rows - sheet.shown_high, chart.rows - sheet.low)
    cells = chart.knots[rows, sheet.left : sheet.shown_right][::-1]
    _fill_cells(canvas, cells, plan, inks)
    _write_symbols(canvas, cells, plan, inks)
    if chart.cells is not None:
        outside = chart.cells.are(OUTSIDE)[rows, sheet.left : sheet.shown_right][::-1].astype(np.uint8)
        wide, high = plan.cell_width, plan.cell_height
        boxes = [(first * wide, row * high, count * wide, high) for row, first, count in runs(outside).get(1, ())]
        if boxes:
            hatch(canvas, boxes)
    draw_marks(canvas, chart, plan, sheet, inks)
    _shade_overlap(canvas, plan, sheet)
    _draw_lines(canvas, plan, sheet)
    _draw_piles(canvas, chart, plan, sheet)
    _write_numbers(canvas, plan, sheet)
    _mark_middle(canvas, plan, sheet)


def runs(cells: Indices) -> dict[int, list[tuple[int, int, int]]]:
    """The runs of one yarn along the rows: (row, first knot, knots), by yarn.

    >>> runs(np.array([[0, 0, 1], [1, 1, 1]], dtype=np.uint8))
    {0: [(0, 0, 2)], 1: [(0, 2, 1), (1, 0, 3)]}
    """
    columns = cells.shape[1]
    flat = cells.ravel()
    begins = np.ones(flat.size, dtype=bool)
    begins[1:] = flat[1:] != flat[:-1]
    begins[::columns] = True
    starts = np.flatnonzero(begins)
    lengths = np.diff(np.append(starts, flat.size))
    by_yarn: dict[int, list[tuple[int, int, int]]] = {}
    rows, firsts = np.divmod(starts, columns)
    for yarn, *run in zip(flat[starts].tolist(), rows.tolist(), firsts.tolist(), lengths.tolist(), strict=True):
        by_yarn.setdefault(yarn, []).append((run[0], run[1], run[2]))
    return by_yarn


def _fill_cells(canvas: PrintCanvas, cells: Indices, plan: SheetLayout, inks: Inks) -> None:
    """One filled path per yarn, one rectangle per run; the unit is a cell."""
    canvas.saveState()
    canvas.scale(plan.cell_width, plan.cell_height)
    for yarn, pieces in sorted(runs(cells).items()):
        canvas.setFillColorRGB(*inks.fills[yarn])
        # Operators of PDF (ISO 32000-1, 8.5): reportlab writes a rectangle 15 times slower, and there are thousands.
        canvas.addLiteral(" ".join([f"{first} {row} {count} 1 re" for row, first, count in pieces]) + " f")
    canvas.restoreState()


def hatch(canvas: PrintCanvas, boxes: Sequence[tuple[float, float, float, float]]) -> None:
    """Boxes of x, y, width and height [pt] in white with thin slanting lines: what is cut away."""
    left, low = (min(box[side] for box in boxes) for side in (0, 1))
    right, high = (max(box[side] + box[side + 2] for box in boxes) for side in (0, 1))
    path = " ".join(f"{x:.3f} {y:.3f} {width:.3f} {height:.3f} re" for x, y, width, height in boxes)
    canvas.saveState()
    canvas.setFillGray(1.0)
    canvas.addLiteral(f"{path} f {path} W n")
    canvas.setStrokeGray(0.6)
    canvas.setLineWidth(0.4)
    rise = high - low
    canvas.lines([(at - rise, low, at, high) for at in np.arange(left, right + rise, _HATCH).tolist()])
    canvas.restoreState()


def _write_symbols(canvas: PrintCanvas, cells: Indices, plan: SheetLayout, inks: Inks) -> None:
    """Each row as texts, black and white, spaced so that every symbol is in its cell; one for each part of the font."""
    size = min(0.74 * plan.cell_height, 0.98 * plan.cell_width)
    indent = (plan.cell_width - ADVANCE * size) / 2
    rise = (plan.cell_height - 0.72 * size) / 2
    codes = {of: canvas.code(inks.symbols[of], SIGNS) for of in np.unique(cells).tolist()}
    canvas.saveState()  # restores the character spacing
    for part, white in sorted({(part, inks.white[of]) for of, (part, _) in codes.items()}):
        signs = np.full(CODES, " ", dtype=object)
        for of, (own, code) in codes.items():
            signs[of] = code if (own, inks.white[of]) == (part, white) else " "
        lines = [f"BT {part} {size:.3f} Tf {plan.cell_width - ADVANCE * size:.3f} Tc {int(white)} g"]
        for row, line in enumerate(signs[cells].tolist()):
            written = "".join(line).rstrip()
            if written:
                lines.append(f"1 0 0 1 {indent:.3f} {row * plan.cell_height + rise:.3f} Tm ({written}) Tj")
        canvas.addLiteral("\n".join([*lines, "ET"]))
    canvas.restoreState()


def _shade_overlap(canvas: PrintCanvas, plan: SheetLayout, sheet: ChartSheet) -> None:
    """Lighten the knots that belong to the next sheets."""
    width, height = sheet.right - sheet.left, sheet.high - sheet.low
    canvas.saveState()
    canvas.setFillColorRGB(1, 1, 1, alpha=0.55)
    canvas.scale(plan.cell_width, plan.cell_height)
    path = canvas.beginPath()
    path.rect(width, 0, sheet.shown_right - sheet.right, sheet.shown_high - sheet.low)
    path.rect(0, height, width, sheet.shown_high - sheet.high)
    canvas.drawPath(path, stroke=0, fill=1)
    canvas.restoreState()


def _draw_lines(canvas: PrintCanvas, plan: SheetLayout, sheet: ChartSheet) -> None:
    """Hairlines around each cell, a bold line every 10 knots of the carpet."""
    wide, high = plan.cell_width, plan.cell_height
    columns, rows = sheet.shown_right - sheet.left, sheet.shown_high - sheet.low
    upright = [(number * wide, 0.0, number * wide, rows * high) for number in range(columns + 1)]
    level = [(0.0, number * high, columns * wide, number * high) for number in range(rows + 1)]
    canvas.setStrokeColorRGB(0.25, 0.25, 0.25, alpha=0.55)
    canvas.setLineWidth(0.2)
    canvas.lines(upright + level)
    bold = [line for number, line in enumerate(upright) if (sheet.left + number) % 10 == 0]
    bold += [line for number, line in enumerate(level) if (sheet.low + number) % 10 == 0]
    canvas.setStrokeColorRGB(0, 0, 0, alpha=1)
    canvas.setLineWidth(0.9)
    canvas.lines(bold)
    canvas.rect(0, 0, columns * wide, rows * high, stroke=1, fill=0)


def _draw_piles(canvas: PrintCanvas, chart: Chart, plan: SheetLayout, sheet: ChartSheet) -> None:
    """A dashed line where the pile of neighbouring knots changes."""
    if chart.cells is None or sum(kind.knotted for kind in chart.cells.kinds) < 2:
        return
    rows = slice(chart.rows - sheet.shown_high, chart.rows - sheet.low)
    shown = rows, slice(sheet.left, sheet.shown_right)
    kinds, tied = (of[shown][::-1] for of in (chart.cells.index, chart.cells.tied))
    wide, high = plan.cell_width, plan.cell_height
    aside = (kinds[:, 1:] != kinds[:, :-1]) & tied[:, 1:] & tied[:, :-1]
    above = (kinds[1:] != kinds[:-1]) & tied[1:] & tied[:-1]
    lines = [((c + 1) * wide, r * high, (c + 1) * wide, (r + 1) * high) for r, c in np.argwhere(aside).tolist()]
    lines += [(c * wide, (r + 1) * high, (c + 1) * wide, (r + 1) * high) for r, c in np.argwhere(above).tolist()]
    canvas.saveState()
    for grey, dash in ((1.0, ()), (0.0, (2.0, 1.5))):
        canvas.setStrokeGray(grey)
        canvas.setLineWidth(1.4)
        canvas.setDash(*dash)
        canvas.lines(lines)
    canvas.restoreState()


def _write_numbers(canvas: PrintCanvas, plan: SheetLayout, sheet: ChartSheet) -> None:
    """Row numbers at both sides, every fifth knot number above and below; tens in bold."""
    wide, high = plan.cell_width, plan.cell_height
    right, top = (sheet.shown_right - sheet.left) * wide, (sheet.shown_high - sheet.low) * high
    small = min(5.2, 0.8 * high)
    for row in range(sheet.low + 1, sheet.shown_high + 1):
        y = (row - sheet.low - 0.5) * high - 0.36 * small
        _ink(canvas, row, small, row <= sheet.high)
        canvas.drawRightString(-3.5, y, str(row))
        canvas.drawString(right + 3.5, y, str(row))
    for knot in range(sheet.left + 1, sheet.shown_right + 1):
        if knot % 5 == 0 or knot == sheet.left + 1:
            x = (knot - sheet.left - 0.5) * wide
            _ink(canvas, knot, 5.2, knot <= sheet.right)
            canvas.drawCentredString(x, -8.5, str(knot))
            canvas.drawCentredString(x, top + 4.0, str(knot))


def _ink(canvas: PrintCanvas, number: int, size: float, own: bool) -> None:
    """Font and grey of a number: tens bold and black, those of the overlap pale."""
    canvas.setFont(STRONG if number % 10 == 0 else TEXT, size)
    canvas.setFillColorRGB(*((0.1, 0.1, 0.1) if number % 10 == 0 and own else _GREY if own else _LIGHT))


def _mark_middle(canvas: PrintCanvas, plan: SheetLayout, sheet: ChartSheet) -> None:
    """Arrowheads on the edges at the carpet's middle column and row, if the sheet contains them."""
    right, top = (sheet.shown_right - sheet.left) * plan.cell_width, (sheet.shown_high - sheet.low) * plan.cell_height
    x = (plan.columns / 2 - sheet.left) * plan.cell_width
    y = (plan.rows / 2 - sheet.low) * plan.cell_height
    canvas.setFillColorRGB(0.70, 0.12, 0.12)
    path = canvas.beginPath()
    if 0 <= x <= (sheet.right - sheet.left) * plan.cell_width:
        for tip, base in ((-10.0, -17.0), (top + 10.5, top + 17.5)):
            _triangle(path, (x, tip), (x - 4.0, base), (x + 4.0, base))
    if 0 <= y <= (sheet.high - sheet.low) * plan.cell_height:
        for tip, base in ((-17.0, -24.0), (right + 17.0, right + 24.0)):
            _triangle(path, (tip, y), (base, y - 4.0), (base, y + 4.0))
    canvas.drawPath(path, stroke=0, fill=1)


def _triangle(path: Any, *corners: tuple[float, float]) -> None:
    path.moveTo(*corners[0])
    for corner in corners[1:]:
        path.lineTo(*corner)
    path.close()


def _write_title(canvas: PrintCanvas, plan: SheetLayout, sheet: ChartSheet) -> None:
    """Write the title of the sheet, and links to its neighbours."""
    canvas.setFillColorRGB(0.1, 0.1, 0.1)
    canvas.setFont(STRONG, 11)
    canvas.write(_LEFT, _TOP, sheet.title)
    canvas.setFont(TEXT, 8)
    canvas.setFillColorRGB(*_GREY)
    canvas.write_to(541.0, _TOP, Sentence("chart.sheet-of", number=sheet.number, count=plan.count))
    canvas.write_to(541.0, 26.0, Name(canvas.printing.name))
    x = _LEFT
    for side, number in sheet.neighbours.items():
        if number:
            text = Sentence(f"chart.{side}", number=number)
            width = canvas.text_width(text)
            canvas.write(x, 26.0, text)
            left = canvas.side(x, width)
            canvas.linkRect("", f"sheet-{number}", (left, 22.0, left + width, 34.0), thickness=0)
            x += width + 18.0
