"""Search of the least distances of pairs of pieces over the turn of a drive: all pairs together, interval by interval.

Where two pieces are d and d' apart at two angles, and their points move at most w against each other between them
(`poses`), they are in between nowhere nearer than

    (d + d' - w) / 2        [a point that is moved from p to p' by way of q has |p - q| + |q - p'| = |p - p'|]

Intervals whose bound lies below both the least distance so far and the required one are halved until none does by more
than `TOLERANCE`. Distances of convex hulls come first; meshes are compared in the intervals that the hulls leave open.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias, TypeVar

import numpy as np

from ilmek.arrays import BoolArray, Float, FloatArray, Int, IntArray
from ilmek.part.colliders import Collider, distances
from ilmek.part.poses import poses
from ilmek.part.swept import Piece, SweptPieces
from ilmek.units import mm

TOLERANCE = 0.5 * mm
"""How far the least distance that is reported may be above that of the meshes [m]."""

_ROUNDING = 1e-9
"""Difference of lengths that counts as rounding [m]."""

_SHORTEST = 1e-6
"""Interval that is not halved further [rad]."""

_Numbers = TypeVar("_Numbers", IntArray, FloatArray)

Relative: TypeAlias = tuple[Float[np.ndarray, "angles 3 3"], Float[np.ndarray, "angles 3"]]
"""Rotation and origin [m] of a part in the axes of another."""


@dataclass(frozen=True, eq=False)
class PiecePair:
    """Two pieces that move against each other, by their bodies and numbers.

    shared   number of the links that both chains begin with    gaps  distances of their boxes in the intervals [m]
    horizon  distance from which on they are left out [m]       enough  above which the exact one is not needed [m]
    """

    carried: tuple[SweptPieces, SweptPieces]
    numbers: tuple[int, int]
    shared: int
    gaps: FloatArray
    horizon: float
    enough: float

    @cached_property
    def pieces(self) -> tuple[Piece, Piece]:
        """Both."""
        first, other = (own.pieces[number] for own, number in zip(self.carried, self.numbers, strict=True))
        return first, other

    @cached_property
    def colliders(self) -> tuple[Collider, Collider]:
        """What is compared: of two rows of many parts three of the first."""
        first, other = self.pieces
        return (first.few if first.few and other.few else first.collider), other.collider

    @property
    def convex(self) -> bool:
        """Whether both are their own hulls."""
        return all(own.convex for own in self.colliders)

    @property
    def near(self) -> BoolArray:
        """Whether their boxes are near, of each interval."""
        return np.asarray(self.gaps < self.horizon)

    @property
    def ends(self) -> Float[np.ndarray, "n samples"]:
        """Samples of the intervals in which their boxes are near [rad]."""
        return np.asarray(self.carried[0].ends[self.near])


@dataclass(frozen=True, eq=False)
class PairDistances:
    """Where pairs are nearest: least distance of each [m], inf where it is the horizon or more, and its angle [rad]."""

    distance: FloatArray
    angle: FloatArray


@dataclass(frozen=True, eq=False)
class _Intervals:
    """Intervals of the turn in which pairs are looked at.

    owner  number of the pair of each      ends  of each [rad]      bound  known least distance in each [m]
    """

    owner: IntArray
    ends: Float[np.ndarray, "n 2"]
    bound: FloatArray

    def chosen(self, some: BoolArray) -> "_Intervals":
        """Some of them."""
        return _Intervals(self.owner[some], self.ends[some], self.bound[some])


@dataclass(frozen=True, eq=False)
class ApproachSearch:
    """Pairs of one drive."""

    pairs: Sequence[PiecePair]

    def nearest(self) -> PairDistances:
        """Where each pair is nearest."""
        pairs = self.pairs
        if not pairs:
            return PairDistances(np.zeros(0), np.zeros(0))
        owner = np.repeat(np.arange(len(pairs)), [int(pair.near.sum()) for pair in pairs])
        ends = np.concatenate([pair.ends[:, [0, -1]] for pair in pairs])
        hulls, intervals = self._halved(
            _Intervals(owner, ends, np.concatenate([pair.gaps[pair.near] for pair in pairs])), exact=False
        )
        distance, angle = hulls.distance, hulls.angle
        proven = (distance >= self._enough) & (distance > 0)
        rest = [k for k in np.flatnonzero(distance < self._horizon).tolist() if self._needs_meshes(k, proven[k])]
        numbers = np.array(rest, dtype=int)
        distance[rest] = self._distances(numbers, self.relative(numbers, angle[rest]), exact=True)
        rest = [k for k in rest if not proven[k] and distance[k] > 0]
        if rest:
            meshes, _ = self._halved(self._left_open(intervals, rest), exact=True)
            distance[rest], angle[rest] = meshes.distance[rest], meshes.angle[rest]
        return PairDistances(np.where(distance < self._horizon, distance, np.inf), angle)

    def relative(self, owner: IntArray, angle: FloatArray) -> Relative:
        """Position of the second piece in the axes of the first, of pairs by their numbers, at angles [rad]."""
        (own, from_), (its, to) = (self._placed(side, owner, angle) for side in (0, 1))
        back = own.swapaxes(1, 2)
        return back @ its, (back @ (to - from_)[:, :, None])[:, :, 0]

    @cached_property
    def _enough(self) -> FloatArray:
        return np.array([pair.enough for pair in self.pairs])

    @cached_property
    def _horizon(self) -> FloatArray:
        return np.array([pair.horizon for pair in self.pairs])

    def _needs_meshes(self, number: int, proven: bool) -> bool:
        """Whether the distance of the hulls does not do, for a pair by its number."""
        pair = self.pairs[number]
        return not pair.convex and not (proven and any(own.large for own in pair.colliders))

    def _left_open(self, intervals: _Intervals, rest: Sequence[int]) -> _Intervals:
        """Of pairs by their numbers the intervals in which the hulls are not far enough apart, or else the nearest."""
        own = intervals.chosen(np.isin(intervals.owner, rest))
        near = own.bound < self._enough[own.owner]
        lowest, _ = _least_of(own.owner, own.bound, len(self.pairs))
        has_near = np.bincount(own.owner[near], minlength=len(self.pairs)) > 0
        return own.chosen(np.where(has_near[own.owner], near, own.bound <= lowest[own.owner]))

    @cached_property
    def _positions(self) -> tuple[Relative, Relative]:
        """Positions of the pieces in their bodies."""
        first, other = (
            (
                np.array([pair.pieces[side].position.rotation for pair in self.pairs]),
                np.array([pair.pieces[side].position.origin for pair in self.pairs]),
            )
            for side in (0, 1)
        )
        return first, other

    @cached_property
    def _bodies(self) -> tuple[tuple[SweptPieces, ...], Int[np.ndarray, "2 pairs"]]:
        """The bodies of all pieces, and the number of that of each piece."""
        numbers: dict[SweptPieces, int] = {}
        own = [[numbers.setdefault(body, len(numbers)) for body in pair.carried] for pair in self.pairs]
        return tuple(numbers), np.array(own).T

    def _placed(self, side: int, owner: IntArray, angle: FloatArray) -> Relative:
        """Rotations and origins [m] of a piece of each pair in the scene, at angles [rad]."""
        bodies, numbers = self._bodies
        body = numbers[side, owner]
        rotation, origin = np.empty((len(angle), 3, 3)), np.empty((len(angle), 3))
        for number in np.unique(body).tolist():
            here, carried = np.flatnonzero(body == number), bodies[number]
            there = poses(carried.travel.chain, carried.travel.drive, angle[here])
            rotation[here], origin[here] = there.rotation, there.origin
        turned, away = (own[owner] for own in self._positions[side])
        return rotation @ turned, origin + (rotation @ away[:, :, None])[:, :, 0]

    def _distances(self, owner: IntArray, lies: Relative, *, exact: bool) -> FloatArray:
        """Distances of pairs by their numbers at positions [m]; exact: of the meshes, not of their hulls."""
        return distances((self.pairs[number].colliders for number in owner.tolist()), *lies, exact=exact)

    @cached_property
    def _boxes(self) -> tuple[Float[np.ndarray, "2 pairs 3"], Float[np.ndarray, "2 pairs 3"]]:
        """Middles and half sides of the boxes of both pieces of each pair, in their own axes [m]."""
        bounds = np.array([[own.bounds for own in pair.colliders] for pair in self.pairs])
        low, high = bounds[:, :, 0].swapaxes(0, 1), bounds[:, :, 1].swapaxes(0, 1)
        return (low + high) / 2, (high - low) / 2

    def _box_gaps(self, owner: IntArray, lies: Relative) -> FloatArray:
        """Least distances of what is in the boxes of both pieces at positions, along the axes of either [m]."""
        (turned, moved), (middles, halves) = lies, self._boxes
        apart = (turned @ middles[1, owner, :, None])[:, :, 0] + moved - middles[0, owner]
        wide, (own, its) = np.abs(turned), halves[:, owner, :, None]
        back = (turned.swapaxes(1, 2) @ apart[:, :, None])[:, :, 0]
        first = np.abs(apart) - (own + wide @ its)[:, :, 0]
        other = np.abs(back) - (its + wide.swapaxes(1, 2) @ own)[:, :, 0]
        return np.asarray(np.linalg.norm(np.maximum([first, other], 0.0), axis=2).max(0))

    @cached_property
    def _angles(self) -> FloatArray:
        """Of the drive, between which every motion is straight [rad]."""
        return self.pairs[0].carried[0].travel.angles

    @cached_property
    def _travelled(self) -> tuple[Float[np.ndarray, "rows angles"], Int[np.ndarray, "2 pairs"]]:
        """Travel of the pieces at the angles [m], and the row of that of each piece of each pair."""
        rows: dict[tuple[SweptPieces, int, int], int] = {}
        own = [
            [
                rows.setdefault((carried, pair.shared, number), len(rows))
                for carried, number in zip(pair.carried, pair.numbers, strict=True)
            ]
            for pair in self.pairs
        ]
        return np.stack([carried.moved(number, shared) for carried, shared, number in rows]), np.array(own).T

    def _moved(self, owner: IntArray, number: IntArray) -> FloatArray:
        """Travel against each other at angles by their numbers [m]: by the links that the chains do not share."""
        travels, (first, other) = self._travelled
        return np.asarray(travels[first[owner], number] + travels[other[owner], number])

    def _travel(self, owner: IntArray, angle: FloatArray) -> FloatArray:
        """The same at any angles [rad]."""
        angles, last = self._angles, len(self._angles) - 1
        before = np.minimum(np.searchsorted(angles, angle, side="right") - 1, last - 1)
        begin, end = self._moved(owner, before), self._moved(owner, before + 1)
        slope = (end - begin) / (angles[before + 1] - angles[before])
        return np.where(angle >= angles[last], end, slope * (angle - angles[before]) + begin)

    def _middles(self, intervals: _Intervals) -> FloatArray:
        """The angle at which half of the travel of each interval is done, or its middle where that is at an end [rad].

        Something moves in each.
        """
        owner, (low, high), angles = intervals.owner, intervals.ends.T, self._angles
        half = np.stack([self._travel(owner, low), self._travel(owner, high)], axis=1).mean(1)
        before = np.searchsorted(angles, low, side="right") - 1
        after = np.minimum(np.searchsorted(angles, high, side="right"), len(angles) - 1)
        while (after - before > 1).any():
            between = (before + after) // 2
            reached = self._moved(owner, between) <= half
            before, after = np.where(reached, between, before), np.where(reached, after, between)
        begin, end = self._moved(owner, before), self._moved(owner, after)
        slope = (angles[after] - angles[before]) / (end - begin)
        middle = np.where(begin == half, angles[before], slope * (half - begin) + angles[before])
        return np.asarray(np.where((low < middle) & (middle < high), middle, intervals.ends.mean(1)))

    def _halved(self, intervals: _Intervals, *, exact: bool) -> tuple[PairDistances, _Intervals]:
        """Where the pairs that have intervals are nearest, and these, halved until that is known."""
        samples, closed = _Samples(self, exact), list[_Intervals]()
        once, back = np.unique(np.repeat(intervals.owner, 2) + 1j * intervals.ends.ravel(), return_inverse=True)
        number = samples.added(once.real.astype(int), once.imag)[back].reshape(-1, 2)
        while True:
            owner, ends = intervals.owner, intervals.ends
            travel = self._travel(owner, ends[:, 1]) - self._travel(owner, ends[:, 0])
            undecided = samples.apart[number].sum(1) - travel < 2 * self._enough[owner]
            samples.measure(np.unique(number[undecided & (intervals.bound < self._enough[owner])]))
            known = _Intervals(owner, ends, np.maximum((samples.apart[number].sum(1) - travel) / 2, intervals.bound))
            is_open = known.bound < np.minimum(samples.least, self._enough)[owner] - TOLERANCE
            is_open &= (samples.least > 0)[owner] & (ends[:, 1] - ends[:, 0] > _SHORTEST)
            closed.append(known.chosen(~is_open))
            if not is_open.any():
                break
            known, number = known.chosen(is_open), number[is_open]
            middle = self._middles(known)
            number = _both_halves(number, samples.added(known.owner, middle))
            intervals = _Intervals(np.tile(known.owner, 2), _both_halves(known.ends, middle), np.tile(known.bound, 2))
        every = zip(*((own.owner, own.ends, own.bound) for own in closed), strict=True)
        return PairDistances(samples.least, samples.nearest), _Intervals(*map(np.concatenate, every))


class _Samples:
    """Angles at which pairs of a search are looked at [rad]: apart, the distances there [m], or lower bounds of them.

    A distance is measured where it may be the least of its pair, or where that is asked for; else the gap of the boxes,
    which is quickly computed, is the bound.

    exact  of the meshes, not of their hulls      least, nearest  least distance of each pair [m], and its angle
    """

    def __init__(self, search: ApproachSearch, exact: bool) -> None:
        self.search, self.exact = search, exact
        self.least, self.nearest = np.full(len(search.pairs), np.inf), np.zeros(len(search.pairs))
        self.owner, self.apart, self.measured = np.zeros(0, dtype=int), np.zeros(0), np.zeros(0, dtype=bool)
        self.lies: Relative = np.zeros((0, 3, 3)), np.zeros((0, 3))

    def added(self, owner: IntArray, angle: FloatArray) -> IntArray:
        """Numbers of new samples of pairs by their numbers, at angles [rad]."""
        search, begin = self.search, len(self.owner)
        turned, moved = search.relative(owner, angle)
        gaps, number = search._box_gaps(owner, (turned, moved)), begin + np.arange(len(owner))
        self.owner, self.apart = np.append(self.owner, owner), np.append(self.apart, gaps)
        self.lies = np.concatenate([self.lies[0], turned]), np.concatenate([self.lies[1], moved])
        self.measured = np.append(self.measured, np.zeros(len(owner), dtype=bool))
        _, first = _least_of(owner, gaps, len(self.least))
        for some in (np.unique(first[owner]), np.arange(len(owner))):
            within = gaps[some] <= np.minimum(self.least, search._horizon)[owner[some]] + _ROUNDING
            self.measure(number[some[within]])
            distance = np.where(self.measured[begin:], self.apart[begin:], np.inf)
            lowest, place = _least_of(owner, distance, len(self.least))
            lower = lowest < self.least
            self.least, self.nearest = np.minimum(lowest, self.least), np.where(lower, angle[place], self.nearest)
        return number

    def measure(self, number: IntArray) -> None:
        """Measure the distances at samples by their numbers that are bounds."""
        left = number[~self.measured[number]]
        lies = self.lies[0][left], self.lies[1][left]
        self.apart[left], self.measured[left] = self.search._distances(self.owner[left], lies, exact=self.exact), True


def _both_halves(ends: _Numbers, middle: _Numbers) -> _Numbers:
    """Values at the ends of the first halves of intervals, then of the second."""
    return np.concatenate([np.column_stack([ends[:, 0], middle]), np.column_stack([middle, ends[:, 1]])])


def _least_of(group: IntArray, values: FloatArray, number: int) -> tuple[FloatArray, IntArray]:
    """The least value of each of a number of groups, inf of an empty one, and the place of the first that is it.

    >>> [found.tolist() for found in _least_of(np.array([1, 1, 0]), np.array([3.0, 2.0, 5.0]), 2)]
    [[5.0, 2.0], [2, 1]]
    """
    least, first = np.full(number, np.inf), np.zeros(number, dtype=int)
    np.minimum.at(least, group, values)
    ties = np.flatnonzero(values == least[group])[::-1]
    first[group[ties]] = ties  # the last of several assignments holds
    return least, first
