"""The knotting dyad's figures: every arm to scale at the first point, the points, and the way of the yarn."""

import numpy as np

from ilmek.carpet.knot_path import warp_places
from ilmek.machines.knotting_dyad.design import KnottingDyad
from ilmek.machines.knotting_dyad.task import Task
from ilmek.report import Dot, Drawing, Figure, Stroke
from ilmek.synthesis.dyad import Dyad
from ilmek.units import format_quantity, turn


def figures(design: KnottingDyad) -> tuple[Figure, ...]:
    """All arms in one drawing, and the arm to build in its four poses."""
    return (drawing(design),) if design.chosen is None else (drawing(design), poses(design))


def drawing(design: KnottingDyad) -> Drawing:
    """Every arm at the first point; a link without length is left out."""
    links = [one for at, dyad in enumerate(design.dyads) for one in _arm(design, dyad, 0, f"{at + 1}: ")]
    pivots = [Dot(dyad.pivot, f"O{at + 1}", "pivot") for at, dyad in enumerate(design.dyads)]
    note = "All at the first point P1. O: pivots."
    title = "Every arm through the four timed points"
    return Drawing("knotting-dyad", title, (*_yarn(design.task), *links), (*pivots, *_points(design)), note=note)


def poses(design: KnottingDyad) -> Drawing:
    """The arm to build at the first point, the others dashed."""
    dyad = design.dyads[design.chosen or 0]
    elbows = design.joints(dyad)
    others = [Stroke(np.array([dyad.pivot, elbows[at], design.task.points[at]]), "construction") for at in range(1, 4)]
    dots = (Dot(dyad.pivot, "O", "pivot"), Dot(complex(elbows[0]), "A"), *_points(design))
    strokes = (*_yarn(design.task), *others, *_arm(design, dyad, 0, ""))
    note = "At the first point P1, the other poses dashed."
    return Drawing("knotting-dyad-poses", f"Arm {(design.chosen or 0) + 1}, the one to build", strokes, dots, note=note)


def _arm(design: KnottingDyad, dyad: Dyad, at: int, said: str) -> tuple[Stroke, ...]:
    elbow, point = complex(design.joints(dyad)[at]), complex(design.task.points[at])
    second = Stroke(np.array([elbow, point]), "link", f"{said}{format_quantity(dyad.second, 'mm')}")
    if not dyad.first:
        return (second,)
    return Stroke(np.array([dyad.pivot, elbow]), "link", f"{said}{format_quantity(abs(dyad.first), 'mm')}"), second


def _points(design: KnottingDyad) -> tuple[Dot, ...]:
    return tuple(Dot(complex(point), f"P{at + 1}", "point") for at, point in enumerate(design.task.points))


def _yarn(task: Task) -> tuple[Stroke, ...]:
    """The knot that the points were chosen on: its warps and the way of the arm's end."""
    if task.path is None:
        return ()
    size = task.path.dimensions
    ring = size.warp_diameter / 2 * np.exp(1j * turn * np.arange(48) / 48)
    places = warp_places(task.path.knot.warps, size.pitch)
    return (
        *(Stroke(place + ring, "outline", closed=True, filled=True) for place in places),
        Stroke(task.course, "yarn"),
    )
