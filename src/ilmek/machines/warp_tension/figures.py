"""The warp tension's figures: the cylinders from the side, deflection and section of one, tension over the rows."""

from dataclasses import dataclass, replace

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.dynamics.animation import frames
from ilmek.elements.beam import uniform
from ilmek.elements.figures import deflection_plot, tube_drawing
from ilmek.machines.warp_tension.analysis import WarpTensionAnalysis, history
from ilmek.report import Animation, Axis, Drawing, Figure, MovingDot, MovingStroke, Plot, Reading, Series, Stroke
from ilmek.units import format_quantity, turn

SHOWN_ROWS = 4
_RING = np.exp(1j * np.linspace(0, turn, 73))


def figures(analysis: WarpTensionAnalysis) -> tuple[Figure, ...]:
    """All figures, in the order of the report."""
    design, params = analysis.design, analysis.design.params
    inertia = float(uniform.tube_inertia(design.outer_radius, design.inner_radius))
    load = design.load + design.self_weight
    line = deflection_plot(load, params.span, params.modulus, inertia, params.deflection_limit)
    section = tube_drawing(design.outer_radius, design.inner_radius, design.outer_radius_min)
    of_one = (replace(figure, name=f"warp-tension-{figure.name}") for figure in (line, section))
    return (side_view(analysis), moving(analysis), *of_one, _tension_plot(analysis))


@dataclass(frozen=True, slots=True)
class _Side:
    """The cylinders from the side: their middles by name, and the path of the warps [m], from the lower one on."""

    middle: dict[str, complex]
    path: ComplexArray


def _side(analysis: WarpTensionAnalysis) -> _Side:
    params, (upper, lower, spacer) = analysis.design.params, analysis.cylinders
    height, back = params.free_length, 4 * analysis.design.outer_radius
    arc = np.exp(1j * np.linspace(0.0, params.spacer_wrap, 25))
    middle = {"spacer": -spacer.outer + 1j * height, "lower": -lower.outer + 0j}
    leaves = middle["spacer"] + spacer.outer * arc[-1]
    along = 1j * np.exp(1j * params.spacer_wrap)
    middle["upper"] = leaves + back * along + 1j * along * upper.outer
    path = np.concatenate([[0j], middle["spacer"] + spacer.outer * arc, [leaves + back * along]])
    return _Side(middle, path)


def side_view(analysis: WarpTensionAnalysis) -> Drawing:
    """The three cylinders from the side, to scale, with the path of the warps and the loads."""
    side, height = _side(analysis), analysis.design.params.free_length
    longest = max(abs(cylinder.load) for cylinder in analysis.cylinders)
    strokes = [Stroke(side.path, "yarn", "warps")]
    for one in analysis.cylinders:
        at = side.middle[one.name]
        force = format_quantity(abs(one.load), "kN", 3)
        load = at + np.array([0.0, one.load / longest * height / 3])
        strokes += [Stroke(at + one.outer * _RING, "outline", one.name, closed=True, filled=True)]
        strokes += [Stroke(at + one.inner * _RING, "outline", closed=True), Stroke(load, "dimension", force)]
    note = "the warps come off the upper cylinder and slip over the spacer, the carpet goes to the lower; arrows: loads"
    return Drawing("warp-tension-side", "The three cylinders from the side", tuple(strokes), unit="m", note=note)


def moving(analysis: WarpTensionAnalysis) -> Animation:
    """A turn of the lower cylinder, take-ups joined to a steady motion: warps, and how far both cylinders turn.

    The lower cylinder winds the length w of carpet, the upper one releases w (1 + crimp); the spacer stands still.
    """
    at, side, params = frames(), _side(analysis), analysis.design.params
    upper, lower, _ = analysis.cylinders
    woven = lower.outer * at
    released = woven * (1 + params.crimp)
    turned = {"lower": at, "upper": released / upper.outer}
    fixed = (
        Stroke(side.path, "yarn", "warps"),
        *(
            Stroke(
                side.middle[cylinder.name] + cylinder.outer * _RING, "outline", cylinder.name, closed=True, filled=True
            )
            for cylinder in analysis.cylinders
        ),
    )
    spokes = tuple(
        MovingStroke(
            side.middle[cylinder.name]
            + cylinder.outer * np.exp(1j * turned[cylinder.name])[:, None] * np.array([-1.0, 1.0]),
            "path",
            f"{cylinder.name} cylinder",
        )
        for cylinder in analysis.cylinders
        if cylinder.name in turned
    )
    marks = MovingDot(_along(side.path, released), "", "point")
    rows = woven / params.cloth.row_distance
    readings = (
        Reading("carpet taken up", woven, "mm"),
        Reading("rows", rows),
        Reading("warp released", released, "mm"),
    )
    note = "the take-ups of all rows joined; the dot is a point of a warp"
    still = Drawing("warp-tension-moving", "The cylinders take up the carpet", fixed, unit="m", note=note)
    drive, period = (
        Axis("angle of the lower cylinder", "deg"),
        float(turn * lower.outer / params.cloth.row_distance * params.row_time),
    )
    return Animation(still, drive, at, spokes, (marks,), period=period, readings=readings)


def _along(path: ComplexArray, released: FloatArray) -> ComplexArray:
    """The point of the warp that has run so far from the upper cylinder [m]; it ends at the fell."""
    run = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(path[::-1])))])
    return np.asarray(np.interp(released, run, path[::-1].real) + 1j * np.interp(released, run, path[::-1].imag))


def _tension_plot(analysis: WarpTensionAnalysis) -> Plot:
    """Tension of a warp over some rows."""
    rows = max(SHOWN_ROWS, analysis.design.params.rows_between + 1)
    at, over = history(analysis.design, rows)
    rest = Series("required", np.array([0.0, float(rows)]), np.full(2, analysis.tension.over.rest), dashed=True)
    note = "rises by the crimp of the warps; peaks: its shed; falls at the take-up, where the upper cylinder releases"
    title = "Tension of a warp over the rows"
    series = (Series("a warp", at, over), rest)
    return Plot("warp-tension-rows", title, Axis("rows"), Axis("tension", "N"), series, note=note)
