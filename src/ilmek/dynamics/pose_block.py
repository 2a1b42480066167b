"""Poses of a mechanism over a block of samples: the quantities in the equations of its forces."""

from collections.abc import Mapping
from dataclasses import field
from typing import Any, NamedTuple

import numpy as np

from ilmek.arrays import ComplexField, RealField
from ilmek.dynamics.inertia import Inertia
from ilmek.errors import MechanismError
from ilmek.linkage.body_motion import STILL, BodyMotion, PointMotion, carried_velocity
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
    at     position [m] of the joint; of gears the pitch point
    line   of a slide: unit vector along its line; otherwise None
    tooth  of a coupling: unit vector of its force on the second body; otherwise None
    """

    name: str
    on: str
    by: str
    at: ComplexField
    line: ComplexField | None
    tooth: ComplexField | None = None

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
        """Unit drive effort of the joint: a torque of 1 N m, or a force of 1 N along the line."""
        return ForceAndMoment(0j, 1.0) if self.line is None else ForceAndMoment(self.line, 0.0)

    @property
    def constraint_forces(self) -> tuple[ForceAndMoment, ...]:
        """Unit constraint forces: two forces of a pin; a cross force and a couple of a slide; one force of teeth."""
        if self.tooth is not None:
            return (ForceAndMoment(self.tooth, 0.0),)
        return (
            (ForceAndMoment(1 + 0j, 0.0), ForceAndMoment(1j, 0.0))
            if self.line is None
            else (ForceAndMoment(1j * self.line, 0.0), ForceAndMoment(0j, 1.0))
        )


@record
class PoseBlock:
    """Motions of the bodies, of their mass centres, and poses of the joints, by name.

    length         characteristic length of the mechanism [m]; moments are divided by it in equations with forces
    point_motions  motions of body points computed so far
    """

    motion: Motion
    bodies: Mapping[str, BodyMotion]
    centres: Mapping[str, PointMotion]
    joints: Mapping[str, JointPoses]
    length: float
    point_motions: dict[tuple[str, complex], PointMotion] = field(default_factory=dict)

    def point_motion(self, body: str, local: complex) -> PointMotion:
        """Motion of the point at `local` [m] in a body's frame; computed once."""
        if (body, local) not in self.point_motions:
            self.point_motions[body, local] = self.bodies[body].carry(local)
        return self.point_motions[body, local]

    def velocity(self, body: str, position: ComplexField) -> ComplexField:
        """Velocity [m/s] of the body's point that coincides with a position [m] in the ground frame."""
        moved = self.bodies[body]
        return carried_velocity(moved.anchor.velocity, position - moved.anchor.position, moved.omega)

    def rate(self, joint: JointPoses) -> RealField:
        """Speed of `on` relative to `by` in the joint [rad/s; m/s along the line]."""
        if joint.line is None:
            return self.bodies[joint.on].omega - self.bodies[joint.by].omega
        return dot(joint.line, self.velocity(joint.on, joint.at) - self.velocity(joint.by, joint.at))


def pose_block(motion: Motion, inertias: Mapping[str, Inertia]) -> PoseBlock:
    """Poses of the mechanism at the samples of a motion; inertias: body -> inertia [kg, m, kg m²].

    motion  with accelerations, shape (samples,)
    Raises MechanismError where the force of a coupling is not determined: a belt, or gears of ratio 1.
    [the pole of gears is derived from the velocities of rolling pitch circles]
    """
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
        {(body, inertias[body].centre): centre for body, centre in centres.items()},
    )


def _joint_poses(mechanism: Mechanism, joint: Joint, bodies: Mapping[str, BodyMotion]) -> JointPoses:
    on = receiver(joint)
    by = next(body for body in joint.bodies if body != on)
    moved = bodies[on]
    at = moved.anchor.position + moved.direction * (mechanism.point(on, joint.name) - moved.at)
    line = None if isinstance(joint, Pin) else bodies[by].direction * unit(joint.along)
    return JointPoses(joint.name, on, by, at, line)


def _coupling_poses(mechanism: Mechanism, coupling: Coupling, bodies: Mapping[str, BodyMotion]) -> JointPoses:
    """Pitch point of a gear pair, the pole of the relative rotation, and the direction of its force.

        gears  P = O_1 + ratio / (ratio - 1) (O_2 - O_1),   force across O_1 O_2
        rack   P = O_1 - i ratio f,                         force along f

    The component along the line of centres, due to the pressure angle, does no work and is left out. Raises
    MechanismError for a belt, because its forces depend on its tension, and for gears with a ratio of 1.
    """
    (first, one), (second, two) = coupling.first, coupling.second
    at = bodies[first].carry(mechanism.point(first, one)).position
    joint = mechanism.joint(two) if coupling.kind == "rack" else None
    if isinstance(joint, Slide):
        line = bodies[joint.guide].direction * unit(joint.along)
        return JointPoses(coupling.name, second, first, at - 1j * coupling.ratio * line, None, line)
    if coupling.kind == "belt" or coupling.ratio == 1:
        raise MechanismError(
            f"the force of {coupling.kind} {coupling.name!r} of {mechanism.name} is not determined",
            allowed="gears with a ratio other than 1, or a rack; the force of a belt depends on its tension",
            do="give gears of the same ratio",
        )
    offset = bodies[second].carry(mechanism.point(second, two)).position - at
    pole = at + coupling.ratio / (coupling.ratio - 1) * offset
    return JointPoses(coupling.name, second, first, pole, None, 1j * offset / np.abs(offset))


def receiver(joint: Joint) -> str:
    """Name of the body on which a joint's force is counted: the second of a pin, the sliding body of a slide."""
    return joint.second if isinstance(joint, Pin) else joint.body


def characteristic_length(mechanism: Mechanism) -> float:
    """Greatest distance of a joint from its body's origin [m]; 1 where all distances are 0."""
    return max((abs(point) for body in mechanism.bodies for point in body.points.values()), default=1.0) or 1.0


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
