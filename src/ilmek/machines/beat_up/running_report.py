"""What a beat-up design says of its shaking, its counterweights, its flywheel and its motor."""

import cmath
import math

import numpy as np

from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.params import BeatUpParams
from ilmek.machines.beat_up.running import REACHED, Running
from ilmek.report import Check, Result, at_least, at_most
from ilmek.report.limits import snap_to_limit
from ilmek.units import format_quantity, turn

ENERGY = 1e-6
ROUNDING = 1e-10
"""A mean torque this small against the greatest, an angle this near to a turn are rounding."""


def shaking_results(design: BeatUp) -> tuple[Result, ...]:
    """Shaking before and after, the counterweight, and what would balance the force altogether."""
    found = design.balance
    (force, balanced), (moment, balanced_moment) = found.greatest("force"), found.greatest("moment")
    with_crank, against = found.first
    whole = dict(zip(("crank", "rocker"), found.whole, strict=True))
    return (
        Result("shaking_force_max", force, "N", "greatest force of the moving masses on the frame"),
        Result("shaking_moment_max", moment, "N*m", "its greatest moment about the crank's pivot"),
        Result(
            "shaking_first_harmonic",
            {"with_crank": with_crank, "against_crank": against},
            "N",
            "the parts of its first harmonic that turn with the crank and against it",
        ),
        Result("counterweight_moment", abs(found.counterweight), "", "on the crank: mass times radius (kg m)"),
        Result("counterweight_mass", found.mass, "kg", "its mass at counterweight_radius"),
        Result("counterweight_angle", _direction(found.counterweight), "deg", "its direction, from the crank"),
        Result("shaking_force_max_balanced", balanced, "N", "greatest shaking force with that counterweight"),
        Result("shaking_moment_max_balanced", balanced_moment, "N*m", "greatest shaking moment with it"),
        Result(
            "full_balance_moment",
            {link: abs(one) for link, one in whole.items()},
            "",
            "counterweights that would leave no shaking force at all: mass times radius (kg m)",
        ),
        Result(
            "full_balance_angle",
            {link: _direction(one) for link, one in whole.items()},
            "deg",
            "their directions, from crank and rocker",
        ),
    )


def _direction(static_moment: complex) -> float:
    """Angle in [0, 2 pi) [rad], rounding below 0 taken for 0."""
    angle = cmath.phase(static_moment) % turn
    return 0.0 if turn - angle < ROUNDING else angle


def running_results(running: Running) -> tuple[Result, ...]:
    """Duty of the motor, the flywheel, and what the runs show; none of the runs' where there are none."""
    duty = running.duty
    mean = duty.mean if abs(duty.mean) > ROUNDING * duty.peak.value else 0.0
    always = (
        Result("drive_torque_mean", mean, "N*m", "mean torque: nothing is lost, so that it is nought"),
        Result("work_excess", duty.excess, "J", "work above the mean between least and greatest speed, over a turn"),
        Result("flywheel_inertia", running.flywheel, "kg*m^2", "flywheel and rotor on the crank, for the fluctuation"),
        Result("motor_torque", running.torque, "N*m", "greatest torque of the motor, on the crank"),
    )
    if running.start is None:
        return always
    started = (Result("start_time", _start_time(running), "s", "from rest to 95 % of the speed; none: not reached"),)
    if running.steady is None:
        return (*always, *started)
    speed, torque = running.last_turn
    return (
        *always,
        *started,
        Result("run_speed_mean", float(speed.mean()), "rad/s", "mean speed of the last turn that was run"),
        Result("run_fluctuation", running.fluctuation, "1", "fluctuation of the speed in that turn"),
        Result("run_motor_torque_max", float(np.max(np.abs(torque))), "N*m", "greatest torque of the motor in it"),
        Result("run_motor_torque_rms", math.sqrt(float(np.mean(torque**2))), "N*m", "root mean square of the same"),
    )


def _start_time(running: Running) -> float | None:
    return float(running.start.time[-1]) if running.start is not None and running.started else None


def running_checks(params: BeatUpParams, running: Running) -> tuple[Check, ...]:
    """Whether the motor starts it, the flywheel is enough, and the runs keep their energy."""
    if running.start is None:
        return ()
    runs = [run for run in (running.start, running.steady) if run is not None]
    reached = max(float(np.max(run.speed)) for run in runs)
    energy = max(run.energy_error for run in runs)
    fluctuation = snap_to_limit(running.fluctuation, params.fluctuation)
    wanted = REACHED * params.speed
    checks = (
        at_least(
            "speed that the motor reaches", snap_to_limit(reached, wanted), wanted, "rad/s", "forward run, 95 % of it"
        ),
        at_most("energy balance of the runs", energy, ENERGY, "1", "work of motor and weight against energy"),
    )
    if running.steady is None:
        return checks
    return (*checks, at_most("fluctuation of the speed", fluctuation, params.fluctuation, "1", "wanted; forward run"))


def running_warnings(running: Running) -> tuple[str, ...]:
    """Why there is no run, or why it did not start."""
    if running.start is None:
        return ("the motor is not run: the linkage stands too near a toggle, or asks for no torque",)
    if running.started:
        return ()
    torque, reached = format_quantity(running.torque, "N*m"), format_quantity(float(running.start.speed.max()), "rad/s")
    return (f"the motor does not bring the crank to its speed: with {torque} it reaches {reached}; give more torque",)
