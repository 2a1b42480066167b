"""A row in motion from the front and from above: wefts, beats and the heads' retreat, over the angle of the row.

Across the loom 0 is the cloth's left edge. From the front y is the height above the fell; from above y is the distance
behind the warps' plane, so that the weaver stands below the picture.
"""

import numpy as np

from ilmek.arrays import Complex, ComplexArray, FloatArray
from ilmek.machines.arrangement.side_view import RETREAT
from ilmek.machines.automated_loom.bodies import beat_tip
from ilmek.machines.automated_loom.cyclogram import BEATER, EVEN, HEADS, ODD, SLIDE, TAKE_UP, weft_windows
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.weft import Shuttle
from ilmek.report import Animation, Axis, Dot, Drawing, MovingStroke, Reading, Stroke
from ilmek.timing.track import sample
from ilmek.units import turn

FRAMES = 120
DRIVE = Axis("angle of the row", "deg")

_LINES = 24
"""Warps drawn; a real loom has more."""

_CLOTH = 0.12
"""Height of the cloth below the fell that is drawn, in widths of the cloth."""


def row_from_the_front(loom: LoomDesign) -> Animation:
    """Carrier, weft and comb before the warps. The heads, which stand in front of them, are not drawn."""
    angle, wide, side = _angles(), loom.task.cloth_width, loom.side
    height = (side.carrier.corner + side.carrier.size / 2).imag
    top = 1.3 * max(float(side.cams[0].at.imag), height)
    carrier = _carrier(loom, angle)
    half = side.carrier.size.imag / 2
    comb = _comb(loom, angle)
    warps = (Stroke(np.array([x, x + 1j * top]), "construction") for x in np.linspace(0, wide, _LINES))
    still = Drawing(
        "loom-row-front",
        "A row from the front",
        (
            Stroke(
                np.array([0, wide, wide - 1j * _CLOTH * wide, -1j * _CLOTH * wide]), "yarn", closed=True, filled=True
            ),
            *warps,
        ),
        (Dot(0j, "fell", "point"),),
        note=f"{_LINES} of {loom.warps} warps are drawn, and no heads, which stand in front",
    )
    strokes = (
        MovingStroke(comb, "path", "comb", closed=True),
        MovingStroke(_weft(loom, angle, carrier, height), "outline", "weft"),
        MovingStroke(_boxes(carrier, 1j * height, half), "path", "carrier", closed=True),
    )
    readings = (*_readings(loom, angle, (loom.row_timing.carrier, BEATER, TAKE_UP)),)
    return Animation(still, DRIVE, angle, strokes, (), period=loom.row_cyclogram.period, readings=readings)


def row_from_above(loom: LoomDesign) -> Animation:
    """Both sheets of warps at the height of the carrier, carrier, comb, heads and rail from above."""
    angle, side, row = _angles(), loom.side, loom.row_cyclogram
    wide = loom.task.cloth_width
    height = (side.carrier.corner + side.carrier.size / 2).imag
    share = height / float(side.cams[0].at.imag)
    ends = np.array([0.0, wide])
    sheets = [ends - 1j * share * sample(row.track(name), angle).position[:, None] for name in (EVEN, ODD)]
    carrier, depth = _carrier(loom, angle), side.carrier
    middle = (depth.corner + depth.size / 2).real
    away = sample(row.track(HEADS), angle).position * RETREAT.real
    depths = _comb_corners(loom, angle).real
    near, far = depths.min(axis=1), depths.max(axis=1)
    comb = np.array([0, wide, wide, 0]) - 1j * np.stack([near, near, far, far], axis=-1)
    heads = [_box(x, side.head.body.real, loom.head_width, side.head.size.real) for x in _parked(loom)]
    rail = _box(0.0, side.rail.corner.real, wide, side.rail.size.real)
    strokes = (
        *(MovingStroke(line, "path", name) for line, name in zip(sheets, (EVEN, ODD), strict=True)),
        MovingStroke(comb, "path", "comb", closed=True),
        MovingStroke(_boxes(carrier, -1j * middle, depth.size.real / 2), "path", "carrier", closed=True),
        *(MovingStroke(one - 1j * away[:, None], "path", "heads", closed=True) for one in heads),
        MovingStroke(rail - 1j * away[:, None], "outline", closed=True),
    )
    still = Drawing(
        "loom-row-above",
        "A row from above",
        (Stroke(ends + 0j, "yarn", "fell"),),
        note="the sheets of warps at the height of the carrier; the weaver stands below the picture",
    )
    readings = _readings(loom, angle, (EVEN, ODD, HEADS))
    return Animation(still, DRIVE, angle, strokes, (), period=row.period, readings=readings)


def _angles() -> FloatArray:
    return np.arange(FRAMES) * (turn / FRAMES)


def _readings(loom: LoomDesign, angle: FloatArray, names: tuple[str, ...]) -> tuple[Reading, ...]:
    tracks = [loom.row_cyclogram.track(name) for name in names]
    return tuple(Reading(one.name, sample(one, angle).position, one.unit) for one in tracks)


def _carrier(loom: LoomDesign, angle: FloatArray) -> FloatArray:
    """Both ends of the carrier across the loom [m], (frames, 2).

    A shuttle rests at either edge, as far outside the cloth as its stroke is longer; of a rapier that comes from the
    left the tip rests before the cloth.
    """
    at = sample(loom.row_cyclogram.track(loom.row_timing.carrier), angle).position
    passage, made = loom.weft.passage, loom.weft.carried
    if isinstance(made, Shuttle):
        middle = at - (passage.stroke - loom.task.cloth_width) / 2
        return np.asarray(middle[:, None] + made.length * np.array([-0.5, 0.5]))
    tip = at - passage.run
    return np.stack([np.full_like(tip, -passage.run - made.length), tip], -1)


def _weft(loom: LoomDesign, angle: FloatArray, carrier: FloatArray, height: float) -> ComplexArray:
    """The weft from the edge at which the carrier started to the carrier; beaten to the fell with the beat."""
    wide, row = loom.task.cloth_width, loom.row_cyclogram
    ends = np.clip(carrier.mean(axis=1), 0.0, wide)
    beats = [part.end for part in row.track(BEATER).segments[::2]]
    lines = np.zeros((len(angle), 2), complex)
    for (start, _), beaten, edge in zip(weft_windows(row), beats, _edges(loom), strict=True):
        laid = angle >= start
        down = laid & (angle >= beaten)
        lines[laid, 0], lines[laid, 1] = edge + 1j * height, ends[laid] + 1j * height
        lines[down, 0], lines[down, 1] = 0.0, wide
    return lines


def _edges(loom: LoomDesign) -> tuple[float, float]:
    """Edges of the cloth at which the two wefts start [m]: a rapier inserts both from the left."""
    return (0.0, loom.task.cloth_width) if isinstance(loom.weft.carried, Shuttle) else (0.0, 0.0)


def _comb(loom: LoomDesign, angle: FloatArray) -> ComplexArray:
    """The comb from the front: its width, its height; one that travels across is as much narrower as its slide runs."""
    heights = _comb_corners(loom, angle).imag
    low, high = heights.min(axis=1), heights.max(axis=1)
    wide, run = loom.task.cloth_width, np.zeros(len(angle))
    slide = next((track for track in loom.row_cyclogram.tracks if track.name == SLIDE), None)
    if slide is not None:
        run = sample(slide, angle).position
        wide = max(wide - float(slide.stroke), 0.02 * wide)
    left, right = run, run + wide
    return np.stack([left + 1j * low, right + 1j * low, right + 1j * high, left + 1j * high], axis=-1)


def _comb_corners(loom: LoomDesign, angle: FloatArray) -> Complex[np.ndarray, "frames corners"]:
    """Corners of the comb in the side view [m]."""
    path = loom.beat.path
    tip = beat_tip(path, loom.row_cyclogram, angle)
    return np.concatenate([path.carried(polygon, tip) for polygon in path.outline], axis=1)


def _boxes(ends: FloatArray, middle: complex, half: float) -> ComplexArray:
    """Rectangles between two ends [m], (frames, 2), about a middle line."""
    low, high = ends[:, 0], ends[:, 1]
    return np.asarray(np.stack([low - 1j * half, high - 1j * half, high + 1j * half, low + 1j * half], -1) + middle)


def _box(x: float, depth: float, wide: float, deep: float) -> ComplexArray:
    """A rectangle from above: from x on [m], and from a depth towards the weaver."""
    return np.asarray(np.array([x, x + wide, x + wide, x]) - 1j * (depth + deep * np.array([0, 0, 1, 1])))


def _parked(loom: LoomDesign) -> FloatArray:
    """Left edges of the heads, each in the middle of its share of the row [m]."""
    share = loom.task.cloth_width / loom.heads
    return np.asarray((np.arange(loom.heads) + 0.5) * share - loom.head_width / 2)
