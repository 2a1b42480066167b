"""Figures of the automated loom: cyclogram of a row, weaving time against heads and pitch, the front of the loom."""

import math
from collections.abc import Callable
from functools import partial

import numpy as np

from ilmek.carpet.design import MOST_KNOTS
from ilmek.carpet.quality import COARSEST, FINEST
from ilmek.machines.automated_loom.cost_figures import cost_over_carpets, cost_over_heads
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.estimate import estimated_times_at
from ilmek.machines.automated_loom.motion.actuators import knot_forces, knot_speeds, row_forces, row_speeds
from ilmek.machines.automated_loom.motion.knot_views import knot_from_the_front, knot_from_the_side, ties_by_grippers
from ilmek.machines.automated_loom.motion.row_views import row_from_above, row_from_the_front, row_from_the_side
from ilmek.machines.automated_loom.motion.yarn_to_knot import yarn_to_knot
from ilmek.machines.automated_loom.views import above, front, room, side
from ilmek.report import Axis, Figure, Mark, Plot, Series, Timing
from ilmek.report.left_out import LazyFigure
from ilmek.timing.figures import draw
from ilmek.units import format_quantity


def figures(loom: LoomDesign) -> tuple[LazyFigure, ...]:
    """The loom's figures: views, a row and a knot in motion with their actuators, the scaling of the weaving time."""
    scaling = time_of_one_knotter if loom.knotters_max == 1 else time_against_pitch
    by_grippers: tuple[Callable[[LoomDesign], Figure], ...] = (knot_from_the_front, yarn_to_knot)
    by_heads: tuple[Callable[[LoomDesign], Figure], ...] = (knot_speeds, knot_forces)
    made: tuple[Callable[[LoomDesign], Figure], ...] = (
        side,
        room,
        row_from_the_side,
        row_from_the_front,
        row_from_above,
        front,
        above,
        one_row,
        row_speeds,
        row_forces,
        *((knot_from_the_side,) if loom.heads else ()),
        *(by_grippers if loom.heads and ties_by_grippers(loom) else ()),
        one_knot,
        *(by_heads if loom.heads else ()),
        cost_over_heads,
        cost_over_carpets,
        scaling,
    )
    return tuple(partial(make, loom) for make in made)


def one_row(loom: LoomDesign) -> Timing:
    """The cyclogram of a row."""
    stand = "; the cams stand, the shed closed, for the beats" if loom.row_timing.turning < 1 else ""
    note = f"Four steps and the warps' harmonic motion: thesis, 3.3; weft, beat and take-up placed within them{stand}."
    return draw(loom.row_cyclogram, "One row: two wefts, two beats", note, drive=Axis("angle of the row", "deg"))


def one_knot(loom: LoomDesign) -> Timing:
    """The cyclogram of a knot, or of a row with its weavers."""
    if not loom.heads:
        note = "The weavers tie beside each other, each the knots of her share; the loom lays and beats the wefts then."
        return draw(loom.knot_cyclogram, "One row with its weavers", note, drive=Axis("angle of the row", "deg"))
    order = "Order of the motions: thesis, 2.2.3; angles chosen, the thesis prints none. The head steps on at the end."
    return draw(loom.cyclograms[0], "One knot: the head's cams, and its step to the next knot", order)


_FINER = (0.4, 0.5, 0.75, 1.0, 1.5, 2.0)
"""Pitches of the scaling's curves, in this loom's."""


def time_against_pitch(loom: LoomDesign) -> Plot:
    """How the weaving time of the same carpet scales: over heads or weavers, a curve for each pitch of the warps."""
    params, own, of = loom.params, loom.task.cloth.warp_pitch, "heads" if loom.heads else "weavers"
    series = []
    for factor in _FINER:
        pitch = factor * own
        if not _finest(loom) <= factor <= _coarsest(loom):
            continue
        columns = round(params.woven_size[0] / (2 * pitch))
        numbers = range(1, loom.head.most(columns, 2 * pitch) + 1)
        total = estimated_times_at(loom, pitch, numbers)
        label = f"{format_quantity(pitch, 'mm', 3)}: {format_quantity(0.5 / pitch, '1/dm', 3)}"
        series.append(Series(label, np.array(numbers, dtype=float), total, dashed=factor != 1.0))
    note = "warp pitch and knots across; rows by the same measure; knot, wefts and beats as of this loom"
    axes = Axis(of), Axis("time", "h")
    return Plot("weaving-time-pitch", f"Weaving time, {of} and pitch", *axes, tuple(series), note=note)


def _finest(loom: LoomDesign) -> float:
    """How much narrower the pitch may be: down to the finest quality, and the most knots but for their rounding."""
    finest = max(0.5 / loom.task.cloth.warp_pitch, loom.params.quality.along) / FINEST
    return min(1.0, max(finest, math.sqrt(loom.rows * loom.columns / (0.999 * MOST_KNOTS))))


def _coarsest(loom: LoomDesign) -> float:
    """How much wider the pitch may be for the carpet still to be one, with two knots across and two rows at least."""
    params, quality, own = loom.params, loom.params.quality, loom.task.cloth.warp_pitch
    fewest = min(params.woven_size[0] / (4 * own), params.length * quality.along / 2)
    return min(fewest, min(0.5 / own, quality.along) / COARSEST)


def time_of_one_knotter(loom: LoomDesign) -> Plot:
    """How the weaving time of a carpet too narrow for a second head or weaver scales: over the pitch of the warps."""
    own = loom.task.cloth.warp_pitch
    pitches = own * np.linspace(max(_FINER[0], _finest(loom)), min(_FINER[-1], max(1.0, _coarsest(loom))), 33)
    total = np.array([float(estimated_times_at(loom, pitch, (1,))[0]) for pitch in pitches.tolist()])
    note = "rows by the same measure; knot, wefts and beats as of this loom; there is room for one head or weaver"
    axes = Axis("warp pitch", "mm"), Axis("time", "h")
    marks = (Mark(own, "this loom"),)
    return Plot("weaving-time-pitch", "Weaving time and pitch", *axes, (Series("", pitches, total),), marks, note)
