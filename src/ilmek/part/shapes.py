"""Shapes of parts by features, exact, each in the part's own axes; prisms, turned shapes, and sums of shapes.

    prism    a section in x and y from z = 0 to its length: a plate, a bar or tube of stock cut to length, a box; less
             what is drilled out of it: blind holes, counterbores, holes across
    turned   the profile (z, r) turned about the z axis: shafts, rollers, pins, cylinders, cones
    sum      shapes at positions that touch and do not overlap: weldments, patterns

Moments are exact (`section`, `moments`): of a prism with the moments M of its section and its length L

    V = L M00,   f = L (M10, M01, L M00 / 2),   Sxx = L M20,  Sxy = L M11,  Sxz = L² M10 / 2,  Szz = L³ M00 / 3

and of a turned shape with those of its profile, x -> z and y -> r      [Pappus; derived]

    V = 2 pi M01,   fz = 2 pi M11,   Sxx = Syy = pi M03,   Szz = 2 pi M21
"""

import math
from functools import lru_cache
from itertools import product
from typing import Protocol, TypeAlias

import numpy as np

from ilmek.arrays import ComplexArray, Float
from ilmek.errors import ParameterError
from ilmek.part.convex import Points, circumscribed, convex_pieces, frustums, prism_corners
from ilmek.part.mesh import extruded, joined, revolved, without
from ilmek.part.moments import Moments, together
from ilmek.part.placement import IDENTITY, Placement, placement
from ilmek.part.profile import Profile
from ilmek.plane.contours import along, bounds, circle, counter_clockwise, polygon
from ilmek.plane.solids import thinned
from ilmek.records import record
from ilmek.report import Contour
from ilmek.report.scene import Solid
from ilmek.units import format_quantity, mm, um

_ON_AXIS = 1e-9
"""Radius below 0 that counts as rounding [m]."""

ROUND = 3e-3
"""Deviation of the rings of a turned mesh over its radius, at most."""

_BOX_DEVIATION = 1 * mm
"""Of the convex pieces by which shapes of other kinds are boxed [m]."""

CHORD = 0.05 * mm
"""Deviation of meshes and convex pieces from the shape where none is given [m]."""


_shared = lru_cache(maxsize=1024)
"""A loom has the same boxes and tubes many times: each is made once, with its area and moments."""

Corner: TypeAlias = Float[np.ndarray, " 3"]


class Shape(Protocol):
    """What every shape answers, in the part's own axes."""

    def __hash__(self) -> int:
        """By identity, as of every record."""

    @property
    def volume(self) -> float:
        """Volume [m³]: the zeroth of the moments."""

    @property
    def moments(self) -> Moments:
        """Moments of its volume: exact."""

    def mesh(self, deviation: float = CHORD) -> Solid:
        """A closed surface of triangles, at most `deviation` [m] from the shape."""

    def pieces(self, deviation: float = CHORD) -> tuple[Points, ...]:
        """Corners of convex bodies that together contain the shape, and exceed it by `deviation` [m] at most beside the
        bores of turned shapes, which they fill. Of a smooth outline they lie within the deviation on both sides.
        """


@record
class Prism:
    """A section between z = 0 and its length [m], less holes that are apart from each other and within it.

    Raises ParameterError for a length that is not above 0.
    """

    section: Profile
    length: float
    drilled: tuple["Drilling", ...] = ()

    def __post_init__(self) -> None:
        _require_above_zero("a prism's length", self.length)

    @property
    def volume(self) -> float:
        """Volume [m³]."""
        return self.section.area * self.length - math.fsum(hole.shape.volume for hole in self.drilled)

    @property
    def moments(self) -> Moments:
        """Moments of its volume: exact."""
        m, length = self.section.moment, self.length
        xz, yz = length**2 / 2 * m(1, 0), length**2 / 2 * m(0, 1)
        xx, xy, yy, zz = length * m(2, 0), length * m(1, 1), length * m(0, 2), length**3 / 3 * m(0, 0)
        whole = Moments(
            length * m(0, 0),
            length * np.array([m(1, 0), m(0, 1), length / 2 * m(0, 0)]),
            np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]),
        )
        return whole + together(hole.shape.moments.placed(hole.position) for hole in self.drilled) * -1.0

    def mesh(self, deviation: float = CHORD) -> Solid:
        """A closed surface of triangles; arcs become chords inside of them."""
        fine = min(deviation, max(self.section.least_wall / 2, um))
        loops = (along(contour, fine) for contour in self.section.contours)
        whole = extruded([_fewer(loop, deviation) if self.section.smooth else loop for loop in loops], self.length)
        return without(whole, [hole.cutter(deviation) for hole in self.drilled]) if self.drilled else whole

    def pieces(self, deviation: float = CHORD) -> tuple[Points, ...]:
        """Prisms over convex pieces of the section; what is drilled is filled."""
        outline, *holes = self.section.contours
        around = circumscribed(outline, deviation)
        around = _fewer(around, deviation) if self.section.smooth else around
        pieces = convex_pieces(around, [along(hole, deviation) for hole in holes])
        return tuple(prism_corners(piece, self.length) for piece in pieces)


@record
class Drilling:
    """A round hole in steps, apart from others.

    position  of its mouth, z into the material      steps  diameter and length of each from there [m]
    bore      diameter of the hole of the section that it is round, as a counterbore is [m]; 0: none
    through   it ends in the open, too
    """

    position: Placement
    steps: tuple[tuple[float, float], ...]
    bore: float = 0.0
    through: bool = False

    @property
    def shape(self) -> "Turned":
        """What is taken away, in its own axes."""
        return _taken(self.steps, self.bore)

    def cutter(self, deviation: float) -> Solid:
        """A closed surface about what is taken away, and beyond it where it is open."""
        first, *others = ((diameter, float(length)) for diameter, length in self.steps)
        steps = [(first[0], first[1] + _OPEN), *others]
        if self.through:
            steps[-1] = (steps[-1][0], steps[-1][1] + _OPEN)
        solid = stepped(*steps).mesh(deviation)
        return Solid(self.position.after(placement(z=-_OPEN)).points(solid.points), solid.triangles)


_OPEN = 0.1 * mm
"""By how much a cutter begins and ends in the open [m]."""


@lru_cache(maxsize=256)
def _taken(steps: tuple[tuple[float, float], ...], bore: float) -> "Turned":
    diameter, length = steps[0]
    return tube(diameter, (diameter - bore) / 2, length) if bore else stepped(*steps)


@record
class Turned:
    """A profile in the half plane (z, r >= 0) turned about z. Raises ParameterError for a profile across the axis."""

    profile: Profile

    def __post_init__(self) -> None:
        inner = bounds(self.profile.outline)[0].imag
        if inner < -_ON_AXIS:
            raise ParameterError(
                f"a profile that reaches {format_quantity(-inner, 'mm')} across its axis", allowed="radii from 0"
            )

    @property
    def outer_radius(self) -> float:
        """Greatest radius [m]."""
        return bounds(self.profile.outline)[1].imag

    @property
    def volume(self) -> float:
        """Volume [m³]."""
        return 2 * math.pi * self.profile.moment(0, 1)

    @property
    def moments(self) -> Moments:
        """Moments of its volume: exact."""
        m = self.profile.moment
        across = math.pi * m(0, 3)
        along_z = 2 * math.pi * m(1, 1)
        return Moments(
            2 * math.pi * m(0, 1), np.array([0.0, 0.0, along_z]), np.diag([across, across, 2 * math.pi * m(2, 1)])
        )

    def mesh(self, deviation: float = CHORD) -> Solid:
        """A closed surface of triangles: chords of the profile, each ring of as many points as the largest needs.

        What is finer than the deviation, such as shallow slots, is left out; the rings are never so coarse.
        """
        loops = [_fewer(along(contour, deviation), deviation) for contour in self.profile.contours]
        return revolved(loops, min(deviation, ROUND * self.outer_radius))

    def pieces(self, deviation: float = CHORD) -> tuple[Points, ...]:
        """Frustums over the chords of the profile's outer line, from end to end along the axis."""
        return frustums(circumscribed(counter_clockwise(self.profile.outline), deviation), deviation)


@record
class Placed:
    """A shape at one or more positions."""

    shape: Shape
    positions: tuple[Placement, ...] = (IDENTITY,)


@record
class Sum:
    """Shapes that touch and do not overlap. Raises ParameterError where there are none."""

    members: tuple[Placed, ...]

    def __post_init__(self) -> None:
        if not self.members:
            raise ParameterError("a sum of no shapes", allowed="one or more")

    @property
    def volume(self) -> float:
        """Volume [m³]."""
        return math.fsum(len(member.positions) * member.shape.volume for member in self.members)

    @property
    def moments(self) -> Moments:
        """The sum of the moments of its members: those of each shape are computed once."""
        return together(
            moments.placed(position)
            for moments, positions in ((member.shape.moments, member.positions) for member in self.members)
            for position in positions
        )

    def mesh(self, deviation: float = CHORD) -> Solid:
        """The meshes of the members, side by side."""
        return joined(
            *(
                Solid(position.points(solid.points), solid.triangles)
                for solid, positions in ((member.shape.mesh(deviation), member.positions) for member in self.members)
                for position in positions
            )
        )

    def pieces(self, deviation: float = CHORD) -> tuple[Points, ...]:
        """The pieces of the members."""
        return tuple(
            position.points(piece)
            for pieces, positions in ((member.shape.pieces(deviation), member.positions) for member in self.members)
            for piece in pieces
            for position in positions
        )


def _fewer(loop: ComplexArray, deviation: float) -> ComplexArray:
    """The loop with fewer points, as `thinned`; all of them where it is thinner than the deviation."""
    few = thinned(loop, deviation)
    return few if len(few) > 2 else loop


def shape_box(shape: Shape) -> tuple[Corner, Corner]:
    """Least and greatest corner of a shape in its own axes [m].

    >>> [corner.tolist() for corner in shape_box(box(2.0, 4.0, 3.0))]
    [[-1.0, -2.0, 0.0], [1.0, 2.0, 3.0]]
    """
    if isinstance(shape, Prism):
        low, high = bounds(shape.section.outline)
        return np.array([low.real, low.imag, 0.0]), np.array([high.real, high.imag, shape.length])
    if isinstance(shape, Turned):
        low, high = bounds(shape.profile.outline)
        radius = high.imag
        return np.array([-radius, -radius, low.real]), np.array([radius, radius, high.real])
    if isinstance(shape, Sum):
        placed = [
            position.points(box_corners(*shape_box(member.shape)))
            for member in shape.members
            for position in member.positions
        ]
    else:
        placed = list(shape.pieces(_BOX_DEVIATION))
    return np.min([points.min(0) for points in placed], axis=0), np.max([points.max(0) for points in placed], axis=0)


def box_corners(low: Corner, high: Corner) -> Float[np.ndarray, "8 3"]:
    """The corners of a box between its least and its greatest one [m]."""
    return np.array(list(product(*zip(low.tolist(), high.tolist(), strict=True))))


@_shared
def box(width: float, height: float, length: float) -> Prism:
    """A cuboid about the z axis: width along x, height along y, from z = 0 to its length [m].

    >>> float(box(2.0, 3.0, 4.0).moments.zeroth)
    24.0
    """
    _require_above_zero("a box's width", width)
    _require_above_zero("a box's height", height)
    return Prism(Profile(rectangle(width, height)), length)


@_shared
def square_tube(side: float, wall: float, length: float) -> Prism:
    """A square hollow section about the z axis, its corners sharp: outer side, wall and length [m].

    Raises ParameterError for a wall of half the side or more.
    """
    _require_wall(wall, side)
    return Prism(Profile(rectangle(side, side), (rectangle(side - 2 * wall, side - 2 * wall),)), length)


def bar(diameter: float, length: float) -> Turned:
    """A round bar about the z axis from z = 0 [m]; its surfaces and moments are those of a cylinder."""
    return tube(diameter, diameter / 2, length)


@_shared
def tube(diameter: float, wall: float, length: float) -> Turned:
    """A round tube about z from z = 0: outer diameter, wall and length [m]; a bar where the wall is the radius.

    Raises ParameterError for a wall beyond the radius.

    >>> round(tube(0.1, 0.05, 1.0).moments.zeroth / (math.pi * 0.05**2), 12)
    1.0
    """
    _require_above_zero("a tube's length", length)
    if not 0 < wall <= diameter / 2:
        raise ParameterError(
            f"a wall of {format_quantity(wall, 'mm')}", allowed=f"above 0, to {format_quantity(diameter / 2, 'mm')}"
        )
    outer, inner = diameter / 2, diameter / 2 - wall
    return Turned(Profile(polygon(np.array([1j * inner, length + 1j * inner, length + 1j * outer, 1j * outer]))))


def bored_ends(shell: Turned, bore: float, deep: float) -> Turned:
    """A tube about z from z = 0, its profile from its inner edge on, bored at both ends to a radius, so deep [m].

    >>> plain = tube(0.1, 0.01, 1.0)
    >>> cut = math.pi * (0.042**2 - 0.04**2) * 2 * 0.05
    >>> round((plain.volume - bored_ends(plain, 0.042, 0.05).volume) / cut, 9)
    1.0
    """
    (first, last), others = shell.profile.outline.points[:2], shell.profile.outline.points[2:]
    if first.imag <= 0:
        return shell
    rise = 1j * (bore - first.imag)
    inner = np.array([first + rise, first + rise + deep, first + deep, last - deep, last + rise - deep, last + rise])
    return Turned(Profile(polygon(np.concatenate([inner, others]))))


def stepped(*steps: tuple[float, float]) -> Turned:
    """A turned shaft of steps from z = 0: diameter and length of each [m].

    >>> round(stepped((0.02, 0.1), (0.04, 0.1)).moments.zeroth / (math.pi * 0.1 * (0.01**2 + 0.02**2)), 12)
    1.0
    """
    corners, z = [0j], 0.0
    for diameter, length in steps:
        _require_above_zero("a step's diameter", diameter)
        _require_above_zero("a step's length", length)
        if corners[-1].imag == diameter / 2:  # it goes on as the step before it
            del corners[-1]
        else:
            corners.append(z + 0.5j * diameter)
        z += length
        corners.append(z + 0.5j * diameter)
    return Turned(Profile(polygon(np.array([*corners, complex(z)]))))


@_shared
def rectangle(width: float, height: float) -> Contour:
    """A rectangle about the origin [m]."""
    return polygon(np.array([-width - 1j * height, width - 1j * height, width + 1j * height, -width + 1j * height]) / 2)


def disc(radius: float, *holes: Contour) -> Profile:
    """The section of a disc about the origin, with its bores [m]."""
    return Profile(circle(0j, radius), holes)


def _require_above_zero(name: str, length: float) -> None:
    if not 0 < length < math.inf:
        raise ParameterError(f"{name} of {format_quantity(length, 'mm')}", allowed="above 0 mm")


def _require_wall(wall: float, most: float) -> None:
    if not 0 < wall < most / 2:
        raise ParameterError(
            f"a wall of {format_quantity(wall, 'mm')}", allowed=f"above 0, below {format_quantity(most / 2, 'mm')}"
        )
