"""What a four-bar for a path says: results, checks, tables and figures."""

import math
from collections.abc import Mapping

from ilmek.machines.four_bars import report as told
from ilmek.machines.path_four_bar.design import PathFourBar, errors
from ilmek.machines.path_four_bar.figures import figures
from ilmek.report import Column, Json, Report, Result, Table
from ilmek.synthesis.candidate import Candidate

EXTRA = (
    "error_max, error_rms and error_squares (sum of squares) of the points; of a search active, starts_agreed, starts"
)


def report(design: PathFourBar) -> Report:
    """Everything that the design says."""
    return Report(
        machine="path-four-bar",
        title="Four-bar for a path",
        parameters=design.params.as_dict(),
        results=(*_nearness(design), *told.results(design.choice, EXTRA), *_cognates(design)),
        checks=told.checks(design.choice),
        tables=(*_search_table(design), *told.tables(design.choice, "path-four-bar"), *_cognate_table(design)),
        figures=figures(design),
        warnings=told.warnings(design.choice),
    )


def _nearness(design: PathFourBar) -> tuple[Result, ...]:
    best = design.choice.best
    if best is None:
        return ()
    found = best.more
    said = [
        Result("error_max", found["error_max"], "mm", "greatest distance from a point, of the solution that is drawn"),
        Result("error_rms", found["error_rms"], "mm", "root mean square of the distances"),
        Result("error_squares", found["error_squares"], "mm^2", "sum of the squared distances"),
    ]
    if "active" in found:
        said += [
            Result("active", found["active"], "", "limits that hold it: without them it would come nearer"),
            Result("starts_agreed", found["starts_agreed"], "", "starts of the search that ended at this error"),
            Result("starts", found["starts"], "", "starts of the search"),
        ]
    return tuple(said)


def _cognates(design: PathFourBar) -> tuple[Result, ...]:
    if not design.cognates:
        return ()
    found: list[Json] = [_cognate(name, one) for name, one in design.cognates]
    meaning = "the other four-bars that draw the same curve: keeps the timing (timed), turns with the coupler (other)"
    return (Result("cognates", found, "", meaning, False),)


def _cognate(name: str, one: Candidate) -> dict[str, Json]:
    return {"name": name, **told.built(one.four_bar), "crank_turns": one.crank_turns, **errors(one)}


def _search_table(design: PathFourBar) -> tuple[Table, ...]:
    """How near each solution of a search comes, how many starts agreed, and what holds it."""
    if design.params.exact or design.choice.best is None:
        return ()
    columns = (
        Column("solution"),
        Column("greatest error", "mm"),
        Column("root mean square", "mm"),
        Column("sum of squares", "mm^2"),
        Column("starts that agree"),
        Column("held by"),
    )
    rows = tuple((at, *_search_row(one.more)) for at, one in enumerate(design.choice.kept, 1))
    return (Table("path-four-bar-search", "How near the solutions come", columns, rows, brief=True),)


def _search_row(found: Mapping[str, Json]) -> tuple[float | int | str, ...]:
    numbers = (found[name] for name in ("error_max", "error_rms", "error_squares"))
    held, agreed = found["active"], found["starts_agreed"]
    return (
        *(one if isinstance(one, float) else math.nan for one in numbers),
        agreed if isinstance(agreed, int) else 0,
        "; ".join(str(one) for one in held) if isinstance(held, list) else "",
    )


SAID = {"timed": "turns with the crank of the solution", "other": "turns with the coupler of the solution"}
"""The crank of each cognate."""


def _cognate_table(design: PathFourBar) -> tuple[Table, ...]:
    if not design.cognates:
        return ()
    columns = (Column("its crank"), *told.LINKS, Column("class"), Column("greatest error", "mm"))
    rows = tuple(
        (SAID[name], *one.four_bar.lengths, one.grashof.kind, one.point_error) for name, one in design.cognates
    )
    return (Table("path-four-bar-cognates", "The cognates: the same curve", columns, rows, brief=True),)
