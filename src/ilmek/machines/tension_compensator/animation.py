"""The compensator in motion: its bars in equilibrium with warps and springs over a turn of the shedding cams."""

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.programme import TURN
from ilmek.machines.tension_compensator.analysis import SAMPLES, CompensatorAnalysis
from ilmek.machines.tension_compensator.side import mirrored, moved, parity
from ilmek.report import Animation, Axis, Dot, Drawing, MovingDot, MovingStroke, Reading, Stroke

_EVERY = 3
"""Samples of the analysis from frame to frame."""


def moving(found: CompensatorAnalysis) -> Animation:
    """A turn of the cams from the side: even warps on the right, odd ones on the left; one bar carries both."""
    design, lever = found.design, found.design.one.lever
    half, shown = design.half_depth, slice(0, SAMPLES - 1, _EVERY)
    at, rotation = found.angle[shown], found.rotation[shown]
    later = np.roll(rotation, at.size // 2)
    pivot, anchor = lever.pivot + half, complex(lever.anchor) + half
    bar = lever.bar(rotation)
    strokes = _over(found, rotation, "even warps" if design.bars > 1 else "warps")
    dots = [Dot(pivot, "pivot", "pivot"), Dot(anchor, "anchor", "pivot")]
    moving_dots = [MovingDot(bar + half, "bar", "point")]
    rods = [moved(rod, half) for rod in parity(design, 0.0).rods]
    if design.bars > 1:
        strokes += [_mirrored(one) for one in _over(found, later, "odd warps")]
        rods += [mirrored(rod, half) for rod in parity(design, 0.0).rods]
        dots += [Dot(-pivot.conjugate(), "", "pivot"), Dot(-anchor.conjugate(), "", "pivot")]
    readings = (
        Reading("tension of an even warp", found.even[shown], "N"),
        Reading("tension of an odd warp", found.odd[shown], "N"),
        Reading("travel of the bar", np.abs(bar - lever.rest), "mm"),
        Reading("force of a spring", found.spring[shown], "N"),
    )
    still = Drawing("tension-compensator-moving", "Compensator in motion", tuple(rods), tuple(dots))
    period = TURN / design.params.speed if design.params.speed > 0 else None
    drive = Axis("cam angle", "deg")
    return Animation(still, drive, at, tuple(strokes), tuple(moving_dots), period=period, readings=readings)


def _over(found: CompensatorAnalysis, rotation: FloatArray, label: str) -> list[MovingStroke]:
    """Warps, bar, lever and springs of a parity at rotations of its lever."""
    design = found.design
    poses = [parity(design, float(angle)) for angle in rotation]

    def track(strokes: list[Stroke], role: str, name: str = "", *, closed: bool = False) -> MovingStroke:
        return MovingStroke(np.stack([one.points for one in strokes]) + design.half_depth, role, name, closed)

    return [
        track([one.warps for one in poses], "yarn", label),
        track([one.lever for one in poses], "link", "lever"),
        track([one.bar for one in poses], "outline", closed=True),
        track([one.springs for one in poses], "path", "springs"),
    ]


def _mirrored(one: MovingStroke) -> MovingStroke:
    return MovingStroke(-np.conj(one.points), one.role, one.label, one.closed)
