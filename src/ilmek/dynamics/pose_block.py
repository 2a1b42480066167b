"""Poses of a mechanism over a block of samples: the quantities in the equations of its forces."""

from collections.abc import Mapping
from dataclasses import field
from typing import Any, NamedTuple

import numpy as np

from ilmek.arrays import ComplexField, RealField
from ilmek.dynamics.inertia import Inertia
from ilmek.linkage.body_motion import STILL, BodyMotion, PointMotion, carried_velocity
from ilmek.linkage.geneva import Geneva
from ilmek.linkage.groups.group import InputMotion
from ilmek.linkage.model import GROUND, Coupling, Joint, Mechanism, Pin, Slide
from ilmek.linkage.motion import Motion
from ilmek.plane.vectors import cross, dot, unit
from ilmek.records import record

BLOCK = 4096
"""Samples computed at a time, so that their arrays stay in the processor's cache."""


class ForceAndMoment(NamedTuple):
    """A force [N] and its moment [N m] about a point stated at each use: numbers, or one value per sample."""

    force: ComplexField
    moment: RealField


@record
class JointPoses:
    """Poses of a joint or coupling between the bodies `on` and `by`.

    name   of the joint or coupling
    on     the body on which its force is counted; of a coupling its second
    by     the other body
    at     position [m] of the joint; of teeth the pitch point; of another coupling the middle of its first wheel
    line   of a slide: unit vector along its line; otherwise None
    tooth  of a coupling: unit force and moment about `at` that it transmits to the second body; otherwise None
    separation  unit vector in which teeth press, or a belt pulls, the second body; otherwise None
    middle      of the second wheel of a coupling [m]; otherwise None
    """

    name: str
    on: str
    by: str
    at: ComplexField
    line: ComplexField | None
    tooth: ForceAndMoment | None = None
    separation: ComplexField | None = None
    middle: ComplexField | None = None

    def point_on(self, body: str) -> ComplexField:
        """Position [m] at which the force acts on one of the two bodies: without teeth its own middle."""
        apart = self.middle is not None and self.tooth is not None and np.any(self.tooth.moment)
        return self.middle if apart and self.middle is not None and body == self.on else self.at

    def generalized_force(self, pull: ForceAndMoment, about: ComplexField) -> RealField:
        """Generalized force of a force and moment on the joint's relative motion; only a drive effort balances it.

        pull   force and moment on the body; the moment is about the point `about`
        about  position [m]

        Returns the moment about a pin [N m], or the force along a slide's line [N].
        """
        if self.line is None:
            return pull.moment + cross(about - self.at, pull.force)
        return dot(self.line, pull.force)

    @property
    def drive(self) -> ForceAndMoment:
        """Unit effort of the joint: a torque of 1 N m, a force of 1 N along the line, or one that separates teeth."""
        if self.separation is not None:
            return ForceAndMoment(self.separation, 0.0)
        return ForceAndMoment(0j, 1.0) if self.line is None else ForceAndMoment(self.line, 0.0)

    @property
    def constraint_forces(self) -> tuple[ForceAndMoment, ...]:
        """Unit constraint forces: two forces of a pin; a cross force and a couple of a slide; one of a coupling."""
        if self.tooth is not None:
            return (self.tooth,)
        return (
            (ForceAndMoment(1 + 0j, 0.0), ForceAndMoment(1j, 0.0))
            if self.line is None
            else (ForceAndMoment(1j * self.line, 0.0), ForceAndMoment(0j, 1.0))
        )


@record
class PoseBlock:
    """Motions of the bodies, of their mass centres, and poses of the joints, by name.

    length         characteristic length of the mechanism [m]; moments are divided by it in equations with forces
    actuators      joints whose efforts drive the motion; (): those of the inputs
    point_motions  motions of body points computed so far
    """

    motion: Motion
    bodies: Mapping[str, BodyMotion]
    centres: Mapping[str, PointMotion]
    joints: Mapping[str, JointPoses]
    length: float
    actuators: tuple[str, ...] = ()
    point_motions: dict[tuple[str, complex | bytes], PointMotion] = field(default_factory=dict)

    def point_motion(self, body: str, local: complex) -> PointMotion:
        """Motion of the point at `local` [m] in a body's frame; computed once."""
        key = body, _hashable(local)
        if key not in self.point_motions:
            self.point_motions[key] = self.bodies[body].carry(local)
        return self.point_motions[key]

    @property
    def drivers(self) -> dict[str, JointPoses]:
        """What drives the motion, by the name of its effort: the actuators, or without them the inputs."""
        if self.actuators:
            return {name: self.joints[name] for name in self.actuators}
        return {entry.name: self.joints[entry.joint] for entry in self.motion.plan.mechanism.inputs}

    def velocity(self, body: str, position: ComplexField) -> ComplexField:
        """Velocity [m/s] of the body's point that coincides with a position [m] in the ground frame."""
        moved = self.bodies[body]
        return carried_velocity(moved.anchor.velocity, position - moved.anchor.position, moved.omega)

    def rate(self, joint: JointPoses) -> RealField:
        """Speed of `on` relative to `by` in the joint [rad/s; m/s along the line]."""
        if joint.line is None:
            return self.bodies[joint.on].omega - self.bodies[joint.by].omega
        return dot(joint.line, self.velocity(joint.on, joint.at) - self.velocity(joint.by, joint.at))


def _hashable(local: Any) -> complex | bytes:
    """A point as a key: of several variants its bytes."""
    return local.tobytes() if isinstance(local, np.ndarray) else local


def pose_block(motion: Motion, inertias: Mapping[str, Inertia], actuators: tuple[str, ...] = ()) -> PoseBlock:
    """Poses of the mechanism at the samples of a motion; inertias: body -> inertia [kg, m, kg m²].

    motion     with accelerations, shape (samples,)
    actuators  joints whose efforts drive the motion; default: those of the inputs
    [the pole of gears is derived from the velocities of rolling pitch circles]
    """
    with np.errstate(invalid="ignore", over="ignore"):  # at a dead centre rates are infinite; `status` says so
        return _poses(motion, inertias, actuators)


def _poses(motion: Motion, inertias: Mapping[str, Inertia], actuators: tuple[str, ...]) -> PoseBlock:
    bodies: dict[str, BodyMotion] = {GROUND: STILL}
    for step in motion.plan.steps:
        bodies.update(step.locate(bodies, {body: motion.columns[body] for body in step.bodies}))
    mechanism = motion.plan.mechanism
    centres = {body: bodies[body].carry(inertia.centre) for body, inertia in inertias.items()}
    return PoseBlock(
        motion,
        bodies,
        centres,
        {joint.name: _joint_poses(mechanism, joint, bodies) for joint in mechanism.joints}
        | {coupling.name: _coupling_poses(mechanism, coupling, bodies) for coupling in mechanism.couplings},
        characteristic_length(mechanism),
        actuators,
        {(body, _hashable(inertias[body].centre)): centre for body, centre in centres.items()},
    )


def _joint_poses(mechanism: Mechanism, joint: Joint, bodies: Mapping[str, BodyMotion]) -> JointPoses:
    on = receiver(joint)
    by = next(body for body in joint.bodies if body != on)
    moved = bodies[on]
    at = moved.anchor.position + moved.direction * (mechanism.point(on, joint.name) - moved.at)
    line = None if isinstance(joint, Pin) else bodies[by].direction * unit(joint.along)
    return JointPoses(joint.name, on, by, at, line)


def _coupling_poses(mechanism: Mechanism, coupling: Coupling, bodies: Mapping[str, BodyMotion]) -> JointPoses:
    """Force of a coupling on its second body, and where it acts.

        gears  P = O_1 + i / (i - 1) (O_2 - O_1),   force across O_1 O_2     [i ratio; P pole of the relative rotation]
        rack   P = O_1 - i ratio f,                 force along f
        other  torque M on the second wheel, -i M on the first, and the force (i - 1) M / |O_1 O_2| across O_1 O_2 on
               the second that balances both                                 [a belt, a chain, wheels that turn alike]

    Teeth also separate their wheels, away from the pitch point: a wheel in a ring is pressed to the middle of the ring.
    The tension of a belt, along O_1 O_2, does no work: see `undetermined`.
    """
    if coupling.law is not None:
        return _pair_poses(mechanism, coupling, bodies)
    (first, first_middle), (second, second_middle) = coupling.ends
    at = bodies[first].carry(mechanism.point(first, first_middle)).position
    joint = mechanism.joint(second_middle) if coupling.kind == "rack" else None
    if isinstance(joint, Slide):
        line = bodies[joint.guide].direction * unit(joint.along)
        arm = -1j * coupling.ratio * line
        tooth = ForceAndMoment(line, 0.0)
        return JointPoses(coupling.name, second, first, at + arm, None, tooth, arm / abs(coupling.ratio))
    ratio, middle = coupling.ratio, bodies[second].carry(mechanism.point(second, second_middle)).position
    offset = middle - at
    distance = np.abs(offset)
    along = offset / distance
    if has_teeth(coupling):
        pole, separation = at + ratio / (ratio - 1) * offset, along if ratio < 0 else -along
        return JointPoses(coupling.name, second, first, pole, None, ForceAndMoment(1j * along, 0.0), separation, middle)
    tooth = ForceAndMoment((ratio - 1) * 1j * along, ratio * distance)
    pulled = None if coupling.spans is None else -along
    return JointPoses(coupling.name, second, first, at, None, tooth, pulled, middle)


def _pair_poses(mechanism: Mechanism, coupling: Coupling, bodies: Mapping[str, BodyMotion]) -> JointPoses:
    """Force of a higher pair on its second body, along the common normal n through the pole P of the relative motion.

    roller  centre C,  n = C - P,  P = O_1 - i f' line of a slide,  P = O_1 + f' / (f' - 1) (O_2 - O_1) of a pin
    flat    n along the slide's line, through P
    geneva  C the pin in the slot, n across C O_2; between the slots the disc locks it: across O_1 O_2 in O_1
                                                          [Aronhold and Kennedy; contact without friction]
    """
    (first, first_middle), (second, end) = coupling.ends
    start = bodies[first].carry(mechanism.point(first, first_middle)).position
    turned = np.angle(bodies[first].direction * np.conj(bodies[coupling.carrier].direction)) - coupling.first_at
    _, ratio, _, _ = coupling.transfer(turned)
    joint = mechanism.joint(end) if coupling.slides else None
    if isinstance(joint, Slide):
        line = bodies[joint.guide].direction * unit(joint.along)
        at, normal = start - 1j * ratio * line, line
        if coupling.roller:
            pole, at = at, bodies[second].carry(mechanism.point(second, coupling.roller)).position
            normal = at - pole
    else:
        offset = bodies[second].carry(mechanism.point(second, end)).position - start
        if isinstance(coupling.law, Geneva):
            arm = np.where(coupling.law.engaged(turned), coupling.law.share * unit(turned), 0.0) * offset
            at, normal = start + arm, 1j * (offset - arm)
        else:
            at = bodies[second].carry(mechanism.point(second, coupling.roller)).position
            normal = (1 - ratio) * (at - start) + ratio * offset
    return JointPoses(coupling.name, second, first, at, None, ForceAndMoment(normal / np.abs(normal), 0.0))


def has_teeth(coupling: Coupling) -> bool:
    """Whether a coupling is two bodies in mesh at a pitch point: a rack, or gears with a ratio other than 1."""
    return coupling.kind == "rack" or (coupling.kind == "gears" and coupling.ratio != 1)


def has_tension(coupling: Coupling) -> bool:
    """Whether a coupling has an open force: a belt without its spans, or wheels that turn alike."""
    return coupling.law is None and coupling.spans is None and not has_teeth(coupling)


def receiver(joint: Joint) -> str:
    """Name of the body on which a joint's force is counted: the second of a pin, the sliding body of a slide."""
    return joint.second if isinstance(joint, Pin) else joint.body


def characteristic_length(mechanism: Mechanism) -> float:
    """Greatest distance of a joint from its body's origin [m]; 1 where all distances are 0."""
    return (
        max((float(np.max(np.abs(p))) for body in mechanism.bodies for p in body.points.values()), default=1.0) or 1.0
    )


def part_of(motion: Motion, part: slice) -> Motion:
    """Some samples of a motion, as views."""
    drives = {
        name: InputMotion(cut(drive.value, part), cut(drive.speed, part), cut(drive.acceleration, part))
        for name, drive in motion.drives.items()
    }
    columns = {body: tuple(cut(field, part) for field in fields) for body, fields in motion.columns.items()}
    return Motion(motion.plan, drives, columns, motion.status[part])


def cut(value: Any, part: slice) -> Any:
    """The samples `part` of an array with one value per sample; a single number is returned unchanged."""
    return value[part] if np.ndim(value) else value
