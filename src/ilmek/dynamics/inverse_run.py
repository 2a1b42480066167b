"""Inverse run of an own machine: joint forces, drive efforts, shaking force and work over given motions.

    work of a drive  W = ∫ M dq,    power  P = M dq/dt      [M effort on the input q; trapezoidal rule over the samples]

Two tests of the computation come with it. The power balance compares drives, loads and kinetic energy. The balance of
the whole compares the force on the frame, summed over joints and drives, with loads and inertia of the moving bodies:

    F_frame = Σ F_load - Σ m a_G,    M_frame = Σ M_load - Σ ((G x m a_G) + J alpha)     [Newton and Euler; about O]
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.balance import Shaking, on_frame, shaking
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import MASSLESS, Forces, inverse, joint_rate, plain
from ilmek.dynamics.loads import Gravity, Load
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.dynamics.pose_block import characteristic_length
from ilmek.linkage.model import GROUND, Pin
from ilmek.linkage.motion import Motion
from ilmek.linkage.status import Status
from ilmek.plane.vectors import cross
from ilmek.records import computed, record, result

ABOUT = 0j
"""Point about which the shaking moment is reported: the ground's origin."""

ROUNDING, NO_WORK = 1e-12, 1e-6
"""Mean effort and work of the drive, relative to their magnitudes, that count as zero."""


@record
class InverseRun:
    """Forces of a machine over a motion, one value per sample.

    driving  name of the driving input; None: all inputs are fixed
    time     of the samples [s]; None: the input stands still
    forces   joint forces, efforts, powers        shaking  force and moment on the frame by the moving masses
    frame    force and moment of all joints and drives on the frame, with gravity and loads
    balance  greatest misfit of the frame's force and moment against loads and inertia, relative [1]
    """

    driving: str | None
    time: FloatArray | None
    forces: Forces
    shaking: Shaking
    frame: Shaking
    balance: float = result(
        "1", "greatest misfit of the forces on the frame, relative", name="frame_residual", shown=False
    )

    @property
    def locked(self) -> np.ndarray:
        """Samples at which friction locks the mechanism."""
        return np.asarray((self.forces.status != Status.OK) & (self.forces.motion.status == Status.OK))

    @property
    def driver(self) -> str | None:
        """Name of the effort that drives: of the driving input, or of the actuator in its place; None without one."""
        names = (entry.name for entry in self.forces.mechanism.inputs)
        return dict(zip(names, self.forces.efforts, strict=True)).get(self.driving or "")

    @property
    def turning(self) -> bool:
        """Whether the drive turns."""
        return self.driver is not None and self.forces.turning(self.driver)

    @property
    def effort(self) -> FloatArray | None:
        """Effort of the drive [N m; N]; None without one."""
        return None if self.driver is None else self.forces.effort(self.driver)

    @property
    def peak(self) -> float | None:
        """Greatest effort of the drive [N m; N]; None without one."""
        return None if self.effort is None else greatest(self.effort)

    def _drive(self, turning: bool, kind: str) -> float | None:
        """Peak, rms or mean of the driving effort, if the input is of that kind."""
        effort = self.effort
        if effort is None or self.turning is not turning:
            return None
        if kind == "peak":
            return greatest(effort)
        value = rms(effort, self.time) if kind == "rms" else mean(effort, self.time)
        return plain(np.where(np.abs(value) <= ROUNDING * greatest(effort), 0.0, value))

    @computed("N", "greatest force of each pin", shown=False)
    def pin_forces_max(self) -> dict[str, float]:
        pins = (joint.name for joint in self.forces.mechanism.joints if isinstance(joint, Pin))
        return {name: greatest(self.forces.reactions[name]) for name in pins}

    @computed("N", "greatest force of each slide across its line", shown=False)
    def slide_forces_max(self) -> dict[str, float]:
        return {name: greatest(self.forces.reactions[name]) for name in self.forces.couples}

    @computed("N*m", "greatest couple of each slide on its body", shown=False)
    def slide_couples_max(self) -> dict[str, float]:
        return {name: greatest(couple) for name, couple in self.forces.couples.items()}

    @computed("N", "greatest tooth force of each coupling", shown=False)
    def tooth_forces_max(self) -> dict[str, float]:
        return {mesh.name: greatest(self.forces.tooth(mesh.name)) for mesh in self.forces.mechanism.couplings}

    @computed("N*m", "greatest torque of gears and belts on the second wheel", shown=False)
    def coupling_torques_max(self) -> dict[str, float]:
        return {name: greatest(torque) for name, torque in self.forces.torques.items()}

    @computed("", "forces and drives not determined: by the tension of a belt, by a redundant constraint", shown=False)
    def undetermined(self) -> list[str]:
        return self.forces.undetermined.listed

    drive_torque_max = computed(
        "N*m",
        "greatest torque of the drive",
        lambda it: it._drive(True, "peak"),
        absent="the input slides, or is fixed",
    )
    drive_torque_rms = computed("N*m", "root mean square of it", lambda it: it._drive(True, "rms"), optional=True)
    drive_torque_mean = computed("N*m", "its mean over time", lambda it: it._drive(True, "mean"), optional=True)
    drive_force_max = computed("N", "greatest force of the drive", lambda it: it._drive(False, "peak"), optional=True)
    drive_force_rms = computed("N", "root mean square of it", lambda it: it._drive(False, "rms"), optional=True)
    drive_force_mean = computed("N", "its mean over time", lambda it: it._drive(False, "mean"), optional=True)

    @computed("J", "work of the drive over the run", optional=True)
    def drive_work(self) -> float | None:
        if self.effort is None:
            return None
        if self.time is None:
            drive = self.forces.motion.drives.get(str(self.driver))
            return None if drive is None else plain(np.trapezoid(self.effort, np.asarray(drive.value)))
        power = self.effort * self.forces.rate(str(self.driver))
        # Samples may run against time: over a descending range, or at a negative speed.
        work = np.sign(self.time[-1] - self.time[0]) * np.trapezoid(power, self.time)
        small = np.abs(work) < NO_WORK * np.abs(np.trapezoid(np.abs(power), self.time))
        return plain(np.where(small, 0.0, work))

    @computed("W", "greatest power of the drives", optional=True)
    def drive_power_max(self) -> float | None:
        return greatest(self.forces.input_power) if self.time is not None else None

    @computed("W", "mean power lost to friction of joints", optional=True)
    def friction_power_mean(self) -> float | None:
        lost = friction_power(self.forces)
        return None if lost is None or self.time is None else mean(lost, self.time)

    @computed("N", "greatest shaking force on the frame, by the moving masses")
    def shaking_force_max(self) -> float:
        return greatest(self.shaking.force)

    @computed("N*m", "greatest shaking moment about the ground's origin")
    def shaking_moment_max(self) -> float:
        return greatest(self.shaking.moment)

    @computed("N", "greatest force of all joints and drives on the frame, with gravity and loads")
    def frame_force_max(self) -> float:
        return greatest(self.frame.force)

    @computed("1", "greatest residual of the power balance, relative", shown=False)
    def power_residual(self) -> float:
        return self.forces.power_error


def inverse_run(machine: OwnMachine, motion: Motion, driving: str | None, time: FloatArray | None) -> InverseRun:
    """Forces of a machine over a motion.

    motion   with speeds and accelerations      driving  name of the driving input; None: all inputs are fixed
    time     of the samples [s], ascending; None: the inputs stand still, and the friction of joints is left out

    Raises MechanismError as `inverse`, for unknown bodies or joints, and for a load over time without one.
    """
    loads, motion = all_loads(machine), replace(motion, time=time)
    moves = any(np.any(np.asarray(drive.speed) != 0) for drive in motion.drives.values())
    forces = inverse(motion, machine.inertias, loads, machine.frictions if moves else (), actuators=machine.actuators)
    shaken, frame = shaking(motion, machine.inertias, ABOUT), on_frame(forces, ABOUT)
    return InverseRun(driving, time, forces, shaken, frame, _misfit(forces, frame, shaken, loads, machine.inertias))


def all_loads(machine: OwnMachine) -> list[Load]:
    """The loads of a machine, gravity included."""
    weight: list[Load] = [Gravity(machine.gravity)] if machine.gravity else []
    return weight + [load.load for load in machine.loads]


def friction_power(forces: Forces) -> FloatArray | None:
    """Power lost to the friction of joints [W], one value per sample; None without friction."""
    if not forces.frictions:
        return None
    total = np.zeros(forces.motion.status.shape)
    for name, effort in forces.frictions.items():
        total = total - effort * joint_rate(forces.motion, name)
    return total


def _misfit(
    forces: Forces, frame: Shaking, shaken: Shaking, loads: list[Load], inertias: Mapping[str, Inertia]
) -> float:
    """Greatest difference between the force on the frame and loads plus inertia, relative to the joint forces."""
    motion, mechanism = forces.motion, forces.mechanism
    force, moment = np.array(shaken.force), np.array(shaken.moment)
    bodies = {body: inertias.get(body, MASSLESS) for body in mechanism.moving}
    size, turn_size = np.abs(force), np.abs(moment)
    with np.errstate(invalid="ignore", over="ignore"):
        for load in loads:
            for wrench in load.wrenches(motion, bodies):
                if wrench.body != GROUND:
                    at = motion.carried(wrench.body, wrench.at).position
                    turning = cross(at - ABOUT, np.asarray(wrench.force)) + wrench.torque
                    force, moment = force + wrench.force, moment + turning
                    size, turn_size = size + np.abs(wrench.force), turn_size + np.abs(turning)
        for force_of_joint, _ in forces.acting.values():
            size = size + np.abs(force_of_joint)
        reach = characteristic_length(mechanism)
        sizes = np.array([greatest(size), greatest(turn_size) + reach * greatest(size)])
        gaps = np.array([greatest(frame.force - force), greatest(frame.moment - moment)])
    usable = np.isfinite(gaps) & np.isfinite(sizes) & (sizes > 0)
    return plain(np.max(np.divide(gaps, sizes, where=usable, out=np.zeros(gaps.shape)), axis=0))


def greatest(values: np.ndarray) -> float:
    """Greatest magnitude of the finite samples; NaN without any. Of several variants, as all of these, one of each.

    >>> greatest(np.array([1.0, -3.0, np.nan]))
    3.0
    """
    size = np.abs(values)
    return plain(np.fmax.reduce(np.where(np.isfinite(size), size, np.nan), axis=-1, initial=np.nan))


def mean(values: FloatArray, time: FloatArray | None) -> float:
    """Mean over time; over the finite samples where some are not finite or time stands still.

    >>> mean(np.array([0.0, 1.0, 2.0]), np.array([0.0, 1.0, 2.0]))
    1.0
    """
    usable = np.isfinite(values)
    if time is not None and usable.all() and values.shape[-1] > 1:
        return plain(np.trapezoid(values, time) / (time[-1] - time[0]))
    if values.ndim > 1:
        return np.array([mean(row, time) for row in values])  # type: ignore[return-value]
    return float(np.mean(values[usable])) if usable.any() else float("nan")


def rms(values: FloatArray, time: FloatArray | None) -> float:
    """Root mean square over time; see `mean`."""
    return plain(np.sqrt(mean(values**2, time)))
