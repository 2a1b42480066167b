"""What stands in the way of a solid that moves straight: exact over the whole move, by the bands that edges sweep.

A solid that moves by v meets another first where an edge passes an edge, a corner a face, or a face a corner. So it
meets none where the bands that its edges sweep cut no triangle of the other, and the bands that the edges of the other
sweep by -v cut none of its own; of the edges those that have a face with n . v > 0.

Solids are taken smaller by `FIT`: each corner r moves by u, n . u = -FIT for the normals n of all faces about it [least
squares]. Parts that touch or fit into each other are then apart, and only what goes in deeper counts.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import TypeAlias

import fcl
import numpy as np

from ilmek.arrays import Float, Int
from ilmek.part.colliders import triangle_tree
from ilmek.part.placement import Placement
from ilmek.report.scene import Solid
from ilmek.units import mm

FIT = 0.15 * mm
"""Depth into each of two parts that counts as their fit: facets of a pin in those of its bore [m]."""

_FLAT = 1e-6
"""Difference of normals that counts as rounding."""

_DIGITS = 6
"""Digits of moves [m] at which two are the same."""

Vector: TypeAlias = Float[np.ndarray, " 3"]
Box: TypeAlias = Float[np.ndarray, "2 3"]
Points: TypeAlias = Float[np.ndarray, "points 3"]


def offset(solid: Solid, by: float) -> Solid:
    """A solid with its faces moved outwards by a length [m], inwards below 0."""
    points, number = np.unique(solid.points.round(9), axis=0, return_inverse=True)
    triangles = number.reshape(-1)[solid.triangles]
    normals = _normals(points, triangles)
    triangles, normals = triangles[np.abs(normals).any(1)], normals[np.abs(normals).any(1)]
    corners, own = triangles.ravel(), np.repeat(normals, 3, axis=0)
    matrix, side = np.zeros((len(points), 3, 3)), np.zeros((len(points), 3))
    np.add.at(matrix, corners, own[:, :, None] * own[:, None, :])
    np.add.at(side, corners, own)
    moved = by * (np.linalg.pinv(matrix, rcond=1e-3, hermitian=True) @ side[:, :, None])[:, :, 0]
    longest = 3 * abs(by)  # at sharp edges
    lengths = np.linalg.norm(moved, axis=1, keepdims=True)
    return Solid(points + moved * np.minimum(1.0, longest / np.maximum(lengths, 1e-12)), triangles)


def _normals(points: Points, triangles: Int[np.ndarray, "triangles 3"]) -> Float[np.ndarray, "triangles 3"]:
    """Unit normals of triangles; 0 for those without an area."""
    first, second, third = points[triangles].swapaxes(0, 1)
    across = np.cross(second - first, third - first)
    length = np.linalg.norm(across, axis=1, keepdims=True)
    return np.asarray(np.where(length > 1e-14, across / np.maximum(length, 1e-14), 0.0))


def edges_of(solid: Solid) -> tuple[Int[np.ndarray, "edges 2"], Float[np.ndarray, "edges 2 3"]]:
    """Numbers of both ends of each edge between faces that do not lie in one plane, once, and the normals of its two
    faces; NaN for an edge of another number of faces.
    """
    ends = np.concatenate([solid.triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    normals = np.tile(_normals(solid.points, solid.triangles), (3, 1))
    order = np.lexsort(np.sort(ends, axis=1).T)
    ends, normals = np.sort(ends[order], axis=1), normals[order]
    same = np.append((ends[1:] == ends[:-1]).all(1), False)
    after = np.roll(normals, -1, axis=0)
    flat = same & (np.abs(after - normals).max(1) < _FLAT)
    first = np.flatnonzero(~np.roll(same, 1) & ~flat)
    pairs = np.stack([normals, after], axis=1)[first]
    pairs[~same[first] | np.roll(same, -1)[first]] = np.nan
    return ends[first], pairs


@dataclass(frozen=True, eq=False)
class FittedSolid:
    """A solid in its own axes, its edges, and the search trees of its triangles and of what these sweep."""

    solid: Solid
    edges: Int[np.ndarray, "edges 2"]
    normals: Float[np.ndarray, "edges 2 3"]
    _bands: dict[tuple[float, ...], fcl.BVHModel] = field(default_factory=dict)

    @cached_property
    def still(self) -> fcl.BVHModel:
        """Its triangles."""
        return triangle_tree(self.solid.points, self.solid.triangles)

    def bands(self, move: Vector) -> fcl.BVHModel:
        """The bands that its edges sweep by a move [m], but those of no face that looks ahead: where such an edge is,
        its surface was before.
        """
        move = move.round(_DIGITS) + 0.0
        key = tuple(move.tolist())
        if key not in self._bands:
            behind = (self.normals @ move).max(1) <= _FLAT * np.linalg.norm(move)
            begin, end = self.solid.points[self.edges[~behind]].swapaxes(0, 1)
            first = np.arange(len(begin))
            second, third, fourth = (first + k * len(begin) for k in (1, 2, 3))
            faces = np.concatenate([np.stack([first, second, third], 1), np.stack([second, fourth, third], 1)])
            self._bands[key] = triangle_tree(np.concatenate([begin, end, begin + move, end + move]), faces)
        return self._bands[key]


def fitted(solid: Solid, by: float) -> FittedSolid:
    """A solid with its faces moved outwards by a length [m]."""
    made = offset(solid, by)
    return FittedSolid(made, *edges_of(made))


@dataclass(frozen=True, eq=False)
class MovedSolids:
    """Solids where they stand that move as one."""

    solids: Sequence[tuple[FittedSolid, Placement]]

    @cached_property
    def boxes(self) -> Float[np.ndarray, "solids 2 3"]:
        """Least and largest x, y, z of each [m]."""
        placed = [position.points(own.solid.points) for own, position in self.solids]
        return np.stack([np.stack([points.min(0), points.max(0)]) for points in placed])

    @cached_property
    def box(self) -> Box:
        """Least and largest x, y, z of all [m]."""
        return np.stack([self.boxes[:, 0].min(0), self.boxes[:, 1].max(0)])


def meets(moving: MovedSolids, standing: MovedSolids, move: Vector, start: Vector | None = None) -> bool:
    """Whether what moves straight meets something [m]; start  from where it stands: where the move begins."""
    begin = np.zeros(3) if start is None else start
    for (own, here), (other, there) in _pairs(moving, standing, move, begin):
        shifted = Placement(here.origin + begin, here.rotation)
        if _cut(own.bands(here.rotation.T @ move), shifted, other.still, there):
            return True
        if _cut(own.still, shifted, other.bands(-there.rotation.T @ move), there):
            return True
    return False


def through(first: MovedSolids, other: MovedSolids) -> bool:
    """Whether the surfaces of some solids cut others where they stand."""
    pairs = _pairs(first, other, np.zeros(3), np.zeros(3))
    return any(_cut(own.still, here, its.still, there) for (own, here), (its, there) in pairs)


def _pairs(
    moving: MovedSolids, standing: MovedSolids, move: Vector, begin: Vector
) -> Iterator[tuple[tuple[FittedSolid, Placement], tuple[FittedSolid, Placement]]]:
    """What may meet, by the boxes of what moves from `begin` and of what stands."""
    low = moving.boxes[:, 0] + begin + np.minimum(move, 0.0)
    high = moving.boxes[:, 1] + begin + np.maximum(move, 0.0)
    meet = (low[:, None] <= standing.boxes[:, 1]) & (standing.boxes[:, 0] <= high[:, None])
    for first, other in np.argwhere(meet.all(2)).tolist():
        yield moving.solids[first], standing.solids[other]


def _cut(own: fcl.BVHModel, here: Placement, other: fcl.BVHModel, there: Placement) -> bool:
    first, second = (
        fcl.CollisionObject(model, fcl.Transform(where.rotation, where.origin))
        for model, where in ((own, here), (other, there))
    )
    return bool(fcl.collide(first, second, _request(), fcl.CollisionResult()) > 0)


def swept_box(box: Box, move: Vector) -> Box:
    """The box about a box that moves straight [m]."""
    return np.stack([box[0] + np.minimum(move, 0.0), box[1] + np.maximum(move, 0.0)])


@lru_cache(maxsize=1)
def _request() -> fcl.CollisionRequest:
    return fcl.CollisionRequest(num_max_contacts=1)
