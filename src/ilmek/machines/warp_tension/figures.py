"""The warp tension's figures: the cylinders from the side, deflection and section of one, tension over the rows."""

from dataclasses import replace

import numpy as np

from ilmek.elements.beam import uniform
from ilmek.elements.figures import deflection_plot, tube_drawing
from ilmek.machines.warp_tension.analysis import WarpTensionAnalysis, history
from ilmek.report import Axis, Drawing, Figure, Plot, Series, Stroke
from ilmek.units import turn

SHOWN_ROWS = 4


def figures(found: WarpTensionAnalysis) -> tuple[Figure, ...]:
    """All figures, in the order of the report."""
    design, params = found.design, found.design.params
    inertia = float(uniform.tube_inertia(design.outer_radius, design.inner_radius))
    load = design.load + design.self_weight
    line = deflection_plot(load, params.width, params.modulus, inertia, params.deflection_limit)
    section = tube_drawing(design.outer_radius, design.inner_radius, design.outer_radius_min)
    of_one = (replace(figure, name=f"warp-tension-{figure.name}") for figure in (line, section))
    return (side_view(found), *of_one, _tension_plot(found))


def side_view(found: WarpTensionAnalysis) -> Drawing:
    """The three cylinders from the side, to scale, with the path of the warps and the loads."""
    params, (upper, lower, spacer) = found.design.params, found.cylinders
    height, back, ring = params.free_length, 4 * found.design.outer_radius, np.exp(1j * np.linspace(0, turn, 73))
    arc = np.exp(1j * np.linspace(0.0, params.spacer_wrap, 25))
    middle = {"spacer": -spacer.outer + 1j * height, "lower": -lower.outer + 0j}
    leaves = middle["spacer"] + spacer.outer * arc[-1]
    along = 1j * np.exp(1j * params.spacer_wrap)
    middle["upper"] = leaves + back * along + 1j * along * upper.outer
    path = np.concatenate([[0j], middle["spacer"] + spacer.outer * arc, [leaves + back * along]])
    longest = max(abs(one.load) for one in found.cylinders)
    strokes = [Stroke(path, "yarn", "warps")]
    for one in found.cylinders:
        at = middle[one.name]
        load = at + np.array([0.0, one.load / longest * height / 3])
        strokes += [Stroke(at + one.outer * ring, "outline", one.name, closed=True, filled=True)]
        strokes += [Stroke(at + one.inner * ring, "outline", closed=True), Stroke(load, "dimension")]
    note = "the warps come off the upper cylinder and slip over the spacer, the carpet goes to the lower; arrows: loads"
    return Drawing("warp-tension-side", "The three cylinders from the side", tuple(strokes), unit="m", note=note)


def _tension_plot(found: WarpTensionAnalysis) -> Plot:
    """Tension of a warp over some rows."""
    rows = max(SHOWN_ROWS, found.design.params.rows_between + 1)
    at, over = history(found.design, rows)
    rest = Series("required", np.array([0.0, float(rows)]), np.full(2, found.tension.over.rest), dashed=True)
    note = "rises by the crimp of the warps; peaks: its shed; falls at the take-up, where the upper cylinder releases"
    title = "Tension of a warp over the rows"
    series = (Series("a warp", at, over), rest)
    return Plot("warp-tension-rows", title, Axis("rows"), Axis("tension", "N"), series, note=note)
