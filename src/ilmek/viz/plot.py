"""Curves over one axis."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ilmek.report import Mark, Plot, Series
from ilmek.units import parse_unit
from ilmek.viz.ink import axes_in_points, sheet
from ilmek.viz.scale import span, tick_labels, ticks
from ilmek.viz.style import (
    AXIS,
    DASHES,
    GRID,
    INK,
    MUTED,
    PALETTE,
    SMALL,
    TEXT,
    colour,
    in_unit,
    text_width,
    with_unit,
)
from ilmek.viz.thinning import thinned_curve, thinned_line

WIDTH, HEIGHT = 420.0, 168.0
"""Width of the sheet and height of the plotting area [pt]."""
_RIGHT, _BOTTOM, _ROW, _TIER = 14.0, 29.0, 13.0, 10.0
_KEY = 20.0


@dataclass(frozen=True, slots=True)
class _Entry:
    """A legend entry with its place: row from the top, left edge [pt]."""

    series: Series
    number: int
    row: int
    left: float


def draw_plot(plot: Plot) -> Figure:
    """The curves with a grid, units on the axes, the legend above the curves and the marks between the two."""
    y_span = _padded(*span(np.concatenate([in_unit(one.y, plot.y.unit) for one in plot.series] or [np.empty(0)])))
    x_span = span(np.concatenate([in_unit(one.x, plot.x.unit) for one in plot.series] or [np.empty(0)]))
    y_ticks = ticks(*y_span, plot.y.unit, 6)
    labels = tick_labels(y_ticks)
    left = 26.0 + max((text_width(label, SMALL) for label in labels), default=0.0)
    entries = _legend(plot, left)
    rows = 1 + max((entry.row for entry in entries), default=-1)
    tiers = _tiers(plot.marks, x_span, plot.x.unit, WIDTH - left - _RIGHT)
    top = 6.0 + _ROW * rows + _TIER * (1 + max(tiers, default=-1)) + (4.0 if tiers else 0.0)
    figure = sheet(WIDTH, _BOTTOM + HEIGHT + top)
    axes = axes_in_points(figure, left, _BOTTOM, WIDTH - left - _RIGHT, HEIGHT)
    _frame(axes, plot, x_span, y_span)
    axes.set_yticks(y_ticks, labels)
    for number, one in enumerate(plot.series):
        x, y = thinned_curve(in_unit(one.x, plot.x.unit), in_unit(one.y, plot.y.unit))
        across, up = (WIDTH - left - _RIGHT) / (x_span[1] - x_span[0]), HEIGHT / (y_span[1] - y_span[0])
        points = thinned_line(across * x + 1j * up * y)
        axes.add_line(Line2D(points.real / across, points.imag / up, zorder=3, **_line(one, number)))
    _draw_marks(axes, plot, tiers)
    _draw_legend(figure, entries)
    return figure


def _padded(low: float, high: float) -> tuple[float, float]:
    """The span with 5 % of air; an end at zero, or near it, is put on zero."""
    air = 0.05 * (high - low)
    if low >= 0 and low < 0.25 * high:
        return 0.0, high + air
    if high <= 0 and high > 0.25 * low:
        return low - air, 0.0
    return low - air, high + air


def _line(series: Series, number: int) -> dict[str, Any]:
    """How a curve is drawn; beyond the palette the line is broken too."""
    rounds = number // len(PALETTE)
    style = DASHES[0] if series.dashed else DASHES[(rounds - 1) % len(DASHES)] if rounds else "-"
    return {"color": colour(number), "linewidth": 1.5, "linestyle": style}


def _frame(axes: Axes, plot: Plot, x_span: tuple[float, float], y_span: tuple[float, float]) -> None:
    axes.set_xlim(*x_span)
    axes.set_ylim(*y_span)
    x_ticks = ticks(*x_span, plot.x.unit, 9)
    axes.set_xticks(x_ticks, tick_labels(x_ticks))
    axes.grid(color=GRID, linewidth=0.6)
    axes.set_axisbelow(True)
    axes.tick_params(length=3, width=0.6, labelsize=SMALL, labelcolor=MUTED, pad=2.5)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    if y_span[0] < 0 < y_span[1]:
        axes.axhline(0.0, color=AXIS, linewidth=0.8, zorder=1.5)
    axes.set_xlabel(with_unit(plot.x.label, plot.x.unit), fontsize=TEXT, labelpad=3)
    axes.figure.text(
        9.0 / WIDTH,
        axes.get_position().y0 + axes.get_position().height / 2,
        with_unit(plot.y.label, plot.y.unit),
        fontsize=TEXT,
        rotation=90,
        ha="center",
        va="center",
    )


def _legend(plot: Plot, left: float) -> list[_Entry]:
    """Entries in rows above the curves; none where the axis says it already."""
    if len(plot.series) == 1 and plot.series[0].label in ("", plot.y.label, plot.title):
        return []
    entries: list[_Entry] = []
    row, place = 0, left
    for number, series in enumerate(plot.series):
        width = _KEY + 4.0 + text_width(series.label, TEXT) + 12.0
        if place > left and place + width > WIDTH:
            row, place = row + 1, left
        entries.append(_Entry(series, number, row, place))
        place += width
    return entries


def _draw_legend(figure: Figure, entries: list[_Entry]) -> None:
    height = float(figure.get_size_inches()[1]) * 72.0
    for entry in entries:
        y = height - 4.0 - _ROW * (entry.row + 0.5)
        across = [entry.left / WIDTH, (entry.left + _KEY) / WIDTH]
        figure.add_artist(Line2D(across, [y / height] * 2, **_line(entry.series, entry.number)))
        figure.text((entry.left + _KEY + 4.0) / WIDTH, y / height, entry.series.label, fontsize=TEXT, va="center")


def _tiers(marks: tuple[Mark, ...], x_span: tuple[float, float], unit: str, width: float) -> list[int]:
    """The height of each mark's label: 0, or higher where it would run into one to its left."""
    places = in_unit(np.array([mark.x for mark in marks], dtype=float), unit)
    centres = (places - x_span[0]) / (x_span[1] - x_span[0]) * width
    tiers = [0] * len(marks)
    ends: list[float] = []
    for index in np.argsort(centres):
        half = text_width(marks[index].label, SMALL) / 2 + 3.0
        tier = next((t for t, end in enumerate(ends) if centres[index] - half >= end), len(ends))
        ends[tier : tier + 1] = [centres[index] + half]
        tiers[index] = tier
    return tiers


def _draw_marks(axes: Axes, plot: Plot, tiers: list[int]) -> None:
    for mark, tier in zip(plot.marks, tiers, strict=True):
        x = mark.x / parse_unit(plot.x.unit).factor
        axes.axvline(x, color=INK, linewidth=0.7, linestyle=(0, (2, 2)), zorder=2)
        axes.annotate(
            mark.label,
            (x, 1.0),
            (0, 3.0 + _TIER * tier),
            xycoords=("data", "axes fraction"),
            textcoords="offset points",
            ha="center",
            fontsize=SMALL,
            color=MUTED,
        )
