"""Figures of the automated loom: cyclogram of a row, weaving time against heads, and the front of the loom."""

import numpy as np

from ilmek.loom.sharing import halves, share
from ilmek.machines import weaver
from ilmek.machines.automated_loom.design import LoomDesign, frame_width
from ilmek.machines.automated_loom.time import estimated_time
from ilmek.report import Axis, Drawing, Figure, Mark, Plot, Series, Stroke
from ilmek.timing.cyclogram import draw
from ilmek.units import format_quantity

_MOST_LINES = 40
"""Warps drawn; a real loom has more."""

_LEADER = 0.1
"""How far the leaders of the names reach beyond the frame [m]."""

_WIDTH, _BOTTOM, _SPACER, _FELL, _HEADS, _COMB, _CAMS, _TOP = 0.05, 0.25, 0.60, 0.80, 0.95, 1.12, 1.50, 2.00
"""Heights over the floor [m]; chosen, as is every height of the drawing."""


def figures(loom: LoomDesign) -> tuple[Figure, ...]:
    """The loom's figures, the head's cyclogram among them."""
    note = (
        "Four steps of 90° and the warps' harmonic motion: thesis, 3.3; shuttle, beat and take-up placed within them."
    )
    row = draw(loom.row_cyclogram, "One row: two wefts, two beats", note)
    return (front(loom), row, weaver.timing(loom.weaver), time_against_heads(loom))


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


def front(loom: LoomDesign) -> Drawing:
    """The loom from the front, true across; heights chosen."""
    params = loom.params
    edge, wide = params.margin, frame_width(params)
    strokes = (
        *(_box(complex(x, 0), complex(0.06, _TOP + 0.15), "outline", filled=True) for x in (-0.06, wide)),
        *_cylinders(wide, loom.tube[0]),
        *_warps(loom, edge),
        _box(complex(edge, _SPACER), complex(params.width, _FELL - _SPACER), "yarn", filled=True),
        Stroke(np.array([edge, edge + params.width]) + 1j * _COMB, "link"),
        _cams(loom, edge, wide),
        *_heads(loom, edge),
        Stroke(np.array([edge, edge + params.width]) + 1j * _WIDTH, "dimension", format_quantity(params.width, "m")),
        *_names(edge + params.width, wide),
    )
    note = f"{loom.warps} warps at {params.pitch * 1e3:.4g} mm, not all drawn; true across, heights chosen"
    return Drawing("loom-front", "The loom from the front", strokes, (), "m", note)


def _box(corner: complex, size: complex, role: str, label: str = "", *, filled: bool = False) -> Stroke:
    """A rectangle from its lower left corner; size is width + i height."""
    corners = corner + np.array([0, size.real, size, 1j * size.imag])
    return Stroke(corners, role, label, closed=True, filled=filled)


def _cylinders(wide: float, diameter: float) -> tuple[Stroke, ...]:
    return tuple(
        _box(complex(0, height - diameter / 2), complex(wide, diameter), "outline")
        for height in (_BOTTOM, _SPACER, _TOP)
    )


def _names(edge: float, wide: float) -> tuple[Stroke, ...]:
    """Leaders from the parts to their names beside the frame, where no warp runs through them."""
    named = {
        _BOTTOM: "carpet cylinder",
        _SPACER: "spacer cylinder",
        (_SPACER + _FELL) / 2: "carpet",
        _HEADS: "knotting heads",
        _COMB: "comb of the beater",
        _CAMS: "shedding cams",
        _TOP: "warp cylinder",
    }
    end = wide + 0.06 + _LEADER
    return tuple(Stroke(np.array([end, edge]) + 1j * height, "construction", name) for height, name in named.items())


def _warps(loom: LoomDesign, edge: float) -> tuple[Stroke, ...]:
    number = min(loom.warps, _MOST_LINES)
    places = edge + loom.params.width * (np.arange(number) + 0.5) / number
    return tuple(Stroke(np.array([x + 1j * _FELL, x + 1j * _TOP]), "construction") for x in places.tolist())


def _cams(loom: LoomDesign, edge: float, wide: float) -> Stroke:
    radius = loom.shedding.stack.guide_radius
    shaft = loom.shedding.shaft.bar / 2
    ends = edge, wide - edge
    profile = [
        complex(0, _CAMS - shaft),
        complex(ends[0], _CAMS - shaft),
        complex(ends[0], _CAMS - radius),
        complex(ends[1], _CAMS - radius),
        complex(ends[1], _CAMS - shaft),
        complex(wide, _CAMS - shaft),
    ]
    upper = [complex(point.real, 2 * _CAMS - point.imag) for point in reversed(profile)]
    return Stroke(np.array(profile + upper), "outline", closed=True)


def _heads(loom: LoomDesign, edge: float) -> tuple[Stroke, ...]:
    """Each head in the middle of the half it works first, and its block of the row under it."""
    params = loom.params
    parts = halves(loom.heads)
    edges = share(loom.columns, loom.heads) * loom.knot_pitch + edge
    strokes = []
    for head in range(loom.heads):
        low, high, end = (float(edges[head * parts + k]) for k in (0, 1, parts))
        body = (low + high) / 2 + params.head_width * np.array([-0.5, 0.5])
        strokes += [
            Stroke(body + 1j * _HEADS, "link"),
            Stroke(np.array([low, end]) + 1j * (_FELL + 0.05), "dimension"),
        ]
    return tuple(strokes)
