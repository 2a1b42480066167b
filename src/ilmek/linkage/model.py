"""Definition of a planar mechanism: rigid bodies, joints and inputs.

A mechanism is data. `structure.plan` finds the order of solution, `solve.solve` computes the motion.

>>> from ilmek.linkage.fourbar import four_bar
>>> mechanism = four_bar(0.300, 0.060, 0.200, 0.230, branch=+1)
>>> [body.name for body in mechanism.bodies]
['ground', 'crank', 'coupler', 'rocker']
>>> degrees_of_freedom(mechanism)
1
"""

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import partial
from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING, TypeAlias, TypeVar

from ilmek.arguments import Arguments
from ilmek.errors import MechanismError, did_you_mean
from ilmek.linkage.couplings import GREATEST_PRESSURE_ANGLE, KINDS, BeltSpans, Coupling
from ilmek.linkage.joints import (
    GROUND,
    Body,
    Displacement,
    FreePoint,
    Pin,
    Rotation,
    Slide,
    about,
    free_point,
)
from ilmek.records import brief, shown_value
from ilmek.report.shown import Shown

if TYPE_CHECKING:
    from ilmek.linkage.variants import Variants

__all__ = [
    "GROUND",
    "KINDS",
    "Body",
    "Coupling",
    "Displacement",
    "Input",
    "Joint",
    "Mechanism",
    "Pin",
    "Rotation",
    "Slide",
    "degrees_of_freedom",
]

Joint: TypeAlias = Pin | Slide
Input: TypeAlias = Rotation | Displacement
Named = TypeVar("Named", Body, Pin | Slide)


@dataclass(frozen=True, slots=True)
class Mechanism(Shown):
    """Bodies, joints, inputs, and the assembly branch of each group.

    branches  free pin's (or slide's) name -> +1 or -1. A group of two links between known pins has two branches; see
              `Pin` (two links: side of the line between the known pins), `groups.rrp` (link and slider: further along
              the line, or less far) and `groups.rpr` (two bodies that slide on one another: by the slide's name, the
              sliding body's pin ahead of the guide's pin along the slide, or behind).
    name      name in messages
    pose      body -> (origin [m], angle [rad]) in some assembled position, roughly; needed only by groups without a
              closed form: the start of Newton's method. Default of a body: its frame coincides with the world.
    couplings  gears, belts, racks
    redundant  joints that stand still by constraints elsewhere, which leave a force in them open: see `redundant`

    Raises MechanismError for a name used twice or unknown, a body that no joint holds, a link of zero length, a
    branch that is neither +1 nor -1, a pose that is not finite. The degrees of freedom are checked by `structure.plan`,
    so that an over-constrained mechanism can be examined too (`mobility`).

    >>> press = Mechanism(
    ...     bodies=[Body("ground", {"line": 0}), Body("ram", {"line": 0})],
    ...     joints=[Slide("line", "ram", "ground")],
    ...     inputs=[Displacement("line")],
    ... )
    >>> press.moving
    ('ram',)
    """

    bodies: tuple[Body, ...]
    joints: tuple[Joint, ...]
    inputs: tuple[Input, ...]
    branches: Mapping[str, int] = field(default_factory=dict)
    name: str = "mechanism"
    pose: Mapping[str, tuple[complex, float]] = field(default_factory=dict)
    couplings: tuple[Coupling, ...] = ()
    redundant: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        given = Arguments("a mechanism", MechanismError)
        kinds = {"bodies": Body, "joints": (Pin, Slide), "inputs": (Rotation, Displacement), "couplings": Coupling}
        object.__setattr__(self, "name", given.text("name", self.name))
        object.__setattr__(self, "redundant", given.sequence("redundant", self.redundant, str))
        for name, kind in kinds.items():
            object.__setattr__(self, name, given.sequence(name, getattr(self, name), kind))
        branches = given.mapping("branches", self.branches, partial(given.whole, least=-1, most=1))
        object.__setattr__(self, "branches", branches)
        object.__setattr__(self, "pose", given.mapping("pose", self.pose, partial(_pose, given)))
        _check(self)

    def __hash__(self) -> int:
        return hash((self.name, self.bodies, self.joints, self.inputs))

    def __repr__(self) -> str:
        return brief(self)

    def body(self, name: str) -> Body:
        """The body of that name."""
        return _find(name, self.bodies, "body", self.name)

    def joint(self, name: str) -> Joint:
        """The joint of that name."""
        return _find(name, self.joints, "joint", self.name)

    def located(self, point: FreePoint) -> tuple[str, complex]:
        """The body of a point, "body.point", and its position in the body's frame [m]; a position as it is."""
        body, name = free_point(Arguments("", MechanismError), "a point", point)
        return body, self.point(body, name) if isinstance(name, str) else name

    def point(self, body: str, point: str = "") -> complex:
        """A point, "body.point", in its body's frame [m]; or of a body and a point's name."""
        if isinstance(point, str) and not point and body not in (entry.name for entry in self.bodies):
            return self.located(body)[1]
        points = self.body(body).points
        if not isinstance(point, str) or point not in points:
            given = f"body {body!r} of {self.name} has no point {shown_value(point)}"
            raise MechanismError(given, allowed=f"it has {', '.join(points) or 'none'}")
        return points[point]

    def vary(self, points: Mapping[str, object] = MappingProxyType({}), **lengths: object) -> "Variants":
        """Variants of it: link -> lengths between its two joints [m]; points: "BODY.POINT" -> positions [m], complex.

        The arrays broadcast. Raises MechanismError for unknown names and for lengths that are not above 0.
        """
        return import_module("ilmek.linkage.variants").varied(self, points, lengths)  # type: ignore[no-any-return]

    @property
    def moving(self) -> tuple[str, ...]:
        """Names of all bodies but the ground."""
        return tuple(body.name for body in self.bodies if body.name != GROUND)


def _pose(given: Arguments, name: str, pose: object) -> tuple[complex, float]:
    """Origin [m] and angle [rad] of a body."""
    origin, angle = given.pair(name, pose, "(origin, angle)")
    return given.point(f"origin of {name}", origin), given.number(f"angle of {name}", angle, "rad")


def degrees_of_freedom(mechanism: Mechanism) -> int:
    """Degrees of freedom [1] with free inputs, 3 bodies - 2 joints - couplings [Gruebler; Norton, chapter 2]."""
    return 3 * len(mechanism.moving) - 2 * len(mechanism.joints) - len(mechanism.couplings)


def _find(name: str, among: Iterable[Named], kind: str, of: str) -> Named:
    if not isinstance(name, str):
        raise MechanismError(f"{shown_value(name)} given for a {kind} of {of}", allowed="its name")
    for entry in among:
        if entry.name == name:
            return entry
    known = [entry.name for entry in among]
    allowed = f"it has {', '.join(known) or 'none'}"
    raise MechanismError(f"{of} has no {kind} {name!r}", allowed=allowed, do=did_you_mean(name, known))


def _check(mechanism: Mechanism) -> None:
    _check_names(mechanism)
    for joint in mechanism.joints:
        with about("joints", joint.name):
            _check_joint(mechanism, joint)
    for coupling in mechanism.couplings:
        with about("couplings", coupling.name):
            _check_coupling(mechanism, coupling)
    for entry in mechanism.inputs:
        with about("inputs", entry.joint):
            _check_input(mechanism, entry)
    for name in mechanism.moving:
        with about("bodies", name):
            _check_joined(mechanism, name)
    for name, branch in mechanism.branches.items():
        with about("branches", name):
            _check_branch(mechanism, name, branch)
    for name in mechanism.pose:
        with about("pose", name):
            mechanism.body(name)
    for name in mechanism.redundant:
        with about("redundant"):
            mechanism.joint(name)


def _check_names(mechanism: Mechanism) -> None:
    for kind in ("bodies", "joints", "inputs", "couplings"):
        named = getattr(mechanism, kind)
        for name, times in Counter(entry.name for entry in named).items():
            if times > 1:
                raise MechanismError(f"{mechanism.name} has {times} {kind} named {name!r}", do="give each its own name")
    for name in {joint.name for joint in mechanism.joints} & {coupling.name for coupling in mechanism.couplings}:
        given = f"{mechanism.name} has a joint and a coupling named {name!r}"
        raise MechanismError(given, do="give each its own name", about=("couplings", name))
    if GROUND not in {body.name for body in mechanism.bodies}:
        given = f"{mechanism.name} has no body named {GROUND!r}"
        raise MechanismError(given, do="one body must stand still", about=("bodies",))


def _check_joint(mechanism: Mechanism, joint: Joint) -> None:
    if joint.bodies[0] == joint.bodies[1]:
        raise MechanismError(f"joint {joint.name!r} of {mechanism.name} joins {joint.bodies[0]!r} to itself")
    for body in joint.bodies:
        mechanism.point(body, joint.name)


def _check_coupling(mechanism: Mechanism, coupling: Coupling) -> None:
    subject = f"coupling {coupling.name!r} of {mechanism.name}"
    if coupling.kind not in KINDS:
        raise MechanismError(f"{subject} is of kind {coupling.kind!r}", allowed=", ".join(KINDS))
    if len(set(coupling.bodies)) < 3:
        raise MechanismError(f"{subject} joins {', '.join(coupling.bodies)}", allowed="three different bodies")
    for body, point in coupling.ends:
        mechanism.point(body, point)
    mechanism.body(coupling.carrier)
    if coupling.ratio == 0 and coupling.law is None:
        raise MechanismError(f"{subject} has ratio 0", allowed="another number")
    if not 0 <= coupling.pressure_angle <= GREATEST_PRESSURE_ANGLE:
        given = f"{subject} has a pressure angle of {coupling.pressure_angle:g} rad"
        raise MechanismError(given, allowed="0 to 45deg", do="teeth have 20deg, as a rule")
    if coupling.spans is not None:
        _check_spans(mechanism, coupling, coupling.spans)
    body, point = coupling.ends[1]
    if coupling.roller:
        mechanism.point(body, coupling.roller)
    if coupling.slides:
        slide = mechanism.joint(point)
        if not isinstance(slide, Slide) or slide.bodies != (body, coupling.carrier):
            given = f"{subject} requires a slide {point!r} of {body!r} on {coupling.carrier!r}"
            raise MechanismError(given, allowed=f"it is a {type(slide).__name__.lower()} of {', '.join(slide.bodies)}")


def _check_spans(mechanism: Mechanism, coupling: Coupling, spans: BeltSpans) -> None:
    points = mechanism.body(coupling.carrier).points
    if coupling.kind != "belt":
        raise MechanismError(f"{coupling.name!r} has spans", allowed="a belt or chain has them")
    (_, first), (_, second) = coupling.ends
    if first in points and second in points:
        distance = abs(points[first] - points[second])
        if abs(spans.radius * (1 - 1 / coupling.ratio)) >= distance:
            other = spans.radius / abs(coupling.ratio)
            given = f"{coupling.name!r}: pulleys of radius {spans.radius:g} m and {other:g} m at {distance:g} m"
            raise MechanismError(given, allowed="a distance at which a belt reaches around both")


def _check_input(mechanism: Mechanism, entry: Input) -> None:
    joint = mechanism.joint(entry.joint)
    required = Pin if isinstance(entry, Rotation) else Slide
    if not isinstance(joint, required):
        raise MechanismError(
            f"{type(entry).__name__.lower()} {entry.name!r} of {mechanism.name} drives {joint.name!r}, "
            f"a {type(joint).__name__.lower()}",
            allowed=f"a {type(entry).__name__.lower()} needs a {required.__name__.lower()}",
        )
    if isinstance(entry, Rotation) and entry.body not in joint.bodies:
        raise MechanismError(
            f"input turns {entry.body!r} about {joint.name!r}", allowed=f"that pin joins {' and '.join(joint.bodies)}"
        )
    if sum(other.joint == entry.joint for other in mechanism.inputs) > 1:
        raise MechanismError(f"two inputs of {mechanism.name} drive joint {joint.name!r}", do="leave one of them")


def _check_joined(mechanism: Mechanism, body: str) -> None:
    joints = [joint for joint in mechanism.joints if body in joint.bodies]
    if not joints:
        raise MechanismError(f"no joint of {mechanism.name} holds body {body!r}", do="join it or leave it out")
    positions = {mechanism.point(body, joint.name) for joint in joints}
    if len(joints) > 1 and len(positions) == 1 and all(isinstance(joint, Pin) for joint in joints):
        pins = " and ".join(joint.name for joint in joints)
        raise MechanismError(f"link {body!r} has zero length: its pins {pins} coincide", do="give it a length above 0")


def _check_branch(mechanism: Mechanism, name: str, branch: int) -> None:
    mechanism.joint(name)
    if branch not in (+1, -1):
        raise MechanismError(f"branch of {name!r} in {mechanism.name} is {branch!r}", allowed="+1 or -1")
