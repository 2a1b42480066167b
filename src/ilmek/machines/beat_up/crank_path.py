"""Motion of a beater on a crank-rocker over a beat: its laws on the cyclogram, and its path in the side view."""

from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.laws import Law, law_of
from ilmek.machines.beat import Beat, BeatPath
from ilmek.machines.beat_up.crank_start import CrankStart
from ilmek.units import turn

_POINTS = np.linspace(0.0, 1.0, 18)[1:-1]
"""Shares of a motion at which the law on the cyclogram is the true one."""

_SAMPLES = 181
_ACTUATOR = "beat-up crank"


def crank_beat(start: CrankStart, slide: float = 0.0) -> Beat:
    """The beat in time of a crank with its start and stop; slide: run of its slide across the carpet [m]."""
    linkage, duty = start.duty.linkage, start.duty
    there, back = _times(start)
    travel, time = start.travel, start.time
    begin, end = travel[0], time[-1]
    forward = 1 - np.interp(_POINTS * there, time, travel) / begin
    backward = np.interp(there + _POINTS * (end - there), time, travel) / begin
    total = start.beat_time
    return Beat(
        stroke=float(begin),
        time=total,
        forward=there / total,
        pressed=(total - there - back) / total,
        law=_spline(tuple(forward.tolist())),
        back_law=_spline(tuple(backward.tolist())),
        actuator=_ACTUATOR if linkage.params.speed else "",
        strokes=duty.strokes * duty.starts,
        slide=slide,
    )


@lru_cache(maxsize=64)
def _spline(values: tuple[float, ...]) -> Law:
    """The law through the true positions at `_POINTS`, at rest at its ends."""
    return law_of("spline", {"u": tuple(_POINTS.tolist()), "s": values, "degree": 5.0})


def _times(start: CrankStart) -> tuple[float, float]:
    """Time from rest to the beat, and from the last beat to rest [s]: (D + r D) / W of the rotations D."""
    linkage, share = start.duty.linkage, 1 + start.params.run_up
    speed, back = linkage.params.speed, linkage.crank_rotation
    return (turn - back) * share / speed, back * share / speed


def crank_path(start: CrankStart, outline: tuple[ComplexArray, ...]) -> BeatPath:
    """Path of the beater: it leaves the fell upwards and to the front, about a pivot in front of the fell.

    Of several strokes the first and the last are kept, each stretched to half of the beat.
    """
    arm = start.duty.linkage.lengths["beater"]
    share = np.linspace(0.0, 1.0, _SAMPLES)
    there, _ = _times(start)
    middle = there / start.time[-1]
    shares: FloatArray = start.time / start.time[-1]
    single = np.interp(share, shares, start.travel)
    if start.duty.strokes * start.duty.starts > 1:
        share = np.where(share <= middle, share / middle / 2, 0.5 + (share - middle) / (1 - middle) / 2)
    swing = single / arm
    return BeatPath(outline, share, arm * (1 - np.cos(swing) + 1j * np.sin(swing)))
