"""A motor's duty: rms and peak of known cycles, reducers driven both ways, the smallest motor that bears it."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.elements.duty import LoadCycle, bears, duty, size_motor
from ilmek.elements.motors import MOTORS, find_motor
from ilmek.elements.reducers import PLANETARY, Reducer
from ilmek.errors import ParameterError
from ilmek.units import rpm

TURN = 2 * np.pi * np.arange(720) / 720
SERVO = find_motor("servo 750 W, 3000 rpm, 2.39 N m")


def test_trapezoidal_speed_has_the_textbook_rms() -> None:
    """A third each of speeding up, running and slowing down, against friction."""
    thirds = np.repeat([1.0, 0.0, -1.0], 200)
    middle = (np.arange(200) + 0.5) / 200
    speed = np.concatenate((middle, np.ones(200), middle[::-1])) * 100
    friction, accelerating = 0.4, 0.2
    cycle = LoadCycle(speed, thirds * 1000.0, np.full(600, friction), inertia=accelerating / 1000)
    found = duty(cycle, SERVO)
    extra = SERVO.inertia * 1000
    torques = friction + np.array([1, 0, -1]) * (accelerating + extra)
    assert found.rms == pytest.approx(math.sqrt(np.mean(torques**2)))
    assert found.peak == pytest.approx(friction + accelerating + extra)
    assert found.power_mean == pytest.approx(friction * speed.mean())
    assert found.inertia_ratio == pytest.approx(2e-4 / SERVO.inertia)
    assert found.reserve == pytest.approx(SERVO.peak / found.peak)


def test_of_several_reducers_that_bear_it_the_one_of_least_rms_torque_is_taken() -> None:
    cycle = LoadCycle(3 * np.sin(TURN), 3 * np.cos(TURN), 4 * np.sin(TURN), inertia=0.02)
    found = size_motor(cycle, PLANETARY, "servo")
    assert found is not None
    every = [duty(cycle, found.motor, reducer) for reducer in PLANETARY]
    able = [one for one in every if bears(found.motor, one)]
    assert found.duty.rms == min(one.rms for one in able) < max(one.rms for one in able)


def test_pure_inertia_takes_no_power_over_a_cycle() -> None:
    swing = LoadCycle(10 * np.sin(TURN), 100 * np.cos(TURN), np.zeros(720), inertia=0.01)
    assert duty(swing, SERVO).power_mean == pytest.approx(0, abs=1e-12)
    assert duty(swing, SERVO).rms == pytest.approx(duty(swing, SERVO).peak / math.sqrt(2))


def test_best_ratio_matches_the_inertias() -> None:
    """Pure inertia: the torque is least for i = sqrt(J / Jm), where the inertia ratio is 1."""
    swing = LoadCycle(10 * np.sin(TURN), 100 * np.cos(TURN), np.zeros(720), inertia=0.01)
    best = math.sqrt(0.01 / SERVO.inertia)
    least = duty(swing, SERVO, Reducer(best, 1.0))
    assert least.inertia_ratio == pytest.approx(1)
    assert all(duty(swing, SERVO, Reducer(best * factor, 1.0)).rms > least.rms for factor in (0.8, 0.95, 1.05, 1.2))


@settings(max_examples=12)
@given(st.floats(0.05, 1.0), st.floats(1.0, 200.0), st.floats(-50, 50), st.sampled_from([-3.0, 0.0, 2.0]))
def test_reducer_never_gives_power_away(efficiency, ratio, torque, speed) -> None:
    """What goes in less what comes out is the loss, the same both ways: |P| (1/eta - 1)."""
    reducer = Reducer(ratio, efficiency)
    into = float(reducer.input_torque(torque, speed)) * ratio * speed
    assert into - torque * speed == pytest.approx(abs(torque * speed) * (1 / efficiency - 1), rel=1e-9, abs=1e-9)
    if reducer.self_locking:
        assert float(reducer.input_torque(torque, 0.0)) == 0


def test_stepper_loses_torque_with_speed() -> None:
    stepper = find_motor("stepper NEMA 34, 7 N m")
    left = stepper.peak_at(np.array([0.0, 300.0, 1000.0]) * rpm) / stepper.peak
    np.testing.assert_allclose(left, [1, 2 / 3, 0.259], atol=1e-3)
    assert stepper.peak_at(300 * rpm) == pytest.approx(stepper.torque)
    assert SERVO.peak_at(3001 * rpm) == 0


@pytest.mark.parametrize("kind", [None, "servo", "stepper"])
def test_sized_motor_bears_it_and_no_lesser_one_does(kind) -> None:
    cycle = LoadCycle(8 + 3 * np.sin(TURN), 20 * np.cos(TURN), 12 + 5 * np.cos(TURN), inertia=0.05)
    drive = size_motor(cycle, kind=kind)
    assert drive is not None
    assert bears(drive.motor, drive.duty)
    for lesser in (motor for motor in MOTORS if motor.power < drive.motor.power and kind in (None, motor.kind)):
        assert not any(bears(lesser, duty(cycle, lesser, reducer)) for reducer in PLANETARY)
    assert size_motor(LoadCycle(cycle.speed, cycle.acceleration, cycle.torque * 1e5, 0.05)) is None


def test_motors_of_the_table_are_of_their_kind() -> None:
    """Within a kind and speed, more torque comes with more inertia and mass; none could not speed itself up."""
    for kind, speed in {(motor.kind, motor.speed) for motor in MOTORS}:
        row = [motor for motor in MOTORS if (motor.kind, motor.speed) == (kind, speed)]
        for values in ([m.torque for m in row], [m.inertia for m in row], [m.mass for m in row]):
            assert values == sorted(values)
        assert all(motor.peak > motor.torque and motor.peak / motor.inertia > 1e3 for motor in row)


def test_unknown_motor_names_the_nearest() -> None:
    with pytest.raises(ParameterError, match="nearest offered is 'servo 400 W"):
        find_motor("servo 500 W")
    with pytest.raises(ParameterError, match="nearest offered is 'stepper NEMA 34"):
        find_motor("stepper NEMA 36")


def test_cycle_of_unequal_samples_is_refused() -> None:
    with pytest.raises(ParameterError, match="as many of each"):
        LoadCycle(np.zeros(3), np.zeros(4), np.zeros(3))
