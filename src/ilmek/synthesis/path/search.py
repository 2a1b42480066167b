"""Four-bars whose tracer comes nearest to given points: independent runs of local optimisation from many starts.

    minimise  sum |P(x, th_k) - p_k|^2    within bounds, with full rotation of the crank and the order of the points

A start is a random set of link ratios with size, position and tracer fitted (`path.starts`). It is optimised by the
Levenberg-Marquardt method with the crank angles eliminated (`path.descent`); in stages only the better half continues.
Each run (`path.run`) has its own random starts, and varies its best ends until they stay the same; at last the best
ends of all runs are varied together. Runs are numbered and seeded, so that the result does not depend on the number of
threads. How many runs end at the same best measures how probably a better one was missed (`path.confidence`).
"""

import dataclasses
import math
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np

from ilmek.errors import ParameterError
from ilmek.progress import SILENT, Progress
from ilmek.synthesis.path.confidence import SOUGHT, probability_missed
from ilmek.synthesis.path.ends import ScaledTask, SearchEnds, joined, refined, scaled_task
from ilmek.synthesis.path.fit import PathFit, Search, SearchEnd, least_transmission, path_fit
from ilmek.synthesis.path.model import SIZE, Design
from ilmek.synthesis.path.run import OF_ALL, RUN, RunEnds, run, varied_until_quiet
from ilmek.synthesis.path.task import PathTask

FEWEST_RUNS, MOST_RUNS = 4, 16
"""Runs of a search whose number of starts is not given."""

WAVE = 2
"""Number of runs after which the end of the search is checked."""

JOINT = 2**31
"""Number that seeds the variations of all runs together."""

SAME_DESIGN = 1e-3
"""Difference, in sizes of the path, below which two four-bars count as the same."""


def path_four_bars(
    task: PathTask,
    *,
    count: int = 5,
    seed: int = 0,
    starts: int | None = None,
    threads: int = 2,
    time_limit: float = math.inf,
    progress: Progress = SILENT,
) -> tuple[PathFit, ...]:
    """At most `count` different four-bars for a path, sorted by error; exact ones by their transmission angle.

    count       results at most; it does not change the search
    seed        of the random starts; the same seed gives the same result
    starts      number of random starts, made whatever is found; default: in runs of 192 from 768 to 3072, until the
                probability that a better optimum was missed is at most 5 %, or an exact four-bar is found
    threads     number of threads
    time_limit  time after which no further run begins [s]; default: none; with a limit the result depends on the speed
                of the computer
    progress    called after each two runs of 192 starts; the search can be cancelled there

    The results are local optima; `search` states how often each was met, and how probably a better one was missed.
    Raises ParameterError for numbers out of range, and where no start can be brought within the limits; Cancelled where
    `progress` cancels.
    """
    for name, value in dict(count=count, starts=1 if starts is None else starts, threads=threads).items():
        if value < 1:
            raise ParameterError(f"{name} {value}", allowed="1 or more")
    if not time_limit > 0:
        raise ParameterError(f"time_limit {time_limit:g} s", allowed="above 0 s")
    full = scaled_task(task)
    scaled = full.thinned(full.coarse)
    runs, pool, evaluations = _runs(
        scaled, seed, starts, threads=threads, until=time.monotonic() + time_limit, progress=progress
    )
    if not len(pool.errors):
        raise ParameterError(
            "no start of the search can be brought within the limits",
            do="widen the bounds of the links, of the pivot or of the turn of the ground link",
        )
    found = pool
    if len(scaled.points) < len(full.points):
        found, more = refined(full, pool)
        evaluations += more
    search = Search(
        seed=seed,
        starts=RUN * len(runs) if starts is None else min(starts, RUN * len(runs)),
        evaluations=evaluations + sum(one.evaluations for one in runs),
        runs=len(runs),
        optima=_optima(scaled, pool),
        missed=_missed(scaled, runs, pool),
    )
    return _solutions(full, found, count, _Evidence(scaled, search, runs, pool))


class _Evidence(NamedTuple):
    """What a search rests on: the task that was searched, the record, the runs and the best ends of all."""

    scaled: ScaledTask
    search: Search
    runs: Sequence[RunEnds]
    pool: SearchEnds

    def of(self, design: Design) -> Search:
        """The record of a result: how many starts and runs ended at the error of the nearest end."""
        gaps = np.abs(self.pool.designs[:, :8] - design[:8]).max(axis=1)
        error = float(self.pool.errors[np.argmin(gaps)])
        agree = self.scaled.agreeing
        starts = sum(int(agree(one.starts, error).sum()) for one in self.runs)
        return dataclasses.replace(self.search, agreed=starts, runs_agreed=_runs_agreed(self.scaled, self.runs, error))


def _runs_agreed(scaled: ScaledTask, runs: Sequence[RunEnds], error: float) -> int:
    """Number of runs that met a squared error."""
    return sum(bool(scaled.agreeing(one.found.errors, error).any()) for one in runs)


def _optima(scaled: ScaledTask, pool: SearchEnds) -> int:
    """Number of different errors up to twice the least of a pool; exact ones count as one."""
    errors = np.maximum(pool.errors, scaled.exact)
    return len(np.unique(errors[errors <= 4 * errors.min()]))


def _missed(scaled: ScaledTask, runs: Sequence[RunEnds], pool: SearchEnds) -> float:
    """Estimated probability that a better optimum than the best of the pool was missed."""
    if not len(pool.errors):
        return 1.0
    best = float(pool.errors.min())
    return 0.0 if best <= scaled.exact else probability_missed(len(runs), _runs_agreed(scaled, runs, best))


def _runs(
    scaled: ScaledTask, seed: int, starts: int | None, *, threads: int, until: float, progress: Progress
) -> tuple[list[RunEnds], SearchEnds, int]:
    """The runs, the best ends after the variation of all, and the number of evaluations of the latter."""
    most = MOST_RUNS if starts is None else math.ceil(starts / RUN)
    sizes = [RUN if starts is None else min(RUN, starts - RUN * number) for number in range(most)]
    made: list[RunEnds] = []
    evaluations, pool, checked = 0, list[SearchEnds](), FEWEST_RUNS if starts is None else most
    progress(0.0)
    with ThreadPoolExecutor(threads) as workers:
        for first in range(0, most, WAVE):
            numbers = range(first, min(first + WAVE, most))
            made += workers.map(lambda number: run(scaled, seed, number, sizes[number]), numbers)
            progress(min(len(made) / most, 1.0))
            late = time.monotonic() >= until
            if not late and len(made) < checked:
                continue
            checked *= 2
            rng = np.random.default_rng([seed, JOINT, len(made)])
            ends = joined([*(one.found for one in made), *pool])
            best, more = (ends, 0) if len(made) == 1 else varied_until_quiet(scaled, ends, rng, OF_ALL)
            pool, evaluations = [best], evaluations + more
            if late or _missed(scaled, made, best) <= SOUGHT:
                break
    return made, pool[0], evaluations


def _solutions(full: ScaledTask, found: SearchEnds, count: int, evidence: _Evidence) -> tuple[PathFit, ...]:
    """The best different four-bars, in metres."""
    transmission = [least_transmission(design) for design in found.designs]
    ranked = np.lexsort((-np.array(transmission), np.maximum(found.errors, full.exact)))
    chosen: list[int] = []
    for index in ranked:
        others = found.designs[chosen, :8]
        if (
            len(chosen) < count
            and not (np.abs(others - found.designs[index, :8]).max(axis=1, initial=0) < SAME_DESIGN).any()
        ):
            chosen.append(int(index))
    scale = np.r_[np.full(8, full.size), 1.0, 1.0]
    shift = np.zeros(SIZE)
    shift[6:8] = full.middle.real, full.middle.imag
    return tuple(
        path_fit(
            full.task,
            SearchEnd(found.designs[k] * scale + shift, found.angles[k], int(found.branches[k]), found.blocks[k]),
            evidence.of(found.designs[k]),
        )
        for k in chosen
    )
