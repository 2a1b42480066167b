"""The hammer's figures: force against rows, the stroke and its force, the fell."""

from dataclasses import replace

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.machines.beat_up.use_figures import start_plots
from ilmek.machines.hammer.axis import CombDrive
from ilmek.machines.hammer.design import Hammer
from ilmek.report import Axis, Drawing, Figure, Mark, Plot, Series, Stroke
from ilmek.units import dm, format_quantity

SHOWN, ROWS = 7, 5
"""Warps and rows drawn."""


def figures(design: Hammer) -> tuple[Figure, ...]:
    """All figures, in the order of the report."""
    driven = axis_plots(design.axis) if design.axis else ()
    if design.linkage is not None:
        driven = start_plots(design.linkage.start, "hammer")
    return (drawing(design), packing_plot(design), fell_plot(design), *driven)


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
    axes = Axis("force of a warp", "N"), Axis("distance of rows", "mm")
    return Plot("hammer-packing", "Rows by the force of the beat", *axes, series, marks, note)


def fell_plot(design: Hammer) -> Plot:
    """Force of the fell along the comb's travel in it: up while it packs, down as the fell returns."""
    fabric = design.fabric
    force = np.linspace(0.0, design.force, 201)
    back = design.comb_travel - fabric.fell(design.force) + fabric.fell(force)
    series = (
        Series("comb going", np.asarray(fabric.travel(force)), force),
        Series("comb coming back", back, force, dashed=True),
    )
    note = "the area between the curves is the work that packs the row, the rest is returned"
    axes = Axis("travel", "mm"), Axis("force of a warp", "N")
    return Plot("hammer-fell", "Force of a warp along the comb's travel in the fell", *axes, series, note=note)


def axis_plots(axis: CombDrive) -> tuple[Plot, Plot]:
    """The stroke, and the force of the axes, over a turn of the cams."""
    over = Axis("cam angle", "deg")
    stroke = (Series("comb", axis.angle, axis.travel),)
    force = (
        Series("all", axis.angle, axis.force),
        Series("the fell's", axis.angle, axis.press, dashed=True),
        Series("inertia", axis.angle, axis.mass * axis.acceleration, dashed=True),
    )
    note = "negative: the axes hold the weight of cams and comb"
    return (
        Plot("hammer-stroke", "Stroke of the comb, downwards", over, Axis("stroke", "mm"), stroke),
        Plot("hammer-force", "Force of the vertical axes, downwards", over, Axis("force", "kN"), force, note=note),
    )


def drawing(design: Hammer) -> Drawing:
    """The comb at the beat, between some warps: its leaves over the last row, the rows below; to scale."""
    params = design.params
    pitch, top, half = params.warp_pitch, params.leaf_height, SHOWN * params.warp_pitch / 2
    gaps = np.arange(SHOWN + 1) * pitch - half
    leaves = tuple(Stroke(_box(x - params.leaf / 2, 0.0, params.leaf, top), "outline", "", True, True) for x in gaps)
    low = -(ROWS + 0.5) * design.spacing
    warps = tuple(Stroke(np.array([x + 1j * low, x + 1.4j * top]), "yarn") for x in gaps[:-1] + pitch / 2)
    rows = tuple(
        Stroke(np.array([-half - pitch, half + pitch]) - 1j * n * design.spacing, "path", "" if n else "last row")
        for n in range(ROWS + 1)
    )
    bar = Stroke(_box(-half - pitch, top, 2 * half + 2 * pitch, 0.3 * top), "outline", "comb, cut off above", True)
    distance = Stroke(half + 1.8 * pitch - 1j * np.array([1, 2]) * design.spacing, "dimension", "rows")
    note = (
        f"Front view at the beat: rows {format_quantity(design.spacing, 'mm')} apart, {design.rows_along * dm:.4g}/dm."
    )
    return Drawing("hammer-comb", "Comb between the warps", (*warps, *rows, *leaves, bar, distance), note=note)


def _box(x: float, y: float, width: float, height: float) -> ComplexArray:
    return np.array([complex(x, y), complex(x + width, y), complex(x + width, y + height), complex(x, y + height)])
