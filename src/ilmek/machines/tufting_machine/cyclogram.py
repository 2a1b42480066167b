"""The cyclogram of a stitch: needles, loopers, and the backing that goes on evenly, over a turn of the main shaft.

The motions of linkages are written as splines through points of them between their dead centres, with the acceleration
there; the relations are the windows of the loop.
"""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from scipy.interpolate import CubicSpline

from ilmek.arrays import FloatArray
from ilmek.cams.laws import spline, uniform
from ilmek.machines.tufting_machine.design import TuftingMachine
from ilmek.timing.cyclogram import Cyclogram, Moment, Relation, Track, TrackSegment, fixed
from ilmek.units import turn

NEEDLES, LOOPERS, KNIVES, BACKING = "needles", "loopers", "knives", "backing"

POINTS = 24
"""Points of a motion between its dead centres."""


def cyclogram(machine: TuftingMachine) -> Cyclogram:
    """A stitch: needles over their lowest position, hooks past the needles' line, backing."""
    angle, crank = np.linspace(0.0, turn, 721), "looper crank shaft"
    window, loop, stitch, knife = machine.loop.window, machine.loop, machine.params.advance, machine.knife
    tracks = [
        Track(NEEDLES, "main shaft", tuple(_swings(machine.loop.geometry.path.rise, ("down", "up")))),
        Track(LOOPERS, crank, tuple(_swings(_closed(angle, machine.looper.ahead(angle)), ("back", "forward")))),
        Track(BACKING, "spiked rollers", (TrackSegment("on", 0.0, turn, 0.0, stitch, uniform.LAW),), revolves=stitch),
    ]
    if knife is not None:
        height = knife.edge_at(angle).imag
        tracks.insert(2, Track(KNIVES, crank, tuple(_swings(_closed(angle, height - height.min()), ("down", "up")))))
    turns = int(loop.release // turn - window.out // turn)
    enters, leaves = (Moment(LOOPERS, motion, "past", 0.0) for motion in ("forward", "back"))
    relations = (
        Relation(enters, fixed(window.opened % turn), 0.0, "the loop is open", window.shut - window.opened),
        Relation(leaves, fixed(window.out % turn), 0.0, "the needle is out", window.back - window.out, turns),
    )
    return Cyclogram("stitch", turn / machine.params.needle.speed, tuple(tracks), relations)


def _closed(angle: FloatArray, height: FloatArray) -> CubicSpline:
    """A periodic curve through heights over a turn, its last as its first."""
    return CubicSpline(angle, [*height[:-1], height[0]], bc_type="periodic")


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
