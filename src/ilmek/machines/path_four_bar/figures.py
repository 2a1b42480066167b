"""A four-bar for a path, drawn: the points, its coupler curve, itself in motion, and its cognates."""

from ilmek.machines.four_bars.figures import curve, drawn, links, moving, pins
from ilmek.machines.path_four_bar.design import PathFourBar
from ilmek.report import Dot, Drawing, Figure, Stroke
from ilmek.synthesis.candidate import Candidate
from ilmek.units import format_quantity

NUMBERED = 12
"""Points that are named by their numbers; of more, the first alone."""


def figures(design: PathFourBar) -> tuple[Figure, ...]:
    """The solution at its first point and in motion, and its cognates where they are asked for."""
    best = design.choice.best
    if best is None:
        return (Drawing("path-four-bar", "The points of the path", (), _points(design)),)
    title = f"Solution {(design.choice.chosen or 0) + 1} at its first point"
    note = f"Misses no point by more than {format_quantity(best.candidate.point_error, 'mm')}."
    still = Drawing("path-four-bar", title, (), note=note)
    moved = moving(best.candidate, Drawing("path-four-bar-moving", "The same in motion", (), _points(design)))
    shown = drawn(best.candidate, still, (), _points(design))
    return (shown, *((moved,) if moved else ()), *_cognates(design))


def _points(design: PathFourBar) -> tuple[Dot, ...]:
    every = len(design.points) <= NUMBERED
    return tuple(
        Dot(complex(point), str(at) if every or at == 1 else "", "point") for at, point in enumerate(design.points, 1)
    )


def _cognates(design: PathFourBar) -> tuple[Drawing, ...]:
    """All three four-bars that draw the curve, where the curve is at its first point."""
    best = design.choice.best
    if best is None or not design.cognates:
        return ()
    family = [("original", best.candidate), *design.cognates]
    strokes = [stroke for name, one in family for stroke in _named(name, one)]
    third = design.cognates[0][1].four_bar
    pivots = Dot(third.a0 if design.cognates[0][0] == "timed" else third.b0, "C0", "pivot")
    moved = [Dot(at, "") for _, one in design.cognates for at in (one.four_bar.a, one.four_bar.b)]
    note = "Dashed: on C0 and B0 the one that turns with the crank, on A0 and C0 the one that turns with the coupler."
    every = (*curve(best.candidate), *strokes)
    dots = (*moved, pivots, *pins(best.candidate.four_bar))
    return (Drawing("path-four-bar-cognates", "Three four-bars that draw one curve", every, dots, note=note),)


def _named(name: str, one: Candidate) -> tuple[Stroke, ...]:
    """Links of the original in full, of the others as outlines."""
    if name == "original":
        return links(one.four_bar)
    return tuple(Stroke(stroke.points, "construction", closed=stroke.closed) for stroke in links(one.four_bar))
