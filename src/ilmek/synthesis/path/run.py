"""One run of the path search: random starts, then variations of the best ends until the best stays the same.

The runs of a search are independent: how often they end at the same best is the evidence that no better one is missed.
"""

import math
from typing import NamedTuple

import numpy as np

from ilmek.arrays import Float
from ilmek.synthesis.path.ends import ScaledTask, SearchEnds, joined, optimised, restarted
from ilmek.synthesis.path.links import random_links
from ilmek.synthesis.path.model import SIZE
from ilmek.synthesis.path.starts import RANDOM_NUMBERS, start_all
from ilmek.synthesis.path.variation import different, varied

RUN = 192
"""Random starts of a run."""


class Rounds(NamedTuple):
    """Rounds of variations: the different ends that are varied in a round, and their variations.

    quiet  successive rounds without a better end after which they end      most  greatest number of rounds
    """

    pool: int
    variations: int
    quiet: int
    most: int


OF_RUN, OF_ALL = Rounds(pool=24, variations=64, quiet=6, most=40), Rounds(pool=32, variations=128, quiet=12, most=60)
"""Rounds of one run, and of the best ends of all runs."""

BETTER = 1e-4
"""Relative reduction of the error that counts as better."""


class RunEnds(NamedTuple):
    """Ends of a run, without those of equal error, the best first.

    starts       squared errors of the ends of its random starts
    evaluations  number of evaluations
    """

    found: SearchEnds
    starts: Float[np.ndarray, " some"]
    evaluations: int


def run(scaled: ScaledTask, seed: int, number: int, starts: int) -> RunEnds:
    """One run of at most `RUN` random starts; its random numbers depend on the seed and its number alone."""
    rng = np.random.default_rng([seed, number])
    found, evaluations = optimised(scaled, random_starts(scaled, rng, starts))
    errors = found.errors
    pool, more = varied_until_quiet(scaled, found, rng, OF_RUN)
    return RunEnds(pool, errors, evaluations + more)


def varied_until_quiet(
    scaled: ScaledTask, found: SearchEnds, rng: np.random.Generator, rounds: Rounds
) -> tuple[SearchEnds, int]:
    """The different ends after rounds of variations, until some bring no better one; and the number of evaluations."""
    kept, evaluations, same = 2 * rounds.pool, 0, 0
    pool = different(scaled, found, kept)
    for _ in range(rounds.most):
        if same == rounds.quiet or not len(pool.errors) or pool.errors[0] <= scaled.exact:
            break
        best = float(pool.errors[0])
        ends = varied(scaled, pool.only(slice(rounds.pool)), rounds.variations, rng)
        if len(ends.errors):
            ends, more = optimised(scaled, ends)
            evaluations += more
            pool = different(scaled, joined([pool, ends]), kept)
        same = 0 if pool.errors[0] < best * (1 - BETTER) else same + 1
    return pool, evaluations


def random_starts(scaled: ScaledTask, rng: np.random.Generator, count: int) -> SearchEnds:
    """Random starts; those within the limits."""
    task = scaled.task
    bounds = scaled.low[:4], scaled.high[:4]
    links = random_links(rng, count, bounds, kind=task.sign, kappa=task.kappa, ratio=task.link_ratio)
    count, points = len(links), scaled.points
    designs, angles = np.empty((count, SIZE)), np.empty((count, len(points)))
    branches, states = np.empty(count, dtype=np.int64), np.zeros((count, 5))
    states[:, 1:3] = 1e-2, 2.0
    errors = np.empty(count)
    limits = (scaled.low, scaled.high, task.sign, task.kappa)
    given = (rng.random((count, RANDOM_NUMBERS)), links, scaled.along, scaled.timed, task.closed, points)
    start_all(*given, *limits, designs, angles, branches, errors)
    states[:, 0] = errors
    made = SearchEnds(designs, angles, branches, scaled.blocks(count), states).only(np.isfinite(errors))
    return made if math.isinf(task.size_max) else restarted(scaled, made)
