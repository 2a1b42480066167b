"""A mechanism with all that its dynamics need: masses, loads, friction, drive, members, and what is to be studied.

It is what a mechanism file states beyond the geometry (`ilmek.io.mechanism_file`), as records of this layer; nothing is
computed here. All quantities are SI; angles are in radians.
"""

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from typing import TypeAlias

from ilmek.arguments import Arguments
from ilmek.arrays import FloatArray
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.joint_friction import JointFriction, PinFriction, SlideFriction
from ilmek.dynamics.loads import Load, gravity_vector
from ilmek.dynamics.motor_drive import MotorDrive
from ilmek.errors import MechanismError, UnitError
from ilmek.linkage.joints import body_point
from ilmek.linkage.model import Mechanism
from ilmek.records import record, value_record
from ilmek.units import parse_quantity

InputLaw: TypeAlias = Callable[[FloatArray], tuple[FloatArray, FloatArray, FloatArray]]
"""Times [s] -> value [rad; m], speed and acceleration of an input: constant speed, motion laws in sequence, a table."""


@record
class NamedLoad:
    """A load of the file, with the name by which forces, power and messages refer to it."""

    name: str
    load: Load


@dataclass(frozen=True, slots=True)
class FlatMember:
    """A link as flat bar: what its strength depends on.

    width      in the plane of motion [m]      thickness  across it [m]
    material   name in `ilmek.elements.materials`
    stress     allowed stress [Pa]; None: the material's strength over `safety`, and fatigue is checked
    safety     against the material's strength, and against fatigue [1]
    """

    width: float
    thickness: float
    material: str
    stress: float | None = None
    safety: float = 2.0


@record
class FlatShape:
    """A flat piece of a body, as its file describes it: all within a radius of the hull of its points [m].

    points     in the body's frame: one of a disc, two of a bar, the corners of a plate
    radius     of a disc, half the width of a bar, 0 of a plate      bore  radius of a hole in its middle; 0: none
    thickness  across the plane of motion [m]      material  name in `ilmek.elements.materials`
    """

    points: tuple[complex, ...]
    radius: float
    thickness: float
    material: str
    bore: float = 0.0


@dataclass(frozen=True, slots=True)
class PinMember:
    """A pin as a machine element.

    diameter   [m]      length  bearing length in the bush [m]
    fork       True: sheared in two sections; False: in one
    shear      allowed shear stress [Pa]      pressure  allowed mean pressure F / (d l) [Pa]
    bending    allowed bending stress in a fork [Pa]; default: 0.15 of the strength of C45 +QT
    wear       allowed mean of pressure times sliding speed [Pa m/s]
    bearing    rolling bearing of the catalogue instead of a bush; None: a bush
    life       required life of the bearing [s of running]
    """

    diameter: float
    length: float
    fork: bool = True
    shear: float = 60e6
    pressure: float = 15e6
    wear: float = 1e6
    bearing: str | None = None
    life: float = 0.0
    bending: float = 105e6


@record
class GivenMotion:
    """An input that follows a law of time.

    law     times -> value, speed, acceleration      period  [s]; the law repeats; None: it ends
    breaks  times at which its acceleration jumps [s], ascending; the last is the end of a law without a period
    speed   constant speed [rad/s; m/s] of which the law consists; None: another law
    """

    law: InputLaw
    period: float | None
    breaks: tuple[float, ...] = ()
    speed: float | None = None


@record
class StopEvent:
    """An event of a forward run: a quantity of the input crosses a value.

    of        "position" [rad; m], "speed" [per s] or "time" [s]      value  in SI
    terminal  the run ends there                                     direction  +1 upward, -1 downward, 0 both
    """

    name: str
    of: str
    value: float
    terminal: bool = True
    direction: int = 0


@value_record
class EndStop:
    """A stop of the input of a forward run, on the side on which it starts.

    position  [rad; m]      rebound  coefficient of restitution, 0 to 1

    A text has its unit. Raises MechanismError for a position that is not finite, and a rebound out of its bounds.

    >>> from ilmek import bar, forward_dynamics, four_bar
    >>> linkage, masses = four_bar(0.300, 0.060, 0.200, 0.230), {"crank": bar(0, 0.060, mass=0.4)}
    >>> run = forward_dynamics(linkage, masses, 0.5, speed=10, stops=[EndStop("60deg", rebound=0.5)])
    >>> [(event.name, round(event.time, 4)) for event in run.events], round(float(run.speed[-1]), 3)
    ([('end stop', 0.1047)], -5.0)
    """

    position: float
    rebound: float = 0.0
    name: str = "end stop"

    def __post_init__(self) -> None:
        given = Arguments("an end stop", MechanismError)
        object.__setattr__(self, "position", given.number("position", self.position, _unit_of(self.position)))
        object.__setattr__(self, "rebound", given.number("rebound", self.rebound))
        if not 0 <= self.rebound <= 1:
            raise MechanismError(f"rebound of an end stop is {self.rebound:g}", allowed="0 to 1")
        object.__setattr__(self, "name", given.text("name", self.name))


def _unit_of(position: object) -> str:
    """Whether a position is a length as a text: of a sliding input."""
    if isinstance(position, str):
        with suppress(UnitError):
            parse_quantity(position, "m")
            return "m"
    return "rad"


@record
class ForwardTask:
    """A forward run: from a state of the driven input, under its drive, for a duration [s].

    ratchet  the direction in which alone the input moves, +1 or -1; 0: both
    """

    duration: float
    position: float = 0.0
    speed: float = 0.0
    drive: MotorDrive | None = None
    events: tuple[StopEvent, ...] = ()
    stops: tuple[EndStop, ...] = ()
    ratchet: int = 0


@record
class SpeedStudy:
    """Speeds of the driving input at which the machine is computed [rad/s; m/s], ascending."""

    speeds: tuple[float, ...]


@record
class OwnMachine:
    """A mechanism with masses, loads, friction, members and its task.

    inertias   body -> inertia; a body that is not listed is massless
    gravity    acceleration [m/s²], complex; 0: the plane of motion is horizontal
    loads      forces, torques, springs, dampers, in the file's order
    frictions  of joints
    members    body -> its section; its strength is computed between the pins and points of the body
    pins       joint -> its pin
    motions    input -> the law that it follows; default: the constant speed of the call
    forward    a forward run; None: none
    study      speeds to compare; None: none
    servo      input for which a motor of the catalogue is chosen; None: none
    paths      each point, "body.point", whose path is drawn and listed; (): all points that are no joints
    transmission  pins at which the transmission angle is listed; (): every free pin of a dyad
    shapes     body -> the pieces whose inertia it has, where its file gives them with thickness and material
    open_masses  moving bodies whose mass the file does not give: that of their parts, once they are made
    actuators  joints with the motors, as many as inputs; (): the joints of the inputs

    Raises MechanismError for a value of another kind.

    >>> from ilmek import four_bar
    >>> OwnMachine(four_bar(0.300, 0.060, 0.200, 0.230), {"rocker": Inertia(0.4, 0.115, 0.002)}, (0, -9.81)).gravity
    -9.81j
    """

    mechanism: Mechanism
    inertias: Mapping[str, Inertia] = field(default_factory=dict)
    gravity: complex = 0j
    loads: tuple[NamedLoad, ...] = ()
    frictions: tuple[JointFriction, ...] = ()
    members: Mapping[str, FlatMember] = field(default_factory=dict)
    pins: Mapping[str, PinMember] = field(default_factory=dict)
    motions: Mapping[str, GivenMotion] = field(default_factory=dict)
    forward: ForwardTask | None = None
    study: SpeedStudy | None = None
    servo: str | None = None
    paths: tuple[tuple[str, str], ...] = ()
    transmission: tuple[str, ...] = ()
    shapes: Mapping[str, tuple[FlatShape, ...]] = field(default_factory=dict)
    open_masses: frozenset[str] = frozenset()
    actuators: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        given = Arguments("a machine", MechanismError)
        given.record("mechanism", self.mechanism, Mechanism)
        object.__setattr__(self, "gravity", gravity_vector(self.gravity))
        for name, kind in (
            ("inertias", Inertia),
            ("members", FlatMember),
            ("pins", PinMember),
            ("motions", GivenMotion),
        ):
            object.__setattr__(self, name, given.mapping(name, getattr(self, name), partial(given.record, kind=kind)))
        for body in (*self.inertias, *self.members):
            self.mechanism.body(body)
        for name, kinds in (
            ("loads", NamedLoad),
            ("frictions", (PinFriction, SlideFriction)),
            ("transmission", str),
            ("actuators", str),
        ):
            object.__setattr__(self, name, given.sequence(name, getattr(self, name), kinds))
        for name, optional in (("forward", ForwardTask), ("study", SpeedStudy), ("servo", str)):
            if getattr(self, name) is not None:
                given.record(name, getattr(self, name), optional)
        paths = given.sequence("paths", self.paths, (str, tuple, list))
        object.__setattr__(self, "paths", tuple(body_point(given, "a path", path) for path in paths))

    @property
    def has_forces(self) -> bool:
        """Whether there is anything to compute forces of: a mass, a load or friction."""
        return bool(self.inertias or self.loads or self.frictions)
