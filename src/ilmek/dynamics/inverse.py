"""Inverse dynamics: joint forces and drive efforts that a given motion requires.

For any planar mechanism with pins, slides and couplings. The equations are in `equations`. What they do not determine,
such as the tension of a belt, is NaN and named (`undetermined`); all else is computed.

Sign convention: a pin's force acts from its first on its `second` body; a slide's force and couple act from the guide
on its `body`; an input's effort acts on the driven body. The opposite acts on the other body.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ilmek.arguments import Arguments
from ilmek.arrays import BoolArray, ComplexArray, FloatArray, Int8, RealField
from ilmek.dynamics.equations import Needs, joint_pulls, loaded, needs
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.joint_friction import JointFriction, check_joints, efforts, separations
from ilmek.dynamics.loads import Load, Wrench
from ilmek.dynamics.pose_block import BLOCK, ForceAndMoment, PoseBlock, cut, part_of, pose_block, receiver
from ilmek.dynamics.undetermined import Undetermined, undetermined
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND, Joint, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.outputs import Travel, output_history
from ilmek.linkage.status import Status
from ilmek.plane.vectors import cross, dot
from ilmek.records import JsonObject, record
from ilmek.report.framed import Framed
from ilmek.units import counted, format_quantity

_GIVEN = Arguments("", MechanismError)

MASSLESS = Inertia(0.0, 0j, 0.0)


class WholeForce(NamedTuple):
    """All force [N] and moment [N m] of a joint or coupling, one value per sample."""

    force: ComplexArray
    moment: FloatArray


@record
class Forces(Framed):
    """Forces over a motion, one value per sample; NaN where the motion does not close or is at a dead centre.

    motion        the given motion
    status        `Status` of each sample: that of the motion, or NOT_CONVERGED where friction locks the mechanism
    reactions     joint -> force on the pin's second body, or across the line on the slide's body [N], complex;
                  coupling -> force on its second body [N], complex; NaN where it is not determined
    couples       slide -> couple on the slide's body [N m]
    torques       gears, belt -> torque on the second wheel about its middle [N m]
    acting        joint or coupling -> all its force [N] and moment [N m] about its point, on the same body: reaction,
                  couple, effort, friction; with each tension that is not determined at 0
    efforts       input, or actuator in its place -> torque [N m] or force along the line [N] on the driven body; NaN
                  where it is not determined
    frictions     joint with friction -> torque [N m] or force along the line [N] on the same body as its reaction
    input_power   Σ effort times its speed [W]
    load_power    power of the loads, including gravity and friction [W]
    kinetic_rate  time derivative of the kinetic energy [W]
    undetermined  what depends on the tension of belts and chains, and on redundant constraints
    actuators     joints whose efforts drive the motion; (): those of the inputs

    >>> from ilmek import bar, four_bar, inverse_dynamics, solve
    >>> motion = solve(four_bar(0.300, 0.060, 0.200, 0.230), [0.0, 0.5, 1.0], speed=15.5)
    >>> forces = inverse_dynamics(motion, {"rocker": bar(0, 0.230, mass=0.4)})
    >>> forces.effort("crank").shape, bool(abs(forces.pin("B", "rocker") + forces.pin("B", "coupler")).max() == 0)
    ((3,), True)
    """

    motion: Motion
    status: Int8[np.ndarray, " samples"]
    reactions: Mapping[str, ComplexArray]
    couples: Mapping[str, FloatArray]
    torques: Mapping[str, FloatArray]
    acting: Mapping[str, WholeForce]
    efforts: Mapping[str, FloatArray]
    frictions: Mapping[str, FloatArray]
    input_power: FloatArray
    load_power: FloatArray
    kinetic_rate: FloatArray
    undetermined: Undetermined = Undetermined()
    actuators: tuple[str, ...] = ()

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism."""
        return self.motion.plan.mechanism

    def require(self) -> "Forces":
        """The forces themselves, if the status of every sample is OK.

        Raises MechanismError that states where the mechanism does not close, or where friction locks it.
        """
        self.motion.require()
        if not self.status.any():
            return self
        locked, entry = self.status != Status.OK, self.mechanism.inputs[0]
        unit = "deg" if isinstance(entry, Rotation) else "mm"
        values = np.asarray(self.motion.drives[entry.name].value)[locked]
        first, last = (format_quantity(float(value), unit) for value in (values.min(), values.max()))
        raise MechanismError(
            f"{self.mechanism.name} is self-locking by friction at {int(locked.sum())} of {locked.size} samples, "
            f"{entry.name} from {first} to {last}: no drive effort maintains the motion",
            do="lower the friction, lengthen the guidance, or improve the transmission angle there",
        )

    def pin(self, name: str, on: str | None = None) -> ComplexArray:
        """Force in a joint [N] on body `on`, complex, one value per sample.

        on  default: the second body of a pin, the sliding body of a slide

        Raises MechanismError for an unknown joint, and for a body that it does not connect.
        """
        joint = self.mechanism.joint(name)
        body = receiver(joint) if on is None else _GIVEN.one_of(f"body at joint {name!r}", on, joint.bodies)
        return self.reactions[name] if body == receiver(joint) else -self.reactions[name]

    def tooth(self, coupling: str) -> ComplexArray:
        """Tooth force of gears or a rack [N] on the coupling's second body, at the pitch point; complex, per sample.

        Along the line of action, at the pressure angle; NaN for a belt. Raises MechanismError for an unknown coupling.
        """
        return self.reactions[_GIVEN.one_of("coupling", coupling, (mesh.name for mesh in self.mechanism.couplings))]

    def table(self) -> dict[str, FloatArray]:
        """Columns by heading: the inputs, force and couple of each joint, effort of each drive; SI and radians."""
        table: dict[str, FloatArray] = {}
        for entry in self.mechanism.inputs:
            heading = f"{entry.name} [{'rad' if isinstance(entry, Rotation) else 'm'}]"
            table[heading] = np.broadcast_to(self.motion.drives[entry.name].value, self.status.shape)
        for name, force in self.reactions.items():
            table[f"{name} Fx [N]"], table[f"{name} Fy [N]"] = force.real, force.imag
            if name in self.couples:
                table[f"{name} couple [N*m]"] = self.couples[name]
        for name, effort in self.efforts.items():
            table[f"{name} drive {'torque [N*m]' if self.turning(name) else 'force [N]'}"] = effort
        return table

    def effort(self, entry: str) -> FloatArray:
        """Torque [N m] or force [N] on the driven body, one value per sample.

        entry  name of the input: that of the driven body, or of the slide; of an actuator: its joint

        Raises MechanismError for an unknown input.
        """
        return self.efforts[_GIVEN.one_of("input", entry, self.efforts)]

    def turning(self, entry: str) -> bool:
        """Whether an input or actuator turns."""
        return isinstance(self._driven(entry), Pin)

    def rate(self, entry: str) -> FloatArray:
        """Speed of an input [rad/s; m/s], or of an actuator in its joint, one value per sample."""
        if not self.actuators:
            return np.asarray(self.motion.drives[entry].speed)
        return joint_rate(self.motion, entry)

    def acceleration(self, entry: str) -> FloatArray:
        """Acceleration of an input [rad/s²; m/s²], or of an actuator in its joint, one value per sample."""
        if not self.actuators:
            return np.asarray(self.motion.drives[entry].acceleration)
        joint = self.mechanism.joint(entry)
        if isinstance(joint, Pin):
            return np.asarray(self.motion.alpha(joint.second) - self.motion.alpha(joint.first))
        return output_history(self.motion, Travel(entry)).second_rate

    def _driven(self, entry: str) -> Joint:
        """The joint of an input or actuator."""
        joints = {drive.name: drive.joint for drive in self.mechanism.inputs}
        return self.mechanism.joint(entry if self.actuators else joints[entry])

    @property
    def power_residual(self) -> FloatArray:
        """Input power + load power - rate of the kinetic energy [W]: zero except for rounding.

        Ideal joints do no work. The sum is independent of the equations that give the joint forces.
        """
        residual: FloatArray = self.input_power + self.load_power - self.kinetic_rate
        return residual

    @property
    def power_error(self) -> float:
        """Greatest power residual, relative to the greatest sum of the powers' magnitudes [1]; NaN samples left out."""
        size = np.abs(self.input_power) + np.abs(self.load_power) + np.abs(self.kinetic_rate)
        usable = np.isfinite(size)
        top = float(np.max(size[usable], initial=0.0))
        return float(np.max(np.abs(self.power_residual[usable]), initial=0.0)) / top if top else 0.0


def inverse(
    motion: Motion,
    inertias: Mapping[str, Inertia],
    loads: Sequence[Load] = (),
    joint_frictions: Sequence[JointFriction] = (),
    *,
    side: RealField = 1.0,
    actuators: Sequence[str] = (),
) -> Forces:
    """Joint forces and drive efforts of a motion under inertia, loads and joint friction.

    motion           the given motion, with speeds and accelerations
    inertias         body -> inertia [kg, m, kg m²]; a body that is not listed is massless
    loads            loads such as `Gravity`; default: none
    joint_frictions  friction of joints, consistent with the joint forces; see `joint_friction`; default: none
    side             at a reversal of a joint with friction: +1 the forces just after it in time, -1 just before; a
                     number or one value per sample
    actuators        joints with the motors, as many as inputs; default: the joints of the inputs

    Raises MechanismError for an unknown body or joint, another number of actuators than of inputs, and for friction
    where no input moves. A single sample never raises: see `Forces.status` and `Forces.require`.
    """
    mechanism = motion.plan.mechanism
    for body in inertias:
        mechanism.body(body)
    check_joints(mechanism, joint_frictions)
    _check_actuators(mechanism, actuators)
    if joint_frictions and not any(np.any(drive.speed) for drive in motion.drives.values()):
        given = f"friction in {mechanism.name} has no direction: its inputs stand still"
        raise MechanismError(given, do="give an input a speed")
    bodies = {body: inertias.get(body, MASSLESS) for body in mechanism.moving}
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):  # rates are infinite at a dead centre
        wrenches = [wrench for load in loads for wrench in load.wrenches(motion, bodies) if wrench.body != GROUND]
        forces, missing = _empty_forces(motion, joint_frictions, actuators), Undetermined()
        for start in range(0, len(motion), BLOCK):
            part = slice(start, start + BLOCK)
            poses = pose_block(part_of(motion, part), bodies, tuple(actuators))
            acting = [wrench.part(part) for wrench in wrenches]
            needed = needs(poses, bodies, acting)
            missing |= undetermined(poses, bodies, joint_frictions)
            laws = [
                *separations(mechanism),
                *(law for law in joint_frictions if law.joint not in missing.frictions),
            ]
            forces.load_power[part] += load_power(poses, acting)
            sizes: dict[str, FloatArray] = {}
            if laws:
                sizes, locked = efforts(poses, needed, laws, cut(side, part))
                needed = loaded(poses, needed, sizes)
                _store_friction(forces, part, poses, sizes, locked)
            forces.kinetic_rate[part] = _kinetic_rate(poses, bodies)
            _store_reactions(forces, part, poses, needed, sizes)
    return _without(forces, missing) if missing else forces


def _check_actuators(mechanism: Mechanism, actuators: Sequence[str]) -> None:
    for name in actuators:
        mechanism.joint(name)
    if actuators and len(set(actuators)) != len(mechanism.inputs):
        given = f"{mechanism.name} has {counted(len(set(actuators)), 'actuator')}"
        raise MechanismError(given, allowed=f"as many as inputs: {len(mechanism.inputs)}")


def joint_rate(motion: Motion, name: str) -> FloatArray:
    """Speed in a joint [rad/s; m/s along a slide], of a pin's second body or of the sliding body, per sample."""
    joint = motion.plan.mechanism.joint(name)
    if isinstance(joint, Pin):
        return np.asarray(motion.omega(joint.second) - motion.omega(joint.first))
    return output_history(motion, Travel(name)).rate


def _empty_forces(motion: Motion, joint_frictions: Sequence[JointFriction], actuators: Sequence[str]) -> Forces:
    """Forces with arrays still to be filled."""
    mechanism, samples = motion.plan.mechanism, motion.status.shape
    joined = (*mechanism.joints, *mechanism.couplings)
    return Forces(
        motion,
        motion.status.copy(),
        reactions={joint.name: np.empty(samples, complex) for joint in joined},
        couples={joint.name: np.empty(samples) for joint in mechanism.joints if isinstance(joint, Slide)},
        torques={wheels.name: np.empty(samples) for wheels in mechanism.couplings if wheels.kind in ("gears", "belt")},
        acting={joint.name: WholeForce(np.empty(samples, complex), np.empty(samples)) for joint in joined},
        efforts={name: np.empty(samples) for name in actuators or [entry.name for entry in mechanism.inputs]},
        frictions={law.joint: np.zeros(samples) for law in joint_frictions},
        input_power=np.zeros(samples),
        load_power=np.zeros(samples),
        kinetic_rate=np.zeros(samples),
        actuators=tuple(actuators),
    )


def _without(forces: Forces, missing: Undetermined) -> Forces:
    """The forces with NaN where they are not determined."""

    def shown(arrays: Mapping[str, object], names: frozenset[str]) -> JsonObject:
        return {name: np.full_like(array, np.nan) if name in names else array for name, array in arrays.items()}

    return replace(
        forces,
        reactions=shown(forces.reactions, missing.couplings | missing.joints),
        couples=shown(forces.couples, missing.joints | missing.couples),
        efforts=shown(forces.efforts, missing.inputs),
        frictions=shown(forces.frictions, missing.frictions),
        input_power=forces.input_power if not missing.inputs else np.full_like(forces.input_power, np.nan),
        undetermined=missing,
    )


def _store_friction(
    forces: Forces, part: slice, poses: PoseBlock, sizes: Mapping[str, FloatArray], locked: BoolArray
) -> None:
    """Store the friction of a block of samples in the forces."""
    status = forces.status[part]
    status[locked & (status == Status.OK)] = Status.NOT_CONVERGED
    for name in sizes.keys() & forces.frictions.keys():
        forces.frictions[name][part] = sizes[name]
        forces.load_power[part] += sizes[name] * poses.rate(poses.joints[name])


def _store_reactions(
    forces: Forces, part: slice, poses: PoseBlock, needed: Needs, sizes: Mapping[str, FloatArray]
) -> None:
    """Solve a block of samples and store the reactions and efforts in the forces."""
    pulls = joint_pulls(poses, needed)
    failed = forces.status[part] != Status.OK
    driving: dict[str, FloatArray] = {}
    for driver, joint in poses.drivers.items():
        pull = pulls[joint.name]
        effort = np.where(failed, np.nan, joint.generalized_force(pull, joint.at))
        forces.efforts[driver][part] = effort if driver in (joint.on, joint.name) else -effort
        forces.input_power[part] += effort * poses.rate(joint)
        driving[joint.name] = effort
        pulls[joint.name] = ForceAndMoment(pull.force - effort * joint.drive.force, pull.moment)
    for name, pull in pulls.items():
        joint, size = poses.joints[name], sizes.get(name, 0.0)
        radial = 0.0 if joint.separation is None else size * joint.separation
        turned = joint.line is None and joint.tooth is None
        along = driving.get(name, 0.0) + (size if joint.separation is None else 0.0)
        forces.reactions[name][part] = np.where(failed, np.nan, pull.force + radial)
        force, moment = pull.force + radial + along * joint.drive.force, along * joint.drive.moment
        whole = forces.acting[name]
        whole.force[part] = np.where(failed, np.nan, force)
        whole.moment[part] = np.where(failed, np.nan, moment + (0.0 if turned else pull.moment))
        if name in forces.couples:
            forces.couples[name][part] = np.where(failed, np.nan, pull.moment)
        if name in forces.torques and joint.middle is not None:
            torque = pull.moment + cross(joint.at - joint.middle, pull.force)
            forces.torques[name][part] = np.where(failed, np.nan, torque)


def load_power(poses: PoseBlock, wrenches: Sequence[Wrench]) -> RealField:
    """Power of loads over a block of samples [W]."""
    power: RealField = 0.0
    for wrench in wrenches:
        velocity = poses.point_motion(wrench.body, wrench.at).velocity
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
