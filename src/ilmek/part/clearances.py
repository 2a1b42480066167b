"""Least distances in space of the parts of a tree that move against each other, over the turn of a drive.

Boxes come first, then convex hulls, and meshes only where the hulls leave it open [`approach_search`]: a result above
the required distance proves it for the whole turn, one below it is exact. Parts at distance 0 may touch, or be through
each other: the volume that they have in common tells which (`colliders`), at `POSES` angles. Of a part that is in its
body `MANY` times the first, the middle and the last stand for all beside another of these.
"""

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from ilmek.part.approach_search import ApproachSearch, PiecePair
from ilmek.part.colliders import Common, Rotation, Vector, inside, pose_key
from ilmek.part.poses import chains, drive_angles
from ilmek.part.swept import INTERVALS, SAMPLES, TURN, SweptPieces, Window, box_gaps, gaps_of_two, swept_pieces
from ilmek.part.tree import Tree
from ilmek.records import record

POSES = 8
"""Poses in a window at which parts that touch are looked at."""

Required = Callable[[str, str], float | None]


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
    search = ApproachSearch(tuple(_pairs(carried, horizon, required, some)))
    nearest = search.nearest()
    near = np.flatnonzero(nearest.distance < horizon)
    lies = zip(*search.relative(near, nearest.angle[near]), strict=True) if len(near) else ()
    common = Common({})
    approached = (
        _approach(search, number, (float(nearest.distance[number]), float(nearest.angle[number])), own, common)
        for number, own in zip(near.tolist(), lies, strict=True)
    )
    return tuple(sorted(approached, key=lambda pair: pair.distance))


def _pairs(
    carried: Sequence[SweptPieces], horizon: float, required: Required, some: frozenset[str]
) -> Iterator[PiecePair]:
    """The pairs of pieces that come near; of bodies that move alike on each of several carriers those on the first."""
    known: set[tuple[object, ...]] = set()
    for first, other in ((carried[number], carried[beside]) for number, beside in _met(carried, horizon, some)):
        shared = sum(1 for own, its in zip(first.chain, other.chain, strict=False) if own == its)
        alike = shared, first.chain[shared - 1].name, first.chain[shared:], other.chain[shared:]
        if not shared or alike not in known:
            known.add(alike)
            yield from _near(first, other, shared, horizon, required)


def _met(carried: Sequence[SweptPieces], horizon: float, some: frozenset[str]) -> Iterator[tuple[int, int]]:
    """Numbers of each two bodies of which the boxes, each about all pieces of one, come nearer than the horizon."""
    if not carried:
        return
    every = [pieces.boxes() for pieces in carried]
    around = np.stack([np.stack([one[:, :, 0].min(0), one[:, :, 1].max(0)], axis=1) for one in every])
    chosen = np.array([pieces.body in some for pieces in carried])
    for first in range(len(carried) - 1):
        gaps = box_gaps(around[first : first + 1], around[first + 1 :])[0]
        others = (gaps < horizon).any(1) & (not some or chosen[first + 1 :] != chosen[first])
        yield from ((first, int(other)) for other in first + 1 + np.flatnonzero(others))


def _near(
    first: SweptPieces, other: SweptPieces, shared: int, horizon: float, required: Required
) -> Iterator[PiecePair]:
    """The pairs of pieces of two bodies, of chains with shared links, whose boxes come nearer than the horizon."""
    if not any((*first.travel.moves[shared:], *other.travel.moves[shared:])):
        return
    enough = required(first.body, other.body)
    if enough is None:
        return
    own, its = np.nonzero(box_gaps(first.around, other.around)[:, :, 0] < horizon)
    gaps = gaps_of_two(first.boxes()[own], other.boxes()[its])
    if (gaps < horizon).any() and any(first.travel.moves[:shared]):
        gaps = np.maximum(gaps, gaps_of_two(first.boxes(shared)[own], other.boxes(shared)[its]))
    near = (gaps < horizon).any(1)
    for *numbers, apart in zip(own[near].tolist(), its[near].tolist(), gaps[near], strict=True):
        yield PiecePair((first, other), (numbers[0], numbers[1]), shared, apart, horizon, enough)


def _approach(
    search: ApproachSearch, number: int, where: tuple[float, float], lies: tuple[Rotation, Vector], common: Common
) -> Approach:
    """The least distance of a pair by its number; where it is 0, by what both have in common at several angles.

    where  least distance [m] and its angle [rad]      lies  position of the second piece in the axes of the first there
    """
    pair, distance = search.pairs[number], where[0]
    depth, volume, angle = _deepest(search, number, where, lies, common)
    first, other = pair.pieces
    bodies = pair.carried[0].body, pair.carried[1].body
    drive = pair.carried[0].travel.drive
    return Approach((first.part, other.part), bodies, -depth if depth > 0 else distance, volume, drive, angle)


def _deepest(
    search: ApproachSearch, number: int, where: tuple[float, float], lies: tuple[Rotation, Vector], common: Common
) -> tuple[float, float, float]:
    """Largest mean depth [m] of what they have in common, its volume [m³] and angle; 0 where they touch only."""
    pair, (distance, angle) = search.pairs[number], where
    first, other = ((piece.few or piece.collider) for piece in pair.pieces)
    deepest = 0.0, 0.0, angle
    if distance > 0:
        return (*common.depth(first, other, *lies), angle) if inside(first, other, *lies) else deepest
    every = pair.ends[:, :: max(SAMPLES * INTERVALS // (POSES * len(pair.ends)), 1)].ravel()
    tried = np.concatenate([[angle], np.unique(every)[:: max(len(every) // POSES, 1)]])
    seen: set[tuple[bytes, ...]] = set()
    for angle, *lies_ in zip(tried.tolist(), *search.relative(np.full(len(tried), number), tried), strict=True):
        key = pose_key(first, other, *lies_)
        if key in seen:
            continue
        seen.add(key)
        depth, volume = common.depth(first, other, *lies_)
        if depth > deepest[0]:
            deepest = depth, volume, angle
    return deepest
