"""An assembly taken apart: how far each piece is moved out along the axis by which it is joined.

The largest block, by the diagonal of its box, stays. Each further one, the larger first, is moved with that in which it
lies, and from there along its axis by the least distance at which it is clear by a gap of all whose convex hulls, seen
along the axis, have room in common with its own.

axis of a piece  that of the bore or journal by which it meets another [`meetings`]; else of its body's joint, where it
                 is the only part; else of a turned or bought part its own z, of any other the direction in which it
                 is thinnest
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from functools import lru_cache

import numpy as np
from scipy.spatial import ConvexHull

from ilmek.arrays import ComplexArray, Float
from ilmek.part.assemblies import AssembledPiece, AssemblyUnit
from ilmek.part.meetings import meetings
from ilmek.part.shapes import Shape, Turned, box_corners, shape_box
from ilmek.part.tree import JointKind, Tree
from ilmek.plane.curves import hull
from ilmek.records import record
from ilmek.units import mm

GAP, SEEN = 0.02, 0.3
"""Least distance of a block from others: of the diagonal of the box about all, and of its second longest side."""

SHOWN = 16
"""Pieces of a part in a body that are shown; of more the first stands for all."""

_TOUCH, _RIM, _DEVIATION = 0.1 * mm, 0.05, 0.2 * mm
"""Depth within which what lies beside each other does not overlap [m]; rim about a box, of its diagonal; deviation of
the hulls [m].
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
    axes = _part_axes(tree)
    blocks = sorted(_blocks(assembly, pieces), key=lambda block: -_diagonal(_box(block)))
    boxes = np.array([_box(block) for block in blocks])
    corners = [_hull_corners(block) for block in blocks]
    whole = _diagonal(np.array([boxes[:, 0].min(0), boxes[:, 1].max(0)]))
    gaps = GAP * whole + SEEN * np.sort(boxes[:, 1] - boxes[:, 0], axis=1)[:, 1]
    begins, shifts = np.zeros((2, len(blocks), 3))
    for number, block in enumerate(blocks[1:], 1):
        begin = begins[number] = shifts[_carrier(boxes[number], boxes[:number])]
        axis = _axis(block, axes)
        standing = [own + shift for own, shift in zip(corners[:number], shifts[:number], strict=True)]
        shifts[number] = begin + _least_shift(corners[number] + begin, standing, axis, float(gaps[number])) * axis
    lines = boxes.mean(1) + np.array([begins, shifts])
    return tuple(
        Block(block, shift, lines[:, number]) for number, (block, shift) in enumerate(zip(blocks, shifts, strict=True))
    )


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


def _part_axes(tree: Tree) -> dict[str, Vector]:
    """By the id of a part its axis in its own frame: of the longest bore or journal by which it meets another."""
    longest: dict[str, tuple[float, Vector]] = {}
    for meeting in meetings(tree):
        for seat in (meeting.bore, meeting.inner):
            length = min(meeting.bore.feature.length, meeting.inner.feature.length)
            if length > longest.get(seat.part.id, (0.0, None))[0]:
                longest[seat.part.id] = length, seat.feature.position.rotation[:, 2]
    return {name: axis for name, (_, axis) in longest.items()}


def _axis(block: Sequence[AssembledPiece], axes: Mapping[str, Vector]) -> Vector:
    """The direction in which a block is taken out, in the axes of the tree."""
    piece = block[0]
    if len(block) > 1 and piece.body.joint.kind is not JointKind.FIXED:
        return piece.axis
    if piece.part.id in axes:
        return np.asarray(piece.position.rotation @ axes[piece.part.id])
    if sum(len(own.positions) for own in piece.body.occurrences) == 1 and piece.body.joint.kind is not JointKind.FIXED:
        return piece.axis
    if isinstance(piece.part.shape, Turned) or piece.part.purchase is not None:
        return piece.position.rotation[:, 2]
    low, high = shape_box(_shape(piece))
    return piece.position.rotation[:, int((high - low).argmin())]


def _carrier(box: Box, standing: Float[np.ndarray, "n 2 3"]) -> int:
    """Number of the box that has most in common with a box and a rim about it."""
    rim = _RIM * _diagonal(box)
    common = np.minimum(box[1] + rim, standing[:, 1]) - np.maximum(box[0] - rim, standing[:, 0])
    return int(np.prod(np.maximum(common, 0.0), axis=1).argmax())


def _least_shift(points: Points, standing: Sequence[Points], axis: Vector, gap: float) -> float:
    """The least shift of points along an axis, to either side, at which they are clear of others by a gap [m]."""
    across = np.linalg.svd(axis[None])[2][1:]
    own, height = _flat_hull(points, across), points @ axis
    behind = [other for other in standing if _overlap(own, _flat_hull(other, across))]
    low = np.array([(other @ axis).min() - gap - height.max() for other in behind])
    high = np.array([(other @ axis).max() + gap - height.min() for other in behind])
    shifts = np.concatenate([[0.0], low, high])
    clear = ~((shifts[:, None] > low + _TOUCH) & (shifts[:, None] < high - _TOUCH)).any(1)
    return float(min(shifts[clear], key=abs))


def _flat_hull(points: Points, across: Float[np.ndarray, "2 3"]) -> ComplexArray:
    flat = points @ across.T
    return hull(flat[:, 0] + 1j * flat[:, 1])


def _overlap(polygon: ComplexArray, other: ComplexArray) -> bool:
    """Whether two convex polygons have more in common than a touch: no side of either separates them."""
    sides = np.concatenate([np.roll(own, -1) - own for own in (polygon, other)])
    outward = (sides / np.maximum(np.abs(sides), 1e-12))[:, None] * 1j
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
