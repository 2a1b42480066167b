"""A machine run by a motor on its crank: required torque, the flywheel, the start from rest and the steady run.

Motor: see `motor_drive`. Equation of motion and flywheel: see `reduced` and `flywheel`.
"""

import math
from collections.abc import Mapping

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.flywheel import CyclicTorque, cyclic_torque, flywheel
from ilmek.dynamics.forward import ForwardRun, ForwardState, at_speed, forward
from ilmek.dynamics.fourier_terms import tabulate
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.loads import Gravity
from ilmek.dynamics.motor_drive import MotorDrive
from ilmek.dynamics.reduced import reduce
from ilmek.linkage.structure import Plan
from ilmek.records import computed, record, result
from ilmek.units import turn

REACHED = 0.95
"""Share of the speed at which the start ends."""

MOST_TURNS = 100
"""Greatest duration of a start, in turns at the speed."""

STEADY_TURNS, STEADY_SAMPLES = 4, 120
RTOL = 1e-9
MOST_STEPS = 10_000
"""Steps of the integrator in a run: about 3 s. A motor of 10 000 times the required torque needs as many."""

ROUNDING = 1e-10
"""Mean torque relative to the greatest that counts as rounding."""


@record
class LastTurn:
    """The last turn of the steady run: speeds of the crank [rad/s], torques of the motor [N m]."""

    speed: FloatArray
    torque: FloatArray

    run_speed_mean = computed("rad/s", "mean speed of the last turn that was run", lambda it: float(it.speed.mean()))
    run_motor_torque_max = computed("N*m", "its greatest motor torque", lambda it: float(np.max(np.abs(it.torque))))
    run_motor_torque_rms = computed("N*m", "root mean square of it", lambda it: math.sqrt(float(np.mean(it.torque**2))))

    @computed("1", "fluctuation of the speed in that turn: (greatest - least) / mean of both", name="run_fluctuation")
    def fluctuation(self) -> float:
        return float((self.speed.max() - self.speed.min()) / ((self.speed.max() + self.speed.min()) / 2))


@record
class MotorRun:
    """A machine under its motor.

    duty       torque over a turn at constant speed
    flywheel   [kg m²]      torque  limit M_0 [N m]
    start      run from rest towards 95 % of the speed
    started    whether it reached 95 %
    steady     turns at speed after the start; None where it does not start
    last_turn  the last of them

    The runs are None where the linkage is so near a toggle position that its inertia has no usable Fourier series.
    """

    duty: CyclicTorque
    flywheel: float = result("kg*m^2", "flywheel and rotor on the crank, for the fluctuation", name="flywheel_inertia")
    torque: float = result("N*m", "greatest torque of the motor, on the crank", name="motor_torque")
    start: ForwardRun | None
    started: bool
    steady: ForwardRun | None
    last_turn: LastTurn | None

    drive_torque_rms = computed("N*m", "root mean square of the torque", lambda it: it.duty.rms)
    work_excess = computed("J", "work above the mean between least and greatest speed", lambda it: it.duty.excess)

    @computed("N*m", "mean torque: nothing is lost, so that it is zero")
    def drive_torque_mean(self) -> float:
        return self.duty.mean if abs(self.duty.mean) > ROUNDING * self.duty.peak.value else 0.0

    @computed("s", "time from rest to 95 % of the speed", absent="not reached, or not run")
    def start_time(self) -> float | None:
        return float(self.start.time[-1]) if self.start is not None and self.started else None

    @property
    def runs(self) -> tuple[ForwardRun, ...]:
        """The start and the turns at speed, as far as they were run."""
        return tuple(run for run in (self.start, self.steady) if run is not None)


@record
class MotorTask:
    """A motor and its flywheel on a crank.

    speed        of the crank [rad/s]                       slip    s of the motor
    torque       M_0 [N m]; None: the greatest required     start   crank angle of the start from rest [rad]
    flywheel     [kg m²]; None: what keeps the fluctuation of the speed, (greatest - least) / mean
    """

    speed: float
    slip: float
    fluctuation: float
    start: float
    torque: float | None = None
    flywheel: float | None = None


def motor_run(
    plan: Plan,
    inertias: Mapping[str, Inertia],
    gravity: complex,
    task: MotorTask,
) -> MotorRun:
    """The run of a mechanism by a motor on its crank, and the motor and flywheel that it requires.

    plan      of the mechanism, its input the body "crank"      inertias  body -> inertia [kg, m, kg m²]
    gravity   acceleration [m/s²], complex
    task      motor and flywheel

    The start lasts at most 4 J omega_0 / M_0, with J the greatest inertia over a turn, and at most 100 turns at the
    speed. A machine that has not reached 95 % of its speed by then, or within MOST_STEPS steps of the integrator, does
    not start; there is no last turn where the turns at speed end early.
    """
    speed, wheel, loads = task.speed, task.flywheel, (Gravity(gravity),)
    bare = reduce(plan, inertias, loads, flywheel=wheel or 0.0)
    table = tabulate(bare)
    torque = table.torque if table is not None else bare.torque
    required = cyclic_torque(lambda angle, _: torque(angle, speed))
    if wheel is None:
        wheel = max(flywheel(required.excess, speed, task.fluctuation) - inertias["crank"].about(0), 0.0)
    most = task.torque or required.peak.value
    reduced = reduce(plan, inertias, loads, flywheel=wheel)
    if most == 0 or table is None:
        return MotorRun(required, wheel, most, None, False, None, None)

    motor = MotorDrive(most, speed, task.slip)

    def run(start: ForwardState, duration: float, every: float, *, reach: bool) -> ForwardRun:
        events = (reached,) if reach else ()
        return forward(
            reduced, start, duration, drive=motor, events=events, every=every, rtol=RTOL, most_steps=MOST_STEPS
        )

    reached = at_speed(REACHED * speed)
    greatest = float(np.max(reduced.terms(np.linspace(0, turn, 181)).inertia))
    duration = min(4 * greatest * speed / most, MOST_TURNS * turn / speed)
    start = run(ForwardState(task.start), duration, duration / 200, reach=True)
    if start.end.reason != reached.name:
        return MotorRun(required, wheel, most, start, False, None, None)
    last, period = start.end.state, turn / speed
    at_speed_from = ForwardState(last.position, last.speed)
    steady = run(at_speed_from, STEADY_TURNS * period, period / STEADY_SAMPLES, reach=False)
    final = LastTurn(steady.speed[-STEADY_SAMPLES:], steady.effort[-STEADY_SAMPLES:])
    return MotorRun(required, wheel, most, start, True, steady, None if steady.end.kind.early else final)
