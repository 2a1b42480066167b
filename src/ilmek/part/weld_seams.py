"""Where the edges of a contact of two pieces are welded, and how.

Just inside of an edge both faces lie on each other. A leg of the weld outside of it goes on

    one of them      a fillet stands on that one
    neither          both end there: the edge of one is bevelled through its wall, and the groove is filled
    both             it is no edge                                          [ISO 2553; ISO 9692-1, 3.3 and 1.9.1]

So a tube that ends over an open end of another has no seam across that opening.
"""

from collections.abc import Iterator, Sequence
from itertools import groupby

import numpy as np

from ilmek.arrays import BoolArray, ComplexArray, Float, FloatArray, Int
from ilmek.part.placement import Placement
from ilmek.part.seat_faces import crossed, seat_faces
from ilmek.part.shapes import Shape, box_corners, shape_box
from ilmek.plane.vectors import following
from ilmek.records import record
from ilmek.units import mm

PlacedPiece = tuple[Shape, Placement]
Loops = tuple[ComplexArray, ...]

_INSIDE, _LEVEL = 0.05 * mm, 0.15 * mm
"""From an edge to the points at which the faces are looked at, and distance of faces that touch [m]."""


@record
class WeldSeam:
    """A straight seam: begin and end [m], whether the edge is bevelled, and whether it is a whole side."""

    ends: Float[np.ndarray, "2 3"]
    bevel: bool
    whole: bool

    @property
    def length(self) -> float:
        """Its length [m]."""
        return float(np.linalg.norm(self.ends[1] - self.ends[0]))


def sides_of(box: Float[np.ndarray, "2 3"]) -> Float[np.ndarray, "4 2 3"]:
    """The sides of a flat box, both long ones first."""
    thin, across, along = np.argsort(np.ptp(box, axis=0), kind="stable")
    corners = np.repeat(box[:1], 4, axis=0)
    corners[:, thin] = box[:, thin].mean()
    corners[1:3, along], corners[2:, across] = box[1, along], box[1, across]
    return np.asarray(corners[[[0, 1], [3, 2], [0, 3], [1, 2]]])


@record
class FlatContact:
    """Faces of two pieces that lie on each other, in the axes of one.

    box    about what both cover [m]      axes  the two in the plane      faces  loops of the faces of each piece there
    """

    box: Float[np.ndarray, "2 3"]
    axes: tuple[int, int]
    faces: tuple[tuple[Loops, ...], tuple[Loops, ...]]


def flat_contact(box: Float[np.ndarray, "2 3"], pieces: tuple[PlacedPiece, PlacedPiece]) -> FlatContact:
    """The contact of two pieces, shapes with their positions, in the flat box that the boxes about them share."""
    thin = int(np.argmin(np.ptp(box, axis=0)))
    first, second = (axis for axis in range(3) if axis != thin)
    faces = tuple(tuple(_faces(*piece, thin, float(box[:, thin].mean()))) for piece in pieces)
    covered = box.copy()
    for own in faces:
        points = np.concatenate([loops[0] for loops in own])
        for axis, values in ((first, points.real), (second, points.imag)):
            covered[:, axis] = max(covered[0, axis], values.min()), min(covered[1, axis], values.max())
    return FlatContact(covered, (first, second), (faces[0], faces[1]))


def weld_seams(contact: FlatContact, leg: float, least: float, *, number: int = 4) -> Iterator[WeldSeam]:
    """The seams along the sides of the box of a contact, all or only both long ones.

    leg  of a fillet [m]      least  length of a seam [m]
    """
    box, axes, faces = contact.box, contact.axes, contact.faces
    for side in sides_of(box)[:number]:
        (start, end), middle = _plane(side, axes).tolist(), complex(*box.mean(axis=0)[[*axes]])
        ahead = end - start
        if abs(ahead) < least:
            continue
        out = 1j * ahead / abs(ahead)
        out *= np.sign(((start - middle) * np.conj(out)).real)
        inside, beyond = start - _INSIDE * out, start + leg * out
        crossed_at = (cut for face in faces for begin in (inside, beyond) for cut in _cuts(begin, ahead, face))
        cuts = np.unique([0.0, 1.0, *crossed_at])
        shares = (cuts[1:] + cuts[:-1]) / 2 * ahead
        on, past = ([_covered(face, begin + shares) for face in faces] for begin in (inside, beyond))
        kinds = np.select([~(on[0] & on[1]), past[0] & past[1], past[0] | past[1]], [_OFF, _WITHIN, _FILLET], _BEVEL)
        for kind, low, high in _runs(kinds, cuts, 2 * leg / abs(ahead)):
            if kind in {_FILLET, _BEVEL} and (high - low) * abs(ahead) > least:
                ends = side[0] + np.array([[low], [high]]) * (side[1] - side[0])
                yield WeldSeam(ends, kind == _BEVEL, low < _SHARE and high > 1 - _SHARE)


_OFF, _WITHIN, _FILLET, _BEVEL = range(4)
"""What a side is along a part of it: off the contact, within both faces, the edge of one, the edge of both."""


def _runs(kinds: Int[np.ndarray, " n"], cuts: FloatArray, short: float) -> Iterator[tuple[int, float, float]]:
    """Parts of a side of one kind, with where they begin and end; at a slanting edge a short one is as what is next."""
    for off, group in groupby(range(len(kinds)), key=lambda k: kinds[k] == _OFF):
        own = [] if off else list(group)
        long = [k for k in own if cuts[k + 1] - cuts[k] > short] or own
        begins = [own[0], *long[1:], own[-1] + 1] if own else []
        for kind, run in groupby(range(len(long)), key=lambda k: int(kinds[long[k]])):
            parts = list(run)
            yield kind, float(cuts[begins[parts[0]]]), float(cuts[begins[parts[-1] + 1]])


_SHARE = 1e-3
"""Of a side that a seam may leave free and yet be whole."""


def _plane(points: Float[np.ndarray, "n 3"], axes: Sequence[int]) -> ComplexArray:
    return np.asarray(points[:, axes[0]] + 1j * points[:, axes[1]])


def _faces(shape: Shape, position: Placement, thin: int, level: float) -> Iterator[Loops]:
    """The faces of a piece in a plane across an axis, in the other two axes; else the box about the piece."""
    axes, none = [axis for axis in range(3) if axis != thin], True
    for face in seat_faces(shape):
        frame = position.after(face.position)
        across = not face.turned and abs(frame.rotation[thin, 2]) > 1 - _ROUNDING
        if across and abs(frame.origin[thin] - level) < _LEVEL:
            none = False
            flat = (np.stack([loop.real, loop.imag, np.zeros(len(loop))], axis=1) for loop in face.loops)
            yield tuple(_plane(frame.points(points), axes) for points in flat)
    if none:
        points = _plane(position.points(box_corners(*shape_box(shape))), axes)
        low, high = complex(points.real.min(), points.imag.min()), complex(points.real.max(), points.imag.max())
        yield (np.array([low, complex(high.real, low.imag), high, complex(low.real, high.imag)]),)


_ROUNDING = 1e-9


def _covered(faces: Sequence[Loops], points: ComplexArray) -> BoolArray:
    """Which points are on any of some faces."""
    on = np.zeros(len(points), bool)
    for loops in faces:
        inside = np.zeros(len(points), bool)
        for loop in loops:
            inside ^= crossed(loop, points)
        on |= inside
    return on


def _cuts(start: complex, ahead: complex, faces: Sequence[Loops]) -> Iterator[float]:
    """Where a line crosses the edges of faces, of its length."""
    for loop in (loop for loops in faces for loop in loops):
        points = (loop - start) / ahead
        after = following(points)
        over = (points.imag > 0) != (after.imag > 0)
        share = points.imag[over] / (points.imag[over] - after.imag[over])
        crossings = points.real[over] + share * (after.real[over] - points.real[over])
        yield from crossings[(crossings > 0) & (crossings < 1)].tolist()
