"""Features of a shape in the part's own axes: of size, its cylinders with their keyways and its squares; plane faces.

They are read from the shape: the straight lines along z of a turned profile; circles, circles with keyways, and squares
among the contours of a prism's section; of a sum those of its members. Arcs that are no whole circle are none.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ilmek.arrays import Float
from ilmek.elements.keyways import Keyway, keyway_for
from ilmek.errors import ParameterError
from ilmek.part.placement import IDENTITY, Placement, placement
from ilmek.part.shapes import Drilling, Prism, Shape, Sum, Turned
from ilmek.plane.contours import STRAIGHT, KeyedCircle, as_hole, as_keyed, bounds, counter_clockwise
from ilmek.plane.vectors import dot, following
from ilmek.records import record
from ilmek.report import Contour

_LEAST = 1e-6
"""Radius and length below which a line of a profile is no cylinder [m]; also their rounding."""


@record
class FeatureOfSize:
    """A cylinder, or the four sides of a square.

    position  where it begins, z along its axis into it, x towards its keyway or through a side of a square
    size      diameter, or width across flats [m]        length  [m]
    inside    it is a bore; else its material is inside
    keyway    by DIN 6885 that opens along x; None: none        others  angles of further keyways from x [rad]
    square    it has four sides
    """

    position: Placement
    size: float
    length: float
    inside: bool
    keyway: Keyway | None = None
    others: tuple[float, ...] = ()
    square: bool = False

    def placed(self, position: Placement) -> "FeatureOfSize":
        """The feature of a part at a position."""
        return FeatureOfSize(
            position.after(self.position), self.size, self.length, self.inside, self.keyway, self.others, self.square
        )


def features_of_size(shape: Shape, position: Placement = IDENTITY) -> tuple[FeatureOfSize, ...]:
    """The features of a shape that lies at a position.

    >>> from ilmek.part.shapes import tube
    >>> [(round(one.size, 9), one.inside) for one in features_of_size(tube(0.02, 0.005, 0.1))]
    [(0.01, True), (0.02, False)]
    """
    return tuple(feature.placed(position) for feature in _features(shape))


def _features(shape: Shape) -> Iterator[FeatureOfSize]:
    if isinstance(shape, Turned):
        yield from _turned(shape)
    elif isinstance(shape, Prism):
        outer = () if shape.section.smooth else (shape.section.outline,)
        yield from (size for contour in outer for size in _of_contour(contour, shape.length, inside=False))
        yield from (size for contour in shape.section.holes for size in _of_contour(contour, shape.length, inside=True))
        for hole in shape.drilled:
            walls = (own for own in _turned(hole.shape) if not own.inside)
            yield from (replace(own, inside=True).placed(hole.position) for own in walls)
    elif isinstance(shape, Sum):
        for member in shape.members:
            own = tuple(_features(member.shape))
            yield from (feature.placed(position) for position in member.positions for feature in own)


def _turned(shape: Turned) -> Iterator[FeatureOfSize]:
    for contour in shape.profile.contours:
        for start, end, bulge in zip(contour.points, following(contour.points), contour.bulges, strict=True):
            along, radius = float(end.real - start.real), float(start.imag)
            level = abs(end.imag - radius) < _LEAST and abs(bulge) < STRAIGHT
            if level and radius > _LEAST and abs(along) > _LEAST:
                begin = placement(z=float(min(start.real, end.real)))
                yield FeatureOfSize(begin, 2 * radius, abs(along), along > 0)  # the profile lies to the left


def _of_contour(contour: Contour, length: float, *, inside: bool) -> Iterator[FeatureOfSize]:
    hole, keyed = as_hole(contour), as_keyed(contour)
    if hole is not None:
        yield FeatureOfSize(placement(hole.at.real, hole.at.imag), 2 * hole.radius, length, inside)
    elif keyed is not None:
        keyway = _standard(keyed, inside=inside)
        first, *others = np.angle(keyed.directions).tolist()
        lies = placement(keyed.centre.real, keyed.centre.imag, about=_Z, angle=first)
        turned = tuple(angle - first for angle in others)
        yield FeatureOfSize(lies, 2 * keyed.radius, length, inside, keyway, turned if keyway else ())
    elif _is_square(contour):
        points = counter_clockwise(contour).points
        middle, side = complex(points.mean()), complex(points[1] - points[0])
        lies = placement(middle.real, middle.imag, about=_Z, angle=float(np.angle(side)))
        yield FeatureOfSize(lies, abs(side), length, inside, square=True)


_X, _Z = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)


def _standard(keyed: KeyedCircle, *, inside: bool) -> Keyway | None:
    """The row of DIN 6885 of a keyway; None: it is no keyway of it."""
    try:
        row = keyway_for(2 * keyed.radius)
    except ParameterError:
        return None
    floor = keyed.radius + (row.in_hub if inside else -row.in_shaft)
    # A groove's floor in the contour is a chord of the shaft's or bore's depth.
    return row if abs(keyed.width - row.width) + abs(keyed.floor - floor) < _LEAST else None


def _is_square(contour: Contour) -> bool:
    if len(contour.points) != 4 or np.any(np.abs(contour.bulges) >= STRAIGHT):
        return False
    sides = following(contour.points) - contour.points
    even = np.ptp(np.abs(sides)) < _LEAST
    return bool(even and np.max(np.abs(dot(sides, following(sides)))) < _LEAST * np.abs(sides[0]))


def drillings(shape: object) -> tuple[Drilling, ...]:
    """The drilled holes of a shape, in its axes; those of its sections are not among them."""
    if isinstance(shape, Prism):
        return shape.drilled
    if isinstance(shape, Sum):
        return tuple(
            replace(hole, position=member.positions[0].after(hole.position))
            for member in shape.members
            for hole in drillings(member.shape)
        )
    return ()


def round_holes(shape: object) -> tuple[Drilling, ...]:
    """All round holes of a prism: drilled ones, a counterbore with the hole that it is round, and through the section.

    Those of the section have their mouth at the prism's length; of other shapes only the drilled ones.

    >>> from ilmek.part.shapes import tube
    >>> round_holes(tube(0.02, 0.005, 0.1))
    ()
    """
    if not isinstance(shape, Prism):
        return drillings(shape)
    drilled = tuple(
        replace(hole, steps=(*hole.steps, (hole.bore, shape.length - hole.steps[0][1])), through=True)
        if hole.bore
        else hole
        for hole in shape.drilled
    )
    sunk = [complex(*hole.position.origin[:2]) for hole in shape.drilled if hole.bore]
    plain = (hole for hole in map(as_hole, shape.section.holes) if hole is not None)
    return *drilled, *(
        Drilling(
            placement(hole.at.real, hole.at.imag, shape.length, about=_X, angle=np.pi),
            ((2 * hole.radius, shape.length),),
            through=True,
        )
        for hole in plain
        if all(abs(hole.at - own) > _LEAST for own in sunk)
    )


@record
class PlaneFace:
    """A plane face: the corners of a rectangle about it [m], and its normal, out of the material."""

    corners: Float[np.ndarray, "4 3"]
    normal: Float[np.ndarray, " 3"]


def faces_of(shape: Shape, position: Placement = IDENTITY) -> Iterator[PlaneFace]:
    """The plane faces of the prisms of a shape that lies at a position: their ends, and straight pieces of outlines."""
    if isinstance(shape, Sum):
        for member in shape.members:
            for own in member.positions:
                yield from faces_of(member.shape, position.after(own))
    elif isinstance(shape, Prism):
        outline, length = counter_clockwise(shape.section.outline), shape.length
        low, high = bounds(outline)
        around = [low, complex(high.real, low.imag), high, complex(low.real, high.imag)]
        for z, sense in ((0.0, -1.0), (length, 1.0)):
            corners = np.array([[one.real, one.imag, z] for one in around])
            yield PlaneFace(position.points(corners), position.rotation @ np.array([0.0, 0.0, sense]))
        for start, end, bulge in zip(outline.points, following(outline.points), outline.bulges, strict=True):
            if abs(bulge) < STRAIGHT and not shape.section.smooth:
                out = -1j * (end - start) / abs(end - start)
                ends = [(start, 0.0), (end, 0.0), (end, length), (start, length)]
                corners = np.array([[one.real, one.imag, z] for one, z in ends])
                yield PlaneFace(position.points(corners), position.rotation @ np.array([out.real, out.imag, 0.0]))
