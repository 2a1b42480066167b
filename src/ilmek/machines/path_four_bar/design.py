"""A four-bar for a path: found, judged, sieved."""

import dataclasses
import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.machines.four_bars.choice import FourBarOption, FourBarSelection, choose
from ilmek.machines.four_bars.filter_params import filters
from ilmek.machines.path_four_bar.params import PathFourBarParams
from ilmek.report import Json
from ilmek.synthesis.candidate import Candidate, judge
from ilmek.synthesis.cognates import cognates
from ilmek.synthesis.path.fit import PathFit, judged
from ilmek.synthesis.path.points import timed_four_bars
from ilmek.synthesis.path.search import path_four_bars
from ilmek.synthesis.path.task import PathTask
from ilmek.synthesis.task import PrecisionTask

CURVES = 12
"""Second links that are looked at on each closed part of the curves of four timed points."""

MET, ROUNDING = 1e-9, 1e-6
"""Shares of a four-bar's size: an error that is none, and of an error, that may be rounding."""


@dataclass(frozen=True, slots=True, eq=False)
class PathFourBar:
    """Four-bars for a path.

    points    [m]      choice  those kept and removed
    cognates  of the one that is drawn, judged as it is; () where they are not asked for
    """

    params: PathFourBarParams
    points: ComplexArray
    choice: FourBarSelection
    cognates: tuple[tuple[str, Candidate], ...]


def design(params: PathFourBarParams) -> PathFourBar:
    """All four-bars for the path.

    Raises ParameterError where the task is none, or no start of the search can be brought within the limits.
    """
    points = params.places()
    options, other = _exact(params, points) if params.exact else (_searched(params), ())
    sieve, rank = filters(params), None
    if not params.exact:  # the search keeps both, and ends at them: a sieve would see them broken by rounding
        sieve, rank = dataclasses.replace(sieve, transmission_min=0.0, full_turn=False), _nearest
    choice = choose(options, sieve, number=params.chosen, count=params.count, other=other, least=rank)
    best = choice.best
    siblings = _siblings(best.candidate) if best is not None and params.cognates else ()
    return PathFourBar(params, points, choice, siblings)


def _nearest(one: FourBarOption) -> tuple[float, float]:
    """The nearest first; among those that meet every point, the best transmission angle."""
    greatest = one.candidate.point_error
    return (0.0 if greatest <= MET * one.candidate.size else greatest), -one.candidate.least_transmission


def _searched(params: PathFourBarParams) -> tuple[FourBarOption, ...]:
    """The nearest four-bars of each class that is searched."""
    return tuple(
        _option(params, task, fit)
        for task in params.tasks()
        for fit in path_four_bars(task, count=params.count, seed=params.seed, starts=params.starts)
    )


def _option(params: PathFourBarParams, task: PathTask, fit: PathFit) -> FourBarOption:
    candidate = judged(task, fit)
    if params.error_max is not None:
        asked = dataclasses.replace(candidate.task, point_tolerance=params.error_max)
        candidate = judge(fit.four_bar, asked)
    search: dict[str, Json] = {
        "active": list(fit.active),
        "starts_agreed": fit.search.agreed,
        "starts": fit.search.starts,
    }
    return FourBarOption(candidate, "search", errors(candidate) | search)


def _exact(params: PathFourBarParams, points: ComplexArray) -> tuple[tuple[FourBarOption, ...], tuple[str, ...]]:
    """All four-bars that meet the timed points, and in words what is none."""
    timing = params.angles()
    assert timing is not None
    found = timed_four_bars(points, timing, pivots=params.given_pivots(), samples=CURVES)
    task = PrecisionTask(points=points, crank=timing)
    options = []
    for one in found:
        if one.four_bar is not None:
            candidate = judge(one.four_bar, task)
            options.append(FourBarOption(candidate, "exact", errors(candidate)))
    return tuple(options), tuple(dict.fromkeys(one.said for one in found if one.four_bar is None))


def _siblings(original: Candidate) -> tuple[tuple[str, Candidate], ...]:
    """The cognates, judged at the same points: one keeps the crank's timing, of the other the crank finds its own."""
    found = cognates(original.four_bar)
    near, points = original.point_error * (1 + ROUNDING) + ROUNDING * original.size, original.task.points
    tasks = (
        ("timed", found.timed, PrecisionTask(points=points, crank=original.task.crank, point_tolerance=near)),
        ("other", found.other, PrecisionTask(points=points, point_tolerance=near)),
    )
    return tuple((name, judge(four_bar, task)) for name, four_bar, task in tasks if four_bar is not None)


def errors(candidate: Candidate) -> dict[str, Json]:
    """Greatest, root mean square and sum of squares of the distances from the points."""
    gaps = np.array([met.point_error for met in candidate.positions])
    if not np.isfinite(gaps).all():
        return {"error_max": None, "error_rms": None, "error_squares": None}
    squares = float(np.sum(gaps**2))
    return {"error_max": float(np.max(gaps)), "error_rms": math.sqrt(squares / len(gaps)), "error_squares": squares}
