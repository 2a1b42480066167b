"""The hammer's figures: force against rows, the stroke and its force, the fell."""

from dataclasses import replace

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.machines.beat_up.figures import moving as moving_beater
from ilmek.machines.beat_up.use_figures import start_plots
from ilmek.machines.hammer.axis import CombDrive
from ilmek.machines.hammer.design import Hammer
from ilmek.machines.hammer.params import HammerParams
from ilmek.report import Animation, Axis, Drawing, Figure, Mark, MovingStroke, Plot, Reading, Series, Stroke
from ilmek.units import dm, format_quantity, turn

SHOWN, ROWS = 7, 5
"""Warps and rows drawn."""

SLIMMEST = 0.6
"""Width over height of the comb in motion: less would be too narrow."""

FRAMES = 120
"""Frames of a turn of the cams."""


def figures(design: Hammer) -> tuple[Figure, ...]:
    """All figures, in the order of the report."""
    driven: tuple[Figure, ...] = ()
    if design.axis is not None:
        driven = (moving(design, design.axis), *axis_plots(design.axis))
    elif design.linkage is not None:
        crank_rocker = moving_beater(design.linkage.one)
        still = replace(crank_rocker.still, name="hammer-moving", title="A crank-rocker of the comb in motion")
        driven = (replace(crank_rocker, still=still), *start_plots(design.linkage.start, "hammer"))
    return (drawing(design), *driven[:1], packing_plot(design), fell_plot(design), *driven[1:])


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


def moving(design: Hammer, axis: CombDrive) -> Animation:
    """The comb over a turn of the cams, with two beats: it presses the new row, and the fell yields and returns.

    The force F of a warp moves the fell by its elastic displacement; the new row follows the comb while it is pressed.
    """
    params, fabric = design.params, design.fabric
    at = np.arange(FRAMES) * (turn / FRAMES)
    travel, press = (np.interp(at, axis.angle, one, period=turn) for one in (axis.travel, axis.press))
    tip = params.stroke - travel
    fell = np.asarray(fabric.fell(design.force) - fabric.fell(press / params.cloth.warps))
    beaten = np.maximum.accumulate(press.reshape(2, -1) > 0, axis=1).ravel()
    going = ~beaten | (press > 0)
    row = np.where(beaten, np.where(going, np.minimum(tip, design.comb_travel), fell), design.comb_travel)
    low = -(ROWS + 0.5) * design.spacing
    high = 1.4 * params.leaf_height + params.stroke
    wide, wider = (SHOWN / 2 + 1) * params.cloth.warp_pitch, _wider(params, high - low)
    comb = _widened(_comb(params), wider)
    strokes = [MovingStroke(1j * tip[:, None] + comb, "outline", "comb", closed=True)]
    for one in range(ROWS + 1):
        height = fell - one * design.spacing if one else row
        ends = wider * np.array([-wide, wide]) + 1j * height[:, None]
        strokes.append(MovingStroke(ends, "path", "rows" if one else "new row"))
    warps = tuple(Stroke(wider * x + 1j * np.array([low, high]), "yarn") for x in _middles(params))
    note = "Front view" + (f", drawn {wider} times as wide." if wider > 1 else ".")
    still = Drawing("hammer-moving", "The comb beats the rows", warps, note=note)
    readings = (
        Reading("stroke", travel, "mm"),
        Reading("force of a warp", press / params.cloth.warps, "N"),
        Reading("force of the axes", np.interp(at, axis.angle, axis.force, period=turn), "kN"),
    )
    drive, period = Axis("cam angle", "deg"), turn / params.shed_speed
    return Animation(still, drive, at, tuple(strokes), (), period=period, readings=readings)


def drawing(design: Hammer) -> Drawing:
    """The comb at the beat, between some warps: its leaves over the last row, the rows below; to scale."""
    params = design.params
    pitch, top, half = params.cloth.warp_pitch, params.leaf_height, SHOWN * params.cloth.warp_pitch / 2
    gaps = np.arange(SHOWN + 1) * pitch - half
    leaves = tuple(Stroke(_box(x - params.leaf / 2, 0.0, params.leaf, top), "outline", "", True, True) for x in gaps)
    low = -(ROWS + 0.5) * design.spacing
    warps = tuple(Stroke(np.array([x + 1j * low, x + 1.4j * top]), "yarn") for x in _middles(params))
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


def _middles(params: HammerParams) -> FloatArray:
    """Positions of the warps across the width [m]."""
    return np.asarray((np.arange(SHOWN) - (SHOWN - 1) / 2) * params.cloth.warp_pitch)


def _comb(params: HammerParams) -> ComplexArray:
    """Outline of the comb, cut off above, the tips of its leaves at y = 0."""
    pitch, top, wide = params.cloth.warp_pitch, params.leaf_height, (SHOWN / 2 + 1) * params.cloth.warp_pitch
    gaps = (np.arange(SHOWN + 1) - SHOWN / 2) * pitch
    tooth = params.leaf / 2 * np.array([-1, -1, 1, 1]) + 1j * top * np.array([1, 0, 0, 1])
    corners = (gaps[:, None] + tooth).ravel()
    ends = np.array([wide + 1j * top, wide + 1.3j * top, -wide + 1.3j * top, -wide + 1j * top])
    return np.concatenate([corners, ends])


def _wider(params: HammerParams, height: float) -> int:
    """The factor of the width at which the warps are as far apart as they can be seen, 1 or more."""
    return max(1, round(SLIMMEST * height / (SHOWN + 2) / params.cloth.warp_pitch))


def _widened(points: ComplexArray, wider: float) -> ComplexArray:
    return np.asarray(wider * points.real + 1j * points.imag)


def _box(x: float, y: float, width: float, height: float) -> ComplexArray:
    return np.array([complex(x, y), complex(x + width, y), complex(x + width, y + height), complex(x, y + height)])
