"""Least distances in space of the parts of a tree over the turn of a drive.

Where two parts are d and d' apart at two angles, and their points move at most w against each other between them
(`poses`), they are in between nowhere nearer than

    (d + d' - w) / 2        [a point that is moved from p to p' by way of q has |p - q| + |q - p'| = |p - p'|]

Intervals whose bound lies below both the least distance so far and the required one are halved until none does by more
than `TOLERANCE`: a result above the required distance proves it for the whole turn, one below it is exact. This is done
with the convex hulls of the parts first, then, where these come near, with their meshes [`fcl`]. Parts at distance 0
may touch, or be through each other: the volume that they have in common [`manifold3d`] and its mean depth, twice the
volume over the surface, tell which. What touches, a pin in its bore, is looked at `POSES` times. Of a part that is in
its body `MANY` times or more the first, the middle and the last stand for all where it is compared with what does not
move against it, or with another of these.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import fcl
import numpy as np
from manifold3d import Manifold, Mesh
from scipy.spatial import ConvexHull

from ilmek.arrays import Float, FloatArray
from ilmek.part.part import Part
from ilmek.part.placement import Placement
from ilmek.part.poses import Chain, MovingPoints, Poses, chains, drive_angles, poses
from ilmek.part.tree import Tree
from ilmek.records import record
from ilmek.report.scene import Solid
from ilmek.units import mm, turn

DEVIATION = 0.1 * mm
"""Deviation of the meshes from the parts, which lie outside of them [m]."""

COARSE = 1 * mm
"""Deviation where a part is in its body `MANY` times or more, or its mesh would have `LARGE` triangles [m]."""

MANY, LARGE = 40, 20_000
TOLERANCE = 0.5 * mm
"""How far the least distance that is reported may be above that of the meshes [m]."""

INTERVALS, SAMPLES = 24, 8
"""Intervals of a turn that are compared by boxes, and samples of each."""

POSES = 8
"""Poses in a window at which parts that touch are looked at."""

DEPTH, VOLUME = 0.1 * mm, 50 * mm**3
"""Mean depth and volume in common below which parts touch: facets of a pin in those of its bore."""

_SHORTEST = 1e-6
"""Interval that is not halved further [rad]."""

_REQUEST = fcl.DistanceRequest()

Window = tuple[float, float]
TURN: tuple[Window, ...] = ((0.0, turn),)

Required = Callable[[str, str], float | None]


def _nothing_in_common(_first: str, _other: str) -> float:
    return 0.0


@record
class Approach:
    """The least distance of two parts [m]: below 0 the mean depth of what they have in common.

    parts, bodies  ids       drive, angle  where it occurs [rad]        volume  in common [m³]
    moving  whether they move against each other
    """

    parts: tuple[str, str]
    bodies: tuple[str, str]
    distance: float
    volume: float
    drive: str
    angle: float
    moving: bool


@dataclass(frozen=True)
class _Placed:
    """A part in a body, at one of its positions in it or at many, over the turn of a drive.

    few  of many, the first, the middle and the last
    """

    part: Part
    chain: Chain
    solid: Solid
    few: Solid
    drive: str
    angles: FloatArray
    ends: Float[np.ndarray, "intervals samples"]

    @property
    def body(self) -> str:
        return self.chain[-1].name

    @cached_property
    def travels(self) -> tuple[FloatArray, ...]:
        """Travel of each link of its chain at the angles [m]."""
        return MovingPoints(self.chain, self.hull_points, self.drive).travel(self.angles)

    def boxes(self, shared: int = 0) -> Float[np.ndarray, "intervals 2 3"]:
        """Boxes that contain it over the intervals, seen from a body of its chain: least and largest x, y, z [m].

        shared  number of the links to that body; default: seen from the ground
        """
        chain, number = self.chain[shared:], len(self.ends)
        points = MovingPoints(chain, self.hull_points, self.drive)
        if not any(travel[-1] for travel in self.travels[shared:]):
            still = poses(chain, self.drive, np.zeros(1)).points(self.hull_points)[0]
            return np.broadcast_to([still.min(0), still.max(0)], (number, 2, 3))
        at = poses(chain, self.drive, self.ends.ravel()).points(_corners(self.hull_points)).reshape(number, -1, 3)
        moved = points.travel_along_axes(self.angles)
        # Between two samples a point leaves the box of its ends by half of its travel at most.
        along = [np.diff(np.interp(self.ends, self.angles, axis)).max(axis=1) / 2 for axis in moved]
        margin = np.stack(along, axis=1)
        return np.stack([at.min(1) - margin, at.max(1) + margin], axis=1)

    @cached_property
    def hull_points(self) -> Float[np.ndarray, "points 3"]:
        """Corners of its convex hull [m]."""
        return np.asarray(self.solid.points[ConvexHull(self.solid.points).vertices])

    @cached_property
    def hull(self) -> fcl.CollisionObject:
        points = self.hull_points
        faces = ConvexHull(points).simplices
        flat = np.column_stack([np.full(len(faces), 3), faces]).ravel()
        return fcl.CollisionObject(fcl.Convex(points, len(faces), flat))

    @cached_property
    def mesh(self) -> fcl.CollisionObject:
        return fcl.CollisionObject(triangle_tree(self.solid))

    @cached_property
    def few_mesh(self) -> fcl.CollisionObject:
        return fcl.CollisionObject(triangle_tree(self.few))

    @cached_property
    def manifold(self) -> Manifold:
        return Manifold(Mesh(self.few.points.astype(np.float32), self.few.triangles.astype(np.uint32)))

    def poses(self, angle: FloatArray) -> Poses:
        return poses(self.chain, self.drive, angle)


def approaches(
    tree: Tree,
    drive: str,
    horizon: float,
    windows: tuple[Window, ...] = TURN,
    required: Required = _nothing_in_common,
    *,
    moving: bool = False,
) -> tuple[Approach, ...]:
    """The least distance of every two parts that come nearer than the horizon [m], the nearest first.

    Parts without a shape are left out.

    windows   angles of the turn that are looked at [rad]
    required  distance of two bodies, by their ids, above which there is no need of the exact one [m]; None: may do as
              they like. Default: 0
    moving    only parts that move against each other
    """
    placed = tuple(_placed(tree, drive, _intervals(windows)))
    boxes = np.array([thing.boxes() for thing in placed])
    met = []
    for first, thing in enumerate(placed):
        gaps = _gaps(boxes[first], boxes[first + 1 :])
        for offset in np.flatnonzero((gaps < horizon).any(1)).tolist():
            other = placed[first + 1 + offset]
            enough = required(thing.body, other.body)
            if enough is not None:
                pair = _Pair(thing, other, gaps[offset], horizon, enough)
                met.append(pair.approach() if pair.moving or not moving else None)
    return tuple(sorted((pair for pair in met if pair is not None), key=lambda pair: pair.distance))


def triangle_tree(solid: Solid) -> fcl.BVHModel:
    """The triangles of a solid, to measure distances from."""
    model = fcl.BVHModel()
    model.beginModel(len(solid.triangles), len(solid.points))
    model.addSubModel(solid.points, solid.triangles)
    model.endModel()
    return model


def _placed(tree: Tree, drive: str, ends: Float[np.ndarray, "intervals samples"]) -> Iterator[_Placed]:
    """Each piece of each part; of one that is in its body `MANY` times all pieces as one."""
    angles, solids = drive_angles(tree, drive), dict[str, tuple[tuple[Solid, Solid], ...]]()
    for chain in chains(tree):
        for occurrence in chain[-1].body.occurrences:
            part, positions = occurrence.part, occurrence.positions
            if part.shape is None:
                continue
            key = f"{chain[-1].name} {part.id}"
            if key not in solids:
                solids[key] = tuple(_solids(part, positions))
            yield from (_Placed(part, chain, *pair, drive, angles, ends) for pair in solids[key])


def _solids(part: Part, positions: tuple[Placement, ...]) -> Iterator[tuple[Solid, Solid]]:
    """The pieces of a part in a body; of many all as one, and with them three of them."""
    mesh = _mesh(part, len(positions))
    if len(positions) >= MANY:
        yield _row(mesh, positions), _row(mesh, (positions[0], positions[len(positions) // 2], positions[-1]))
        return
    for position in positions:
        piece = _row(mesh, (position,))
        yield piece, piece


def _mesh(part: Part, number: int) -> Solid:
    assert part.shape is not None
    fine = part.shape.mesh(COARSE if number >= MANY else DEVIATION)
    return fine if len(fine.triangles) < LARGE else part.shape.mesh(COARSE)


def _row(mesh: Solid, positions: Iterable[Placement]) -> Solid:
    """The mesh at all positions."""
    points = [position.points(mesh.points) for position in positions]
    begins = np.arange(len(points)) * len(mesh.points)
    return Solid(np.concatenate(points), np.concatenate([mesh.triangles + begin for begin in begins]))


def _corners(points: Float[np.ndarray, "points 3"]) -> Float[np.ndarray, "8 3"]:
    """Corners of the box about points in their own frame."""
    low, high = points.min(0), points.max(0)
    return np.array([np.where(chosen, high, low) for chosen in np.ndindex(2, 2, 2)])


def _intervals(windows: tuple[Window, ...]) -> Float[np.ndarray, "intervals samples"]:
    """Angles of the intervals of the windows [rad]: both ends of each, and samples between them."""
    rows = []
    for begin, end in windows:
        number = max(round((end - begin) / turn * INTERVALS), 1)
        edges = np.linspace(begin, end, number + 1)
        rows += [np.linspace(low, high, SAMPLES + 1) for low, high in pairwise(edges.tolist())]
    return np.array(rows)


def _gaps(
    box: Float[np.ndarray, "intervals 2 3"], others: Float[np.ndarray, "n intervals 2 3"]
) -> Float[np.ndarray, "n intervals"]:
    apart = np.maximum(box[:, 0] - others[:, :, 1], others[:, :, 0] - box[:, 1])
    return np.asarray(np.linalg.norm(np.maximum(apart, 0.0), axis=2))


@dataclass(frozen=True)
class _Pair:
    """Two parts, and the distances of their boxes in the intervals [m]."""

    first: _Placed
    other: _Placed
    gaps: FloatArray
    horizon: float
    enough: float

    @cached_property
    def shared(self) -> int:
        """Number of the links that both chains begin with."""
        pairs = zip(self.first.chain, self.other.chain, strict=False)
        return sum(1 for own, its in pairs if own == its)

    @cached_property
    def apart(self) -> FloatArray:
        """Distance of the boxes in the intervals, seen from the ground and from what carries both [m]."""
        if not any(travel[-1] for travel in self.first.travels[: self.shared]):
            return self.gaps
        seen = _gaps(self.first.boxes(self.shared), self.other.boxes(self.shared)[None])[0]
        return np.asarray(np.maximum(self.gaps, seen))

    @cached_property
    def moved(self) -> FloatArray:
        """Travel against each other at the angles: of the links of their chains that they do not share [m]."""
        every = [*self.first.travels[self.shared :], *self.other.travels[self.shared :]]
        return np.asarray(np.sum(every, axis=0)) if every else np.zeros(len(self.first.angles))

    @property
    def moving(self) -> bool:
        """Whether they move against each other."""
        return bool(self.moved[-1])

    def approach(self) -> Approach | None:
        """Their least distance; None where it is the horizon or more."""
        hulls = self._least(self.first.hull, self.other.hull)
        if hulls[1] >= self.horizon:
            return None
        angle, distance = self._least(*self._meshes())
        if distance >= self.horizon:
            return None
        depth, volume, deepest = self._deepest(angle) if distance <= 0 else (0.0, 0.0, angle)
        return Approach(
            (self.first.part.id, self.other.part.id),
            (self.first.body, self.other.body),
            distance - depth,
            volume,
            self.first.drive,
            deepest,
            self.moving,
        )

    def _meshes(self) -> tuple[fcl.CollisionObject, fcl.CollisionObject]:
        """What is compared: of two rows of many parts three of one of them, of two that stand three of each."""
        if not self.moving:
            return self.first.few_mesh, self.other.few_mesh
        many = self.first.few is not self.first.solid and self.other.few is not self.other.solid
        return self.first.few_mesh if many else self.first.mesh, self.other.mesh

    def _least(self, own: fcl.CollisionObject, its: fcl.CollisionObject) -> tuple[float, float]:
        """Angle and least distance of two colliders over the near intervals; the first angle at which it is 0."""
        angles, moved = self.first.angles, self.moved
        if not self.moving:
            return 0.0, float(self._distances(own, its, np.zeros(1))[0])
        near = self.apart < self.horizon
        if not near.any():
            return 0.0, self.horizon
        ends, floor = self.first.ends[near][:, [0, -1]], self.apart[near]
        once, number = np.unique(ends, return_inverse=True)
        apart = self._distances(own, its, once)[number].reshape(-1, 2)
        best = int(np.argmin(apart))
        angle, least = float(ends.flat[best]), float(apart.flat[best])
        while least > 0:
            travel = np.diff(np.interp(ends, angles, moved))[:, 0]
            bound = np.maximum((apart.sum(1) - travel) / 2, floor)
            is_open = (bound < min(least, self.enough) - TOLERANCE) & (ends[:, 1] - ends[:, 0] > _SHORTEST)
            if not is_open.any():
                break
            ends, apart, floor = ends[is_open], apart[is_open], np.tile(floor[is_open], 2)
            middle = _half_travelled(angles, moved, ends)
            between = self._distances(own, its, middle)
            lowest = int(np.argmin(between))
            if between[lowest] < least:
                angle, least = float(middle[lowest]), float(between[lowest])
            ends = np.concatenate([np.column_stack([ends[:, 0], middle]), np.column_stack([middle, ends[:, 1]])])
            apart = np.concatenate([np.column_stack([apart[:, 0], between]), np.column_stack([between, apart[:, 1]])])
        return angle, least

    def _distances(self, own: fcl.CollisionObject, its: fcl.CollisionObject, angle: FloatArray) -> FloatArray:
        """Distances at angles [m]; 0 where they touch or are through each other."""
        rotation, origin = self._relative(angle)
        own.setTransform(fcl.Transform())
        distances = np.empty(len(angle))
        for number, (turned, moved) in enumerate(zip(rotation, origin, strict=True)):
            its.setTransform(fcl.Transform(turned, moved))
            distances[number] = fcl.distance(own, its, _REQUEST, fcl.DistanceResult())
        return np.maximum(distances, 0.0)

    def _relative(self, angle: FloatArray) -> tuple[Float[np.ndarray, "angles 3 3"], Float[np.ndarray, "angles 3"]]:
        """Rotation and origin [m] of the other part in the first one's frame."""
        own, its = self.first.poses(angle), self.other.poses(angle)
        back = own.rotation.transpose(0, 2, 1)
        return back @ its.rotation, (back @ (its.origin - own.origin)[:, :, None])[:, :, 0]

    def _deepest(self, touched: float) -> tuple[float, float, float]:
        """Largest mean depth [m] of what they have in common, its volume [m³] and angle; 0 where they touch only."""
        ends = self.first.ends[self.apart < self.horizon] if self.moving else np.zeros((1, 1))
        every = ends[:, :: max(SAMPLES * INTERVALS // (POSES * len(ends)), 1)].ravel()
        tried = np.concatenate([[touched], np.unique(every)[:: max(len(every) // POSES, 1)]])
        deepest = 0.0, 0.0, touched
        for angle, turned, moved in zip(tried.tolist(), *self._relative(tried), strict=True):
            common = self.first.manifold ^ self.other.manifold.transform(np.column_stack([turned, moved]))
            volume, surface = common.volume(), common.surface_area()
            depth = 2 * volume / surface if surface > 0 else 0.0
            if volume > VOLUME and depth > max(DEPTH, deepest[0]):
                deepest = depth, volume, angle
        return deepest


def _half_travelled(angles: FloatArray, moved: FloatArray, ends: Float[np.ndarray, "n 2"]) -> FloatArray:
    """The angle at which half of the travel of each interval is done, or its middle where nothing moves [rad]."""
    halves = np.interp(np.interp(ends, angles, moved).mean(1), moved, angles)
    between = (ends[:, 0] < halves) & (halves < ends[:, 1])
    return np.asarray(np.where(between, halves, ends.mean(1)))
