"""A four-bar for a function: found by the criterion, judged all over the range, sieved."""

from dataclasses import dataclass

import numpy as np

from ilmek.machines.four_bars.choice import FourBarOption, FourBarSelection, choose
from ilmek.machines.four_bars.filter_params import filters
from ilmek.machines.function_four_bar.params import CRITERIA, FunctionFourBarParams
from ilmek.report import Json
from ilmek.synthesis.approximation.function_generator import FunctionApproximation, function_approximations
from ilmek.synthesis.candidate import Candidate, judge
from ilmek.synthesis.function import Function
from ilmek.synthesis.task import MET, PrecisionTask

SAME = 1e-9
"""Distance of two places, in ranges of x, below which they are one."""

ROUNDING = 1e-6
"""Share of an error that may be rounding."""


@dataclass(frozen=True, slots=True, eq=False)
class FunctionFourBar:
    """Four-bars for a function.

    function  that is wanted      choice  those kept and removed
    found     what the method says of each, by the four-bar
    """

    params: FunctionFourBarParams
    function: Function
    choice: FourBarSelection
    found: tuple[FunctionApproximation, ...]

    @property
    def best(self) -> FunctionApproximation | None:
        """What the method says of the solution that is drawn."""
        option = self.choice.best
        if option is None:
            return None
        return next(one for one in self.found if one.four_bar is option.candidate.four_bar)


def design(params: FunctionFourBarParams) -> FunctionFourBar:
    """All four-bars that were found for the function.

    Raises ParameterError for what is no function, and where a whole family of four-bars generates it.
    """
    function = params.wanted()
    answers = function_approximations(
        function,
        CRITERIA[params.criterion],
        crank_start=params.crank_start,
        rocker_start=params.rocker_start,
        ground=params.ground,
    )
    ranks = {id(one.four_bar): float(at) for at, one in enumerate(answers.found)}
    options = [
        FourBarOption(_judged(params, function, one), params.criterion, _said(function, one)) for one in answers.found
    ]
    choice = choose(
        options,
        filters(params),
        number=params.chosen,
        count=params.count,
        other=answers.left_out,
        least=lambda one: (ranks[id(one.candidate.four_bar)], 0.0),
    )
    return FunctionFourBar(params, function, choice, answers.found)


def _judged(params: FunctionFourBarParams, function: Function, found: FunctionApproximation) -> Candidate:
    """The four-bar judged where it is exact, or at the extremes of its error, within the greatest."""
    exact = params.criterion == "interpolation" and params.error_max is None
    asked = function.nodes(_free(params)) if exact else found.at
    apart = np.abs(asked - found.drawn_at) > SAME * abs(function.stop - function.start)
    x = np.concatenate([[found.drawn_at], asked[apart]])
    near = params.error_max or (MET if exact else found.greatest * (1 + ROUNDING) + MET)
    return judge(
        found.four_bar, PrecisionTask(crank=function.crank(x), rocker=function.rocker(x), angle_tolerance=near)
    )


def _free(params: FunctionFourBarParams) -> int:
    """Places at which a four-bar can be exact."""
    return 3 + sum(start is None for start in (params.crank_start, params.rocker_start))


def _said(function: Function, found: FunctionApproximation) -> dict[str, Json]:
    """What the method says, by the names of the JSON."""
    four_bar, at = found.four_bar, np.array([found.drawn_at])
    alternation: list[Json] = [
        {"x": float(x), "error": float(error)} for x, error in zip(found.at, found.errors, strict=True)
    ]
    first, last = function.range
    return {
        "x_drawn": found.drawn_at,
        "crank_start": four_bar.crank_angle - float(function.crank(at)[0]),
        "rocker_start": four_bar.rocker_angle - float(function.rocker(at)[0]),
        "error_max": found.greatest,
        "error_rms": found.rms,
        "y_error_max": abs(found.greatest * (last - first) / function.rocker_swing),
        "extremes": alternation,
        "bound": found.bound if np.isfinite(found.bound) else None,
        "gap": found.gap,
        "proven": bool(found.proven),
    }
