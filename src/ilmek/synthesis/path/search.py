"""Four-bars whose tracer comes nearest to given points: local optimisation from many random starts.

    minimise  sum |P(x, th_k) - p_k|^2    within bounds, with full rotation of the crank and the order of the points

A start is a random set of link ratios with size, position and tracer fitted (`path.starts`). It is optimised by the
Levenberg-Marquardt method with the crank angles eliminated (`path.descent`); in stages only the better half continues.
The search ends when enough starts agree on the best error. Batches of starts are numbered and seeded, so that the
result does not depend on the number of threads.   [sources: `path.descent`, `path.model`]
"""

import dataclasses
import math
import time
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np

from ilmek.arrays import Bool, Complex, Float, Int
from ilmek.errors import ParameterError
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.synthesis.path.descent import EXACT, descend_all
from ilmek.synthesis.path.fit import PathFit, Search, SearchEnd, least_transmission, path_fit
from ilmek.synthesis.path.links import random_links
from ilmek.synthesis.path.model import SIZE, squared_error
from ilmek.synthesis.path.order import in_order, pooled
from ilmek.synthesis.path.starts import RANDOM_NUMBERS, start_all
from ilmek.synthesis.path.task import PathTask

BATCH = 96
"""Number of starts in a batch."""

WAVE = 2
"""Number of batches after which the end of the search is checked."""

STAGES = ((30, 0.5), (60, 0.5), (400, 1.0))
"""Evaluations of each stage, and the share of the starts that continues after it."""

COARSE = 48
"""Greatest number of points in the first stages; the last stage uses all points."""

AGREEMENT = 5
"""Number of starts that must end at the best squared error, within SAME of it."""

SAME = 1e-4
"""Relative difference up to which squared errors agree."""

ZERO_ERROR = 1e-6
"""Root mean square error, in sizes of the path, up to which errors agree."""

CONTINUED = 12
"""Starts of a batch that continue with all points, or whose order is restored."""

REPAIRS, REPAIR_EVALUATIONS = 12, 100
"""Attempts to restore the order of the points of a start, and evaluations of each attempt."""

SAME_DESIGN = 1e-3
"""Difference, in sizes of the path, below which two four-bars count as the same."""


class SearchEnds(NamedTuple):
    """Ends of starts, in sizes of the path relative to its middle; one row per start."""

    designs: Float[np.ndarray, "some 10"]
    angles: Float[np.ndarray, "some points"]
    branches: Int[np.ndarray, " some"]
    blocks: Int[np.ndarray, "some points"]
    states: Float[np.ndarray, "some 5"]

    def only(self, which: slice | Bool[np.ndarray, " some"] | Int[np.ndarray, " part"]) -> "SearchEnds":
        """The selected ends, copied."""
        return SearchEnds(*(part[which] for part in self))

    @property
    def errors(self) -> Float[np.ndarray, " some"]:
        """Squared errors, in squared sizes of the path."""
        return self.states[:, 0]


@record
class ScaledTask:
    """A task in sizes of its path relative to its middle."""

    task: PathTask
    middle: complex
    size: float
    points: Complex[np.ndarray, " points"]
    along: Float[np.ndarray, " points"]
    low: Float[np.ndarray, "10"]
    high: Float[np.ndarray, "10"]

    def descend(self, found: SearchEnds, points: Complex[np.ndarray, " part"], rounds: int) -> int:
        """Continue each descent in place; returns the number of evaluations."""
        before = found.states[:, 4].sum()
        kind, kappa = self.task.sign, self.task.kappa
        arrays = (found.designs, found.angles, found.branches, found.states, found.blocks)
        descend_all(*arrays, points, self.low, self.high, kind, kappa, rounds)
        return int(found.states[:, 4].sum() - before)


def path_four_bars(
    task: PathTask,
    *,
    count: int = 5,
    seed: int = 0,
    starts: int = 960,
    threads: int = 2,
    time_limit: float = math.inf,
    progress: Progress = SILENT,
) -> tuple[PathFit, ...]:
    """At most `count` different four-bars for a path, sorted by error; exact ones by their transmission angle.

    seed        of the random starts; the same seed gives the same result
    starts      greatest number of starts, in batches of 192; the search ends earlier when five starts agree on the best
    threads     number of threads
    time_limit  time after which no further batch of starts begins [s]; default: none; with a limit the result depends
                on the speed of the computer
    progress    called after each batch of 192 starts; the search can be cancelled there

    The results are local optima; `search.agreed` is the number of starts that ended at each. Raises ParameterError for
    numbers out of range, and where no start can be brought within the limits; Cancelled where `progress` cancels.
    """
    for name, value in dict(count=count, starts=starts, threads=threads).items():
        if value < 1:
            raise ParameterError(f"{name} {value}", allowed="1 or more")
    if not time_limit > 0:
        raise ParameterError(f"time_limit {time_limit:g} s", allowed="above 0 s")
    scaled, until = _scaled(task), time.monotonic() + time_limit
    found, evaluations, begun = [], 0, 0
    progress(0.0)
    with ThreadPoolExecutor(threads) as pool:
        for first in range(0, math.ceil(starts / BATCH), WAVE):
            wave = pool.map(lambda number: _batch(scaled, seed, number), range(first, first + WAVE))
            for ends, used in wave:
                found.append(ends)
                evaluations += used
            begun += WAVE * BATCH
            progress(min(begun / starts, 1.0))
            errors = np.concatenate([ends.errors for ends in found])
            if len(errors) and _agreed(errors, errors.min(), len(task.points)) >= max(AGREEMENT, count):
                break
            if time.monotonic() >= until:
                break
    if not sum(len(ends.errors) for ends in found):
        raise ParameterError(
            "no start of the search can be brought within the limits",
            do="widen the bounds of the links, of the pivot or of the turn of the ground link",
        )
    return _solutions(scaled, _joined(found), count, Search(seed, begun, evaluations, 0))


def _scaled(task: PathTask) -> ScaledTask:
    """The task in sizes of its path relative to its middle."""
    middle, size = complex(task.points.mean()), task.size
    points = (task.points - middle) / size
    shift = np.zeros(SIZE)
    shift[6:8] = middle.real, middle.imag
    scale = np.r_[np.full(8, size), 1.0, 1.0]
    low, high = ((ends - shift) / scale for ends in task.limits())
    along = task.timing
    if along is None:
        lengths = np.r_[0.0, np.cumsum(np.abs(np.diff(points)))]
        along = lengths / (lengths[-1] + (abs(points[-1] - points[0]) if task.closed else 0.0))
    return ScaledTask(task, middle, size, points, along, low, high)


def _batch(scaled: ScaledTask, seed: int, number: int) -> tuple[SearchEnds, int]:
    """Ends of one batch of starts, and the number of evaluations."""
    part = np.unique(np.linspace(0, len(scaled.points) - 1, COARSE).round().astype(int))
    if len(scaled.points) <= COARSE:
        part = np.arange(len(scaled.points))
    found = _begin(scaled, part, seed, number)
    evaluations = 0
    for rounds, stay in STAGES:
        evaluations += scaled.descend(found, scaled.points[part], rounds)
        found = found.only(np.argsort(found.errors, kind="stable")[: math.ceil(stay * len(found.errors))])
    if len(part) < len(scaled.points):
        found = _refined(scaled, found.only(slice(CONTINUED)), part)
        evaluations += scaled.descend(found, scaled.points, STAGES[-1][0])
    if scaled.task.timing is None and scaled.task.ordered:
        found, more = _with_order_restored(scaled, found)
        evaluations += more
    return found, evaluations


def _begin(scaled: ScaledTask, part: Int[np.ndarray, " part"], seed: int, number: int) -> SearchEnds:
    """Random starts for a part of the points; those within the limits."""
    task, rng = scaled.task, np.random.default_rng([seed, number])
    bounds = scaled.low[:4], scaled.high[:4]
    links = random_links(rng, BATCH, bounds, kind=task.sign, kappa=task.kappa)
    count, points = len(links), scaled.points[part]
    designs, angles = np.empty((count, SIZE)), np.empty((count, len(part)))
    branches, states = np.empty(count, dtype=np.int64), np.zeros((count, 5))
    states[:, 1:3] = 1e-2, 2.0
    errors = np.empty(count)
    timed = task.timing is not None
    limits = (scaled.low, scaled.high, task.sign, task.kappa)
    random = rng.random((count, RANDOM_NUMBERS))
    start_all(random, links, scaled.along[part], timed, task.closed, points, *limits, designs, angles, branches, errors)
    states[:, 0] = errors
    blocks = np.tile(np.full(len(part), -1) if timed else np.arange(len(part)), (count, 1))
    return SearchEnds(designs, angles, branches, blocks, states).only(np.isfinite(errors))


def _refined(scaled: ScaledTask, found: SearchEnds, part: Int[np.ndarray, " part"]) -> SearchEnds:
    """The same four-bars for all points, with crank angles interpolated from a part of them."""
    indices = np.arange(len(scaled.points))
    angles = np.array([np.interp(indices, part, row) for row in found.angles]).reshape(-1, len(indices))
    timing = scaled.task.timing
    if timing is not None:
        angles = found.angles[:, :1] + (timing - timing[0])
    blocks = np.tile(np.full(len(indices), -1) if timing is not None else indices, (len(angles), 1))
    return _restarted(scaled, SearchEnds(found.designs, angles, found.branches, blocks, found.states))


def _restarted(scaled: ScaledTask, found: SearchEnds) -> SearchEnds:
    """The ends as new starts: squared errors recomputed, damping reset."""
    rows = zip(found.designs, found.angles, found.branches, strict=True)
    states = np.zeros((len(found.branches), 5))
    states[:, 0] = [squared_error(design, angles, scaled.points, int(branch)) for design, angles, branch in rows]
    states[:, 1:3] = 1e-2, 2.0
    return found._replace(states=states)


def _with_order_restored(scaled: ScaledTask, found: SearchEnds) -> tuple[SearchEnds, int]:
    """Ends that meet the points in order, and the number of evaluations.

    The best of the others are optimised again with a common crank angle for points out of order. This increases their
    error: an end out of order that is worse than enough ends in order is dropped.
    """
    good = in_order(found.angles)
    ordered, unordered, evaluations = found.only(good), found.only(~good), 0
    for _ in range(REPAIRS):
        worst = np.sort(ordered.errors)[CONTINUED - 1] if len(ordered.errors) >= CONTINUED else math.inf
        unordered = unordered.only(np.argsort(unordered.errors, kind="stable")[:CONTINUED])
        unordered = unordered.only(unordered.errors < worst)
        if not len(unordered.errors):
            break
        pairs = [pooled(angles, blocks) for angles, blocks in zip(unordered.angles, unordered.blocks, strict=True)]
        angles, blocks = (np.array(part) for part in zip(*pairs, strict=True))
        unordered = _restarted(scaled, unordered._replace(angles=angles, blocks=blocks))
        unordered = unordered.only(np.isfinite(unordered.errors))
        evaluations += scaled.descend(unordered, scaled.points, REPAIR_EVALUATIONS)
        good = in_order(unordered.angles)
        ordered, unordered = _joined([ordered, unordered.only(good)]), unordered.only(~good)
    return ordered, evaluations


def _joined(parts: list[SearchEnds]) -> SearchEnds:
    """Several sets of ends joined."""
    return SearchEnds(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))


def _agreed(errors: Float[np.ndarray, " some"], best: float, points: int) -> int:
    """Number of squared errors that agree with the best one."""
    return int(np.sum(errors <= best * (1 + SAME) + ZERO_ERROR**2 * points))


def _solutions(scaled: ScaledTask, found: SearchEnds, count: int, search: Search) -> tuple[PathFit, ...]:
    """The best different four-bars, in metres."""
    exact = 1e6 * EXACT * len(scaled.points)
    transmission = [least_transmission(design) for design in found.designs]
    ranked = np.lexsort((-np.array(transmission), np.maximum(found.errors, exact)))
    chosen: list[int] = []
    for index in ranked:
        others = found.designs[chosen, :8]
        if (
            len(chosen) < count
            and not (np.abs(others - found.designs[index, :8]).max(axis=1, initial=0) < SAME_DESIGN).any()
        ):
            chosen.append(int(index))
    scale = np.r_[np.full(8, scaled.size), 1.0, 1.0]
    shift = np.zeros(SIZE)
    shift[6:8] = scaled.middle.real, scaled.middle.imag
    agreed = [_agreed(found.errors, found.errors[k], len(scaled.points)) for k in chosen]
    return tuple(
        path_fit(
            scaled.task,
            SearchEnd(found.designs[k] * scale + shift, found.angles[k], int(found.branches[k]), found.blocks[k]),
            dataclasses.replace(search, agreed=number),
        )
        for k, number in zip(chosen, agreed, strict=True)
    )
