"""Drawings to scale: bars, pivots, paths, dimensions.

Each role of `report.Stroke` and `report.Dot` has one way of being drawn. The drawing is laid out in points, so that
names, hatches and arrows keep their size whatever the machine's size; a scale bar tells the size.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Polygon

from ilmek.arrays import ComplexArray
from ilmek.report import Drawing, Stroke
from ilmek.units import parse_unit
from ilmek.viz.ink import axes_in_points, sheet
from ilmek.viz.labels import Wanted, placed
from ilmek.viz.scale import tick_labels
from ilmek.viz.style import INK, MUTED, PAPER, SMALL, STEEL, STRONG, TEXT, YARN, colour, shown_unit, text_width, tint
from ilmek.viz.thinning import thinned_line

WIDTH = 420.0
_MARGIN, _FOOT = 26.0, 30.0
_LEAST, _MOST = 90.0, 330.0
"""Height of the drawn part [pt], at least and at most."""


@dataclass(frozen=True, slots=True)
class _Pen:
    """Where to draw, how a place [m] becomes a place on the sheet [pt], and the next colour's number."""

    axes: Axes
    scale: float
    origin: complex
    numbers: Mapping[int, int]
    unit: str

    def __call__(self, points: ComplexArray) -> ComplexArray:
        return (points - self.origin) * self.scale


def draw_drawing(drawing: Drawing) -> Figure:
    """The drawing as large as the sheet allows, equal in both directions, with a scale bar below."""
    everything = np.concatenate(
        [np.empty(0, complex), *(s.points for s in drawing.strokes), np.array([d.at for d in drawing.dots], complex)]
    )
    finite = everything[np.isfinite(everything)]
    lower, upper = _corners(finite) if len(finite) else (0j, 1 + 1j)
    size = upper - lower
    scale = min((WIDTH - 2 * _MARGIN) / max(size.real, 1e-12), (_MOST - 2 * _MARGIN) / max(size.imag, 1e-12))
    high = max(size.imag * scale + 2 * _MARGIN, _LEAST)
    figure = sheet(WIDTH, high + _FOOT)
    axes = axes_in_points(figure, 0.0, 0.0, WIDTH, high + _FOOT)
    axes.set_xlim(0.0, WIDTH)
    axes.set_ylim(0.0, high + _FOOT)
    axes.set_axis_off()
    centre = complex(WIDTH / 2, _FOOT + high / 2)
    pen = _Pen(axes, scale, (lower + upper) / 2 - centre / scale, _colours(drawing.strokes), drawing.unit)
    for number, stroke in enumerate(drawing.strokes):
        _STROKES[stroke.role](pen, stroke, number)
    for dot in drawing.dots:
        _DOTS[dot.role](pen, complex(pen(np.array([dot.at]))[0]))
    _names(pen, drawing, complex(WIDTH, high + _FOOT))
    _scale_bar(pen)
    return figure


def _corners(points: ComplexArray) -> tuple[complex, complex]:
    return (
        complex(points.real.min(), points.imag.min()),
        complex(points.real.max(), points.imag.max()),
    )


def _colours(strokes: tuple[Stroke, ...]) -> dict[int, int]:
    """A colour number for each coloured stroke, by place: links first, then paths; paths of a link's name share it."""
    numbers: dict[int, int] = {}
    names: dict[str, int] = {}
    for role in ("link", "path"):
        for place, stroke in enumerate(strokes):
            if stroke.role == role:
                fresh = len(set(numbers.values()))
                numbers[place] = names.setdefault(stroke.label, fresh) if stroke.label else fresh
    return numbers


def _line(pen: _Pen, stroke: Stroke, **look: Any) -> ComplexArray:
    """The stroke as a line; returns its points on the sheet."""
    points = thinned_line(pen(stroke.points))
    if stroke.closed and len(points):
        points = np.append(points, points[0])
    pen.axes.add_line(Line2D(points.real, points.imag, **look))
    return points


def _fill(pen: _Pen, stroke: Stroke, shade: str, order: float) -> None:
    points = thinned_line(pen(stroke.points))
    pen.axes.add_patch(
        Polygon(np.column_stack((points.real, points.imag)), closed=True, facecolor=shade, linewidth=0, zorder=order)
    )


def _outline(pen: _Pen, stroke: Stroke, _: int) -> None:
    if stroke.filled:
        _fill(pen, stroke, "#eef1f4", 1.8)
    _line(pen, stroke, color=INK, linewidth=1.4, zorder=3)


def _link(pen: _Pen, stroke: Stroke, number: int) -> None:
    """A bar: a wide line in a pale shade inside a slightly wider one in the full colour."""
    shade = colour(pen.numbers[number])
    if stroke.filled:
        _fill(pen, stroke, tint(shade, 0.3), 3.8)
    round_ends = {"solid_capstyle": "round", "solid_joinstyle": "round"}
    _line(pen, stroke, color=shade, linewidth=7.0, zorder=4, **round_ends)
    _line(pen, stroke, color=tint(shade, 0.45), linewidth=4.8, zorder=4.1, **round_ends)


def _ground(pen: _Pen, stroke: Stroke, _: int) -> None:
    """A grey line with hatches on the right hand of its direction."""
    points = _line(pen, stroke, color=STEEL, linewidth=1.4, zorder=2.5)
    if stroke.filled:
        _fill(pen, stroke, "#e4e8ec", 1.7)
    _hatch(pen.axes, points, 5.5)


def _hatch(axes: Axes, points: ComplexArray, length: float) -> None:
    steps = np.diff(points)
    along = np.concatenate([[0.0], np.cumsum(np.abs(steps))])
    if len(points) < 2 or along[-1] == 0:
        return
    places = np.arange(2.0, along[-1], 5.0)
    where = np.clip(np.searchsorted(along, places, side="right") - 1, 0, len(steps) - 1)
    ways = steps[where] / np.abs(steps[where])
    starts = points[where] + ways * (places - along[where])
    ends = starts + ways * length * np.exp(-1j * np.radians(135))
    gap = np.full_like(starts, complex(np.nan, np.nan))
    lines = np.column_stack((starts, ends, gap)).ravel()
    axes.add_line(Line2D(lines.real, lines.imag, color=STEEL, linewidth=0.7, zorder=2.4))


def _path(pen: _Pen, stroke: Stroke, number: int) -> None:
    _line(pen, stroke, color=colour(pen.numbers[number]), linewidth=1.1, zorder=3.2)


def _construction(pen: _Pen, stroke: Stroke, _: int) -> None:
    _line(pen, stroke, color=STEEL, linewidth=0.7, linestyle=(0, (4, 2.5)), zorder=2)


def _yarn(pen: _Pen, stroke: Stroke, _: int) -> None:
    if stroke.filled:
        _fill(pen, stroke, tint(YARN, 0.25), 2.0)
    _line(pen, stroke, color=YARN, linewidth=2.0, zorder=3.5)


def _dimension(pen: _Pen, stroke: Stroke, _: int) -> None:
    """A thin line with an arrow at both ends and its text on the line."""
    points = _line(pen, stroke, color=MUTED, linewidth=0.7, zorder=5)
    if len(points) < 2:
        return
    for tip, inner in ((points[0], points[1]), (points[-1], points[-2])):
        way = (inner - tip) / (abs(inner - tip) or 1.0)
        corners = tip + way * np.array([0, 6 + 1.6j, 6 - 1.6j])
        pen.axes.add_patch(Polygon(np.column_stack((corners.real, corners.imag)), color=MUTED, linewidth=0, zorder=5))
    if not stroke.label:
        return
    middle, way = _middle(points)
    if text_width(stroke.label, SMALL) + 18.0 > float(np.abs(np.diff(points)).sum()):
        middle += 7.0 * _upright(way) * 1j
    pen.axes.text(
        middle.real,
        middle.imag,
        stroke.label,
        fontsize=SMALL,
        color=INK,
        ha="center",
        va="center",
        rotation=float(np.degrees(np.angle(_upright(way)))),
        rotation_mode="anchor",
        bbox={"facecolor": PAPER, "linewidth": 0, "pad": 1.0},
        zorder=6,
    )


def _upright(way: complex) -> complex:
    """The direction or its opposite, whichever lets a text be read from below or from the right."""
    return -way if way.real < -1e-9 or (abs(way.real) <= 1e-9 and way.imag < 0) else way


def _beside(points: ComplexArray, closed: bool) -> ComplexArray:
    """Points of a line its name may stand beside: its middle first; all round a closed one, from the upper right."""
    if closed:
        points = np.append(points, points[0])
    along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(points)))])
    shares = np.arange(24) / 24 if closed else np.array([0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8])
    places = np.interp(shares * along[-1], along, points.real) + 1j * np.interp(shares * along[-1], along, points.imag)
    if not closed:
        return np.asarray(places)
    turned = np.angle((places - places.mean()) * np.exp(-1j * np.pi / 4))
    return np.asarray(places[np.argsort(np.abs(turned), kind="stable")])


def _middle(points: ComplexArray) -> tuple[complex, complex]:
    """The middle of a polyline by its length, and the unit direction there."""
    steps = np.diff(points)
    along = np.concatenate([[0.0], np.cumsum(np.abs(steps))])
    place = int(np.clip(np.searchsorted(along, along[-1] / 2) - 1, 0, len(steps) - 1))
    length = abs(steps[place]) or 1.0
    return complex(points[place] + steps[place] * (along[-1] / 2 - along[place]) / length), complex(
        steps[place] / length
    )


def _pin(pen: _Pen, at: complex) -> None:
    pen.axes.add_patch(Circle((at.real, at.imag), 3.4, facecolor=PAPER, edgecolor=INK, linewidth=1.1, zorder=7))


def _pivot(pen: _Pen, at: complex) -> None:
    """A triangle on hatched ground with the pin at its tip."""
    corners = at + np.array([0, -7.5 - 12j, 7.5 - 12j])
    pen.axes.add_patch(
        Polygon(
            np.column_stack((corners.real, corners.imag)), facecolor="#e4e8ec", edgecolor=INK, linewidth=1.0, zorder=3.6
        )
    )
    base = at + np.array([-10.5 - 12j, 10.5 - 12j])
    pen.axes.add_line(Line2D(base.real, base.imag, color=INK, linewidth=1.0, zorder=3.6))
    _hatch(pen.axes, base, 5.0)
    _pin(pen, at)


def _point(pen: _Pen, at: complex) -> None:
    pen.axes.add_patch(Circle((at.real, at.imag), 1.9, facecolor=INK, linewidth=0, zorder=7))


_STROKES: Mapping[str, Callable[[_Pen, Stroke, int], None]] = {
    "outline": _outline,
    "link": _link,
    "ground": _ground,
    "path": _path,
    "construction": _construction,
    "dimension": _dimension,
    "yarn": _yarn,
}
_DOTS: Mapping[str, Callable[[_Pen, complex], None]] = {"pin": _pin, "pivot": _pivot, "point": _point}


def _names(pen: _Pen, drawing: Drawing, corner: complex) -> None:
    """Names of dots in bold, names of strokes in the stroke's colour, all clear of the lines."""
    wanted: list[Wanted] = []
    looks: list[dict[str, Any]] = []
    for dot in drawing.dots:
        if dot.label:
            wanted.append(Wanted(pen(np.array([dot.at])), dot.label, STRONG, 5.5, pull=3.0))
            looks.append({"color": INK, "weight": "bold", "fontsize": STRONG})
    seen: set[str] = set()
    for number, stroke in enumerate(drawing.strokes):
        if stroke.label and stroke.label not in seen and stroke.role != "dimension" and len(stroke.points) > 1:
            seen.add(stroke.label)
            places = _beside(thinned_line(pen(stroke.points)), stroke.closed)
            wanted.append(Wanted(places, stroke.label, TEXT, 7.0 if stroke.role == "link" else 4.5))
            looks.append({"color": _shade(pen, stroke, number), "fontsize": TEXT})
    centres = placed(wanted, _obstacles(pen, drawing), complex(2.0, _FOOT), corner - (2 + 2j))
    for one, centre, look in zip(wanted, centres, looks, strict=True):
        pen.axes.text(centre.real, centre.imag, one.text, ha="center", va="center", zorder=8, **look)


def _shade(pen: _Pen, stroke: Stroke, number: int) -> str:
    if number in pen.numbers:
        return colour(pen.numbers[number])
    return {"yarn": YARN, "outline": INK}.get(stroke.role, MUTED)


def _obstacles(pen: _Pen, drawing: Drawing) -> ComplexArray:
    """Points each 3 pt along every stroke, and rings around the dots, which no name should cover."""
    parts: list[ComplexArray] = [np.empty(0, complex)]
    for stroke in drawing.strokes:
        points = thinned_line(pen(stroke.points))
        if stroke.closed and len(points):
            points = np.append(points, points[0])
        if len(points) > 1:
            along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(points)))])
            places = np.linspace(0.0, along[-1], max(2, int(along[-1] / 3.0)))
            parts.append(np.interp(places, along, points.real) + 1j * np.interp(places, along, points.imag))
    ring = 4.0 * np.exp(2j * np.pi * np.arange(8) / 8)
    parts += [pen(np.array([dot.at])) + ring for dot in drawing.dots]
    parts += [
        pen(np.array([dot.at])) + np.linspace(-9 - 13j, 9 - 13j, 6) for dot in drawing.dots if dot.role == "pivot"
    ]
    points = np.concatenate(parts)
    return np.asarray(points[np.isfinite(points)])


def _scale_bar(pen: _Pen) -> None:
    """A bar of a round length, about a fifth of the sheet, at the lower left."""
    factor = parse_unit(pen.unit).factor
    aim = 0.22 * WIDTH / pen.scale / factor
    decade = 10.0 ** np.floor(np.log10(aim))
    length = float(max(step * decade for step in (1, 2, 5) if step * decade <= aim * 1.0001))
    left, low, end = 14.0, 12.0, 14.0 + length * factor * pen.scale
    pen.axes.add_line(
        Line2D(
            [left, left, left, end, end, end],
            [low - 2.5, low + 2.5, low, low, low - 2.5, low + 2.5],
            color=INK,
            linewidth=0.9,
        )
    )
    text = f"{tick_labels([0.0, length])[1]} {shown_unit(pen.unit)}"
    pen.axes.text(end + 6.0, low, text, fontsize=SMALL, color=MUTED, va="center")
