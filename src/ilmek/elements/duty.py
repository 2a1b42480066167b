"""A motor's duty over a cycle, and the smallest sufficient motor with its reducer.

    M = Mr(T + J a) + Jm i a,   M_rms = sqrt(mean M²),   ratio = J / (i² Jm)

T torque of the load, J its inertia, w and a its speed and acceleration; Mr the reducer's input torque (`reducers`), i
its ratio, Jm the rotor's inertia; the reducer's inertia is neglected. The heating of the windings follows the mean of
M², the drive's current the largest M.                                      [derived here from the equation of motion]
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.motors import MOTORS, STEPPER, Motor
from ilmek.elements.reducers import DIRECT, PLANETARY, Reducer
from ilmek.errors import ParameterError
from ilmek.records import record, value_record

INERTIA_RATIO = 10.0
"""Greatest ratio of the load's inertia to the rotor's for a servo; 5 for stiff control [usual practice]."""

MARGIN = 1.25
"""Least ratio of available to computed torque."""


@record
class LoadCycle:
    """A load over a cycle, at equal steps of time (or of a master angle with constant speed).

    speed, acceleration  of the load [rad/s, rad/s²]      torque  of resistance, without inertia [N m]
    inertia              of the load [kg m²]
    """

    speed: FloatArray
    acceleration: FloatArray
    torque: FloatArray
    inertia: float = 0.0

    def __post_init__(self) -> None:
        if not self.speed.shape == self.acceleration.shape == self.torque.shape or not self.speed.size:
            raise ParameterError(
                f"speeds, accelerations and torques of shapes {self.speed.shape}, {self.acceleration.shape}, "
                f"{self.torque.shape}",
                allowed="one or more samples, as many of each",
            )

    @property
    def effort(self) -> FloatArray:
        """Torque with the load's inertia, T + J a [N m]."""
        return np.asarray(self.torque + self.inertia * self.acceleration)


@dataclass(frozen=True, slots=True)
class MotorDuty:
    """A motor's load over a cycle.

    rms, peak       of its torque [N m]      speed_max  [rad/s]      power_mean  input, with recovery of braking [W]
    inertia_ratio   of the load, reduced to the motor's shaft, to the rotor
    reserve         least ratio of available to required torque over the samples
    """

    rms: float
    peak: float
    speed_max: float
    power_mean: float
    inertia_ratio: float
    reserve: float


@value_record
class ServoDrive:
    """A motor, its reducer and their duty."""

    motor: Motor
    reducer: Reducer
    duty: MotorDuty

    def as_json(self) -> dict[str, str | float]:
        """Motor, ratio of the reducer, and duty as plain data, SI."""
        duty = self.duty
        return {
            "motor": self.motor.name,
            "ratio": self.reducer.ratio,
            "torque_rms": duty.rms,
            "torque_peak": duty.peak,
            "speed_max": duty.speed_max,
            "inertia_ratio": duty.inertia_ratio,
        }


def duty(cycle: LoadCycle, motor: Motor, reducer: Reducer = DIRECT) -> MotorDuty:
    """The motor's duty M = Mr(T + J a) + Jm i a over a cycle.

    `cycle` has arrays of one shape in [rad/s], [rad/s²] and [N m]; `reserve` is inf where no torque is required.

    >>> turn = 2 * np.pi * np.arange(360) / 360
    >>> swing = LoadCycle(10 * np.sin(turn), 100 * np.cos(turn), np.zeros(360), inertia=0.01)
    >>> servo = next(motor for motor in MOTORS if motor.name.startswith("servo 750 W"))
    >>> found = duty(swing, servo)
    >>> round(found.peak, 6), round(found.rms, 6), round(found.inertia_ratio, 3)
    (1.01, 0.714178, 100.0)
    """
    torque = reducer.input_torque(cycle.effort, cycle.speed) + motor.inertia * reducer.ratio * cycle.acceleration
    speed = reducer.ratio * cycle.speed
    required = np.abs(torque)
    available = motor.peak_at(speed)
    reserve = np.divide(available, required, out=np.full(required.shape, np.inf), where=required > 0)
    return MotorDuty(
        rms=float(np.sqrt(np.mean(torque**2))),
        peak=float(np.max(required)),
        speed_max=float(np.max(np.abs(speed))),
        power_mean=float(np.mean(torque * speed)),
        inertia_ratio=cycle.inertia / reducer.ratio**2 / motor.inertia,
        reserve=float(np.min(reserve)),
    )


def bears(motor: Motor, found: MotorDuty, *, margin: float = MARGIN, inertia_ratio: float = INERTIA_RATIO) -> bool:
    """Whether a motor is sufficient for a duty: peak torque, inertia ratio, and for a servo rms torque and speed.

    margin  least ratio of available to required torque [1]      inertia_ratio  greatest load to rotor [1]
    A stepper always carries its rated current, so that its rms torque has no limit.
    """
    continuous = motor.kind == STEPPER or (
        found.rms * margin <= motor.torque and found.speed_max <= motor.speed * (1 + 1e-9)
    )
    return continuous and found.reserve >= margin and found.inertia_ratio <= inertia_ratio


def size_motor(
    cycle: LoadCycle,
    reducers: Sequence[Reducer] = (DIRECT, *PLANETARY),
    kind: str | None = None,
    *,
    margin: float = MARGIN,
    inertia_ratio: float = INERTIA_RATIO,
    best: Callable[[ServoDrive], float] = lambda drive: drive.duty.rms,
) -> ServoDrive | None:
    """The motor of least power in `MOTORS` that is sufficient with one of the reducers; None if none is.

    kind  "stepper" or "servo"; default: either      margin, inertia_ratio  as for `bears`
    best  what is least of the chosen one of several sufficient reducers; default: the rms torque
    """
    ratios = np.array([reducer.ratio for reducer in reducers])[:, None]
    loads = np.stack([reducer.input_torque(cycle.effort, cycle.speed) for reducer in reducers])
    speeds = ratios * cycle.speed
    for motor in sorted(MOTORS, key=lambda one: one.power):
        if kind in (None, motor.kind):
            # All reducers at once; `bears` judges those that are left.
            torques = loads + motor.inertia * ratios * cycle.acceleration
            enough = np.all(np.abs(torques) * margin <= motor.peak_at(speeds) * (1 + _CLOSE), axis=1)
            drives = [
                ServoDrive(motor, reducer, duty(cycle, motor, reducer))
                for reducer, passes in zip(reducers, enough, strict=True)
                if passes
            ]
            able = [one for one in drives if bears(motor, one.duty, margin=margin, inertia_ratio=inertia_ratio)]
            if able:
                return min(able, key=best)
    return None


_CLOSE = 1e-9
