"""A four-bar for a function: found by the criterion, judged over the whole range, filtered."""

import math
from dataclasses import replace

import numpy as np

from ilmek.machines.function_four_bar.params import CRITERIA, FunctionFourBarParams
from ilmek.records import record
from ilmek.report import Json
from ilmek.synthesis.approximation.function_generator import FunctionApproximation, function_approximations
from ilmek.synthesis.candidate import Candidate, judge
from ilmek.synthesis.function import Function
from ilmek.synthesis.selection import (
    FourBarDesign,
    FourBarOption,
    choose,
    detail_of_best,
    finite,
    ranked_by_error,
    solutions,
)
from ilmek.synthesis.task import TOLERANCE, PrecisionTask

SAME = 1e-9
"""Distance of two points, in ranges of x, below which they are one."""

ROUNDING = 1e-6
"""Share of an error that may be rounding."""


@record
class FunctionFourBar(FourBarDesign):
    """Four-bars for a function.

    function        required
    approximations  the method's answers for the solutions, in their order
    """

    params: FunctionFourBarParams
    function: Function
    approximations: tuple[FunctionApproximation, ...]

    error_max = detail_of_best("deg", "greatest error of the rocker over the range", "error_max")
    error_rms = detail_of_best("deg", "root of the mean square error over the range", "error_rms")
    y_error_max = detail_of_best("", "the greatest error as one of y", "y_error_max")
    crank_start = detail_of_best("deg", "angle of the crank at the start, from the ground link", "crank_start")
    rocker_start = detail_of_best("deg", "angle of the rocker at the start", "rocker_start")
    solutions = solutions(
        "x_drawn; crank_start, rocker_start from the ground link; error_max, error_rms of the rocker, y_error_max; "
        "extremes [{x, error}]; bound, gap, proven"
    )

    @property
    def approximation(self) -> FunctionApproximation | None:
        """The method's answer for the solution that is drawn; None where there is none."""
        return None if self.choice.number is None else self.approximations[self.choice.number - 1]


def design(params: FunctionFourBarParams) -> FunctionFourBar:
    """All four-bars that were found for the function, the least error first; by merit within `error_max`.

    Raises ParameterError where there is no such function, and where a whole family of four-bars generates it.
    """
    function = params.required_function()
    answers = function_approximations(
        function,
        CRITERIA[params.criterion],
        crank_start=params.crank_start,
        rocker_start=params.rocker_start,
        ground=params.ground,
    )
    options = [
        FourBarOption(_judged(params, function, one), params.criterion, _details(function, one))
        for one in answers.found
    ]
    error = "error_rms" if params.criterion == "least-squares" else "error_max"
    tolerated = params.error_max is not None
    ranked = ranked_by_error(options, lambda one: finite(one.details[error]), tolerated=tolerated)
    choice = choose(ranked, tuple(answers.left_out), params, rank=ranked.index)
    candidates = [option.candidate for option in options]
    kept = tuple(answers.found[candidates.index(one.candidate)] for one in choice.kept)
    return FunctionFourBar(choice=choice, params=params, function=function, approximations=kept)


def _judged(params: FunctionFourBarParams, function: Function, approximation: FunctionApproximation) -> Candidate:
    """The four-bar judged where it is exact, or at the extremes of its error, within the greatest.

    Transmission angle and size are those over the range, also where it goes beyond the first and last exact position.
    """
    exact = params.criterion == "interpolation" and params.error_max is None
    nodes = function.nodes(params.free_points) if exact else approximation.at
    apart = np.abs(nodes - approximation.drawn_at) > SAME * abs(function.stop - function.start)
    x = np.concatenate([[approximation.drawn_at], nodes[apart]])
    near = params.error_max or (TOLERANCE if exact else approximation.greatest * (1 + ROUNDING) + TOLERANCE)
    judged = judge(
        approximation.four_bar, PrecisionTask(crank=function.crank(x), rocker=function.rocker(x), angle_tolerance=near)
    )
    ends = np.array([approximation.drawn_at, function.start, function.stop])
    task = PrecisionTask(crank=function.crank(ends), rocker=function.rocker(ends), angle_tolerance=np.pi)
    over = judge(approximation.four_bar, task)
    return replace(judged, transmission=over.transmission, size=over.size)


def _details(function: Function, approximation: FunctionApproximation) -> dict[str, Json]:
    """The method's answer by the names of the JSON."""
    four_bar, at = approximation.four_bar, np.array([approximation.drawn_at])
    first, last = function.range
    return {
        "x_drawn": approximation.drawn_at,
        "crank_start": four_bar.crank_angle - float(function.crank(at)[0]),
        "rocker_start": four_bar.rocker_angle - float(function.rocker(at)[0]),
        "error_max": approximation.greatest,
        "error_rms": approximation.rms,
        "y_error_max": abs(approximation.greatest * (last - first) / function.rocker_swing),
        "extremes": [{"x": x, "error": error} for x, error in zip(approximation.at, approximation.errors, strict=True)],
        "bound": None if math.isnan(approximation.bound) else approximation.bound,
        "gap": approximation.gap,
        "proven": bool(approximation.proven),
    }
