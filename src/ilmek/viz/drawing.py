"""Drawings to scale: parts are drawn by their roles (`strokes`), names are placed clear of the lines.

The layout is in points, so that names, hatches and arrows have the same size for every machine. A scale bar shows the
scale.
"""

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.records import JsonObject
from ilmek.report import Drawing, MovingStroke, Stroke
from ilmek.units import parse_unit
from ilmek.viz.labels import LabelRequest, placed
from ilmek.viz.scale import tick_labels
from ilmek.viz.sheet import Sheet
from ilmek.viz.strokes import DOTS, STROKES, Pen
from ilmek.viz.style import INK, MUTED, SMALL, STRONG, TEXT, YARN, colour, letters, shown_unit

WIDTH = 420.0
FOOT = 30.0
"""Height reserved for the scale bar [pt]."""

_MARGIN = 26.0
_LEAST, _MOST = 90.0, 330.0
"""Least and greatest height of the drawn part [pt]."""


def draw_drawing(drawing: Drawing) -> Sheet:
    """The drawing as large as the sheet allows, with equal scales in x and y and a scale bar below."""
    pen = pen_for(extent(drawing), drawing.unit)
    draw_still(pen, drawing)
    names(pen, drawing, obstacles(pen, drawing))
    return pen.sheet


def extent(drawing: Drawing) -> ComplexArray:
    """All points of the drawing."""
    dots = np.array([dot.at for dot in drawing.dots], complex)
    return np.concatenate([*(stroke.points for stroke in drawing.strokes), dots])


def pen_for(points: ComplexArray, unit: str, foot: float = FOOT) -> Pen:
    """A pen on a sheet that contains all points [m], with space below for the scale bar.

    unit  of the scale bar
    foot  height of the space below [pt]
    """
    finite = points[np.isfinite(points)]
    lower, upper = _corners(finite) if len(finite) else (0j, 1 + 1j)
    size = upper - lower
    scale = min((WIDTH - 2 * _MARGIN) / max(size.real, 1e-12), (_MOST - 2 * _MARGIN) / max(size.imag, 1e-12))
    high = max(size.imag * scale + 2 * _MARGIN, _LEAST)
    centre = complex(WIDTH / 2, foot + high / 2)
    return Pen(Sheet(WIDTH, high + foot), scale, (lower + upper) / 2 - centre / scale, unit)


def draw_still(pen: Pen, drawing: Drawing) -> None:
    """Draw strokes, dots and the scale bar, without names."""
    draw_parts(pen, drawing)
    _scale_bar(pen)


def draw_parts(pen: Pen, drawing: Drawing) -> None:
    """Draw strokes and dots."""
    if drawing.strokes:
        pen.thinned(drawing.strokes[0], drawing.strokes)
    for stroke in drawing.strokes:
        STROKES[stroke.role](pen, stroke)
    for dot in drawing.dots:
        DOTS[dot.role](pen, complex(pen(np.array([dot.at]))[0]), dot.along)


def _corners(points: ComplexArray) -> tuple[complex, complex]:
    return (complex(points.real.min(), points.imag.min()), complex(points.real.max(), points.imag.max()))


def _beside(points: ComplexArray, closed: bool) -> ComplexArray:
    """Anchors for the name of a line, its middle first; all around a closed line, from the upper right."""
    if closed:
        points = np.append(points, points[0])
    along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(points)))])
    shares = np.arange(24) / 24 if closed else np.array([0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8])
    anchors = np.interp(shares * along[-1], along, points.real) + 1j * np.interp(shares * along[-1], along, points.imag)
    if not closed:
        return np.asarray(anchors)
    turned = np.angle((anchors - anchors.mean()) * np.exp(-1j * np.pi / 4))
    return np.asarray(anchors[np.argsort(np.abs(turned), kind="stable")])


def names(pen: Pen, drawing: Drawing, covered: ComplexArray, foot: float = FOOT) -> list[tuple[complex, complex]]:
    """Write names of dots in bold and of strokes in their colours, clear of the points `covered` [pt].

    Returns the centre of each name and half its width + i half its height [pt].
    """
    requests: list[LabelRequest] = []
    looks: list[JsonObject] = []
    for dot in drawing.dots:
        if dot.label:
            requests.append(LabelRequest(pen(np.array([dot.at])), dot.label, STRONG, 5.5, pull=3.0))
            looks.append({"color": INK, "bold": True, "fontsize": STRONG})
    seen: set[str] = set()
    for stroke in drawing.strokes:
        if stroke.label and stroke.label not in seen and stroke.role != "dimension" and len(stroke.points) > 1:
            seen.add(stroke.label)
            anchors = _beside(pen.thinned(stroke, drawing.strokes), stroke.closed)
            requests.append(LabelRequest(anchors, stroke.label, TEXT, 7.0 if stroke.role == "link" else 4.5))
            looks.append({"color": shade_of(stroke), "fontsize": TEXT})
    corner = complex(pen.sheet.width, pen.sheet.height)
    centres = placed(requests, covered, complex(2.0, foot), corner - (2 + 2j))
    for one, centre, look in zip(requests, centres, looks, strict=True):
        pen.sheet.text(centre, one.text, ha="center", va="center_baseline", zorder=8, **look)
    return [(centre, one.half) for one, centre in zip(requests, centres, strict=True)]


def shade_of(stroke: Stroke | MovingStroke) -> str:
    """The colour of the letters of a stroke's name, by its look or else its role."""
    if stroke.look >= 0:
        return letters(colour(stroke.look))
    return {"yarn": YARN, "outline": INK}.get(stroke.role, MUTED)


def obstacles(pen: Pen, drawing: Drawing) -> ComplexArray:
    """Points that no name should cover [pt]: every 3 pt along strokes, and rings around dots."""
    parts: list[ComplexArray] = [np.empty(0, complex)]
    for stroke in drawing.strokes:
        points = pen.thinned(stroke, drawing.strokes)
        parts.append(dotted(np.append(points, points[:1]) if stroke.closed else points))
    ring = 4.0 * np.exp(2j * np.pi * np.arange(8) / 8)
    parts += [pen(np.array([dot.at])) + ring for dot in drawing.dots]
    parts += [
        pen(np.array([dot.at])) + np.linspace(-9 - 13j, 9 - 13j, 6) for dot in drawing.dots if dot.role == "pivot"
    ]
    points = np.concatenate(parts)
    return np.asarray(points[np.isfinite(points)])


def dotted(points: ComplexArray) -> ComplexArray:
    """Points every 3 pt along a line [pt]."""
    if len(points) < 2:
        return np.empty(0, complex)
    along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(points)))])
    lengths = np.linspace(0.0, along[-1], max(2, int(along[-1] / 3.0)))
    return np.asarray(np.interp(lengths, along, points.real) + 1j * np.interp(lengths, along, points.imag))


def _scale_bar(pen: Pen) -> None:
    """A bar of a round length, about a fifth of the sheet, at the lower left."""
    factor = parse_unit(pen.unit).factor
    aim = 0.22 * WIDTH / pen.scale / factor
    decade = 10.0 ** np.floor(np.log10(aim))
    length = float(max(step * decade for step in (1, 2, 5) if step * decade <= aim * 1.0001))
    left, low, end = 14.0, 12.0, 14.0 + length * factor * pen.scale
    bar = np.array([left - 2.5j, left + 2.5j, left, end, end - 2.5j, end + 2.5j])
    pen.sheet.line(bar + 1j * low, color=INK, linewidth=0.9)
    text = f"{tick_labels([0.0, length])[1]} {shown_unit(pen.unit)}"
    pen.sheet.text(complex(end + 6.0, low), text, fontsize=SMALL, color=MUTED, va="center_baseline")
