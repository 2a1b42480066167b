"""Least distances in space of the parts of a tree that move against each other, over the turn of a drive.

Where two parts are d and d' apart at two angles, and their points move at most w against each other between them
(`poses`), they are in between nowhere nearer than

    (d + d' - w) / 2        [a point that is moved from p to p' by way of q has |p - q| + |q - p'| = |p - p'|]

Intervals whose bound lies below both the least distance so far and the required one are halved until none does by more
than `TOLERANCE`: a result above the required distance proves it for the whole turn, one below it is exact. Boxes and
convex hulls come first; meshes are compared only in the intervals that the hulls leave open. Parts at distance 0 may
touch, or be through each other: the volume that they have in common tells which (`colliders`), at `POSES` angles.
Of a part that is in its body `MANY` times the first, the middle and the last stand for all beside another of these.
"""

from collections.abc import Callable, Generator, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np

from ilmek.arrays import Float, FloatArray, IntArray
from ilmek.part.colliders import Collider, Common, distances, inside, pose_key
from ilmek.part.poses import chains, drive_angles, poses
from ilmek.part.swept import INTERVALS, SAMPLES, TURN, Piece, SweptPieces, Window, box_gaps, swept_pieces
from ilmek.part.tree import Tree
from ilmek.records import record
from ilmek.units import mm

TOLERANCE = 0.5 * mm
"""How far the least distance that is reported may be above that of the meshes [m]."""

POSES = 8
"""Poses in a window at which parts that touch are looked at."""

_SHORTEST = 1e-6
"""Interval that is not halved further [rad]."""

Required = Callable[[str, str], float | None]
Relative: TypeAlias = tuple[Float[np.ndarray, "angles 3 3"], Float[np.ndarray, "angles 3"]]
"""Rotation and origin [m] of a part in the axes of another."""


def _nothing_in_common(_first: str, _other: str) -> float:
    return 0.0


@record
class Approach:
    """The least distance of two parts [m]: below 0 the mean depth of what they have in common.

    parts, bodies  ids       drive, angle  where it occurs [rad]; "" where they stand to each other
    volume         in common [m³]
    """

    parts: tuple[str, str]
    bodies: tuple[str, str]
    distance: float
    volume: float
    drive: str
    angle: float


def approaches(  # noqa: PLR0917
    tree: Tree,
    drive: str,
    horizon: float,
    windows: tuple[Window, ...] = TURN,
    required: Required = _nothing_in_common,
    some: frozenset[str] = frozenset(),
) -> tuple[Approach, ...]:
    """The least distance of every two parts that move against each other with a drive, and come nearer than the horizon
    [m]; the nearest first. Parts without a shape are left out.

    windows   angles of the turn that are looked at [rad]
    required  distance of two bodies, by their ids, above which there is no need of the exact one [m]; None: may do as
              they like. Default: 0
    some      ids of bodies that are compared with all others, and nothing else is; default: all with each other
    """
    angles = tuple(drive_angles(tree, drive).tolist())
    every = (
        swept_pieces(tuple((link.body, link.index) for link in chain), drive, angles, windows) for chain in chains(tree)
    )
    carried = [one for one in every if one.pieces]
    both = ((carried[first], carried[other]) for first, other in _met(carried, horizon, some))
    pairs = [pair for first, other in both for pair in _near(first, other, horizon, required)]
    near = [(pair, where) for pair, where in zip(pairs, _searched(pairs), strict=True) if where]
    common = Common({})
    at = _relative_poses([pair for pair, _ in near], [np.array([where.angle]) for _, where in near])
    nearest = (_approach(pair, where, lies, common) for (pair, where), lies in zip(near, at, strict=True))
    return tuple(sorted(nearest, key=lambda pair: pair.distance))


def _met(carried: Sequence[SweptPieces], horizon: float, some: frozenset[str]) -> Iterator[tuple[int, int]]:
    """Numbers of each two bodies of which the boxes, each about all pieces of one, come nearer than the horizon."""
    if not carried:
        return
    every = [one.boxes() for one in carried]
    around = np.stack([np.stack([one[:, :, 0].min(0), one[:, :, 1].max(0)], axis=1) for one in every])
    chosen = np.array([one.body in some for one in carried])
    for first in range(len(carried) - 1):
        gaps = box_gaps(around[first : first + 1], around[first + 1 :])[0]
        others = (gaps < horizon).any(1) & (not some or chosen[first + 1 :] != chosen[first])
        yield from ((first, int(other)) for other in first + 1 + np.flatnonzero(others))


def _near(first: SweptPieces, other: SweptPieces, horizon: float, required: Required) -> Iterator["_Pair"]:
    """The pairs of pieces of two bodies whose boxes come nearer than the horizon."""
    shared = sum(1 for own, its in zip(first.chain, other.chain, strict=False) if own == its)
    if not any((*first.travel.moves[shared:], *other.travel.moves[shared:])):
        return
    enough = required(first.body, other.body)
    if enough is None:
        return
    gaps = box_gaps(first.boxes(), other.boxes())
    if (gaps < horizon).any() and any(first.travel.moves[:shared]):
        gaps = np.maximum(gaps, box_gaps(first.boxes(shared), other.boxes(shared)))
    for number, its in np.argwhere((gaps < horizon).any(2)).tolist():
        yield _Pair((first, other), (number, its), shared, gaps[number, its], horizon, enough)


@dataclass(frozen=True, eq=False)
class _Asked:
    """Angles at which the distances of two pieces are to be known [rad]; exact: of the meshes, not of their hulls."""

    exact: bool
    angles: FloatArray


@dataclass(frozen=True, eq=False)
class _Where:
    """Where two pieces are nearest: angle [rad] and distance [m]."""

    angle: float
    distance: float


@dataclass(frozen=True, eq=False)
class _Searched:
    """Intervals with a lower bound of the distance in each [m]; the least distance at their ends, and its angle."""

    ends: Float[np.ndarray, "n 2"]
    bound: FloatArray
    angle: float
    least: float


@dataclass(frozen=True, eq=False)
class _Pair:
    """Two pieces that move against each other, by their bodies and numbers.

    shared  number of the links that both chains begin with      gaps  distances of their boxes in the intervals [m]
    """

    carried: tuple[SweptPieces, SweptPieces]
    numbers: tuple[int, int]
    shared: int
    gaps: FloatArray
    horizon: float
    enough: float

    @cached_property
    def pieces(self) -> tuple[Piece, Piece]:
        first, other = (own.pieces[number] for own, number in zip(self.carried, self.numbers, strict=True))
        return first, other

    @cached_property
    def moved(self) -> FloatArray:
        """Travel against each other at the angles [m]: of the links of their chains that they do not share."""
        own, its = (own.moved(number, self.shared) for own, number in zip(self.carried, self.numbers, strict=True))
        return np.asarray(own + its)

    @cached_property
    def colliders(self) -> tuple[Collider, Collider]:
        """What is compared: of two rows of many parts three of the first."""
        first, other = self.pieces
        return (first.few if first.few and other.few else first.collider), other.collider

    @property
    def ends(self) -> Float[np.ndarray, "n samples"]:
        """Samples of the intervals in which their boxes are near [rad]."""
        return np.asarray(self.carried[0].ends[self.gaps < self.horizon])

    def search(self) -> Generator[_Asked, FloatArray, _Where | None]:
        """Where they are nearest; None where that is the horizon or more. Asks for distances at angles."""
        hulls = yield from self._halved(self.ends[:, [0, -1]], self.gaps[self.gaps < self.horizon], exact=False)
        if hulls.least >= self.horizon:
            return None
        if all(own.convex for own in self.colliders):
            return _Where(hulls.angle, hulls.least)
        proven = hulls.least >= self.enough and hulls.least > 0
        if proven and any(own.large for own in self.colliders):
            return _Where(hulls.angle, hulls.least)
        distance = yield _Asked(exact=True, angles=np.array([hulls.angle]))
        where = _Where(hulls.angle, float(distance[0]))
        if not proven and where.distance > 0:
            left = hulls.bound < self.enough
            left = left if left.any() else hulls.bound <= hulls.bound.min()
            meshes = yield from self._halved(hulls.ends[left], hulls.bound[left], exact=True)
            where = _Where(meshes.angle, meshes.least)
        return where if where.distance < self.horizon else None

    def _halved(
        self, ends: Float[np.ndarray, "n 2"], floor: FloatArray, *, exact: bool
    ) -> Generator[_Asked, FloatArray, _Searched]:
        """Intervals halved until the least distance is known; floor: what is known of each before [m]."""
        angles, moved = self.carried[0].travel.angles, self.moved
        once, number = np.unique(ends, return_inverse=True)
        apart = (yield _Asked(exact, once))[number].reshape(-1, 2)
        best = int(np.argmin(apart))
        angle, least = float(ends.flat[best]), float(apart.flat[best])
        closed: list[tuple[FloatArray, FloatArray]] = []
        while True:
            travel = np.diff(np.interp(ends, angles, moved))[:, 0]
            bound = np.maximum((apart.sum(1) - travel) / 2, floor)
            is_open = (bound < min(least, self.enough) - TOLERANCE) & (ends[:, 1] - ends[:, 0] > _SHORTEST)
            is_open &= least > 0
            closed.append((ends[~is_open], bound[~is_open]))
            if not is_open.any():
                break
            ends, apart, floor = ends[is_open], apart[is_open], np.tile(bound[is_open], 2)
            middle = _half_travelled(angles, moved, ends)
            between = yield _Asked(exact, middle)
            lowest = int(np.argmin(between))
            if between[lowest] < least:
                angle, least = float(middle[lowest]), float(between[lowest])
            ends = np.concatenate([np.column_stack([ends[:, 0], middle]), np.column_stack([middle, ends[:, 1]])])
            apart = np.concatenate([np.column_stack([apart[:, 0], between]), np.column_stack([between, apart[:, 1]])])
        every, bounds = (np.concatenate(each) for each in zip(*closed, strict=True))
        return _Searched(every, bounds, angle, least)


def _half_travelled(angles: FloatArray, moved: FloatArray, ends: Float[np.ndarray, "n 2"]) -> FloatArray:
    """The angle at which half of the travel of each interval is done, or its middle where nothing moves [rad]."""
    halves = np.interp(np.interp(ends, angles, moved).mean(1), moved, angles)
    between = (ends[:, 0] < halves) & (halves < ends[:, 1])
    return np.asarray(np.where(between, halves, ends.mean(1)))


def _searched(pairs: Sequence[_Pair]) -> tuple[_Where | None, ...]:
    """Where each pair is nearest: all are searched together, the poses of a body once for all its pieces."""
    results: list[_Where | None] = [None] * len(pairs)
    searches = [pair.search() for pair in pairs]
    asked = {number: next(search) for number, search in enumerate(searches)}
    while asked:
        relative = _relative_poses([pairs[number] for number in asked], [one.angles for one in asked.values()])
        answered, asked = asked, {}
        for (number, one), (turned, moved) in zip(answered.items(), relative, strict=True):
            apart = distances(*pairs[number].colliders, turned, moved, exact=one.exact)
            try:
                asked[number] = searches[number].send(apart)
            except StopIteration as end:
                results[number] = end.value
    return tuple(results)


def _relative_poses(pairs: Sequence[_Pair], angles: Sequence[FloatArray]) -> Iterator[Relative]:
    """Of each pair the position of its second piece in the axes of the first at angles [rad]."""
    if not pairs:
        return iter(())
    counts, at = np.array([len(own) for own in angles]), np.concatenate(angles)
    (own, from_), (its, to) = (_placed_at(pairs, side, counts, at) for side in (0, 1))
    back = own.swapaxes(1, 2)
    turned, moved = back @ its, (back @ (to - from_)[:, :, None])[:, :, 0]
    stops = np.cumsum(counts)[:-1]
    return zip(np.split(turned, stops), np.split(moved, stops), strict=True)


def _placed_at(pairs: Sequence[_Pair], side: int, counts: IntArray, angle: FloatArray) -> Relative:
    """Rotations and origins [m] of a piece of each pair in the scene, at its angles."""
    rows: dict[SweptPieces, list[int]] = {}
    for number, pair in enumerate(pairs):
        rows.setdefault(pair.carried[side], []).append(number)
    begins = np.cumsum(counts) - counts
    rotation, origin = np.empty((len(angle), 3, 3)), np.empty((len(angle), 3))
    for carried, numbers in rows.items():
        here = np.concatenate([np.arange(begins[k], begins[k] + counts[k]) for k in numbers])
        body = poses(carried.chain, carried.travel.drive, angle[here])
        rotation[here], origin[here] = body.rotation, body.origin
    positions = [pair.pieces[side].position for pair in pairs]
    own = np.repeat([position.rotation for position in positions], counts, axis=0)
    away = np.repeat([position.origin for position in positions], counts, axis=0)
    return rotation @ own, origin + (rotation @ away[:, :, None])[:, :, 0]


def _approach(pair: _Pair, where: _Where, lies: Relative, common: Common) -> Approach:
    """The least distance; where it is 0, by the volume that both have in common at several angles.

    lies  position of the second piece in the axes of the first where they are nearest
    """
    depth, volume, angle = _deepest(pair, where, lies, common)
    first, other = pair.pieces
    bodies = pair.carried[0].body, pair.carried[1].body
    drive = pair.carried[0].travel.drive
    return Approach((first.part, other.part), bodies, -depth if depth > 0 else where.distance, volume, drive, angle)


def _deepest(pair: _Pair, where: _Where, lies: Relative, common: Common) -> tuple[float, float, float]:
    """Largest mean depth [m] of what they have in common, its volume [m³] and angle; 0 where they touch only."""
    first, other = ((piece.few or piece.collider) for piece in pair.pieces)
    deepest = 0.0, 0.0, where.angle
    tried, (turned, moved) = np.array([where.angle]), lies
    if where.distance > 0 and not inside(first, other, turned[0], moved[0]):
        return deepest
    if where.distance <= 0:
        every = pair.ends[:, :: max(SAMPLES * INTERVALS // (POSES * len(pair.ends)), 1)].ravel()
        tried = np.concatenate([tried, np.unique(every)[:: max(len(every) // POSES, 1)]])
        ((turned, moved),) = _relative_poses([pair], [tried])
    seen: set[tuple[bytes, ...]] = set()
    for angle, rotation, origin in zip(tried.tolist(), turned, moved, strict=True):
        key = pose_key(first, other, rotation, origin)
        if key in seen:
            continue
        seen.add(key)
        depth, volume = common.depth(first, other, rotation, origin)
        if depth > deepest[0]:
            deepest = depth, volume, angle
    return deepest
