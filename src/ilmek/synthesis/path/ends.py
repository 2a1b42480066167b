"""Ends of descents of the path search, and the task in sizes of its path."""

import math
from typing import NamedTuple

import numpy as np

from ilmek.arrays import Bool, Complex, Float, Int
from ilmek.records import record
from ilmek.synthesis.path.descent import EXACT, descend_all
from ilmek.synthesis.path.extent import penalised
from ilmek.synthesis.path.model import SIZE
from ilmek.synthesis.path.order import in_order, pooled
from ilmek.synthesis.path.task import PathTask

STAGES = ((30, 0.5), (60, 0.5), (400, 1.0))
"""Evaluations of each stage, and the share of the descents that continues after it."""

COARSE = 48
"""Greatest number of points of the search; its best ends are refined with all points."""

SAME = 1e-4
"""Relative difference up to which squared errors agree."""

ZERO_ERROR = 1e-6
"""Root mean square error, in sizes of the path, up to which errors agree."""

CONTINUED = 12
"""Ends whose order is restored, and that are refined with all points."""

REPAIRS, REPAIR_EVALUATIONS = 12, 100
"""Attempts to restore the order of the points of an end, and evaluations of each attempt."""


class SearchEnds(NamedTuple):
    """Ends of descents, in sizes of the path relative to its middle; one row per descent.

    states    of the descents (`descent.descend`)
    """

    designs: Float[np.ndarray, "some 10"]
    angles: Float[np.ndarray, "some points"]
    branches: Int[np.ndarray, " some"]
    blocks: Int[np.ndarray, "some points"]
    states: Float[np.ndarray, "some 5"]

    def only(self, which: slice | Bool[np.ndarray, " some"] | Int[np.ndarray, " part"]) -> "SearchEnds":
        """The selected ends, copied."""
        return SearchEnds(*(part[which] for part in self))

    def best(self, count: int) -> "SearchEnds":
        """The `count` best ends, sorted by error."""
        return self.only(np.argsort(self.errors, kind="stable")[:count])

    @property
    def errors(self) -> Float[np.ndarray, " some"]:
        """Squared errors, in squared sizes of the path."""
        return self.states[:, 0]


def joined(parts: list[SearchEnds]) -> SearchEnds:
    """Several sets of ends joined."""
    return SearchEnds(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))


@record
class ScaledTask:
    """A task in sizes of its path relative to its middle.

    size    of the path [m]
    along   the timing [rad], or without one the position of each point along the path, 0 to 1
    """

    task: PathTask
    middle: complex
    size: float
    points: Complex[np.ndarray, " points"]
    along: Float[np.ndarray, " points"]
    low: Float[np.ndarray, "10"]
    high: Float[np.ndarray, "10"]

    @property
    def timed(self) -> bool:
        """Whether the crank angles are given."""
        return self.task.timing is not None

    @property
    def size_max(self) -> float:
        """Greatest overall size of the four-bar, in sizes of the path."""
        return self.task.size_max / self.size

    @property
    def exact(self) -> float:
        """Squared error at the level of rounding."""
        return 1e6 * EXACT * len(self.points)

    @property
    def coarse(self) -> Int[np.ndarray, " part"]:
        """Indices of the points that the search uses."""
        return np.unique(np.linspace(0, len(self.points) - 1, COARSE).round().astype(int))

    def thinned(self, part: Int[np.ndarray, " part"]) -> "ScaledTask":
        """The task with a part of its points."""
        return ScaledTask(self.task, self.middle, self.size, self.points[part], self.along[part], self.low, self.high)

    def blocks(self, count: int) -> Int[np.ndarray, "count points"]:
        """The blocks of descents in which every point has its own angle, or the timing."""
        indices = np.arange(len(self.points))
        return np.tile(np.full_like(indices, -1) if self.timed else indices, (count, 1))

    def descend(self, found: SearchEnds, rounds: int) -> int:
        """Continue each descent in place; returns the number of evaluations."""
        before, task = found.states[:, 4].sum(), self.task
        arrays = (found.designs, found.angles, found.branches, found.states, found.blocks)
        numbers = (task.sign, task.kappa, task.link_ratio, self.size_max, rounds)
        descend_all(*arrays, self.points, self.low, self.high, *numbers)
        return int(found.states[:, 4].sum() - before)

    def agreeing(self, errors: Float[np.ndarray, " some"], best: float) -> Bool[np.ndarray, " some"]:
        """Which squared errors agree with one."""
        return np.asarray(np.abs(errors - best) <= SAME * best + ZERO_ERROR**2 * len(self.points))


def scaled_task(task: PathTask) -> ScaledTask:
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


def optimised(scaled: ScaledTask, found: SearchEnds) -> tuple[SearchEnds, int]:
    """Ends of descents in stages, the better ones continued, in order; and the number of evaluations."""
    evaluations = 0
    for rounds, stay in STAGES:
        evaluations += scaled.descend(found, rounds)
        found = found.best(math.ceil(stay * len(found.errors)))
    return _in_order(scaled, found, evaluations)


def refined(scaled: ScaledTask, found: SearchEnds) -> tuple[SearchEnds, int]:
    """The best ends for a part of the points optimised for all points, and the number of evaluations."""
    indices, part = np.arange(len(scaled.points)), scaled.coarse
    found = found.best(CONTINUED)
    angles = np.array([np.interp(indices, part, row) for row in found.angles]).reshape(-1, len(indices))
    if scaled.timed:
        angles = found.designs[:, 9:] + scaled.along
    found = restarted(scaled, found._replace(angles=angles, blocks=scaled.blocks(len(angles))))
    return _in_order(scaled, found, scaled.descend(found, STAGES[-1][0]))


def _in_order(scaled: ScaledTask, found: SearchEnds, evaluations: int) -> tuple[SearchEnds, int]:
    """The ends in order, where it is required, and the number of evaluations with those needed for it."""
    if scaled.timed or not scaled.task.ordered:
        return found, evaluations
    found, more = _with_order_restored(scaled, found)
    return found, evaluations + more


def restarted(scaled: ScaledTask, found: SearchEnds) -> SearchEnds:
    """The ends as new starts: squared errors recomputed, damping reset; without those that do not close."""
    rows = zip(found.designs, found.angles, found.branches, strict=True)
    states, size_max = np.zeros((len(found.branches), 5)), scaled.size_max
    states[:, 0] = [penalised(*row[:2], scaled.points, int(row[2]), size_max) for row in rows]
    states[:, 1:3] = 1e-2, 2.0
    return found._replace(states=states).only(np.isfinite(states[:, 0]))


def _with_order_restored(scaled: ScaledTask, found: SearchEnds) -> tuple[SearchEnds, int]:
    """Ends that meet the points in order, and the number of evaluations.

    The best of the others are optimised again with a common crank angle for points out of order. This increases their
    error: an end out of order that is worse than enough ends in order is dropped.
    """
    good = in_order(found.angles)
    ordered, unordered, evaluations = found.only(good), found.only(~good), 0
    for _ in range(REPAIRS):
        worst = np.sort(ordered.errors)[CONTINUED - 1] if len(ordered.errors) >= CONTINUED else math.inf
        unordered = unordered.best(CONTINUED)
        unordered = unordered.only(unordered.errors < worst)
        if not len(unordered.errors):
            break
        pairs = [pooled(angles, blocks) for angles, blocks in zip(unordered.angles, unordered.blocks, strict=True)]
        angles, blocks = (np.array(part) for part in zip(*pairs, strict=True))
        unordered = restarted(scaled, unordered._replace(angles=angles, blocks=blocks))
        evaluations += scaled.descend(unordered, REPAIR_EVALUATIONS)
        good = in_order(unordered.angles)
        ordered, unordered = joined([ordered, unordered.only(good)]), unordered.only(~good)
    return ordered, evaluations
