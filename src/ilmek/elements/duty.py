"""A motor's duty over a cycle, and the smallest motor with its reducer that bears it.

    M = Mr(T + J a) + Jm i a,   M_rms = sqrt(mean M²),   ratio = J / (i² Jm)

T torque of the load, J its inertia, w and a its speed and acceleration; Mr the reducer's input torque (`reducers`), i
its ratio, Jm the rotor's inertia; the reducer's own is left out. The windings' warmth goes with the mean of M², the
drive's current with its largest.                              [equation of motion; usual practice of servo sizing]
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.motors import MOTORS, STEPPER, Motor
from ilmek.elements.reducers import DIRECT, PLANETARY, Reducer
from ilmek.errors import ParameterError
from ilmek.records import record

INERTIA_RATIO = 10.0
"""Load over rotor that a controller of a servo bears well; 5 where it must be stiff [usual practice]."""

MARGIN = 1.25
"""Of torque over what is reckoned."""


@record
class LoadCycle:
    """What moves over a cycle, at equal steps of time (of the master angle, where that turns evenly).

    speed, acceleration  of the load [rad/s, rad/s²]      torque  that it resists with, without inertia [N m]
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
        """Torque with that of the load's own inertia [N m]."""
        return np.asarray(self.torque + self.inertia * self.acceleration)


@dataclass(frozen=True, slots=True)
class MotorDuty:
    """What a motor bears over a cycle.

    rms, peak       of its torque [N m]      speed_max  [rad/s]      power_mean  that goes in [W], braking counted back
    inertia_ratio   of the load, on the motor's shaft, over the rotor
    reserve         least ratio of the torque it can give to the one asked, over the samples
    """

    rms: float
    peak: float
    speed_max: float
    power_mean: float
    inertia_ratio: float
    reserve: float


@dataclass(frozen=True, slots=True)
class ServoDrive:
    """A motor, its reducer and their duty."""

    motor: Motor
    reducer: Reducer
    duty: MotorDuty


def duty(cycle: LoadCycle, motor: Motor, reducer: Reducer = DIRECT) -> MotorDuty:
    """The motor's duty over the cycle.

    >>> turn = 2 * np.pi * np.arange(360) / 360
    >>> swing = LoadCycle(10 * np.sin(turn), 100 * np.cos(turn), np.zeros(360), inertia=0.01)
    >>> servo = next(motor for motor in MOTORS if motor.name.startswith("servo 750 W"))
    >>> found = duty(swing, servo)
    >>> round(found.peak, 6), round(found.rms, 6), round(found.inertia_ratio, 3)
    (1.01, 0.714178, 100.0)
    """
    torque = reducer.input_torque(cycle.effort, cycle.speed) + motor.inertia * reducer.ratio * cycle.acceleration
    speed = reducer.ratio * cycle.speed
    asked = np.abs(torque)
    given = motor.peak_at(speed)
    reserve = np.divide(given, asked, out=np.full(asked.shape, np.inf), where=asked > 0)
    return MotorDuty(
        rms=float(np.sqrt(np.mean(torque**2))),
        peak=float(np.max(asked)),
        speed_max=float(np.max(np.abs(speed))),
        power_mean=float(np.mean(torque * speed)),
        inertia_ratio=cycle.inertia / reducer.ratio**2 / motor.inertia,
        reserve=float(np.min(reserve)),
    )


def bears(motor: Motor, found: MotorDuty, *, margin: float = MARGIN, inertia_ratio: float = INERTIA_RATIO) -> bool:
    """Whether the motor bears a duty: torque of every sample, lasting torque and speed of a servo, inertia ratio.

    A stepper's windings always carry their current, so that no rms is asked of it.
    """
    lasts = motor.kind == STEPPER or (
        found.rms * margin <= motor.torque and found.speed_max <= motor.speed * (1 + 1e-9)
    )
    return lasts and found.reserve >= margin and found.inertia_ratio <= inertia_ratio


def size_motor(
    cycle: LoadCycle,
    reducers: Sequence[Reducer] = (DIRECT, *PLANETARY),
    kind: str | None = None,
    *,
    margin: float = MARGIN,
    inertia_ratio: float = INERTIA_RATIO,
) -> ServoDrive | None:
    """The motor of least power in `MOTORS` that bears the cycle behind one of the reducers; None where none does.

    Of several reducers the one with the least rms torque. kind  "stepper" or "servo"; None takes either
    """
    for motor in sorted(MOTORS, key=lambda one: one.power):
        if kind in (None, motor.kind):
            drives = [ServoDrive(motor, reducer, duty(cycle, motor, reducer)) for reducer in reducers]
            able = [one for one in drives if bears(motor, one.duty, margin=margin, inertia_ratio=inertia_ratio)]
            if able:
                return min(able, key=lambda one: one.duty.rms)
    return None
