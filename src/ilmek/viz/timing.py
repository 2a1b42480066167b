"""Cyclograms: what every actuator does over one turn of the master shaft.

Tracks lie under one another over a common master angle; a motion is drawn as the curve of its position, a dwell lies
flat. The events of a track are ticks with names above its curve. The lower axis is the angle, the upper one the time.
"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ilmek.report import Lane, Timing
from ilmek.units import deg
from ilmek.viz.flags import Flag, flags
from ilmek.viz.ink import axes_in_points, sheet
from ilmek.viz.scale import tick_labels, ticks
from ilmek.viz.style import AXIS, GRID, INK, MUTED, SMALL, STRONG, TEXT, colour, text_width, tint
from ilmek.viz.thinning import thinned_curve, thinned_line

WIDTH = 600.0
_RIGHT, _TOP, _BOTTOM = 16.0, 30.0, 30.0
_STROKE, _GAP, _TIER = 26.0, 9.0, 9.5
"""Height of a full stroke, air between tracks, height of a line of event names [pt]."""
_TURN = 360.0


def draw_timing(timing: Timing) -> Figure:
    """The tracks stacked, the first on top."""
    names = [text_width(lane.name, STRONG, bold=True) for lane in timing.lanes]
    actuators = [text_width(lane.actuator, SMALL) for lane in timing.lanes]
    left = 18.0 + max([40.0, *names, *actuators])
    width = WIDTH - left - _RIGHT
    flown = [_flags(lane, width) for lane in timing.lanes]
    heights = [_STROKE + _GAP + _TIER * (1 + max((flag.tier for flag in lane), default=-1)) for lane in flown]
    body = sum(heights) + 2.0
    figure = sheet(WIDTH, _BOTTOM + body + _TOP)
    axes = axes_in_points(figure, left, _BOTTOM, width, body)
    axes.set_xlim(0.0, width)
    axes.set_ylim(0.0, body)
    ceiling = body - 1.0
    for number, (lane, lane_flags, height) in enumerate(zip(timing.lanes, flown, heights, strict=True)):
        ceiling -= height
        floor = ceiling + _GAP / 2
        _motion(axes, lane, floor, width, colour(number))
        _events(axes, lane, lane_flags, floor)
        _name(axes, lane, floor + _STROKE / 2)
        if number + 1 < len(timing.lanes):
            axes.axhline(ceiling, color=AXIS, linewidth=0.4)
    _angle_axis(axes, width)
    _time_axis(axes, timing.period)
    return figure


def _flags(lane: Lane, width: float) -> list[Flag]:
    places = [event.x / deg / _TURN * width for event in lane.events]
    return flags(places, [text_width(event.label, SMALL) + 7.0 for event in lane.events], width)


def _motion(axes: Axes, lane: Lane, floor: float, width: float, shade: str) -> None:
    """The curve of the position over its baseline [pt]."""
    angle, position = thinned_curve(np.asarray(lane.angle, dtype=float), np.asarray(lane.position, dtype=float))
    points = thinned_line(angle / deg / _TURN * width + 1j * (floor + _STROKE * position))
    axes.fill_between(points.real, floor, points.imag, color=tint(shade, 0.16), linewidth=0, zorder=2)
    axes.plot([0.0, width], [floor, floor], color=AXIS, linewidth=0.5, zorder=2.2)
    axes.plot(points.real, points.imag, color=shade, linewidth=1.6, zorder=3)


def _events(axes: Axes, lane: Lane, lane_flags: list[Flag], floor: float) -> None:
    """A tick from the baseline to the line of the name, a dot at its foot, the name beside its head."""
    for event, flag in zip(lane.events, lane_flags, strict=True):
        low = floor + _STROKE + 1.5 + _TIER * flag.tier
        axes.plot([flag.x, flag.x], [floor, low + 0.75 * _TIER], color=INK, linewidth=0.7, zorder=3.5)
        axes.plot([flag.x], [floor], marker="o", markersize=2.6, color=INK, zorder=4)
        side, shift = ("right", -2.5) if flag.leftward else ("left", 2.5)
        axes.text(flag.x + shift, low + 0.4, event.label, fontsize=SMALL, color=INK, ha=side, va="bottom", zorder=5)


def _name(axes: Axes, lane: Lane, middle: float) -> None:
    """Name of the track and of its actuator, left of the axis."""
    shift = 5.2 if lane.actuator else 0.0
    axes.text(-8.0, middle + shift, lane.name, ha="right", va="center", fontsize=STRONG, weight="bold")
    if lane.actuator:
        axes.text(-8.0, middle - 5.4, lane.actuator, ha="right", va="center", fontsize=SMALL, color=MUTED)


def _angle_axis(axes: Axes, width: float) -> None:
    places = [30.0 * step for step in range(13)]
    axes.set_xticks([place / _TURN * width for place in places], tick_labels(places))
    axes.set_yticks([])
    axes.grid(axis="x", color=GRID, linewidth=0.6)
    axes.set_axisbelow(True)
    axes.tick_params(length=3, width=0.6, labelsize=SMALL, labelcolor=MUTED, pad=2.5)
    axes.set_xlabel("master angle [°]", fontsize=TEXT, labelpad=3)


def _time_axis(axes: Axes, period: float) -> None:
    """The upper axis: seconds, or milliseconds for a quick turn."""
    factor, unit = (1.0, "s") if period >= 0.5 else (1e-3, "ms")
    upper = axes.twiny()
    upper.set_xlim(0.0, period / factor)
    places = ticks(0.0, period / factor, "", 8)
    upper.set_xticks(places, tick_labels(places))
    upper.tick_params(length=3, width=0.6, labelsize=SMALL, labelcolor=MUTED, pad=2)
    upper.set_xlabel(f"time [{unit}]", fontsize=TEXT, labelpad=3)
    for side in ("left", "right", "bottom"):
        upper.spines[side].set_visible(False)
