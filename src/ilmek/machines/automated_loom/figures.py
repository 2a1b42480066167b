"""Figures of the automated loom: cyclogram of a row, weaving time against heads, and the front of the loom."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from ilmek.carpet.design import MOST_KNOTS
from ilmek.carpet.quality import COARSEST, FINEST
from ilmek.loom.sharing import halves, heads_that_fit, share
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.estimate import estimated_time, estimated_times_at
from ilmek.report import Axis, Drawing, Mark, Plot, Series, Stroke, Timing
from ilmek.report.left_out import LazyFigure
from ilmek.timing.figures import draw
from ilmek.units import format_quantity

_MOST_LINES = 40
"""Warps drawn; a real loom has more."""

_NAMES = 0.3
"""How far the leaders of the names reach beyond the frame, in its widths; the names stand on them."""

_KINK, _APART = 0.05, 0.06
"""Where a leader turns level beyond the frame, and the least distance of two names, in widths of the frame."""


@dataclass(frozen=True, slots=True)
class _Heights:
    """Heights over the floor [m]; chosen, as is every height of the drawing, but never less than the parts need."""

    bottom: float
    spacer: float
    fell: float
    heads: float
    comb: float
    cams: float
    top: float


_WIDTH = 0.05
"""Height of the dimension of the width [m]."""


def _heights(loom: LoomDesign) -> _Heights:
    tube, guide = loom.tube[0], loom.shedding.stack.guide_radius
    bottom = max(0.25, 0.10 + tube / 2)
    spacer = max(bottom + 0.35, bottom + 1.1 * tube)
    fell = spacer + max(0.20, tube / 2 + 0.08)
    comb = fell + 0.32
    cams = max(fell + 0.70, comb + guide + 0.08)
    return _Heights(bottom, spacer, fell, fell + 0.15, comb, cams, cams + max(0.50, guide + tube / 2 + 0.08))


def figures(loom: LoomDesign) -> tuple[LazyFigure, ...]:
    """The loom's figures, the head's cyclogram among them."""
    scaling = (time_of_one_head,) if loom.heads_max == 1 else (time_against_heads, time_against_pitch)
    return tuple(partial(make, loom) for make in (front, one_row, one_knot, *scaling))


def one_row(loom: LoomDesign) -> Timing:
    """The cyclogram of a row."""
    note = (
        "Four steps of 90° and the warps' harmonic motion: thesis, 3.3; shuttle, beat and take-up placed within them."
    )
    return draw(loom.row_cyclogram, "One row: two wefts, two beats", note)


def one_knot(loom: LoomDesign) -> Timing:
    """The cyclogram of a knot."""
    order = "Order of the motions: thesis, 2.2.3; angles chosen, the thesis prints none. The head steps on at the end."
    return draw(loom.cyclograms[0], "One knot: the head's cams, and its step to the next knot", order)


def time_against_heads(loom: LoomDesign) -> Plot:
    """Estimated weaving time for every number of heads that fits."""
    heads = np.arange(1, loom.heads_max + 1)
    total = np.array([estimated_time(loom, int(number)) for number in heads])
    wefts = np.full(len(heads), loom.rows * loom.times.weft)
    series = (
        Series("weaving time", heads.astype(float), total),
        Series("wefts and beats alone", heads.astype(float), wefts, dashed=True),
    )
    note = f"at {loom.params.changes_per_knot:.2g} colour changes a knot; heads waiting for each other not counted"
    return Plot(
        "weaving-time",
        "Weaving time and number of heads",
        Axis("heads"),
        Axis("time", "h"),
        series,
        (Mark(float(loom.heads), "this loom"),),
        note,
    )


_FINER = (0.4, 0.5, 0.75, 1.0, 1.5, 2.0)
"""Pitches of the scaling's curves, in this loom's."""


def time_against_pitch(loom: LoomDesign) -> Plot:
    """How the weaving time of the same carpet scales: over the number of heads, a curve for each pitch of the warps."""
    params = loom.params
    series = []
    for factor in _FINER:
        pitch = factor * params.pitch
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
    finest = max(0.5 / loom.params.pitch, loom.params.quality.along) / FINEST
    return min(1.0, max(finest, math.sqrt(loom.rows * loom.columns / (0.999 * MOST_KNOTS))))


def _coarsest(loom: LoomDesign) -> float:
    """How much wider the pitch may be for the carpet still to be one, with two knots across and two rows at least."""
    params, quality = loom.params, loom.params.quality
    fewest = min(params.width / (4 * params.pitch), params.length * quality.along / 2)
    return min(fewest, min(0.5 / params.pitch, quality.along) / COARSEST)


def time_of_one_head(loom: LoomDesign) -> Plot:
    """How the weaving time of a carpet too narrow for a second head scales: over the pitch of the warps."""
    params = loom.params
    pitches = params.pitch * np.linspace(max(_FINER[0], _finest(loom)), min(_FINER[-1], max(1.0, _coarsest(loom))), 33)
    total = np.array([float(estimated_times_at(loom, pitch, (1,))[0]) for pitch in pitches.tolist()])
    note = "rows by the same measure; head, wefts and beats as of this loom; there is room for one head"
    axes = Axis("warp pitch", "mm"), Axis("time", "h")
    marks = (Mark(params.pitch, "this loom"),)
    return Plot("weaving-time-pitch", "Weaving time and pitch", *axes, (Series("", pitches, total),), marks, note)


def front(loom: LoomDesign) -> Drawing:
    """The loom from the front, true across; heights chosen."""
    params = loom.params
    edge, wide, at, cloth = params.margin, loom.task.width, _heights(loom), loom.task.cloth_width
    strokes = (
        *(
            _box(complex(x, 0), complex(0.06, at.top + loom.tube[0] / 2 + 0.08), "outline", filled=True)
            for x in (-0.06, wide)
        ),
        *_cylinders(wide, loom.tube[0], at),
        *_warps(loom, edge, at),
        _box(complex(edge, at.spacer), complex(cloth, at.fell - at.spacer), "yarn", filled=True),
        Stroke(np.array([edge, edge + cloth]) + 1j * at.comb, "link"),
        _cams(loom, edge, wide, at.cams),
        *_heads(loom, edge, at),
        Stroke(
            np.array([edge, edge + cloth]) + 1j * _WIDTH,
            "dimension",
            format_quantity(cloth, "m"),
        ),
        *_names(edge + cloth, wide, at),
    )
    note = f"{loom.warps} warps at {params.pitch * 1e3:.4g} mm, not all drawn; true across, heights chosen"
    return Drawing("loom-front", "The loom from the front", strokes, (), "m", note)


def _box(corner: complex, size: complex, role: str, label: str = "", *, filled: bool = False) -> Stroke:
    """A rectangle from its lower left corner; size is width + i height."""
    corners = corner + np.array([0, size.real, size, 1j * size.imag])
    return Stroke(corners, role, label, closed=True, filled=filled)


def _cylinders(wide: float, diameter: float, at: _Heights) -> tuple[Stroke, ...]:
    return tuple(
        _box(complex(0, height - diameter / 2), complex(wide, diameter), "outline")
        for height in (at.bottom, at.spacer, at.top)
    )


def _names(edge: float, wide: float, at: _Heights) -> tuple[Stroke, ...]:
    """Leaders from the parts to their names beside the frame, where no warp runs through them."""
    named = {
        at.bottom: "carpet cylinder",
        at.spacer: "spacer cylinder",
        (at.spacer + at.fell) / 2: "carpet",
        at.heads: "knotting heads",
        at.comb: "comb of the beater",
        at.cams: "shedding cams",
        at.top: "warp cylinder",
    }
    end, kink = wide + 0.06 + _NAMES * wide, wide + 0.06 + _KINK * wide
    return tuple(
        Stroke(np.array([end + 1j * stands, kink + 1j * stands, edge + 1j * height]), "construction", name)
        for stands, (height, name) in zip(_spread(list(named), _APART * wide), named.items(), strict=True)
    )


def _spread(heights: list[float], apart: float) -> list[float]:
    """Heights in ascending order, at least `apart` from each other, near those given in that order."""
    spread = [heights[0]]
    for height in heights[1:]:
        spread.append(max(height, spread[-1] + apart))
    lower = (spread[-1] - heights[-1]) / 2
    return [height - lower for height in spread]


def _warps(loom: LoomDesign, edge: float, at: _Heights) -> tuple[Stroke, ...]:
    number = min(loom.warps, _MOST_LINES)
    places = edge + loom.task.cloth_width * (np.arange(number) + 0.5) / number
    return tuple(Stroke(np.array([x + 1j * at.fell, x + 1j * at.top]), "construction") for x in places.tolist())


def _cams(loom: LoomDesign, edge: float, wide: float, height: float) -> Stroke:
    radius = loom.shedding.stack.guide_radius
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


def _heads(loom: LoomDesign, edge: float, at: _Heights) -> tuple[Stroke, ...]:
    """Each head in the middle of the half it works first, and its block of the row under it."""
    parts = halves(loom.heads)
    edges = share(loom.columns, loom.heads) * loom.knot_pitch + edge
    strokes = []
    for head in range(loom.heads):
        low, high, end = (float(edges[head * parts + k]) for k in (0, 1, parts))
        body = (low + high) / 2 + loom.head_width * np.array([-0.5, 0.5])
        strokes += [
            Stroke(body + 1j * at.heads, "link"),
            Stroke(np.array([low, end]) + 1j * (at.fell + 0.05), "dimension"),
        ]
    return tuple(strokes)
