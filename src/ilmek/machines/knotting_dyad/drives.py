"""The drives of the joints: torques of both arms over the cycle, by inverse dynamics, and the servos.

An arm is a mechanism of two inputs, at the pivot and in the elbow, with torques M1 and M2, each on the outer link from
the inner one. A belt that turns the second link from the pivot reacts on the ground instead of the first link, so that
by the power of both the pivot's servo gives M1 - M2:     M1 w1 + M2 (w2 - w1) = (M1 - M2) w1 + M2 w2
Behind gears of ratio i and efficiency e a servo of rotor inertia J gives     M / (i e) + J i a
"""

import math
from collections.abc import Mapping
from dataclasses import asdict, replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.dynamics.inverse import Forces, inverse
from ilmek.dynamics.loads import Gravity, PointForce
from ilmek.elements.motors import Motor, Reducer, smallest_motor
from ilmek.elements.reducers import RATIOS
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.machines.knotting_dyad.arms import Arm, arm_mechanism, inertias
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.jaws import Jaws, jaws_of
from ilmek.machines.knotting_dyad.motion import ArmMotion, KnotCycle, cycle_of, drive_angles
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.strength import LoadedArm, arm_strength
from ilmek.machines.linkage_strength import LinkageStrength, bore_for, smallest_pin
from ilmek.records import computed, group, record, result
from ilmek.report import Json, results_of

JOINTS = ("first link", "second link")


@record
class ArmForces:
    """An arm's torques over the cycle: of its two drives [N m], and the forces they come from, with their loads."""

    torque: Float[np.ndarray, "samples 2"]
    loaded: LoadedArm

    @property
    def forces(self) -> Forces:
        """The forces in its joints."""
        return self.loaded.forces


@record
class JointDrive:
    """A drive, for the worse of both arms: `motor` is the smallest class that is enough, None where none is."""

    joint: str = result("", "link that it turns")
    torque_max: float = result("mN*m", "greatest torque at the joint")
    torque_rms: float = result("mN*m", "root mean square of it over the cycle")
    speed_max: float = result("rad/s", "greatest speed of the joint")
    power_max: float = result("W", "greatest power at the joint")
    reducer: Reducer
    servo_torque_max: float = result("mN*m", "greatest torque of the servo, with its own rotor")
    servo_torque_rms: float = result("mN*m", "root mean square of it over the cycle")
    servo_speed: float = result("rad/s", "greatest speed of the servo")
    motor: Motor | None

    gear_ratio = computed("1", "ratio of its gears", lambda it: it.reducer.ratio)
    servo = computed("", "class of the servo", lambda it: it.motor and it.motor.name, absent="none is enough")


@record
class HeadMotion:
    """The cycle of a head in time, torques of both arms, by name, the drive of each joint, and the links' strength.

    hole  diameter of the links' holes [m]      jaws  of its grippers
    """

    cycle: KnotCycle
    arms: Mapping[str, ArmForces]
    joints: tuple[JointDrive, JointDrive]
    hole: float
    strength: LinkageStrength = group()
    jaws: Jaws = group()

    cycle_time = computed(
        "ms",
        "that the arms take of a knot, as quick as their drives allow; the rest is the head's handler, opener and sley",
        lambda it: it.cycle.period,
    )
    torque_max = computed("mN*m", "greatest torque at a joint", lambda it: max(one.torque_max for one in it.joints))

    @computed("mN*m", "greatest root mean square of the torque at a joint, over the cycle")
    def torque_rms(self) -> float:
        return max(joint.torque_rms for joint in self.joints)

    joint_speed_max = computed("rad/s", "greatest speed of a joint", lambda it: max(one.speed_max for one in it.joints))

    @computed("", "of first and second link, for the worse arm: at the joint and at its servo, SI")
    def drives(self) -> Json:
        return [{one.name: one.value for one in results_of(joint)} for joint in self.joints]

    @computed("", "servo class that is enough for every joint", absent="a joint has none")
    def servo(self) -> str | None:
        motors = [joint.motor for joint in self.joints if joint.motor]
        return max(motors, key=lambda one: one.power).name if len(motors) == len(self.joints) else None

    @computed("", "phases and grips, one after the other [s]", name="cycle")
    def parts(self) -> Json:
        return [asdict(part) for part in self.cycle.parts]

    @property
    def power_error(self) -> float:
        """Greatest power residual of the torques, over the powers' size."""
        return max(arm.forces.power_error for arm in self.arms.values())


@lru_cache(maxsize=4)
def head_motion(params: KnottingDyadParams, head: Head) -> HeadMotion:
    """The cycle of a head, and the drives that it needs: the links' holes grow until their pins bear the forces."""
    cycle = cycle_of(params, head)
    section, rate = (params.link_width, params.link_thickness), params.joint_jerk / params.joint_acceleration
    hole, needed = 0.0, smallest_pin(params.strength, params.link_width)
    while needed > hole:
        hole = needed
        arms, joints = drives_of(params, head, cycle, hole)
        loaded = [arm.loaded for arm in arms.values()]
        strength = arm_strength(loaded, cycle.time, params.strength, section, rate)
        needed = bore_for(strength.pin_diameter, params.link_width)
    if needed < hole:
        limits = replace(params.strength, pin_diameter=hole)
        strength = arm_strength(loaded, cycle.time, limits, section, rate)
    return HeadMotion(cycle, arms, joints, hole, strength, jaws_of(params, head, hole))


def drives_of(
    params: KnottingDyadParams, head: Head, cycle: KnotCycle, hole: float
) -> tuple[dict[str, ArmForces], tuple[JointDrive, JointDrive]]:
    """Torques of the arms and the drives of a head over its cycle; hole: diameter of the links' holes [m]."""
    arm = Arm(arm_mechanism(head), inertias(params, head, hole))
    arms = {name: _arm_forces(params, arm, motion) for name, motion in cycle.arms.items()}
    turned = drive_angles(params).T
    first, second = (
        _drive(
            params,
            joint,
            _Load(
                cycle.time,
                [forces.torque[:, at] for forces in arms.values()],
                [(motion.speed @ turned)[:, at] for motion in cycle.arms.values()],
                [(motion.acceleration @ turned)[:, at] for motion in cycle.arms.values()],
            ),
        )
        for at, joint in enumerate(JOINTS)
    )
    return arms, (first, second)


def _arm_forces(params: KnottingDyadParams, made: Arm, arm: ArmMotion) -> ArmForces:
    angle, speed, acceleration = (
        {"link 1": one[:, 0], "link 2": one[:, 1] - one[:, 0]} for one in (arm.angle, arm.speed, arm.acceleration)
    )
    motion = solve(plan(made.mechanism), angle, speed, acceleration).require()
    loads = (Gravity(-1j * params.gravity), PointForce("link 2.P", _pull(params, motion, arm)))
    forces = inverse(motion, made.inertias, loads)
    at_pivot, in_elbow = forces.effort("link 1"), forces.effort("link 2")
    base = at_pivot - in_elbow if params.elbow_drive == "belt" else at_pivot
    return ArmForces(np.stack([base, in_elbow], axis=1), LoadedArm(forces, made.inertias, loads))


def _pull(params: KnottingDyadParams, motion: Motion, arm: ArmMotion) -> np.ndarray:
    """Force of the yarn on the tip [N], against its motion while it leads an end."""
    velocity = np.asarray(motion.point("link 2", "P").velocity)
    speed = np.abs(velocity)
    moves = arm.leads & (speed > 0)
    return np.asarray(np.where(moves, -params.yarn_pull * velocity / np.where(speed > 0, speed, 1.0), 0j))


@record
class _Load:
    """Load of one joint's drive over the cycle, in each arm."""

    time: FloatArray
    torque: list[FloatArray]
    speed: list[FloatArray]
    acceleration: list[FloatArray]


def _drive(params: KnottingDyadParams, joint: str, load: _Load) -> JointDrive:
    """The drive of a joint: the smallest servo, behind the first gears with which it is enough."""
    ratios = RATIOS if params.gear_ratio is None else (params.gear_ratio,)
    found = [_behind(params, joint, load, Reducer(ratio, params.gear_efficiency)) for ratio in ratios]
    return min(found, key=lambda one: one.motor.power if one.motor else math.inf)


def _behind(params: KnottingDyadParams, joint: str, load: _Load, reducer: Reducer) -> JointDrive:
    """The drive of a joint behind given gears."""
    at_servo = [
        reducer.motor_torque(1.0) * torque + params.rotor_inertia * reducer.ratio * acceleration
        for torque, acceleration in zip(load.torque, load.acceleration, strict=True)
    ]
    most, lasting, speed = _most(at_servo), _rms(load.time, at_servo), _most(load.speed)
    return JointDrive(
        joint,
        torque_max=_most(load.torque),
        torque_rms=_rms(load.time, load.torque),
        speed_max=speed,
        power_max=_most([torque * rate for torque, rate in zip(load.torque, load.speed, strict=True)]),
        reducer=reducer,
        servo_torque_max=most,
        servo_torque_rms=lasting,
        servo_speed=reducer.ratio * speed,
        motor=smallest_motor(max(lasting, most / params.servo_overload), reducer.ratio * speed, "servo"),
    )


def _most(values: list[FloatArray]) -> float:
    return max(float(np.max(np.abs(one))) for one in values)


def _rms(time: FloatArray, values: list[FloatArray]) -> float:
    """The greater root mean square over the cycle."""
    return max(math.sqrt(float(np.trapezoid(one**2, time)) / float(time[-1])) for one in values)
