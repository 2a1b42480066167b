"""What a four-bar for a function says: results, checks, tables and figures."""

import math
from collections.abc import Mapping

from ilmek.machines.four_bars import report as told
from ilmek.machines.function_four_bar.design import FunctionFourBar
from ilmek.machines.function_four_bar.figures import figures
from ilmek.report import Check, Column, Json, Report, Result, Table, at_most
from ilmek.synthesis.approximation.exchange import PROVEN
from ilmek.units import format_quantity

EXTRA = (
    "x_drawn; crank_start, rocker_start from the ground link; error_max, error_rms of the rocker, y_error_max; "
    "extremes [{x, error}]; bound, gap, proven"
)


def report(design: FunctionFourBar) -> Report:
    """Everything that the design says."""
    return Report(
        machine="function-four-bar",
        title="Four-bar for a function",
        parameters=design.params.as_dict(),
        results=(*_error(design), *told.results(design.choice, EXTRA)),
        checks=(*told.checks(design.choice), *_proof(design)),
        tables=(*_error_table(design), *told.tables(design.choice, "function-four-bar"), *_extreme_table(design)),
        figures=figures(design),
        warnings=told.warnings(design.choice),
    )


def _error(design: FunctionFourBar) -> tuple[Result, ...]:
    option = design.choice.best
    if option is None:
        return ()
    said = option.more
    return (
        Result("error_max", said["error_max"], "deg", "greatest error of the rocker over the range"),
        Result("error_rms", said["error_rms"], "deg", "root of the mean square error over the range"),
        Result("y_error_max", said["y_error_max"], "", "the greatest error as one of y"),
        Result("crank_start", said["crank_start"], "deg", "angle of the crank at the start, from the ground link"),
        Result("rocker_start", said["rocker_start"], "deg", "angle of the rocker at the start"),
    )


def _proof(design: FunctionFourBar) -> tuple[Check, ...]:
    """A minimax reaches its bound, a least squares is stationary."""
    best = design.best
    if best is None or design.params.criterion == "interpolation":
        return ()
    words = "error above the bound of its alternation" if design.params.criterion == "minimax" else "slope of its error"
    return (at_most(words, best.gap, PROVEN, "1", "the criterion"),)


def _error_table(design: FunctionFourBar) -> tuple[Table, ...]:
    if not design.choice.kept:
        return ()
    columns = (
        Column("solution"),
        Column("greatest error", "deg"),
        Column("root mean square", "deg"),
        Column("greatest error of y"),
        Column("crank at the start", "deg"),
        Column("rocker at the start", "deg"),
        Column("proven"),
    )
    rows = tuple((at, *_row(one.more)) for at, one in enumerate(design.choice.kept, 1))
    return (Table("function-four-bar-errors", "How near the solutions come", columns, rows, brief=True),)


def _row(said: Mapping[str, Json]) -> tuple[float | str, ...]:
    names = ("error_max", "error_rms", "y_error_max", "crank_start", "rocker_start")
    values = (said[name] for name in names)
    return *(one if isinstance(one, float) else math.nan for one in values), "yes" if said["proven"] else "no"


def _extreme_table(design: FunctionFourBar) -> tuple[Table, ...]:
    best = design.best
    if best is None:
        return ()
    columns = (Column("extreme"), Column("x"), Column("error of the rocker", "deg"))
    rows = tuple(
        (at, float(x), float(error)) for at, (x, error) in enumerate(zip(best.at, best.errors, strict=True), 1)
    )
    most = format_quantity(best.greatest, "deg")
    return (Table("function-four-bar-extremes", f"Extremes of the error: at most {most}", columns, rows, brief=True),)
