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
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ilmek.arrays import BoolArray, ComplexField, FloatArray, RealField
from ilmek.dynamics.equations import Needs, joint_pulls, loaded
from ilmek.dynamics.friction import OFFSET
from ilmek.dynamics.pose_block import ForceAndMoment, JointPoses, PoseBlock, has_teeth
from ilmek.errors import MechanismError
from ilmek.linkage.body_motion import carried_acceleration
from ilmek.linkage.couplings import BeltSpans
from ilmek.linkage.model import Mechanism, Pin, Slide
from ilmek.num.linear import solve_many
from ilmek.plane.vectors import cross, dot

MAX_ITERATIONS = 50
TOLERANCE = 1e-12
"""Relative residual of a friction effort against the friction limit of its joint."""


@dataclass(frozen=True, slots=True)
class PinFriction:
    """Friction of a pin.

    joint  name      radius  of the pin [m]      coefficient  mu [1]      drag  viscous, c [N m s]

    Raises MechanismError for values that are negative or not finite.
    """

    joint: str
    radius: float
    coefficient: float
    drag: float = 0.0

    def __post_init__(self) -> None:
        _require(self.joint, radius=self.radius, coefficient=self.coefficient, drag=self.drag)

    @property
    def dry(self) -> bool:
        """Whether it depends on the force of its joint."""
        return self.coefficient * self.radius > 0

    def limit(self, joint: JointPoses, pull: ForceAndMoment) -> RealField:  # noqa: ARG002
        """Greatest torque of Coulomb friction [N m] under the pin force: mu r |F|."""
        return self.coefficient * self.radius * np.abs(pull.force)

    def limit_change(self, joint: JointPoses, pull: ForceAndMoment, change: ForceAndMoment) -> RealField:  # noqa: ARG002
        """Derivative of `limit` [N m] in the direction of a change of the joint force."""
        return self.coefficient * self.radius * _size_change(pull.force, change.force)


@dataclass(frozen=True, slots=True)
class SlideFriction:
    """Friction of a slide.

    joint  name      breadth  length b of the guide along the line [m]      coefficient  mu [1]
    drag   viscous, c [N s/m]

    The guide extends by b / 2 to either side of the body's point with the slide's name. Raises MechanismError for
    values that are negative or not finite, and a breadth of 0.
    """

    joint: str
    breadth: float
    coefficient: float
    drag: float = 0.0

    def __post_init__(self) -> None:
        _require(self.joint, coefficient=self.coefficient, drag=self.drag)
        if not (math.isfinite(self.breadth) and self.breadth > 0):
            raise MechanismError(f"breadth of slide {self.joint!r} is {self.breadth:g} m", allowed="finite and above 0")

    @property
    def dry(self) -> bool:
        """Whether it depends on the force of its joint."""
        return self.coefficient > 0

    def limit(self, joint: JointPoses, pull: ForceAndMoment) -> RealField:
        """Greatest force of Coulomb friction [N] under the slide's force and couple: mu max(|N|, 2 |C| / b)."""
        across, couple = self._parts(joint, pull)
        return self.coefficient * np.maximum(np.abs(across), np.abs(couple))

    def limit_change(self, joint: JointPoses, pull: ForceAndMoment, change: ForceAndMoment) -> RealField:
        """Derivative of `limit` [N] in the direction of a change of the joint force and couple."""
        across, couple = self._parts(joint, pull)
        to_across, to_couple = self._parts(joint, change)
        leaning = np.abs(across) >= np.abs(couple)
        return self.coefficient * np.where(leaning, np.sign(across) * to_across, np.sign(couple) * to_couple)

    def _parts(self, joint: JointPoses, pull: ForceAndMoment) -> tuple[RealField, RealField]:
        """N and 2 C / b."""
        line = joint.line if joint.line is not None else 1 + 0j
        return dot(1j * line, pull.force), 2 * pull.moment / self.breadth


@dataclass(frozen=True, slots=True)
class ToothSeparation:
    """The force that separates teeth in mesh; joint: name of the coupling, pressure_angle: alpha [rad]."""

    joint: str
    pressure_angle: float
    drag: float = 0.0

    def limit(self, joint: JointPoses, pull: ForceAndMoment) -> RealField:  # noqa: ARG002
        """The force F_r [N] under the force along the pitch line."""
        return math.tan(self.pressure_angle) * np.abs(pull.force)

    def limit_change(self, joint: JointPoses, pull: ForceAndMoment, change: ForceAndMoment) -> RealField:  # noqa: ARG002
        """Derivative of `limit` [N] in the direction of a change of the force along the pitch line."""
        return math.tan(self.pressure_angle) * _size_change(pull.force, change.force)


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

    def limit(self, joint: JointPoses, pull: ForceAndMoment) -> RealField:
        """The force F [N]."""
        return np.maximum(2 * self.spans.pretension, np.abs(self.difference(joint, pull))) * self._along(joint)

    def limit_change(self, joint: JointPoses, pull: ForceAndMoment, change: ForceAndMoment) -> RealField:
        """Derivative of `limit` [N] in the direction of a change of the force and moment."""
        apart = self.difference(joint, pull)
        slack = np.abs(apart) > 2 * self.spans.pretension
        return np.where(slack, np.sign(apart) * self.difference(joint, change), 0.0) * self._along(joint)

    def difference(self, joint: JointPoses, pull: ForceAndMoment) -> RealField:
        """M_2 / r_2 [N]: the difference of the forces in the spans."""
        assert joint.middle is not None
        return (pull.moment + cross(joint.at - joint.middle, pull.force)) * abs(self.ratio) / self.spans.radius

    def _along(self, joint: JointPoses) -> RealField:
        assert joint.middle is not None
        along: RealField = np.sqrt(1 - self.spans.lean(self.ratio, np.abs(joint.middle - joint.at)) ** 2)
        return along


JointFriction: TypeAlias = PinFriction | SlideFriction

EffortLaw: TypeAlias = JointFriction | ToothSeparation | SpanTension
"""The law of an effort that depends on the forces of its joint."""


def separations(mechanism: Mechanism) -> Iterator[ToothSeparation | SpanTension]:
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
    separating = np.array([[isinstance(law, ToothSeparation | SpanTension)] for law in laws])
    rates = np.stack([np.broadcast_to(poses.rate(joint), samples) for joint in joints])
    viscous = -np.array([[law.drag] for law in laws]) * rates
    rest = loaded(poses, needed, dict(zip((law.joint for law in laws), viscous, strict=True)))
    unloaded = joint_pulls(poses, rest)
    nothing = {body: ForceAndMoment(0j, 0.0) for body in needed}
    responses = [joint_pulls(poses, loaded(poses, nothing, {joint.name: np.ones(samples)})) for joint in joints]
    signs = np.full(rates.shape, -1.0)
    if not separating.all():
        second = np.stack([_second_rate(poses, joint) for joint in joints])
        signs = np.where(separating, signs, np.sign(rates + _time_offset(poses, side) * second))
    sizes, locked = _consistent(joints, laws, signs, unloaded, responses)
    return {law.joint: size for law, size in zip(laws, viscous + sizes, strict=True)}, locked


def _consistent(
    joints: Sequence[JointPoses],
    laws: Sequence[EffortLaw],
    signs: FloatArray,
    unloaded: Mapping[str, ForceAndMoment],
    responses: Sequence[Mapping[str, ForceAndMoment]],
) -> tuple[FloatArray, BoolArray]:
    """Efforts, one row per joint, and the locked samples; Newton's method on all samples at once."""
    x = np.zeros_like(signs)
    greatest = np.zeros_like(signs)
    for _ in range(MAX_ITERATIONS):
        pulls = [_sum(unloaded[joint.name], [unit[joint.name] for unit in responses], x) for joint in joints]
        rows = list(zip(laws, joints, pulls, strict=True))
        limits = np.stack([law.limit(joint, pull) for law, joint, pull in rows])
        greatest = np.fmax(greatest, limits)
        residual = x + signs * limits
        slopes = [[law.limit_change(joint, pull, unit[joint.name]) for unit in responses] for law, joint, pull in rows]
        matrix = np.eye(len(joints)) + np.moveaxis(signs[:, None] * np.array(slopes), -1, 0)
        off = np.abs(residual) > TOLERANCE * greatest
        if not off.any():
            break
        x = x - solve_many(matrix, np.ascontiguousarray(residual.T)).T
    joined = np.linalg.det(np.where(np.isfinite(matrix), matrix, 0.0)) > 0
    locked: BoolArray = off.any(axis=0) | ~joined | ~np.isfinite(x).all(axis=0)
    return np.where(locked, np.nan, x), locked


def _sum(rest: ForceAndMoment, responses: Sequence[ForceAndMoment], x: FloatArray) -> ForceAndMoment:
    force = rest.force + sum(size * response.force for size, response in zip(x, responses, strict=True))
    return ForceAndMoment(
        force, rest.moment + sum(size * response.moment for size, response in zip(x, responses, strict=True))
    )


def _size_change(force: ComplexField, change: ComplexField) -> RealField:
    """Derivative of |F| in the direction of a change of F; 0 at F = 0."""
    size = np.abs(force)
    return np.divide(dot(force, change), size, out=np.zeros(np.shape(size)), where=size > 0)


def _time_offset(poses: PoseBlock, side: RealField) -> RealField:
    """Time before or after an instant at which the direction of friction is evaluated [s].

    Where all inputs rest, any time: the accelerations give the direction in which the joints begin to move, or stopped.
    """
    speeds = [np.abs(np.asarray(drive.speed, dtype=float)) for drive in poses.motion.drives.values()]
    fastest = np.asarray(sum(speeds))
    offset: RealField = np.asarray(side) * OFFSET / np.where(fastest > 0, fastest, 1.0)
    return offset


def _second_rate(poses: PoseBlock, joint: JointPoses) -> FloatArray:
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


def _require(joint: str, **sizes: float) -> None:
    for name, size in sizes.items():
        if not (math.isfinite(size) and size >= 0):
            raise MechanismError(f"{name} of joint {joint!r} is {size:g}", allowed="finite and not negative")
