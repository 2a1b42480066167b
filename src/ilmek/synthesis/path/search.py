"""Four-bars whose tracer comes nearest to given points: many starts, each to its own best, the better half at a time.

    least  sum |P(x, th_k) - p_k|^2    within bounds, a crank that turns fully, the order of the points

A start is a random set of link ratios with size, place and tracer fitted at once (`path.starts`); it goes downhill by
Levenberg-Marquardt without the crank's angles (`path.descent`). The search ends when starts enough agree on the best.
Seeded: batches of starts are numbered, and no result depends on how many threads there are.
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
from ilmek.synthesis.path.starts import DICE, start_all
from ilmek.synthesis.path.task import PathTask

BATCH = 96
"""Starts of one batch."""

WAVE = 2
"""Batches after which the search looks whether it may end."""

STAGES = ((30, 0.5), (60, 0.5), (400, 1.0))
"""Evaluations, and the part of the starts that goes on after them."""

COARSE = 48
"""Points at most with which a search begins; all of them come in at the end."""

AGREE = 5
"""Starts that must have ended at the best squared error, within SAME of it."""

SAME = 1e-4
"""Relative difference of squared errors that is none, when starts are asked whether they agree."""

NOTHING = 1e-6
"""Root mean square error, in sizes of the path, that is none when starts are asked whether they agree."""

KEPT = 12
"""Starts of a batch that go on from a part of the points to all of them, or whose order is mended."""

REPAIRS, MENDING = 12, 100
"""Times that a lost order is mended before a start is given up, and evaluations each time."""

ALIKE = 1e-3
"""Difference, in sizes of the path, below which two four-bars are one."""


class SearchEnds(NamedTuple):
    """Ends of starts, in sizes of the path about its middle."""

    designs: Float[np.ndarray, "some 10"]
    angles: Float[np.ndarray, "some points"]
    branches: Int[np.ndarray, " some"]
    blocks: Int[np.ndarray, "some points"]
    states: Float[np.ndarray, "some 5"]

    def only(self, which: slice | Bool[np.ndarray, " some"] | Int[np.ndarray, " part"]) -> "SearchEnds":
        """Those chosen, copied."""
        return SearchEnds(*(part[which] for part in self))

    @property
    def errors(self) -> Float[np.ndarray, " some"]:
        """Squared errors."""
        return self.states[:, 0]


@record
class Scaled:
    """A task in sizes of its path about its middle."""

    task: PathTask
    middle: complex
    size: float
    points: Complex[np.ndarray, " points"]
    along: Float[np.ndarray, " points"]
    low: Float[np.ndarray, "10"]
    high: Float[np.ndarray, "10"]

    def descend(self, found: SearchEnds, points: Complex[np.ndarray, " part"], rounds: int) -> int:
        """Each start goes on downhill, in place; the evaluations that took."""
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
    """At most `count` different four-bars for a path, the nearest first; among exact ones, the best transmission first.

    seed     of the random starts: the same seed gives the same answers
    starts   after which the search ends at the latest, in batches of 192; it ends sooner where five agree on the best
    threads  that search at once
    time_limit  time [s] after which no further batch of starts begins; default: none. The answers then depend on the
             speed of the computer
    progress called after each batch of 192 starts; the search can be cancelled there

    Local optima are all that any search of this kind can prove; `search.agreed` says how many starts ended here.
    Raises ParameterError for a number out of range, or where no start can be brought within the limits; Cancelled.
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
            for ends, spent in wave:
                found.append(ends)
                evaluations += spent
            begun += WAVE * BATCH
            progress(min(begun / starts, 1.0))
            errors = np.concatenate([ends.errors for ends in found])
            if len(errors) and _agreed(errors, errors.min(), len(task.points)) >= max(AGREE, count):
                break
            if time.monotonic() >= until:
                break
    if not sum(len(ends.errors) for ends in found):
        raise ParameterError(
            "no start of the search can be brought within the limits",
            do="widen the bounds of the links, of the pivot or of the turn of the ground link",
        )
    return _answers(scaled, _joined(found), count, Search(seed, begun, evaluations, 0))


def _scaled(task: PathTask) -> Scaled:
    """The task in sizes of its path about its middle."""
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
    return Scaled(task, middle, size, points, along, low, high)


def _batch(scaled: Scaled, seed: int, number: int) -> tuple[SearchEnds, int]:
    """The ends of one batch of starts, and the evaluations they took."""
    part = np.unique(np.linspace(0, len(scaled.points) - 1, COARSE).round().astype(int))
    if len(scaled.points) <= COARSE:
        part = np.arange(len(scaled.points))
    found = _begin(scaled, part, seed, number)
    spent = 0
    for rounds, stay in STAGES:
        spent += scaled.descend(found, scaled.points[part], rounds)
        found = found.only(np.argsort(found.errors, kind="stable")[: math.ceil(stay * len(found.errors))])
    if len(part) < len(scaled.points):
        found = _refined(scaled, found.only(slice(KEPT)), part)
        spent += scaled.descend(found, scaled.points, STAGES[-1][0])
    if scaled.task.timing is None and scaled.task.ordered:
        found, more = _in_order(scaled, found)
        spent += more
    return found, spent


def _begin(scaled: Scaled, part: Int[np.ndarray, " part"], seed: int, number: int) -> SearchEnds:
    """Random starts through a part of the points; those that keep the limits."""
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
    dice = rng.random((count, DICE))
    start_all(dice, links, scaled.along[part], timed, task.closed, points, *limits, designs, angles, branches, errors)
    states[:, 0] = errors
    blocks = np.tile(np.full(len(part), -1) if timed else np.arange(len(part)), (count, 1))
    return SearchEnds(designs, angles, branches, blocks, states).only(np.isfinite(errors))


def _refined(scaled: Scaled, found: SearchEnds, part: Int[np.ndarray, " part"]) -> SearchEnds:
    """The same four-bars at all points, their crank angles between those at a part of them."""
    every = np.arange(len(scaled.points))
    angles = np.array([np.interp(every, part, row) for row in found.angles]).reshape(-1, len(every))
    timing = scaled.task.timing
    if timing is not None:
        angles = found.angles[:, :1] + (timing - timing[0])
    blocks = np.tile(np.full(len(every), -1) if timing is not None else every, (len(angles), 1))
    return _restarted(scaled, SearchEnds(found.designs, angles, found.branches, blocks, found.states))


def _restarted(scaled: Scaled, found: SearchEnds) -> SearchEnds:
    """As new starts: squared errors at the angles that are, damping as at the beginning."""
    rows = zip(found.designs, found.angles, found.branches, strict=True)
    states = np.zeros((len(found.branches), 5))
    states[:, 0] = [squared_error(design, angles, scaled.points, int(branch)) for design, angles, branch in rows]
    states[:, 1:3] = 1e-2, 2.0
    return found._replace(states=states)


def _in_order(scaled: Scaled, found: SearchEnds) -> tuple[SearchEnds, int]:
    """Those that meet the points in order, and the best of the others once points out of order share a crank angle.

    With the evaluations that took.

    To keep the order costs: a start that is out of order and worse than enough of those in order is left.
    """
    good = in_order(found.angles)
    done, lost, spent = found.only(good), found.only(~good), 0
    for _ in range(REPAIRS):
        worst = np.sort(done.errors)[KEPT - 1] if len(done.errors) >= KEPT else math.inf
        lost = lost.only(np.argsort(lost.errors, kind="stable")[:KEPT])
        lost = lost.only(lost.errors < worst)
        if not len(lost.errors):
            break
        pairs = [pooled(angles, blocks) for angles, blocks in zip(lost.angles, lost.blocks, strict=True)]
        angles, blocks = (np.array(part) for part in zip(*pairs, strict=True))
        lost = _restarted(scaled, lost._replace(angles=angles, blocks=blocks))
        lost = lost.only(np.isfinite(lost.errors))
        spent += scaled.descend(lost, scaled.points, MENDING)
        good = in_order(lost.angles)
        done, lost = _joined([done, lost.only(good)]), lost.only(~good)
    return done, spent


def _joined(parts: list[SearchEnds]) -> SearchEnds:
    """All of them, one after the other."""
    return SearchEnds(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))


def _agreed(errors: Float[np.ndarray, " some"], best: float, points: int) -> int:
    """How many squared errors are the best one."""
    return int(np.sum(errors <= best * (1 + SAME) + NOTHING**2 * points))


def _answers(scaled: Scaled, found: SearchEnds, count: int, search: Search) -> tuple[PathFit, ...]:
    """The best different four-bars, in metres."""
    exact = 1e6 * EXACT * len(scaled.points)
    transmission = [least_transmission(design) for design in found.designs]
    ranked = np.lexsort((-np.array(transmission), np.maximum(found.errors, exact)))
    chosen: list[int] = []
    for place in ranked:
        others = found.designs[chosen, :8]
        if len(chosen) < count and not (np.abs(others - found.designs[place, :8]).max(axis=1, initial=0) < ALIKE).any():
            chosen.append(int(place))
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
