"""A row of a carpet in motion, from the front: heads that tie along the row, then wefts and beats, in time.

Times are those of the rules without faults and stops (`loom.twin.durations`). The operations after the knots move as
the row's cyclogram has them. Height is not to scale: it shows what is tied, and what moves.
"""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, IntArray
from ilmek.loom.operations import LoomSetup, RowOperations
from ilmek.loom.twin.durations import Durations, durations_of
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
    """When each knot of a row is tied, head by head in the order of tying [s], and the end of the knots [s].

    begins, ends  of each knot [s], without stops      last  end of all knots [s]
    """

    begins: FloatArray
    ends: FloatArray
    last: float


def timed_row(row: RowOperations, durations: Durations, tubes: IntArray) -> TimedRow:
    """The knots of a row in time.

    tubes  aligned in each head before the row, (heads,); -1: that of its first knot
    """
    begins, ends = np.zeros(len(row.columns)), np.zeros(len(row.columns))
    starts, phase_begin = row.starts, 0
    at, tube = starts[:-1].copy(), tubes.astype(np.int64)
    for phase in range(row.phases):
        slowest = phase_begin
        for head in range(row.heads):
            clock = phase_begin
            for knot in range(at[head], at[head] + int(row.counts[head, phase])):
                moved = abs(int(row.columns[knot]) - int(row.columns[knot - 1])) if knot > starts[head] else 0
                changed = tube[head] not in (-1, row.tubes[knot])
                begins[knot] = clock / BILLION
                clock += durations.knot + changed * durations.colour_change + durations.travel * max(moved - 1, 0)
                ends[knot], tube[head] = clock / BILLION, row.tubes[knot]
            at[head] += int(row.counts[head, phase])
            slowest = max(slowest, clock)
        phase_begin = slowest
    return TimedRow(begins, ends, phase_begin / BILLION)


def row_in_motion(setup: LoomSetup, row: RowOperations) -> Animation:
    """The row over its time; the tubes of the first knots are aligned before."""
    durations = durations_of(setup.times)
    timed = timed_row(row, durations, np.full(row.heads, -1))
    total = timed.last + durations.row_end / BILLION
    time = np.linspace(0.0, total, FRAMES)
    pitch = 2 * setup.warp_pitch
    wide = setup.columns * pitch
    tied = np.array([int(np.count_nonzero(timed.ends <= now)) for now in time], float)
    strokes = (
        MovingStroke(_knots(row, timed, time, pitch), "yarn", "knots"),
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


def _knots(row: RowOperations, timed: TimedRow, time: FloatArray, pitch: float) -> ComplexArray:
    """Ticks as high as the share of their knots that is tied, (frames, 3 ticks)."""
    columns = len(row.columns)
    ticks = min(columns, MOST_TICKS)
    tick = row.columns.astype(np.int64) * ticks // columns
    sizes = np.bincount(tick, minlength=ticks)
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
