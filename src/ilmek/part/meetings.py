"""Which features of size of a tree's parts meet, and how one moves in the other: at rest, every drive at angle 0.

A bore and a journal meet where they have the same size, the same axis, and lie along it beside each other. How they
move follows from the joints between their bodies: of the chains from the body that carries both. A bought guide sits on
the faces on which its own lie.
"""

from collections.abc import Iterator, Sequence
from functools import lru_cache

import numpy as np

from ilmek.arrays import Float
from ilmek.part.features import FeatureOfSize, faces_of, features_of_size
from ilmek.part.part import Part
from ilmek.part.placement import Placement
from ilmek.part.poses import Chain, chains, poses
from ilmek.part.shapes import box_corners, shape_box
from ilmek.part.tree import STANDING, JointKind, Tree
from ilmek.records import record
from ilmek.units import um

SAME = 1 * um
"""Distance of axes, difference of sizes [m], and of directions that counts as rounding."""

_BESIDE = 100 * um
"""Least length along the axis over which features meet [m]."""


@record
class SeatFeature:
    """A feature of a part, by its number among `features_of_size` of the part's shape."""

    part: Part
    number: int
    feature: FeatureOfSize


@record
class Meeting:
    """A bore and what is in it.

    joint   how one moves in the other: fixed, pin, slide          body   id of the body that moves, or that has both
    ends    the inner one ends in the bore: the tip of a screw
    along   where the bore begins and ends along the axis of the inner one, from where that begins [m]
    """

    bore: SeatFeature
    inner: SeatFeature
    joint: JointKind
    body: str
    ends: bool
    along: tuple[float, float]


@record
class _Placed:
    """A feature where it stands."""

    seat: SeatFeature
    chain: Chain
    turning: bool


@lru_cache(maxsize=8)
def meetings(tree: Tree) -> tuple[Meeting, ...]:
    """The meetings of different parts, those of like pairs of features in the same bodies once."""
    placed, lines = _placed(tree)
    if not placed:
        return ()
    kept: dict[tuple[object, ...], Meeting] = {}
    for bore, inner, ends, along in _pairs(placed, lines):
        joint, body = _joint(bore, inner)
        meeting = Meeting(bore.seat, inner.seat, joint, body, ends, along)
        names = (seat.part.id for seat in (bore.seat, inner.seat))
        kept.setdefault((*names, bore.seat.number, inner.seat.number, joint, body, ends), meeting)
    return tuple(kept.values())


def _placed(tree: Tree) -> tuple[list[_Placed], Float[np.ndarray, "features 8"]]:
    """The features where they stand; and origins, directions, sizes and lengths of them."""
    placed, lines, own = [], [], dict[str, tuple[SeatFeature, ...]]()
    for chain in chains(tree):
        here = poses(chain, "", np.zeros(1))
        body = Placement(here.origin[0], here.rotation[0])
        for occurrence in chain[-1].body.occurrences:
            part = occurrence.part
            if part.id not in own:
                shaped = () if part.shape is None else features_of_size(part.shape)
                own[part.id] = tuple(SeatFeature(part, number, feature) for number, feature in enumerate(shaped))
            for position in occurrence.positions if own[part.id] else ():
                stands = body.after(position)
                for seat in own[part.id]:
                    feature = seat.feature
                    origin = stands.points(feature.position.origin)
                    along = stands.rotation @ feature.position.rotation[:, 2]
                    placed.append(_Placed(seat, chain, occurrence.turning))
                    lines.append([*origin, *along, feature.size, feature.length])
    return placed, np.array(lines).reshape(-1, 8)


def _pairs(
    placed: Sequence[_Placed], lines: Float[np.ndarray, "features 8"]
) -> Iterator[tuple[_Placed, _Placed, bool, tuple[float, float]]]:
    """Bore and inner feature of each meeting, whether the inner one ends in the bore, and where that lies along it."""
    inside = np.array([one.seat.feature.inside for one in placed])
    square = np.array([one.seat.feature.square for one in placed])
    inner = np.flatnonzero(~inside)
    inner = inner[np.argsort(lines[inner, 6])]
    sizes = lines[inner, 6]
    for bore in np.flatnonzero(inside).tolist():
        first, last = np.searchsorted(sizes, lines[bore, 6] + np.array([-SAME, SAME]))
        near = inner[first:last]
        origin, along, length = lines[bore, :3], lines[bore, 3:6], lines[bore, 7]
        away, other = lines[near, :3] - origin, lines[near, 3:6]
        begin, turned = away @ along, other @ along
        same = np.abs(other - turned[:, None] * along).max(1, initial=0.0) < SAME
        same &= np.abs(away - begin[:, None] * along).max(1, initial=0.0) < SAME
        same &= square[near] == square[bore]
        end = begin + turned * lines[near, 7]
        low, high = np.minimum(begin, end), np.maximum(begin, end)
        same &= np.minimum(high, length) - np.maximum(low, 0.0) > _BESIDE
        for k in np.flatnonzero(same).tolist():
            if placed[near[k]].seat.part is not placed[bore].seat.part:
                first, last = sorted((float(-begin[k] * turned[k]), float((length - begin[k]) * turned[k])))
                yield placed[bore], placed[near[k]], bool(-SAME <= end[k] <= length + SAME), (first, last)


def _joint(bore: _Placed, inner: _Placed) -> tuple[JointKind, str]:
    """How two features move in each other, and the id of the body that does; of both where they stand."""
    joint, body = _relative(bore.chain, inner.chain)
    turning = joint is JointKind.FIXED and (bore.turning or inner.turning)
    return (JointKind.PIN if turning else joint), body


def _relative(chain: Chain, inner: Chain) -> tuple[JointKind, str]:
    """How the ends of two chains move in each other, and the id of the body that does."""
    common = sum(1 for one, other in zip(chain, inner, strict=False) if one == other)
    moving = [link for own in (inner, chain) for link in own[common:] if link.body.joint.kind not in STANDING]
    if not moving:
        return JointKind.FIXED, inner[-1].name
    kinds = {link.body.joint.kind for link in moving}
    return JointKind.PIN if kinds & _TURNING else JointKind.SLIDE, moving[-1].name


_TURNING = {JointKind.PIN, JointKind.ROLLING, JointKind.TRANSMISSION}


GUIDES = frozenset({"linear guide", "guide carriage", "linear axis"})
"""Processes of bought guides, which take the form of the face that they sit on."""


@record
class GuideSeat:
    """The face of a made part that a bought guide sits on, or that slides on the face of another part.

    guide  the other part      slides  one moves along the other
    position  in the part's own axes: the middle of what both cover, z out of the part      length  of that [m]
    """

    part: Part
    guide: Part
    body: str
    position: Placement
    length: float
    slides: bool = False


@lru_cache(maxsize=8)
def slide_seats(tree: Tree) -> tuple[GuideSeat, ...]:
    """The faces on which made parts of different bodies slide on each other at rest, each once."""
    stands, seats = _made_once(tree), dict[tuple[str, ...], GuideSeat]()
    boxes = np.array([_box(part, lies) for part, lies, _ in stands]).reshape(-1, 2, 3)
    sliding = [k for k, (_, _, chain) in enumerate(stands) if chain[-1].body.joint.kind is JointKind.SLIDE]
    for k in sliding:
        near = (boxes[:, 0] <= boxes[k, 1] + _FLUSH).all(1) & (boxes[k, 0] <= boxes[:, 1] + _FLUSH).all(1)
        for j in np.flatnonzero(near).tolist():
            kind, body = _relative(stands[k][2], stands[j][2])
            if kind is JointKind.SLIDE:
                for (part, lies, _), (other, there, _) in ((stands[k], stands[j]), (stands[j], stands[k])):
                    for middle, length in _covered(part, lies, other, there):
                        seat = GuideSeat(part, other, body, middle, length, slides=True)
                        seats.setdefault((part.id, other.id, str(np.round(middle.origin / SAME))), seat)
    return tuple(seats.values())


def _made_once(tree: Tree) -> list[tuple[Part, Placement, Chain]]:
    """The made parts of each body with their first positions, where they stand."""
    stands: list[tuple[Part, Placement, Chain]] = []
    for chain in chains(tree):
        here = poses(chain, "", np.zeros(1))
        body = Placement(here.origin[0], here.rotation[0])
        still = (own for own in chain[-1].body.occurrences if own.part.material is not None and not own.turning)
        stands += [(own.part, body.after(own.positions[0]), chain) for own in still]
    return stands


def _box(part: Part, lies: Placement) -> Float[np.ndarray, "2 3"]:
    """Least and largest x, y, z of the plane faces of a part that stands at a position; of none nowhere."""
    corners = [face.corners for face in faces_of(part.shape, lies)] if part.shape is not None else []
    points = np.concatenate(corners) if corners else np.full((1, 3), np.nan)
    return np.stack([points.min(0), points.max(0)])


def guide_seats(tree: Tree) -> tuple[GuideSeat, ...]:
    """The seats of guides on parts that stand to them, and of parts on the axes that move them, each once.

    Also those on bought parts, whose makers see to them.
    """
    placed = [
        (own.part, body.after(position), chain)
        for chain, body in _bodies(tree)
        for own in chain[-1].body.occurrences
        for position in own.positions
    ]
    placed = [each for each in placed if each[0].shape is not None]
    corners = np.array([lies.points(_corners(part)) for part, lies, _ in placed]).reshape(-1, 8, 3)
    low, high = corners.min(1) - _FLUSH, corners.max(1) + _FLUSH
    seats, driven = dict[tuple[str, ...], GuideSeat](), dict[tuple[str, ...], GuideSeat]()
    for number in (k for k, each in enumerate(placed) if each[0].process in GUIDES):
        guide, there, carrier = placed[number]
        near = (low <= high[number]).all(1) & (low[number] <= high).all(1)
        for part, lies, chain in (placed[k] for k in np.flatnonzero(near) if placed[k][0].process not in GUIDES):
            kind, body = _relative(carrier, chain)
            for middle, length in _covered(part, lies, guide, there):
                seat = GuideSeat(part, guide, body, middle, length)
                if kind is JointKind.FIXED:
                    seats.setdefault((part.id, guide.id, str(np.round(middle.origin / SAME))), seat)
                elif kind is JointKind.SLIDE:  # of what an axis moves, the rest only touches it
                    driven[body, guide.id] = max(driven.get((body, guide.id), seat), seat, key=lambda one: one.length)
    return (*seats.values(), *driven.values())


@lru_cache(maxsize=4096)
def _corners(part: Part) -> Float[np.ndarray, "8 3"]:
    assert part.shape is not None
    return box_corners(*shape_box(part.shape))


def _bodies(tree: Tree) -> Iterator[tuple[Chain, Placement]]:
    """The chain of each body, of like ones the first, and where it stands."""
    for chain in chains(tree):
        if not any(link.index for link in chain):
            here = poses(chain, "", np.zeros(1))
            yield chain, Placement(here.origin[0], here.rotation[0])


def _covered(part: Part, position: Placement, guide: Part, at: Placement) -> Iterator[tuple[Placement, float]]:
    """Where a face of a guide lies on one of a part, in the part's axes: the middle and length of what both cover."""
    if part.shape is None or guide.shape is None:
        return
    faces, others = tuple(faces_of(part.shape)), tuple(faces_of(guide.shape, position.inverse.after(at)))
    if not faces or not others:
        return
    normals, its = np.array([own.normal for own in faces]), np.array([other.normal for other in others])
    levels = np.einsum("ki,ki->k", normals, [own.corners[0] for own in faces])
    apart = normals @ np.array([other.corners[0] for other in others]).T - levels[:, None]
    for k, j in np.argwhere((normals @ its.T <= SAME - 1) & (abs(apart) <= _FLUSH)).tolist():
        own, other = faces[k], others[j]
        across = own.corners[1] - own.corners[0]
        axes = np.stack([across / np.linalg.norm(across), np.cross(own.normal, across / np.linalg.norm(across))])
        low = np.maximum((own.corners @ axes.T).min(0), (other.corners @ axes.T).min(0))
        high = np.minimum((own.corners @ axes.T).max(0), (other.corners @ axes.T).max(0))
        if (high - low).min() > _COVERED:
            middle = (low + high) / 2 @ axes + own.corners[0] @ own.normal * own.normal
            yield Placement(middle, np.stack([*axes, own.normal], axis=1)), float((high - low).max())


_FLUSH, _COVERED = 10 * um, 1e-3
"""Distance within which faces lie on each other, and least width of what both cover [m]."""
