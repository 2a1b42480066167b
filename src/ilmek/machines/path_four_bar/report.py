"""Tables and figures of a four-bar for a path."""

import math

from ilmek.machines.four_bar_figures import curve, drawn_and_moving, links, numbered, pins
from ilmek.machines.path_four_bar.design import PathFourBar
from ilmek.report import Dot, Drawing, Figure, Stroke, Table, columns, rounded
from ilmek.synthesis.path.confidence import SOUGHT
from ilmek.synthesis.selection import FourBarOption, finite
from ilmek.synthesis.selection_report import LINKS
from ilmek.synthesis.selection_report import tables as shared_tables
from ilmek.synthesis.selection_report import warnings as shared_warnings
from ilmek.units import format_quantity

NUMBERED = 12
"""Points that are shown with their numbers; of more, the first alone."""

MERITS = 1.5
"""Ratio of merits from which a farther solution is named."""

CRANKS = {"timed": "turns with the crank of the solution", "other": "turns with the coupler of the solution"}
"""The crank of each cognate."""


def tables(design: PathFourBar) -> tuple[Table, ...]:
    """Errors of a search's solutions, the solutions, and the cognates of the one that is drawn."""
    searched = not design.params.exact and design.best is not None
    return (
        *((_search_table(design),) if searched else ()),
        *((_proof_table(design),) if design.complete is not None and design.best is not None else ()),
        *shared_tables(design.choice, "path-four-bar"),
        *((_cognate_table(design),) if design.cognates else ()),
    )


def _search_table(design: PathFourBar) -> Table:
    heads = columns(
        *("solution", "greatest error [mm]", "root mean square [mm]", "sum of squares [mm^2]"),
        *("runs that agree", "active limits"),
    )
    rows = tuple((at, *_search_row(one)) for at, one in enumerate(design.choice.kept, 1))
    return Table("path-four-bar-search", "Errors of the solutions", heads, rows, brief=True)


def _search_row(option: FourBarOption) -> tuple[float | int | str, ...]:
    agreed, active = option.details["runs_agreed"], option.details["active"]
    return (
        *(finite(option.details[name]) for name in ("error_max", "error_rms", "error_squares")),
        agreed if isinstance(agreed, int) else 0,
        "; ".join(str(limit) for limit in active) if isinstance(active, list) else "",
    )


def _proof_table(design: PathFourBar) -> Table:
    heads = columns("solution", "curve", "proven", "exact pins within [mm]", "greatest error [mm]")
    rows = tuple(
        (
            at,
            str(one.details["curve"]),
            "yes" if one.certified else "no",
            finite(one.details["within"]),
            finite(one.details["error_max"]),
        )
        for at, one in enumerate(design.choice.kept, 1)
    )
    return Table("path-four-bar-proof", "Proof of the solutions; cognates have one curve", heads, rows, brief=True)


def _cognate_table(design: PathFourBar) -> Table:
    heads = columns("its crank", *LINKS, "class", "greatest error [mm]")
    rows = tuple(
        (CRANKS[name], *one.four_bar.lengths, one.grashof.kind, one.point_error) for name, one in design.cognates
    )
    return Table("path-four-bar-cognates", "The cognates: the same curve", heads, rows, brief=True)


def warnings(design: PathFourBar) -> tuple[str, ...]:
    """Those of all four-bars, a better four-bar that is not much farther, and whether the search is likely complete."""
    return (*shared_warnings(design), *_better_built(design), *_unsure(design))


def _better_built(design: PathFourBar) -> tuple[str, ...]:
    """The first solution with a much better merit, where the one that is drawn is the first."""
    kept = design.choice.kept
    if design.searched is None or not kept or kept[0].merit is None or design.choice.number != 1:
        return ()
    for at, one in enumerate(kept[1:], 2):
        error = finite(one.details["error_rms"])
        if one.merit is not None and one.merit.value > MERITS * kept[0].merit.value and math.isfinite(error):
            first = finite(kept[0].details["error_rms"])
            errors = f"{format_quantity(error, 'mm')} from the points, solution 1 {format_quantity(first, 'mm')}"
            merits = f"{one.merit.value:.2f} and {kept[0].merit.value:.2f}"
            return (f"solution {at} comes within {errors} (root mean square); their merits are {merits}",)
    return ()


def _unsure(design: PathFourBar) -> tuple[str, ...]:
    """A warning where a nearer four-bar was probably missed."""
    searched = design.searched
    if searched is None or searched.missed <= SOUGHT:
        return ()
    words = (
        f"{searched.starts} starts in {searched.runs} runs do not agree on the best: with a probability of about "
        f"{searched.missed:.0%} there is a nearer four-bar; set starts higher"
    )
    return (words,)


def figures(design: PathFourBar) -> tuple[Figure, ...]:
    """The solution at its first point and in motion, and its cognates where they are required."""
    best, points = design.best, numbered(design.points)
    if len(points) > NUMBERED:
        points = (points[0], *(Dot(dot.at, "", "point") for dot in points[1:]))
    if best is None:
        return (Drawing("path-four-bar", "The points of the path", (), points),)
    title = f"Solution {design.choice.number} at its first point"
    note = f"Its greatest error is {format_quantity(rounded(best.candidate.point_error, 'mm'), 'mm')}."
    still = Drawing("path-four-bar", title, (), points, note=note)
    return (*drawn_and_moving(best.candidate, still, "The same in motion"), *_cognates(design))


def _cognates(design: PathFourBar) -> tuple[Drawing, ...]:
    """All three four-bars that trace the curve, where the tracer is at its first point."""
    if design.best is None or not design.cognates:
        return ()
    original = design.best.candidate
    others = [one.four_bar for _, one in design.cognates]
    outlines = (
        Stroke(link.points, "construction", closed=link.closed) for four_bar in others for link in links(four_bar)
    )
    pivot = Dot(others[0].a0 if design.cognates[0][0] == "timed" else others[0].b0, "C0", "pivot")
    joints = (Dot(at, "") for four_bar in others for at in (four_bar.a, four_bar.b))
    note = "Dashed: on C0 and B0 the one that turns with the crank, on A0 and C0 the one that turns with the coupler."
    strokes = (*curve(original), *links(original.four_bar), *outlines)
    dots = (*joints, pivot, *pins(original.four_bar))
    return (Drawing("path-four-bar-cognates", "Three four-bars that trace one curve", strokes, dots, note=note),)
