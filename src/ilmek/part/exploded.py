"""An assembly taken apart: how far each piece is moved out along the axis by which it is joined.

Blocks with parallel axes whose convex hulls, seen along the axis, have room in common are on one line. The largest
block of all, by the diagonal of its box, stays. The blocks of a line are moved with that in which its largest lies, and
from there outwards along their axis, each by the least distance at which it is clear by a gap of all that it has room
in common with, on that side of what its line goes through on which it is assembled.

The axis of a piece is that of its body's joint, where it is the only part and meets none; else its own [`seat_axes`].
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from functools import lru_cache

import numpy as np
from scipy.spatial import ConvexHull

from ilmek.arrays import BoolArray, ComplexArray, Float, FloatArray
from ilmek.part.assemblies import AssembledPiece, AssemblyUnit
from ilmek.part.seat_axes import meeting_axes, seat_axis
from ilmek.part.shapes import Shape, box_corners, shape_box
from ilmek.part.tree import JointKind, Tree
from ilmek.plane.curves import hull
from ilmek.records import record
from ilmek.units import mm

GAP, SEEN = 0.02, 0.3
"""Least distance of a block from others: of the diagonal of the box about all, and of its second longest side."""

SHOWN = 16
"""Pieces of a part in a body that are shown; of more the first stands for all."""

_TOUCH, _RIM, _DEVIATION, _PARALLEL = 0.1 * mm, 0.05, 0.2 * mm, 1 - 1e-6
"""Depth within which what lies beside each other does not overlap [m]; rim about a box, of its diagonal; deviation of
the hulls [m]; cosine above which axes are parallel.
"""

Vector = Float[np.ndarray, " 3"]
Box = Float[np.ndarray, "2 3"]
Points = Float[np.ndarray, "points 3"]


@record
class Block:
    """Pieces that are moved as one by a shift [m]; where its middle was on what it came from, and where it is [m]."""

    pieces: tuple[AssembledPiece, ...]
    shift: Vector
    line: Float[np.ndarray, "2 3"]


def exploded(tree: Tree, assembly: AssemblyUnit, pieces: Sequence[AssembledPiece]) -> tuple[Block, ...]:
    """The blocks of an assembly's pieces, moved apart: a piece of its own, or an assembly in it."""
    axes = meeting_axes(tree)
    blocks = sorted(_blocks(assembly, pieces), key=lambda block: -_diagonal(_box(block)))
    boxes = np.array([_box(block) for block in blocks])
    corners, directions = [_hull_corners(block) for block in blocks], [_axis(block, axes) for block in blocks]
    whole = _diagonal(np.array([boxes[:, 0].min(0), boxes[:, 1].max(0)]))
    gaps = GAP * whole + SEEN * np.sort(boxes[:, 1] - boxes[:, 0], axis=1)[:, 1]
    begins, shifts = np.zeros((2, len(blocks), 3))
    placed: list[int] = []
    for line in _lines(corners, directions):
        axis, anchor = directions[line[0]], line[0]
        if placed:
            anchor = placed[_carrier(boxes[anchor], boxes[placed])]
        begin = shifts[anchor].copy()
        middles = np.array([(points @ axis).max() + (points @ axis).min() for points in corners]) / 2
        for number in sorted(line, key=lambda own: (abs(middles[own] - middles[anchor]), own)):
            standing = [corners[own] + shifts[own] for own in placed]
            away = middles[number] - middles[placed]
            sides = np.where(abs(away) > _TOUCH, np.sign(away), 0.0)
            own, along = np.isin(placed, [*line, anchor]), _beside(shifts[placed] - begin, axis)
            shift = _least_shift(
                corners[number] + begin, standing, axis, float(gaps[number]), (sides * along, sides * own)
            )
            begins[number], shifts[number] = begin, begin + shift * axis
            placed.append(number)
    lines = boxes.mean(1) + np.array([begins, shifts])
    return tuple(
        Block(block, shift, lines[:, number]) for number, (block, shift) in enumerate(zip(blocks, shifts, strict=True))
    )


def _lines(corners: Sequence[Points], directions: Sequence[Vector]) -> list[list[int]]:
    """Numbers of the blocks on each line, the largest first."""
    lines: list[list[int]] = []
    for number, (points, axis) in enumerate(zip(corners, directions, strict=True)):
        across = _across(axis)
        own = _flat_hull(points, across)
        joined, others = [number], list[list[int]]()
        for line in lines:
            parallel = abs(directions[line[0]] @ axis) > _PARALLEL
            near = (corners[k] for k in line if parallel and _may_overlap(points, corners[k], across))
            if any(_overlap(own, _flat_hull(other, across)) for other in near):
                joined += line
            else:
                others.append(line)
        lines = [*others, sorted(joined)]
    return sorted(lines)


def _beside(shifts: Points, axis: Vector) -> BoolArray:
    """Which shifts are along an axis."""
    return np.asarray(np.linalg.norm(shifts - np.outer(shifts @ axis, axis), axis=1) < _TOUCH)


def _blocks(assembly: AssemblyUnit, pieces: Sequence[AssembledPiece]) -> list[tuple[AssembledPiece, ...]]:
    inner = {body.id for own in assembly.assemblies for body in own.all_bodies}
    rows = Counter((piece.body.id, piece.part.id) for piece in pieces)
    blocks: dict[tuple[int, ...], list[AssembledPiece]] = {}
    for number, piece in enumerate(pieces):
        if piece.body.id in inner:
            blocks.setdefault((piece.item,), []).append(piece)
        elif rows[piece.body.id, piece.part.id] <= SHOWN or not piece.row:
            blocks[piece.item, number] = [piece]
    return [tuple(block) for block in blocks.values()]


def _box(pieces: Sequence[AssembledPiece]) -> Box:
    every = np.concatenate([piece.position.points(box_corners(*shape_box(_shape(piece)))) for piece in pieces])
    return np.array([every.min(0), every.max(0)])


def _hull_corners(pieces: Sequence[AssembledPiece]) -> Points:
    """Corners of the convex hull of pieces [m]."""
    points = np.concatenate([piece.position.points(_corners(_shape(piece))) for piece in pieces])
    return points if len(pieces) == 1 else np.asarray(points[ConvexHull(points).vertices])


def _diagonal(box: Box) -> float:
    return float(np.linalg.norm(box[1] - box[0]))


def _axis(block: Sequence[AssembledPiece], axes: Mapping[str, Vector]) -> Vector:
    """The direction in which a block is taken out, in the axes of the tree."""
    piece = block[0]
    if len(block) > 1 and piece.body.joint.kind is not JointKind.FIXED:
        return piece.axis
    alone = sum(len(own.positions) for own in piece.body.occurrences) == 1
    if piece.part.id not in axes and alone and piece.body.joint.kind is not JointKind.FIXED:
        return piece.axis
    return np.asarray(piece.position.rotation @ seat_axis(piece.part, axes))


def _carrier(box: Box, standing: Float[np.ndarray, "n 2 3"]) -> int:
    """Number of the box that has most in common with a box and a rim about it."""
    rim = _RIM * _diagonal(box)
    common = np.minimum(box[1] + rim, standing[:, 1]) - np.maximum(box[0] - rim, standing[:, 0])
    return int(np.prod(np.maximum(common, 0.0), axis=1).argmax())


def _least_shift(
    points: Points, standing: Sequence[Points], axis: Vector, gap: float, sides: Sequence[FloatArray]
) -> float:
    """The least shift of points along an axis at which they are clear of others by a gap [m].

    sides  on which of each of the others they have to be along the axis: +1 beyond, -1 before, 0 either; with the last
           there always is a shift, that with the first is taken where there is one
    """
    across = _across(axis)
    own, height = _flat_hull(points, across), points @ axis
    beside = (number for number, other in enumerate(standing) if _may_overlap(points, other, across))
    behind = [number for number in beside if _overlap(own, _flat_hull(standing[number], across))]
    low = np.array([(standing[k] @ axis).min() - gap - height.max() for k in behind])
    high = np.array([(standing[k] @ axis).max() + gap - height.min() for k in behind])
    shifts = np.concatenate([[0.0], low, high])
    clear = ~((shifts[:, None] > low + _TOUCH) & (shifts[:, None] < high - _TOUCH)).any(1)
    for side in (choice[behind] for choice in sides):
        allowed = clear & (side * (shifts[:, None] - np.where(side > 0, high, low)) > -_TOUCH).all(1)
        if allowed.any():
            return float(min(shifts[allowed], key=abs))
    return float(min(shifts[clear], key=abs))


def _across(axis: Vector) -> Float[np.ndarray, "2 3"]:
    """Two directions across an axis."""
    return np.asarray(np.linalg.svd(axis[None])[2][1:])


def _flat_hull(points: Points, across: Float[np.ndarray, "2 3"]) -> ComplexArray:
    flat = points @ across.T
    return hull(flat[:, 0] + 1j * flat[:, 1])


def _may_overlap(points: Points, other: Points, across: Float[np.ndarray, "2 3"]) -> bool:
    """Whether the boxes of points have something in common, across an axis: a quick look before their hulls."""
    own, its = points @ across.T, other @ across.T
    return bool(((own.min(0) < its.max(0)) & (its.min(0) < own.max(0))).all())


def _overlap(polygon: ComplexArray, other: ComplexArray) -> bool:
    """Whether two convex polygons have more in common than a touch: no side of either separates them."""
    sides = np.concatenate([np.roll(own, -1) - own for own in (polygon, other)])
    sides = sides[np.abs(sides) > 1e-9]
    outward = (sides / np.abs(sides))[:, None] * 1j
    own, its = ((outward.conj() * points).real for points in (polygon, other))
    return not bool(((own.max(1) < its.min(1) + _TOUCH) | (its.max(1) < own.min(1) + _TOUCH)).any())


def _shape(piece: AssembledPiece) -> Shape:
    assert piece.part.shape is not None
    return piece.part.shape


@lru_cache(maxsize=512)
def _corners(shape: Shape) -> Points:
    """Corners of the convex hull of a shape [m]."""
    points = shape.mesh(_DEVIATION).points
    return np.asarray(points[ConvexHull(points).vertices])
