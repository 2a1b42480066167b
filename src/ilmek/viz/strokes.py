"""Drawing of each role of `report.Stroke` and `report.Dot`: bars, hatched ground, pivots, dimensions."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import field
from typing import Any

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.records import record
from ilmek.report import Stroke
from ilmek.viz.font import text_width
from ilmek.viz.sheet import Sheet, circle
from ilmek.viz.style import GRID, INK, MUTED, PAPER, SMALL, STEEL, YARN, colour, tint
from ilmek.viz.thinning import thinned_line, thinned_lines

BLOCK = 10 + 6.5j
"""Half the length + i half the height of a slider's block [pt]."""

PITCH = (6.0, 1.7, 1.3, 1.7)
"""Dashes of a pitch circle [line widths]."""


@record
class Pen:
    """A sheet and the map from points of the machine [m] to the sheet [pt]."""

    sheet: Sheet
    scale: float
    origin: complex
    unit: str
    shown: dict[Stroke, ComplexArray] = field(default_factory=dict)

    def thinned(self, stroke: Stroke, others: Sequence[Stroke] = ()) -> ComplexArray:
        """The points of a stroke that show on the sheet [pt]: its line, its area and its name need them.

        others  that will be asked for next: all together take less time
        """
        if stroke not in self.shown:
            new = (stroke, *(own for own in others if own is not stroke and own not in self.shown))
            self.shown.update(zip(new, thinned_lines([self(own.points) for own in new]), strict=True))
        return self.shown[stroke]

    def __call__(self, points: ComplexArray) -> ComplexArray:
        """Positions of points [m] on the sheet [pt]."""
        return (points - self.origin) * self.scale


def _line(pen: Pen, stroke: Stroke, **look: Any) -> ComplexArray:
    """The stroke as a line; returns its points on the sheet."""
    points = pen.thinned(stroke)
    if stroke.closed and len(points):
        points = np.append(points, points[0])
    pen.sheet.line(points, **look)
    return points


def _fill(pen: Pen, stroke: Stroke, shade: str, order: float) -> None:
    points = pen(stroke.points)
    whole = np.isfinite(points)
    area = pen.thinned(stroke) if whole.all() else thinned_line(points[whole])
    pen.sheet.area(area, facecolor=shade, linewidth=0, zorder=order)


def _outline(pen: Pen, stroke: Stroke) -> None:
    if stroke.filled:
        _fill(pen, stroke, "#eef1f4", 1.8)
    _line(pen, stroke, color=INK, linewidth=1.4, zorder=3)


def _link(pen: Pen, stroke: Stroke) -> None:
    """A bar: a wide pale line with edges in the full colour."""
    shade = colour(stroke.look)
    if stroke.filled:
        _fill(pen, stroke, tint(shade, 0.3), 3.8)
    _line(pen, stroke, color=shade, linewidth=7.0, zorder=4)
    _line(pen, stroke, color=tint(shade, 0.45), linewidth=4.8, zorder=4.1)


def _ground(pen: Pen, stroke: Stroke) -> None:
    """A grey line with hatches on the right of its direction."""
    points = _line(pen, stroke, color=STEEL, linewidth=1.4, zorder=2.5)
    if stroke.filled:
        _fill(pen, stroke, "#e4e8ec", 1.7)
    _hatch(pen.sheet, points, 5.5)


def _guide(pen: Pen, stroke: Stroke) -> None:
    """The hatched guide of a slider, on the right of its direction and clear of the block."""
    points = pen(stroke.points)
    direction = (points[-1] - points[0]) / (abs(points[-1] - points[0]) or 1.0)
    wall = points + direction * (BLOCK.real * np.linspace(-1, 1, len(points)) - 1j * (BLOCK.imag + 0.8))
    pen.sheet.line(wall, color=STEEL, linewidth=1.4, zorder=2.5)
    _hatch(pen.sheet, wall, 5.5)


def _hatch(sheet: Sheet, points: ComplexArray, length: float) -> None:
    steps = np.diff(points)
    along = np.concatenate([[0.0], np.cumsum(np.abs(steps))])
    if len(points) < 2 or along[-1] == 0:
        return
    lengths = np.arange(2.0, along[-1], 5.0)
    where = np.clip(np.searchsorted(along, lengths, side="right") - 1, 0, len(steps) - 1)
    directions = steps[where] / np.abs(steps[where])
    starts = points[where] + directions * (lengths - along[where])
    ends = starts + directions * length * np.exp(-1j * np.radians(135))
    sheet.lines(starts, ends, color=STEEL, linewidth=0.7, zorder=2.4)


def _path(pen: Pen, stroke: Stroke) -> None:
    _line(pen, stroke, color=colour(stroke.look), linewidth=1.1, zorder=3.2)


def _construction(pen: Pen, stroke: Stroke) -> None:
    _line(pen, stroke, color=STEEL, linewidth=0.7, dashes=(4, 2.5), zorder=2)


def _yarn(pen: Pen, stroke: Stroke) -> None:
    if stroke.filled:
        _fill(pen, stroke, tint(YARN, 0.25), 2.0)
    _line(pen, stroke, color=YARN, linewidth=2.0, zorder=3.5)


def _dimension(pen: Pen, stroke: Stroke) -> None:
    """A thin line with an arrow at both ends and its text on the line."""
    points = _line(pen, stroke, color=MUTED, linewidth=0.7, zorder=5)
    if len(points) < 2:
        return
    for tip, inner in ((points[0], points[1]), (points[-1], points[-2])):
        direction = (inner - tip) / (abs(inner - tip) or 1.0)
        corners = tip + direction * np.array([0, 6 + 1.6j, 6 - 1.6j])
        pen.sheet.area(corners, facecolor=MUTED, linewidth=0, zorder=5)
    if not stroke.label:
        return
    middle, direction = _middle(points)
    if text_width(stroke.label, SMALL) + 18.0 > float(np.abs(np.diff(points)).sum()):
        middle += 7.0 * _upright(direction) * 1j
    pen.sheet.text(
        middle,
        stroke.label,
        fontsize=SMALL,
        color=INK,
        ha="center",
        va="center_baseline",
        rotation=float(np.degrees(np.angle(_upright(direction)))),
        clear=True,
        zorder=6,
    )


def _upright(direction: complex) -> complex:
    """The direction or its opposite, so that a text is read from below or from the right."""
    return -direction if direction.real < -1e-9 or (abs(direction.real) <= 1e-9 and direction.imag < 0) else direction


def _middle(points: ComplexArray) -> tuple[complex, complex]:
    """The middle of a polyline by its length, and the unit direction at that point."""
    steps = np.diff(points)
    along = np.concatenate([[0.0], np.cumsum(np.abs(steps))])
    index = int(np.clip(np.searchsorted(along, along[-1] / 2) - 1, 0, len(steps) - 1))
    length = abs(steps[index]) or 1.0
    return complex(points[index] + steps[index] * (along[-1] / 2 - along[index]) / length), complex(
        steps[index] / length
    )


def _wheel(pen: Pen, stroke: Stroke) -> None:
    """The pitch circle of a wheel, with a radius that shows its turn."""
    shade = colour(stroke.look)
    points = _line(pen, stroke, color=shade, linewidth=1.2, dashes=PITCH, zorder=3.8)
    pen.sheet.area(points, facecolor=tint(shade, 0.1), linewidth=0, zorder=1.7)


def _pin(pen: Pen, at: complex, _: complex) -> None:
    pen.sheet.area(circle(at, 3.4), facecolor=PAPER, edgecolor=INK, linewidth=1.1, zorder=7)


def _pivot(pen: Pen, at: complex, along: complex) -> None:
    """A triangle on hatched ground with the pin at its tip."""
    corners = at + np.array([0, -7.5 - 12j, 7.5 - 12j])
    pen.sheet.area(corners, facecolor="#e4e8ec", edgecolor=INK, linewidth=1.0, zorder=3.6)
    base = at + np.array([-10.5 - 12j, 10.5 - 12j])
    pen.sheet.line(base, color=INK, linewidth=1.0, zorder=3.6)
    _hatch(pen.sheet, base, 5.0)
    _pin(pen, at, along)


def _point(pen: Pen, at: complex, _: complex) -> None:
    pen.sheet.area(circle(at, 1.9), facecolor=INK, linewidth=0, zorder=7)


def _block(pen: Pen, at: complex, along: complex) -> None:
    """A slider along its guide."""
    corners = at + np.array([BLOCK, -BLOCK.conjugate(), -BLOCK, BLOCK.conjugate()]) * along / (abs(along) or 1.0)
    pen.sheet.area(corners, facecolor=GRID, edgecolor=STEEL, linewidth=1.2, zorder=6.5)


STROKES: Mapping[str, Callable[[Pen, Stroke], None]] = {
    "outline": _outline,
    "link": _link,
    "ground": _ground,
    "guide": _guide,
    "path": _path,
    "construction": _construction,
    "dimension": _dimension,
    "yarn": _yarn,
    "wheel": _wheel,
}
DOTS: Mapping[str, Callable[[Pen, complex, complex], None]] = {
    "pin": _pin,
    "pivot": _pivot,
    "point": _point,
    "block": _block,
}
"""Each draws at a point of the sheet [pt]; a block along a direction."""
