"""What distances of parts are measured from: their meshes, and the convex hulls of these; and what two have in common.

Distances by `fcl`, volumes in common by `manifold3d`. What lies between two parallel planes t apart has a volume V over
its surface S of V / S <= t / 2: parts whose boxes share less than `DEPTH` need no volume in common to be computed.
"""

import hashlib
import math
from collections.abc import Callable, Hashable, Iterable
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial
from typing import Generic, TypeVar, cast

import fcl
import numpy as np
from manifold3d import Manifold, Mesh
from scipy.spatial import ConvexHull

from ilmek.arrays import Float, Int
from ilmek.part.placement import Placement
from ilmek.part.shapes import Shape, Turned
from ilmek.part.tree import Occurrence
from ilmek.plane.solids import is_closed, volume
from ilmek.report.scene import Solid
from ilmek.units import mm

DEVIATION = 0.1 * mm
"""Deviation of the meshes from the parts, which lie outside of them [m]."""

COARSE = 1 * mm
"""Deviation where a part is in its body `MANY` times or more [m]."""

MANY = 40

DEPTH, VOLUME = 0.1 * mm, 0.2 * mm**3
"""Mean depth and volume in common below which parts touch: facets of a pin in those of its bore, and rounding."""

LARGE = 20_000
"""Triangles above which a mesh is searched near the other part only."""

_CONVEX = 1e-9
"""Share of a mesh's volume that its convex hull may have more, by rounding."""

_ROUNDED = 7
"""Digits of the relative positions [m] that are compared: pairs of like parts that lie alike are measured once."""

_SAME = 9
"""Digits of the relative positions [m] at which distances are the same."""

_KEPT = 20_000
"""Results for pairs that are kept."""

T = TypeVar("T")
Rotation = Float[np.ndarray, "3 3"]
Vector = Float[np.ndarray, " 3"]
Points = Float[np.ndarray, "points 3"]


@dataclass(frozen=True, eq=False)
class Collider:
    """A solid that distances are measured from, in its own axes.

    mesh  makes its mesh        spun  whether it is a body of revolution about its z axis
    """

    mesh: Callable[[], Solid]
    spun: bool = False

    @cached_property
    def solid(self) -> Solid:
        """Its mesh."""
        return self.mesh()

    @cached_property
    def _hull(self) -> ConvexHull:
        return ConvexHull(self.solid.points)

    @cached_property
    def corners(self) -> Points:
        """Corners of its convex hull [m]."""
        return np.asarray(self.solid.points[self._hull.vertices])

    @cached_property
    def bounds(self) -> Float[np.ndarray, "2 3"]:
        """Least and largest x, y, z [m]."""
        return np.stack([self.corners.min(0), self.corners.max(0)])

    @cached_property
    def convex(self) -> bool:
        """Whether the mesh is its own convex hull."""
        return bool(self._hull.volume <= volume(self.solid) * (1 + _CONVEX))

    @cached_property
    def closed(self) -> bool:
        """Whether the mesh encloses a volume."""
        return is_closed(self.solid)

    @property
    def large(self) -> bool:
        """Whether it has so many triangles that a search of all takes long."""
        return len(self.solid.triangles) > LARGE

    def near(self, points: Points, gap: float) -> fcl.CollisionObject | None:
        """Its triangles that are within a gap of the box about points [m]; None where there are none."""
        low, high = points.min(0) - gap, points.max(0) + gap
        corners = self.solid.points[self.solid.triangles]
        within = ((corners.max(1) >= low) & (corners.min(1) <= high)).all(1)
        triangles = self.solid.triangles[within]
        return fcl.CollisionObject(triangle_tree(self.solid.points, triangles)) if len(triangles) else None

    @cached_property
    def digest(self) -> bytes:
        """The same for solids of the same points and triangles."""
        content = self.solid.points.tobytes() + self.solid.triangles.tobytes()
        return hashlib.blake2b(content, digest_size=16).digest()

    @cached_property
    def outer(self) -> tuple[fcl.CollisionObject, fcl.CollisionObject]:
        """Its convex hull twice: one that stays in its own axes, one to be moved."""
        number = np.zeros(len(self.solid.points), dtype=int)
        number[self._hull.vertices] = np.arange(len(self._hull.vertices))
        faces = number[self._hull.simplices]
        flat = np.column_stack([np.full(len(faces), 3), faces]).ravel()
        hull = fcl.Convex(self.corners, len(faces), flat)
        return fcl.CollisionObject(hull), fcl.CollisionObject(hull)

    @cached_property
    def exact(self) -> tuple[fcl.CollisionObject, fcl.CollisionObject]:
        """The solid itself twice, as `outer`."""
        if self.convex:
            return self.outer
        model = triangle_tree(self.solid.points, self.solid.triangles)
        return fcl.CollisionObject(model), fcl.CollisionObject(model)

    def manifold(self) -> Manifold:
        """The solid for volumes in common; not kept: one that lives as long as the process is reported as leaked."""
        return Manifold(Mesh(self.solid.points.astype(np.float32), self.solid.triangles.astype(np.uint32)))


def triangle_tree(points: Points, triangles: Int[np.ndarray, "triangles 3"]) -> fcl.BVHModel:
    """The search tree of triangles: numbers of their three points [m]."""
    model = fcl.BVHModel()
    model.beginModel(len(triangles), len(points))
    model.addSubModel(points, triangles)
    model.endModel()
    return model


def collider(shape: Shape) -> Collider:
    """A shape."""
    return _collider(cast(Hashable, shape))  # every shape is a record


@lru_cache(maxsize=1024)
def _collider(hashed: Hashable) -> Collider:
    shape = cast(Shape, hashed)
    return Collider(lambda: shape.mesh(DEVIATION), isinstance(shape, Turned))


@lru_cache(maxsize=64)
def row(occurrence: Occurrence) -> tuple[Collider, Collider]:
    """A part that is in its body `MANY` times, in the body's axes: all of them, and the first, the middle, the last."""
    positions, shape = occurrence.positions, occurrence.part.shape
    assert shape is not None
    mesh = lru_cache(lambda: shape.mesh(COARSE))
    three = positions[0], positions[len(positions) // 2], positions[-1]
    return Collider(lambda: _repeated(mesh(), positions)), Collider(lambda: _repeated(mesh(), three))


def _repeated(mesh: Solid, positions: Iterable[Placement]) -> Solid:
    """The mesh at all positions."""
    points = [position.points(mesh.points) for position in positions]
    begins = np.arange(len(points)) * len(mesh.points)
    return Solid(np.concatenate(points), np.concatenate([mesh.triangles + begin for begin in begins]))


@dataclass(frozen=True, eq=False)
class Common:
    """What colliders have in common; a Manifold of each is made once, and not kept longer than this is."""

    manifolds: dict[Collider, Manifold]

    def depth(self, first: Collider, other: Collider, turned: Rotation, moved: Vector) -> tuple[float, float]:
        """Mean depth [m] and volume [m³] of what two have in common; 0 where they touch only.

        turned, moved  rotation and origin [m] of the other in the first one's axes
        """
        if shared_thickness(first, other, turned, moved) <= DEPTH:
            return 0.0, 0.0
        key = pose_key(first, other, turned, moved)
        return _MEASURED.of(key, lambda: self._measured(first, other, turned, moved))

    def _measured(self, first: Collider, other: Collider, turned: Rotation, moved: Vector) -> tuple[float, float]:
        common = self._of(first) ^ self._of(other).transform(np.column_stack([turned, moved]))
        shared = common.volume()
        depth = 2 * shared / common.surface_area() if shared > VOLUME else 0.0
        return (depth, shared) if depth > DEPTH else (0.0, 0.0)

    def _of(self, one: Collider) -> Manifold:
        if one not in self.manifolds:
            self.manifolds[one] = one.manifold()
        return self.manifolds[one]


@dataclass(frozen=True, eq=False)
class _Kept(Generic[T]):
    """Results by how two colliders lie, the last `_KEPT`: looms that differ elsewhere share them."""

    known: dict[tuple[bytes, ...], T]

    def of(self, key: tuple[bytes, ...], measure: Callable[[], T]) -> T:
        """The result of a key, measured where it is not known."""
        if key not in self.known:
            while len(self.known) >= _KEPT:
                del self.known[next(iter(self.known))]
            self.known[key] = measure()
        return self.known[key]


_MEASURED = _Kept[tuple[float, float]]({})
"""Mean depths [m] and volumes [m³] in common, by `pose_key`."""

_APART = _Kept[float]({})
"""Distances of meshes [m]."""


def pose_key(
    first: Collider, other: Collider, turned: Rotation, moved: Vector, along: Vector | None = None
) -> tuple[bytes, ...]:
    """The same for two colliders that lie alike; a body of revolution may be turned about its axis.

    along  direction in the first one's axes in which one of them may be elsewhere; default: none
    """
    if along is not None:
        moved = moved - along * (along @ moved)
    kept = turned[:, 2] if other.spun else turned
    if first.spun and not other.spun:
        moved, kept = -turned.T @ moved, turned[2]
    lies = np.concatenate([np.ravel(kept), moved])
    return first.digest, other.digest, (np.round(lies, _ROUNDED) + 0.0).tobytes()


def shared_thickness(first: Collider, other: Collider, turned: Rotation, moved: Vector) -> float:
    """Least side of what the boxes of two colliders share, in the axes of either [m]; below 0 they are apart."""
    back = turned.T
    return min(
        _least_side(first.bounds, other.corners @ back + moved),
        _least_side(other.bounds, (first.corners - moved) @ turned),
    )


def _least_side(box: Float[np.ndarray, "2 3"], points: Points) -> float:
    return float((np.minimum(box[1], points.max(0)) - np.maximum(box[0], points.min(0))).min())


def inside(first: Collider, other: Collider, turned: Rotation, moved: Vector) -> bool:
    """Whether one may be within the other: its box within the box of the other, in the axes of either."""
    theirs, own = other.corners @ turned.T + moved, (first.corners - moved) @ turned
    return _contains(first.bounds, theirs) or _contains(other.bounds, own)


def _contains(box: Float[np.ndarray, "2 3"], points: Points) -> bool:
    return bool((points.min(0) >= box[0]).all() and (points.max(0) <= box[1]).all())


def distances(
    colliders: Iterable[tuple[Collider, Collider]],
    turned: Float[np.ndarray, "n 3 3"],
    moved: Float[np.ndarray, "n 3"],
    *,
    exact: bool = True,
) -> Float[np.ndarray, " n"]:
    """Distances of two at a time, the other at positions in the first one's axes [m]; 0 where they touch or are through
    each other.

    exact  False: of their convex hulls
    """
    if exact:
        lies = np.column_stack([turned.reshape(-1, 9), moved]).round(_SAME) + 0.0
        known = (
            _APART.of((first.digest, other.digest, row.tobytes()), partial(_exact, first, other, *where))
            for (first, other), row, *where in zip(colliders, lies, turned, moved, strict=True)
        )
        return np.array(list(known))
    both = zip(colliders, turned, moved, strict=True)
    return np.array([_apart(first.outer[0], other.outer[1], *where) for (first, other), *where in both])


def _exact(first: Collider, other: Collider, turned: Rotation, moved: Vector) -> float:
    return _apart(first.exact[0], other.exact[1], turned, moved)


def _apart(own: fcl.CollisionObject, its: fcl.CollisionObject, turned: Rotation, moved: Vector) -> float:
    its.setTransform(fcl.Transform(turned, moved))
    return max(float(fcl.distance(own, its, _REQUEST, _RESULT)), 0.0)


def gap_between(first: Collider, other: Collider, turned: Rotation, moved: Vector, most: float) -> float:
    """The distance of two colliders as of `distances` [m]; inf or more than `most` where it is above that."""
    if not (first.large or other.large):
        return float(distances([(first, other)], turned[None], moved[None])[0])
    if first.large and other.large:
        return math.inf
    if other.large:
        return gap_between(other, first, turned.T, -turned.T @ moved, most)
    own, its = first.near(other.corners @ turned.T + moved, most), other.exact[1]
    if own is None:
        return math.inf
    return _apart(own, its, turned, moved)


_REQUEST, _RESULT = fcl.DistanceRequest(), fcl.DistanceResult()
