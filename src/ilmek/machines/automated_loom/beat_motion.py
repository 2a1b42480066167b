"""Motion of what beats, in the side view, over the cyclogram of a row."""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.machines.automated_loom.cyclogram import BEATER
from ilmek.machines.beat import BeatPath
from ilmek.timing.cyclogram import Cyclogram

NODES = 40
"""Samples of a stroke of what beats, at least."""


def beat_displacement(beat: BeatPath, row: Cyclogram, angle: FloatArray) -> ComplexArray:
    """Displacement of what beats from its rest [m] at angles of the row [rad]."""
    return np.asarray(beat_tip(beat, row, angle) - beat.tip[0])


def beat_tip(beat: BeatPath, row: Cyclogram, angle: FloatArray) -> ComplexArray:
    """The tip of what beats from the fell [m] at angles of the row [rad]."""
    share = np.zeros(np.shape(angle))
    for start, end in beat_windows(row):
        share += np.where((angle > start) & (angle < end), (angle - start) / (end - start), 0.0)
    return beat(share)


def beat_windows(row: Cyclogram) -> tuple[tuple[float, float], ...]:
    """Angles of the row at which each beat begins and ends [rad]."""
    parts = row.track(BEATER).segments
    return tuple((first.start, last.end) for first, last in zip(parts[::2], parts[1::2], strict=True))


def beat_joints(beat: BeatPath, row: Cyclogram) -> FloatArray:
    """Angles of the row at which the first stroke down and the last stroke up of each beat are sampled [rad].

    Strokes between these, of a beat that travels along the row, run over the same path.
    """
    near = np.flatnonzero(np.abs(beat.tip) <= np.abs(beat.tip).min() + 1e-9)
    down, up = beat.share[: near[0] + 1], beat.share[near[-1] :]
    shares = np.concatenate([one[np.linspace(0, len(one) - 1, NODES).astype(int)] for one in (down, up)])
    return np.concatenate([start + shares * (end - start) for start, end in beat_windows(row)])
