"""A mechanism in its poses over a block of samples: what the equations of its forces are made of."""

from collections.abc import Mapping
from dataclasses import dataclass, field
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

BLOCK = 4096
"""Samples worked off at a time: more would leave the processor's cache."""


class ForceAndMoment(NamedTuple):
    """A force [N] and its moment [N m] about a point that is said where it is used: numbers, or one a sample."""

    force: ComplexField
    moment: RealField


@dataclass(frozen=True, slots=True)
class JointPoses:
    """A joint or coupling in its poses; `on` one body, `by` the other.

    at    its point [m]; of gears the pitch point     line  of a slide, the direction of its line
    tooth of a coupling, the direction of the only force that it bears, on its second body by its first
    """

    name: str
    on: str
    by: str
    at: ComplexField
    line: ComplexField | None
    tooth: ComplexField | None = None

    def play(self, pull: ForceAndMoment, about: ComplexField) -> RealField:
        """Work of a pull, its moment about a given point, on the joint's own motion: nothing but its drive resists it.

        The moment about a pin [N m], the force along a slide's line [N].
        """
        if self.line is None:
            return pull.moment + cross(about - self.at, pull.force)
        return dot(self.line, pull.force)

    @property
    def drive(self) -> ForceAndMoment:
        """A unit of the effort that drives the joint: a torque, or a force along the line."""
        return ForceAndMoment(0j, 1.0) if self.line is None else ForceAndMoment(self.line, 0.0)

    @property
    def bears(self) -> tuple[ForceAndMoment, ...]:
        """Units of what it bears by itself: two forces of a pin; across a line a force, and a couple; one of teeth."""
        if self.tooth is not None:
            return (ForceAndMoment(self.tooth, 0.0),)
        return (
            (ForceAndMoment(1 + 0j, 0.0), ForceAndMoment(1j, 0.0))
            if self.line is None
            else (ForceAndMoment(1j * self.line, 0.0), ForceAndMoment(0j, 1.0))
        )


@dataclass(frozen=True, slots=True)
class PoseBlock:
    """The bodies' motions, those of their mass centres, and the joints, by name.

    length   of the mechanism [m]: where forces and moments meet in one equation, moments are divided by it
    carried  the places computed so far
    """

    motion: Motion
    bodies: Mapping[str, BodyMotion]
    centres: Mapping[str, PointMotion]
    joints: Mapping[str, JointPoses]
    length: float
    carried: dict[tuple[str, complex], PointMotion] = field(default_factory=dict)

    def place(self, body: str, local: complex) -> PointMotion:
        """Motion of the place at `local` [m] in a body's frame; computed once."""
        if (body, local) not in self.carried:
            self.carried[body, local] = self.bodies[body].carry(local)
        return self.carried[body, local]

    def velocity(self, body: str, position: ComplexField) -> ComplexField:
        """Velocity [m/s] of the material of a body that is at a position of the world [m]."""
        moved = self.bodies[body]
        return carried_velocity(moved.anchor.velocity, position - moved.anchor.position, moved.omega)

    def rate(self, joint: JointPoses) -> RealField:
        """How fast `on` moves against `by` in the joint's own motion [rad/s, or m/s along the line]."""
        if joint.line is None:
            return self.bodies[joint.on].omega - self.bodies[joint.by].omega
        return dot(joint.line, self.velocity(joint.on, joint.at) - self.velocity(joint.by, joint.at))


def posed(motion: Motion, inertias: Mapping[str, Inertia]) -> PoseBlock:
    """The mechanism in the poses of a motion."""
    bodies: dict[str, BodyMotion] = {GROUND: STILL}
    for step in motion.plan.steps:
        bodies.update(step.place(bodies, {body: motion.columns[body] for body in step.bodies}))
    mechanism = motion.plan.mechanism
    centres = {body: bodies[body].carry(inertia.centre) for body, inertia in inertias.items()}
    return PoseBlock(
        motion,
        bodies,
        centres,
        {joint.name: _held(mechanism, joint, bodies) for joint in mechanism.joints}
        | {coupling.name: _meshed(mechanism, coupling, bodies) for coupling in mechanism.couplings},
        characteristic_length(mechanism),
        {(body, inertias[body].centre): centre for body, centre in centres.items()},
    )


def _held(mechanism: Mechanism, joint: Joint, bodies: Mapping[str, BodyMotion]) -> JointPoses:
    on = receiver(joint)
    by = next(body for body in joint.bodies if body != on)
    moved = bodies[on]
    at = moved.anchor.position + moved.direction * (mechanism.point(on, joint.name) - moved.at)
    line = None if isinstance(joint, Pin) else bodies[by].direction * unit(joint.along)
    return JointPoses(joint.name, on, by, at, line)


def _meshed(mechanism: Mechanism, coupling: Coupling, bodies: Mapping[str, BodyMotion]) -> JointPoses:
    """Gears touch in the pitch point, the pole of their turning against one another:

        P = O_1 + ratio / (ratio - 1) (O_2 - O_1),   its force across O_1 O_2;    rack: P = O_1 - i ratio f, along f

    The pressure angle's share along the line of centres does no work and is left out. Raises MechanismError for a belt,
    whose pull depends on its tension, and for gears that turn alike.
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
            allowed="a belt's depends on its tension; gears that turn alike touch nowhere",
            do="give gears of the same ratio",
        )
    way = bodies[second].carry(mechanism.point(second, two)).position - at
    pole = at + coupling.ratio / (coupling.ratio - 1) * way
    return JointPoses(coupling.name, second, first, pole, None, 1j * way / np.abs(way))


def receiver(joint: Joint) -> str:
    """The body on which a joint's force is counted: the second of a pin, the sliding one of a slide."""
    return joint.second if isinstance(joint, Pin) else joint.body


def characteristic_length(mechanism: Mechanism) -> float:
    """Greatest distance of a joint from its body's origin [m]; 1 where there is none."""
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
    """Some samples of a value given by sample; a lone number is that of every sample."""
    return value[part] if np.ndim(value) else value
