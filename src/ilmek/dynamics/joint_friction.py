"""Efforts in joints that follow from the joint forces: friction in pins and slides, separation of teeth.

    pin      T = -mu r |F| sgn(omega) - c omega                        F pin force, r pin radius
    slide    F = -mu (|N_1| + |N_2|) sgn(v) - c v                      N_1, N_2 at the ends of a guide of length b
             N_1,2 = N / 2 +- C / b,   |N_1| + |N_2| = max(|N|, 2 |C| / b)
                                                                       N force across the line, C couple
    teeth    F_r = |F_t| tan alpha                                     F_t along the pitch line, alpha pressure angle

Friction is consistent with the joint forces that it changes. F_r separates the two bodies, whichever flank carries;
it does no work, but loads bearings and guides, and so their friction.

The joint forces are linear in the friction efforts x: F = F_0 + Σ x_k G_k, with G_k the response to a unit effort. So
x + sgn mu |F(x)| = 0 is solved by Newton's method, with one unknown per joint with friction. Where it has no solution,
no drive effort maintains the motion: the mechanism is self-locking. A solution that is not connected to the
frictionless one as mu grows from 0 (the determinant of the Jacobian has changed its sign) counts as self-locking too.
[Coulomb's law; the guide's end forces and the criterion are derived here; teeth: Shigley, chapter 13]
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ilmek.arguments import Arguments
from ilmek.arrays import BoolArray, Float, FloatArray, RealField
from ilmek.dynamics.equations import Needs, Pulls, joint_pulls, loaded
from ilmek.dynamics.friction import OFFSET
from ilmek.dynamics.pose_block import ForceAndMoment, JointPoses, PoseBlock, has_teeth
from ilmek.errors import MechanismError
from ilmek.linkage.body_motion import carried_acceleration
from ilmek.linkage.couplings import BeltSpans
from ilmek.linkage.model import Mechanism, Pin, Slide
from ilmek.num.linear import solve_many
from ilmek.plane.vectors import cross, dot

Components: TypeAlias = tuple[RealField, RealField]
"""Two linear functions of a joint force [N]; friction is a factor times their size: |F| of a pin and of teeth, the
greater of both in a slide and a belt. `given` is 1 of a joint force, 0 of a change of one."""

MAX_ITERATIONS = 50
TOLERANCE = 1e-12
"""Relative residual of a friction effort against the friction limit of its joint."""


@dataclass(frozen=True, slots=True)
class PinFriction:
    """Friction of a pin.

    joint  name      radius  of the pin [m]      coefficient  mu [1]      drag  viscous, c [N m s]

    Raises MechanismError for values that are negative or not finite.

    >>> PinFriction("B", "12mm", 0.1).radius
    0.012
    """

    joint: str
    radius: float
    coefficient: float
    drag: float = 0.0

    def __post_init__(self) -> None:
        _read(self, radius="m", coefficient="", drag="N*m*s")

    @property
    def dry(self) -> bool:
        """Whether it depends on the force of its joint."""
        return self.coefficient * self.radius > 0

    @property
    def factor(self) -> float:
        """Of the size of the pin force: mu r [m]."""
        return self.coefficient * self.radius

    def components(self, joint: JointPoses, pull: ForceAndMoment, given: float = 1.0) -> Components:  # noqa: ARG002
        """The pin force F [N]."""
        return np.real(pull.force), np.imag(pull.force)


@dataclass(frozen=True, slots=True)
class SlideFriction:
    """Friction of a slide.

    joint  name      breadth  length b of the guide along the line [m]      coefficient  mu [1]
    drag   viscous, c [N s/m]

    The guide extends by b / 2 to either side of the body's point with the slide's name. Raises MechanismError for
    values that are negative or not finite, and a breadth of 0.

    >>> SlideFriction("line", "80mm", 0.1).breadth
    0.08
    """

    joint: str
    breadth: float
    coefficient: float
    drag: float = 0.0

    def __post_init__(self) -> None:
        _read(self, breadth="m", coefficient="", drag="N*s/m")
        if self.breadth == 0:
            raise MechanismError(f"breadth of slide {self.joint!r} is 0 m", allowed="above 0")

    @property
    def dry(self) -> bool:
        """Whether it depends on the force of its joint."""
        return self.coefficient > 0

    @property
    def factor(self) -> float:
        """Of the force on the guide: mu [1]."""
        return self.coefficient

    def components(self, joint: JointPoses, pull: ForceAndMoment, given: float = 1.0) -> Components:  # noqa: ARG002
        """N and 2 C / b [N]."""
        line = joint.line if joint.line is not None else 1 + 0j
        return dot(1j * line, pull.force), 2 * pull.moment / self.breadth


@dataclass(frozen=True, slots=True)
class ToothSeparation:
    """The force that separates teeth in mesh; joint: name of the coupling, pressure_angle: alpha [rad]."""

    joint: str
    pressure_angle: float
    drag: float = 0.0

    @property
    def factor(self) -> float:
        """Of the force along the pitch line: tan alpha [1]."""
        return math.tan(self.pressure_angle)

    def components(self, joint: JointPoses, pull: ForceAndMoment, given: float = 1.0) -> Components:  # noqa: ARG002
        """The force along the pitch line [N]."""
        return np.real(pull.force), np.imag(pull.force)


@dataclass(frozen=True, slots=True)
class SpanTension:
    """The force with which the spans of a belt pull its pulleys together.

        F = max(2 T_0, |M_2| / r_2) cos alpha     [N], the sum of both spans along the line of centres

    T_0 pretension, M_2 torque on the second pulley; where it exceeds 2 T_0 r_2 one span is slack, as of a chain.
    [sum and difference of the forces in the spans]
    """

    joint: str
    spans: BeltSpans
    ratio: float
    drag: float = 0.0

    @property
    def factor(self) -> float:
        """1: the force is the greater component."""
        return 1.0

    def components(self, joint: JointPoses, pull: ForceAndMoment, given: float = 1.0) -> Components:
        """M_2 / r_2 cos alpha, the difference of the forces in the spans, and 2 T_0 cos alpha [N]."""
        assert joint.middle is not None
        torque = pull.moment + cross(joint.at - joint.middle, pull.force)
        along = self._along(joint)
        return torque * abs(self.ratio) / self.spans.radius * along, given * 2 * self.spans.pretension * along

    def _along(self, joint: JointPoses) -> RealField:
        assert joint.middle is not None
        along: RealField = np.sqrt(1 - self.spans.lean(self.ratio, np.abs(joint.middle - joint.at)) ** 2)
        return along


JointFriction: TypeAlias = PinFriction | SlideFriction

Separation: TypeAlias = ToothSeparation | SpanTension

EffortLaw: TypeAlias = JointFriction | Separation
"""The law of an effort that depends on the forces of its joint."""


def separations(mechanism: Mechanism) -> Iterator[Separation]:
    """The laws of all teeth in mesh with a pressure angle, and of all belts with given spans."""
    for mesh in mechanism.couplings:
        if has_teeth(mesh) and mesh.pressure_angle:
            yield ToothSeparation(mesh.name, mesh.pressure_angle)
        if mesh.spans is not None:
            yield SpanTension(mesh.name, mesh.spans, mesh.ratio)


def check_joints(mechanism: Mechanism, joint_frictions: Sequence[JointFriction]) -> None:
    """Raise MechanismError for friction in a joint that is unknown, of the other kind, or given twice."""
    for law in joint_frictions:
        joint, required = mechanism.joint(law.joint), Pin if isinstance(law, PinFriction) else Slide
        if not isinstance(joint, required):
            raise MechanismError(
                f"{type(law).__name__} is given for {law.joint!r}, a {type(joint).__name__.lower()}",
                allowed=f"it is for a {required.__name__.lower()}",
            )
        if sum(other.joint == law.joint for other in joint_frictions) > 1:
            raise MechanismError(f"friction in joint {law.joint!r} is given twice", do="give it once")


def efforts(
    poses: PoseBlock, needed: Needs, laws: Sequence[EffortLaw], side: RealField
) -> tuple[dict[str, FloatArray], BoolArray]:
    """Efforts of joints by their laws, and the samples at which the mechanism is self-locking.

    poses   the block of samples
    needed  forces and moments that the bodies require without these efforts
    laws    friction of joints, and separation of teeth
    side    at a reversal of a joint: +1 just after it in time, -1 just before; a number or one per sample

    Returns joint -> torque [N m] or force along the line [N] on its `on` body, coupling -> force [N] that separates
    its teeth, one value per sample, NaN where locked; and the locked samples. Where a joint has neither speed nor
    acceleration its friction is 0: at rest, a force up to its limit may act in either direction.
    """
    samples = poses.motion.status.shape[0]
    joints = [poses.joints[law.joint] for law in laws]
    separating = np.array([[isinstance(law, Separation)] for law in laws])
    rates = np.stack([np.broadcast_to(poses.rate(joint), samples) for joint in joints])
    viscous = -np.array([[law.drag] for law in laws]) * rates
    rest = loaded(poses, needed, dict(zip((law.joint for law in laws), viscous, strict=True)))
    start = components(joints, laws, joint_pulls(poses, rest), samples)
    nothing = {body: ForceAndMoment(0j, 0.0) for body in needed}
    units = [loaded(poses, nothing, {joint.name: np.ones(samples)}) for joint in joints]
    responses = np.stack([components(joints, laws, joint_pulls(poses, unit), samples, 0.0) for unit in units])
    signs = np.full(rates.shape, -1.0)
    if not separating.all():
        second = np.stack([second_rate(poses, joint) for joint in joints])
        signs = np.where(separating, signs, np.sign(rates + _time_offset(poses, side) * second))
    sizes, locked = consistent(laws, signs, start, responses)
    return {law.joint: size for law, size in zip(laws, viscous + sizes, strict=True)}, locked


def components(
    joints: Sequence[JointPoses], laws: Sequence[EffortLaw], pulls: Pulls, samples: int, given: float = 1.0
) -> Float[np.ndarray, "laws 2 samples"]:
    """Components of the joint forces of all laws [N]; given: 0 where the forces are changes."""
    found = np.empty((len(laws), 2, samples))
    for row, joint, law in zip(found, joints, laws, strict=True):
        row[0], row[1] = law.components(joint, pulls[joint.name], given)
    return found


def consistent(
    laws: Sequence[EffortLaw],
    signs: Float[np.ndarray, "laws samples"],
    start: Float[np.ndarray, "laws 2 samples"],
    responses: Float[np.ndarray, "laws laws 2 samples"],
) -> tuple[Float[np.ndarray, "laws samples"], BoolArray]:
    """Efforts, and the locked samples, shape (samples,); Newton's method on all samples at once.

    signs      of the speeds in the joints; -1 of a separation
    start      components of the joint forces without these efforts
    responses  their changes by a unit effort of the first law
    """
    factors = np.array([[law.factor] for law in laws])
    greater = np.array([[isinstance(law, SlideFriction | SpanTension)] for law in laws])
    x, greatest = np.zeros_like(signs), np.zeros_like(signs)
    for _ in range(MAX_ITERATIONS):
        at = start + np.einsum("ks,klcs->lcs", x, responses)
        first, second = np.abs(at[:, 0]), np.abs(at[:, 1])
        size = np.where(greater, np.maximum(first, second), np.hypot(first, second))
        leads = np.where(greater, first >= second, np.divide(first, size, out=np.zeros_like(size), where=size > 0))
        trails = np.where(greater, first < second, np.divide(second, size, out=np.zeros_like(size), where=size > 0))
        along = np.stack((np.sign(at[:, 0]) * leads, np.sign(at[:, 1]) * trails), axis=1)
        slopes = factors * np.einsum("lcs,klcs->kls", along, responses)
        greatest = np.fmax(greatest, factors * size)
        residual = x + signs * factors * size
        matrix = np.eye(len(laws)) + np.moveaxis(signs * slopes, (0, 1, 2), (2, 1, 0))
        off = np.abs(residual) > TOLERANCE * greatest
        if not off.any():
            break
        x = x - solve_many(matrix, np.ascontiguousarray(residual.T)).T
    joined = np.linalg.det(np.where(np.isfinite(matrix), matrix, 0.0)) > 0
    locked: BoolArray = off.any(axis=0) | ~joined | ~np.isfinite(x).all(axis=0)
    return np.where(locked, np.nan, x), locked


def _time_offset(poses: PoseBlock, side: RealField) -> RealField:
    """Time before or after an instant at which the direction of friction is evaluated [s].

    Where all inputs rest, any time: the accelerations give the direction in which the joints begin to move, or stopped.
    """
    speeds = [np.abs(np.asarray(drive.speed, dtype=float)) for drive in poses.motion.drives.values()]
    fastest = np.asarray(sum(speeds))
    offset: RealField = np.asarray(side) * OFFSET / np.where(fastest > 0, fastest, 1.0)
    return offset


def second_rate(poses: PoseBlock, joint: JointPoses) -> FloatArray:
    """Time derivative of the joint's rate where the rate is zero [rad/s²; m/s²]."""
    on, by = poses.bodies[joint.on], poses.bodies[joint.by]
    if joint.line is None:
        second = on.alpha - by.alpha
    else:
        first, other = (
            carried_acceleration(moved.anchor.acceleration, joint.at - moved.anchor.position, moved.omega, moved.alpha)
            for moved in (on, by)
        )
        second = dot(joint.line, first - other)
    return np.broadcast_to(np.asarray(second, dtype=float), poses.motion.status.shape)


def _read(law: JointFriction, **units: str) -> None:
    """Convert the quantities of a friction. Raises MechanismError for one that is negative or not finite."""
    given = Arguments("friction of a joint", MechanismError)
    object.__setattr__(law, "joint", given.text("joint", law.joint))
    given = Arguments(f"joint {law.joint!r}", MechanismError)
    for name, unit in units.items():
        object.__setattr__(law, name, given.not_negative(name, getattr(law, name), unit))
