"""Lanes over one axis: Gantt charts, and horizontal bars of parts side by side."""

from collections.abc import Sequence

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.report import Gantt, GanttLane, StackedBars
from ilmek.units import parse_unit
from ilmek.viz.font import text_width
from ilmek.viz.frame import Box, grid, lower_axis, paper
from ilmek.viz.scale import ticks
from ilmek.viz.sheet import Sheet
from ilmek.viz.style import AXIS, STRONG, TEXT, colour, in_unit, tint, with_unit

WIDTH = 600.0
_RIGHT, _BOTTOM, _BAR, _GAP, _ROW, _KEY = 16.0, 30.0, 15.0, 8.0, 13.0, 10.0
"""Right margin, room for the axis, height of a bar, gap of two, height of a row of the legend, side of a key [pt]."""

_PALE = 0.35
"""Share of the colour in what is drawn pale."""

_LEAST = 0.7
"""Least width of a span [pt]: a short stop of a long carpet is still seen."""


def draw_gantt(gantt: Gantt) -> Sheet:
    """The sheet of a Gantt chart, the first lane on top; short spans lie over long ones."""
    used = sorted({int(kind) for lane in gantt.lanes for kind in np.unique(lane.kinds)})
    most = max([1e-9, *(float(lane.ends.max()) for lane in gantt.lanes if len(lane.ends))])
    frame = _Frame(gantt, [lane.name for lane in gantt.lanes], used, most)
    frame.make_pale(gantt.pale)
    for index, lane in enumerate(gantt.lanes):
        for kind, low, high in _merged(lane, frame):
            frame.bar(index, kind, low, high)
    frame.legend()
    return frame.sheet


def _merged(lane: GanttLane, frame: "_Frame") -> list[tuple[int, float, float]]:
    """Spans on the sheet [pt], neighbours of one kind joined; the longest first, so that shorter ones lie over them."""
    starts, ends = frame.x(lane.starts), frame.x(lane.ends)
    spans: list[tuple[int, float, float]] = []
    open_spans: dict[int, list[float]] = {}

    def put(kind: int, low: float, high: float) -> None:
        spans.append((kind, low, max(high, low + _LEAST)))

    for kind, low, high in zip(lane.kinds.tolist(), starts.tolist(), ends.tolist(), strict=True):
        last = open_spans.get(kind)
        if last is not None and low - last[1] < 0.05:
            last[1] = max(high, last[1])
            continue
        if last is not None:
            put(kind, *last)
        open_spans[kind] = [low, high]
    for kind, (low, high) in open_spans.items():
        put(kind, low, high)
    return sorted(spans, key=lambda span: span[1] - span[2])


def draw_stacked(bars: StackedBars) -> Sheet:
    """The sheet of bars of parts, the first on top."""
    values = np.nan_to_num(np.asarray(bars.values, dtype=float))
    used = np.flatnonzero(values.any(axis=0)).tolist()
    most = max(1e-9, float(values.sum(axis=1).max(initial=0.0)))
    frame = _Frame(bars, bars.bars, used, most)
    for index, row in enumerate(values):
        ends = frame.x(np.concatenate([[0.0], np.cumsum(row)])).tolist()
        for kind in used:
            if row[kind] > 0:
                frame.bar(index, kind, ends[kind], ends[kind + 1])
    frame.legend()
    return frame.sheet


class _Frame:
    """Sheet, axis, names and legend of a number of lanes."""

    def __init__(self, figure: Gantt | StackedBars, names: Sequence[str], used: Sequence[int], most: float) -> None:
        axis, kinds = figure.x, figure.kinds
        shades = [colour(number) for number in figure.looks]
        if len({shades[kind] for kind in used}) < len(used):  # other figures have taken colours: here each its own
            shades = [colour(number) for number in range(len(kinds))]
        self._colours = dict(enumerate(shades))
        left = 18.0 + max([40.0, *(text_width(name, STRONG, bold=True) for name in names)])
        keys = _keys([(kind, kinds[kind]) for kind in used], left)
        rows = 1 + max((row for _, row, _ in keys), default=-1)
        height = len(names) * (_BAR + _GAP) + _GAP
        self.sheet = Sheet(WIDTH, _BOTTOM + height + _ROW * rows + 6.0)
        self._box = Box(left, _BOTTOM, WIDTH - left - _RIGHT, height)
        self._factor, self._most = parse_unit(axis.unit).factor, most
        paper(self.sheet, self._box)
        values = ticks(0.0, most / self._factor, axis.unit, 8)
        at = [float(self.x(np.array([value * self._factor]))[0]) for value in values]
        grid(self.sheet, self._box, at)
        lower_axis(self.sheet, self._box, at, values, with_unit(axis.label, axis.unit))
        for index, name in enumerate(names):
            middle = complex(left - 8.0, self._low(index) + _BAR / 2)
            self.sheet.text(middle, name, fontsize=STRONG, bold=True, ha="right", va="center_baseline")
        self.sheet.line(left + 1j * np.array([self._box.low, self._box.top]), color=AXIS, linewidth=0.7)
        self._keys, self._kinds = keys, kinds

    def make_pale(self, kinds: int) -> None:
        """Draw the first kinds pale."""
        self._colours |= {kind: tint(self._colours[kind], _PALE) for kind in range(kinds)}

    def legend(self) -> None:
        """Draw the legend."""
        for kind, row, across in self._keys:
            self._key(
                self._kinds[kind], self._colours[kind], complex(across, self.sheet.height - 4.0 - _ROW * (row + 0.5))
            )

    def x(self, values: FloatArray) -> FloatArray:
        """Abscissae on the sheet [pt] of SI values."""
        return self._box.left + in_unit(values, "") / self._most * self._box.width

    def bar(self, index: int, kind: int, low: float, high: float) -> None:
        """Draw a part of a lane between two abscissae [pt]."""
        floor = 1j * self._low(index)
        corners = np.array([low, high, high, low]) + floor + 1j * _BAR * np.array([0, 0, 1, 1])
        self.sheet.area(corners, facecolor=self._colours[kind], zorder=2.0)

    def _low(self, index: int) -> float:
        return self._box.top - (index + 1) * (_BAR + _GAP)

    def _key(self, name: str, shade: str, at: complex) -> None:
        corners = at + _KEY * np.array([0, 1, 1, 0]) + 1j * _KEY * np.array([-0.5, -0.5, 0.5, 0.5])
        self.sheet.area(corners, facecolor=shade)
        self.sheet.text(at + _KEY + 4.0, name, fontsize=TEXT, va="center_baseline")


def _keys(kinds: Sequence[tuple[int, str]], left: float) -> list[tuple[int, int, float]]:
    """Kind, row from the top and left edge [pt] of each entry of the legend."""
    keys, row, at = [], 0, left
    for kind, name in kinds:
        width = _KEY + 4.0 + text_width(name, TEXT) + 14.0
        if at > left and at + width > WIDTH:
            row, at = row + 1, left
        keys.append((kind, row, at))
        at += width
    return keys
