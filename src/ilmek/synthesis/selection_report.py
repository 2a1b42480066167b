"""Tables, checks and warnings of all machines that synthesise four-bars for a task."""

import math

from ilmek.report import Check, Table, at_least, columns, snap_to_limit
from ilmek.synthesis.candidate import Candidate
from ilmek.synthesis.merit import TRANSMISSION
from ilmek.synthesis.selection import FourBarDesign, FourBarOption, FourBarSelection
from ilmek.units import format_quantity

RULE = "rule of thumb for rockers"

LISTED, BRIEF = 20, 6
"""Greatest number of removed four-bars in the table, and on a terminal; the JSON contains all."""

LINKS = ("ground [mm]", "crank [mm]", "coupler [mm]", "rocker [mm]")


def tables(choice: FourBarSelection, name: str) -> tuple[Table, ...]:
    """Solutions, their merit, positions of the one that is drawn, and removed four-bars; `name` of the machine."""
    return (
        *((_solutions(choice, name),) if choice.kept else ()),
        *((_merits(choice, name),) if choice.kept else ()),
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


def _merits(choice: FourBarSelection, name: str) -> Table:
    apart = any(math.isfinite(one.apart) for one in choice.kept)
    proven = any(one.certified for one in choice.kept)
    heads = columns(
        *("solution", "merit", "μ [deg]", "size / extent", "link ratio", "sensitivity"),
        *("point, links 0.1 mm off [mm]", "angle, links 0.1 mm off [deg]"),
        *(("apart, in extents",) if apart else ()),
        *(("proven exact",) if proven else ()),
    )
    rows = tuple(
        (
            *(at, one.value, one.transmission, one.size, one.ratio, one.sensitivity, one.point_shift, one.angle_shift),
            *((option.apart if math.isfinite(option.apart) else math.nan,) if apart else ()),
            *(("yes" if option.certified else "no",) if proven else ()),
        )
        for at, option in enumerate(choice.kept, 1)
        for one in (option.merit,)
        if one is not None
    )
    return Table(f"{name}-merit", "Merit of the solutions", heads, rows)


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
    some = choice.family is not None and choice.family.searched > len(choice.removed)
    title = "Nearest to the limits" if some and not choice.kept else f"Removed: {choice.reasons}"
    title += f" ({left} more are in the JSON)" if left else ""
    heads = columns("found by", *LINKS, "reason")
    return Table(f"{name}-removed", title, heads, rows, brief=len(rows) <= BRIEF)


def checks(design: FourBarDesign) -> tuple[Check, ...]:
    """Whether there is a solution, and its transmission angle: at least `transmission_min`, or the rule of thumb."""
    choice = design.choice
    cure = "; ".join(choice.cures)
    found = at_least("four-bars without defects", len(choice.kept) + choice.more, 1, "1", "the task").with_cure(cure)
    if choice.best is None:
        return (found,)
    required = design.params.transmission_min
    cure = f"set transmission_min={math.degrees(TRANSMISSION):.4g}deg, or change the task"
    angle = at_least(
        "transmission angle",
        _least(choice.best),
        required or TRANSMISSION,
        "deg",
        "transmission_min" if required else RULE,
    ).with_cure("" if required else cure)
    return found, angle


def warnings(design: FourBarDesign) -> tuple[str, ...]:
    """Reason why there is no solution, or a warning that coupler and rocker come too near to one line."""
    choice = design.choice
    if choice.best is None:
        if choice.family is not None and choice.left_out:
            cures = (
                "; ".join(choice.cures) or "no single limit, loosened alone, gives one: loosen two, or change the task"
            )
            return (f"no four-bar keeps all limits ({choice.reasons}): {cures}", *choice.other)
        if not choice.removed:
            return ("there is no four-bar: change the task", *choice.other)
        cures = f"; {'; '.join(choice.cures)}" if choice.cures else ""
        return (
            f"no four-bar is left: {choice.sieve}; loosen a filter to see one, or change the task{cures}",
            *choice.other,
        )
    least = _least(choice.best)
    if snap_to_limit(least, TRANSMISSION) >= TRANSMISSION:
        return ()
    shown = format_quantity(least, "deg")
    rule = f"the {RULE} is {format_quantity(TRANSMISSION, 'deg')}"
    return (f"coupler and rocker come within {shown} of one line: forces grow, play shows; {rule}",)


def _least(best: FourBarOption) -> float:
    """Least transmission angle over what is required [rad]."""
    return best.candidate.least_transmission if best.merit is None else best.merit.transmission
