"""Curves over one axis."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.records import JsonObject
from ilmek.report import Mark, Plot, Series
from ilmek.units import parse_unit
from ilmek.viz.font import text_width
from ilmek.viz.frame import Box, grid, left_axis, lower_axis, paper
from ilmek.viz.looks import dashes, marker_shape
from ilmek.viz.scale import span, tick_labels, ticks
from ilmek.viz.sheet import Sheet
from ilmek.viz.style import AXIS, INK, MUTED, PAPER, SMALL, TEXT, colour, in_unit, with_unit
from ilmek.viz.thinning import thinned_curve, thinned_line

WIDTH, HEIGHT = 420.0, 168.0
"""Width of the sheet and height of the plotting area [pt]."""
_RIGHT, _BOTTOM, _ROW, _TIER = 14.0, 29.0, 13.0, 10.0
_KEY = 20.0
_MARKER, _MARKERS = 2.9, 6
"""Radius of a marker [pt], and their number on a curve."""


@dataclass(frozen=True, slots=True)
class _Entry:
    """A legend entry with its row from the top and its left edge [pt]."""

    series: Series
    row: int
    left: float


def draw_plot(plot: Plot) -> Sheet:
    """The curves with grid, axes with units, legend above the curves and labels of the marks between the two."""
    x_span = span(_all([in_unit(one.x, plot.x.unit) for one in plot.series]))
    y_span = _padded(*span(_all([in_unit(one.y, plot.y.unit) for one in plot.series])))
    if plot.series and not _unique(plot) and plot.x.unit == plot.y.unit:
        x_span, y_span = _equal_scales(x_span, y_span)
    x_ticks, y_ticks = ticks(*x_span, plot.x.unit, 9), ticks(*y_span, plot.y.unit, 6)
    left = 26.0 + max((text_width(label, SMALL) for label in tick_labels(y_ticks)), default=0.0)
    entries = _legend(plot, left)
    tiers = _tiers(plot.marks, x_span, plot.x.unit, WIDTH - left - _RIGHT)
    rows = 1 + max((entry.row for entry in entries), default=-1)
    top = 6.0 + _ROW * rows + _TIER * (1 + max(tiers, default=-1)) + (4.0 if tiers else 0.0)
    sheet = Sheet(WIDTH, _BOTTOM + HEIGHT + top)
    box = Box(left, _BOTTOM, WIDTH - left - _RIGHT, HEIGHT)
    scales = _Scales(box, x_span, y_span)
    paper(sheet, box)
    at_x, at_y = [scales.x(value) for value in x_ticks], [scales.y(value) for value in y_ticks]
    grid(sheet, box, at_x, at_y)
    lower_axis(sheet, box, at_x, x_ticks, with_unit(plot.x.label, plot.x.unit))
    left_axis(sheet, box, at_y, y_ticks, with_unit(plot.y.label, plot.y.unit))
    if y_span[0] < 0 < y_span[1]:
        sheet.line(1j * scales.y(0.0) + np.array([box.left, box.right]), color=AXIS, linewidth=0.8, zorder=1.5)
    _draw_curves(sheet, scales, plot)
    _draw_marks(sheet, box, scales, plot, tiers)
    _draw_legend(sheet, entries)
    return sheet


def _unique(plot: Plot) -> bool:
    """Whether a plot has a curve with one ordinate for an abscissa."""
    return any(len(one.x) > 0 and bool(np.all(np.diff(one.x) >= 0)) for one in plot.series)


def _draw_curves(sheet: Sheet, scales: "_Scales", plot: Plot) -> None:
    """The curves; where there are several, each has markers, staggered so that they stand apart."""
    several = len(plot.series) > 1
    for index, one in enumerate(plot.series):
        x, y = thinned_curve(in_unit(one.x, plot.x.unit), in_unit(one.y, plot.y.unit))
        points = thinned_line(scales.x(x) + 1j * scales.y(y))
        sheet.line(points, zorder=3, **_line(one))
        if several:
            for at in _spread(points, scales.box, (index + 0.5) / len(plot.series)):
                _mark(sheet, at, one.look)


def _mark(sheet: Sheet, at: complex, number: int) -> None:
    corners = at + marker_shape(number, _MARKER)
    sheet.area(corners, facecolor=colour(number), edgecolor=PAPER, linewidth=0.4, zorder=3.4)


def _spread(points: ComplexArray, box: Box, share: float) -> ComplexArray:
    """Points of a curve at even abscissae; none where it has no unique ordinate, or a gap."""
    finite = points[np.isfinite(points)]
    if len(finite) < len(points) or len(points) < 2 or np.any(np.diff(points.real) < 0):
        return np.empty(0, complex)
    x = box.left + box.width * (np.arange(_MARKERS) + share) / _MARKERS
    x = x[(x >= points.real[0]) & (x <= points.real[-1])]
    return np.asarray(x + 1j * np.interp(x, points.real, points.imag))


@dataclass(frozen=True, slots=True)
class _Scales:
    """Map from values in the axes' units to coordinates on the sheet [pt]."""

    box: Box
    x_span: tuple[float, float]
    y_span: tuple[float, float]

    def x(self, values: Any) -> Any:
        return self.box.left + (values - self.x_span[0]) / (self.x_span[1] - self.x_span[0]) * self.box.width

    def y(self, values: Any) -> Any:
        return self.box.low + (values - self.y_span[0]) / (self.y_span[1] - self.y_span[0]) * self.box.height


def _all(parts: list[FloatArray]) -> FloatArray:
    return np.concatenate([np.empty(0), *parts])


def _equal_scales(x: tuple[float, float], y: tuple[float, float]) -> tuple[tuple[float, float], tuple[float, float]]:
    """Spans with equal scales in both directions, for a curve in a plane; the narrower one is widened."""
    room = (WIDTH - 60.0) / HEIGHT
    wide, high = x[1] - x[0], y[1] - y[0]
    more_x, more_y = max(high * room - wide, 0.0) / 2, max(wide / room - high, 0.0) / 2
    return (x[0] - more_x, x[1] + more_x), (y[0] - more_y, y[1] + more_y)


def _padded(low: float, high: float) -> tuple[float, float]:
    """The span with 5 % margins; an end at or near zero is put on zero."""
    margin = 0.05 * (high - low)
    if low >= 0 and low < 0.25 * high:
        return 0.0, high + margin
    if high <= 0 and high > 0.25 * low:
        return low - margin, 0.0
    return low - margin, high + margin


def _line(series: Series) -> JsonObject:
    """Style of a curve."""
    return {"color": colour(series.look), "linewidth": 1.5, "dashes": dashes(series.look, dashed=series.dashed)}


def _legend(plot: Plot, left: float) -> list[_Entry]:
    """Entries in rows above the curves; none if the axis names the only curve."""
    if len(plot.series) == 1 and plot.series[0].label in ("", plot.y.label, plot.title):
        return []
    entries: list[_Entry] = []
    row, at = 0, left
    for series in plot.series:
        width = _KEY + 4.0 + text_width(series.label, TEXT) + 12.0
        if at > left and at + width > WIDTH:
            row, at = row + 1, left
        entries.append(_Entry(series, row, at))
        at += width
    return entries


def _draw_legend(sheet: Sheet, entries: list[_Entry]) -> None:
    for entry in entries:
        at = complex(entry.left, sheet.height - 4.0 - _ROW * (entry.row + 0.5))
        sheet.line(np.array([at, at + _KEY]), **_line(entry.series))
        if len(entries) > 1:
            _mark(sheet, at + _KEY / 2, entry.series.look)
        sheet.text(at + _KEY + 4.0, entry.series.label, fontsize=TEXT, va="center_baseline")


def _tiers(marks: tuple[Mark, ...], x_span: tuple[float, float], unit: str, width: float) -> list[int]:
    """The tier of each mark's label: 0, or higher if it would overlap one to its left."""
    values = in_unit(np.array([mark.x for mark in marks], dtype=float), unit)
    centres = (values - x_span[0]) / (x_span[1] - x_span[0]) * width
    tiers = [0] * len(marks)
    ends: list[float] = []
    for index in np.argsort(centres):
        half = text_width(marks[index].label, SMALL) / 2 + 3.0
        tier = next((t for t, end in enumerate(ends) if centres[index] - half >= end), len(ends))
        ends[tier : tier + 1] = [centres[index] + half]
        tiers[index] = tier
    return tiers


def _draw_marks(sheet: Sheet, box: Box, scales: _Scales, plot: Plot, tiers: list[int]) -> None:
    for mark, tier in zip(plot.marks, tiers, strict=True):
        x = float(scales.x(mark.x / parse_unit(plot.x.unit).factor))
        if not box.left - 1e-6 <= x <= box.right + 1e-6:
            continue
        line = x + 1j * np.array([box.low, box.top])
        sheet.line(line, color=INK, linewidth=0.7, dashes=(2, 2), zorder=2)
        above = x + 1j * (box.top + 3.0 + _TIER * tier)
        sheet.text(above, mark.label, ha="center", va="bottom", fontsize=SMALL, color=MUTED)
