"""The PDF files of a chart: how they are opened and closed, and the digits of their numbers."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from reportlab import rl_config
from reportlab.lib.pagesizes import A4
from reportlab.pdfgen.canvas import Canvas

from ilmek.carpet.bill import YarnBill
from ilmek.carpet.chart import Chart
from ilmek.carpet.mounting import Mounting
from ilmek.io.chart.symbols import STRONG, register_fonts
from ilmek.records import record

DIGITS = {"latin": "0123456789", "fa": "۰۱۲۳۴۵۶۷۸۹", "ar": "٠١٢٣٤٥٦٧٨٩"}
"""Digits 0 to 9 by the language: Persian and Urdu (fa), Arabic (ar). The fonts of the printed files have them."""


@record
class Printing:
    """What the printed files of a chart have besides it.

    digits  of DIGITS      bill  the yarn to buy      mounting  of the warps; None: neither is printed
    """

    digits: str = "latin"
    bill: YarnBill | None = None
    mounting: Mounting | None = None


PLAIN = Printing()
"""The chart alone."""


class PrintCanvas(Canvas):  # type: ignore[misc]
    """A canvas that writes numbers in the digits of a script; symbols and names stay as they are."""

    def __init__(self, path: Path, digits: str, **more: object) -> None:
        super().__init__(str(path), pageCompression=1, invariant=1, **more)
        self._digits = str.maketrans(DIGITS["latin"], DIGITS[digits])

    def numerals(self, text: str) -> str:
        """A text with the digits of this canvas."""
        return text.translate(self._digits)

    def drawString(self, x: float, y: float, text: str) -> None:
        """As of reportlab, in the digits of this canvas."""
        super().drawString(x, y, self.numerals(text))

    def drawRightString(self, x: float, y: float, text: str) -> None:
        """As of reportlab, in the digits of this canvas."""
        super().drawRightString(x, y, self.numerals(text))

    def drawCentredString(self, x: float, y: float, text: str) -> None:
        """As of reportlab, in the digits of this canvas."""
        super().drawCentredString(x, y, self.numerals(text))

    def draw_letters(self, x: float, y: float, text: str) -> None:
        """A text from x to the right, with its own digits."""
        super().drawString(x, y, text)

    def draw_sign(self, x: float, y: float, sign: str) -> None:
        """The symbol of a yarn, centred on x."""
        super().drawCentredString(x, y, sign)


def title_of(chart: Chart) -> str:
    """The name of a chart's size, or its columns and rows."""
    return chart.size.name or f"{chart.columns} × {chart.rows} knots"


@contextmanager
def printed_file(path: Path, title: str, digits: str = "latin", **more: object) -> Iterator[PrintCanvas]:
    """The canvas of a PDF file, which is saved at the end; the same pages make the same file.

    more  of reportlab's Canvas: pagesize (default: A4), pdfVersion
    Streams are bytes, not base-85 text: smaller, and several times faster.
    """
    register_fonts()
    config: Any = rl_config
    before = config.useA85
    config.useA85 = 0
    try:
        canvas = PrintCanvas(path, digits, **{"pagesize": A4, **more})
        canvas.setTitle(title)
        canvas.setCreator("ilmek")
        yield canvas
        canvas.save()
    finally:
        config.useA85 = before


def write_stamp(canvas: PrintCanvas, words: str, width: float, height: float) -> None:
    """Words across a page of a size, in the units of the canvas, pale: below all else if they are written first."""
    canvas.saveState()
    size = min(width, height) / 7.5
    canvas.setFont(STRONG, size)
    canvas.setFillColorRGB(1.0, 0.82, 0.82)
    canvas.translate(width / 2, height / 2)
    canvas.rotate(math.degrees(math.atan2(height, width)))
    canvas.drawCentredString(0, -size / 3, words)
    canvas.restoreState()
