"""The hammer's figures: force against rows, force and rows across the width, the stroke and its force, the fell."""

from dataclasses import replace

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.machines.hammer.axis import CombDrive as VerticalAxis
from ilmek.machines.hammer.design import Hammer
from ilmek.report import Axis, Drawing, Figure, Mark, Plot, Series, Stroke
from ilmek.units import dm, format_quantity


def figures(design: Hammer) -> tuple[Figure, ...]:
    """All figures, in the order of the report."""
    driven = () if design.axis is None else axis_plots(design.axis)
    return (drawing(design), packing_plot(design), fell_plot(design), *across_plots(design), *driven)


def packing_plot(design: Hammer) -> Plot:
    """Distance of rows that a force leaves, up to twice the larger of force and need."""
    force = np.linspace(0.0, 2 * max(design.force, design.needed), 201)
    fabric = design.fabric
    loose = replace(fabric, tension=fabric.tension / 2)
    series = (
        Series("tension as set", force, np.asarray(fabric.spacing(force))),
        Series("half of it", force, np.asarray(loose.spacing(force)), dashed=True),
    )
    marks = (Mark(design.force, format_quantity(design.spacing, "mm")),)
    note = f"jammed at {format_quantity(fabric.jammed, 'mm')}, laid at {format_quantity(fabric.laid, 'mm')}"
    title = "Rows by the force of the beat"
    across, up = Axis("force of a warp", "N"), Axis("distance of rows", "mm")
    return Plot("hammer-packing", title, across, up, series, marks, note)


def fell_plot(design: Hammer) -> Plot:
    """Force of the fell along the comb's last way: up while it packs, down by what the fell gives back."""
    fabric = design.fabric
    force = np.linspace(0.0, design.force, 201)
    end = float(fabric.travel(design.force))
    series = (
        Series("comb going", np.asarray(fabric.travel(force)), force),
        Series("comb coming back", end - fabric.fell(design.force) + fabric.fell(force), force, dashed=True),
    )
    note = "the area between the curves is the work that packs the row, the rest is given back"
    title = "Force of a warp along the comb's way in the fell"
    return Plot("hammer-fell", title, Axis("way", "mm"), Axis("force of a warp", "N"), series, note=note)


def across_plots(design: Hammer) -> tuple[Plot, Plot]:
    """Force of a warp, and rows per length, across the width."""
    x = design.comb.line.x
    ends = np.array([0.0, design.params.width])
    force = Plot(
        "hammer-across",
        "Force of a warp across the width",
        Axis("across", "mm"),
        Axis("force of a warp", "N"),
        (Series("comb", x, design.force_across()), Series("mean", ends, np.full(2, design.force), dashed=True)),
    )
    rows = Plot(
        "hammer-rows-across",
        "Rows along the carpet, across its width",
        Axis("across", "mm"),
        Axis("rows", "1/dm"),
        (
            Series("comb", x, 1 / design.spacing_across()),
            Series("wanted", ends, np.full(2, 1 / design.params.rows), dashed=True),
        ),
    )
    return force, rows


def axis_plots(axis: VerticalAxis) -> tuple[Plot, Plot]:
    """The stroke, and the force of the axes, over a turn of the cams."""
    over = Axis("cam angle", "deg")
    stroke = Plot(
        "hammer-stroke",
        "Stroke of the comb, downwards",
        over,
        Axis("stroke", "mm"),
        (Series("comb", axis.angle, axis.travel),),
    )
    inertia = axis.mass * axis.acceleration
    force = Plot(
        "hammer-force",
        "Force of the vertical axes, downwards",
        over,
        Axis("force", "kN"),
        (
            Series("all", axis.angle, axis.force),
            Series("the fell's", axis.angle, axis.press, dashed=True),
            Series("inertia", axis.angle, inertia, dashed=True),
        ),
        note="negative: the axes hold the weight of cams and comb",
    )
    return stroke, force


SHOWN, ROWS = 7, 5
"""Warps and rows drawn."""


def drawing(design: Hammer) -> Drawing:
    """The comb at the beat, between some warps: its leaves over the last row, the rows below; to scale."""
    params = design.params
    pitch, top, half = params.warp_pitch, params.leaf_height, SHOWN * params.warp_pitch / 2
    places = np.arange(SHOWN + 1) * pitch - half
    leaves = tuple(Stroke(_box(x - params.leaf / 2, 0.0, params.leaf, top), "outline", "", True, True) for x in places)
    low = -(ROWS + 0.5) * design.spacing
    warps = tuple(Stroke(np.array([x + 1j * low, x + 1.4j * top]), "yarn") for x in places[:-1] + pitch / 2)
    rows = tuple(
        Stroke(np.array([-half - pitch, half + pitch]) - 1j * n * design.spacing, "path", "" if n else "last row")
        for n in range(ROWS + 1)
    )
    bar = _box(-half - pitch, top, 2 * half + 2 * pitch, 0.3 * top)
    said = Stroke(half + 1.8 * pitch - 1j * np.array([1, 2]) * design.spacing, "dimension", "rows")
    strokes = (*warps, *rows, *leaves, Stroke(bar, "outline", "comb, cut off above", True), said)
    note = (
        f"Front view at the beat: rows {format_quantity(design.spacing, 'mm')} apart, {design.rows_along * dm:.4g}/dm."
    )
    return Drawing("hammer-comb", "Comb between the warps", strokes, note=note)


def _box(x: float, y: float, width: float, height: float) -> ComplexArray:
    return np.array([complex(x, y), complex(x + width, y), complex(x + width, y + height), complex(x, y + height)])
