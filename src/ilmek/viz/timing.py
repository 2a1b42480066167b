"""Cyclograms: the motion of every actuator over one turn of the master shaft.

Tracks are stacked over a common master angle. A motion is drawn as the curve of its position, with its name and law
below; a dwell is flat. Events are ticks with names above the curve. Intervals in a zone that another track needs are
shaded; arrows show the required order of events. The lower axis is the angle, the upper one the time.
"""

import numpy as np

from ilmek.records import JsonObject
from ilmek.report import Lane, Move, Shade, Timing
from ilmek.units import deg
from ilmek.viz.flags import Flag, flags
from ilmek.viz.font import text_width
from ilmek.viz.frame import Box, grid, lower_axis, paper, upper_axis
from ilmek.viz.scale import ticks
from ilmek.viz.sheet import Sheet, circle
from ilmek.viz.style import AXIS, INK, MUTED, SMALL, STRONG, colour, tint
from ilmek.viz.thinning import thinned_curve, thinned_line

WIDTH = 600.0
_RIGHT, _TOP, _BOTTOM = 16.0, 30.0, 30.0
_STROKE, _GAP, _TIER, _LAW = 26.0, 9.0, 9.5, 8.0
"""Height of a full stroke, gap between tracks, height of a line of event names, and of one of laws [pt]."""
_FINE = 6.4
"""Size of the names of motions and laws [pt]."""
_BAD, _SHADE = "#c0392b", "#8a94a0"
_TURN = 360.0


def draw_timing(timing: Timing) -> Sheet:
    """The sheet with the stacked tracks, the first on top."""
    names = [text_width(lane.name, STRONG, bold=True) for lane in timing.lanes]
    actuators = [text_width(lane.actuator, SMALL) for lane in timing.lanes]
    actuators += [text_width(_shared_law(lane), _FINE) for lane in timing.lanes]
    left = 18.0 + max([40.0, *names, *actuators])
    flown = [_flags(lane, WIDTH - left - _RIGHT) for lane in timing.lanes]
    heights = [_height(lane, lane_flags) for lane, lane_flags in zip(timing.lanes, flown, strict=True)]
    box = Box(left, _BOTTOM, WIDTH - left - _RIGHT, sum(heights) + 2.0)
    sheet = Sheet(WIDTH, box.top + _TOP)
    paper(sheet, box)
    _axes(sheet, box, timing)
    ceiling, floors = box.top - 1.0, []
    for lane, lane_flags, height in zip(timing.lanes, flown, heights, strict=True):
        ceiling -= height
        floor = complex(left, ceiling + _GAP / 2 + (_LAW if lane.moves else 0.0))
        floors.append(floor)
        for shade in lane.shades:
            _shade(sheet, lane, shade, floor, box.width)
        _motion(sheet, lane, floor, box.width, colour(lane.look))
        _events(sheet, lane, lane_flags, floor)
        _name(sheet, lane, floor + 1j * _STROKE / 2)
        if lane is not timing.lanes[-1]:
            sheet.line(1j * ceiling + np.array([box.left, box.right]), color=AXIS, linewidth=0.4)
    _links(sheet, timing, floors, box.width)
    return sheet


def _height(lane: Lane, lane_flags: list[Flag]) -> float:
    tiers = 1 + max((flag.tier for flag in lane_flags), default=-1)
    return _STROKE + _GAP + _TIER * tiers + (_LAW if lane.moves else 0.0)


def _flags(lane: Lane, width: float) -> list[Flag]:
    ticks_at = [event.x / deg / _TURN * width for event in lane.events]
    return flags(ticks_at, [text_width(event.label, SMALL) + 7.0 for event in lane.events], width)


def _motion(sheet: Sheet, lane: Lane, floor: complex, width: float, shade: str) -> None:
    """Draw the position over its baseline, which begins at `floor` [pt]."""
    angle, position = thinned_curve(np.asarray(lane.angle, dtype=float), np.asarray(lane.position, dtype=float))
    points = thinned_line(floor + angle / deg / _TURN * width + 1j * _STROKE * position)
    finite = points[np.isfinite(points)]
    sheet.line(floor + np.array([0, width]), color=AXIS, linewidth=0.5, zorder=2.2)
    if len(finite):
        feet = np.array([finite[-1].real, finite[0].real]) + 1j * floor.imag
        sheet.area(np.concatenate([finite, feet]), facecolor=tint(shade, 0.16), linewidth=0, zorder=0.8)
    sheet.line(points, color=shade, linewidth=1.6, zorder=3)
    for move in lane.moves:
        _law(sheet, move, floor, width, shared=bool(_shared_law(lane)))


def _shared_law(lane: Lane) -> str:
    """The law of all motions of a lane; "" if there are several."""
    laws = {move.law for move in lane.moves}
    return laws.pop() if len(laws) == 1 else ""


def _law(sheet: Sheet, move: Move, floor: complex, width: float, *, shared: bool) -> None:
    """Write name and law of a motion below its part of the baseline, as far as they fit; a shared law is written beside
    the lane.
    """
    room = (min(move.end, _TURN * deg) - max(move.start, 0.0)) / deg / _TURN * width
    middle = (min(move.end, _TURN * deg) + max(move.start, 0.0)) / 2 / deg / _TURN * width
    texts = (move.name,) if shared else (f"{move.name} · {move.law}", move.name)
    fits = next((words for words in texts if text_width(words, _FINE) <= room + 2.0), None)
    if fits:
        sheet.text(floor + middle - 1.8j, fits, fontsize=_FINE, color=MUTED, ha="center", va="top", zorder=5)


def _shade(sheet: Sheet, lane: Lane, shade: Shade, floor: complex, width: float) -> None:
    """Draw a window behind the curve, in two parts if it crosses the end of the turn, with its name at the bottom."""
    ends = np.array([shade.start, shade.end]) / deg
    spans = [(ends[0], min(ends[1], _TURN))] + ([(0.0, ends[1] - _TURN)] if ends[1] > _TURN else [])
    look = (_BAD, 0.42) if shade.bad else (_SHADE, 0.22)
    for start, end in spans:
        corners = np.array([start, end, end, start]) / _TURN * width + 1j * _STROKE * np.array([0, 0, 1, 1])
        sheet.area(floor + corners, facecolor=tint(*look), linewidth=0, zorder=0.85 if shade.bad else 0.7)
    if shade.label and not shade.bad:
        start, end = (at / _TURN * width for at in max(spans, key=lambda span: span[1] - span[0]))
        half = text_width(shade.label, _FINE) / 2 + 1.0
        ticks = [event.x / deg / _TURN * width for event in lane.events]
        middles = [start + share * (end - start) for share in (0.5, 0.35, 0.65, 0.25, 0.75)]
        clear = [at for at in middles if all(abs(at - tick) > half for tick in ticks)]
        if 2 * half <= end - start + 6.0:
            sheet.text(
                floor + (clear or middles)[0] + 2.5j,
                shade.label,
                fontsize=_FINE,
                color=INK,
                ha="center",
                va="baseline",
                zorder=1.4,
            )


def _links(sheet: Sheet, timing: Timing, floors: list[complex], width: float) -> None:
    """Draw an arrow from each instant to the one that must come after it; red if that does not hold."""
    for link in timing.links:
        ends = [floors[lane] + angle / deg / _TURN * width for lane, angle in (link.first, link.then)]
        up = np.sign(ends[1].imag - ends[0].imag)
        lift = (_STROKE * 0.5, _STROKE * 0.5) if up == 0 else (_STROKE * max(up, 0.0), _STROKE * max(-up, 0.0))
        start, end = ends[0] + 1j * lift[0], ends[1] + 1j * lift[1]
        if abs(end - start) < 4.0:
            continue
        shade, ahead = (MUTED if link.ok else _BAD), (end - start) / abs(end - start)
        sheet.line(np.array([start, end - 3.0 * ahead]), color=shade, linewidth=0.8, dashes=(3, 2), zorder=3.2)
        head = end + ahead * np.array([0, -4.6 + 1.9j, -4.6 - 1.9j])
        sheet.area(head, facecolor=shade, linewidth=0, zorder=3.3)


def _events(sheet: Sheet, lane: Lane, lane_flags: list[Flag], floor: complex) -> None:
    """Draw a tick from the baseline to the tier of the name, a dot at its bottom, the name beside its top."""
    for event, flag in zip(lane.events, lane_flags, strict=True):
        foot = floor + flag.x
        low = foot + 1j * (_STROKE + 1.5 + _TIER * flag.tier)
        sheet.line(np.array([foot, low + 0.75j * _TIER]), color=INK, linewidth=0.7, zorder=3.5)
        sheet.area(circle(foot, 1.4), facecolor=INK, linewidth=0, zorder=4)
        side, shift = ("right", -2.5) if flag.leftward else ("left", 2.5)
        sheet.text(low + shift + 2.2j, event.label, fontsize=SMALL, color=INK, ha=side, va="baseline", zorder=5)


def _name(sheet: Sheet, lane: Lane, middle: complex) -> None:
    """Write the names of track and actuator, and a law that all motions share, left of the axis."""
    right: JsonObject = {"ha": "right", "va": "center_baseline"}
    shift = 5.2j if lane.actuator else 0j
    sheet.text(middle - 8.0 + shift, lane.name, fontsize=STRONG, bold=True, **right)
    if lane.actuator:
        sheet.text(middle - 8.0 - 5.6j, lane.actuator, fontsize=SMALL, color=MUTED, **right)
    if _shared_law(lane):
        sheet.text(
            middle - 8.0 - (14.6j if lane.actuator else 8j), _shared_law(lane), fontsize=_FINE, color=MUTED, **right
        )


def _axes(sheet: Sheet, box: Box, timing: Timing) -> None:
    """Draw the angle below with the grid, the time above in seconds, or in milliseconds for a fast turn."""
    angles = [30.0 * step for step in range(13)]
    at = [box.left + angle / _TURN * box.width for angle in angles]
    grid(sheet, box, at)
    lower_axis(sheet, box, at, angles, f"{timing.drive.label} [°]")
    period = timing.period
    factor, unit = (1.0, "s") if period >= 0.5 else (1e-3, "ms")
    times = ticks(0.0, period / factor, "", 8)
    upper_axis(sheet, box, [box.left + t * factor / period * box.width for t in times], times, f"time [{unit}]")
    for x in (box.left, box.right):
        sheet.line(x + 1j * np.array([box.low, box.top]), color=AXIS, linewidth=0.7)
