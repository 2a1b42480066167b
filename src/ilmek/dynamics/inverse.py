"""Inverse dynamics: the forces in the joints and the effort of the drive that a given motion needs.

For any planar mechanism of pins and slides; the equations are those of `equations`.

Sign convention: a pin's force acts on its `second` body, from the first; a slide's force and couple act on its
`body`, from the guide; an input's effort acts on the driven body, from the other one. The opposite acts on the other.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, RealField
from ilmek.dynamics.equations import joint_pulls, needs
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.loads import Load, Wrench
from ilmek.dynamics.posed import BLOCK, Posed, Pull, part_of, posed, receiver
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND, Mechanism, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.status import Status
from ilmek.plane.vectors import dot

MASSLESS = Inertia(0.0, 0j, 0.0)


@dataclass(frozen=True, slots=True)
class Forces:
    """Forces over a motion, one a sample; NaN where the motion does not close or stands at a dead centre.

    reactions     joint -> force on the second body of the pin, or across the line on the slide's body [N], complex
    couples       slide -> couple on the slide's body [N m]
    efforts       input -> torque [N m] or force along the line [N] on the driven body
    input_power   Σ effort times speed of the drive [W]
    load_power    power of the loads, weight among them [W]
    kinetic_rate  time derivative of the kinetic energy [W]
    """

    mechanism: Mechanism
    reactions: Mapping[str, ComplexArray]
    couples: Mapping[str, FloatArray]
    efforts: Mapping[str, FloatArray]
    input_power: FloatArray
    load_power: FloatArray
    kinetic_rate: FloatArray

    def pin(self, name: str, on: str | None = None) -> ComplexArray:
        """Force in a joint [N] on body `on`; unsaid: on the second body of a pin, the sliding body of a slide."""
        joint = self.mechanism.joint(name)
        if on is not None and on not in joint.bodies:
            joined = " and ".join(joint.bodies)
            raise MechanismError(f"joint {name!r} does not touch {on!r}", allowed=f"it joins {joined}")
        return self.reactions[name] if on in (None, receiver(joint)) else -self.reactions[name]

    def effort(self, entry: str) -> FloatArray:
        """Torque [N m] or force [N] on the driven body, by the name of the input: that of the body, or of the slide."""
        if entry not in self.efforts:
            raise MechanismError(f"no input {entry!r}", allowed=f"inputs: {', '.join(self.efforts)}")
        return self.efforts[entry]

    @property
    def power_residual(self) -> FloatArray:
        """Input power + load power - rate of the kinetic energy [W]: zero but for rounding, at every instant.

        Joints do no work; the sum is formed without the equations that gave the forces in them.
        """
        residual: FloatArray = self.input_power + self.load_power - self.kinetic_rate
        return residual

    @property
    def power_error(self) -> float:
        """Greatest power residual over the greatest sum of the powers' sizes; samples that are NaN are left out."""
        size = np.abs(self.input_power) + np.abs(self.load_power) + np.abs(self.kinetic_rate)
        usable = np.isfinite(size)
        top = float(np.max(size[usable], initial=0.0))
        return float(np.max(np.abs(self.power_residual[usable]), initial=0.0)) / top if top else 0.0


def inverse(motion: Motion, inertias: Mapping[str, Inertia], loads: Sequence[Load] = ()) -> Forces:
    """Joint forces and efforts of a motion, under inertia and loads.

    inertias  body -> inertia; a body not named is massless. Raises MechanismError for an unknown body.
    """
    mechanism = motion.plan.mechanism
    for body in inertias:
        mechanism.body(body)
    bodies = {body: inertias.get(body, MASSLESS) for body in mechanism.moving}
    wrenches = [wrench for load in loads for wrench in load.wrenches(motion, bodies) if wrench.body != GROUND]
    forces = _room(mechanism, len(motion))
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        for start in range(0, len(motion), BLOCK):
            part = slice(start, start + BLOCK)
            poses = posed(part_of(motion, part), bodies)
            _fill(forces, part, poses, bodies, [wrench.part(part) for wrench in wrenches])
    return forces


def _room(mechanism: Mechanism, samples: int) -> Forces:
    """Forces yet to be filled in."""
    return Forces(
        mechanism,
        reactions={joint.name: np.empty(samples, complex) for joint in mechanism.joints},
        couples={joint.name: np.empty(samples) for joint in mechanism.joints if isinstance(joint, Slide)},
        efforts={entry.name: np.empty(samples) for entry in mechanism.inputs},
        input_power=np.zeros(samples),
        load_power=np.zeros(samples),
        kinetic_rate=np.zeros(samples),
    )


def _fill(forces: Forces, part: slice, poses: Posed, bodies: Mapping[str, Inertia], wrenches: Sequence[Wrench]) -> None:
    """Solve a block of samples and write it into the forces."""
    pulls = joint_pulls(poses, needs(poses, bodies, wrenches))
    lost = poses.motion.status != Status.OK
    for entry in forces.mechanism.inputs:
        joint = poses.joints[entry.joint]
        pull = pulls[entry.joint]
        effort = np.where(lost, np.nan, joint.play(pull, joint.at))
        forces.efforts[entry.name][part] = effort if entry.name in (joint.on, joint.name) else -effort
        forces.input_power[part] += effort * poses.rate(joint)
        pulls[entry.joint] = Pull(pull.force - effort * joint.drive.force, pull.moment)
    for name, pull in pulls.items():
        forces.reactions[name][part] = np.where(lost, np.nan, pull.force)
        if name in forces.couples:
            forces.couples[name][part] = np.where(lost, np.nan, pull.moment)
    forces.load_power[part] = _load_power(poses, wrenches)
    forces.kinetic_rate[part] = _kinetic_rate(poses, bodies)


def _load_power(poses: Posed, wrenches: Sequence[Wrench]) -> RealField:
    power: RealField = 0.0
    for wrench in wrenches:
        velocity = poses.place(wrench.body, wrench.at).velocity
        power = power + dot(wrench.force, velocity) + wrench.torque * poses.bodies[wrench.body].omega
    return power


def _kinetic_rate(poses: Posed, bodies: Mapping[str, Inertia]) -> RealField:
    """d/dt Σ (m |v|² + J omega²) / 2 = Σ (m v · a + J omega alpha)."""
    rate: RealField = 0.0
    for body, inertia in bodies.items():
        moved, centre = poses.bodies[body], poses.centres[body]
        rate = rate + inertia.mass * dot(centre.velocity, centre.acceleration)
        rate = rate + inertia.moment * moved.omega * moved.alpha
    return rate
