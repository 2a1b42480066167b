"""The nearest four-bars for a path: searched, judged, alike ones grouped, ranked by error and merit."""

import dataclasses
import math
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.path_four_bar.params import PathFourBarParams
from ilmek.progress import Progress
from ilmek.records import record
from ilmek.report import Json
from ilmek.synthesis.candidate import Candidate, judge
from ilmek.synthesis.distinct import pins_of
from ilmek.synthesis.filters import defects
from ilmek.synthesis.merit import extent_of_points
from ilmek.synthesis.path.confidence import share_excluded
from ilmek.synthesis.path.fit import PathFit, Search, cognate_fit, judged
from ilmek.synthesis.path.search import path_four_bars
from ilmek.synthesis.path.task import PathTask
from ilmek.synthesis.selection import (
    NEAR_EQUAL,
    FourBarOption,
    FourBarSelection,
    SearchedFamily,
    best_first,
    choose,
    ranked_by_error,
    single_cures,
    with_merit,
)
from ilmek.units import format_quantity

POOL = 30
"""Different four-bars of each class that are judged, each with its cognate."""

EXACT = 1e-8
"""Root mean square error that counts as none, in extents of the points."""

ALIKE = 1e-3
"""Difference of link ratios below which four-bars are alike: mirror images, cognates, repeats."""

APART = (0.5, 0.25, 0.125, 0.0625, 0.03)
"""Least distance of a four-bar from all better ones, in extents of the points: the first that gives enough."""


@record
class SearchRecord:
    """What the searches of all classes rest on: see `Search`.

    optima          different errors up to twice the least
    missed          probability that one of the searches missed a better optimum than its best [1]
    share_excluded  greatest share of the runs that an optimum which all missed has with 95 % confidence [1]
    """

    starts: int
    runs: int
    optima: int
    missed: float
    share_excluded: float


class Nearest(NamedTuple):
    """The nearest four-bars, and the record of their search."""

    choice: FourBarSelection
    searched: SearchRecord


def nearest(params: PathFourBarParams, progress: Progress) -> Nearest:
    """The nearest four-bars, ranked. Raises ParameterError where no start can be brought within the limits; Cancelled.

    Four-bars that are alike are one answer: the best by merit. Exact ones, those within `error_max` where it is given,
    and those whose sums of squared errors differ by at most 0.1 % are ranked by merit; others by this error.
    """
    found, searches = _searched(params, progress)
    # The search keeps these limits, and ends at them: a filter would find them exceeded by rounding.
    filters = dataclasses.replace(params.filters(), transmission_min=0.0, full_turn=False, transmits=False)
    missed = [(one, defects(one.candidate, filters)) for one in found]
    good = [with_merit(one) for one, reasons in missed if not reasons]
    removed = [(one, reasons) for one, reasons in missed if reasons]
    zero, tolerated = EXACT * extent_of_points(params.positions()), params.error_max is not None
    ranked = ranked_by_error(_unlike(sorted(good, key=best_first)), _error, zero=zero, tolerated=tolerated)
    listed = _apart(params, ranked)
    choice = choose(listed, (), params, filters=filters, rank=lambda _: 0)  # as listed: sorting is stable
    counts = Counter(name for _, reasons in removed for name in reasons)
    family = SearchedFamily(len(ranked) + len(removed), len(ranked), counts)
    cures = () if listed else _cures(params, removed)
    choice = dataclasses.replace(
        choice, family=family, cures=cures, removed=tuple(removed), more=len(ranked) - len(choice.kept)
    )
    return Nearest(choice, _record(searches))


def _record(searches: Sequence[Search]) -> SearchRecord:
    """The record of the searches of all classes."""
    return SearchRecord(
        starts=sum(search.starts for search in searches),
        runs=sum(search.runs for search in searches),
        optima=sum(search.optima for search in searches),
        missed=1.0 - math.prod(1.0 - search.missed for search in searches),
        share_excluded=max(share_excluded(search.runs) for search in searches),
    )


def _searched(params: PathFourBarParams, progress: Progress) -> tuple[list[FourBarOption], tuple[Search, ...]]:
    """The nearest four-bars of each class with their cognates within the bounds, judged; and the searches."""
    tasks, found, searches = params.tasks(), list[FourBarOption](), list[Search]()
    for number, task in enumerate(tasks):
        part = progress.part(number / len(tasks), (number + 1) / len(tasks))
        fits = path_four_bars(
            task, count=max(POOL, params.count), seed=params.seed, starts=params.starts, progress=part
        )
        searches.append(fits[0].search)
        for fit in fits:
            other = cognate_fit(task, fit)
            found += [_option(params, task, one) for one in (fit, other) if one is not None]
    return found, tuple(searches)


def _option(params: PathFourBarParams, task: PathTask, fit: PathFit) -> FourBarOption:
    candidate = judged(task, fit)
    if params.error_max is not None:
        candidate = judge(fit.four_bar, dataclasses.replace(candidate.task, point_tolerance=params.error_max))
    search: dict[str, Json] = {
        "active": list(fit.active),
        "starts_agreed": fit.search.agreed,
        "runs_agreed": fit.search.runs_agreed,
        "starts": fit.search.starts,
    }
    return FourBarOption(candidate, "search", errors(candidate) | search)


def errors(candidate: Candidate) -> dict[str, Json]:
    """Greatest, root mean square and sum of squares of the distances from the points [m, m, m²]."""
    gaps = np.array([met.point_error for met in candidate.positions])
    if not np.isfinite(gaps).all():
        return {"error_max": None, "error_rms": None, "error_squares": None}
    squares = float(np.sum(gaps**2))
    return {"error_max": float(np.max(gaps)), "error_rms": math.sqrt(squares / len(gaps)), "error_squares": squares}


def _error(option: FourBarOption) -> float:
    """Root mean square error [m]."""
    error = option.details["error_rms"]
    return error if isinstance(error, float) else math.inf


def _ratios(option: FourBarOption) -> FloatArray:
    """Crank, and the shorter and the longer of coupler and rocker, over the ground link: equal for alike four-bars."""
    ground, crank, coupler, rocker = option.candidate.four_bar.lengths
    return np.array([crank, min(coupler, rocker), max(coupler, rocker)]) / ground


def _unlike(options: Sequence[FourBarOption]) -> list[FourBarOption]:
    """The options without those that are alike one before."""
    kept, seen = list[FourBarOption](), np.zeros((0, 3))
    for option in options:
        ratios = _ratios(option)
        if not (np.abs(np.log(seen / ratios)).max(axis=1, initial=0.0) < ALIKE).any():
            kept.append(option)
            seen = np.vstack([seen, ratios])
    return kept


def _apart(params: PathFourBarParams, ranked: Sequence[FourBarOption]) -> list[FourBarOption]:
    """The first that differ, with their distances from the nearest one before, in extents of the points.

    Those as near as the best must differ most; the others follow where these are too few.
    """
    if not ranked:
        return []
    extent = extent_of_points(params.positions())
    most = max(EXACT * extent, NEAR_EQUAL * min(map(_error, ranked)))
    best = [option for option in ranked if params.error_max is not None or _error(option) <= most]
    for least in APART:
        chosen = _spaced(best if least > APART[-1] else ranked, least * extent)
        if len(chosen) >= params.count:
            break
    return [dataclasses.replace(one, apart=gap / extent) for one, gap in chosen]


def _spaced(options: Sequence[FourBarOption], least: float) -> list[tuple[FourBarOption, float]]:
    """The options whose pins are `least` from those of all before [m], and these distances."""
    chosen: list[tuple[FourBarOption, float]] = []
    taken = np.zeros((0, 4), dtype=complex)
    for option in options:
        pins = pins_of(option.candidate.four_bar)
        gap = float(np.min(np.abs(taken - pins).max(axis=1), initial=math.inf))
        if gap >= least:
            chosen.append((option, gap))
            taken = np.vstack([taken, pins])
    return chosen


def _cures(params: PathFourBarParams, removed: Sequence[tuple[FourBarOption, Mapping[str, str]]]) -> tuple[str, ...]:
    """Single limits that give a four-bar if they are loosened."""
    near = [one for one, reasons in removed if set(reasons) == {"met"}]
    if params.error_max is None or not near:
        return single_cures(removed)
    greatest = min(one.candidate.point_error for one in near)
    return (f"error_max={format_quantity(greatest, 'mm')} gives one",)
