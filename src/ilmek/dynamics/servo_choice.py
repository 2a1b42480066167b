"""A servo motor of the catalogue for the driving input of an own machine, and why it is sufficient.

    J(q) = 2 T / q'²        inertia that the input feels: T kinetic energy of the bodies at the input's speed q'

The duty is that of `elements.duty`: peak and rms torque, speed, and J's mean over the run against the rotor's inertia.
"""

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.inverse import joint_rate
from ilmek.dynamics.inverse_run import InverseRun
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.elements.duty import INERTIA_RATIO, MARGIN, LoadCycle, MotorDuty, ServoDrive, duty, size_motor
from ilmek.elements.motors import SERVO, strongest_motor
from ilmek.elements.reducers import DIRECT
from ilmek.errors import MechanismError
from ilmek.linkage.solve import solve
from ilmek.records import computed, record
from ilmek.report import Check, at_least, at_most

SAMPLES = 1440
"""Equal steps of time of the motor's duty."""


@record
class ServoChoice:
    """A servo for the driving input.

    cycle  the load      drive  the smallest sufficient motor with its reducer; None: none is sufficient
    """

    cycle: LoadCycle
    drive: ServoDrive | None

    @computed(
        "",
        "smallest sufficient servo, direct or with a planetary reducer, and its duty",
        absent="none of the catalogue is sufficient",
        shown=False,
    )
    def servo(self) -> dict[str, str | float] | None:
        return None if self.drive is None else self.drive.as_json()

    servo_name = computed(
        "",
        "smallest sufficient servo of the catalogue, and the ratio of its reducer",
        lambda it: f"{it.drive.motor.name}, ratio {it.drive.reducer.ratio:g}" if it.drive else None,
        absent="none is sufficient",
    )

    @property
    def judged(self) -> ServoDrive:
        """The chosen drive, or the strongest motor at the speed, which is not sufficient."""
        if self.drive is not None:
            return self.drive
        motor = strongest_motor(float(np.max(np.abs(self.cycle.speed))))
        return ServoDrive(motor, DIRECT, duty(self.cycle, motor))

    @property
    def checks(self) -> tuple[Check, ...]:
        """Torque, speed and inertia of the drive against the motor's limits."""
        one = self.judged
        found: MotorDuty = one.duty
        source = f"{one.motor.name}, ratio {one.reducer.ratio:g}"
        cure = "lower the speed, balance the load, or drive through a reducer and a flywheel"
        return (
            at_most(
                "servo: rms torque", found.rms * MARGIN, one.motor.torque, "N*m", f"{MARGIN:g} times rms; {source}"
            ).with_cure(cure),
            at_least("servo: reserve of peak torque", found.reserve, MARGIN, "1", source).with_cure(cure),
            at_most("servo: speed", found.speed_max, one.motor.speed, "rpm", source).with_cure(cure),
            at_most("servo: inertia ratio", found.inertia_ratio, INERTIA_RATIO, "1", source).with_cure(cure),
        )


def servo_choice(machine: OwnMachine, run: InverseRun) -> ServoChoice:
    """The smallest servo that is sufficient for the driving input, or the actuator in its place, over a run.

    Over samples at which the mechanism does not close or locks the effort is interpolated.
    Raises MechanismError where the servo's input slides, is not the driving one, or stands still.
    """
    name = machine.servo
    if name is None or name != run.driver or not run.turning or run.time is None:
        raise MechanismError(
            f"a servo is required for {name!r}, the drive is {run.driver or 'none'}",
            allowed="the drive, turning and moving",
        )
    time, effort, felt = np.abs(run.time - run.time[0]), run.forces.effort(name), felt_inertia(machine, run, name)
    good = np.isfinite(effort) & np.isfinite(felt)
    even = (np.arange(SAMPLES) + 0.5) / SAMPLES * time[-1]
    curves = (run.forces.rate(name), run.forces.acceleration(name), effort, felt)
    speed, rate, effort, felt = (
        np.interp(even, time[good], np.broadcast_to(curve, time.shape)[good]) for curve in curves
    )
    inertia = float(np.mean(felt))
    cycle = LoadCycle(speed, rate, effort - inertia * rate, inertia)
    return ServoChoice(cycle, size_motor(cycle, kind=SERVO))


def felt_inertia(machine: OwnMachine, run: InverseRun, name: str) -> FloatArray:
    """Inertia of all bodies that a drive feels [kg m²; kg], one value per sample, the other inputs at rest.

    name  the driving input, or a turning actuator in its place; infinite where that stands still
    """
    motion = run.forces.motion
    unit = solve(motion.plan, {entry: drive.value for entry, drive in motion.drives.items()}, {str(run.driving): 1.0})
    total = np.zeros(len(unit))
    for body, inertia in machine.inertias.items():
        centre = unit.carried(body, inertia.centre)
        total = total + inertia.mass * np.abs(centre.velocity) ** 2 + inertia.moment * unit.omega(body) ** 2
    if not run.forces.actuators:
        return total
    with np.errstate(divide="ignore"):
        return np.asarray(total / joint_rate(unit, name) ** 2)
