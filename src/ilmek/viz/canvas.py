"""A picture of pixels on which figures are drawn in points, as on a `Sheet`; drawn twice as fine and reduced."""

import itertools
from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from ilmek.arrays import ComplexArray
from ilmek.viz.font import ASCENT, DESCENT, FONTS, text_width
from ilmek.viz.sheet import BASELINES, AreaMark, LineMark, Sheet, TextMark
from ilmek.viz.style import PAPER

FINER = 2
"""Pixels drawn for a pixel of the picture, in each direction."""

_ANCHORS = {"left": "ls", "center": "ms", "right": "rs"}
_PAD = 1.0
"""Margin around a text on a line [pt]."""


class Canvas:
    """A white picture of width x height [pt] with `scale` pixels drawn per point."""

    def __init__(self, width: float, height: float, scale: float, picture: Image.Image | None = None) -> None:
        self.width, self.height, self.scale = width, height, scale
        size = tuple(2 * FINER * -(-round(side * scale) // (2 * FINER)) for side in (width, height))
        self.picture = Image.new("RGB", (size[0], size[1]), PAPER) if picture is None else picture
        self._draw = ImageDraw.Draw(self.picture)

    def copy(self) -> "Canvas":
        """The same canvas on a copy of the picture."""
        return Canvas(self.width, self.height, self.scale, self.picture.copy())

    def reduced(self) -> Image.Image:
        """The picture with smooth edges; both sides are even."""
        return self.picture.reduce(FINER)

    def line(
        self, points: ComplexArray, color: str, width: float, dashes: Sequence[float] = (), *, closed: bool = False
    ) -> None:
        """Draw a line with round ends through points [pt]; NaN makes a gap. dashes: lengths of dash, gap ... [pt]."""
        if closed and len(points):
            points = np.append(points, points[0])
        pieces = [_piece for _piece in _unbroken(points) if len(_piece) > 1]
        if dashes:
            pieces = [dash for piece in pieces for dash in _dashed(piece, dashes)]
        thick = max(1, round(width * self.scale))
        for piece in pieces:
            corners = self._corners(piece)
            self._draw.line(corners, fill=color, width=thick, joint="curve")
            if thick > 2 and not dashes:
                self._disc(corners[:2], thick / 2, color)
                self._disc(corners[-2:], thick / 2, color)

    def area(self, points: ComplexArray, fill: str, edge: str = "", width: float = 0.0) -> None:
        """Draw a filled polygon [pt]; its edge is drawn if it has a colour."""
        points = points[np.isfinite(points)]
        if len(points) > 2:
            self._draw.polygon(self._corners(points), fill=fill)
        if edge and width:
            self.line(points, edge, width, closed=True)

    def text(
        self,
        at: complex,
        words: str,
        size: float,
        color: str,
        *,
        anchor: str = "left",
        bold: bool = False,
        edge: float = 0.0,
    ) -> None:
        """Draw a text with its baseline at y [pt]; anchor: left, center or right; edge: width of a pale edge [pt]."""
        x, y = self._corners(np.array([at]))
        font, border = _font(bold, size * self.scale), round(edge * self.scale)
        self._draw.text(
            (x, y), words, fill=color, font=font, anchor=_ANCHORS[anchor], stroke_width=border, stroke_fill=PAPER
        )

    def turned_text(self, middle: complex, words: str, size: float, color: str, turn: float) -> None:
        """Draw a text turned about its middle [pt], anticlockwise [deg]."""
        font = _font(False, size * self.scale)
        left, top, right, bottom = font.getbbox(words)
        mask = Image.new("L", (int(right - left) + 4, int(bottom - top) + 4))
        ImageDraw.Draw(mask).text((2 - left, 2 - top), words, fill=255, font=font)
        mask = mask.rotate(turn, expand=True, resample=Image.Resampling.BICUBIC)
        x, y = self._corners(np.array([middle]))
        self.picture.paste(color, (round(x - mask.width / 2), round(y - mask.height / 2)), mask)

    def draw(self, sheet: Sheet) -> None:
        """Draw all marks of a sheet; a text that is turned is turned about its middle."""
        for mark in sheet.marks:
            if isinstance(mark, LineMark):
                self.line(mark.points, mark.color, mark.linewidth, [mark.linewidth * length for length in mark.dashes])
            elif isinstance(mark, AreaMark):
                self.area(mark.points, mark.facecolor, mark.edgecolor, mark.linewidth)
            else:
                self._mark_text(mark)

    def _mark_text(self, mark: TextMark) -> None:
        at, words, size = mark.at, mark.words, mark.fontsize
        if mark.clear:
            self.area(_box(words, size, mark.bold) * np.exp(1j * np.radians(mark.rotation)) + at, PAPER)
        if abs(mark.rotation) > 1e-6:
            self.turned_text(at, words, size, mark.color, mark.rotation)
        else:
            self.text(at - 1j * BASELINES[mark.va] * size, words, size, mark.color, anchor=mark.ha, bold=mark.bold)

    def _corners(self, points: ComplexArray) -> list[float]:
        pixels = np.column_stack((points.real, self.height - points.imag)) * self.scale
        return [float(number) for number in np.clip(pixels, -1e5, 1e5).ravel()]

    def _disc(self, at: list[float], radius: float, color: str) -> None:
        x, y = at
        self._draw.ellipse((x - radius, y - radius, x + radius - 1, y + radius - 1), fill=color)


def _box(words: str, size: float, bold: bool) -> ComplexArray:
    """Corners of the box of a text about its middle [pt]."""
    wide, high = text_width(words, size, bold) / 2 + _PAD, (ASCENT + DESCENT) * size / 2 + _PAD
    return wide * np.array([-1, 1, 1, -1]) + 1j * high * np.array([-1, -1, 1, 1])


def _unbroken(points: ComplexArray) -> list[ComplexArray]:
    """The pieces between gaps."""
    whole = np.isfinite(points)
    pieces = np.split(points, np.flatnonzero(np.diff(whole)) + 1)
    return [piece for piece in pieces if len(piece) and np.isfinite(piece[0])]


def _dashed(points: ComplexArray, dashes: Sequence[float]) -> list[ComplexArray]:
    """The dashes of a line."""
    along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(points)))])
    if along[-1] == 0 or sum(dashes) <= 0:
        return []
    ends = np.cumsum(np.tile(dashes, int(along[-1] / sum(dashes)) + 1))
    starts = np.concatenate([[0.0], ends[:-1]])
    found = []
    for start, end in itertools.islice(zip(starts, np.minimum(ends, along[-1]), strict=True), 0, None, 2):
        inside = along[(along > start) & (along < end)]
        where = np.concatenate([[start], inside, [end]])
        found.append(np.interp(where, along, points.real) + 1j * np.interp(where, along, points.imag))
    return [dash for dash in found if abs(dash[-1] - dash[0]) > 0]


@lru_cache(maxsize=32)
def _font(bold: bool, size: float) -> ImageFont.FreeTypeFont:
    """A font of the package; size in pixels."""
    file = FONTS / ("DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf")
    return ImageFont.truetype(file, size, layout_engine=ImageFont.Layout.BASIC)
