"""A tree seen from a side: the outlines of its parts, at rest or over the turn of a drive.

The outline of a part is that of its mesh [`manifold3d`], of a turned one along or across its axis that of its profile;
holes are left out. A part that turns about the line of sight or does not turn keeps it; of one that turns otherwise the
convex hull of what is seen is drawn.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from enum import Enum
from functools import cached_property, lru_cache

import numpy as np
from manifold3d import CrossSection, FillRule, Manifold, Mesh
from scipy.spatial import ConvexHull

from ilmek.arrays import Complex, ComplexArray, Float, FloatArray
from ilmek.part.colliders import MANY
from ilmek.part.extents import around, extents
from ilmek.part.part import Part
from ilmek.part.placement import IDENTITY, Placement
from ilmek.part.poses import Chain, Poses, chains, poses
from ilmek.part.shapes import Turned
from ilmek.part.tree import Tree
from ilmek.plane.contours import along, circle
from ilmek.plane.curves import hull
from ilmek.plane.vectors import following
from ilmek.records import record
from ilmek.report.scene import Solid
from ilmek.units import mm, turn

COARSE = 0.5 * mm
"""Deviation of outlines [m]."""

DIRECTIONS = 16
"""Directions in which the hull of a part is measured that turns out of the plane of the view."""

_SAME = 1e-9


class View(Enum):
    """A side from which a machine is seen: its line of sight, and which axes point to the right and up."""

    SIDE = ((-1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 1.0, 0.0))
    """From the weaver's right: the front is at the right."""
    FRONT = ((0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    TOP = ((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, -1.0))
    """From above: the weaver stands below."""

    @cached_property
    def rotation(self) -> Float[np.ndarray, "3 3"]:
        """From the axes of the scene to those of the view: right, up, towards the eye."""
        sight, right, up = (np.array(axis) for axis in self.value)
        return np.array([right, up, -sight])


def widest_view(tree: Tree) -> View:
    """The view in which the box about a tree is largest."""
    low, high = around(extents(tree, ()))
    area = {view: float(np.prod((np.abs(view.rotation) @ (high - low))[:2])) for view in View}
    return max(area, key=area.__getitem__)


@record
class PieceOutline:
    """What is seen of a piece of a part: closed curves [m], and its nearest distance towards the eye [m]."""

    part: Part
    body: str
    curves: tuple[ComplexArray, ...]
    near: float

    @property
    def middle(self) -> complex:
        """The middle of the box about it."""
        every = np.concatenate(self.curves)
        return complex(np.ptp(every.real) / 2 + every.real.min(), np.ptp(every.imag) / 2 + every.imag.min())


@record
class MovingOutline:
    """What is seen of a piece over the frames of a motion [m]; depth: of its origin, towards the eye [m]."""

    part: Part
    body: str
    points: Complex[np.ndarray, "frames points"]
    depth: FloatArray


@dataclass(frozen=True)
class _Piece:
    """A part at a position in a body; or many of it, as the corners of their convex hull in the body's axes [m]."""

    part: Part
    chain: Chain
    position: Placement
    corners: Float[np.ndarray, "corners 3"] | None = None


def outlines(tree: Tree, view: View, drive: str = "", angle: float = 0.0) -> tuple[PieceOutline, ...]:
    """The outlines of all pieces that have a shape, the farthest first.

    Pieces that cover each other alike are one; so are those of a part that is in its body `MANY` times, as their hull.

    drive, angle  the angle of a drive [rad]; default: all stand at 0
    """
    seen: dict[tuple[str, bytes], PieceOutline] = {}
    for chain in chains(tree):
        body = poses(chain, drive, np.array([angle]))
        for occurrence in chain[-1].body.occurrences:
            if occurrence.part.shape is None:
                continue
            pieces = [_at_rest(occurrence.part, chain, body, position, view) for position in occurrence.positions]
            if len(pieces) >= MANY:
                every = np.concatenate([curve for piece in pieces for curve in piece.curves])
                pieces = [replace(pieces[0], curves=(hull(every),), near=max(piece.near for piece in pieces))]
            for piece in pieces:
                key = piece.part.id, np.round(piece.curves[0] / (0.1 * mm)).tobytes()
                if key not in seen or seen[key].near < piece.near:
                    seen[key] = piece
    return tuple(sorted(seen.values(), key=lambda outline: outline.near))


def _at_rest(part: Part, chain: Chain, body: Poses, position: Placement, view: View) -> PieceOutline:
    here = _seen(body, position, view)
    curves, near = _projected(part, here.rotation[0].tobytes())
    right, up, towards = here.origin[0].tolist()
    return PieceOutline(part, chain[-1].name, tuple(curve + complex(right, up) for curve in curves), near + towards)


def moving_outlines(
    tree: Tree, view: View, drive: str, angle: FloatArray, bodies: Iterable[str]
) -> tuple[MovingOutline, ...]:
    """The outlines of the pieces of some bodies at angles of a drive [rad]."""
    chosen = frozenset(bodies)
    seen: dict[tuple[str, bytes], MovingOutline] = {}
    for piece in _pieces(tree):
        if piece.chain[-1].name not in chosen:
            continue
        here = _seen(poses(piece.chain, drive, angle), piece.position, view)
        for points in _over_turn(piece, here):
            key = piece.part.id, np.round(points[0] / (0.1 * mm)).tobytes()
            seen.setdefault(key, MovingOutline(piece.part, piece.chain[-1].name, points, here.origin[:, 2]))
    return tuple(seen.values())


def _pieces(tree: Tree) -> Iterator[_Piece]:
    for chain in chains(tree):
        for occurrence in chain[-1].body.occurrences:
            part, positions = occurrence.part, occurrence.positions
            if part.shape is None:
                continue
            if len(positions) < MANY:
                yield from (_Piece(part, chain, position) for position in positions)
                continue
            own = _points(part)
            every = np.concatenate([position.points(own) for position in positions])
            yield _Piece(part, chain, IDENTITY, every[ConvexHull(every).vertices])


def _seen(body: Poses, position: Placement, view: View) -> Poses:
    """Poses of a part in the axes of the view."""
    origin = body.origin + body.rotation @ position.origin
    return Poses(view.rotation @ body.rotation @ position.rotation, origin @ view.rotation.T)


def _over_turn(piece: _Piece, here: Poses) -> Iterator[Complex[np.ndarray, "frames points"]]:
    origin = here.origin[:, 0] + 1j * here.origin[:, 1]
    relative = here.rotation @ here.rotation[0].T
    if np.abs(relative[:, 2, 2] - 1).max() < _SAME:
        turned = relative[:, 0, 0] + 1j * relative[:, 1, 0]
        for curve in _curves(piece, here.rotation[0]):
            yield origin[:, None] + turned[:, None] * curve
        return
    corners = _points(piece.part) if piece.corners is None else piece.corners
    flat = np.einsum("fij,pj->fpi", here.rotation[:, :2], corners)
    away = np.exp(1j * turn * np.arange(DIRECTIONS) / DIRECTIONS)
    far = flat[:, :, 0, None] * away.real + flat[:, :, 1, None] * away.imag
    corner = np.take_along_axis(flat, far.argmax(1)[:, :, None], axis=1)
    yield origin[:, None] + corner[:, :, 0] + 1j * corner[:, :, 1]


def _curves(piece: _Piece, turned: Float[np.ndarray, "3 3"]) -> tuple[ComplexArray, ...]:
    """The outline of a piece at rest, about its origin [m]."""
    if piece.corners is None:
        return _projected(piece.part, turned.tobytes())[0]
    flat = piece.corners @ turned[:2].T
    return (hull(flat[:, 0] + 1j * flat[:, 1]),)


@lru_cache(maxsize=2048)  # a loom has about a thousand
def _projected(part: Part, rotation: bytes) -> tuple[tuple[ComplexArray, ...], float]:
    """Outer curves of a part turned about its origin [m], and its nearest distance towards the eye [m]."""
    turned = np.frombuffer(rotation).reshape(3, 3)
    if isinstance(part.shape, Turned) and (seen_turned := _turned_body(part.shape, turned[:, 2])):
        return seen_turned
    mesh = _mesh(part)
    # Not kept: a Manifold that lives as long as the process is reported as leaked at its end.
    solid = Manifold(Mesh(mesh.points.astype(np.float32), mesh.triangles.astype(np.uint32)))
    seen = solid.transform(np.column_stack([turned, np.zeros(3)]))
    outer = tuple(_outer(seen.project()))
    if not outer:  # thinner than the deviation
        flat = mesh.points @ turned[:2].T
        outer = (hull(flat[:, 0] + 1j * flat[:, 1]),)
    return outer, float(seen.bounding_box()[5])


def _turned_body(shape: Turned, axis: Float[np.ndarray, "3"]) -> tuple[tuple[ComplexArray, ...], float] | None:
    """What is seen of a turned body along its axis, its largest circle, or across it, its frustums; None: aslant."""
    profile = along(shape.profile.outline, COARSE / 2)
    if abs(axis[2]) > 1 - _SAME:
        return (along(circle(0j, shape.outer_radius), COARSE / 2),), float((profile.real * axis[2]).max())
    if abs(axis[2]) > _SAME:
        return None
    after = following(profile)
    ahead = profile.real < after.real
    left, right = np.where(ahead, profile, after), np.where(ahead, after, profile)
    frustums = np.stack([left.conj(), right.conj(), right, left], axis=1)[left.real < right.real]
    together = CrossSection(list(np.stack([frustums.real, frustums.imag], axis=-1)), FillRule.NonZero)
    return tuple(complex(axis[0], axis[1]) * curve for curve in _outer(together)), shape.outer_radius


def _outer(section: CrossSection) -> Iterator[ComplexArray]:
    """Its outer curves, simplified."""
    curves = (polygon[:, 0] + 1j * polygon[:, 1] for polygon in section.simplify(COARSE / 2).to_polygons())
    return (curve for curve in curves if _area(curve) > 0)


@lru_cache(maxsize=512)  # all parts of a loom: each view goes through them in the same order
def _mesh(part: Part) -> Solid:
    assert part.shape is not None
    return part.shape.mesh(COARSE)


def _area(curve: ComplexArray) -> float:
    return float((np.conj(curve) * following(curve)).imag.sum()) / 2


@lru_cache(maxsize=512)
def _points(part: Part) -> Float[np.ndarray, "points 3"]:
    """Corners of the convex hull of a part [m]."""
    assert part.shape is not None
    points = part.shape.mesh(2 * COARSE).points
    return np.asarray(points[ConvexHull(points).vertices])
