"""Figures of the automated loom: cyclogram of a row, weaving time against heads and pitch, the front of the loom."""

import math
from collections.abc import Callable
from functools import partial

import numpy as np

from ilmek.carpet.design import MOST_KNOTS
from ilmek.carpet.quality import COARSEST, FINEST
from ilmek.loom.sharing import halves, heads_that_fit, share
from ilmek.machines.arrangement.side_view import CamPosition, SideView
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.estimate import estimated_times_at
from ilmek.machines.automated_loom.motion.actuators import knot_forces, knot_speeds, row_forces, row_speeds
from ilmek.machines.automated_loom.motion.knot_views import knot_from_the_front, knot_from_the_side, ties_by_grippers
from ilmek.machines.automated_loom.motion.row_side import one_row_from_the_side
from ilmek.machines.automated_loom.motion.row_views import row_from_above, row_from_the_front
from ilmek.machines.automated_loom.motion.yarn_to_knot import yarn_to_knot
from ilmek.machines.automated_loom.side_figures import room, side, spread
from ilmek.report import Axis, Drawing, Figure, Mark, Plot, Series, Stroke, Timing
from ilmek.report.left_out import LazyFigure
from ilmek.timing.figures import draw
from ilmek.units import format_quantity

_MOST_LINES = 40
"""Warps drawn; a real loom has more."""

_NAMES = 0.3
"""How far the leaders of the names reach beyond the frame, in its widths; the names stand on them."""

_KINK, _APART = 0.05, 0.06
"""Where a leader turns level beyond the frame, and the least distance of two names, in widths of the frame."""


_WIDTH = 0.05
"""Height of the dimension of the width [m]."""


def figures(loom: LoomDesign) -> tuple[LazyFigure, ...]:
    """The loom's figures: views, a row and a knot in motion with their actuators, the scaling of the weaving time."""
    scaling = time_of_one_head if loom.heads_max == 1 else time_against_pitch
    by_grippers: tuple[Callable[[LoomDesign], Figure], ...] = (knot_from_the_front, yarn_to_knot)
    made: tuple[Callable[[LoomDesign], Figure], ...] = (
        side,
        room,
        one_row_from_the_side,
        row_from_the_front,
        row_from_above,
        front,
        one_row,
        row_speeds,
        row_forces,
        knot_from_the_side,
        *(by_grippers if ties_by_grippers(loom) else ()),
        one_knot,
        knot_speeds,
        knot_forces,
        scaling,
    )
    return tuple(partial(make, loom) for make in made)


def one_row(loom: LoomDesign) -> Timing:
    """The cyclogram of a row."""
    stand = "; the cams stand, the shed closed, for the beats" if loom.row_timing.turning < 1 else ""
    note = f"Four steps and the warps' harmonic motion: thesis, 3.3; weft, beat and take-up placed within them{stand}."
    return draw(loom.row_cyclogram, "One row: two wefts, two beats", note, drive=Axis("angle of the row", "deg"))


def one_knot(loom: LoomDesign) -> Timing:
    """The cyclogram of a knot."""
    order = "Order of the motions: thesis, 2.2.3; angles chosen, the thesis prints none. The head steps on at the end."
    return draw(loom.cyclograms[0], "One knot: the head's cams, and its step to the next knot", order)


_FINER = (0.4, 0.5, 0.75, 1.0, 1.5, 2.0)
"""Pitches of the scaling's curves, in this loom's."""


def time_against_pitch(loom: LoomDesign) -> Plot:
    """How the weaving time of the same carpet scales: over the number of heads, a curve for each pitch of the warps."""
    params, own = loom.params, loom.task.cloth.warp_pitch
    series = []
    for factor in _FINER:
        pitch = factor * own
        if not _finest(loom) <= factor <= _coarsest(loom):
            continue
        columns = round(params.width / (2 * pitch))
        heads = range(1, heads_that_fit(columns, 2 * pitch, loom.head_width) + 1)
        total = estimated_times_at(loom, pitch, heads)
        label = f"{format_quantity(pitch, 'mm', 3)}: {format_quantity(0.5 / pitch, '1/dm', 3)}"
        series.append(Series(label, np.array(heads, dtype=float), total, dashed=factor != 1.0))
    note = "warp pitch and knots across; rows by the same measure; head, wefts and beats as of this loom"
    axes = Axis("heads"), Axis("time", "h")
    return Plot("weaving-time-pitch", "Weaving time, heads and pitch", *axes, tuple(series), note=note)


def _finest(loom: LoomDesign) -> float:
    """How much narrower the pitch may be: down to the finest quality, and the most knots but for their rounding."""
    finest = max(0.5 / loom.task.cloth.warp_pitch, loom.params.quality.along) / FINEST
    return min(1.0, max(finest, math.sqrt(loom.rows * loom.columns / (0.999 * MOST_KNOTS))))


def _coarsest(loom: LoomDesign) -> float:
    """How much wider the pitch may be for the carpet still to be one, with two knots across and two rows at least."""
    params, quality, own = loom.params, loom.params.quality, loom.task.cloth.warp_pitch
    fewest = min(params.width / (4 * own), params.length * quality.along / 2)
    return min(fewest, min(0.5 / own, quality.along) / COARSEST)


def time_of_one_head(loom: LoomDesign) -> Plot:
    """How the weaving time of a carpet too narrow for a second head scales: over the pitch of the warps."""
    own = loom.task.cloth.warp_pitch
    pitches = own * np.linspace(max(_FINER[0], _finest(loom)), min(_FINER[-1], max(1.0, _coarsest(loom))), 33)
    total = np.array([float(estimated_times_at(loom, pitch, (1,))[0]) for pitch in pitches.tolist()])
    note = "rows by the same measure; head, wefts and beats as of this loom; there is room for one head"
    axes = Axis("warp pitch", "mm"), Axis("time", "h")
    marks = (Mark(own, "this loom"),)
    return Plot("weaving-time-pitch", "Weaving time and pitch", *axes, (Series("", pitches, total),), marks, note)


def front(loom: LoomDesign) -> Drawing:
    """The loom from the front, to scale."""
    params, view = loom.params, loom.side
    edge, wide, cloth = params.margin, loom.task.width, loom.task.cloth.width
    up = -view.floor
    lower = view.lower.at.imag + up
    strokes = (
        *(_box(complex(x, 0), complex(0.06, view.loom_height), "outline", filled=True) for x in (-0.06, wide)),
        *_cylinders(view, wide),
        *_warps(loom, edge),
        _box(complex(edge, lower), complex(cloth, up - lower), "yarn", filled=True),
        *(
            _box(complex(edge, one.imag.min() + up), complex(cloth, np.ptp(one.imag)), "outline")
            for one in view.comb[1:]
        ),
        *(_cams(loom, edge, wide, cam) for cam in view.cams),
        *_heads(loom, edge),
        Stroke(np.array([edge, edge + cloth]) + 1j * _WIDTH, "dimension", format_quantity(cloth, "m")),
        *_names(edge + cloth, wide, view),
    )
    note = f"{loom.warps} warps at {loom.task.cloth.warp_pitch * 1e3:.4g} mm, not all drawn; true to scale"
    return Drawing("loom-front", "The loom from the front", strokes, (), "m", note)


def _box(corner: complex, size: complex, role: str, label: str = "", *, filled: bool = False) -> Stroke:
    """A rectangle from its lower left corner; size is width + i height."""
    corners = corner + np.array([0, size.real, size, 1j * size.imag])
    return Stroke(corners, role, label, closed=True, filled=filled)


def _cylinders(view: SideView, wide: float) -> tuple[Stroke, ...]:
    """Lower, spacer and upper cylinder, and the back rest."""
    return tuple(
        _box(complex(0, one.at.imag - view.floor - one.radius), complex(wide, 2 * one.radius), "outline")
        for one in (view.lower, view.spacer, view.upper, view.back_rest)
    )


def _names(edge: float, wide: float, view: SideView) -> tuple[Stroke, ...]:
    """Leaders from the parts to their names beside the frame, where no warp runs through them."""
    cams = {f"cam shaft {number + 1}" if number else "shedding cams": cam.at for number, cam in enumerate(view.cams)}
    named = {
        "lower cylinder": view.lower.at.imag,
        "spacer cylinder": view.spacer.at.imag,
        "carpet": -view.spacer.radius / 4,
        "knotting heads": view.head.top / 2,
        "comb": float(view.comb[-1].imag.mean()),
        **{name: at.imag for name, at in cams.items()},
        "warp cylinder": view.upper.at.imag - view.upper.radius / 2,
        "back rest": view.back_rest.at.imag,
    }
    named = {name: height - view.floor for name, height in sorted(named.items(), key=lambda one: one[1])}
    end, kink = wide + 0.06 + _NAMES * wide, wide + 0.06 + _KINK * wide
    apart = _APART * max(wide, view.loom_height)
    return tuple(
        Stroke(np.array([end + 1j * stands, kink + 1j * stands, edge + 1j * height]), "construction", name)
        for stands, (name, height) in zip(spread(list(named.values()), apart), named.items(), strict=True)
    )


def _warps(loom: LoomDesign, edge: float) -> tuple[Stroke, ...]:
    number = min(loom.warps, _MOST_LINES)
    view = loom.side
    ends = np.array([0.0, view.spans.back_rest]) - view.floor
    columns = edge + loom.task.cloth.width * (np.arange(number) + 0.5) / number
    return tuple(Stroke(x + 1j * ends, "construction") for x in columns.tolist())


def _cams(loom: LoomDesign, edge: float, wide: float, cam: CamPosition) -> Stroke:
    radius, height = cam.guide_radius, cam.at.imag - loom.side.floor
    shaft = loom.shedding.shaft.bar / 2
    ends = edge, wide - edge
    profile = [
        complex(0, height - shaft),
        complex(ends[0], height - shaft),
        complex(ends[0], height - radius),
        complex(ends[1], height - radius),
        complex(ends[1], height - shaft),
        complex(wide, height - shaft),
    ]
    upper = [complex(point.real, 2 * height - point.imag) for point in reversed(profile)]
    return Stroke(np.array(profile + upper), "outline", closed=True)


def _heads(loom: LoomDesign, edge: float) -> tuple[Stroke, ...]:
    """Each head in the middle of the half it works first, and its block of the row above it."""
    parts, view = halves(loom.heads), loom.side
    edges = share(loom.columns, loom.heads) * loom.knot_pitch + edge
    low, top = (height - view.floor for height in (view.head.body.imag, view.head.top))
    strokes = []
    for head in range(loom.heads):
        first, last, end = (float(edges[head * parts + k]) for k in (0, 1, parts))
        left = (first + last - loom.head_width) / 2
        strokes += [
            _box(complex(left, low), complex(loom.head_width, top - low), "outline", filled=True),
            Stroke(np.array([first, end]) + 1j * (top + 0.03), "dimension"),
        ]
    return tuple(strokes)
