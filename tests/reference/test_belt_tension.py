"""Belts and chains with given pretension, against the forces of their two spans along their tangents."""

import numpy as np
import pytest

from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.inverse_run import all_loads
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import mechanism_json, mechanism_toml, parse_mechanism
from ilmek.jobs.mechanism.analysis import analysis
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.linkage.solve import solve
from ilmek.plane.vectors import cross


def belt_file(first: float, second: float, middle: complex, *, crossed: bool, pretension: float, torque: float) -> str:
    ratio = (-1 if crossed else 1) * first / second
    return f"""
inputs = {{ O = "motor" }}
motions = {{ O = "100rad/s" }}
gravity = "9.81m/s^2"
[bodies]
ground.points = {{ O = [0, 0], Q = ["{middle.real:.17g}m", "{middle.imag:.17g}m"] }}
motor = {{ points = {{ O = [0, 0] }}, mass = "1kg", moment = "0.01kg*m^2" }}
pulley = {{ points = {{ Q = [0, 0] }}, mass = "3kg", moment = "0.05kg*m^2" }}
[joints]
O.pin = ["ground", "motor"]
Q.pin = ["ground", "pulley"]
[couplings.belt]
belt = ["motor.O", "pulley.Q"]
ratio = {ratio:.17g}
first_at = 0
second_at = 0
radius = "{first:.17g}m"
pretension = "{pretension:.17g}N"
friction = 0.3
[loads]
work = {{ torque = "{torque:.17g}N*m", on = "pulley" }}
"""


@pytest.mark.parametrize("seed", range(25))
@pytest.mark.parametrize("crossed", [False, True])
@pytest.mark.parametrize("chain", [False, True])
def test_bearings_carry_both_spans(seed: int, crossed: bool, chain: bool) -> None:
    rng = np.random.default_rng(seed)
    first, second = rng.uniform(0.02, 0.1, 2)
    middle = rng.uniform(0.25, 0.5) * np.exp(1j * rng.uniform(0, 2 * np.pi))
    torque = rng.uniform(-9, 9)
    pretension = 0.0 if chain else rng.uniform(300, 600)
    text = belt_file(first, second, middle, crossed=crossed, pretension=pretension, torque=torque)
    file = parse_mechanism(text)
    motion = solve(file.plan(), np.linspace(0, 9, 5), 100.0, 20.0).require()
    forces = inverse(motion, file.inertias, all_loads(file.machine))
    ratio = (-1 if crossed else 1) * first / second
    moment = 0.05 * 20 * ratio - torque  # that the belt must give the pulley
    spans = []
    for side in (+1, -1):  # tangents that the belt runs along, by their ends on both rims
        lean = np.arcsin((first + second if crossed else first - second) / abs(middle))
        rim = np.exp(1j * (np.angle(middle) + side * (np.pi / 2 - lean)))
        start, end = first * rim, middle + (-second if crossed else second) * rim
        pull = (start - end) / abs(start - end)
        assert abs((pull * np.conj(rim)).real) < 1e-12
        spans.append((start, end, pull))
    per = [float(cross(end - middle, pull)) for _, end, pull in spans]  # +- r_2
    apart = moment / per[0]  # T_0 - T_1
    total = max(2 * pretension, abs(apart))
    sizes = (total + apart) / 2, (total - apart) / 2
    assert min(sizes) >= -1e-9
    on_pulley = sum(size * pull for size, (_, _, pull) in zip(sizes, spans, strict=True))
    np.testing.assert_allclose(forces.reactions["belt"], on_pulley, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(forces.torques["belt"], moment, rtol=1e-9)
    np.testing.assert_allclose(forces.pin("Q", "pulley"), 3 * 9.81j - on_pulley, atol=1e-8)
    np.testing.assert_allclose(forces.pin("O", "motor"), 9.81j + on_pulley, atol=1e-8)
    drive = 0.01 * 20 + sum(size * cross(start, pull) for size, (start, _, pull) in zip(sizes, spans, strict=True))
    np.testing.assert_allclose(forces.effort("motor"), drive, atol=1e-9)
    assert not forces.undetermined
    assert forces.power_error < 1e-12


def test_grip_by_the_capstan_limit() -> None:
    """An open belt of equal pulleys: T_1 / T_2 = exp(0.3 pi) at the limit."""
    limit = 2 * 400 * (np.exp(0.3 * np.pi) - 1) / (np.exp(0.3 * np.pi) + 1)
    for share, holds in ((0.99, True), (1.01, False)):
        text = belt_file(0.05, 0.05, 0.3, crossed=False, pretension=400, torque=-limit * 0.05 * share)
        found = analysis(run(parse_mechanism(text), MotionRequest({})))
        (check,) = (check for check in found.checks if check.name == "belt: grip of the belt")
        assert check.limit == pytest.approx(limit, rel=1e-12)
        assert check.value == pytest.approx(limit * share, rel=1e-12)
        assert check.ok is holds


def test_written_belts_are_read_without_loss() -> None:
    machine = parse_mechanism(belt_file(0.03, 0.07, 0.3 + 0.1j, crossed=True, pretension=250, torque=2)).machine
    for written, toml in ((mechanism_toml(machine), True), (mechanism_json(machine), False)):
        assert parse_mechanism(written, toml=toml).machine.mechanism == machine.mechanism


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('radius = "0.05', 'radius = "0.35', "reaches around both"),
        ('radius = "', 'radius = 0 # "', "radius of a pulley is 0"),
        ("radius", "#", "no radius"),
    ],
)
def test_belts_that_contradict_are_one_error(old: str, new: str, message: str) -> None:
    text = belt_file(0.05, 0.05, 0.3, crossed=True, pretension=400, torque=1)
    with pytest.raises(MechanismError, match=message) as error:
        parse_mechanism(text.replace(old, new))
    assert "\n" not in str(error.value)
    assert "couplings.belt" in str(error.value)
