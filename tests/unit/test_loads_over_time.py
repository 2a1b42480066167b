"""Loads over time in a mechanism file, against superposition and closed forms of a wheel on a shaft."""

import numpy as np
import pytest
from tests.support.mechanisms import CRANK_ROCKER

from ilmek.dynamics.input_loads import TabulatedLoad
from ilmek.dynamics.loads import Torque
from ilmek.dynamics.own_forward import own_forward
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import MechanismFile, parse_mechanism
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.mechanism.run import MechanismRun, run

LOAD = '[loads]\np = { force = "FORCE", direction = "0deg", on = "rocker.C"TABLE }\n'

WHEEL = """\
name = "wheel"
inputs = { A = "wheel" }
[bodies]
ground.points = { A = [0, 0] }
wheel = { points = { A = [0, 0] }, mass = 0, moment = "2kg*m^2" }
[joints]
A.pin = ["ground", "wheel"]
[loads]
push = { torque = 0, on = "wheel", table = [["0s", "0N*m"], ["1s", "6N*m"], ["2s", "0N*m"]] }
[forward]
duration = "3s"
"""


def linkage(force: str = "100N", table: str = "") -> MechanismFile:
    return parse_mechanism(
        'gravity = "9.81m/s^2"\n' + CRANK_ROCKER + LOAD.replace("FORCE", force).replace("TABLE", table)
    )


def torque(file: MechanismFile, **request: object) -> tuple[np.ndarray, MechanismRun]:
    answer = run(file, MotionRequest(fixed={}, speed="4rad/s", **request))  # type: ignore[arg-type]
    assert answer.forces is not None
    effort = answer.forces.effort
    assert effort is not None
    return effort, answer


def test_a_force_over_time_is_the_sum_of_its_constant_and_its_growing_part() -> None:
    timed, answer = torque(linkage(table=', table = [["0s", "10N"], ["1s", "20N"]]'))
    low, high = torque(linkage("10N"))[0], torque(linkage("20N"))[0]
    assert answer.time is not None
    assert answer.time[-1] > 1.2
    share = np.clip(answer.time, 0.0, 1.0)
    assert np.max(np.abs(timed - low - share * (high - low))) < 1e-12 * np.max(np.abs(high))
    assert np.ptp(high - low) > 0.1


def test_time_is_zero_where_the_input_is_at_the_start_of_its_motion() -> None:
    table = ', over = "time", table = [[0, "10N"], ["1s", "20N"]]'
    forwards, answer = torque(linkage(table=table), over="30deg..200deg")
    low, high = (torque(linkage(force), over="30deg..200deg")[0] for force in ("10N", "20N"))
    assert answer.time is not None
    assert answer.time[0] == pytest.approx(np.deg2rad(30) / 4)
    assert np.allclose(forwards, low + np.minimum(answer.time, 1.0) * (high - low), rtol=0, atol=1e-12)


def test_a_wheel_gains_the_impulse_of_a_torque_over_time() -> None:
    file = parse_mechanism(WHEEL)
    assert file.machine.forward is not None
    forward = own_forward(file.machine, file.plan(), file.machine.forward)
    time = forward.run.time
    impulse = np.where(time < 1, 3 * time**2, np.where(time < 2, 6 - 3 * (2 - time) ** 2, 6.0))
    assert np.max(np.abs(forward.run.speed - impulse / 2)) < 1e-6
    assert forward.run.energy_error < 1e-6
    assert forward.effort_error < 1e-6


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ('[["0s", "10N"], ["90deg", "20N"]]', "a quantity in rad; a quantity in s is required"),
        ('[["1s", "10N"], ["0s", "20N"]]', "do not ascend"),
        ('[["0s", "10N"], ["1m", "20N"]]', "a quantity in m; a quantity in s is required"),
    ],
)
def test_a_table_over_time_that_contradicts_itself_is_refused_with_its_line(table: str, message: str) -> None:
    with pytest.raises(MechanismError, match=f"line 15, loads.p.*{message}"):
        linkage(table=f", table = {table}")


def test_a_single_position_has_no_time() -> None:
    answer = run(linkage(table=', table = [["0s", "10N"], ["1s", "20N"]]'), MotionRequest(fixed={"": "30deg"}))
    assert answer.forces is None
    assert "over time" in answer.left_out


def test_a_table_over_time_does_not_repeat() -> None:
    with pytest.raises(MechanismError, match="over time repeats"):
        TabulatedLoad(Torque("wheel", 1.0), None, (0.0, 1.0), (0.0, 1.0))
