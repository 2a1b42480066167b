"""Plane faces on which parts are screwed to each other: where a screw has room on them, and how deep a part is there.

A screw has room at a point of a face that is farther from all its edges than a distance. Faces are those of prisms, of
prisms in sums, and the ends of turned shapes, which take one screw in their axis.
"""

import math
from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from ilmek.arrays import BoolArray, ComplexArray, Float, FloatArray
from ilmek.part.placement import IDENTITY, Placement
from ilmek.part.shapes import Prism, Shape, Sum, Turned
from ilmek.plane.contours import STRAIGHT, along, bounds
from ilmek.plane.vectors import following
from ilmek.records import record
from ilmek.units import mm

_CHORD = 0.05 * mm
"""Deviation of the polygons of contours [m]."""

_LEAST = 4 * mm
"""Least width of a side that is screwed [m]; assumed by this project."""

_REACH = 4.0
"""Length of a hollow over its width up to which a key reaches what is in it; assumed by this project."""

_SIDES = 40
"""Corners of an outline up to which its sides are looked at: others are curves."""

_ROUNDING = 1e-7
"""Length that counts as rounding [m]."""


@record
class SeatFace:
    """A plane face of a shape.

    position  of its frame in the shape's axes: z out of the material, x and y in the face
    low, high  of a box about it in its frame [m]       loops  polygons of its outline and its holes
    member   number of the member of a sum that it is of; -1: of the shape itself
    depth    of the material below all of it [m]; 0: it is a side of a prism, by its section
    turned   the end of a turned shape: in its middle is the only room
    """

    position: Placement
    low: complex
    high: complex
    loops: tuple[ComplexArray, ...]
    member: int
    depth: float
    turned: bool = False

    @property
    def up(self) -> int:
        """Of its normal the z in the shape's axes: -1 and 1 of its ends, 0 of its sides."""
        return round(float(self.position.rotation[2, 2]))

    def room(self, points: ComplexArray, most: float) -> FloatArray:
        """Distance of points of the face from its edges [m], at most so far; below 0 outside."""
        room = np.full(len(points), most)
        inside = np.zeros(len(points), bool)
        for loop in self.loops:
            start = loop[:, None]
            side = following(loop)[:, None] - start
            away = points - start
            share = np.clip((np.conj(side) * away).real / np.abs(side) ** 2, 0.0, 1.0)
            room = np.minimum(room, np.abs(away - share * side).min(0))
            inside ^= crossed(loop, points)
        return np.where(inside, room, -room)


def crossed(loop: ComplexArray, points: ComplexArray) -> BoolArray:
    """Whether a line from each point to the right crosses a polygon an odd number of times."""
    start, end = loop[:, None], following(loop)[:, None]
    over = (start.imag > points.imag) != (end.imag > points.imag)
    rise = np.where(over, end.imag - start.imag, 1.0)
    right = points.real < start.real + (points.imag - start.imag) / rise * (end.real - start.real)
    return np.asarray((over & right).sum(0) % 2 == 1)


@lru_cache(maxsize=4096)
def seat_faces(shape: Shape) -> tuple[SeatFace, ...]:
    """The plane faces of a shape that can be screwed."""
    if isinstance(shape, Turned):
        return tuple(_ends(shape))
    if isinstance(shape, Prism):
        return tuple(_of_prism(shape, IDENTITY, -1))
    if isinstance(shape, Sum):
        single = ((number, own) for number, own in enumerate(shape.members) if len(own.positions) == 1)
        return tuple(
            face
            for number, own in single
            if isinstance(own.shape, Prism)
            for face in _of_prism(own.shape, own.positions[0], number)
        )
    return ()


_UPSIDE_DOWN = np.diag([1.0, -1.0, -1.0])


def _ends(shape: Turned) -> Iterator[SeatFace]:
    """The ends that are full discs about the axis."""
    points = shape.profile.outline.points
    low, high = float(points.real.min()), float(points.real.max())
    for z, rotation in ((low, _UPSIDE_DOWN), (high, np.eye(3))):
        at_end = points.imag[np.abs(points.real - z) < _ROUNDING]
        if len(at_end) and at_end.min() < _ROUNDING < at_end.max():
            radius = float(at_end.max())
            disc = radius * np.exp(2j * np.pi * np.arange(24) / 24)
            corner = radius * (1 + 1j)
            yield SeatFace(Placement(np.array([0, 0, z]), rotation), -corner, corner, (disc,), -1, high - low, True)


def _of_prism(shape: Prism, position: Placement, member: int) -> Iterator[SeatFace]:
    section, length = shape.section, shape.length
    loops = tuple(along(contour, _CHORD) for contour in section.contours)
    low, high = bounds(section.outline)
    below = tuple(np.conj(loop) for loop in loops)
    ends = (
        (0.0, _UPSIDE_DOWN, below, complex(low.real, -high.imag), complex(high.real, -low.imag)),
        (length, np.eye(3), loops, low, high),
    )
    for z, rotation, own, least, most in ends:
        yield SeatFace(position.after(Placement(np.array([0, 0, z]), rotation)), least, most, own, member, length)
    outline = section.contours[0]
    if section.smooth or len(outline.points) > _SIDES or length < _LEAST:
        return
    for start, end, bulge in zip(outline.points, following(outline.points), outline.bulges, strict=True):
        wide = abs(end - start)
        if abs(bulge) < STRAIGHT and wide > _LEAST:
            ahead = (end - start) / wide
            out = -1j * ahead
            axes = np.array([[ahead.real, 0.0, out.real], [ahead.imag, 0.0, out.imag], [0.0, 1.0, 0.0]])
            lies = position.after(Placement(np.array([start.real, start.imag, 0.0]), axes))
            corner = complex(wide, length)
            sides = np.array([0j, complex(wide), corner, complex(0.0, length)])
            yield SeatFace(lies, 0j, corner, (sides,), member, 0.0)


@record
class Depth:
    """Of a hole from a point of a face: its length in the material [m], whether it ends at a plane face, how far it is
    in the open behind that, and the thickness of the wall that ends this hollow; 0: none [m].
    """

    length: float
    flat: bool
    free: float
    wall: float = 0.0


def depth_below(shape: Shape, face: SeatFace, point: complex, radius: float) -> Depth:
    """How deep a hole of a radius is from a point of a face until it leaves the material.

    >>> from ilmek.part.shapes import square_tube
    >>> tube = square_tube(0.04, 0.003, 1.0)
    >>> wall = depth_below(tube, seat_faces(tube)[2], 0.02 + 0.5j, 0.002)
    >>> round(wall.length, 9), wall.flat, wall.free
    (0.003, True, 0.0)
    """
    if face.depth:
        return Depth(face.depth, True, math.inf)
    prism, back = prism_of(shape, face.member)
    lies = back.after(face.position)
    ahead, inwards = (complex(*lies.rotation[:2, k]) for k in (0, 2))
    inwards = -inwards
    mouth = complex(*lies.points(np.array([point.real, point.imag, 0.0]))[:2])
    lines = [_crossings(prism, mouth + aside * ahead, inwards) for aside in (-radius, 0.0, radius)]
    if not all(len(line) for line in lines):
        return Depth(0.0, False, 0.0)
    first = [float(line[0, 0]) for line in lines]
    free = min((float(line[1, 0] - line[0, 0]) if len(line) > 1 else math.inf) for line in lines)
    if any(line[0, 1] for line in lines) and prism.length > _REACH * free:
        free = 0.0
    wall = max((float(line[2, 0] - line[1, 0]) if len(line) > 2 else 0.0) for line in lines)
    return Depth(min(first), max(first) - min(first) < _ROUNDING, free, wall)


def prism_of(shape: Shape, member: int) -> tuple[Prism, Placement]:
    """The prism of a shape by the number of its member, and the position of the shape in the axes of that."""
    if isinstance(shape, Sum):
        own = shape.members[member]
        assert isinstance(own.shape, Prism)
        return own.shape, own.positions[0].inverse
    assert isinstance(shape, Prism)
    return shape, IDENTITY


def _crossings(prism: Prism, begin: complex, inwards: complex) -> Float[np.ndarray, "n 2"]:
    """Distances at which a line into a section crosses its contours [m], ascending, and numbers of these."""
    starts, ends, numbers = _pieces(prism)
    first, last = (starts - begin) / inwards, (ends - begin) / inwards
    over = np.flatnonzero((first.imag > 0) != (last.imag > 0))
    start, end = first[over], last[over]
    there = start.real - start.imag / (end.imag - start.imag) * (end.real - start.real)
    every = np.column_stack([there, numbers[over]])[there > 10 * _ROUNDING]
    return np.asarray(every[np.argsort(every[:, 0])])


@lru_cache(maxsize=1024)
def _pieces(prism: Prism) -> tuple[ComplexArray, ComplexArray, FloatArray]:
    """Starts and ends of the straight pieces of a section's polygons [m], and numbers of their contours."""
    loops = [along(contour, _CHORD) for contour in prism.section.contours]
    numbers = np.repeat(np.arange(len(loops), dtype=float), [len(loop) for loop in loops])
    return np.concatenate(loops), np.concatenate([following(loop) for loop in loops]), numbers
