"""The page of a carpet by a tufting gun: verdict, path in motion, time and yarn of each colour, cost, checks, files."""

from collections.abc import Sequence

import numpy as np

from ilmek.machines.tufting_gun.design import TuftedByGun
from ilmek.report import Check, Json, Result
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
        data=_data(tufted),
    )


def _data(tufted: TuftedByGun) -> dict[str, Json]:
    """The strokes with their moments, in steps of _STEP and seconds: colour, begin, end, x and y of each point."""
    moments = np.round(tufted.clock, 1).tolist()
    strokes: list[Json] = []
    for colour in tufted.plan.colours:
        shown = tufted.cones[colour.label].colour
        for stroke in colour.strokes:
            begin, end = moments[2 * len(strokes) : 2 * len(strokes) + 2]
            points = np.round(np.stack([stroke.real, stroke.imag], axis=1) / _STEP).astype(int)
            strokes.append([shown, begin, end, points.ravel().tolist()])
    plan = tufted.plan
    size = [round(side / _STEP) for side in (plan.width, plan.length, plan.spacing)]
    return {"strokes": strokes, "size": size, "end": moments[-1]}
