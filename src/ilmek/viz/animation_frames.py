"""Pictures of a machine in motion, for a GIF or a video: the figure of the page with its drive and its readings."""

from collections.abc import Callable, Iterator, Mapping

import numpy as np
from PIL import Image

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.records import record
from ilmek.report import Animation
from ilmek.units import parse_unit
from ilmek.viz.animation import SECONDS, laid_out
from ilmek.viz.canvas import FINER, Canvas
from ilmek.viz.cursor import decimals
from ilmek.viz.drawing import WIDTH
from ilmek.viz.font import text_width
from ilmek.viz.moving_parts import DOT_RADII, MovingBlock, MovingCircle, MovingLine, MovingMarker, MovingPart
from ilmek.viz.number_format import NARROW_SPACE
from ilmek.viz.sheet import Sheet, circle
from ilmek.viz.strokes import BLOCK
from ilmek.viz.style import INK, MUTED, PALETTE, PAPER, STEEL, STRONG, TEXT, YARN, shown_unit, tint

PIXELS = 960
"""Width of the pictures."""

RATE = 25
"""Pictures per second."""

PICTURES = round(SECONDS * RATE)
"""Pictures of a run."""

COLOURS = (*PALETTE, *(tint(shade, 0.45) for shade in PALETTE), INK, MUTED, STEEL, YARN)
"""Colours of lines and bars."""

_HEAD, _ROW, _LEFT, _GAP, _FOOT = 24.0, 15.0, 14.0, 18.0, 8.0
"""Height of the title and of a row of readings, left margin, gap between readings, and lower margin [pt]."""


@record
class _Slot:
    """A reading at its position: its SI values over the frames, shown in a unit with some decimals."""

    at: complex
    label: str
    values: FloatArray
    unit: str
    digits: int

    def written(self, value: float) -> str:
        """The value as it is shown."""
        text = f"{value / parse_unit(self.unit).factor:.{self.digits}f}".replace("-", "−")
        if not text.strip("−0."):
            text = text.removeprefix("−")
        unit = shown_unit(self.unit)
        return text + (NARROW_SPACE if unit not in ("", "°", "%") else "") + unit


def pictures(animation: Animation, looks: Mapping[str, int]) -> Iterator[Image.Image]:
    """The pictures of a run: a turn that closes, or forth and back. Between frames, points move on straight lines."""
    layout = laid_out(animation, looks)
    slots, low = _slots(animation)
    height = low + layout.sheet.height + _HEAD
    scale = PIXELS * FINER / WIDTH
    sheet = Sheet(WIDTH, height)
    sheet.text(complex(_LEFT, height - 16.0), animation.title, fontsize=STRONG + 1, bold=True)
    for slot in slots:
        sheet.text(slot.at, slot.label, fontsize=TEXT, color=MUTED)
    ground = Canvas(WIDTH, height, scale)
    ground.draw(sheet)
    still = Canvas(WIDTH, layout.sheet.height, scale)
    still.draw(layout.sheet)
    top = round(_HEAD * scale)
    ground.picture.paste(still.picture, (0, top))
    for value in _run(animation):
        canvas = ground.copy()
        at = _between(value, len(animation.at))
        for part in layout.parts:
            _draw(canvas, part, at, 1j * low)
        for slot in slots:
            beside = slot.at + text_width(slot.label, TEXT) + 5.0
            canvas.text(beside, slot.written(float(at(slot.values))), TEXT, INK, bold=True)
        yield canvas.reduced()


def _slots(animation: Animation) -> tuple[list[_Slot], float]:
    """Drive and readings in rows below the figure, at fixed positions, and the height of all rows [pt]."""
    drive = animation.drive
    extent = float(np.ptp(animation.at)) / parse_unit(drive.unit).factor
    shown = [(drive.label, animation.at, drive.unit, decimals(extent))]
    for reading in animation.readings:
        digits = decimals(float(np.ptp(reading.values)) / parse_unit(reading.unit).factor)
        shown.append((reading.label, reading.values, reading.unit, digits))
    placed: list[_Slot] = []
    left, row = _LEFT, 0
    for label, values, unit, digits in shown:
        slot = _Slot(0j, label, values, unit, digits)
        longest = max((slot.written(float(value)) for value in values), key=len)
        width = text_width(label, TEXT) + 5.0 + text_width(longest, TEXT, True) + _GAP
        if left > _LEFT and left + width > WIDTH:
            left, row = _LEFT, row + 1
        placed.append(_Slot(complex(left, row), label, values, unit, digits))
        left += width
    height = _FOOT + _ROW * (row + 1)
    return [
        _Slot(complex(one.at.real, height - _ROW * (one.at.imag + 0.7)), one.label, one.values, one.unit, one.digits)
        for one in placed
    ], height


def _run(animation: Animation) -> FloatArray:
    """Frames, with parts of them, at which the pictures are drawn."""
    phase = np.arange(PICTURES) / PICTURES
    frames = len(animation.at)
    if animation.closes:
        return np.asarray((animation.start + phase * frames) % frames)
    return np.asarray((frames - 1) * (1 - np.cos(2 * np.pi * phase)) / 2)


def _between(value: float, frames: int) -> Callable[[ComplexArray], ComplexArray]:
    """Values between a frame and the next."""
    frame = int(value)
    share = value - frame

    def at(values: ComplexArray) -> ComplexArray:
        before, after = values[frame], values[(frame + 1) % frames]
        return np.asarray(before + share * (after - before))

    return at


def _draw(canvas: Canvas, part: MovingPart, at: Callable[[ComplexArray], ComplexArray], shift: complex) -> None:
    """Draw a moving part."""
    if isinstance(part, MovingLine):
        points = at(part.points) + shift
        if part.fill != "none":
            canvas.area(points, part.fill)
        if part.width:
            canvas.line(points, part.stroke, part.width, part.dashes, closed=part.closed)
        return
    middle = complex(at(part.at)) + shift
    if isinstance(part, MovingMarker):
        canvas.area(middle + part.corners, part.fill, PAPER, 0.5)
    elif isinstance(part, MovingCircle):
        radius = DOT_RADII[part.role]
        pin = part.role == "pin"
        canvas.area(circle(middle, radius), PAPER if pin else INK, INK, 1.1 if pin else 0.0)
    elif isinstance(part, MovingBlock):
        along = complex(at(part.along))
        corners = np.array([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j])
        box = (corners.real * BLOCK.real + 1j * corners.imag * BLOCK.imag) * along / (abs(along) or 1.0)
        canvas.area(middle + box, "#e4e8ec", STEEL, 1.2)
    else:
        canvas.text(middle - 0.35j * STRONG, part.text, STRONG, INK, anchor="center", bold=True, edge=1.3)
