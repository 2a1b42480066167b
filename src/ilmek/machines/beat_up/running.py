"""The beat-up run by a motor: required torque, the flywheel, the start from rest and the steady run.

    M = M_0 tanh((omega_0 - omega) / (s omega_0))          a motor or drive that limits its torque to M_0

omega_0 the speed without load, s the slip at which it would give M_0 were its curve straight.
"""

import math
from collections.abc import Callable, Mapping

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.flywheel import CyclicTorque, duty, flywheel
from ilmek.dynamics.forward import ForwardRun, ForwardState, at_speed, forward
from ilmek.dynamics.fourier_terms import tabulate
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.loads import Gravity
from ilmek.dynamics.reduced import ReducedMechanism, reduce
from ilmek.linkage.structure import Plan
from ilmek.machines.beat_up.params import BeatUpParams
from ilmek.records import record
from ilmek.report import computed, result
from ilmek.units import turn

REACHED = 0.95
"""Part of the speed at which the start is over."""

MOST_TURNS = 100
"""Turns after which a start is given up."""

STEADY_TURNS, STEADY_SAMPLES = 4, 120
RTOL = 1e-9
ROUNDING = 1e-10
"""A mean torque below this part of the greatest is rounding."""


@record
class MotorRun:
    """The beat-up under its motor.

    duty      of the torque at constant speed
    start     the run from rest, the beater farthest back, to 95 % of the speed; `started`: whether it came there
    steady    turns at speed, after it; None where it does not start
    Both are None where the linkage stands so near a toggle that its inertia has no usable Fourier series.
    """

    duty: CyclicTorque
    flywheel: float = result("kg*m^2", "flywheel and rotor on the crank, for the fluctuation", name="flywheel_inertia")
    torque: float = result("N*m", "greatest torque of the motor, on the crank", name="motor_torque")
    start: ForwardRun | None
    started: bool
    steady: ForwardRun | None

    drive_torque_rms = computed("N*m", "root mean square of the torque", lambda it: it.duty.rms)
    work_excess = computed(
        "J", "work above the mean between least and greatest speed, over a turn", lambda it: it.duty.excess
    )

    @computed("N*m", "mean torque: nothing is lost, so that it is zero")
    def drive_torque_mean(self) -> float:
        return self.duty.mean if abs(self.duty.mean) > ROUNDING * self.duty.peak.value else 0.0

    @computed("s", "time from rest to 95 % of the speed; none: not reached", optional=True)
    def start_time(self) -> float | None:
        if self.start is None:
            return None
        return float(self.start.time[-1]) if self.started else math.nan

    @computed("rad/s", "mean speed of the last turn that was run", optional=True)
    def run_speed_mean(self) -> float | None:
        return float(self.last_turn[0].mean()) if self.steady else None

    @computed("1", "fluctuation of the speed in that turn", optional=True)
    def run_fluctuation(self) -> float | None:
        return self.fluctuation if self.steady else None

    @computed("N*m", "greatest torque of the motor in it", optional=True)
    def run_motor_torque_max(self) -> float | None:
        return float(np.max(np.abs(self.last_turn[1]))) if self.steady else None

    @computed("N*m", "root mean square of the same", optional=True)
    def run_motor_torque_rms(self) -> float | None:
        return math.sqrt(float(np.mean(self.last_turn[1] ** 2))) if self.steady else None

    @property
    def last_turn(self) -> tuple[FloatArray, FloatArray]:
        """Speeds [rad/s] and motor torques [N m] of the steady run's last turn; empty where there is none."""
        if self.steady is None:
            return np.zeros(0), np.zeros(0)
        return self.steady.speed[-STEADY_SAMPLES:], self.steady.effort[-STEADY_SAMPLES:]

    @property
    def fluctuation(self) -> float:
        """Of the speed in the last turn, (greatest - least) / mean of both; NaN where there is none."""
        speed, _ = self.last_turn
        return float((speed.max() - speed.min()) / ((speed.max() + speed.min()) / 2)) if speed.size else math.nan


def run(
    params: BeatUpParams,
    planned: Plan,
    inertias: Mapping[str, Inertia],
    weight: Gravity,
    *,
    torque: Callable[[FloatArray], FloatArray],
    back: float,
) -> MotorRun:
    """The running of a beat-up: `torque` on the crank at constant speed, `back` the crank angle that it starts from."""
    required = duty(lambda angle, _: torque(angle))
    wheel = params.flywheel
    if wheel is None:
        wheel = max(flywheel(required.excess, params.speed, params.fluctuation) - inertias["crank"].about(0), 0.0)
    most = params.motor_torque or required.peak.value
    reduced = reduce(planned, inertias, (weight,), flywheel=wheel)
    if most == 0 or tabulate(reduced) is None:
        return MotorRun(required, wheel, most, None, False, None)

    def motor(_time: float, _position: float, speed: float) -> float:
        return most * math.tanh((params.speed - speed) / (params.slip * params.speed))

    start, started = _start(params, reduced, motor, most, back)
    last = start.end.state
    steady = _steady(params, reduced, motor, ForwardState(last.position, last.speed)) if started else None
    return MotorRun(required, wheel, most, start, started, steady)


def _start(
    params: BeatUpParams,
    reduced: ReducedMechanism,
    motor: Callable[[float, float, float], float],
    most: float,
    back: float,
) -> tuple[ForwardRun, bool]:
    """The run from rest; whether it reached its speed in the time that twice the greatest inertia would take."""
    greatest = float(np.max(reduced.terms(np.linspace(0, turn, 181)).inertia))
    duration = min(4 * greatest * params.speed / most, MOST_TURNS * turn / params.speed)
    reached = at_speed(REACHED * params.speed)
    found = forward(
        reduced, ForwardState(back), duration, drive=motor, events=(reached,), every=duration / 200, rtol=RTOL
    )
    return found, found.end.words == reached.name


def _steady(
    params: BeatUpParams, reduced: ReducedMechanism, motor: Callable[[float, float, float], float], start: ForwardState
) -> ForwardRun:
    """The run from the start's last state."""
    period = turn / params.speed
    every = period / STEADY_SAMPLES
    return forward(reduced, start, STEADY_TURNS * period, drive=motor, every=every, rtol=RTOL)
