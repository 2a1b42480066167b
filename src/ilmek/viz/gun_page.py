"""The page of a carpet by a tufting gun: verdict, its path, time and yarn of each colour, cost, checks, files."""

from collections.abc import Sequence

import numpy as np
from markupsafe import Markup, escape

from ilmek.arrays import ComplexArray
from ilmek.machines.tufting_gun.design import TuftedByGun
from ilmek.report import Check, Result
from ilmek.units import format_quantity, mm
from ilmek.viz.tufted_page import tufted_page

_STEP = 0.1 * mm
"""Step of the points of the picture in motion [m]."""


def gun_page(
    title: str, tufted: TuftedByGun, results: Sequence[Result], checks: Sequence[Check], files: Sequence[str]
) -> str:
    """The page as self-contained HTML; results  of `tufted`, declared; files  names of those of the folder."""
    plan = tufted.plan
    return tufted_page(
        "gun.html.j2",
        f"{title}: by the tufting gun",
        maker="gun",
        results=results,
        checks=checks,
        files=files,
        cones=[tufted.cones[own.label] for own in plan.colours],
        colours=tufted.gun_colours,
        amounts=(("Strokes", "strokes", 0), ("Rows [m]", "rows", 1)),
        cost=tufted.gun_cost,
        apart=("gun_colours", "gun_cost"),
        lead=f"{plan.width / mm:.0f} × {plan.length / mm:.0f} mm, rows of {format_quantity(plan.spacing, 'mm')}",
        path=_path(tufted),
    )


def _path(tufted: TuftedByGun) -> Markup:
    """The strokes as SVG in steps of _STEP, each with its moments [s] for the page's script."""
    plan, moments = tufted.plan, np.round(tufted.clock, 1).tolist()
    width, length, row = (round(side / _STEP) for side in (plan.width, plan.length, plan.spacing))
    strokes = [(tufted.cones[own.label].colour, stroke) for own in plan.colours for stroke in own.strokes]
    paths = "\n".join(
        f'<path d="{_through(stroke)}" stroke="{escape(shade)}" data-from="{begin}" data-to="{end}" pathLength="1"/>'
        for (shade, stroke), begin, end in zip(strokes, moments[0::2], moments[1::2], strict=False)
    )
    return Markup(
        f'<svg id="gun-path" viewBox="0 0 {width} {length}" role="img" aria-label="Strokes of the gun">\n'
        f'<g transform="matrix(1 0 0 -1 0 {length})" fill="none" stroke-linejoin="round">\n'
        f'<g stroke-width="{0.85 * row:g}">\n{paths}\n</g>\n'
        f'<path id="gun-travels" d="" stroke="#c0f" stroke-width="{row / 4:g}"/>\n'
        f'<circle id="gun-mark" r="{max(2 * row, width / 100):g}" fill="#e00" stroke="#fff" '
        f'stroke-width="{row / 2:g}" visibility="hidden"/>\n</g></svg>'
    )


def _through(stroke: ComplexArray) -> str:
    """The SVG path through points [m], from each to the next."""
    points = np.round(np.stack([stroke.real, stroke.imag], axis=1) / _STEP).astype(int)
    steps = np.diff(points, axis=0, prepend=0)
    return f"M{steps[0, 0]} {steps[0, 1]}l{' '.join(map(str, steps[1:].ravel().tolist()))}"
