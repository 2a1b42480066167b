"""Definition of a general planar multibody system, and its conversion to the arrays of the compiled kernels.

Equations and sources are in `multibody.kernel`; SI units and radians.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import scipy

from ilmek.dynamics.clearance import ClearancePin
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.multibody.contact import FLIGHT
from ilmek.dynamics.multibody.kernel import Model
from ilmek.dynamics.springs import Spring
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND, Body, Joint, Pin, Slide
from ilmek.linkage.motion import Motion
from ilmek.plane.vectors import unit
from ilmek.records import record


@dataclass(frozen=True, slots=True)
class BodyState:
    """State of a body's frame: origin [m], angle [rad], velocity of the origin [m/s], omega [rad/s]."""

    origin: complex
    angle: float = 0.0
    velocity: complex = 0j
    omega: float = 0.0


@dataclass(frozen=True, slots=True)
class BodyForce:
    """A constant force [N], in directions of the ground frame, at a named point of a body."""

    body: str
    point: str
    force: complex


@dataclass(frozen=True, slots=True)
class BodyTorque:
    """A torque on a body, torque - drag omega [N m, N m s]: for example a linear motor characteristic."""

    body: str
    torque: float
    drag: float = 0.0


@record
class System:
    """Bodies with masses, the joints between them, the loads, and the initial state.

    bodies    including the ground, as in `Mechanism`
    joints    pins, slides, pins with clearance; they may be redundant
    inertias  body -> inertia for every moving body, mass and moment above 0
    poses     body -> initial state for every moving body
    gravity   acceleration [m/s²], complex, such as -9.81j; default: 0
    loads     springs, forces, torques; default: none
    order     moving bodies in the order of the arrays (computed)

    Raises MechanismError for unknown or missing names, a body without mass or moment of inertia, and values that are
    not finite.
    """

    bodies: tuple[Body, ...]
    joints: tuple[Joint | ClearancePin, ...]
    inertias: Mapping[str, Inertia]
    poses: Mapping[str, BodyState]
    gravity: complex = 0j
    loads: Sequence[Spring | BodyForce | BodyTorque] = ()
    name: str = "system"
    order: tuple[str, ...] = field(init=False)

    def __post_init__(self) -> None:
        moving = [body.name for body in self.bodies if body.name != GROUND]
        if len(set(moving)) < len(moving) or not moving:
            raise MechanismError(f"{self.name} has bodies {', '.join(moving) or 'none'}", allowed="each name once")
        for name in moving:
            self._check(name)
        object.__setattr__(self, "order", _narrow_band_order(moving, self.joints))
        for joint in self.joints:
            if joint.bodies[0] == joint.bodies[1]:
                raise MechanismError(f"joint {joint.name!r} of {self.name} joins {joint.bodies[0]!r} to itself")
            for body in joint.bodies:
                self.point(body, joint.name)
        if not np.isfinite(self.gravity):
            raise MechanismError(f"gravity of {self.name} is {self.gravity}", allowed="a finite acceleration in m/s²")
        for load in self.loads:
            _check_load(self, load)

    @property
    def pins(self) -> tuple[Pin, ...]:
        """The pins without clearance."""
        return tuple(joint for joint in self.joints if isinstance(joint, Pin))

    @property
    def slides(self) -> tuple[Slide, ...]:
        """The slides."""
        return tuple(joint for joint in self.joints if isinstance(joint, Slide))

    @property
    def rigid(self) -> tuple[Joint, ...]:
        """The joints without clearance in the order of their equations: pins, then slides."""
        return (*self.pins, *self.slides)

    @property
    def clearances(self) -> tuple[ClearancePin, ...]:
        """The pins with clearance."""
        return tuple(joint for joint in self.joints if isinstance(joint, ClearancePin))

    def clearance(self, name: str) -> ClearancePin:
        """The pin with clearance of a name; raises MechanismError for an unknown name."""
        found = {pin.name: pin for pin in self.clearances}
        if name not in found:
            known = ", ".join(found) or "none"
            raise MechanismError(f"{self.name} has no pin with clearance {name!r}", allowed=f"it has {known}")
        return found[name]

    def _check(self, name: str) -> None:
        inertia, pose = self.inertias.get(name), self.poses.get(name)
        if inertia is None or pose is None:
            raise MechanismError(f"body {name!r} of {self.name} has no {'pose' if inertia else 'inertia'}")
        if not (inertia.mass > 0 and inertia.moment > 0):
            raise MechanismError(
                f"body {name!r} of {self.name} has mass {inertia.mass:g} kg, moment {inertia.moment:g} kg m²",
                allowed="both above 0",
                do="give it both, or combine it with a neighbour as one body",
            )
        if not np.all(np.isfinite([pose.origin, pose.angle, pose.velocity, pose.omega])):
            raise MechanismError(f"the pose of body {name!r} of {self.name} is {pose}", allowed="finite numbers")

    def point(self, body: str, point: str) -> complex:
        """Position of a body's point in the body's frame [m]; raises MechanismError for unknown names."""
        points = {one.name: one.points for one in self.bodies}
        if body not in points:
            raise MechanismError(f"{self.name} has no body {body!r}", allowed=f"it has {', '.join(points)}")
        if point not in points[body]:
            raise MechanismError(
                f"body {body!r} of {self.name} has no point {point!r}", allowed=f"it has {', '.join(points[body])}"
            )
        return points[body][point]

    def arm(self, body: str, point: str) -> complex:
        """Position of a body's point relative to the mass centre [m]; for the ground, relative to its origin."""
        return self.point(body, point) - (0j if body == GROUND else self.inertias[body].centre)


def with_clearance(system: System, *clearances: ClearancePin) -> System:
    """The system with some of its pins replaced by pins with clearance of the same names.

    Raises MechanismError for a name without a pin.
    """
    names = [pin.name for pin in system.pins]
    for pin in clearances:
        if pin.name not in names:
            raise MechanismError(
                f"{system.name} has no pin {pin.name!r}", allowed=f"it has {', '.join(names) or 'none'}"
            )
    by_name = {pin.name: pin for pin in clearances}
    return replace(system, joints=tuple(by_name.get(joint.name, joint) for joint in system.joints))


def from_motion(
    motion: Motion,
    inertias: Mapping[str, Inertia],
    *,
    gravity: complex = 0j,
    loads: Sequence[Spring | BodyForce | BodyTorque] = (),
) -> System:
    """The system of a mechanism with free inputs; its initial state is the first sample of a motion.

    motion    of the mechanism       inertias  body -> inertia of every moving body
    gravity   acceleration [m/s²], complex      loads  springs, forces, torques

    Raises MechanismError where the motion fails, for couplings, which a system does not support, and as `System` does.
    """
    mechanism = motion.require().plan.mechanism
    if mechanism.couplings:
        raise MechanismError(
            f"{mechanism.name} has a coupling {mechanism.couplings[0].name!r}",
            allowed="a general system has pins and slides",
            do="use the reduced equation: `dynamics.forward`",
        )
    for body in inertias:
        mechanism.body(body)
    poses = {}
    for body in mechanism.moving:
        origin = motion.carried(body, 0j)
        angle, omega = float(motion.angle(body)[0]), float(motion.omega(body)[0])
        poses[body] = BodyState(complex(origin.position[0]), angle, complex(origin.velocity[0]), omega)
    return System(mechanism.bodies, mechanism.joints, inertias, poses, gravity, loads, mechanism.name)


def _narrow_band_order(moving: Sequence[str], joints: Sequence[Joint | ClearancePin]) -> tuple[str, ...]:
    """Bodies in an order that gives the matrix a narrow band [reverse Cuthill-McKee]."""
    index = {name: k for k, name in enumerate(moving)}
    pairs = [
        (index[a], index[b]) for joint in joints for a, b in [joint.bodies, joint.bodies[::-1]] if {a, b} <= set(index)
    ]
    rows, columns = np.array(pairs, dtype=int).reshape(-1, 2).T
    graph = scipy.sparse.coo_array((np.ones(len(rows)), (rows, columns)), shape=(len(moving), len(moving))).tocsr()
    return tuple(moving[k] for k in scipy.sparse.csgraph.reverse_cuthill_mckee(graph, symmetric_mode=True))


def model_arrays(system: System) -> Model:
    """The system as arrays."""
    index = {name: k for k, name in enumerate(system.order)} | {GROUND: -1}
    loose = system.clearances
    springs = [load for load in system.loads if isinstance(load, Spring)]
    forces = [load for load in system.loads if isinstance(load, BodyForce)]
    joint_bodies = [[index[body] for body in joint.bodies] for joint in system.rigid for _ in range(2)]
    apart = [abs(a - b) for a, b in joint_bodies if min(a, b) >= 0]
    inertias = [system.inertias[name] for name in system.order]
    ends = [[(body, joint.name) for body in joint.bodies] for joint in system.rigid]
    ends += [list(spring.ends) for spring in springs]
    ends += [[(force.body, force.point)] * 2 for force in forces]
    ends += [[(body, pin.name) for body in pin.bodies] for pin in loose]
    numbers = [(0.0, 0.0, 0.0) for _ in system.pins] + [
        (slide.along, _relative_angle(system, slide), 0.0) for slide in system.slides
    ]
    numbers += [(spring.stiffness, spring.length, spring.damping) for spring in springs]
    numbers += [(complex(force.force).real, complex(force.force).imag, 0.0) for force in forces]
    return Model(
        masses=np.array([value for inertia in inertias for value in (inertia.mass, inertia.mass, inertia.moment)]),
        gravity=complex(system.gravity),
        ends=_pairs([[index[body] for body, _ in pair] for pair in ends]),
        arms=np.array([[system.arm(*end) for end in pair] for pair in ends], dtype=complex).reshape(-1, 2),
        numbers=np.array(numbers, dtype=float).reshape(-1, 3),
        pins=len(system.pins),
        slides=len(system.slides),
        springs=len(springs),
        forces=len(forces),
        contacts=np.array([_contact(system, pin) for pin in loose], dtype=float).reshape(-1, 8),
        torques=_torques(system),
        joint_bodies=_pairs(joint_bodies),
        length=_length(system),
        band=min(3 * max(apart, default=0) + 2, 3 * len(system.order) - 1),
    )


def start_state(system: System) -> np.ndarray:
    """Initial state: positions and velocities of the mass centres, no work, no contact."""
    row = np.full(6 * len(system.order) + 1 + len(system.clearances), FLIGHT)
    row[6 * len(system.order)] = 0.0
    half = 3 * len(system.order)
    for k, name in enumerate(system.order):
        pose, arm = system.poses[name], system.inertias[name].centre * unit(system.poses[name].angle)
        centre, velocity = complex(pose.origin + arm), complex(pose.velocity + 1j * pose.omega * arm)
        row[3 * k : 3 * k + 3] = centre.real, centre.imag, pose.angle
        row[half + 3 * k : half + 3 * k + 3] = velocity.real, velocity.imag, pose.omega
    return row


def _contact(system: System, pin: ClearancePin) -> tuple[float, ...]:
    series = 1 / sum(1 / system.inertias[body].mass for body in pin.bodies if body != GROUND)
    law = pin.stiffness, pin.exponent, pin.hysteresis
    return *law, pin.radius, pin.clearance, pin.friction, pin.slip, series


def _check_load(system: System, load: Spring | BodyForce | BodyTorque) -> None:
    """Raise MechanismError for a load on an unknown body or point, and for values that are not finite."""
    if isinstance(load, Spring):
        ends, numbers = list(load.ends), [load.stiffness, load.length]
        numbers.append(load.damping)
    elif isinstance(load, BodyForce):
        ends, numbers = [(load.body, load.point)], [abs(load.force)]
    else:
        ends, numbers = [], [load.torque, load.drag]
        if load.body not in system.order:
            known = ", ".join(system.order)
            raise MechanismError(f"a torque of {system.name} acts on {load.body!r}", allowed=f"it has {known}")
    for end in ends:
        system.point(*end)
    if not np.all(np.isfinite(numbers)):
        raise MechanismError(f"a load of {system.name} is {load}", allowed="finite numbers")


def _relative_angle(system: System, slide: Slide) -> float:
    """Constant relative angle of a slide [rad], with the number of full turns of the initial poses."""
    body, guide = (system.poses[name].angle if name != GROUND else 0.0 for name in slide.bodies)
    turns = round((body - guide - slide.turned) / (2 * np.pi))
    return slide.turned + turns * 2 * np.pi


def _torques(system: System) -> np.ndarray:
    torques = np.zeros((len(system.order), 2))
    for load in system.loads:
        if isinstance(load, BodyTorque):
            torques[system.order.index(load.body)] += load.torque, load.drag
    return torques


def _length(system: System) -> float:
    """Greatest distance of a joint from its body's mass centre [m]; 1 where all distances are 0."""
    arms = [abs(system.arm(body, joint.name)) for joint in system.joints for body in joint.bodies if body != GROUND]
    return max(arms, default=1.0) or 1.0


def _pairs(found: Sequence[Sequence[int]]) -> np.ndarray:
    return np.array(found, dtype=np.int64).reshape(-1, 2)
