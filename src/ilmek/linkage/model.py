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
from typing import Protocol, TypeAlias, TypeVar

from ilmek.arguments import Arguments
from ilmek.arrays import RealField
from ilmek.errors import MechanismError, did_you_mean
from ilmek.linkage.joints import GROUND, Body, Displacement, Pin, Rotation, Slide, about, set_texts
from ilmek.plane.teeth import PRESSURE_ANGLE
from ilmek.records import brief, shown_value
from ilmek.report.shown import Shown
from ilmek.units import deg

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


GREATEST_PRESSURE_ANGLE = 45 * deg
"""Greatest pressure angle of a coupling [rad]; teeth have 14.5° to 30°."""


class TransferLaw(Protocol):
    """A law q_2 = f(q_1) of a higher pair, periodic in q_1 but for a constant; `geneva.Geneva`, the lift of a cam.

    slides  whether q_2 is a displacement [m], not an angle      turns  of q_1 after which the second is as before
    one_sided  whether the first body can only press on the second
    """

    @property
    def slides(self) -> bool: ...

    @property
    def turns(self) -> int: ...

    @property
    def one_sided(self) -> bool: ...

    def motion(self, angle: RealField, /) -> tuple[RealField, RealField, RealField, RealField]:
        """F and its first three derivatives at angles [rad]."""


@dataclass(frozen=True, slots=True)
class BeltSpans:
    """The spans of a belt or chain between its pulleys, whose forces load their bearings.

    radius      r_1 of the first pulley [m]; r_2 = r_1 / |ratio|
    pretension  T_0 of each span at rest [N]; 0: a chain, whose slack span has no force
    friction    mu of a flat belt on its pulleys; None: teeth, which do not slip

    >>> BeltSpans("40mm", pretension="300N", friction=0.3).radius
    0.04
    """

    radius: float
    pretension: float = 0.0
    friction: float | None = None

    def __post_init__(self) -> None:
        given = Arguments("a belt", MechanismError)
        object.__setattr__(self, "radius", given.not_negative("radius", self.radius, "m"))
        if not self.radius:
            raise MechanismError("the radius of a pulley is 0", allowed="above 0")
        object.__setattr__(self, "pretension", given.not_negative("pretension", self.pretension, "N"))
        if self.friction is not None:
            object.__setattr__(self, "friction", given.not_negative("friction", self.friction, ""))

    def lean(self, ratio: float, distance: RealField) -> RealField:
        """Sin alpha = (r_1 -+ r_2) / a: of the spans against the line of centres, at a distance a of these [m]."""
        return self.radius * (1 - 1 / ratio) / distance


@dataclass(frozen=True, slots=True)
class Coupling:
    """A fixed relation of the motions of two bodies on one carrier: gears, belt or chain, rack, cam, Geneva wheel.

        q_second - second_at = ratio (q_first - first_at),   or  = f(q_first - first_at) by a law

    kind     "gears", "belt", "rack", "cam" or "geneva"
    first    body and its point in the middle of the wheel; q is its angle against the carrier [rad]
    second   the same of the other wheel; for a rack the sliding body and its slide, q the slide's displacement s [m]
    ratio    gears outside one another -z1/z2, one inside the other z1/z2; an open belt r1/r2, a crossed one -r1/r2;
             rack: travel per radian of the pinion [m/rad], the signed pitch radius
    first_at, second_at   both q in the assembled position: the mesh is given, never assumed
    carrier  the body that carries both wheels; it may move (planetary gears); for a rack the slide's guide
    pressure_angle   of gears and racks: of their teeth at the pitch point [rad]; a belt has none
    law      f of a cam or Geneva wheel, in place of the ratio; the angle of a Geneva crank from the line of its centres
    spans    of a belt or chain; None: the forces that depend on its tension are open
    roller   point of a cam's follower in the middle of its roller; "": a flat face square to its slide

    Angles determined by inputs and ratios alone count full turns. Any other angle of `first` (or `second`) is assumed
    to be within half a turn of `first_at` (`second_at`).

    >>> Coupling("mesh", "gears", ("pinion", "P0"), ("wheel", "W0"), ratio=-20 / 60, first_at=0, second_at=0).bodies
    ('pinion', 'wheel', 'ground')
    """

    name: str
    kind: str
    first: tuple[str, str]
    second: tuple[str, str]
    ratio: float
    first_at: float
    second_at: float
    carrier: str = GROUND
    pressure_angle: float = PRESSURE_ANGLE
    law: TransferLaw | None = None
    roller: str = ""
    spans: BeltSpans | None = None

    def __post_init__(self) -> None:
        set_texts(self, "name", "kind", "carrier", "roller")
        given = Arguments(f"coupling {self.name!r}", MechanismError)
        rack = self.slides
        with about("couplings", self.name):
            for name in ("first", "second"):
                body, point = given.pair(name, getattr(self, name), "(body, point)")
                wheel = given.text(f"body of {name}", body), given.text(f"point of {name}", point)
                object.__setattr__(self, name, wheel)
            units = {"ratio": "m" if rack else "", "first_at": "rad", "second_at": "m" if rack else "rad"}
            units["pressure_angle"] = "rad"
            for name, unit in units.items():
                object.__setattr__(self, name, given.number(name, getattr(self, name), unit))

    @property
    def bodies(self) -> tuple[str, str, str]:
        """First, second, carrier."""
        return self.first[0], self.second[0], self.carrier

    @property
    def slides(self) -> bool:
        """Whether the second body slides."""
        return self.kind == "rack" if self.law is None else self.law.slides

    def transfer(self, turned: RealField) -> tuple[RealField, RealField, RealField, RealField]:
        """q_second - second_at and its derivatives by q_first, at q_first - first_at [rad]."""
        if self.law is not None:
            return self.law.motion(turned)
        return self.ratio * turned, self.ratio, 0.0, 0.0


KINDS = ("gears", "belt", "rack", "cam", "geneva")
"""Kinds of couplings."""

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

    def point(self, body: str, point: str) -> complex:
        """A body's point in the body's frame [m]."""
        points = self.body(body).points
        if not isinstance(point, str) or point not in points:
            known = ", ".join(points) or "none"
            raise MechanismError(
                f"body {body!r} of {self.name} has no point {shown_value(point)}", allowed=f"it has {known}"
            )
        return points[point]

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
    for body, point in (coupling.first, coupling.second):
        mechanism.point(body, point)
    mechanism.body(coupling.carrier)
    if coupling.ratio == 0 and coupling.law is None:
        raise MechanismError(f"{subject} has ratio 0", allowed="another number")
    if not 0 <= coupling.pressure_angle <= GREATEST_PRESSURE_ANGLE:
        given = f"{subject} has a pressure angle of {coupling.pressure_angle:g} rad"
        raise MechanismError(given, allowed="0 to 45deg", do="teeth have 20deg, as a rule")
    if coupling.spans is not None:
        _check_spans(mechanism, coupling, coupling.spans)
    if coupling.roller:
        mechanism.point(coupling.second[0], coupling.roller)
    if coupling.slides:
        slide = mechanism.joint(coupling.second[1])
        if not isinstance(slide, Slide) or slide.bodies != (coupling.second[0], coupling.carrier):
            given = (
                f"{subject} requires a slide {coupling.second[1]!r} of {coupling.second[0]!r} on {coupling.carrier!r}"
            )
            raise MechanismError(given, allowed=f"it is a {type(slide).__name__.lower()} of {', '.join(slide.bodies)}")


def _check_spans(mechanism: Mechanism, coupling: Coupling, spans: BeltSpans) -> None:
    points = mechanism.body(coupling.carrier).points
    if coupling.kind != "belt":
        raise MechanismError(f"{coupling.name!r} has spans", allowed="a belt or chain has them")
    if coupling.first[1] in points and coupling.second[1] in points:
        distance = abs(points[coupling.first[1]] - points[coupling.second[1]])
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
