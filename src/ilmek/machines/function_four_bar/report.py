"""Checks, tables and figures of a four-bar for a function."""

import dataclasses

import numpy as np

from ilmek.dynamics.animation import animated, frames
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.machines.four_bar_figures import drawn
from ilmek.machines.function_four_bar.design import FunctionFourBar
from ilmek.report import Animation, Axis, Check, Drawing, Figure, Mark, Plot, Reading, Series, Table, at_most, columns
from ilmek.synthesis import selection_report as shared
from ilmek.synthesis.approximation.exchange import PROVEN
from ilmek.synthesis.approximation.function_generator import FunctionApproximation
from ilmek.synthesis.selection import FourBarOption, finite
from ilmek.units import format_number, format_quantity


def self_tests(design: FunctionFourBar) -> tuple[Check, ...]:
    """A minimax reaches its bound, a least squares is stationary."""
    found, criterion = design.approximation, design.params.criterion
    if found is None or criterion == "interpolation":
        return ()
    name = "error above the bound of its alternation" if criterion == "minimax" else "slope of its error"
    return (at_most(name, found.gap, PROVEN, "1", "the criterion"),)


def tables(design: FunctionFourBar) -> tuple[Table, ...]:
    """Errors of the solutions, the solutions, and the extremes of the error of the one that is drawn."""
    found = design.approximation
    return (
        *((_error_table(design),) if design.choice.kept else ()),
        *shared.tables(design.choice, "function-four-bar"),
        *(() if found is None else (_extreme_table(found),)),
    )


def _error_table(design: FunctionFourBar) -> Table:
    heads = columns(
        *("solution", "greatest error [deg]", "root mean square [deg]", "greatest error of y"),
        *("crank at the start [deg]", "rocker at the start [deg]", "proven"),
    )
    rows = tuple((at, *_errors(one)) for at, one in enumerate(design.choice.kept, 1))
    return Table("function-four-bar-errors", "Errors of the solutions", heads, rows, brief=True)


def _errors(option: FourBarOption) -> tuple[float | str, ...]:
    names = ("error_max", "error_rms", "y_error_max", "crank_start", "rocker_start")
    return *(finite(option.details[name]) for name in names), "yes" if option.details["proven"] else "no"


def _extreme_table(found: FunctionApproximation) -> Table:
    heads = columns("extreme", "x", "error of the rocker [deg]")
    rows = tuple(
        (at, float(x), float(error)) for at, (x, error) in enumerate(zip(found.at, found.errors, strict=True), 1)
    )
    title = f"Extremes of the error: at most {format_quantity(found.greatest, 'deg')}"
    return Table("function-four-bar-extremes", title, heads, rows, brief=True)


def figures(design: FunctionFourBar) -> tuple[Figure, ...]:
    """The solution as drawn and in motion, its error and its function; the required one alone where there is none."""
    best, found = design.best, design.approximation
    if best is None or found is None:
        return (_required(design),)
    title = f"Solution {design.choice.number} where it shows x = {format_number(found.drawn_at)}"
    still = Drawing("function-four-bar", title, (), note="Its error vanishes there.")
    return (drawn(best.candidate, still), _moving(design, found), _error(found), _generated(found))


def _error(approximation: FunctionApproximation) -> Plot:
    """Structural error over the range, its extremes marked."""
    marks = tuple(Mark(float(x), "") for x in approximation.at)
    series = (Series("error of the rocker", approximation.curve.x, approximation.curve.error),)
    note = f"At most {format_quantity(approximation.greatest, 'deg')}; lines: its {len(approximation.at)} extremes."
    return Plot("function-four-bar-error", "Structural error", Axis("x"), Axis("error", "deg"), series, marks, note)


def _generated(approximation: FunctionApproximation) -> Plot:
    """Rotation of the rocker, required and generated."""
    x, curve = approximation.curve.x, approximation.curve
    series = (Series("generated", x, curve.generated), Series("required", x, curve.required, dashed=True))
    axes = Axis("x"), Axis("rotation of the rocker", "deg")
    return Plot("function-four-bar-shown", "Generated function", *axes, series)


def _required(design: FunctionFourBar) -> Plot:
    function = design.function
    x = np.linspace(function.start, function.stop, 181)
    axes = Axis("x"), Axis("rotation of the rocker", "deg")
    return Plot("function-four-bar-wanted", "Required function", *axes, (Series("required", x, function.rocker(x)),))


def _moving(design: FunctionFourBar, approximation: FunctionApproximation) -> Animation:
    """The four-bar over the range, with the x and the y that it shows."""
    function, four_bar = design.function, approximation.four_bar
    start = four_bar.crank_angle - float(function.crank(np.array([approximation.drawn_at]))[0])
    angles = frames(*sorted((start, start + function.crank_swing)))
    motion = solve(plan(four_bar.mechanism()), angles).require()
    x = function.start + (angles - start) / function.crank_swing * (function.stop - function.start)
    rising = np.argsort(approximation.curve.x)
    turned = np.interp(x, approximation.curve.x[rising], approximation.curve.generated[rising])
    first, last = function.range
    y = first + turned / function.rocker_swing * (last - first)
    drawing = Drawing("function-four-bar-moving", "Over the range", ())
    moved = animated(motion, angles, drawing, start=four_bar.crank_angle if function.crank_swing > 0 else None)
    return dataclasses.replace(moved, readings=(Reading("x", x), Reading("y", y)))
