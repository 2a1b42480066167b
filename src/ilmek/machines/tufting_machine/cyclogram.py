"""The cyclogram of a stitch: needles, loopers, and the backing that goes on evenly, over a turn of the main shaft.

The motions of linkages are written as splines through points of them between their dead centres, with the acceleration
there; the relations are the windows of the loop.
"""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from scipy.interpolate import CubicSpline

from ilmek.cams.laws import spline, uniform
from ilmek.machines.tufting_machine.design import TuftingMachine
from ilmek.timing.cyclogram import Cyclogram, Moment, Relation, Track, TrackSegment, fixed
from ilmek.units import turn

NEEDLES, LOOPERS, BACKING = "needles", "loopers", "backing"

POINTS = 24
"""Points of a motion between its dead centres."""


def cyclogram(machine: TuftingMachine) -> Cyclogram:
    """A stitch: needles over their lowest position, hooks past the needles' line, backing."""
    angle = np.linspace(0.0, turn, 721)
    ahead = machine.looper.ahead(angle)
    ahead[-1] = ahead[0]
    hooks = CubicSpline(angle, ahead, bc_type="periodic")
    window, loop, stitch = machine.loop.window, machine.loop, machine.params.advance
    tracks = (
        Track(NEEDLES, "main shaft", tuple(_swings(machine.loop.geometry.path.rise, ("down", "up")))),
        Track(LOOPERS, "looper crank shaft", tuple(_swings(hooks, ("back", "forward")))),
        Track(BACKING, "spiked rollers", (TrackSegment("on", 0.0, turn, 0.0, stitch, uniform.LAW),), revolves=stitch),
    )
    turns = int(loop.release // turn - window.out // turn)
    enters, leaves = (Moment(LOOPERS, motion, "past", 0.0) for motion in ("forward", "back"))
    relations = (
        Relation(enters, fixed(window.opened % turn), 0.0, "the loop is open", window.shut - window.opened),
        Relation(leaves, fixed(window.out % turn), 0.0, "the needle is out", window.back - window.out, turns),
    )
    return Cyclogram("stitch", turn / machine.params.needle.speed, tracks, relations)


def _swings(curve: CubicSpline, names: tuple[str, str]) -> Iterator[TrackSegment]:
    """The motions of a curve of a turn between its dead centres; names: of those that fall and rise."""
    ends = sorted({round(float(at) % turn, 12) for at in curve.derivative().roots(extrapolate=False)})
    share = np.arange(1, POINTS) / POINTS
    for start, end in pairwise([*ends, ends[0] + turn]):
        begin, finish = (float(curve(at % turn)) for at in (start, end))
        inner = (curve((start + share * (end - start)) % turn) - begin) / (finish - begin)
        steep = (float(curve(at % turn, 2)) * (end - start) ** 2 / (finish - begin) for at in (start, end))
        first, last = ((0.0, value) for value in steep)
        law = spline.law(tuple(share.tolist()), tuple(inner.tolist()), first, last)
        yield TrackSegment(names[finish > begin], start, end, begin, finish, law)
