"""A mechanism's dimensions: the lengths and angles that have a tolerance on a drawing.

A change of a dimension acts on the equations of its joint like a small displacement of a body, in these equations only:
a point moved by d in its body's frame is a body shifted by d. So the derivative of an equation by a dimension is its
derivative by a pose, and needs no formula of its own. [derived here; see `sensitivity`]
"""

from cmath import phase
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

from ilmek.arrays import ComplexField, RealField
from ilmek.errors import MechanismError
from ilmek.linkage.model import Mechanism, Slide
from ilmek.plane.vectors import unit


class BodyShift(NamedTuple):
    """A displacement in a body's own frame per unit of a dimension: shift [m], turn about the origin [rad]."""

    shift: ComplexField
    turn: RealField = 0.0


NONE = BodyShift(0j)
"""No displacement."""

BodyShifts: TypeAlias = Mapping[tuple[str, str], BodyShift]
"""(joint or point, body) -> displacement of the body in the equations of that joint."""


@dataclass(frozen=True, slots=True)
class BodyPoint:
    """Coordinate of a point in its body's frame [m] in the direction `along` [rad].

    A link's length is the coordinate of its far point along the link.
    """

    body: str
    point: str
    along: float = 0.0

    @property
    def length(self) -> bool:
        """Whether it is a length: True."""
        return True

    def shifts(self, mechanism: Mechanism) -> BodyShifts:
        """The body shifted. Raises MechanismError for an unknown body or point."""
        mechanism.point(self.body, self.point)
        return {(self.point, self.body): BodyShift(unit(self.along))}

    def value(self, mechanism: Mechanism) -> float:
        """The coordinate [m]."""
        return float((mechanism.point(self.body, self.point) * unit(-self.along)).real)


@dataclass(frozen=True, slots=True)
class LineDirection:
    """The direction [rad] of a slide's line in its guide's frame: `Slide.along`; the body does not turn with it."""

    slide: str

    @property
    def length(self) -> bool:
        """An angle."""
        return False

    def shifts(self, mechanism: Mechanism) -> BodyShifts:
        """Guide and body turned together, each about its own point of the slide."""
        slide = _slide(mechanism, self.slide)
        return {(slide.name, body): _about(mechanism.point(body, slide.name), 1.0) for body in slide.bodies}

    def value(self, mechanism: Mechanism) -> float:
        """The angle [rad]."""
        return _slide(mechanism, self.slide).along


@dataclass(frozen=True, slots=True)
class FixedAngle:
    """The fixed angle [rad] of a slide's body against its guide: `Slide.turned`."""

    slide: str

    @property
    def length(self) -> bool:
        """An angle."""
        return False

    def shifts(self, mechanism: Mechanism) -> BodyShifts:
        """The body turned back about its point of the slide."""
        slide = _slide(mechanism, self.slide)
        return {(slide.name, slide.body): _about(mechanism.point(slide.body, slide.name), -1.0)}

    def value(self, mechanism: Mechanism) -> float:
        """The angle [rad]."""
        return _slide(mechanism, self.slide).turned


Dimension: TypeAlias = BodyPoint | LineDirection | FixedAngle


def dimensions(mechanism: Mechanism) -> tuple[Dimension, ...]:
    """All dimensions: x and y of every point of every body, direction and fixed angle of every slide.

    They are more than a drawing needs: dimensions that only move a body's frame in the body cancel.
    """
    coordinates = [
        BodyPoint(body.name, point, along)
        for body in mechanism.bodies
        for point in body.points
        for along in (0.0, QUARTER)
    ]
    slides = [joint.name for joint in mechanism.joints if isinstance(joint, Slide)]
    return (*coordinates, *(kind(slide) for slide in slides for kind in (LineDirection, FixedAngle)))


def link_dimensions(mechanism: Mechanism) -> tuple[Dimension, ...]:
    """The dimensions as on a drawing, none of which only moves a body's frame.

    Of each body the distance of its second point from its first, the datum, and of every further point the coordinates
    along that line and across it; of each slide its direction and its fixed angle.

    >>> from ilmek.linkage.fourbar import four_bar
    >>> [(entry.body, entry.point) for entry in link_dimensions(four_bar(0.300, 0.060, 0.200, 0.230, branch=+1))]
    [('ground', 'B0'), ('crank', 'A'), ('coupler', 'B'), ('rocker', 'B')]
    """
    lengths: list[Dimension] = []
    joints = {joint.name for joint in mechanism.joints}
    for body in mechanism.bodies:
        names = sorted(body.points, key=lambda name: name not in joints)  # joints first, in the body's order
        others = [name for name in names if body.points[name] != body.points[names[0]]]
        if others:
            along = phase(body.points[others[0]] - body.points[names[0]])
            lengths.append(BodyPoint(body.name, others[0], along))
            lengths += [BodyPoint(body.name, name, along + turn) for name in others[1:] for turn in (0.0, QUARTER)]
    slides = [joint.name for joint in mechanism.joints if isinstance(joint, Slide)]
    return (*lengths, *(kind(slide) for slide in slides for kind in (LineDirection, FixedAngle)))


QUARTER = 1.5707963267948966
"""Direction of y [rad]."""


def _about(centre: complex, turn: float) -> BodyShift:
    return BodyShift(-1j * turn * centre, turn)


def _slide(mechanism: Mechanism, name: str) -> Slide:
    joint = mechanism.joint(name)
    if not isinstance(joint, Slide):
        raise MechanismError(f"{name!r} is not a slide", allowed="only a slide has a direction and a fixed angle")
    return joint
