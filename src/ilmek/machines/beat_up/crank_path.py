"""Motion of a beater on a crank-rocker over a beat: its laws on the cyclogram, and its path in the side view."""

from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.laws import Law, law_of
from ilmek.linkage.solve import solve
from ilmek.machines.beat import Beat, BeatPath
from ilmek.machines.beat_up.crank_start import CrankStart
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.travel import BeaterTravel
from ilmek.units import turn

_POINTS = np.linspace(0.0, 1.0, 26)[1:-1]
"""Shares of a motion at which the law on the cyclogram is the true one."""

_TURN_SAMPLES = 41
_ACTUATOR = "beat-up crank"


def crank_beat(start: CrankStart, across: BeaterTravel | None = None) -> Beat:
    """The beat in time of a crank with its start and stop; across: its travel along the carpet."""
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
        slide=across.slide_run if across else 0.0,
        park=across.params.park if across else 0.0,
        park_time=across.parking if across else 0.0,
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


def rocker_outline(linkage: BeatUp) -> ComplexArray:
    """The rocker at the beat in the side view, from the beater's bar to beyond its pivot: corners [m]."""
    eye, arm = linkage.params.width / 2, linkage.lengths["beater"]
    end = arm - max(linkage.lengths["rocker"], arm - linkage.params.before_beater) - eye
    return np.array([complex(end, -eye), complex(arm + eye, -eye), complex(arm + eye, eye), complex(end, eye)])


def crank_path(start: CrankStart, outline: tuple[ComplexArray, ...]) -> BeatPath:
    """Path of the beater: it leaves the fell upwards and to the front, about a pivot in front of the fell."""
    arm, total = start.duty.linkage.lengths["beater"], start.beat_time
    there, back = _times(start)
    time, travel = start.time, start.travel
    first, last = time <= there, time >= there
    between_time, between = _between(start)
    cycle = between_time[-1] if between_time.size else 0.0
    number = start.duty.strokes * start.duty.starts - 1
    times = [time[first], np.array([there])]
    travels = [travel[first], np.zeros(1)]
    for one in range(number):
        times.append(there + one * cycle + between_time)
        travels.append(between)
    times.append(time[last] - there + total - back)
    travels.append(travel[last])
    swing = np.concatenate(travels) / arm
    share: FloatArray = np.concatenate(times) / total
    return BeatPath(outline, share, arm * (1 - np.cos(swing) + 1j * np.sin(swing)), pivot=arm)


def _between(start: CrankStart) -> tuple[FloatArray, FloatArray]:
    """Time and travel of the beater from one beat of a stroke to the next [s, m]; empty for a single stroke."""
    duty = start.duty
    if duty.strokes * duty.starts == 1:
        return np.zeros(0), np.zeros(0)
    linkage = duty.linkage
    if duty.starts == 1:
        turned = np.linspace(0.0, turn, _TURN_SAMPLES)
        rocker = solve(linkage.plan, linkage.beta + turned).angle("rocker") - linkage.rocker_angles[0]
        return turned / linkage.params.speed, linkage.lengths["beater"] * np.abs(rocker)
    there, back = _times(start)
    returning, going = start.time >= there, start.time <= there
    times = (start.time[returning] - there, start.time[going] + back + duty.pause, [there + back + duty.pause])
    return np.concatenate(times), np.concatenate([start.travel[returning], start.travel[going], [0.0]])
