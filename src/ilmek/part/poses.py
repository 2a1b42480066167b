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
from functools import cached_property, partial

import numpy as np

from ilmek.arrays import Float, FloatArray
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

    def turns(self, drive: str) -> bool:
        """Whether it turns with a drive."""
        motion = self.body.joint.motion
        return motion is not None and motion.drive == drive and bool(np.ptp(motion.rotation))


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
    rotation, origin = np.eye(3)[None], np.zeros((1, 3))
    for link in chain:
        origin = origin + rotation @ link.position.origin
        rotation = rotation @ link.position.rotation
        motion = link.body.joint.motion
        if motion is not None:
            shift, turned = _moved(link.body, motion, angle if motion.drive == drive else np.zeros(1))
            origin = origin + (rotation @ shift[:, :, None])[:, :, 0]
            rotation = rotation @ turned
    shape = len(angle), 3
    return Poses(np.broadcast_to(rotation, (*shape, 3)), np.broadcast_to(origin, shape))


def _moved(
    body: RigidBody, motion: SceneMotion, angle: FloatArray
) -> tuple[Float[np.ndarray, "n 3"], Float[np.ndarray, "n 3 3"]]:
    """Shift [m] and rotation of a motion at angles of its drive [rad]: Rodrigues' formula."""
    shift = np.stack([np.interp(angle, motion.angle, motion.shift[:, axis]) for axis in range(3)], axis=1)
    turned = np.interp(angle, motion.angle, motion.rotation)[:, None, None]
    x, y, z = _unit(body.joint.axis).tolist()
    across = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return shift, np.eye(3) + np.sin(turned) * across + (1 - np.cos(turned)) * (across @ across)


@dataclass(frozen=True)
class MovingPoints:
    """Points of the last body of a chain [m], over the turn of a drive."""

    chain: Chain
    points: Points
    drive: str

    def travel(self, angle: FloatArray) -> tuple[FloatArray, ...]:
        """How far a point has moved at most from angle 0 on [m], by the motion of each link of the chain."""
        return tuple(
            _travelled(link, self.drive, angle, lambda shift: np.linalg.norm(shift, axis=1), reach)
            for link, reach in zip(self.chain, self.reaches, strict=True)
        )

    def travel_along_axes(self, angle: FloatArray) -> Float[np.ndarray, "3 angles"]:
        """The same by all links, along x, y and z of the frame in which the chain begins [m].

        No point moves along an axis by turning about it. Behind a rotation about p a shift s moves along the axis i by
        |s.p| |p_i| + |s x p| sqrt(1 - p_i²) at most; behind rotations about several axes, by |s|.
        """
        whole, turned, pivot = np.zeros((3, len(angle))), np.eye(3), _Pivot()
        for link, reach in zip(self.chain, self.reaches, strict=True):
            turned = turned @ link.position.rotation
            about = turned @ _unit(link.body.joint.axis)
            own = pivot.joined(about)
            across = np.ones(3) if own.several else np.sqrt(np.maximum(1 - about**2, 0.0))
            for axis in range(3):
                shifted = partial(pivot.along, axis, turned)
                whole[axis] += _travelled(link, self.drive, angle, shifted, reach * float(across[axis]))
            if link.turns(self.drive):
                pivot = own
        return whole

    @cached_property
    def reaches(self) -> tuple[float, ...]:
        """Largest distance of a point from the axis of each link's joint [m]."""
        reaches: list[float] = []
        # From the last link to the first: the points' distance from the axis, their distance from the origin, the axis.
        across = farthest = 0.0
        axis = np.zeros(3)
        for number, link in enumerate(reversed(self.chain)):
            own = _unit(link.body.joint.axis)
            if number == 0:
                across = float(np.linalg.norm(np.cross(self.points, own), axis=1).max())
                farthest = float(np.linalg.norm(self.points, axis=1).max())
            else:
                beyond = self.chain[len(self.chain) - number]
                offset, moved = beyond.position.origin, _largest_shift(beyond.body.joint.motion)
                parallel = np.abs(np.cross(beyond.position.rotation @ axis, own)).max() < _PARALLEL
                across = float(np.linalg.norm(np.cross(offset, own))) + moved + (across if parallel else farthest)
                farthest += float(np.linalg.norm(offset)) + moved
            axis = own
            reaches.append(across)
        return tuple(reversed(reaches))


@record
class _Pivot:
    """The axes about which what carries a link turns: none, one, or several."""

    axis: FloatArray | None = None
    several: bool = False

    def joined(self, about: FloatArray) -> "_Pivot":
        """With another axis."""
        if self.axis is None:
            return _Pivot(about, self.several)
        return _Pivot(self.axis, self.several or bool(np.abs(np.cross(self.axis, about)).max() >= _PARALLEL))

    def along(
        self, axis: int, turned: Float[np.ndarray, "3 3"], shift: Float[np.ndarray, "n 3"]
    ) -> Float[np.ndarray, " n"]:
        """Largest motion along an axis by shifts in a frame that is turned at rest [m]."""
        if self.several:
            return np.asarray(np.linalg.norm(shift, axis=1))
        outside = shift @ turned.T
        if self.axis is None:
            return np.asarray(np.abs(outside[:, axis]))
        own, rest = self.axis[axis], np.linalg.norm(np.cross(outside, self.axis), axis=1)
        return np.asarray(np.abs(outside @ self.axis) * abs(own) + rest * math.sqrt(max(1 - own**2, 0.0)))


def _unit(axis: Sequence[float]) -> FloatArray:
    vector = np.array(axis, dtype=float)
    return np.asarray(vector / np.linalg.norm(vector))


def _largest_shift(motion: SceneMotion | None) -> float:
    return 0.0 if motion is None else float(np.linalg.norm(motion.shift, axis=1).max())


def _travelled(
    link: ChainLink,
    drive: str,
    angle: FloatArray,
    length: Callable[[Float[np.ndarray, "n 3"]], FloatArray],
    reach: float,
) -> FloatArray:
    motion = link.body.joint.motion
    if motion is None or motion.drive != drive:
        return np.zeros(len(angle))
    steps = length(np.diff(motion.shift, axis=0)) + np.abs(np.diff(motion.rotation)) * reach
    return np.asarray(np.interp(angle, motion.angle, np.concatenate([[0.0], np.cumsum(steps)])))
