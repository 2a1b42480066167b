"""Cyclograms: what every actuator does over one turn of the master shaft.

Tracks lie under one another over a common master angle; a motion is drawn as the curve of its position, a dwell lies
flat. The events of a track are ticks with names above its curve. The lower axis is the angle, the upper one the time.
"""

import numpy as np

from ilmek.report import Lane, Timing
from ilmek.units import deg
from ilmek.viz.flags import Flag, flags
from ilmek.viz.frame import Box, grid, lower_axis, paper, upper_axis
from ilmek.viz.scale import ticks
from ilmek.viz.sheet import Sheet, circle
from ilmek.viz.style import AXIS, INK, MUTED, SMALL, STRONG, colour, text_width, tint
from ilmek.viz.thinning import thinned_curve, thinned_line

WIDTH = 600.0
_RIGHT, _TOP, _BOTTOM = 16.0, 30.0, 30.0
_STROKE, _GAP, _TIER = 26.0, 9.0, 9.5
"""Height of a full stroke, air between tracks, height of a line of event names [pt]."""
_TURN = 360.0


def draw_timing(timing: Timing) -> Sheet:
    """The tracks stacked, the first on top."""
    names = [text_width(lane.name, STRONG, bold=True) for lane in timing.lanes]
    actuators = [text_width(lane.actuator, SMALL) for lane in timing.lanes]
    left = 18.0 + max([40.0, *names, *actuators])
    flown = [_flags(lane, WIDTH - left - _RIGHT) for lane in timing.lanes]
    heights = [_STROKE + _GAP + _TIER * (1 + max((flag.tier for flag in lane), default=-1)) for lane in flown]
    box = Box(left, _BOTTOM, WIDTH - left - _RIGHT, sum(heights) + 2.0)
    sheet = Sheet(WIDTH, box.top + _TOP)
    paper(sheet, box)
    _axes(sheet, box, timing.period)
    ceiling = box.top - 1.0
    for number, (lane, lane_flags, height) in enumerate(zip(timing.lanes, flown, heights, strict=True)):
        ceiling -= height
        floor = complex(left, ceiling + _GAP / 2)
        _motion(sheet, lane, floor, box.width, colour(number))
        _events(sheet, lane, lane_flags, floor)
        _name(sheet, lane, floor + 1j * _STROKE / 2)
        if number + 1 < len(timing.lanes):
            sheet.line(1j * ceiling + np.array([box.left, box.right]), color=AXIS, linewidth=0.4)
    return sheet


def _flags(lane: Lane, width: float) -> list[Flag]:
    places = [event.x / deg / _TURN * width for event in lane.events]
    return flags(places, [text_width(event.label, SMALL) + 7.0 for event in lane.events], width)


def _motion(sheet: Sheet, lane: Lane, floor: complex, width: float, shade: str) -> None:
    """The curve of the position over its baseline, which begins at `floor`."""
    angle, position = thinned_curve(np.asarray(lane.angle, dtype=float), np.asarray(lane.position, dtype=float))
    points = thinned_line(floor + angle / deg / _TURN * width + 1j * _STROKE * position)
    finite = points[np.isfinite(points)]
    if len(finite):
        feet = np.array([finite[-1].real, finite[0].real]) + 1j * floor.imag
        sheet.area(np.concatenate([finite, feet]), facecolor=tint(shade, 0.16), linewidth=0, zorder=0.8)
    sheet.line(floor + np.array([0, width]), color=AXIS, linewidth=0.5, zorder=2.2)
    sheet.line(points, color=shade, linewidth=1.6, zorder=3)


def _events(sheet: Sheet, lane: Lane, lane_flags: list[Flag], floor: complex) -> None:
    """A tick from the baseline to the line of the name, a dot at its foot, the name beside its head."""
    for event, flag in zip(lane.events, lane_flags, strict=True):
        foot = floor + flag.x
        low = foot + 1j * (_STROKE + 1.5 + _TIER * flag.tier)
        sheet.line(np.array([foot, low + 0.75j * _TIER]), color=INK, linewidth=0.7, zorder=3.5)
        sheet.area(circle(foot, 1.4), facecolor=INK, linewidth=0, zorder=4)
        side, shift = ("right", -2.5) if flag.leftward else ("left", 2.5)
        sheet.text(low + shift + 2.2j, event.label, fontsize=SMALL, color=INK, ha=side, va="baseline", zorder=5)


def _name(sheet: Sheet, lane: Lane, middle: complex) -> None:
    """Name of the track and of its actuator, left of the axis."""
    right = {"ha": "right", "va": "center_baseline"}
    shift = 5.2j if lane.actuator else 0j
    sheet.text(middle - 8.0 + shift, lane.name, fontsize=STRONG, weight="bold", **right)
    if lane.actuator:
        sheet.text(middle - 8.0 - 5.6j, lane.actuator, fontsize=SMALL, color=MUTED, **right)


def _axes(sheet: Sheet, box: Box, period: float) -> None:
    """The master angle below with the grid, the time above: seconds, or milliseconds for a quick turn."""
    angles = [30.0 * step for step in range(13)]
    at = [box.left + angle / _TURN * box.width for angle in angles]
    grid(sheet, box, at)
    lower_axis(sheet, box, at, angles, "master angle [°]")
    factor, unit = (1.0, "s") if period >= 0.5 else (1e-3, "ms")
    times = ticks(0.0, period / factor, "", 8)
    upper_axis(sheet, box, [box.left + t * factor / period * box.width for t in times], times, f"time [{unit}]")
    for x in (box.left, box.right):
        sheet.line(x + 1j * np.array([box.low, box.top]), color=AXIS, linewidth=0.7)
