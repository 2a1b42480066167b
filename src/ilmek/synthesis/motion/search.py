"""Search of all pairs of guides of three or four poses that fulfil every limit.

Three poses leave both pivots free, a family of four parameters; four poses leave a curve for each pivot, a family of
two. About a million pairs of links are evaluated in compiled code, against all limits at once. Pairs that miss a limit
are moved to where they fulfil it (`refine.to_limits`), so that a small feasible part of the family is met although no
sample lies in it. Answers are chosen one by one: the pair of the best merit, improved by a local search, then the best
of those that differ enough from all before it (`apart`). The same task always has the same answer.
"""

import math
from collections.abc import Mapping

import numpy as np

from ilmek.arrays import ComplexArray, Float, FloatArray, IntArray
from ilmek.params.text_lists import BodyPoses
from ilmek.plane.vectors import unit
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.synthesis.burmester.constant_distance import TaskFrame, homogeneous, pose_forms
from ilmek.synthesis.burmester.curve import BurmesterCurve
from ilmek.synthesis.burmester.links import other_ends
from ilmek.synthesis.distinct import APART, CLOSEST, SWAPPED
from ilmek.synthesis.merit import RULE_SINE, extent_of_points
from ilmek.synthesis.motion import measures, refine, regions
from ilmek.synthesis.motion.limits import MotionLimits

LINKS = 1000
"""Links of three poses that are paired with each other, unless their number is given."""

ROWS = 50
"""Links whose pairs are evaluated in one call of compiled code."""

STARTS, STEPS = 600, 15
"""Pairs that miss a limit from which the search moves to the limits, and its steps."""

ENOUGH = 60
"""Pairs of different links within the limits with which no further ones are sought."""

ROUNDS = 3
"""Sets of links of three poses that are tried before a task counts as without answer."""

RULED = 300
"""Pairs, the best first, that are moved to where they keep the rule of thumb for transmission angles."""

REACH = 0.05
"""Side of the first simplex of a local search for three poses, in sizes of the task; of four: one sample."""

NEAR, FAR = 0.03, 30.0
"""Least and greatest distance of a link's end from the poses that is tried, in sizes of the task."""

EVALUATIONS = 360
"""Evaluations of the merit in one local search."""

REASONS = {
    measures.RATIO: "link_ratio",
    measures.BRANCH: "one_branch",
    measures.CIRCUIT: "one_circuit",
    measures.ORDER: "in_order",
    measures.TURN: "full_turn",
    measures.TRANSMISSION: "transmission",
    measures.CRANK_REGION: "crank_region",
    measures.ROCKER_REGION: "rocker_region",
    measures.CRANK_SWING: "crank_swing",
    measures.SIZE: "size",
    measures.ROCKER_SWING: "rocker_swing",
    measures.KEEP_OUT: "keep_out",
}
"""Name of each margin, as in `filters.REASONS`."""


@record
class FoundPair:
    """A pair of guides: pivots and pins at the first pose [m], crank first; its merit, or the violation that is left.

    apart  distance from the nearest answer before it, in extents of the task; inf for the first
    """

    pins: ComplexArray
    worth: float
    apart: float = math.inf


@record
class PairSearch:
    """What a search found.

    pairs     answers that differ, the best merit first        found  pairs of the samples within all limits
    searched  pairs that were evaluated                        left_out  pairs that missed a limit, by its name
    nearest   without an answer: the pairs that come nearest to the limits
    """

    pairs: tuple[FoundPair, ...]
    found: int
    searched: int
    left_out: Mapping[str, int]
    nearest: tuple[FoundPair, ...]


@record
class PairPool:
    """Pairs by their parameters: rows of x and parts, score (minus the merit, or the violation)."""

    xs: FloatArray
    parts: IntArray
    scores: FloatArray

    def only(self, which: IntArray) -> "PairPool":
        """Some of the pairs, by their indices."""
        return PairPool(self.xs[which], self.parts[which], self.scores[which])

    def joined(self, other: "PairPool") -> "PairPool":
        """These pairs and those of another pool."""
        return PairPool(
            np.concatenate([self.xs, other.xs]),
            np.concatenate([self.parts, other.parts]),
            np.concatenate([self.scores, other.scores]),
        )


class MotionSpace:
    """The family of pairs of guides of poses, and its search.

    poses  three or four      curve  of four poses: their curve, densely sampled
    links  links of three poses that are paired with each other
    """

    def __init__(
        self, poses: BodyPoses, curve: BurmesterCurve | None, limits: MotionLimits, links: int = LINKS
    ) -> None:
        self.poses, self.curve, self.limits, self.most = poses, curve, limits, links
        forms, self.frame = pose_forms(*poses)
        self.extent = extent_of_points(poses.points)
        if not self.extent:
            self.frame = TaskFrame(self.frame.origin, limits.scale)
            forms, _ = pose_forms(poses.points / limits.scale, poses.angles)
        points = self.frame.to_frame(poses.points)
        samples, ends = np.zeros((0, 3)), np.zeros((0, 2), dtype=np.int64)
        if curve is not None:
            loops = [loop.centres for loop in curve.loops if len(loop.centres) > 1]
            samples = np.concatenate([samples, *loops])
            stops = np.cumsum([len(loop) for loop in loops])
            ends = np.concatenate([ends, *(np.tile([stop - len(loop), stop], (len(loop), 1))
                                           for loop, stop in zip(loops, stops, strict=True))])  # fmt: skip
        turned = np.asarray(unit(poses.angles - poses.angles[0]))
        self.family = refine.GuideFamily(np.ascontiguousarray(forms), points, turned, samples, ends)
        self.bounds = limits.in_frame(self.frame, (self.extent or self.frame.size) / self.frame.size)
        self.link_count = 0
        self.mirror = _mirror(points, poses.angles)

    @property
    def unit(self) -> float:
        """Extent of the task in sizes of its frame."""
        return (self.extent or self.frame.size) / self.frame.size

    def links(self, which: int, seed: int) -> tuple[FloatArray, IntArray, ComplexArray, ComplexArray]:
        """Parameters, samples of the curve, pivots and pins (frame) of the links of one role, 0 crank or 1 rocker."""
        if len(self.family.forms) == 2:
            pivots = self._pivots(which, seed)
            ends = homogeneous(pivots)
            pins = other_ends(ends, self.family.forms)
            xs, parts = np.stack([pivots.real, pivots.imag], axis=-1), np.zeros(len(pivots), dtype=np.int64)
        else:
            ends = self.family.curve
            pins = np.stack([self._pin(pivot) for pivot in ends])
            parts = np.arange(len(ends))
            xs = parts[:, None].astype(float)
        good = (np.abs(pins[:, 2]) > 1e-9) & (np.abs(ends[:, 2]) > 1e-9)
        ends, pins = ends[good], pins[good]
        pivots = (ends[:, 0] + 1j * ends[:, 1]) / ends[:, 2]
        return xs[good], parts[good], pivots, (pins[:, 0] + 1j * pins[:, 1]) / pins[:, 2]

    def _pin(self, pivot: FloatArray) -> FloatArray:
        lines = np.einsum("a,iab->ib", pivot, self.family.forms)
        crossed = np.cross(lines, np.roll(lines, -1, axis=0))
        best = crossed[np.argmax(np.sum(crossed**2, axis=-1))]
        return np.asarray(best / max(float(np.linalg.norm(best)), 1e-300))

    def _pivots(self, which: int, seed: int) -> ComplexArray:
        """Pivots of three poses: of links with a pivot near the poses, and of links with a pin near them."""
        share = _spread(4 * self.most, seed)
        middle = complex(np.mean(self.family.points))
        most = min(FAR, 1.05 * float(self.bounds.limits[measures.SIZE_MAX]) + 0.1)
        around = middle + NEAR * (most / NEAR) ** share[:, 0] * unit(2 * math.pi * share[:, 1])
        box, corners = self.bounds.boxes[which], (self.bounds.crank, self.bounds.rocker)[which]
        low = np.maximum(box[[0, 2]], [middle.real - most, middle.imag - most])
        high = np.minimum(box[[1, 3]], [middle.real + most, middle.imag + most])
        if len(corners):
            low = np.maximum(low, [corners.real.min(), corners.imag.min()])
            high = np.minimum(high, [corners.real.max(), corners.imag.max()])
        if np.any(low > high):  # the region is farther than any four-bar of the greatest size reaches
            return np.zeros(0, dtype=complex)
        even = low + (high - low) * share
        evenly = even[:, 0] + 1j * even[:, 1]
        ends = other_ends(homogeneous(around), np.swapaxes(self.family.forms, -1, -2))
        near = np.abs(ends[:, 2]) > 1e-9 * np.hypot(ends[:, 0], ends[:, 1])
        of_pins = (ends[near, 0] + 1j * ends[near, 1]) / ends[near, 2]
        sets = [self._inside(one, which)[: self.most // 3 + 1] for one in (around, of_pins, evenly)]
        return np.concatenate(sets)[: self.most]

    def _inside(self, pivots: ComplexArray, which: int) -> ComplexArray:
        box, corners = self.bounds.boxes[which], (self.bounds.crank, self.bounds.rocker)[which]
        rows = (pivots.real >= box[0]) & (pivots.real <= box[1]) & (pivots.imag >= box[2]) & (pivots.imag <= box[3])
        found = pivots[rows]
        if len(corners):
            found = found[np.array([regions.polygon_margin(complex(one), corners) >= 0 for one in found], dtype=bool)]
        return np.asarray(found)

    def sampled(
        self, bounds: measures.SearchBounds, seed: int, progress: Progress
    ) -> tuple[PairPool, int, int, IntArray]:
        """The best pair of each link; how many fulfil the limits, of how many; failures by margin."""
        sides = [self.links(0, seed)]
        sides.append(sides[0] if self.limits.same_regions else self.links(1, seed))
        arrays = [self._arrays(side[2], side[3]) for side in sides]
        rows, columns = (len(side[2]) for side in sides)
        self.link_count = rows if self.limits.same_regions else rows + columns
        best = [np.full(rows, np.inf), np.full(columns, np.inf)]
        partner = [np.zeros(rows, dtype=np.int64), np.zeros(columns, dtype=np.int64)]
        counts, found = np.zeros(measures.MARGINS, dtype=np.int64), 0
        for start in range(0, rows, ROWS):
            progress(start / max(rows, 1))
            found += measures.search_rows(
                start, min(start + ROWS, rows), arrays[0], arrays[1], self.family.points, bounds,
                best[0], partner[0], best[1], partner[1], counts,
            )  # fmt: skip
        if not rows or not columns:
            none = PairPool(np.zeros((0, 2 * sides[0][0].shape[1])), np.zeros((0, 2), dtype=np.int64), np.zeros(0))
            return none, 0, 0, counts
        i = np.concatenate([np.arange(rows), partner[1]])
        j = np.concatenate([partner[0], np.arange(columns)])
        scores = np.concatenate(best)
        _, first = np.unique(np.stack([i, j]), axis=1, return_index=True)
        first = first[np.isfinite(scores[first])]
        xs = np.concatenate([sides[0][0][i], sides[1][0][j]], axis=1)
        parts = np.stack([sides[0][1][i], sides[1][1][j]], axis=1)
        pool = PairPool(np.ascontiguousarray(xs[first]), np.ascontiguousarray(parts[first]), scores[first])
        return pool.only(np.argsort(pool.scores, kind="stable")), found, rows * columns, counts

    def _arrays(self, pivots: ComplexArray, pins: ComplexArray) -> tuple[ComplexArray, ComplexArray, FloatArray]:
        at = self.family.points + (pins[:, None] - self.family.points[0]) * self.family.turned
        return pivots, at, np.angle(at - pivots[:, None])

    def repaired(self, pool: PairPool, bounds: measures.SearchBounds, steps: int, progress: Progress) -> PairPool:
        """The pairs moved to the limits; scores as in the pool."""
        count = len(pool.scores)
        xs, left, worth = pool.xs.copy(), np.empty(count), np.empty(count)
        for start in range(0, count, ROWS):
            progress(start / count)
            refine.repair_rows(
                self.family, bounds, ALONE, xs, pool.parts, start, min(start + ROWS, count), steps, left, worth
            )
        return PairPool(xs, pool.parts, np.where(left > 0, left, -worth))

    def pins(self, x: FloatArray, parts: IntArray) -> ComplexArray:
        """Pivots and pins m1, m2, w1, w2 of a pair in the frame."""
        return np.asarray(refine.pair_of(self.family, x, parts))

    def equivalents(self, pins: ComplexArray) -> ComplexArray:
        """The same pair, driven at either side, and its mirror image where the poses have one."""
        same = [pins, pins[SWAPPED]]
        if self.mirror is not None:
            centre, factor = self.mirror
            last = self.family.points[-1] + (pins[2:] - self.family.points[0]) * self.family.turned[-1]
            image = np.array([centre + factor * np.conj(one - centre) for one in (*pins[:2], *last)])
            same += [image, image[SWAPPED]]
        return np.array(same)


def _reason(limits: MotionLimits, margin: int) -> str:
    """Name of a margin; a transmission angle that is required only to transmit at all has its own."""
    return "transmits" if margin == measures.TRANSMISSION and limits.filters.transmits_only else REASONS[margin]


ALONE = refine.OtherPairs(np.zeros((0, 4), dtype=complex), 0.0)
"""No other pairs near by."""


def _spread(count: int, seed: int) -> Float[np.ndarray, "count 2"]:
    """Points spread evenly over the unit square.   [the R2 sequence, Roberts 2018]"""
    at = np.arange(1, count + 1)[:, None] + seed * count
    return np.asarray((0.5 + at * np.array([0.7548776662466927, 0.5698402909980532])) % 1.0)


def _mirror(points: ComplexArray, angles: FloatArray) -> tuple[complex, complex] | None:
    """The reflection z -> c + f conj(z - c) that takes the poses onto themselves, the last one first; else None."""
    sums = angles + angles[::-1]
    across = points[-1] - points[0]
    if not abs(across) or np.max(np.abs(np.angle(unit(sums - sums[0])))) > 1e-9:
        return None
    centre, direction = complex(points[0] + points[-1]) / 2, across / abs(across)
    factor = -complex(direction * direction)
    image = centre + factor * np.conj(points[::-1] - centre)
    return (centre, factor) if np.max(np.abs(image - points)) < 1e-9 else None


def search_pairs(space: MotionSpace, count: int, progress: Progress = SILENT) -> PairSearch:
    """At most `count` pairs within all limits that differ, the best merit first. Raises Cancelled."""
    pool, found, searched, counts = space.sampled(space.bounds, 0, progress.part(0.0, 0.2))
    good = feasible(pool)
    if len(good.scores) < ENOUGH:
        good, others = reached(space, pool, space.bounds, progress.part(0.2, 0.5))
        for seed in range(1, ROUNDS if len(space.family.forms) == 2 else 1):
            if len(good.scores):
                break
            more, more_found, more_searched, more_counts = space.sampled(space.bounds, seed, progress)
            found, searched, counts = found + more_found, searched + more_searched, counts + more_counts
            good, again = reached(space, more, space.bounds, progress)
            others = others.joined(again)
        nearest = others.only(np.argsort(others.scores, kind="stable")[:count])
    else:
        nearest = pool.only(np.arange(0))
    pairs = chosen_pairs(space, good, count, progress.part(0.5, 1.0))
    return PairSearch(
        pairs,
        max(found, len(good.scores)),
        searched,
        {_reason(space.limits, at): int(number) for at, number in enumerate(counts) if number},
        ()
        if pairs
        else tuple(_as_pair(space, one, at, math.inf) for one in [nearest] for at in range(len(one.scores))),
    )


def reached(
    space: MotionSpace, pool: PairPool, bounds: measures.SearchBounds, progress: Progress
) -> tuple[PairPool, PairPool]:
    """The feasible pairs of a pool and of those moved to the limits, and the others."""
    good = feasible(pool)
    rest = pool.only(np.flatnonzero(pool.scores > 0)[:STARTS])
    moved = space.repaired(rest, bounds, STEPS, progress) if len(rest.scores) else rest
    return good.joined(feasible(moved)), moved.only(np.flatnonzero(moved.scores > 0))


def feasible(pool: PairPool) -> PairPool:
    """The pairs of a pool that keep all limits."""
    return pool.only(np.flatnonzero(pool.scores <= 0))


def chosen_pairs(space: MotionSpace, pool: PairPool, count: int, progress: Progress) -> tuple[FoundPair, ...]:
    """The best pairs of a pool that differ, each improved, the best first.

    Pairs that keep the rule of thumb for transmission angles come first; then all, and where these are too few, pairs
    that differ less.
    """
    rule = space.bounds.limits.copy()
    rule[measures.LEAST_SINE] = max(rule[measures.LEAST_SINE], RULE_SINE)
    ruled = space.bounds._replace(limits=rule)
    near = pool.only(np.argsort(pool.scores, kind="stable")[:RULED])
    chosen: list[FoundPair] = []
    taken = np.zeros((0, 4), dtype=complex)
    for bounds, some, least in (
        (ruled, feasible(space.repaired(near, ruled, STEPS, progress)), APART),
        (space.bounds, pool, CLOSEST),
    ):
        some = some.only(np.argsort(some.scores, kind="stable"))
        all_pins = np.array([space.pins(x, parts) for x, parts in zip(some.xs, some.parts, strict=True)])
        apart = APART
        while len(some.scores) and len(chosen) < count and apart >= least:
            progress(len(chosen) / count)
            free = np.flatnonzero(_gaps(all_pins, taken) > apart * space.unit)
            if not len(free):
                apart /= 2
                continue
            others = refine.OtherPairs(taken, apart * space.unit)
            pins, worth = _improved(space, bounds, others, some, int(free[0]))
            chosen.append(FoundPair(space.frame.to_world(pins), worth, float(_gaps(pins[None], taken)[0]) / space.unit))
            taken = np.concatenate([taken, space.equivalents(pins)])
    return tuple(sorted(chosen, key=lambda one: -one.worth))


def _improved(
    space: MotionSpace, bounds: measures.SearchBounds, others: refine.OtherPairs, pool: PairPool, at: int
) -> tuple[ComplexArray, float]:
    """Pivots and pins, and merit, of the best pair near one of a pool."""
    x, parts = pool.xs[at].copy(), pool.parts[at]
    side = REACH if len(space.family.forms) == 2 else 1.0
    worth = -refine.improve(space.family, bounds, others, x, parts, side, EVALUATIONS)
    return space.pins(x, parts), float(worth)


def _gaps(pins: ComplexArray, taken: ComplexArray) -> FloatArray:
    """Distance of each pair from the nearest of those taken; inf without any."""
    apart = np.max(np.abs(pins[:, None] - taken[None]), axis=-1)
    return np.asarray(np.min(apart, axis=1, initial=math.inf))


def _as_pair(space: MotionSpace, pool: PairPool, at: int, apart: float) -> FoundPair:
    return FoundPair(_to_world(space, space.pins(pool.xs[at], pool.parts[at])), float(pool.scores[at]), apart)


def _to_world(space: MotionSpace, pins: ComplexArray) -> ComplexArray:
    return space.frame.to_world(pins)
