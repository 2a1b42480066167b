"""Four-bars that answer a task, told: results, tables, checks and warnings that all their machines share."""

import math
from collections.abc import Mapping, Sequence

from ilmek.machines.four_bars.choice import FourBarOption, FourBarSelection
from ilmek.report import Check, Column, Json, Result, Table, at_least
from ilmek.synthesis.candidate import Candidate, PositionResult
from ilmek.synthesis.filters import REASONS
from ilmek.synthesis.four_bar import FourBar
from ilmek.units import deg, format_quantity

TRANSMISSION = 40 * deg
RULE = "rule of thumb for rockers"

LISTED, BRIEF = 20, 6
"""Removed four-bars that the table lists, and that a terminal lists; the JSON has them all."""

NAMED = (
    "ground, crank, coupler, rocker; pins a0, b0, a, b and tracer as drawn at the first position, tracer_on_coupler "
    "(x from A to B); branch; grashof, crank_turns; of each position crank_angles, circuits, branches and errors; "
    "order; transmission [least, greatest], transmission_min; link_ratio; size"
)


def place(at: complex | None) -> Json:
    """A place as [x, y]."""
    return None if at is None else [at.real, at.imag]


def numbers(values: Sequence[float]) -> list[Json]:
    """Numbers as JSON has them; what does not exist is None."""
    return [float(value) if math.isfinite(value) else None for value in values]


def built(four_bar: FourBar) -> dict[str, Json]:
    """A four-bar: links, pins and tracer as drawn, branch."""
    return {
        **four_bar.lengths._asdict(),
        "a0": place(four_bar.a0),
        "b0": place(four_bar.b0),
        "a": place(four_bar.a),
        "b": place(four_bar.b),
        "tracer": place(four_bar.tracer),
        "tracer_on_coupler": place(four_bar.tracer_on_coupler),
        "branch": four_bar.branch,
        "grashof": four_bar.grashof.kind,
    }


def solution(option: FourBarOption) -> dict[str, Json]:
    """A solution, SI and radians: see NAMED."""
    one = option.candidate
    return {
        **built(one.four_bar),
        "crank_turns": one.crank_turns,
        "crank_angles": numbers([met.crank_angle for met in one.positions]),
        "circuits": [met.circuit for met in one.positions],
        "branches": [met.branch for met in one.positions],
        "point_errors": numbers([met.point_error for met in one.positions]),
        "coupler_errors": numbers([met.coupler_error for met in one.positions]),
        "rocker_errors": numbers([met.rocker_error for met in one.positions]),
        "order": list(one.order),
        "transmission": numbers(one.transmission),
        "transmission_min": one.least_transmission,
        "link_ratio": one.link_ratio,
        "size": one.size,
        "made": option.made,
        **option.more,
    }


def results(choice: FourBarSelection, extra: str = "") -> tuple[Result, ...]:
    """Every solution, the one that is drawn, and what was removed.

    extra  what the method says of each solution besides, in words
    """
    solutions: list[Json] = [solution(one) for one in choice.kept]
    removed: list[Json] = [_removed(*one) for one in choice.removed]
    counts: dict[str, Json] = dict(choice.counts)
    number = None if choice.chosen is None else choice.chosen + 1
    named = f"{NAMED}; {extra}" if extra else NAMED
    return (
        Result("sieve", choice.words, "", "what became of all four-bars that were found"),
        *_of_chosen(choice),
        Result("chosen", number, "", "number of the solution that is drawn, from 1"),
        Result("solutions", solutions, "", f"the best first, SI and radians: {named}", False),
        Result("removed", removed, "", "four-bars that were removed: links, how made, reasons by filter", False),
        Result("removed_counts", counts, "", "how many failed each filter", False),
        Result("no_four_bar", list(choice.other), "", "what was found and is no four-bar, in words"),
    )


def _of_chosen(choice: FourBarSelection) -> tuple[Result, ...]:
    if choice.best is None:
        return ()
    one = choice.best.candidate
    links = one.four_bar.lengths
    return (
        Result("ground", links.ground, "mm", "of the solution that is drawn: A0 to B0"),
        Result("crank", links.crank, "mm", "A0 to A, driven"),
        Result("coupler", links.coupler, "mm", "A to B"),
        Result("rocker", links.rocker, "mm", "B0 to B"),
        Result("grashof", one.grashof.kind, "", "class of the four-bar"),
        Result("transmission_min", one.least_transmission, "deg", "least angle between coupler and rocker"),
        Result("size", one.size, "mm", "greatest extent over its motion"),
    )


def _removed(option: FourBarOption, reasons: Mapping[str, str]) -> dict[str, Json]:
    four_bar = option.candidate.four_bar
    pins: dict[str, Json] = {name: place(getattr(four_bar, name)) for name in ("a0", "b0", "a", "b", "tracer")}
    return {**four_bar.lengths._asdict(), **pins, "made": option.made, "reasons": dict(reasons)}


def tables(choice: FourBarSelection, name: str) -> tuple[Table, ...]:
    """Candidates, the positions of the one that is drawn, and what was removed."""
    found = [ranking(choice, name)]
    if choice.best is not None:
        found.append(positions(choice.best.candidate, name))
    if choice.removed:
        found.append(_removed_table(choice, name))
    return tuple(found)


LINKS = (Column("ground", "mm"), Column("crank", "mm"), Column("coupler", "mm"), Column("rocker", "mm"))


def ranking(choice: FourBarSelection, name: str) -> Table:
    """The solutions, the best first."""
    columns = (
        Column("solution"),
        *LINKS,
        Column("class"),
        Column("least μ", "deg"),
        Column("link ratio"),
        Column("size", "mm"),
        Column("made of"),
    )
    rows = tuple(
        (
            at + 1,
            *one.candidate.four_bar.lengths,
            one.candidate.grashof.kind,
            one.candidate.least_transmission,
            one.candidate.link_ratio,
            one.candidate.size,
            one.made,
        )
        for at, one in enumerate(choice.kept)
    )
    more = f", and {choice.more} more" if choice.more else ""
    return Table(
        f"{name}-solutions", f"Solutions, the best first{more}; μ: transmission angle", columns, rows, brief=True
    )


ERRORS = (
    ("point_error", Column("point missed by", "mm")),
    ("coupler_error", Column("coupler angle missed by", "deg")),
    ("rocker_error", Column("rocker angle missed by", "deg")),
)


def positions(one: Candidate, name: str) -> Table:
    """How each position is met, by moving the four-bar."""
    asked = [(error, column) for error, column in ERRORS if any(_known(met, error) for met in one.positions)]
    columns = (
        Column("position"),
        Column("crank angle", "deg"),
        Column("circuit"),
        Column("branch"),
        *(column for _, column in asked),
    )
    rows = tuple(
        (at, met.crank_angle, met.circuit, met.branch, *(getattr(met, error) for error, _ in asked))
        for at, met in enumerate(one.positions, 1)
    )
    return Table(f"{name}-positions", "Positions of the solution that is drawn, by moving it", columns, rows)


def _known(met: PositionResult, error: str) -> bool:
    return not math.isnan(getattr(met, error))


def _removed_table(choice: FourBarSelection, name: str) -> Table:
    columns = (Column("made of"), *LINKS, Column("removed because"))
    rows = tuple(
        (one.made, *one.candidate.four_bar.lengths, "; ".join(reasons.values()))
        for one, reasons in choice.removed[:LISTED]
    )
    left = len(choice.removed) - len(rows)
    counted = ", ".join(f"{REASONS[kind]} {count}" for kind, count in choice.counts.items())
    title = f"Removed: {counted}" + (f" ({left} more are in the JSON)" if left else "")
    return Table(f"{name}-removed", title, columns, rows, brief=len(rows) <= BRIEF)


def checks(choice: FourBarSelection) -> tuple[Check, ...]:
    """A solution is there, and its transmission angle is fit."""
    there = at_least("four-bars without defects", len(choice.kept) + choice.more, 1, "1", "the task")
    if choice.best is None:
        return (there,)
    least = choice.best.candidate.least_transmission
    return there, at_least("transmission angle", least, TRANSMISSION, "deg", RULE)


def warnings(choice: FourBarSelection) -> tuple[str, ...]:
    """What a reader should not overlook."""
    if choice.best is None:
        if not choice.removed:
            return ("there is no four-bar: change the task", *choice.other)
        return (f"no four-bar is left: {choice.words}; loosen a filter to see one, or change the task", *choice.other)
    least = choice.best.candidate.least_transmission
    if least >= TRANSMISSION:
        return ()
    shown = format_quantity(least, "deg")
    return (f"coupler and rocker come within {shown} of one line: forces grow, play shows; set transmission_min",)
