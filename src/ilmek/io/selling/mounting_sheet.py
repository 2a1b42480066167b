"""Mounting sheet of a carpet as PDF: its warps between the beams, the selvedges, marks of the middle and of each tenth.

The drawing has the proportions of the carpet on the loom; the warps beyond the pile are drawn shorter.
"""

from pathlib import Path

import numpy as np
from PIL import Image
from reportlab.lib.utils import ImageReader

from ilmek.carpet.chart import Chart
from ilmek.carpet.mounting import TENS, Mounting
from ilmek.io.chart.legend import mounting_lines
from ilmek.io.chart.printing import printed_file, quality_of, size_of
from ilmek.io.selling.page import LEFT, ROOM, OrderPage
from ilmek.sentences import Sentence, noun
from ilmek.units import cm, format_number

_HIGH, _WIDE = 400.0, 330.0
"""Largest size of the drawn pile [pt]."""

_BEAM, _ENDS, _SELVEDGE = 16.0, 26.0, 6.0
_PIXELS, _PALE = 400, 0.8
"""Pixels of the pale chart along its longer side, and the share of white in it."""

_APART = 24.0
"""Least distance of two numbers at the marks [pt]."""


def write_mounting(path: Path, name: str, chart: Chart, made: Mounting) -> None:
    """Write the mounting sheet in the language that is spoken. Raises OSError."""
    title = Sentence("order.mounting")
    with printed_file(path, title) as canvas:
        page = OrderPage(canvas, title, name)
        page.heading(name, 15.0)
        page.facts(
            [
                (Sentence("order.size"), size_of(chart.size)),
                (Sentence("order.quality"), quality_of(chart.quality)),
                (Sentence("order.knot"), noun(chart.knot)),
            ]
        )
        _draw(page, chart, made)
        page.heading(Sentence("mounting.title"))
        page.facts(mounting_lines(chart, made))
        page.end()


def _draw(page: OrderPage, chart: Chart, made: Mounting) -> None:
    canvas = page.canvas
    length, width = made.row_mark * chart.rows / TENS, made.knot_mark * chart.columns / TENS
    scale = min((_HIGH - 2 * (_BEAM + _ENDS)) / length, _WIDE / width)
    long, wide = scale * length, scale * width
    left = LEFT + (ROOM - wide) / 2
    low = page.y - 24.0 - _BEAM - _ENDS - long
    top = low + long
    canvas.setLineWidth(0.3)
    canvas.setStrokeGray(0.6)
    warps = min(60, made.warps)
    for warp in range(warps + 1):
        x = left - _SELVEDGE + (wide + 2 * _SELVEDGE) * warp / warps
        canvas.line(x, low - _ENDS, x, top + _ENDS)
    for y, key in ((top + _ENDS, "order.warp-beam"), (low - _ENDS - _BEAM, "order.cloth-beam")):
        canvas.setFillGray(0.85)
        canvas.setStrokeGray(0.3)
        canvas.setLineWidth(0.8)
        canvas.roundRect(left - 40.0, y, wide + 80.0, _BEAM, 5.0, stroke=1, fill=1)
        _centred(page, left + wide / 2, y + 4.5, Sentence(key))
    canvas.drawImage(ImageReader(_pale(chart)), left, low, wide, long)
    canvas.setLineWidth(1.0)
    canvas.rect(left, low, wide, long, stroke=1, fill=0)
    canvas.setFillGray(0.72)
    for x in (left - _SELVEDGE, left + wide):
        canvas.rect(x, low, _SELVEDGE, long, stroke=1, fill=1)
    _marks(page, chart, made, (left, low, wide, long))
    _centred(page, left + wide / 2, low + 8.0, Sentence("order.begin-row"))
    page.y = low - _ENDS - _BEAM - 8.0


def _pale(chart: Chart) -> Image.Image:
    """The chart, small and pale, to lie below marks and words."""
    picture = Image.fromarray(np.array([yarn.srgb for yarn in chart.shades], dtype=np.uint8)[chart.shaded])
    small = picture.reduce(max(1, max(picture.size) // _PIXELS))
    return Image.blend(small, Image.new("RGB", small.size, (255, 255, 255)), _PALE)


def _centred(page: OrderPage, x: float, y: float, text: str, size: float = 8.0) -> None:
    page.canvas.setFont("ilmek-text", size)
    page.canvas.setFillGray(0.1)
    page.canvas.drawCentredString(x, y, text)


def _marks(page: OrderPage, chart: Chart, made: Mounting, box: tuple[float, float, float, float]) -> None:
    """The marks of each tenth row at both sides and of each tenth knot below and above, and the lines of the middle."""
    canvas, (left, low, wide, long) = page.canvas, box
    canvas.setStrokeGray(0.1)
    canvas.setLineWidth(0.5)
    numbered = _numbered(long / chart.rows)
    for row in range(TENS, chart.rows + 1, TENS):
        y = low + long * row / chart.rows
        for side in (left - _SELVEDGE, left + wide + _SELVEDGE + 6.0):
            canvas.line(side - 6.0, y, side, y)
        if row % numbered == 0:
            metres = Sentence("order.cm", length=format_number(round(made.row_mark * row / TENS / cm, 1)))
            canvas.setFont("ilmek-text", 7)
            canvas.setFillGray(0.1)
            canvas.drawRightString(left - _SELVEDGE - 9.0, y - 2.5, str(row))
            canvas.drawString(left + wide + _SELVEDGE + 9.0, y - 2.5, metres)
    numbered = _numbered(wide / chart.columns)
    for knot in range(TENS, chart.columns + 1, TENS):
        x = left + wide * knot / chart.columns
        canvas.line(x, top := low + long, x, top + 5.0)
        if knot % numbered == 0:
            _centred(page, x, top + 8.0, str(knot), 7.0)
    canvas.setDash(4, 3)
    canvas.setStrokeColorRGB(0.7, 0.1, 0.1)
    middle = left + wide * made.middle_knot / chart.columns, low + long * made.middle_row / chart.rows
    canvas.line(middle[0], low, middle[0], low + long)
    canvas.line(left, middle[1], left + wide, middle[1])
    canvas.setDash()


def _numbered(step: float) -> int:
    """Rows or knots from number to number, of which each takes a step [pt]."""
    return next(number for number in (10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10**9) if number * step >= _APART)
