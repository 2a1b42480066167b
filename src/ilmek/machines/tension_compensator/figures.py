"""The compensator's figures: from the side, tensions over the turn, forces over the turn."""

import numpy as np

from ilmek.machines.tension_compensator.analysis import CompensatorAnalysis
from ilmek.machines.tension_compensator.animation import moving
from ilmek.machines.tension_compensator.design import TensionCompensator
from ilmek.machines.tension_compensator.side import RING, mirrored, moved, parity
from ilmek.report import Axis, Dot, Drawing, Figure, Plot, Series, Stroke
from ilmek.units import turn


def figures(found: CompensatorAnalysis) -> tuple[Figure, ...]:
    """All figures, in the order of the report."""
    return side_view(found.design), moving(found), tension_plot(found), travel_plot(found), force_plot(found)


def tension_plot(found: CompensatorAnalysis) -> Plot:
    """Tension of both parities over the turn, and that on fixed rods."""
    design, x = found.design, found.angle
    ends = np.array([0.0, turn])
    fixed = Series("open shed, fixed rods", ends, np.full(2, design.fixed_tension), dashed=True)
    allowed = Series(
        "allowed", ends, np.full(2, design.params.tension_most * design.params.cloth.warp_tension), dashed=True
    )
    series = (Series("even warps", x, found.even), Series("odd warps", x, found.odd), allowed, fixed)
    axes = Axis("cam angle", "deg"), Axis("tension", "N")
    return Plot("tension-compensator-tension", "Tension of a warp over the turn", *axes, series)


def travel_plot(found: CompensatorAnalysis) -> Plot:
    """Travel of the even warps' bar, or of the only one, and the warp that it gives, over the turn."""
    lever = found.design.one.lever
    travel = np.abs(lever.bar(found.rotation) - lever.rest)
    series = (
        Series("travel of the bar", found.angle, np.asarray(travel)),
        Series("warp that it gives", found.angle, lever.slack(found.rotation)),
    )
    axes = Axis("cam angle", "deg"), Axis("length", "mm")
    return Plot("tension-compensator-travel", "Travel of a bar over the turn", *axes, series)


def force_plot(found: CompensatorAnalysis) -> Plot:
    """Force of a spring and of a lever's pivot over the turn."""
    series = (Series("one spring", found.angle, found.spring), Series("pivot of a lever", found.angle, found.pivot))
    axes = Axis("cam angle", "deg"), Axis("force", "N")
    return Plot("tension-compensator-forces", "Forces of a lever over the turn", *axes, series)


def side_view(design: TensionCompensator) -> Drawing:
    """Both parities from the side, to scale: even warps in the open shed on the right, odd ones at rest on the left."""
    half, lever = design.half_depth, design.one.lever
    at_rest = Stroke(lever.rest + design.radius * RING, "construction", closed=True)
    right = (*parity(design, design.one.angle, named=True).strokes, at_rest)
    left = parity(design, 0.0).strokes if design.bars > 1 else ()
    strokes = (*(moved(one, half) for one in right), *(mirrored(one, half) for one in left))
    dots = (Dot(lever.pivot + half, "pivot", "pivot"), Dot(complex(lever.anchor) + half, "anchor", "pivot"))
    note = "right: a bar in the open shed, dashed at rest; left: the other parity at rest"
    return Drawing("tension-compensator-side", "Compensator from the side", strokes, dots, note=note)
