"""Tables, checks and warnings of all machines that synthesise four-bars for a task."""

import math

from ilmek.report import Check, Table, at_least, columns
from ilmek.synthesis.candidate import Candidate
from ilmek.synthesis.selection import FourBarDesign, FourBarSelection
from ilmek.units import deg, format_quantity

TRANSMISSION = 40 * deg
RULE = "rule of thumb for rockers"

LISTED, BRIEF = 20, 6
"""Greatest number of removed four-bars in the table, and on a terminal; the JSON contains all."""

LINKS = ("ground [mm]", "crank [mm]", "coupler [mm]", "rocker [mm]")


def tables(choice: FourBarSelection, name: str) -> tuple[Table, ...]:
    """Solutions, positions of the one that is drawn, and removed four-bars; `name` of the machine."""
    return (
        _solutions(choice, name),
        *(() if choice.best is None else (_positions(choice.best.candidate, name),)),
        *((_removed(choice, name),) if choice.removed else ()),
    )


def _solutions(choice: FourBarSelection, name: str) -> Table:
    heads = columns("solution", *LINKS, "class", "least μ [deg]", "link ratio", "size [mm]", "found by")
    rows = tuple(
        (at, *one.four_bar.lengths, one.grashof.kind, one.least_transmission, one.link_ratio, one.size, option.made)
        for at, option in enumerate(choice.kept, 1)
        for one in (option.candidate,)
    )
    more = f", and {choice.more} more" if choice.more else ""
    return Table(
        f"{name}-solutions", f"Solutions, the best first{more}; μ: transmission angle", heads, rows, brief=True
    )


ERRORS = {
    "point_error": "error of the point [mm]",
    "coupler_error": "error of the coupler angle [deg]",
    "rocker_error": "error of the rocker angle [deg]",
}


def _positions(one: Candidate, name: str) -> Table:
    known = [error for error in ERRORS if not all(math.isnan(getattr(met, error)) for met in one.positions)]
    heads = columns("position", "crank angle [deg]", "circuit", "branch", *(ERRORS[error] for error in known))
    rows = tuple(
        (at, met.crank_angle, met.circuit, met.branch, *(getattr(met, error) for error in known))
        for at, met in enumerate(one.positions, 1)
    )
    return Table(f"{name}-positions", "Positions of the solution that is drawn, from its motion", heads, rows)


def _removed(choice: FourBarSelection, name: str) -> Table:
    rows = tuple(
        (one.made, *one.candidate.four_bar.lengths, "; ".join(reasons.values()))
        for one, reasons in choice.removed[:LISTED]
    )
    left = len(choice.removed) - len(rows)
    title = f"Removed: {choice.reasons}" + (f" ({left} more are in the JSON)" if left else "")
    heads = columns("found by", *LINKS, "reason")
    return Table(f"{name}-removed", title, heads, rows, brief=len(rows) <= BRIEF)


def checks(design: FourBarDesign) -> tuple[Check, ...]:
    """Whether there is a solution, and its transmission angle."""
    choice = design.choice
    found = at_least("four-bars without defects", len(choice.kept) + choice.more, 1, "1", "the task")
    if choice.best is None:
        return (found,)
    least = choice.best.candidate.least_transmission
    return found, at_least("transmission angle", least, TRANSMISSION, "deg", RULE)


def warnings(design: FourBarDesign) -> tuple[str, ...]:
    """Reason why there is no solution, or a warning that coupler and rocker come too near to one line."""
    choice = design.choice
    if choice.best is None:
        if not choice.removed:
            return ("there is no four-bar: change the task", *choice.other)
        return (f"no four-bar is left: {choice.sieve}; loosen a filter to see one, or change the task", *choice.other)
    least = choice.best.candidate.least_transmission
    if least >= TRANSMISSION:
        return ()
    shown = format_quantity(least, "deg")
    return (f"coupler and rocker come within {shown} of one line: forces grow, play shows; set transmission_min",)
