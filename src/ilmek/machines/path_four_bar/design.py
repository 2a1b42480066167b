"""A four-bar for a path: found by a search or by the exact methods, judged, filtered."""

import dataclasses
import math
from collections.abc import Callable
from typing import Any

from ilmek.arrays import ComplexArray
from ilmek.machines.path_four_bar.complete import CompleteSearch, search
from ilmek.machines.path_four_bar.nearest import SearchRecord, errors, nearest
from ilmek.machines.path_four_bar.params import PathFourBarParams
from ilmek.progress import SILENT, Progress
from ilmek.records import computed, record
from ilmek.report import Json
from ilmek.synthesis.candidate import Candidate, judge
from ilmek.synthesis.cognates import cognates
from ilmek.synthesis.path.points import timed_four_bars
from ilmek.synthesis.selection import FourBarDesign, FourBarOption, choose, detail_of_best, dimensions, solutions
from ilmek.synthesis.task import PrecisionTask

CURVES = 12
"""Second links that are tried on each closed part of the curves of four timed points."""

ROUNDING = 1e-6
"""Share of an error, and of a four-bar's size, that may be rounding."""


def of_complete(doc: str, value: Callable[[CompleteSearch], Json]) -> Any:
    """Declare a result of complete synthesis; left out elsewhere."""
    return computed("", doc, lambda it: None if it.complete is None else value(it.complete), optional=True)


def of_search(doc: str, value: Callable[[SearchRecord], Json], unit: str = "") -> Any:
    """Declare a result of a search; left out elsewhere."""
    return computed(unit, doc, lambda it: None if it.searched is None else value(it.searched), optional=True)


@record
class PathFourBar(FourBarDesign):
    """Four-bars for a path.

    points    [m]      cognates  of the one that is drawn, judged, by their names; () where they are not required
    complete  where nine points, or poses and points, are met exactly; None otherwise
    searched  where the nearest four-bars are searched; None otherwise
    """

    params: PathFourBarParams
    points: ComplexArray
    cognates: tuple[tuple[str, Candidate], ...]
    complete: CompleteSearch | None = None
    searched: SearchRecord | None = None

    error_max = detail_of_best("mm", "greatest distance from a point, of the solution that is drawn", "error_max")
    error_rms = detail_of_best("mm", "root mean square of the distances", "error_rms")
    error_squares = detail_of_best("mm^2", "sum of the squared distances", "error_squares")
    active = detail_of_best("", "active limits: without them it would come nearer", "active")
    starts_agreed = detail_of_best("", "random starts that ended at this error", "starts_agreed")
    runs_agreed = detail_of_best("", "runs of the search that met this error", "runs_agreed")
    starts = detail_of_best("", "random starts of the search of its class", "starts")
    starts_used = of_search("random starts of all classes that were searched", lambda one: one.starts)
    runs = of_search("independent runs that these are divided into", lambda one: one.runs)
    optima = of_search("different errors up to twice the least that were met", lambda one: one.optima)
    probability_missed = of_search(
        "estimated probability that a nearer four-bar exists within the limits (docs: path synthesis)",
        lambda one: one.missed,
        unit="1",
    )
    share_excluded = of_search(
        "a nearer four-bar that at least this share of the runs lead to would have been found with 95 %",
        lambda one: one.share_excluded,
        unit="1",
    )
    solutions = solutions(
        "error_max, error_rms and error_squares (sum of squares) of the points; of a search active, starts_agreed, "
        "runs_agreed, starts; of nine points within (distance of its exact pins) and curve (its number: cognates "
        "have one)"
    )
    paths = of_complete(
        "solutions of the complex task that were followed; of nine points each counts for three cognates",
        lambda one: one.answer.paths,
    )
    real = of_complete("four-bars that meet the points exactly, defects included", lambda one: len(one.answer.found))
    certified = of_complete(
        "of these, four-bars whose existence is proven", lambda one: sum(each.certified for each in one.answer.found)
    )
    every_path_ended = of_complete(
        "whether every path ended at a solution that stands alone: then no four-bar is missing",
        lambda one: one.answer.complete,
    )

    @computed(
        "",
        "the other four-bars that trace the same curve: keeps the timing (timed), turns with the coupler (other)",
        name="cognates",
        shown=False,
        optional=True,
    )
    def other_four_bars(self) -> Json:
        return [
            {"name": name, **dimensions(one.four_bar), "crank_turns": one.crank_turns, **errors(one)}
            for name, one in self.cognates
        ] or None


def _proven(complete: CompleteSearch) -> tuple[FourBarOption, ...]:
    """The four-bars of complete synthesis that are judged."""
    options = []
    for one, candidate in complete.judged:
        proof: dict[str, Json] = {"within": one.distance if math.isfinite(one.distance) else None, "curve": one.family}
        details = errors(candidate) | proof
        options.append(FourBarOption(candidate, "complete", details, certified=one.certified))
    return tuple(options)


def design(params: PathFourBarParams, progress: Progress = SILENT) -> PathFourBar:
    """All four-bars for the path.

    Raises ParameterError where the task cannot be read, or no start of the search can be brought within the limits;
    Cancelled.
    """
    points = params.positions()
    complete = searched = None
    if params.exact and params.timing is None:
        complete = search(params.poses_and_points(), params.filters(), progress)
        choice = choose(_proven(complete), complete.words, params)
        cures = () if choice.kept else complete.cures(choice)
        choice = dataclasses.replace(choice, family=complete.family(choice), cures=cures)
    elif params.exact:
        choice = choose(*_exact(params, points), params)
    else:
        found = nearest(params, progress)
        choice, searched = found.choice, found.searched
    siblings = _siblings(choice.best.candidate) if choice.best is not None and params.cognates else ()
    return PathFourBar(
        choice=choice, params=params, points=points, cognates=siblings, complete=complete, searched=searched
    )


def _exact(params: PathFourBarParams, points: ComplexArray) -> tuple[tuple[FourBarOption, ...], tuple[str, ...]]:
    """All four-bars that meet the timed points, and descriptions of what is none."""
    timing = params.angles()
    assert timing is not None
    bars = timed_four_bars(points, timing, pivots=params.both_pivots(), samples=CURVES)
    task = PrecisionTask(points=points, crank=timing)
    candidates = [judge(bar.four_bar, task) for bar in bars if bar.four_bar is not None]
    other = dict.fromkeys(bar.description for bar in bars if bar.four_bar is None)
    return tuple(FourBarOption(candidate, "exact", errors(candidate)) for candidate in candidates), tuple(other)


def _siblings(original: Candidate) -> tuple[tuple[str, Candidate], ...]:
    """The cognates, judged at the same points: one keeps the crank's timing, the crank of the other has its own."""
    found = cognates(original.four_bar)
    near, points = original.point_error * (1 + ROUNDING) + ROUNDING * original.size, original.task.points
    tasks = (
        ("timed", found.timed, PrecisionTask(points=points, crank=original.task.crank, point_tolerance=near)),
        ("other", found.other, PrecisionTask(points=points, point_tolerance=near)),
    )
    return tuple((name, judge(four_bar, task)) for name, four_bar, task in tasks if four_bar is not None)
