"""Records of a mechanism as the linkage editor draws it: structure, motion, forces. SI and radians."""

from dataclasses import dataclass, field

from ilmek.io.mechanism.moved_joint import FileChange


@dataclass(frozen=True, slots=True)
class LinkageFault:
    """What is wrong with a mechanism: what was found, what is allowed, what to do."""

    given: str
    allowed: str = ""
    do: str = ""


@dataclass(frozen=True, eq=False, slots=True)
class BodyAnswer:
    """A body: its points in its own frame [m], by name, and whether it is located by the groups found so far."""

    name: str
    points: dict[str, tuple[float, float]]
    solved: bool


@dataclass(frozen=True, slots=True)
class JointAnswer:
    """A joint of two bodies.

    name    a pin of several bodies is divided: `M` and `M.BODY`      file_joint  its name in the file
    kind    "pin" or "slide"      bodies  of a slide the sliding body and its guide
    along   direction of a slide's line in the guide's frame [rad]
    turned  angle of the sliding body against the guide [rad]
    """

    name: str
    file_joint: str
    kind: str
    bodies: tuple[str, str]
    along: float = 0.0
    turned: float = 0.0


@dataclass(frozen=True, slots=True)
class CouplingAnswer:
    """Gears, a belt or a rack: kind, its bodies and the points in the middle of the wheels, ratio."""

    name: str
    kind: str
    first: tuple[str, str]
    second: tuple[str, str]
    carrier: str
    ratio: float


@dataclass(frozen=True, slots=True)
class GroupAnswer:
    """An Assur group, or a driven body.

    kind    "input", "gears", "dyad" or "general"      symbol  of a dyad its joints, R turning, P sliding, like "RRP"
    bodies, joints  its members; joints to known bodies are among them
    branch  sign of a dyad that has two assemblies; 0: it has one      free  the joint of that sign
    drawn   whether the coordinates as drawn fix that sign
    """

    kind: str
    symbol: str
    bodies: tuple[str, ...]
    joints: tuple[str, ...]
    description: str
    branch: int = 0
    free: str = ""
    drawn: bool = False


@dataclass(frozen=True, slots=True)
class InputAnswer:
    """An input: name in `fixed` and `over`, driven joint of the file, kind "rotation" or "displacement"."""

    name: str
    joint: str
    kind: str


@dataclass(frozen=True, slots=True)
class Structure:
    """The structure of a mechanism that may be unfinished.

    degrees_of_freedom  by count, 3 bodies - 2 joints - couplings      driven  number of inputs
    loops    independent loops, joints + couplings - bodies + connected parts
    groups   in the order of solution      left    bodies that no group holds      loose  bodies without a joint
    missing  why there are no more groups; None: all bodies are located
    """

    degrees_of_freedom: int
    driven: int
    loops: int
    groups: tuple[GroupAnswer, ...]
    left: tuple[str, ...]
    loose: tuple[str, ...]
    missing: LinkageFault | None


@dataclass(frozen=True, eq=False, slots=True)
class VectorSeries:
    """A vector over the samples; None where there is none."""

    x: list[float | None]
    y: list[float | None]


@dataclass(frozen=True, slots=True)
class Rates:
    """Velocity [m/s] and acceleration [m/s²] of a point."""

    velocity: VectorSeries
    acceleration: VectorSeries


@dataclass(frozen=True, eq=False, slots=True)
class PoseSeries:
    """A body over the samples: origin of its frame [m] and angle [rad]."""

    x: list[float | None]
    y: list[float | None]
    angle: list[float | None]


@dataclass(frozen=True, slots=True)
class DeadCentreAnswer:
    """A value of the input at which it reverses [rad; m], and the bodies that are in line there."""

    value: float
    bodies: tuple[str, ...]


@dataclass(frozen=True, eq=False, slots=True)
class ForceSeries:
    """Forces over the samples, with what they depend on.

    joints   joint -> force on the pin's second body, or on the slide's body [N]
    effort   of the drive [N m; N]      shaking  force of the moving masses on the frame [N]
    """

    joints: dict[str, VectorSeries]
    effort: list[float | None]
    shaking: VectorSeries


@dataclass(frozen=True, eq=False, slots=True)
class MotionAnswer:
    """The motion of all located bodies over the range of the driving input.

    driving       name of the input; "": all inputs are fixed      kind  "rotation" or "displacement"
    values        of the input [rad; m]      speed  constant speed [rad/s; m/s]; None: it follows a law of time
    status        by sample: 0 OK, 1 cannot close, 2 dead centre, 3 not converged
    fault         why it does not close everywhere, with the range and a remedy
    poses         body -> its pose      points  body -> points that are no joints or joints by the first body
    transmission  pin -> acute transmission angle [rad]
    closing       ranges of the input in which it closes [rad; m]      dead_centres  ends at which the input reverses
    change_points values at which two assemblies meet [rad; m]
    rates         body -> point -> velocity and acceleration; only if required
    forces        only if required, and if the file has masses, loads or friction; else `no_forces` states why not
    """

    driving: str
    kind: str
    values: list[float | None]
    speed: float | None
    status: list[int]
    fault: LinkageFault | None
    poses: dict[str, PoseSeries]
    points: dict[str, dict[str, VectorSeries]]
    transmission: dict[str, list[float | None]]
    closing: tuple[tuple[float, float], ...] = ()
    dead_centres: tuple[DeadCentreAnswer, ...] = ()
    change_points: tuple[float, ...] = ()
    rates: dict[str, dict[str, Rates]] = field(default_factory=dict)
    forces: ForceSeries | None = None
    no_forces: str = ""


@dataclass(frozen=True, eq=False, slots=True)
class MechanismAnswer:
    """A mechanism as drawn.

    poses    of the moving bodies that no motion holds: origin [m] and angle [rad]
    no_motion  why there is no motion
    changes  of the file: of a dragged joint, and branches that the drawing shows and the file lacks
    values   of the inputs in the dragged pose [rad; m]
    refused  the first entry that cannot be read; it is left out, with those that depend on it
    """

    name: str
    bodies: tuple[BodyAnswer, ...]
    joints: tuple[JointAnswer, ...]
    couplings: tuple[CouplingAnswer, ...]
    inputs: tuple[InputAnswer, ...]
    structure: Structure
    poses: dict[str, tuple[float, float, float]]
    motion: MotionAnswer | None
    no_motion: LinkageFault | None = None
    changes: tuple[FileChange, ...] = ()
    values: dict[str, float] = field(default_factory=dict)
    refused: LinkageFault | None = None
