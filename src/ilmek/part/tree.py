"""Bodies and their joints: the tree of a machine, from which all its views are made.

    point in the parent = position (shift(q) + R(axis, rotation(q)) point)          q  angle of the joint's drive

`position` is where the body's frame lies in its parent's at rest; a body that is there many times has one for each.
"""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from enum import StrEnum
from functools import lru_cache

from ilmek.errors import ParameterError
from ilmek.part.moments import Moments, together
from ilmek.part.part import Part
from ilmek.part.placement import IDENTITY, Placement, placement
from ilmek.records import record
from ilmek.report.scene import SceneMotion
from ilmek.units import mm

GROUND = ""
"""Name of what stands."""

Axis = tuple[float, float, float]


class JointKind(StrEnum):
    """How a body is held by its parent."""

    FIXED = "fixed"
    PIN = "pin"
    SLIDE = "slide"
    SCREW = "screw"
    ROLLING = "rolling"
    TRANSMISSION = "transmission"
    CAM = "cam and follower"
    MISSING = "missing"
    """Nothing holds the body yet: its support is not designed."""


STANDING = frozenset({JointKind.FIXED, JointKind.MISSING})
"""Joints that let nothing move."""


@record
class Joint:
    """The joint of a body to its parent.

    axis    in the body's frame: of a pin, along a slide          motion  what drives it; None: it stands, or hangs free
    seats   seat of the body and seat of the parent, or of a body that moves on the same parent about the same axis,
            that meet in it, each `part id:seat`; none where it is not designed
    motor    id of the part that drives it, directly or by a reducer, belt or screw
    hand     id of the part by which the weaver's hand moves it, directly or by a reducer
    passive  why nothing has to drive it: what holds it, in words
    """

    kind: JointKind = JointKind.FIXED
    axis: Axis = (0.0, 0.0, 1.0)
    motion: SceneMotion | None = None
    seats: tuple[str, ...] = ()
    motor: str = ""
    hand: str = ""
    passive: str = ""


@record
class Occurrence:
    """A part in a body, at one or more positions in its frame.

    turning  it turns on what it sits, as a roller or an eye, and no body follows it
    """

    part: Part
    positions: tuple[Placement, ...] = (IDENTITY,)
    turning: bool = False


@record
class RigidBody:
    """What moves as one: parts, and the joint by which its parent holds it.

    id  unique    parent  id of a body, or the ground    positions  of its frame in the parent's, one for each of them
    """

    id: str
    occurrences: tuple[Occurrence, ...]
    parent: str = GROUND
    joint: Joint = field(default_factory=Joint)
    positions: tuple[Placement, ...] = (IDENTITY,)

    @property
    def moments(self) -> Moments:
        """Moments of its mass in its own frame (kg, kg m, kg m²), of the parts that are weighed."""
        return _moments(self)


@record
class Closure:
    """A joint that closes a loop: it holds two bodies together, and carries neither.

    kind    pin; fixed; rolling: the second body turns against its parent `ratio` times as far as the first; or a
            transmission: the second follows the first by the law that their motions state (cam, slot, rack, magnets)
    bodies  ids: those there as often as one another are held one to one, one is held to all of many, and of a body with
            itself the first to all others
    position  of the joint's frame in the first body's
    kept_by  ids of the parts without which nothing keeps them together: the spring of a cam's follower, magnets
    along    of a transmission: direction of the slide that follows; default: the body has one coordinate
    """

    kind: JointKind
    bodies: tuple[str, str]
    position: Placement = IDENTITY
    ratio: float = 1.0
    kept_by: tuple[str, ...] = ()
    along: Axis | None = None


@record
class Tree:
    """The bodies of a machine, each after its parent, and the joints that close their loops.

    Raises ParameterError for an id that is there twice, for a parent that does not come before its body, and for a
    closure of unknown bodies.
    """

    bodies: tuple[RigidBody, ...] = ()
    closures: tuple[Closure, ...] = ()

    def __post_init__(self) -> None:
        ids: set[str] = {GROUND}
        for body in self.bodies:
            if body.id in ids:
                raise ParameterError(f"two bodies named {body.id!r}", do="give each its own id")
            if body.parent not in ids:
                raise ParameterError(f"body {body.id!r} on {body.parent!r}", allowed="a body before it, or the ground")
            ids.add(body.id)
        ids.remove(GROUND)
        for name in (name for closure in self.closures for name in closure.bodies):
            if name not in ids:
                raise ParameterError(f"a loop closed at {name!r}", allowed="bodies of the tree")
        parts: dict[str, Part] = {}
        for body in self.bodies:
            for occurrence in body.occurrences:
                if parts.setdefault(occurrence.part.id, occurrence.part) is not occurrence.part:
                    raise ParameterError(f"two parts named {occurrence.part.id!r}", do="give each its own id")

    def body(self, name: str) -> RigidBody:
        """The body of an id. Raises ParameterError for an unknown one."""
        for body in self.bodies:
            if body.id == name:
                return body
        raise ParameterError(f"no body {name!r}", allowed=", ".join(body.id for body in self.bodies))

    def counts(self) -> Mapping[str, int]:
        """How often each body is there: its positions times those of all that carry it."""
        counts = {GROUND: 1}
        for body in self.bodies:
            counts[body.id] = counts[body.parent] * len(body.positions)
        return counts

    def occurrences(self) -> Iterator[tuple[Part, int]]:
        """Each part once, in the order of the bodies, with the number of its pieces in the machine."""
        counts, parts, numbers = self.counts(), dict[str, Part](), dict[str, int]()
        for body in self.bodies:
            for occurrence in body.occurrences:
                part = parts.setdefault(occurrence.part.id, occurrence.part)
                numbers[part.id] = numbers.get(part.id, 0) + counts[body.id] * len(occurrence.positions)
        return ((part, numbers[name]) for name, part in parts.items())

    @property
    def mass(self) -> float:
        """Mass of all parts that are weighed [kg]."""
        return _mass(self)

    def moving(self, motions: Mapping[str, SceneMotion]) -> "Tree":
        """The tree with motions of bodies by their ids."""
        return self.replaced(
            replace(body, joint=replace(body.joint, motion=motions[body.id])) if body.id in motions else body
            for body in self.bodies
        )

    def replaced(self, bodies: Iterable[RigidBody]) -> "Tree":
        """The tree with other bodies, its loops closed alike."""
        return Tree(tuple(bodies), self.closures)

    def carried_by(self, name: str) -> tuple[str, ...]:
        """Ids of a body and of all that it carries."""
        carried = [name]
        for body in self.bodies:
            if body.parent in carried:
                carried.append(body.id)
        return tuple(carried)

    def carrying(self, parent: str, tree: "Tree", position: Placement = IDENTITY) -> "Tree":
        """The tree with another on one of its bodies: the ground of the other at a position in that body's frame."""
        return Tree((*self.bodies, *tree.bodies_on(parent, position)), (*self.closures, *tree.closures))

    def bodies_on(self, parent: str, position: Placement = IDENTITY) -> Iterator[RigidBody]:
        """Its bodies with its ground at a position in the frame of a parent."""
        for body in self.bodies:
            if body.parent != GROUND or (parent == GROUND and position is IDENTITY):
                yield body
            else:
                yield replace(body, parent=parent, positions=tuple(position.after(own) for own in body.positions))


def in_line(parts: Sequence[Part], begin: float, at: complex = 0j) -> tuple[Occurrence, ...]:
    """Parts behind one another from z = begin [m] towards -z, the last, a motor, with its flange to the others.

    at  where their axis is [m]
    """
    occurrences = []
    for part in parts[:-1]:
        begin -= depth_of(part)
        occurrences.append(Occurrence(part, (placement(at.real, at.imag, begin),)))
    return (*occurrences, Occurrence(parts[-1], (placement(at.real, at.imag, begin),)))


def depth_of(part: Part) -> float:
    """Length along z of a part from z = 0 [m]."""
    assert part.shape is not None
    return max(float(piece[:, 2].max()) for piece in part.shape.pieces(1 * mm))


@lru_cache(maxsize=1024)
def _moments(body: RigidBody) -> Moments:
    return together(
        moments.placed(position)
        for occurrence in body.occurrences
        for moments in [occurrence.part.moments]
        if moments is not None
        for position in occurrence.positions
    )


@lru_cache(maxsize=64)
def _mass(tree: Tree) -> float:
    weighed = ((number, part.mass) for part, number in tree.occurrences())
    return math.fsum(number * mass for number, mass in weighed if not math.isnan(mass))
