"""A mechanism's dimensions: what a drawing puts a number and a tolerance on.

A dimension, changed, acts on the equations of its joint as a small displacement of a body would, but of that body as
this joint alone sees it. A point moved by d in its body's frame: the body shifted by d. So the derivative of any
equation by any dimension is that equation's derivative by a pose, and needs no formula of its own.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

from ilmek.arrays import ComplexField, RealField
from ilmek.errors import MechanismError
from ilmek.linkage.model import Mechanism, Slide
from ilmek.plane.vectors import unit


class BodyShift(NamedTuple):
    """A displacement in a body's own frame, a unit change of a dimension: shift [m], turn about the origin [rad]."""

    shift: ComplexField
    turn: RealField = 0.0


NONE = BodyShift(0j)
"""No displacement."""

Nudges: TypeAlias = Mapping[tuple[str, str], BodyShift]
"""(joint or point, body) -> how that joint sees the body displaced."""


@dataclass(frozen=True, slots=True)
class BodyPoint:
    """Where a point stands in its body [m], measured in the direction `along` [rad] of the body's frame.

    A link's length is its far point's place along the link.
    """

    body: str
    point: str
    along: float = 0.0

    @property
    def length(self) -> bool:
        """A length."""
        return True

    def nudges(self, mechanism: Mechanism) -> Nudges:
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

    def nudges(self, mechanism: Mechanism) -> Nudges:
        """Guide and body turned together, each about its own point of the slide."""
        slide = _slide(mechanism, self.slide)
        return {(slide.name, body): _about(mechanism.point(body, slide.name), 1.0) for body in slide.bodies}

    def value(self, mechanism: Mechanism) -> float:
        """The angle [rad]."""
        return _slide(mechanism, self.slide).along


@dataclass(frozen=True, slots=True)
class FixedAngle:
    """The angle [rad] at which a slide holds its body against its guide: `Slide.turned`."""

    slide: str

    @property
    def length(self) -> bool:
        """An angle."""
        return False

    def nudges(self, mechanism: Mechanism) -> Nudges:
        """The body turned back about its point of the slide."""
        slide = _slide(mechanism, self.slide)
        return {(slide.name, slide.body): _about(mechanism.point(slide.body, slide.name), -1.0)}

    def value(self, mechanism: Mechanism) -> float:
        """The angle [rad]."""
        return _slide(mechanism, self.slide).turned


Dimension: TypeAlias = BodyPoint | LineDirection | FixedAngle


def dimensions(mechanism: Mechanism) -> tuple[Dimension, ...]:
    """All of them: x and y of every point of every body, direction and fixed angle of every slide.

    They are more than a drawing needs: those that only move a body's frame in the body cancel one another.
    """
    places = [
        BodyPoint(body.name, point, along)
        for body in mechanism.bodies
        for point in body.points
        for along in (0.0, QUARTER)
    ]
    slides = [joint.name for joint in mechanism.joints if isinstance(joint, Slide)]
    return (*places, *(kind(slide) for slide in slides for kind in (LineDirection, FixedAngle)))


QUARTER = 1.5707963267948966
"""A quarter turn [rad]: along y."""


def _about(centre: complex, turn: float) -> BodyShift:
    return BodyShift(-1j * turn * centre, turn)


def _slide(mechanism: Mechanism, name: str) -> Slide:
    joint = mechanism.joint(name)
    if not isinstance(joint, Slide):
        raise MechanismError(f"{name!r} is not a slide", allowed="only a slide has a direction and a fixed angle")
    return joint
