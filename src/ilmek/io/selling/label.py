"""The label of a carpet as PDF: its name, size and fibre, and a QR code that leads to its record without a network."""

import importlib
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from reportlab.lib.units import mm

from ilmek.errors import ParameterError
from ilmek.io.chart.printing import PrintCanvas, printed_file
from ilmek.io.chart.symbols import STRONG, TEXT
from ilmek.sentences import Sentence

_SIZE = (100 * mm, 60 * mm)
_CODE = 38 * mm


def import_codes() -> Any:
    """The module that makes QR codes. Raises ParameterError, naming the extra, where it is not installed."""
    try:
        return importlib.import_module("segno")
    except ImportError:
        do = "pip install 'ilmek[orders]'"
        raise ParameterError("the label of a carpet needs segno, which is not installed", do=do) from None


def draw_code(canvas: PrintCanvas, text: str, x: float, y: float, size: float) -> None:
    """Draw a QR code of a text, error correction M, in a square with its lower left corner at x, y [pt]."""
    rows = [list(row) for row in import_codes().make(text, error="m", micro=False).matrix]
    module = size / len(rows)
    canvas.setFillGray(0.0)
    for number, row in enumerate(rows):
        start = None
        for column, dark in enumerate([*row, 0]):
            if dark and start is None:
                start = column
            elif not dark and start is not None:
                upper = y + size - (number + 1) * module
                canvas.rect(x + start * module, upper, (column - start) * module, module, stroke=0, fill=1)
                start = None


def write_label(path: Path, name: str, facts: Iterable[tuple[str, str]], code: str) -> None:
    """Write the label in the language that is spoken. Raises OSError, ParameterError."""
    with printed_file(path, Sentence("order.label"), pagesize=_SIZE) as canvas:
        canvas.setStrokeGray(0.6)
        canvas.setLineWidth(0.5)
        canvas.rect(2 * mm, 2 * mm, _SIZE[0] - 4 * mm, _SIZE[1] - 4 * mm)
        canvas.setFont(STRONG, 9)
        canvas.setFillGray(0.1)
        canvas.write(6 * mm, 50 * mm, name)
        lines = list(facts)
        step = min(4.6, 34.0 / len(lines))
        canvas.setFont(TEXT, 7)
        begin = max(20 * mm, *(8 * mm + canvas.text_width(heading) for heading, _ in lines))
        for line, (heading, text) in enumerate(lines):
            canvas.setFont(TEXT, 7)
            canvas.setFillGray(0.42)
            canvas.write(6 * mm, (43.5 - step * line) * mm, heading)
            canvas.setFillGray(0.1)
            canvas.write(begin, (43.5 - step * line) * mm, text)
        draw_code(canvas, code, canvas.side(_SIZE[0] - _CODE - 6 * mm, _CODE), 9 * mm, _CODE)
        canvas.setFont(TEXT, 4.6)
        canvas.setFillGray(0.42)
        canvas.draw_letters(6 * mm, 4 * mm, code)
        canvas.showPage()
