"""A four-bar for a function, drawn: its error over the range, what it shows, and itself from start to stop."""

import dataclasses

import numpy as np

from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.machines.animation import animated, frames
from ilmek.machines.four_bars.figures import drawn
from ilmek.machines.function_four_bar.design import FunctionFourBar
from ilmek.report import Animation, Axis, Drawing, Figure, Mark, Plot, Reading, Series
from ilmek.synthesis.approximation.function_generator import FunctionApproximation
from ilmek.units import format_number, format_quantity


def figures(design: FunctionFourBar) -> tuple[Figure, ...]:
    """The solution as drawn and in motion, its error and what it shows; the function alone where there is none."""
    option, best = design.choice.best, design.best
    if option is None or best is None:
        return (_wanted(design),)
    title = f"Solution {(design.choice.chosen or 0) + 1} where it shows x = {format_number(best.drawn_at)}"
    still = Drawing("function-four-bar", title, (), note="Its error vanishes there.")
    return (drawn(option.candidate, still, (), ()), _moving(design, best), _error(best), _shown(best))


def _error(best: FunctionApproximation) -> Plot:
    """Structural error over the range, its extremes marked."""
    greatest = format_quantity(best.greatest, "deg")
    marks = tuple(Mark(float(x), "") for x in best.at)
    series = (Series("error of the rocker", best.curve.x, best.curve.error),)
    note = f"At most {greatest}; lines: its extremes, {len(best.at)} of them."
    return Plot("function-four-bar-error", "Structural error", Axis("x"), Axis("error", "deg"), series, marks, note)


def _shown(best: FunctionApproximation) -> Plot:
    """Turn of the rocker that is wanted, and that it makes."""
    curve = best.curve
    series = (Series("generated", curve.x, curve.generated), Series("wanted", curve.x, curve.wanted, dashed=True))
    title = "What the rocker shows"
    return Plot("function-four-bar-shown", title, Axis("x"), Axis("turn of the rocker", "deg"), series)


def _wanted(design: FunctionFourBar) -> Plot:
    function = design.function
    x = np.linspace(function.start, function.stop, 181)
    series = (Series("wanted", x, function.rocker(x)),)
    return Plot("function-four-bar-wanted", "What is wanted", Axis("x"), Axis("turn of the rocker", "deg"), series)


def _moving(design: FunctionFourBar, best: FunctionApproximation) -> Animation:
    """The four-bar over the range, with the x and the y that it shows."""
    function, four_bar = design.function, best.four_bar
    at = np.array([best.drawn_at])
    start = four_bar.crank_angle - float(function.crank(at)[0])
    low, high = sorted((start, start + function.crank_swing))
    angles = frames(low, high)
    motion = solve(plan(four_bar.mechanism()), angles).require()
    x = function.start + (angles - start) / function.crank_swing * (function.stop - function.start)
    first, last = function.range
    turned = np.interp(x, *_rising(best))
    y = first + turned / function.rocker_swing * (last - first)
    drawing = Drawing("function-four-bar-moving", "Over the range", ())
    moved = animated(motion, angles, drawing, start=four_bar.crank_angle if function.crank_swing > 0 else None)
    return dataclasses.replace(moved, readings=(Reading("x", x), Reading("y", y)))


def _rising(best: FunctionApproximation) -> tuple[np.ndarray, np.ndarray]:
    """Places of the error curve in rising order, and the turn of the rocker there."""
    order = np.argsort(best.curve.x)
    return best.curve.x[order], best.curve.generated[order]
