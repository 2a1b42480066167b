"""Inverse dynamics: the forces in the joints and the effort of the drive that a given motion needs.

For any planar mechanism of pins and slides; the equations are those of `equations`.

Sign convention: a pin's force acts on its `second` body, from the first; a slide's force and couple act on its
`body`, from the guide; an input's effort acts on the driven body, from the other one. The opposite acts on the other.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import BoolArray, ComplexArray, FloatArray, Int8, RealField
from ilmek.dynamics.equations import Needs, joint_pulls, needs
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.joint_friction import JointFriction, check_joints, frictions, loaded
from ilmek.dynamics.loads import Load, Wrench
from ilmek.dynamics.pose_block import BLOCK, ForceAndMoment, PoseBlock, cut, part_of, posed, receiver
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND, Mechanism, Rotation, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.status import Status
from ilmek.plane.vectors import dot
from ilmek.units import format_quantity

MASSLESS = Inertia(0.0, 0j, 0.0)


@dataclass(frozen=True, slots=True)
class Forces:
    """Forces over a motion, one a sample; NaN where the motion does not close or stands at a dead centre.

    motion        whose forces they are
    status        Status of each sample: the motion's, and NOT_CONVERGED where friction locks the mechanism
    reactions     joint -> force on the second body of the pin, or across the line on the slide's body [N], complex;
                  coupling -> force on its second body
    couples       slide -> couple on the slide's body [N m]
    efforts       input -> torque [N m] or force along the line [N] on the driven body
    input_power   Σ effort times speed of the drive [W]
    frictions     joint that rubs -> torque [N m] or force along the line [N] on the same body as its reaction
    load_power    power of the loads, weight and friction among them [W]
    kinetic_rate  time derivative of the kinetic energy [W]
    """

    motion: Motion
    status: Int8[np.ndarray, " samples"]
    reactions: Mapping[str, ComplexArray]
    couples: Mapping[str, FloatArray]
    efforts: Mapping[str, FloatArray]
    frictions: Mapping[str, FloatArray]
    input_power: FloatArray
    load_power: FloatArray
    kinetic_rate: FloatArray

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism."""
        return self.motion.plan.mechanism

    def require(self) -> "Forces":
        """The forces themselves, if every sample has them.

        Raises MechanismError that says where the mechanism does not close, or where friction locks it.
        """
        self.motion.require()
        if not self.status.any():
            return self
        locked, entry = self.status != Status.OK, self.mechanism.inputs[0]
        unit = "deg" if isinstance(entry, Rotation) else "mm"
        values = np.asarray(self.motion.drives[entry.name].value)[locked]
        first, last = (format_quantity(float(value), unit) for value in (values.min(), values.max()))
        raise MechanismError(
            f"{self.mechanism.name} locks itself by friction at {int(locked.sum())} of {locked.size} samples, "
            f"{entry.name} from {first} to {last}: no drive keeps up the motion",
            do="lower the friction, lengthen the guidance, or better the transmission angle there",
        )

    def pin(self, name: str, on: str | None = None) -> ComplexArray:
        """Force in a joint [N] on body `on`; unsaid: on the second body of a pin, the sliding body of a slide."""
        joint = self.mechanism.joint(name)
        if on is not None and on not in joint.bodies:
            joined = " and ".join(joint.bodies)
            raise MechanismError(f"joint {name!r} does not touch {on!r}", allowed=f"it joins {joined}")
        return self.reactions[name] if on in (None, receiver(joint)) else -self.reactions[name]

    def tooth(self, coupling: str) -> ComplexArray:
        """Force of gears or a rack [N] on the coupling's second body, in the pitch point."""
        if coupling not in {one.name for one in self.mechanism.couplings}:
            raise MechanismError(f"{self.mechanism.name} has no coupling {coupling!r}")
        return self.reactions[coupling]

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


def inverse(
    motion: Motion,
    inertias: Mapping[str, Inertia],
    loads: Sequence[Load] = (),
    rubbing: Sequence[JointFriction] = (),
    *,
    side: RealField = 1.0,
) -> Forces:
    """Joint forces and efforts of a motion, under inertia, loads and friction in the joints.

    inertias  body -> inertia; a body not named is massless
    rubbing   joints with friction, consistent with the forces that it changes; see `joint_friction`
    side      where a joint that rubs turns round: +1 the forces just after in time, -1 just before, one or one a sample

    Raises MechanismError for an unknown body or joint, and for friction where no input moves. Never fails for a sample:
    see `Forces.status` and `Forces.require`.
    """
    mechanism = motion.plan.mechanism
    for body in inertias:
        mechanism.body(body)
    check_joints(mechanism, rubbing)
    bodies = {body: inertias.get(body, MASSLESS) for body in mechanism.moving}
    wrenches = [wrench for load in loads for wrench in load.wrenches(motion, bodies) if wrench.body != GROUND]
    forces = _room(motion, rubbing)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        for start in range(0, len(motion), BLOCK):
            part = slice(start, start + BLOCK)
            poses = posed(part_of(motion, part), bodies)
            acting = [wrench.part(part) for wrench in wrenches]
            needed = needs(poses, bodies, acting)
            forces.load_power[part] += _load_power(poses, acting)
            if rubbing:
                found, locked = frictions(poses, needed, rubbing, cut(side, part))
                needed = loaded(poses, needed, found)
                _note_friction(forces, part, poses, found, locked)
            forces.kinetic_rate[part] = _kinetic_rate(poses, bodies)
            _fill(forces, part, poses, needed)
    return forces


def _room(motion: Motion, rubbing: Sequence[JointFriction]) -> Forces:
    """Forces yet to be filled in."""
    mechanism, samples = motion.plan.mechanism, len(motion)
    return Forces(
        motion,
        motion.status.copy(),
        reactions={one.name: np.empty(samples, complex) for one in (*mechanism.joints, *mechanism.couplings)},
        couples={joint.name: np.empty(samples) for joint in mechanism.joints if isinstance(joint, Slide)},
        efforts={entry.name: np.empty(samples) for entry in mechanism.inputs},
        frictions={one.joint: np.empty(samples) for one in rubbing},
        input_power=np.zeros(samples),
        load_power=np.zeros(samples),
        kinetic_rate=np.zeros(samples),
    )


def _note_friction(
    forces: Forces, part: slice, poses: PoseBlock, found: Mapping[str, FloatArray], locked: BoolArray
) -> None:
    """Write the friction of a block of samples into the forces."""
    status = forces.status[part]
    status[locked & (status == Status.OK)] = Status.NOT_CONVERGED
    for name, friction in found.items():
        forces.frictions[name][part] = friction
        forces.load_power[part] += friction * poses.rate(poses.joints[name])


def _fill(forces: Forces, part: slice, poses: PoseBlock, needed: Needs) -> None:
    """Solve a block of samples and write it into the forces."""
    pulls = joint_pulls(poses, needed)
    lost = forces.status[part] != Status.OK
    for entry in forces.mechanism.inputs:
        joint = poses.joints[entry.joint]
        pull = pulls[entry.joint]
        effort = np.where(lost, np.nan, joint.play(pull, joint.at))
        forces.efforts[entry.name][part] = effort if entry.name in (joint.on, joint.name) else -effort
        forces.input_power[part] += effort * poses.rate(joint)
        pulls[entry.joint] = ForceAndMoment(pull.force - effort * joint.drive.force, pull.moment)
    for name, pull in pulls.items():
        forces.reactions[name][part] = np.where(lost, np.nan, pull.force)
        if name in forces.couples:
            forces.couples[name][part] = np.where(lost, np.nan, pull.moment)


def _load_power(poses: PoseBlock, wrenches: Sequence[Wrench]) -> RealField:
    power: RealField = 0.0
    for wrench in wrenches:
        velocity = poses.place(wrench.body, wrench.at).velocity
        power = power + dot(wrench.force, velocity) + wrench.torque * poses.bodies[wrench.body].omega
    return power


def _kinetic_rate(poses: PoseBlock, bodies: Mapping[str, Inertia]) -> RealField:
    """d/dt Σ (m |v|² + J omega²) / 2 = Σ (m v · a + J omega alpha)."""
    rate: RealField = 0.0
    for body, inertia in bodies.items():
        moved, centre = poses.bodies[body], poses.centres[body]
        rate = rate + inertia.mass * dot(centre.velocity, centre.acceleration)
        rate = rate + inertia.moment * moved.omega * moved.alpha
    return rate
