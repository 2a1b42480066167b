"""A row of a carpet in motion, from the front: heads that tie along the row, then wefts and beats, in time.

Times are those of the rules without faults and stops (`loom.twin.durations`). The operations after the knots move as
the row's cyclogram has them. Height is not to scale: it shows what is tied, and what moves.
"""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.loom.operations import LoomSetup, RowOperations
from ilmek.loom.twin.durations import Durations, durations_of
from ilmek.loom.twin.phase import PhaseTimes, RowKnots, time_knots
from ilmek.records import record
from ilmek.report import Animation, Axis, Drawing, MovingStroke, Reading, Stroke
from ilmek.timing.cyclogram import Track
from ilmek.timing.track import sample
from ilmek.units import BILLION, turn

FRAMES = 150
MOST_TICKS = 60
"""Largest number of ticks that stand for the knots of a row."""

CARRIERS = ("shuttle", "rapier")
BEATER = "beater"

_HEAD, _TICK, _SHED = 0.08, 0.03, 0.05
"""Heights of heads, of knots and of the open shed, in widths of the row."""


@record
class TimedRow:
    """When each knot of a row is tied, head by head in the order of tying, and the end of all knots [s]."""

    ends: FloatArray
    last: float


def timed_row(row: RowOperations, durations: Durations) -> TimedRow:
    """The knots of a row in time, without stops; the tube of each head's first knot is aligned before."""
    heads, counts = row.heads, np.ascontiguousarray(row.counts, np.int64)
    first = np.ascontiguousarray(row.starts[:-1, None] + np.cumsum(counts, axis=1) - counts)
    by_tube = np.zeros((heads, int(row.tubes.max(initial=0)) + 1), np.int64)
    columns, tubes = np.ascontiguousarray(row.columns, np.int32), np.ascontiguousarray(row.tubes, np.uint8)
    knots = RowKnots(columns, tubes, first, counts, by_tube)
    states = np.full((heads, 2), -1, np.int64)
    base, yarn, changes, idle = np.zeros((4, heads), np.int64)
    times = PhaseTimes(np.zeros(len(columns), np.int64), base, yarn, changes, idle, by_tube.copy())
    ends, begin = np.zeros(len(columns), np.int64), 0
    for phase in range(row.phases):
        time_knots(knots, phase, (durations.knot, durations.colour_change, durations.travel), states, times)
        for head in range(heads):
            tied = slice(first[head, phase], first[head, phase] + counts[head, phase])
            ends[tied] = begin + np.cumsum(times.lasts[tied])
        begin += int(times.base.max())
    return TimedRow(ends / BILLION, begin / BILLION)


def row_in_motion(setup: LoomSetup, row: RowOperations) -> Animation:
    """The row over its time; the tubes of the first knots are aligned before."""
    durations = durations_of(setup.times)
    timed = timed_row(row, durations)
    total = timed.last + durations.row_end / BILLION
    time = np.linspace(0.0, total, FRAMES)
    pitch = 2 * setup.warp_pitch
    wide = setup.columns * pitch
    tied = np.array([int(np.count_nonzero(timed.ends <= now)) for now in time], float)
    strokes = (
        MovingStroke(_knots(row, timed, time, setup), "yarn", "knots"),
        *(
            MovingStroke(_head(head, row, timed, time, setup), "path", "heads", closed=True)
            for head in range(row.heads)
        ),
        *_row_end(setup, timed, time, wide),
    )
    still = Drawing(
        f"row-{row.number + 1}-moving",
        f"Row {row.number + 1} in motion",
        (
            Stroke(np.array([0j, wide + 0j]), "outline", "fell"),
            Stroke(wide * np.array([0, 1, 1 - 0.06j, -0.06j]), "yarn", closed=True, filled=True),
        ),
        note="from the front, without faults and stops; heights are not to scale, a tick stands for neighbouring knots",
    )
    axis = Axis("time of the row", "s")
    return Animation(still, axis, time, strokes, (), period=total, readings=(Reading("knots", tied),))


def _knots(row: RowOperations, timed: TimedRow, time: FloatArray, setup: LoomSetup) -> ComplexArray:
    """Ticks as high as the share of their knots that is tied, (frames, 3 ticks)."""
    columns, pitch = setup.columns, 2 * setup.warp_pitch
    ticks = min(columns, MOST_TICKS)
    tick = row.columns.astype(np.int64) * ticks // columns
    sizes = np.maximum(np.bincount(tick, minlength=ticks), 1)
    shares = np.stack([np.bincount(tick[timed.ends <= now], minlength=ticks) / sizes for now in time])
    foot = (np.arange(ticks) + 0.5) / ticks * columns * pitch
    top = foot + 1j * _TICK * columns * pitch * shares
    feet = np.broadcast_to(foot, top.shape)
    return np.stack([feet, top, feet], axis=-1).reshape(len(time), -1)


def _head(head: int, row: RowOperations, timed: TimedRow, time: FloatArray, setup: LoomSetup) -> ComplexArray:
    """A head as a box over the knot that it ties; it moves between two knots, and up when all are tied."""
    first, last = row.starts[head : head + 2]
    pitch = 2 * setup.warp_pitch
    wide = setup.columns * pitch
    if first == last:
        at = np.full(len(time), (head + 0.5) * wide / row.heads)
    else:
        ends, columns = timed.ends[first:last], (row.columns[first:last] + 0.5) * pitch
        at = np.interp(time, ends, columns)
    up = np.where(time > timed.last, _SHED, 0.0) * wide
    half = min(0.45 * setup.spacing * pitch, 0.5 * wide)
    box = np.array([-half, half, half + 1j * _HEAD * wide, -half + 1j * _HEAD * wide])
    return np.asarray((at + 1j * (up + 1.5 * _TICK * wide))[:, None] + box)


def _row_end(setup: LoomSetup, timed: TimedRow, time: FloatArray, wide: float) -> tuple[MovingStroke, ...]:
    """Weft with its carrier, and beater, by the row's cyclogram; nothing without one."""
    tracks = {track.name: track for cyclogram in setup.cyclograms[1:] for track in cyclogram.tracks}
    carrier = next((tracks[name] for name in CARRIERS if name in tracks), None)
    if carrier is None or BEATER not in tracks:
        return ()
    whole = setup.times.row_ends[-1]
    angle = np.clip((time - timed.last) / whole, 0.0, 1.0) * turn
    across = _share(carrier, angle) * wide
    away = 1 - _share(tracks[BEATER], angle)
    high = 1j * _TICK * wide / 2
    ends = np.stack([np.where(across < wide, 0.0, across), across], -1) + high
    reach = 0.02 * wide * np.array([-1, 1])
    beat = 1j * (_TICK + (_SHED + _HEAD) * away[:, None]) * wide + wide * np.array([0.0, 1.0])
    return (
        MovingStroke(ends, "outline", "weft"),
        MovingStroke(across[:, None] + reach + high, "link", "carrier of the weft"),
        MovingStroke(beat, "path", "comb"),
    )


def _share(track: Track, angle: FloatArray) -> FloatArray:
    """Position of a track over its stroke at master angles [rad]: 0 to 1."""
    position = sample(track, angle).position
    low = min(float(part.begin) for part in track.segments)
    return np.asarray((position - low) / track.stroke)
