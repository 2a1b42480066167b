"""Pictures of a machine in motion, for a GIF or a video: the figure of the page with its drive and its readings."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from PIL import Image

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.records import record
from ilmek.report import Animation
from ilmek.units import parse_unit
from ilmek.viz.animation import Between, between, first_of_each, middle, moving_at, pen_of, unnamed
from ilmek.viz.canvas import FINER, Canvas
from ilmek.viz.drawing import FOOT, WIDTH, draw_parts, draw_still, names, obstacles, shade_of
from ilmek.viz.font import text_width
from ilmek.viz.labels import LabelRequest, steady
from ilmek.viz.number_format import NARROW_SPACE
from ilmek.viz.sheet import Sheet
from ilmek.viz.strokes import Pen
from ilmek.viz.style import INK, MUTED, PALETTE, STEEL, STRONG, TEXT, YARN, shown_unit, tint

SECONDS = 5.0
"""Duration of a run [s]."""

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


def pictures(animation: Animation) -> Iterator[Image.Image]:
    """The pictures of a run: a turn that closes, or forth and back. Between frames, points move on straight lines."""
    slots, low = _slots(animation)
    pen = pen_of(animation)
    scale, height = PIXELS * FINER / WIDTH, low + pen.sheet.height + _HEAD
    ground = Canvas(WIDTH, height, scale)
    ground.draw(_head_and_readings(animation.title, slots, height))
    moving, labels = _moving(pen, animation, low), _labels(pen, animation)
    still = Canvas(WIDTH, pen.sheet.height, scale)
    still.draw(pen.sheet)
    ground.picture.paste(still.picture, (0, round(_HEAD * scale)))
    for value in _run(animation):
        at = between(animation, value)
        picture = ground.copy()
        picture.draw(moving(at))
        for centres, label, size, shade in labels:
            baseline, bold = complex(at(centres)) + 1j * low - 0.35j * size, size == STRONG
            picture.text(baseline, label, size, shade, anchor="center", bold=bold, edge=1.3)
        for slot in slots:
            beside = slot.at + text_width(slot.label, TEXT) + 5.0
            picture.text(beside, slot.written(float(at(slot.values))), TEXT, INK, bold=True)
        yield picture.reduced()


def _head_and_readings(title: str, slots: list[_Slot], height: float) -> Sheet:
    sheet = Sheet(WIDTH, height)
    sheet.text(complex(_LEFT, height - 16.0), title, fontsize=STRONG + 1, bold=True)
    for slot in slots:
        sheet.text(slot.at, slot.label, fontsize=TEXT, color=MUTED)
    return sheet


def _moving(pen: Pen, animation: Animation, low: float) -> Callable[[Between], Sheet]:
    """What draws the moving strokes and all dots at a frame on a sheet that begins `low` [pt] below that of the pen,
    which gets the rest.
    """
    still = animation.still
    quiet = replace(still, strokes=tuple(map(unnamed, still.strokes)), dots=())
    draw_still(pen, quiet)
    names(pen, quiet, np.concatenate([obstacles(pen, still), *_covered(pen, animation)]))

    def drawn(at: Between) -> Sheet:
        sheet, origin = Sheet(pen.sheet.width, pen.sheet.height + low), pen.origin - 1j * low / pen.scale
        over, moving = replace(pen, sheet=sheet, origin=origin, shown={}), moving_at(animation, at)
        over.shown.update((stroke, over(stroke.points)) for stroke in moving.strokes)
        draw_parts(over, replace(moving, dots=(*still.dots, *moving.dots)))
        return over.sheet

    return drawn


def _covered(pen: Pen, animation: Animation) -> list[ComplexArray]:
    """Points along all moving parts at every frame [pt]."""
    frames = (moving_at(animation, between(animation, frame)) for frame in range(len(animation.at)))
    return [obstacles(replace(pen, shown={}), drawing) for drawing in frames]


def _labels(pen: Pen, animation: Animation) -> list[tuple[ComplexArray, str, float, str]]:
    """The names of dots and lines: middles over the frames [pt], text, size, colour."""
    frames = len(animation.at)
    named = [(np.full(frames, dot.at), dot.label, STRONG, INK) for dot in animation.still.dots]
    named += [(dot.at, dot.label, STRONG, INK) for dot in animation.dots]
    named += [(middle(stroke.points), stroke.label, TEXT, shade_of(stroke)) for stroke in animation.strokes]
    own = [named[number] for number in first_of_each([label for _, label, _, _ in named])]
    requests = [LabelRequest(pen(at), label, size, 6.0) for at, label, size, _ in own]
    corner = complex(pen.sheet.width, pen.sheet.height) - (2 + 2j)
    fixed = obstacles(pen, animation.still)
    met = [np.concatenate([fixed, points]) for points in _covered(pen, animation)]
    centres = steady(requests, met, complex(2, FOOT), corner)
    return [(at, label, size, shade) for (_, label, size, shade), at in zip(own, centres, strict=True)]


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


def decimals(extent: float) -> int:
    """Decimals with which a thousandth of the extent is seen.

    >>> decimals(360.0), decimals(1.2), decimals(25000.0)
    (0, 3, 0)
    """
    return int(np.clip(3 - np.floor(np.log10(extent) + 0.5), 0, 9)) if extent > 0 else 1
