"""Figures and tables of a report, made plain data for the studio's client: see `answers`.

Curves of many samples are thinned as on the pages that the command line writes.
"""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.records import alike
from ilmek.report import (
    Animation,
    DesignCloud,
    Drawing,
    Figure,
    Gantt,
    MovingStroke,
    Plot,
    StackedBars,
    Stroke,
    Table,
    Timing,
)
from ilmek.viz.looks import COLOURED, looks_of, numbered
from ilmek.viz.number_format import quiet_rows
from ilmek.viz.plain.records import (
    MovingPoint,
    MovingShape,
    Numbers,
    ShownAnimation,
    ShownAxis,
    ShownBars,
    ShownCloud,
    ShownColumn,
    ShownCurve,
    ShownDot,
    ShownDrawing,
    ShownFigure,
    ShownGantt,
    ShownLane,
    ShownPlot,
    ShownReading,
    ShownSpans,
    ShownStroke,
    ShownTable,
    ShownTiming,
)
from ilmek.viz.thinning import thinned_curve, thinned_line

DIGITS = 6
"""Significant digits of a number in a figure: a pixel of the largest screen is a hundred times more."""

FINE = 4000.0
"""Extent of a drawing in the units in which its lines are thinned: it can be enlarged ten times without corners."""

EVEN = 0.5
"""Largest deviation of a thinned curve, in the same units of the extent of its axes: a tenth of a pixel."""


def shown_figures(figures: Iterable[Figure]) -> list[ShownFigure]:
    """Figures that belong together."""
    figures = tuple(figures)
    looks = looks_of(figures)
    return [shown_figure(figure, looks) for figure in figures]


def shown_figure(figure: Figure, looks: Mapping[str, int]) -> ShownFigure:
    """A figure with the looks of its labels, see `viz.looks.looks_of`."""
    kind: dict[str, Any]
    match figure:
        case Plot():
            kind = {"plot": _plot(figure, looks)}
        case Drawing():
            kind = {"drawing": _drawing(figure, _coloured(figure.strokes, looks))}
        case Animation():
            kind = {"animation": _animation(figure, looks)}
        case Timing():
            kind = {"timing": _timing(figure, looks)}
        case Gantt():
            kind = {"gantt": _gantt(figure, looks)}
        case StackedBars():
            kind = {"bars": _bars(figure, looks)}
        case DesignCloud():
            kind = {"cloud": _cloud(figure, looks)}
    return ShownFigure(figure.name, figure.title, figure.note, **kind)


def shown_table(table: Table) -> ShownTable:
    """A table, without rounding noise."""
    heads = [ShownColumn(column.heading, column.unit, column.digits) for column in table.columns]
    return ShownTable(table.name, table.title, heads, [list(row) for row in quiet_rows(table)])


def rounded_numbers(values: FloatArray) -> Numbers:
    """Numbers with six significant digits, not a number as null.

    >>> rounded_numbers(np.array([0.1 + 0.2, -1234567.0, 0.0, np.nan, np.inf]))
    [0.3, -1234570.0, 0.0, None, None]
    """
    flat = np.asarray(values, dtype=float).ravel()
    finite = np.isfinite(flat)
    flat = np.where(finite, flat, 0.0)
    size = np.abs(flat)
    decade = np.floor(np.log10(np.where(size > 0, size, 1.0)))
    shift = DIGITS - 1 - decade
    up, down = 10.0 ** np.maximum(shift, 0.0), 10.0 ** np.maximum(-shift, 0.0)
    rounded: Numbers = (np.rint(flat * up / down) * down / up + 0.0).tolist()
    for gap in np.flatnonzero(~finite).tolist():
        rounded[gap] = None
    return rounded


def interleaved(points: ComplexArray) -> Numbers:
    """Points as x, y, x, y, …

    >>> interleaved(np.array([1 + 2j, 3 - 4j]))
    [1.0, 2.0, 3.0, -4.0]
    """
    return rounded_numbers(np.ascontiguousarray(points, dtype=complex).view(float))


def _plot(plot: Plot, looks: Mapping[str, int]) -> ShownPlot:
    numbers = numbered([series.label for series in plot.series], looks)
    curves, wide, high = [], _extent([one.x for one in plot.series]), _extent([one.y for one in plot.series])
    for series, look in zip(plot.series, numbers, strict=True):
        x, y = thinned_curve(np.asarray(series.x, float), np.asarray(series.y, float))
        points = thinned_line(x * (FINE / wide) + 1j * y * (FINE / high), EVEN)
        x, y = points.real * (wide / FINE), points.imag * (high / FINE)
        curves.append(ShownCurve(series.label, look, series.dashed, rounded_numbers(x), rounded_numbers(y)))
    return ShownPlot(ShownAxis(plot.x.label, plot.x.unit), ShownAxis(plot.y.label, plot.y.unit), curves, plot.marks)


def _extent(parts: Iterable[FloatArray]) -> float:
    """Greatest less least of the finite values; 1 where they do not differ."""
    values = np.concatenate([np.zeros(0), *(np.asarray(part, float) for part in parts)])
    values = values[np.isfinite(values)]
    return float(np.ptp(values)) or 1.0 if len(values) else 1.0


def _coloured(strokes: Iterable[Stroke | MovingStroke], looks: Mapping[str, int]) -> list[int]:
    """The look of each stroke; -1 of those whose role has a colour of its own."""
    strokes = tuple(strokes)
    order = [index for role in COLOURED for index, stroke in enumerate(strokes) if stroke.role == role]
    look = dict(zip(order, numbered([strokes[index].label for index in order], looks), strict=True))
    return [look.get(index, -1) for index in range(len(strokes))]


def _drawing(drawing: Drawing, numbers: list[int]) -> ShownDrawing:
    parts = [stroke.points[np.isfinite(stroke.points)] for stroke in drawing.strokes if len(stroke.points)]
    everything = np.concatenate(parts) if parts else np.zeros(1, complex)
    wide = max(np.ptp(everything.real), np.ptp(everything.imag), 1e-9) if len(everything) else 1.0
    scale = FINE / float(wide)
    strokes = [
        alike(ShownStroke, stroke, points=interleaved(thinned_line(stroke.points * scale) / scale), look=look)
        for stroke, look in zip(drawing.strokes, numbers, strict=True)
    ]
    dots = [ShownDot((dot.at.real, dot.at.imag), dot.label, dot.role) for dot in drawing.dots]
    return ShownDrawing(strokes, dots, drawing.unit)


class _Tracks:
    """Positions of points over the frames, each once."""

    def __init__(self) -> None:
        self.positions: list[Numbers] = []
        self._known: dict[bytes, int] = {}

    def number(self, points: ComplexArray) -> int:
        key = np.ascontiguousarray(points).tobytes()
        if key not in self._known:
            self._known[key] = len(self.positions)
            self.positions.append(interleaved(points))
        return self._known[key]


def _animation(animation: Animation, looks: Mapping[str, int]) -> ShownAnimation:
    tracks = _Tracks()
    numbers = _coloured((*animation.still.strokes, *animation.strokes), looks)
    still = len(animation.still.strokes)
    shapes = [_shape(stroke, tracks, look) for stroke, look in zip(animation.strokes, numbers[still:], strict=True)]
    return ShownAnimation(
        still=_drawing(animation.still, numbers[:still]),
        drive=ShownAxis(animation.drive.label, animation.drive.unit),
        at=rounded_numbers(animation.at),
        tracks=tracks.positions,
        shapes=shapes,
        points=[
            MovingPoint(
                tracks.number(dot.at),
                -1 if dot.along is None else tracks.number(dot.at + dot.along),
                dot.label,
                dot.role,
            )
            for dot in animation.dots
        ],
        readings=[
            ShownReading(reading.label, reading.unit, rounded_numbers(reading.values)) for reading in animation.readings
        ],
        closes=animation.closes,
        start=animation.start,
        period=animation.period,
    )


def _shape(stroke: MovingStroke, tracks: _Tracks, look: int) -> MovingShape:
    points = stroke.points
    if not _is_rigid(points):
        numbers = [tracks.number(points[:, at]) for at in range(points.shape[1])]
        return MovingShape(numbers, [], stroke.role, stroke.label, stroke.closed, look)
    far = int(np.argmax(np.abs(points[0] - points[0, 0])))
    along = points[0, far] - points[0, 0]
    local = (points[0] - points[0, 0]) * abs(along) / along
    numbers = [tracks.number(points[:, 0]), tracks.number(points[:, far])]
    return MovingShape(numbers, interleaved(local), stroke.role, stroke.label, stroke.closed, look)


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


def _timing(timing: Timing, looks: Mapping[str, int]) -> ShownTiming:
    numbers = numbered([lane.name for lane in timing.lanes], looks)
    lanes = []
    for lane, look in zip(timing.lanes, numbers, strict=True):
        angle, position = thinned_curve(np.asarray(lane.angle, float), np.asarray(lane.position, float))
        known: Iterable[FloatArray] = () if lane.motion is None else lane.motion
        motion = [rounded_numbers(np.interp(angle, lane.angle, row)) for row in known]
        lanes.append(
            alike(
                ShownLane,
                lane,
                shown_unit=lane.unit,
                look=look,
                angle=rounded_numbers(angle),
                position=rounded_numbers(position),
                motion=motion,
            )
        )
    return ShownTiming(ShownAxis(timing.drive.label, timing.drive.unit), timing.period, lanes, timing.links)


def _gantt(gantt: Gantt, looks: Mapping[str, int]) -> ShownGantt:
    lanes = [
        ShownSpans(lane.name, rounded_numbers(lane.starts), rounded_numbers(lane.ends), lane.kinds.tolist())
        for lane in gantt.lanes
    ]
    kinds = list(gantt.kinds)
    return ShownGantt(ShownAxis(gantt.x.label, gantt.x.unit), lanes, kinds, numbered(kinds, looks), gantt.pale)


def _bars(bars: StackedBars, looks: Mapping[str, int]) -> ShownBars:
    kinds = list(bars.kinds)
    rows = [rounded_numbers(row) for row in np.asarray(bars.values, float)]
    axis = ShownAxis(bars.x.label, bars.x.unit)
    return ShownBars(axis, list(bars.bars), kinds, numbered(kinds, looks), rows)


def _cloud(cloud: DesignCloud, looks: Mapping[str, int]) -> ShownCloud:
    columns, kinds = [ShownAxis(one.label, one.unit) for one in cloud.columns], list(cloud.kinds)
    values = [rounded_numbers(row) for row in cloud.values]
    return ShownCloud(columns, values, kinds, numbered(kinds, looks), cloud.kind.tolist(), list(cloud.commands))
