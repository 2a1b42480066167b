"""Machines in motion: a drawing to scale whose bars and joints are moved by a script of the page (`animate.js`).

Fixed parts are drawn as in any drawing. Moving parts are separate SVG elements at the first frame shown; they refer to
positions at every frame, listed in the figure's metadata. Without the script the figure is a drawing.
"""

import dataclasses
from collections.abc import Iterator, Mapping

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.records import record
from ilmek.report import Animation, Stroke
from ilmek.units import parse_unit
from ilmek.viz.cursor import decimals, drive, metadata
from ilmek.viz.drawing import FOOT, WIDTH, dotted, draw_still, extent, look_numbers, names, obstacles, pen_for
from ilmek.viz.font import text_width
from ilmek.viz.labels import LabelRequest
from ilmek.viz.looks import marker_shape
from ilmek.viz.moving_names import named
from ilmek.viz.moving_parts import (
    PITCH,
    MovingBlock,
    MovingCircle,
    MovingLine,
    MovingMarker,
    MovingName,
    MovingPart,
    PointTracks,
    part_svg,
)
from ilmek.viz.sheet import Sheet
from ilmek.viz.strokes import Pen
from ilmek.viz.style import INK, PAPER, STRONG, TEXT, YARN, colour, shown_unit, tint

SECONDS = 5.0
"""Duration of a run on the page [s]."""

_MOVING, _STILL = 0.4, 1e6
"""Cost of moving a name around its point: of a moving point, of a fixed one."""

_ROW, _LEFT = 13.0, 14.0

_MARKER = 2.3
"""Radius of the marker on a bar [pt]."""


PLAIN = {"outline": (INK, 1.6), "yarn": (YARN, 2.0)}
"""Colour and width [pt] of moving lines that have the same colour in every figure."""


@record
class LaidOut:
    """A figure laid out: the sheet with the fixed parts, and the moving parts over them, the lowest first."""

    sheet: Sheet
    parts: tuple[MovingPart, ...]


def laid_out(animation: Animation, looks: Mapping[str, int]) -> LaidOut:
    """The layout of the figure."""
    still, start = animation.still, animation.start
    moving = tuple(
        Stroke(stroke.points[start], stroke.role, stroke.label, stroke.closed) for stroke in animation.strokes
    )
    numbers = look_numbers((*still.strokes, *moving), looks)
    rows = list(_rows(animation))
    foot = FOOT + _ROW * len(rows)
    points = [
        extent(still),
        *(stroke.points.ravel() for stroke in animation.strokes),
        *(dot.at for dot in animation.dots),
    ]
    pen = pen_for(np.concatenate(points), numbers, still.unit, foot)
    draw_still(pen, still)
    _legend(pen, rows, {at for at, one in enumerate(moving, len(still.strokes)) if one.role == "path"})
    bars = _bars(pen, animation)
    unnamed = tuple(
        dataclasses.replace(stroke, label="") if stroke.role == "path" else stroke for stroke in still.strokes
    )
    quiet = dataclasses.replace(still, strokes=unnamed, dots=())
    fixed = obstacles(pen, still)
    boxes = names(pen, quiet, np.concatenate([fixed, *bars]), foot)
    met = [np.concatenate([at, fixed, *(_filled(*box) for box in boxes)]) for at in bars]
    parts = (*_lines(pen, animation), *_dots(pen, animation), *_names(pen, animation, met, foot))
    return LaidOut(pen.sheet, parts)


def draw_animation(animation: Animation, looks: Mapping[str, int]) -> tuple[Sheet, str]:
    """The sheet with the fixed parts, and the SVG of the moving parts, which follows it in the same element."""
    layout = laid_out(animation, looks)
    tracks = PointTracks(layout.sheet.height, animation.start)
    parts = [part_svg(tracks, part) for part in layout.parts]
    return layout.sheet, "\n".join((*parts, _run(animation, tracks)))


def _lines(pen: Pen, animation: Animation) -> Iterator[MovingPart]:
    """Wheels below, then bars as wide pale lines with edges in the full colour, others as plain lines."""
    first = len(animation.still.strokes)
    ordered = sorted(enumerate(animation.strokes, first), key=lambda entry: entry[1].role != "wheel")
    seen: set[str] = set()
    for index, one in ordered:
        points = pen(one.points)
        if one.role in PLAIN:
            yield MovingLine(points, *PLAIN[one.role], one.closed)
            continue
        number = pen.numbers[index]
        shade = colour(number)
        if one.role == "path":
            yield MovingLine(points, shade, 1.6, one.closed)
            continue
        if one.role == "wheel":
            yield MovingLine(points, shade, 1.2, True, tint(shade, 0.1), PITCH)
            continue
        if one.closed:
            yield MovingLine(points, "none", 0.0, True, tint(shade, 0.3))
        yield MovingLine(points, shade, 7.0, one.closed)
        yield MovingLine(points, tint(shade, 0.45), 4.8, one.closed)
        if one.label and one.label not in seen:
            seen.add(one.label)
            yield MovingMarker(_middle(points, closed=one.closed), marker_shape(number, _MARKER), shade)


def _middle(points: ComplexArray, *, closed: bool) -> ComplexArray:
    """The point of a bar that bears its marker: at a third of its first part, or the middle of an area."""
    return np.asarray(points.mean(axis=1) if closed else points[:, 0] + 0.35 * (points[:, 1] - points[:, 0]))


def _dots(pen: Pen, animation: Animation) -> Iterator[MovingPart]:
    """Blocks below the pins; pins of the pivots again, because bars pass over them."""
    for dot in animation.dots:
        if dot.role == "block" and dot.along is not None:
            yield MovingBlock(pen(dot.at), dot.along)
    frames = len(animation.at)
    for pivot in animation.still.dots:
        if pivot.role == "pivot":
            yield MovingCircle(np.full(frames, pen(np.array([pivot.at]))[0]), "pin")
    for dot in animation.dots:
        if dot.role != "block":
            yield MovingCircle(pen(dot.at), dot.role)


def _bars(pen: Pen, animation: Animation) -> list[ComplexArray]:
    """Points along all moving parts at every frame [pt]."""
    ring = 4.0 * np.exp(2j * np.pi * np.arange(8) / 8)
    bars = []
    for frame in range(len(animation.at)):
        lines = [dotted(pen(stroke.points[frame])) for stroke in animation.strokes]
        bars.append(np.concatenate([*lines, *(pen(dot.at)[frame] + ring for dot in animation.dots)]))
    return bars


def _filled(centre: complex, half: complex) -> ComplexArray:
    across, up = np.linspace(-1, 1, 7) * half.real, np.linspace(-1, 1, 3) * half.imag
    return np.asarray((centre + across[:, np.newaxis] + 1j * up).ravel())


def _names(pen: Pen, animation: Animation, met: list[ComplexArray], foot: float) -> Iterator[MovingName]:
    """Names of all dots; those of fixed dots do not move."""
    frames = len(animation.at)
    fixed = [(np.full(frames, dot.at), dot.label, _STILL) for dot in animation.still.dots]
    requests = [
        LabelRequest(pen(at), label, STRONG, 6.0, pull)
        for at, label, pull in (*fixed, *((dot.at, dot.label, _MOVING) for dot in animation.dots))
        if label
    ]
    corner = complex(pen.sheet.width, pen.sheet.height) - (2 + 2j)
    middles = named(requests, met, complex(2, foot), corner, closes=animation.closes)
    for one, middle in zip(requests, middles, strict=True):
        yield MovingName(middle, one.text)


def _rows(animation: Animation) -> Iterator[list[tuple[float, int, str]]]:
    """The legend in rows: left edge [pt], index among all strokes, and name of each coloured line."""
    row: list[tuple[float, int, str]] = []
    left, first, seen = _LEFT, len(animation.still.strokes), {""}
    for index, stroke in enumerate(animation.strokes, first):
        width = 20.0 + text_width(stroke.label, TEXT) + 12.0
        if stroke.role in PLAIN or stroke.label in seen:
            continue
        seen.add(stroke.label)
        if row and left + width > WIDTH:
            yield row
            row, left = [], _LEFT
        row.append((left, index, stroke.label))
        left += width
    if row:
        yield row


def _legend(pen: Pen, rows: list[list[tuple[float, int, str]]], thin: set[int]) -> None:
    """Names beside bars with their markers; beside plain lines for the strokes `thin`."""
    for at, row in enumerate(rows):
        height = FOOT + _ROW * (len(rows) - 1 - at) - 1.0
        for left, index, label in row:
            shade = colour(pen.numbers[index])
            swatch = np.array([left, left + 14.0]) + 1j * height
            pen.sheet.line(swatch, color=shade, linewidth=1.6 if index in thin else 6.0)
            if index not in thin:
                pen.sheet.line(swatch, color=tint(shade, 0.45), linewidth=3.8)
                corners = swatch.mean() + marker_shape(pen.numbers[index], _MARKER)
                pen.sheet.area(corners, facecolor=shade, edgecolor=PAPER, linewidth=0.5, zorder=4)
            pen.sheet.text(complex(left + 21.0, height), label, fontsize=TEXT, color=INK, va="center_baseline")


def _run(animation: Animation, tracks: PointTracks) -> str:
    """The data of the script."""
    factor = parse_unit(animation.drive.unit).factor
    at = animation.at / factor
    step = float(at[1] - at[0])
    frames = len(at)
    readings = [
        {
            "values": [float(f"{value:.4g}") for value in reading.values / parse_unit(reading.unit).factor],
            "decimals": decimals(float(np.ptp(reading.values)) / parse_unit(reading.unit).factor),
            "measure": shown_unit(reading.unit),
        }
        for reading in animation.readings
    ]
    ends = float(at[0]), float(at[0]) + step * (frames if animation.closes else frames - 1)
    run = {
        **drive(animation.drive.label, animation.drive.unit, ends),
        "positions": tracks.positions,
        "frames": frames,
        "closes": int(animation.closes),
        "start": animation.start,
        "seconds": SECONDS,
        "readings": readings,
    }
    return metadata(run)
