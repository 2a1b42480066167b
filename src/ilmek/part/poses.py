"""Where the bodies of a tree are over the turn of a drive, and how far their points move.

A body stands on a chain of bodies from the ground; its pose is the product of their positions and motions:

    pose(q) = product over the chain of position . (shift(q), R(axis, rotation(q)))

Between two angles no point of it moves, by the motion of one link of the chain, farther than

    |shift(b) - shift(a)| + |rotation(b) - rotation(a)| r        r  reach: largest distance of a point from the axis

summed over the samples of the motion between them: the `travel`.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache, partial

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.part.moments import Moments, together
from ilmek.part.placement import Placement
from ilmek.part.tree import GROUND, RigidBody, Tree
from ilmek.records import record
from ilmek.report.scene import SceneMotion
from ilmek.units import turn

_PARALLEL = 1e-9
"""Difference of two axes' directions that counts as rounding."""

Points = Float[np.ndarray, "points 3"]


@dataclass(frozen=True, slots=True)
class ChainLink:
    """A body in a chain, at one of its positions; equal links are the same thing."""

    body: RigidBody = field(compare=False)
    name: str
    index: int

    @property
    def position(self) -> Placement:
        """Its position in the body before it."""
        return self.body.positions[self.index]

    @property
    def moves(self) -> bool:
        """Whether it moves with any drive."""
        motion = self.body.joint.motion
        return motion is not None and any(_changes(motion))

    def turns(self, drive: str) -> bool:
        """Whether it turns with a drive."""
        motion = self.body.joint.motion
        return motion is not None and motion.drive == drive and _changes(motion)[1]


@lru_cache(maxsize=1024)
def _changes(motion: SceneMotion) -> tuple[bool, bool]:
    """Whether it shifts, and whether it turns."""
    return bool(np.ptp(motion.shift, axis=0).any()), bool(np.ptp(motion.rotation))


Chain = tuple[ChainLink, ...]


def chains(tree: Tree) -> Iterator[Chain]:
    """The chain of every body at every position of it and of all that carry it."""
    ends: dict[str, tuple[Chain, ...]] = {GROUND: ((),)}
    for body in tree.bodies:
        ends[body.id] = tuple(
            (*carrier, ChainLink(body, body.id, index))
            for carrier in ends[body.parent]
            for index in range(len(body.positions))
        )
        yield from ends[body.id]


def drive_angles(tree: Tree, drive: str) -> FloatArray:
    """Angles of a drive between which every motion of the tree is straight [rad], 0 and a turn among them."""
    motions = (body.joint.motion for body in tree.bodies)
    samples = [motion.angle for motion in motions if motion is not None and motion.drive == drive]
    return np.unique(np.concatenate([[0.0, turn], *samples]))


@record
class Poses:
    """Poses of a body: a point r of it is at origin + rotation r [m]."""

    rotation: Float[np.ndarray, "angles 3 3"]
    origin: Float[np.ndarray, "angles 3"]

    def points(self, points: Points) -> Float[np.ndarray, "angles points 3"]:
        """Points of the body at each pose [m]."""
        return np.asarray(self.origin[:, None] + points @ self.rotation.transpose(0, 2, 1))


def poses(chain: Chain, drive: str, angle: FloatArray) -> Poses:
    """The poses of the last body of a chain at angles of a drive [rad]; all other drives stand at 0."""
    rotation, origin = np.eye(3), np.zeros(3)
    for link in chain:
        origin = origin + rotation @ link.position.origin
        rotation = rotation @ link.position.rotation
        motion = link.body.joint.motion
        if motion is not None:
            shift, turned = _moved(motion, angle) if motion.drive == drive else _at_start(motion)
            if shift.any():
                origin = origin + (rotation @ shift[:, :, None])[:, :, 0]
            if turned.any():
                rotation = rotation @ _rotations(link.body.joint.axis, turned)
    shape = len(angle), 3
    return Poses(np.broadcast_to(rotation, (*shape, 3)), np.broadcast_to(origin, shape))


_START = np.zeros(1)


def moments_at_rest(tree: Tree, left_out: frozenset[str] = frozenset()) -> Moments:
    """Moments of the mass of a tree with every drive at angle 0, in its axes (kg, kg m, kg m²).

    left_out  ids of bodies that are not counted; what is not weighed is not counted either
    """
    own = {body.id: body.moments for body in tree.bodies}
    return together(
        own[chain[-1].name].placed(Placement(here.origin[0], here.rotation[0]))
        for chain in chains(tree)
        if chain[-1].name not in left_out
        for here in [poses(chain, "", _START)]
    )


@lru_cache(maxsize=1024)
def _at_start(motion: SceneMotion) -> tuple[Float[np.ndarray, "1 3"], FloatArray]:
    return _moved(motion, _START)


def _moved(motion: SceneMotion, angle: FloatArray) -> tuple[Float[np.ndarray, "n 3"], FloatArray]:
    """Shift [m] and rotation [rad] of a motion at angles of its drive [rad]."""
    after = np.clip(np.searchsorted(motion.angle, angle), 1, len(motion.angle) - 1)
    before = after - 1
    begin = motion.angle[before]
    share = np.clip((angle - begin) / (motion.angle[after] - begin), 0.0, 1.0)
    shift, turned = motion.shift, motion.rotation
    return (
        shift[before] + share[:, None] * (shift[after] - shift[before]),
        turned[before] + share * (turned[after] - turned[before]),
    )


def _rotations(axis: Sequence[float], angle: FloatArray) -> Float[np.ndarray, "n 3 3"]:
    """Rotations about an axis: Rodrigues' formula."""
    x, y, z = _unit(axis).tolist()
    across, turned = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]), angle[:, None, None]
    return np.asarray(np.eye(3) + np.sin(turned) * across + (1 - np.cos(turned)) * (across @ across))


@record
class BodyPoints:
    """Points of a body [m]; of a body of revolution also where its axis lies, along which z points.

    A body of revolution stays where it is when it turns about its own axis: its reach is then that of its axis.
    """

    points: Points
    axis: Placement | None = None


@lru_cache(maxsize=512)
def _own_reaches(
    extents: tuple[BodyPoints, ...], direction: tuple[float, ...]
) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Largest distances of points from an axis through the origin, and from the origin [m]."""
    farthest = _greatest(extents, np.linalg.norm(np.concatenate([own.points for own in extents]), axis=1))
    return _across(extents, np.array(direction)), farthest


def _across(extents: Sequence[BodyPoints], axis: FloatArray) -> Float[np.ndarray, " n"]:
    """Largest distances of points from an axis through the origin [m]."""
    reached = _greatest(extents, np.linalg.norm(_cross(np.concatenate([own.points for own in extents]), axis), axis=1))
    for number, own in enumerate(extents):
        if own.axis is not None and np.abs(_cross(own.axis.rotation[:, 2], axis)).max() < _PARALLEL:
            reached[number] = np.linalg.norm(_cross(own.axis.origin, axis))
    return reached


def _greatest(extents: Sequence[BodyPoints], values: FloatArray) -> Float[np.ndarray, " n"]:
    """The greatest value at the points of each."""
    sizes = np.array([len(own.points) for own in extents])
    return np.asarray(np.maximum.reduceat(values, np.cumsum(sizes) - sizes))


def _cross(vectors: Float[np.ndarray, "*n 3"], axis: FloatArray) -> Float[np.ndarray, "*n 3"]:
    """Cross products of vectors and an axis; `numpy.cross` takes several times as long."""
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    a, b, c = axis.tolist()
    return np.stack([y * c - z * b, z * a - x * c, x * b - y * a], axis=-1)


@dataclass(frozen=True, eq=False)
class ChainTravel:
    """How far points of the last body of a chain move over the turn of a drive.

    The travel by a link is that of its shift, and its rotation times the reach: the distance of a point from its axis.
    angles  of the drive, between which every motion is straight [rad]
    """

    chain: Chain
    drive: str
    angles: FloatArray

    @cached_property
    def moves(self) -> tuple[bool, ...]:
        """Whether each link moves with the drive."""
        motions = (link.body.joint.motion for link in self.chain)
        return tuple(motion is not None and motion.drive == self.drive and any(_changes(motion)) for motion in motions)

    @cached_property
    def shifts(self) -> Float[np.ndarray, "links angles"]:
        """Lengths of the shifts of each link from angle 0 on [m]."""
        return np.stack([self._along(link, _lengths, self.angles) for link in self.chain])

    @cached_property
    def turns(self) -> Float[np.ndarray, "links angles"]:
        """Sums of the rotations of each link from angle 0 on, whatever their sense [rad]."""
        return np.stack([self._along(link, _rotated, self.angles) for link in self.chain])

    def _along(self, link: ChainLink, steps: "_Steps", angles: FloatArray) -> FloatArray:
        motion = link.body.joint.motion
        if motion is None or motion.drive != self.drive:
            return np.zeros(angles.shape)
        return np.asarray(np.interp(angles, motion.angle, np.concatenate([[0.0], np.cumsum(steps(motion))])))

    def along_axes(
        self, reaches: Float[np.ndarray, "n links"], angles: Float[np.ndarray, "*any"]
    ) -> Float[np.ndarray, "n 3 *any"]:
        """Travel of points by all links along x, y and z of the frame in which the chain begins [m], at angles [rad].

        No point moves along an axis by turning about it. Behind a rotation about p a shift s moves along the axis i by
        |s.p| |p_i| + |s x p| sqrt(1 - p_i²) at most; behind rotations about several axes, by |s|.
        """
        whole, turned, pivot = np.zeros((len(reaches), 3, angles.size)), np.eye(3), _Pivot()
        for number, link in enumerate(self.chain):
            turned = turned @ link.position.rotation
            about = turned @ _unit(link.body.joint.axis)
            own = pivot.joined(about)
            if self.moves[number]:
                across = np.ones(3) if own.several else np.sqrt(np.maximum(1 - about**2, 0.0))
                whole += [
                    self._along(link, partial(_shifted, pivot, axis, turned), angles.ravel()) for axis in range(3)
                ]
                rotated = self._along(link, _rotated, angles.ravel())
                whole += across[:, None] * rotated * reaches[:, number, None, None]
            if link.turns(self.drive):
                pivot = own
        return whole.reshape(len(reaches), 3, *angles.shape)

    def reaches(self, extents: tuple[BodyPoints, ...]) -> Float[np.ndarray, "n links"]:
        """Largest distances of points of the last body from the axis of each link's joint [m]; a row for each."""
        # From the last link to the first: the points' distance from the axis, their distance from the origin, the axis.
        axis = _unit(self.chain[-1].body.joint.axis)
        across, farthest = _own_reaches(extents, tuple(axis.tolist()))
        reaches = [across]
        for link, beyond in zip(self.chain[-2::-1], self.chain[::-1], strict=False):
            own, offset = _unit(link.body.joint.axis), beyond.position.origin
            moved = _largest_shift(beyond.body.joint.motion)
            parallel = np.abs(_cross(beyond.position.rotation @ axis, own)).max() < _PARALLEL
            across = float(np.linalg.norm(_cross(offset, own))) + moved + (across if parallel else farthest)
            farthest, axis = farthest + float(np.linalg.norm(offset)) + moved, own
            reaches.append(across)
        return np.stack(reaches[::-1], axis=1)


_Steps = Callable[[SceneMotion], FloatArray]


def _lengths(motion: SceneMotion) -> FloatArray:
    return np.asarray(np.linalg.norm(np.diff(motion.shift, axis=0), axis=1))


def _rotated(motion: SceneMotion) -> FloatArray:
    return np.asarray(np.abs(np.diff(motion.rotation)))


def _shifted(pivot: "_Pivot", axis: int, turned: Float[np.ndarray, "3 3"], motion: SceneMotion) -> FloatArray:
    return pivot.along(axis, turned, np.diff(motion.shift, axis=0))


@record
class _Pivot:
    """The axes about which what carries a link turns: none, one, or several."""

    axis: FloatArray | None = None
    several: bool = False

    def joined(self, about: FloatArray) -> "_Pivot":
        """With another axis."""
        if self.axis is None:
            return _Pivot(about, self.several)
        return _Pivot(self.axis, self.several or bool(np.abs(_cross(self.axis, about)).max() >= _PARALLEL))

    def along(
        self, axis: int, turned: Float[np.ndarray, "3 3"], shift: Float[np.ndarray, "n 3"]
    ) -> Float[np.ndarray, " n"]:
        """Largest motion along an axis by shifts in a frame that is turned at rest [m]."""
        if self.several:
            return np.asarray(np.linalg.norm(shift, axis=1))
        outside = shift @ turned.T
        if self.axis is None:
            return np.asarray(np.abs(outside[:, axis]))
        own, rest = self.axis[axis], np.linalg.norm(_cross(outside, self.axis), axis=1)
        return np.asarray(np.abs(outside @ self.axis) * abs(own) + rest * math.sqrt(max(1 - own**2, 0.0)))


def _unit(axis: Sequence[float]) -> FloatArray:
    vector = np.array(axis, dtype=float)
    return np.asarray(vector / np.linalg.norm(vector))


def _largest_shift(motion: SceneMotion | None) -> float:
    return 0.0 if motion is None else float(np.linalg.norm(motion.shift, axis=1).max())
