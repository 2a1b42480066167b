"""The parts of bodies over the turn of a drive, as pieces: the boxes that contain each in intervals of the turn."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from itertools import pairwise

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.part.colliders import MANY, Collider, collider, row
from ilmek.part.placement import IDENTITY, Placement
from ilmek.part.poses import BodyPoints, Chain, ChainLink, ChainTravel, poses
from ilmek.part.shapes import Shape, Sum
from ilmek.part.tree import Occurrence, RigidBody
from ilmek.units import turn

INTERVALS, SAMPLES = 24, 8
"""Intervals of a turn that are compared by boxes, and samples of each."""

Window = tuple[float, float]
TURN: tuple[Window, ...] = ((0.0, turn),)

Boxes = Float[np.ndarray, "pieces intervals 2 3"]


@dataclass(frozen=True, eq=False)
class Piece:
    """A part in a body, or of many all as one; few: of many three."""

    part: str
    position: Placement
    collider: Collider
    few: Collider | None = None

    @cached_property
    def box(self) -> Float[np.ndarray, "2 3"]:
        """Middle and half sides of its box in the body's axes [m]."""
        low, high = self.extent.points.min(0), self.extent.points.max(0)
        return np.stack([low + high, high - low]) / 2

    @cached_property
    def extent(self) -> BodyPoints:
        """Corners of its convex hull in the body's axes [m]."""
        return BodyPoints(self.position.points(self.collider.corners), self.position if self.collider.spun else None)


@dataclass(frozen=True, eq=False)
class SweptPieces:
    """The pieces of a body at the end of a chain, over the turn of a drive."""

    pieces: tuple[Piece, ...]
    travel: ChainTravel
    ends: Float[np.ndarray, "intervals samples"]
    seen: dict[int, Boxes] = field(default_factory=dict)
    travelled: dict[int, Float[np.ndarray, "pieces angles"]] = field(default_factory=dict)

    @property
    def chain(self) -> Chain:
        """Its chain."""
        return self.travel.chain

    @property
    def body(self) -> str:
        """Id of the body."""
        return self.chain[-1].name

    @cached_property
    def reaches(self) -> Float[np.ndarray, "pieces links"]:
        """Largest distances of the points of each piece from the axis of each link's joint [m]."""
        return self.travel.reaches(tuple(piece.extent for piece in self.pieces))

    def moved(self, number: int, shared: int) -> FloatArray:
        """Travel of a piece at the angles, by the links of its chain after the shared ones [m]."""
        if shared not in self.travelled:
            by_turns = self.reaches[:, shared:] @ self.travel.turns[shared:]
            self.travelled[shared] = self.travel.shifts[shared:].sum(0) + by_turns
        return np.asarray(self.travelled[shared][number])

    @cached_property
    def around(self) -> Float[np.ndarray, "pieces 1 2 3"]:
        """Boxes that contain the pieces over all intervals, seen from the ground [m]."""
        boxes = self.boxes()
        return np.stack([boxes[:, :, 0].min(1), boxes[:, :, 1].max(1)], axis=1)[:, None]

    def boxes(self, shared: int = 0) -> Boxes:
        """Boxes that contain the pieces over the intervals, seen from a body of the chain: least, largest x, y, z [m].

        shared  number of the links to that body; default: seen from the ground
        """
        if shared not in self.seen:
            self.seen[shared] = self._boxes(shared)
        return self.seen[shared]

    def _boxes(self, shared: int) -> Boxes:
        chain, drive = self.chain[shared:], self.travel.drive
        size = len(self.pieces), len(self.ends), 2, 3
        if not any(self.travel.moves[shared:]):
            resting = _at_rest(self.chain[-1].body.occurrences, tuple((link.body, link.index) for link in chain))
            return np.broadcast_to(resting[:, None], size)
        middles, halves = np.stack([piece.box for piece in self.pieces], axis=1)
        at, samples = poses(chain, drive, self.ends.ravel()), self.ends.shape
        if any(link.turns(drive) for link in chain):
            points, wide = at.points(middles), halves @ np.abs(at.rotation).swapaxes(1, 2)
            low, high = ((points + side * wide).reshape(*samples, -1, 3) for side in (-1, 1))
            low, high = low.min(1).swapaxes(0, 1), high.max(1).swapaxes(0, 1)
        else:
            points, wide = middles @ at.rotation[0].T, halves @ np.abs(at.rotation[0]).T
            origins = at.origin.reshape(*samples, 3)
            low, high = (points - wide)[:, None] + origins.min(1), (points + wide)[:, None] + origins.max(1)
        along = ChainTravel(chain, drive, self.travel.angles).along_axes(self.reaches[:, shared:], self.ends)
        # Between two samples a point leaves the box of its ends by half of its travel at most.
        margin = (np.diff(along, axis=-1).max(-1) / 2).swapaxes(1, 2)
        return np.stack([low - margin, high + margin], axis=2)


Links = tuple[tuple[RigidBody, int], ...]
"""The bodies of a chain, each at the position of a number: trees that share these share what is made of them."""


@lru_cache(maxsize=2048)
def _at_rest(occurrences: tuple[Occurrence, ...], links: Links) -> Float[np.ndarray, "pieces 2 3"]:
    """Boxes of the pieces of a body at the end of a chain with all drives at 0, seen from where this begins [m]."""
    points = [piece.extent.points for piece in _pieces(occurrences)]
    begins = np.cumsum([0, *(len(own) for own in points[:-1])])
    (at,) = poses(_chain(links), "", np.zeros(1)).points(np.concatenate(points))
    return np.stack([np.minimum.reduceat(at, begins), np.maximum.reduceat(at, begins)], axis=1)


def _chain(links: Links) -> Chain:
    return tuple(ChainLink(body, body.id, index) for body, index in links)


@lru_cache(maxsize=512)
def swept_pieces(links: Links, drive: str, angles: tuple[float, ...], windows: tuple[Window, ...]) -> SweptPieces:
    """The pieces at the end of a chain of bodies."""
    chain = _chain(links)
    pieces = _pieces(chain[-1].body.occurrences)
    return SweptPieces(pieces, ChainTravel(chain, drive, np.array(angles)), intervals(windows))


@lru_cache(maxsize=512)
def _pieces(occurrences: tuple[Occurrence, ...]) -> tuple[Piece, ...]:
    """The pieces of the parts of a body, of a sum its members; of what is in it `MANY` times all as one."""
    return tuple(_each_piece(occurrences))


def _each_piece(occurrences: tuple[Occurrence, ...]) -> Iterator[Piece]:
    for occurrence in occurrences:
        part = occurrence.part
        if part.shape is None:
            continue
        if len(occurrence.positions) >= MANY:
            yield Piece(part.id, IDENTITY, *row(occurrence))
            continue
        members = tuple(_members(part.shape))
        if len(members) >= MANY:
            members = ((part.shape, IDENTITY),)
        for position in occurrence.positions:
            yield from (Piece(part.id, position.after(own), collider(shape)) for shape, own in members)


def _members(shape: Shape) -> Iterator[tuple[Shape, Placement]]:
    if not isinstance(shape, Sum):
        yield shape, IDENTITY
        return
    for member in shape.members:
        inner = tuple(_members(member.shape))
        yield from ((own, position.after(at)) for position in member.positions for own, at in inner)


@lru_cache(maxsize=16)
def intervals(windows: tuple[Window, ...]) -> Float[np.ndarray, "intervals samples"]:
    """Angles of the intervals of the windows [rad]: both ends of each, and samples between them."""
    rows = []
    for begin, end in windows:
        number = max(round((end - begin) / turn * INTERVALS), 1)
        edges = np.linspace(begin, end, number + 1)
        rows += [np.linspace(low, high, SAMPLES + 1) for low, high in pairwise(edges.tolist())]
    return np.array(rows)


def box_gaps(boxes: Boxes, others: Boxes) -> Float[np.ndarray, "n m intervals"]:
    """Distances of boxes, each with each [m]."""
    return gaps_of_two(boxes[:, None], others[None])


def gaps_of_two(
    own: Float[np.ndarray, "*#n intervals 2 3"], its: Float[np.ndarray, "*#n intervals 2 3"]
) -> Float[np.ndarray, "*n intervals"]:
    """Distances of boxes and others [m]."""
    apart = np.maximum(own[..., 0, :] - its[..., 1, :], its[..., 0, :] - own[..., 1, :])
    x, y, z = (np.maximum(apart[..., axis], 0.0) for axis in range(3))  # `norm` of so short rows takes longer
    return np.asarray(np.sqrt(x * x + y * y + z * z))
