"""Figures and tables of reports as the studio's client draws them: the records of `report`, thinned and rounded.

Curves of many samples are thinned as on the pages that the command line writes. What moves is packed: each track of a
point is there once, and what keeps its shape moves by two of its points.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.records import alike
from ilmek.report import (
    Animation,
    Axis,
    Drawing,
    Figure,
    Gantt,
    MovingStroke,
    Plot,
    Reading,
    Series,
    StackedBars,
    Stroke,
    Timing,
)
from ilmek.viz.looks import looked
from ilmek.viz.thinning import thinned_curve, thinned_line

DIGITS = 6
"""Significant digits of a number in a figure: a pixel of the largest screen is a hundred times more."""

FINE = 4000.0
"""Extent of a drawing in the units in which its lines are thinned: it can be enlarged ten times without corners."""

EVEN = 0.5
"""Largest deviation of a thinned curve, in the same units of the extent of its axes: a tenth of a pixel."""

KINDS = {
    Plot: "plot",
    Drawing: "drawing",
    Animation: "animation",
    Timing: "timing",
    Gantt: "gantt",
    StackedBars: "bars",
}
"""Kinds of figures by their classes."""

Numbers = TypeVar("Numbers", FloatArray, ComplexArray)


@dataclass(frozen=True, eq=False, slots=True)
class MovingShape:
    """A line that moves. track: numbers of the tracks of its points.

    shape   where it keeps its shape: its points about the first track, the second track ahead of it on the x axis
    """

    tracks: list[int]
    shape: ComplexArray
    role: str
    label: str
    closed: bool
    look: int


@dataclass(frozen=True, slots=True)
class MovingPoint:
    """A point that moves: pin, point or block; ahead: the track of a point ahead of a block on its guide, -1: none."""

    track: int
    ahead: int
    label: str
    role: str


@dataclass(frozen=True, eq=False, slots=True)
class ShownAnimation:
    """A machine in motion as in the report; tracks: positions of points over the frames [m]."""

    still: Drawing
    drive: Axis
    at: FloatArray
    tracks: list[ComplexArray]
    shapes: list[MovingShape]
    points: list[MovingPoint]
    readings: tuple[Reading, ...]
    closes: bool
    start: int
    period: float | None


@dataclass(frozen=True, eq=False, slots=True)
class ShownFigure:
    """A figure: one of its kinds, the others are null."""

    plot: Plot | None = None
    drawing: Drawing | None = None
    animation: ShownAnimation | None = None
    timing: Timing | None = None
    gantt: Gantt | None = None
    bars: StackedBars | None = None


def shown_figures(figures: Iterable[Figure]) -> list[ShownFigure]:
    """Figures that belong together, with looks, thinned and rounded."""
    return [ShownFigure(**{KINDS[type(figure)]: _shown(figure)}) for figure in looked(figures)]


def _shown(figure: Figure) -> Any:
    match figure:
        case Plot():
            return _plot(figure)
        case Drawing():
            return _drawing(figure)
        case Animation():
            return _animation(figure)
        case Timing():
            return _timing(figure)
        case Gantt():
            lanes = (replace(lane, starts=rounded(lane.starts), ends=rounded(lane.ends)) for lane in figure.lanes)
            return replace(figure, lanes=tuple(lanes))
        case StackedBars():
            return replace(figure, values=tuple(map(rounded, figure.values)))


def rounded(values: Numbers) -> Numbers:
    """Numbers, real or complex, with six significant digits; what is not finite is not a number.

    >>> rounded(np.array([0.1 + 0.2, -1234567.0, 0.0, np.nan, np.inf])).tolist()
    [0.3, -1234570.0, 0.0, nan, nan]
    """
    if np.iscomplexobj(values):
        return rounded(np.ascontiguousarray(values).view(float)).view(complex)
    finite = np.isfinite(values)
    whole = np.where(finite, values, 0.0)
    size = np.abs(whole)
    shift = DIGITS - 1 - np.floor(np.log10(np.where(size > 0, size, 1.0)))
    up, down = 10.0 ** np.maximum(shift, 0.0), 10.0 ** np.maximum(-shift, 0.0)
    return np.where(finite, np.rint(whole * up / down) * down / up + 0.0, np.nan)


def _plot(plot: Plot) -> Plot:
    wide, high = _extent([one.x for one in plot.series]), _extent([one.y for one in plot.series])

    def thinned(series: Series) -> Series:
        x, y = thinned_curve(np.asarray(series.x, float), np.asarray(series.y, float))
        points = thinned_line(x * (FINE / wide) + 1j * y * (FINE / high), EVEN)
        return replace(series, x=rounded(points.real * (wide / FINE)), y=rounded(points.imag * (high / FINE)))

    return replace(plot, series=tuple(map(thinned, plot.series)))


def _extent(parts: Iterable[FloatArray]) -> float:
    """Greatest less least of the finite values; 1 where they do not differ."""
    values = np.concatenate([np.zeros(0), *(np.asarray(part, float) for part in parts)])
    values = values[np.isfinite(values)]
    return float(np.ptp(values)) or 1.0 if len(values) else 1.0


def _drawing(drawing: Drawing) -> Drawing:
    parts = [stroke.points[np.isfinite(stroke.points)] for stroke in drawing.strokes if len(stroke.points)]
    everything = np.concatenate(parts) if parts else np.zeros(1, complex)
    wide = max(np.ptp(everything.real), np.ptp(everything.imag), 1e-9) if len(everything) else 1.0
    scale = FINE / float(wide)

    def thinned(stroke: Stroke) -> Stroke:
        return replace(stroke, points=rounded(np.asarray(thinned_line(stroke.points * scale) / scale, complex)))

    dots = (replace(dot, at=complex(dot.at), along=complex(dot.along)) for dot in drawing.dots)
    return replace(drawing, strokes=tuple(map(thinned, drawing.strokes)), dots=tuple(dots))


class _Tracks:
    """Positions of points over the frames, each once."""

    def __init__(self) -> None:
        self.positions: list[ComplexArray] = []
        self._known: dict[bytes, int] = {}

    def number(self, points: ComplexArray) -> int:
        key = np.ascontiguousarray(points).tobytes()
        if key not in self._known:
            self._known[key] = len(self.positions)
            self.positions.append(rounded(np.asarray(points, complex)))
        return self._known[key]


def _animation(animation: Animation) -> ShownAnimation:
    tracks = _Tracks()
    points = [
        MovingPoint(
            tracks.number(dot.at), -1 if dot.along is None else tracks.number(dot.at + dot.along), dot.label, dot.role
        )
        for dot in animation.dots
    ]
    return alike(
        ShownAnimation,
        animation,
        still=_drawing(animation.still),
        at=rounded(animation.at),
        tracks=tracks.positions,
        shapes=[_shape(stroke, tracks) for stroke in animation.strokes],
        points=points,
        readings=tuple(replace(one, values=rounded(np.asarray(one.values, float))) for one in animation.readings),
    )


def _shape(stroke: MovingStroke, tracks: _Tracks) -> MovingShape:
    points = stroke.points
    if not _is_rigid(points):
        numbers = [tracks.number(points[:, at]) for at in range(points.shape[1])]
        return alike(MovingShape, stroke, tracks=numbers, shape=np.zeros(0, complex))
    far = int(np.argmax(np.abs(points[0] - points[0, 0])))
    along = points[0, far] - points[0, 0]
    local = (points[0] - points[0, 0]) * abs(along) / along
    numbers = [tracks.number(points[:, 0]), tracks.number(points[:, far])]
    return alike(MovingShape, stroke, tracks=numbers, shape=rounded(local))


def _is_rigid(points: ComplexArray) -> bool:
    """Whether a line of more than three points moves without changing its shape; points (frames, points)."""
    if points.shape[1] <= 3 or not np.isfinite(points).all():
        return False
    off = points - points[:, :1]
    far = int(np.argmax(np.abs(off[0])))
    size = abs(off[0, far])
    if size == 0 or np.any(off[:, far] == 0):
        return False
    turned = off[:, far] / off[0, far]
    return bool(np.max(np.abs(off - turned[:, np.newaxis] * off[0])) < 1e-6 * size)


def _timing(timing: Timing) -> Timing:
    lanes = []
    for lane in timing.lanes:
        angle, position = thinned_curve(np.asarray(lane.angle, float), np.asarray(lane.position, float))
        motion = tuple(rounded(np.interp(angle, lane.angle, row)) for row in lane.motion)
        lanes.append(replace(lane, angle=rounded(angle), position=rounded(position), motion=motion))
    return replace(timing, lanes=tuple(lanes))
