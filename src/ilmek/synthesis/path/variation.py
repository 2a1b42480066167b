"""Variations of good four-bars as new starts of the path search (basin hopping with crossover).

Each variation takes one of the best different ends and changes it by one of:

    numbers    its ten numbers, by 2 to 70 %
    refit      link ratios and crank angles by 2 to 70 %, the other numbers by linear least squares (`path.starts`)
    mirror     the other branch, refitted
    cognate    coupler and rocker exchanged, the other branch, refitted: the cognate that rotates with the same crank
               has the same error, but other neighbours and other active bounds; then as `refit`
    crossover  its link ratios with the crank angles of another end, refitted
                                                                        [Wales and Doye 1997; changes: this project]
"""

import math

import numpy as np

from ilmek.arrays import Float, Int
from ilmek.synthesis.path.ends import ScaledTask, SearchEnds, restarted
from ilmek.synthesis.path.limits import MARGIN, TOLERANCE, excess, ratio_excess
from ilmek.synthesis.path.model import START, Design
from ilmek.synthesis.path.order import in_order
from ilmek.synthesis.path.starts import refit_all
from ilmek.synthesis.path.task import PathTask

SHARES = (0.45, 0.25, 0.08, 0.12, 0.10)
"""Share of each kind of variation, in the order above."""

NUMBERS, REFIT, MIRROR, COGNATE, CROSSOVER = range(5)

SMALLEST, GREATEST = 0.02, 0.7
"""Range of the relative changes."""

TURNED = 0.5
"""Change of the crank angles [rad] over that of the numbers [1]."""

EXACT = 100
"""Exact ends that are kept."""

DISTINCT = 1e-3
"""Relative difference of squared errors above which two ends are different."""


def different(scaled: ScaledTask, found: SearchEnds, count: int) -> SearchEnds:
    """The best `count` ends with different errors, and besides at most `EXACT` exact ones, which may be many."""
    order = np.argsort(found.errors, kind="stable")
    kept: list[int] = []
    last = 0.0
    exact = order[found.errors[order] <= scaled.exact][:EXACT]
    for index in order[np.sum(found.errors <= scaled.exact) :]:
        error = float(found.errors[index])
        if error > last * (1 + DISTINCT):
            kept.append(int(index))
            last = error
            if len(kept) == count:
                break
    return found.only(np.r_[exact, np.array(kept, dtype=np.int64)])


def varied(scaled: ScaledTask, pool: SearchEnds, count: int, rng: np.random.Generator) -> SearchEnds:
    """`count` variations of the ends of a pool, each end as often as the others; those within the limits."""
    size = len(pool.errors)
    chosen = pool.only(np.arange(count) % size)
    strength = np.exp(rng.uniform(math.log(SMALLEST), math.log(GREATEST), (count, 1)))
    kind = rng.choice(len(SHARES), count, p=SHARES)
    noise, turned = rng.normal(size=(count, 10)), rng.normal(size=chosen.angles.shape)
    other = pool.only(rng.integers(0, size, count))
    angles = np.where((kind == CROSSOVER)[:, None], other.angles, chosen.angles)
    designs, branches = chosen.designs.copy(), chosen.branches.copy()
    swapped = kind == COGNATE
    designs[swapped, 2], designs[swapped, 3] = chosen.designs[swapped, 3], chosen.designs[swapped, 2]
    branches[swapped | (kind == MIRROR)] *= -1
    designs[:, :4] *= np.exp(strength * noise[:, :4])
    designs[:, 4:] += strength * noise[:, 4:]
    designs[:, START] = np.clip(designs[:, START], scaled.low[START], scaled.high[START])
    if scaled.timed:
        angles = designs[:, START:] + scaled.along
    else:
        angles = _kept_in_order(scaled, angles, angles + TURNED * strength * turned)
    return _within(scaled, SearchEnds(designs, angles, branches, scaled.blocks(count), chosen.states), kind)


def _kept_in_order(
    scaled: ScaledTask, before: Float[np.ndarray, "some points"], changed: Float[np.ndarray, "some points"]
) -> Float[np.ndarray, "some points"]:
    """The changed angles, sorted where they were in order and must be."""
    if not scaled.task.ordered:
        return changed
    rising = np.where(before[:, -1:] >= before[:, :1], 1.0, -1.0)
    return np.where(in_order(before)[:, None], rising * np.sort(rising * changed, axis=1), changed)


def _within(scaled: ScaledTask, made: SearchEnds, kind: Int[np.ndarray, " some"]) -> SearchEnds:
    """The variations within the limits, as new starts: refitted, except where only the numbers are changed."""
    task = scaled.task
    limits = (scaled.low, scaled.high, task.sign, task.kappa)
    shortest = made.designs[:, 1 if task.sign > 0 else 0, None]
    made.designs[:, :4] = np.minimum(made.designs[:, :4], task.link_ratio * (1 - MARGIN) * shortest)
    plain = np.clip(made.designs, scaled.low, scaled.high)
    errors = np.empty(len(kind))
    refit_all(made.angles, made.branches, scaled.points, *limits, made.designs, errors)
    fitted = np.isfinite(errors) & (kind != NUMBERS)
    designs = np.where(fitted[:, None], made.designs, plain)
    good = np.array([_allowed(task, design) for design in designs], dtype=bool)
    return restarted(scaled, made._replace(designs=designs).only(good))


def _allowed(task: PathTask, design: Design) -> bool:
    """Whether a design keeps the limits of its links."""
    over = max(excess(design, task.sign, task.kappa), ratio_excess(design, task.sign, task.link_ratio))
    return over <= TOLERANCE
