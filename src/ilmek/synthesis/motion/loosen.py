"""Where no four-bar keeps all limits: which single limit, loosened how far, gives one.

One limit is dropped first. Where the family then has four-bars, the limit is loosened by a share t of its value only,
and t falls in small steps, each beginning from the four-bars of the step before, down to the least that is reached.
"""

import math
from collections.abc import Callable

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.synthesis.candidate import Candidate
from ilmek.synthesis.motion.limits import LIMITS, FlagLimit, MotionLimit, breaches
from ilmek.synthesis.motion.search import MotionSpace, PairPool, PairSearch, feasible, reached, search_pairs

FIRST, COARSEST, FINEST = 0.02, 1.1, 1.003
"""First share t that is tried, doubled until it gives four-bars; greatest and least factor by which it then falls."""

SETS = 3
"""Sets of links of three poses among which four-bars without the limit are sought."""

BASINS = 1200
"""Four-bars without the limit from which the steps begin."""

GREATEST = 64.0
"""Greatest share by which a limit is loosened without being dropped."""


@record
class Cure:
    """A single limit, loosened just so far that there are four-bars.

    name   of the parameter      setting  its new value, as it is set      instead  the value given
    found  four-bars within all other limits then                          share    by which it was loosened [1]
    """

    name: str
    setting: str
    instead: str
    found: int
    share: float

    @property
    def words(self) -> str:
        """The cure as a phrase."""
        return f"{self.setting} instead of {self.instead} gives {self.found}"


def cures(
    space: MotionSpace, judged: Callable[[ComplexArray], Candidate], progress: Progress = SILENT
) -> tuple[Cure, ...]:
    """Every single limit that gives a four-bar if it is loosened, the least change first. Raises Cancelled.

    judged  pivots and pins [m] -> the four-bar's check
    """
    given = [limit for limit in LIMITS if limit.is_given(space.limits)]
    found = []
    for number, limit in enumerate(given):
        part = progress.part(number / len(given), (number + 1) / len(given), "loosen")
        found += _cure(space, judged, limit, part)
    return tuple(sorted(found, key=lambda one: one.share))


def _cure(
    space: MotionSpace, judged: Callable[[ComplexArray], Candidate], limit: MotionLimit, progress: Progress
) -> list[Cure]:
    """The cure by one limit; [] where none is found."""
    size = space.extent or space.frame.size
    without = MotionSpace(space.poses, space.curve, limit.loosened(space.limits, math.inf, size), space.most)
    is_flag = isinstance(limit, FlagLimit)
    seeds = SETS if len(space.family.forms) == 2 and not is_flag else 1
    pool, _, _, _ = without.sampled(without.bounds, 0, progress.part(0.0, 0.3))
    for seed in range(1, seeds):
        pool = pool.joined(without.sampled(without.bounds, seed, progress)[0])
    pool = pool.only(np.argsort(pool.scores, kind="stable"))
    near, _ = reached(without, pool, without.bounds, progress.part(0.3, 0.5))
    if not len(near.scores):
        return []
    if is_flag:
        search = search_pairs(without, 1, progress.part(0.5, 1.0))
        return [Cure(limit.name, f"{limit.name}=no", "yes", search.found, 1.0)] if search.pairs else []
    # Those that miss the given limit least come first.
    missed = space.repaired(near, space.bounds, 0, progress)
    near = near.only(np.argsort(missed.scores, kind="stable")[:BASINS])
    least = _least_share(space, near, limit, progress)
    return [] if least is None else _stated(space, judged, limit, least)


def _least_share(space: MotionSpace, near: PairPool, limit: MotionLimit, progress: Progress) -> float | None:
    """The least share by which a limit must be loosened, followed down from the pairs found without it."""
    share, factor, reached_at = FIRST, 2.0, math.inf
    while factor > FINEST and share <= GREATEST:
        progress(0.6)
        limits = limit.loosened(space.limits, share, space.extent or space.frame.size)
        trial = MotionSpace(space.poses, space.curve, limits, space.most)
        good = feasible(trial.repaired(near, trial.bounds, 25, progress))
        if len(good.scores):
            reached_at, near = share, good
            factor = min(factor, COARSEST)
            share = reached_at / factor
        elif math.isinf(reached_at):
            share *= factor
        else:
            factor = math.sqrt(factor)
            share = reached_at / factor
        if reached_at < 1e-3 * FIRST:
            break
    return None if math.isinf(reached_at) else reached_at


def _stated(
    space: MotionSpace, judged: Callable[[ComplexArray], Candidate], limit: MotionLimit, share: float
) -> list[Cure]:
    """The cure with its value rounded to what can be typed, and the four-bars that it gives."""
    limits = limit.loosened(space.limits, share * 1.002 + 1e-4, space.extent or space.frame.size)
    setting, instead, limits = limit.stated(space.limits, limits, share)
    trial = MotionSpace(space.poses, space.curve, limits, space.most)
    search: PairSearch = search_pairs(trial, 3)
    good = [pair for pair in search.pairs if not breaches(judged(pair.pins), limits)]
    return [Cure(limit.name, setting, instead, search.found, share)] if good else []
