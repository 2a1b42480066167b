"""The PDF files of a chart: how they are opened and closed, their language and the digits of their numbers."""

import math
import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any

from reportlab import rl_config
from reportlab.lib.pagesizes import A4
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfgen.canvas import Canvas

from ilmek.carpet.bill import YarnBill
from ilmek.carpet.chart import Chart
from ilmek.carpet.mounting import Mounting
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.io.chart.lettering import draw_line, is_plain, line_width
from ilmek.io.chart.sheets import ChartSheet, SheetLayout
from ilmek.io.chart.symbols import STRONG, register_fonts
from ilmek.records import record
from ilmek.sentences import (
    DEFAULT,
    LATIN,
    WEAVERS,
    Name,
    Sentence,
    changed,
    in_language,
    language_spoken,
    noun,
    translated,
)
from ilmek.units import cm, format_number

DIGITS = {"latin": LATIN} | {code: row.digits for code, row in WEAVERS.items() if row.digits != LATIN}
"""Digits 0 to 9 by the language that writes with them. The fonts of the printed files have them."""

_WORDS, _CODE = re.compile(r"( +)"), re.compile(r"[#A-Za-z]")
"""Blanks between words, and the begin of a code."""

_BETWEEN = re.compile(r"(?<=[۰-۹٠-٩])[.\u202f](?=[۰-۹٠-٩])")
_KEPT = str.maketrans(LATIN, "".join(chr(0xE000 + digit) for digit in range(10)))
_SHOWN = {code: chr(digit) for digit, code in _KEPT.items()}
"""Digits of a name within a sentence, for private use while those around them are changed."""

_POINT = re.compile(r"(?<![.\d])(\d[\d\u202f]*)\.(?=\d)(?!\d+\.\d)")
"""The point of one decimal number, not of 1.2.3."""

_SIGNS = {".": "٫", "\u202f": "٬"}
"""Decimal point and mark of thousands between Arabic digits."""


@record
class Printing:
    """What the printed files of a chart have besides it.

    digits    of DIGITS; "": those of the language       language  of WEAVERS
    bill      the yarn to buy      mounting  of the warps; None: neither is printed
    name      of the carpet, colourway included; "": it has none
    marks     drawn on the cells of a sheet: with canvas, rows of the chart, layout and sheet; None: none
    pile      height of knots without one of their own [m]; None: the usual one
    notes     lines below the yarns of the legend
    technique whose nouns are said; "": that of knots
    """

    digits: str = ""
    bill: YarnBill | None = None
    mounting: Mounting | None = None
    language: str = DEFAULT
    name: str = ""
    marks: Callable[[Any, int, SheetLayout, ChartSheet], None] | None = None
    notes: tuple[Sentence, ...] = ()
    pile: float | None = None
    technique: str = ""


PLAIN = Printing()
"""The chart alone."""


class PrintCanvas(Canvas):  # type: ignore[misc]
    """A canvas of the language that is spoken, in any script, with the digits of one; symbols and names stay as they
    are.

    unit      points in a unit of length of the file
    printing  what the file has besides a chart
    leftward  whether lines begin at the right side of the page
    """

    def __init__(self, path: Path, digits: str = "", **more: object) -> None:
        super().__init__(str(path), pageCompression=1, invariant=1, **more)
        language = language_spoken()
        self.unit, self.leftward, self.printing = 1, language.leftward, PLAIN
        self._point = language.point
        self._digits = str.maketrans(LATIN, DIGITS[digits] if digits else language.digits)
        self._figures: dict[str, str] = {}
        self._shown: dict[tuple[str, str, float], tuple[str, float]] = {}

    def numerals(self, text: str) -> str:
        """A text in the language and with the digits of this canvas; a code, like N-204 or #9e2b25, and a name keep
        their own.
        """
        if isinstance(text, Name):
            return text
        if not isinstance(text, Sentence):
            if text not in self._figures:
                parts = (part if _CODE.match(part) else self._written(part) for part in _WORDS.split(text))
                self._figures[text] = "".join(parts)
            return self._figures[text]
        kept = changed(text, lambda value: value.translate(_KEPT) if isinstance(value, Name) else value)
        return self._written(translated(kept)).translate(_SHOWN)

    def _written(self, text: str) -> str:
        """Digits, decimal points and marks of thousands of the language."""
        pointed = text if self._point == "." else _POINT.sub(rf"\1{self._point}", text)
        return _BETWEEN.sub(lambda sign: _SIGNS[sign[0]], pointed.translate(self._digits))

    def side(self, x: float, width: float = 0.0) -> float:
        """The left edge of what is as wide and lies x from the side of the page where lines begin."""
        return self._pagesize[0] * self.unit - x - width if self.leftward else x

    def drawString(self, x: float, y: float, text: str) -> None:
        """As of reportlab, in the language and the digits of this canvas."""
        self._draw(x, y, self.numerals(text), 0.0)

    def drawRightString(self, x: float, y: float, text: str) -> None:
        """As of reportlab, in the language and the digits of this canvas."""
        self._draw(x, y, self.numerals(text), 1.0)

    def drawCentredString(self, x: float, y: float, text: str) -> None:
        """As of reportlab, in the language and the digits of this canvas."""
        self._draw(x, y, self.numerals(text), 0.5)

    def lines(self, linelist: Iterable[tuple[float, float, float, float]]) -> None:
        """As of reportlab, which takes ten times as long to write the numbers (ISO 32000-1, 8.5)."""
        self.addLiteral(" ".join(f"{x:.3f} {y:.3f} m {to:.3f} {up:.3f} l" for x, y, to, up in linelist) + " S")

    def write(self, x: float, y: float, text: str) -> None:
        """Write a text that begins x from the side where lines begin."""
        self._draw(self.side(x), y, self.numerals(text), float(self.leftward))

    def write_to(self, x: float, y: float, text: str) -> None:
        """Write a text that ends x from the side where lines begin."""
        self._draw(self.side(x), y, self.numerals(text), float(not self.leftward))

    def name_of(self, name: str) -> str:
        """The name of a yarn: in the language of this canvas where it is one of ours, else as it is."""
        known = noun(name)
        return self.numerals(known) if isinstance(known, Sentence) else name

    def write_name(self, x: float, y: float, name: str, size: float) -> None:
        """Write a name in its own direction and with its own digits, x from the side where lines begin."""
        draw_line(self, self.side(x, line_width(name, size)), y, name, size)

    def text_width(self, text: str) -> float:
        """Width of a text as it is written in the present font [pt]."""
        return line_width(self.numerals(text), self._fontsize, self._fontname, not self.leftward)

    def _draw(self, x: float, y: float, text: str, share: float) -> None:
        """Draw a text with a share of its width before x; one that is plain is encoded once, as there are thousands."""
        font, size, rightward = self._fontname, self._fontsize, not self.leftward
        if is_plain(text, font):
            key = (text, font, size)
            if key not in self._shown:
                self._shown[key] = self.operators(text, font, size), self.stringWidth(text, font, size)
            code, width = self._shown[key]
            self.addLiteral(f"BT 1 0 0 1 {x - share * width:.3f} {y:.3f} Tm {code} T* ET")
            return
        draw_line(
            self, x - share * line_width(text, size, font, rightward), y, text, size, base=font, rightward=rightward
        )
        self.setFont(font, size)

    def operators(self, text: str, font: str, size: float) -> str:
        """The operators of PDF that show a text where a text object is (ISO 32000-1, 9.4), font included."""
        made = self.beginText()
        made.setFont(font, size)
        made.textOut(text)
        code: str = made.getCode()  # BT, where it begins, font, text, ET
        return code.partition(" Tm ")[2].removesuffix(" ET")

    def code(self, letter: str, font: str) -> tuple[str, str]:
        """The name of the part of a font that has a letter, and its code in a text of PDF; a blank has its own."""
        face = pdfmetrics.getFont(font)
        ((part, code),) = face.splitString(letter, self._doc)
        return face.getSubsetInternalName(part, self._doc), self._escape(code)

    def draw_letters(self, x: float, y: float, text: str) -> None:
        """A text from x to the right, with its own digits."""
        super().drawString(x, y, text)

    def draw_sign(self, x: float, y: float, sign: str) -> None:
        """The symbol of a yarn, centred on x."""
        super().drawCentredString(x, y, sign)


def title_of(chart: Chart, printing: Printing = PLAIN) -> str:
    """The name of a chart's carpet, or of its size, or its columns and rows."""
    return (
        Name(printing.name) or noun(chart.size.name) or Sentence("chart.grid", columns=chart.columns, rows=chart.rows)
    )


def size_of(size: CarpetSize) -> str:
    """Width and length in cm, after the name of the size where it has one."""
    sides = (format_number(side / cm) for side in (size.width, size.length))
    text = Sentence("chart.size", **dict(zip(("width", "length"), sides, strict=True)))
    return Sentence("chart.named-size", name=noun(size.name), size=text) if size.name else text


def quality_of(quality: Quality) -> Sentence:
    """Knots across and along per dm."""
    return Sentence("chart.quality", across=format_number(quality.across / 10), along=format_number(quality.along / 10))


@contextmanager
def printed_file(path: Path, title: str, printing: Printing | None = None, **more: object) -> Iterator[PrintCanvas]:
    """The canvas of a PDF file, which is saved at the end; the same pages make the same file.

    printing  default: in the language that is spoken
    more      of reportlab's Canvas: pagesize (default: A4), pdfVersion
    Streams are bytes, not base-85 text: smaller, and several times faster.
    """
    register_fonts()
    config: Any = rl_config
    before = config.useA85
    config.useA85 = 0
    try:
        with nullcontext() if printing is None else in_language(printing.language, printing.technique):
            spoken = {} if printing is None else {"digits": printing.digits, "lang": printing.language}
            canvas = PrintCanvas(path, **{"pagesize": A4, **spoken, **more})
            canvas.printing = printing or PLAIN
            canvas.setTitle(canvas.numerals(title))
            canvas.setCreator("ilmek")
            if canvas.leftward:
                canvas.setViewerPreference("Direction", "R2L")
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
