"""A sheet on which figures are drawn, in points, and its SVG text.

The y axis of a sheet points up, that of SVG down. Lengths are rounded to a hundredth of a point. Marks are drawn in the
order of their levels, those of one level in the order of their creation.
"""

import re
from collections.abc import Iterator, Sequence
from typing import Any, TypeAlias
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.records import record
from ilmek.viz.font import ASCENT, DESCENT, text_width
from ilmek.viz.style import INK, PAPER, TEXT

_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]")  # not allowed in XML
_ANCHORS = {"left": "", "center": ' text-anchor="middle"', "right": ' text-anchor="end"'}
BASELINES = {"baseline": 0.0, "center_baseline": ASCENT / 2, "top": ASCENT, "bottom": -DESCENT}
"""Distance of the baseline below the anchor of a text, as a share of its size."""
_PAD = 1.0
"""Margin around a text on a line [pt]."""


@record
class LineMark:
    """A line through points [pt]; NaN makes a gap.

    dashes  lengths of dash, gap, dash ... in line widths; default: a full line
    """

    points: ComplexArray
    color: str = INK
    linewidth: float = 1.0
    dashes: Sequence[float] = ()


@record
class AreaMark:
    """A filled polygon [pt]; its edge is drawn if it has a colour."""

    points: ComplexArray
    facecolor: str
    edgecolor: str = ""
    linewidth: float = 0.0


@record
class TextMark:
    """A text.

    at        position of the anchor [pt]
    ha, va    anchor of the text: left, center, right; top, center_baseline, baseline, bottom
    rotation  about the anchor, anticlockwise [deg]
    clear     hide the lines under a centred text
    """

    at: complex
    words: str
    fontsize: float = TEXT
    color: str = INK
    ha: str = "left"
    va: str = "baseline"
    bold: bool = False
    rotation: float = 0.0
    clear: bool = False


Mark: TypeAlias = LineMark | AreaMark | TextMark


class Sheet:
    """A sheet of width x height [pt]; positions are complex, from its lower left corner [pt]."""

    def __init__(self, width: float, height: float) -> None:
        self.width, self.height = float(width), float(height)
        self._marks: list[tuple[float, Mark]] = []

    @property
    def marks(self) -> list[Mark]:
        """All marks, the lowest level first."""
        return [mark for _, mark in sorted(self._marks, key=lambda one: one[0])]

    def line(self, points: ComplexArray, *, zorder: float = 2.0, **look: Any) -> None:
        """Draw a line, at a level; look: as of a `LineMark`."""
        self._marks.append((zorder, LineMark(points, **look)))

    def lines(self, starts: ComplexArray, ends: ComplexArray, *, color: str, linewidth: float, zorder: float) -> None:
        """Draw straight lines from each start to its end [pt] as one mark."""
        gaps = np.full(len(starts), complex(np.nan, np.nan))
        points = np.column_stack((starts, ends, gaps)).ravel()
        self.line(points, color=color, linewidth=linewidth, zorder=zorder)

    def area(self, points: ComplexArray, *, zorder: float = 1.0, **look: Any) -> None:
        """Draw a filled polygon, at a level; look: as of an `AreaMark`."""
        self._marks.append((zorder, AreaMark(points, **look)))

    def text(self, at: complex, words: str, *, zorder: float = 3.0, **look: Any) -> None:
        """Draw a text, at a level; look: as of a `TextMark`."""
        self._marks.append((zorder, TextMark(at, words, **look)))

    def svg(self, title: str, fonts: str) -> str:
        """The sheet as an `<svg>` element with a title and no fixed size: its view box keeps the proportions.

        >>> text = Sheet(72, 36).svg("a < b", "sans-serif")
        >>> text.startswith("<svg") and "a &lt; b" in text
        True
        """
        marks = "\n".join(element for mark in self.marks for element in self._elements(mark))
        text = (
            f'<svg xmlns="http://www.w3.org/2000/svg" role="img" viewBox="0 0 {self.width:.6g} {self.height:.6g}" '
            f'style="stroke-linejoin:round;font-family:{fonts}" aria-label={quoteattr(title)}>\n'
            f'<title>{escape(title)}</title>\n<g fill="none" stroke-linecap="round">\n{marks}\n</g>\n</svg>'
        )
        return _CONTROL.sub("", text)

    def _elements(self, mark: Mark) -> Iterator[str]:
        """The SVG elements of a mark; none of a line or area without points."""
        if isinstance(mark, TextMark):
            yield from self._text(mark)
        elif not (through := self._through(mark.points)):
            return
        elif isinstance(mark, AreaMark):
            edge = f' stroke="{mark.edgecolor}" stroke-width="{mark.linewidth:g}"' if mark.edgecolor else ""
            yield f'<path d="{through}Z" fill="{mark.facecolor}"{edge}/>'
        else:
            lengths = " ".join(f"{mark.linewidth * length:.4g}" for length in mark.dashes)
            broken = f' stroke-dasharray="{lengths}" stroke-linecap="butt"' if lengths else ""
            yield f'<path d="{through}" stroke="{mark.color}" stroke-width="{mark.linewidth:g}"{broken}/>'

    def _text(self, mark: TextMark) -> Iterator[str]:
        x, y, size = mark.at.real, self.height - mark.at.imag, mark.fontsize
        turn = f' transform="rotate({-mark.rotation:.4g} {x:.6g} {y:.6g})"' if abs(mark.rotation) > 1e-6 else ""
        base = y + BASELINES[mark.va] * size
        if mark.clear:
            width, top = text_width(mark.words, size, mark.bold) + 2 * _PAD, base - ASCENT * size - _PAD
            box = f'width="{width:.4g}" height="{(ASCENT + DESCENT) * size + 2 * _PAD:.4g}"'
            yield f'<rect x="{x - width / 2:.6g}" y="{top:.6g}" {box} fill="{PAPER}"{turn}/>'
        weight = ' font-weight="bold"' if mark.bold else ""
        look = f'font-size="{size:g}" fill="{mark.color}"{weight}{_ANCHORS[mark.ha]}{turn}'
        yield f'<text x="{_short(x)}" y="{_short(base)}" {look}>{escape(mark.words)}</text>'

    def _through(self, points: ComplexArray) -> str:
        """The SVG path through points, divided at gaps; a piece of one point is left out."""
        coordinates = np.round(np.column_stack((points.real, self.height - points.imag)), 2)
        whole = np.isfinite(coordinates).all(axis=1)
        pieces = np.split(coordinates, np.flatnonzero(np.diff(whole)) + 1)
        return "".join(
            "M" + "L".join(f"{x:g} {y:g}" for x, y in piece.tolist())
            for piece in pieces
            if len(piece) > 1 and np.isfinite(piece[0]).all()
        )


def _short(value: float) -> str:
    return f"{round(value, 2):g}"


def circle(centre: complex, radius: float) -> ComplexArray:
    """A circle as a polygon of 24 corners [pt]."""
    return np.asarray(centre + radius * np.exp(2j * np.pi * np.arange(24) / 24))


def axis_points(values: Sequence[float]) -> ComplexArray:
    """Coordinates along an axis [pt] as complex numbers on the real line."""
    return np.array(values, dtype=complex)
