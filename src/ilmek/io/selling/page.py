"""Pages of an order's papers: title, facts, tables and pictures under one another, in the language of their reader."""

import io
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from PIL import Image
from reportlab.lib.pagesizes import A4
from reportlab.lib.utils import ImageReader

from ilmek.io.chart.lettering import two_lines
from ilmek.io.chart.printing import PrintCanvas
from ilmek.io.chart.symbols import STRONG, TEXT
from ilmek.sentences import Name, Sentence

WIDTH, HEIGHT = A4
LEFT, TOP, LOW = 48.0, HEIGHT - 64.0, 62.0
ROOM = WIDTH - 2 * LEFT
"""Margins of a page, and the width between them [pt]."""

_INK, _GREY, _RULE = 0.1, 0.42, 0.75

_QUALITY = 92
"""Of pictures as JPEG."""


class PageColumn(NamedTuple):
    """A column of a table: where it begins, or with `end` where it ends, from the side where lines begin [pt]."""

    head: str
    x: float
    end: bool = False


class OrderPage:
    """The pages of a paper with a baseline y [pt], from which the next lines are written down."""

    def __init__(self, canvas: PrintCanvas, title: str, reference: str) -> None:
        self.canvas, self.title, self.reference, self.number = canvas, title, reference, 0
        self.y = TOP
        self.begin()

    def begin(self) -> None:
        """Begin a page: its title, and at its foot the reference and its number."""
        canvas = self.canvas
        if self.number:
            canvas.showPage()
        self.number += 1
        self.write(LEFT, HEIGHT - 44.0, self.title, 9, grey=True)
        self.write(LEFT, 36.0, self.reference, 8, grey=True)
        self.write(WIDTH - LEFT, 36.0, Sentence("order.page", number=self.number), 8, grey=True, end=True)
        self.rule(HEIGHT - 50.0)
        self.y = TOP - 14.0

    def end(self) -> None:
        """End the last page."""
        self.canvas.showPage()

    def room(self, height: float) -> None:
        """Go to a new page where a height [pt] does not fit."""
        if self.y - height < LOW:
            self.begin()

    def write(
        self, x: float, y: float, text: str, size: float, *, strong: bool = False, grey: bool = False, end: bool = False
    ) -> None:
        """Write a text that begins, or with `end` ends, at x from the side where lines begin."""
        self.canvas.setFont(STRONG if strong else TEXT, size)
        self.canvas.setFillGray(_GREY if grey else _INK)
        (self.canvas.write_to if end else self.canvas.write)(x, y, text)

    def rule(self, y: float, x: float = LEFT, width: float = ROOM) -> None:
        """A thin line across the page."""
        self.canvas.setStrokeGray(_RULE)
        self.canvas.setLineWidth(0.5)
        left = self.canvas.side(x, width)
        self.canvas.line(left, y, left + width, y)

    def heading(self, text: str, size: float = 12.0) -> None:
        """A heading."""
        self.room(4 * size)
        self.y -= 1.2 * size
        self.write(LEFT, self.y, text, size, strong=True)
        self.y -= 0.6 * size + 8.0

    def facts(self, facts: Iterable[tuple[str, str]], x: float = LEFT, beside: float = 110.0) -> None:
        """Names with their values."""
        for name, value in facts:
            self.room(14.0)
            self.write(x, self.y, name, 9, grey=True)
            self.paragraph(value, x + beside, 9)

    def paragraph(self, text: str, x: float, size: float, *, grey: bool = False) -> None:
        """A text in as many lines as it takes between x and the margin where lines end."""
        rest = self.canvas.numerals(text)
        while rest:
            line, rest = two_lines(rest, size, LEFT + ROOM - x)
            self.write(x, self.y, Name(line), size, grey=grey)
            self.y -= size + 5.0

    def table(self, columns: Sequence[PageColumn], rows: Iterable[Sequence[str]], *, sums: int = 0) -> None:
        """A table, whose heads are repeated on each page; sums: number of last rows that are sums."""
        listed = list(rows)
        self.room(40.0)
        self._heads(columns)
        for number, row in enumerate(listed):
            if self.y - 14.0 < LOW:
                self.begin()
                self._heads(columns)
            is_sum = number >= len(listed) - sums
            if is_sum and number == len(listed) - sums:
                self.rule(self.y + 10.5)
            for column, text in zip(columns, row, strict=True):
                self.write(LEFT + column.x, self.y, text, 8.5, end=column.end, strong=is_sum)
            self.y -= 14.0
        self.y -= 4.0

    def _heads(self, columns: Sequence[PageColumn]) -> None:
        for column in columns:
            self.write(LEFT + column.x, self.y, column.head, 7.5, grey=True, end=column.end)
        self.rule(self.y - 4.0)
        self.y -= 16.0

    def picture(self, image: Image.Image, x: float, y: float, width: float, height: float) -> tuple[float, float]:
        """A picture in a box with its lower edge at y, in true proportion in the box's middle; its width and height."""
        wide, high = image.size
        scale = min(width / wide, height / high)
        size = scale * wide, scale * high
        left = self.canvas.side(x, width) + (width - size[0]) / 2
        self.canvas.drawImage(_as_photograph(image), left, y + (height - size[1]) / 2, *size)
        return size

    def swatch(self, x: float, y: float, srgb: tuple[int, int, int], size: tuple[float, float] = (22.0, 10.0)) -> None:
        """A field in a colour."""
        self.canvas.setFillColorRGB(*(code / 255 for code in srgb))
        self.canvas.setStrokeGray(0.4)
        self.canvas.setLineWidth(0.3)
        self.canvas.rect(self.canvas.side(x, size[0]), y, *size, stroke=1, fill=1)


def _as_photograph(image: Image.Image) -> ImageReader:
    """A picture as JPEG, all colours at full size: a tenth of the bytes, and no difference that is seen."""
    stream = io.BytesIO()
    image.convert("RGB").save(stream, format="JPEG", quality=_QUALITY, subsampling=0)
    return ImageReader(stream)
