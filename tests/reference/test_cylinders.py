"""A boom lifted by a cylinder against the triangle of its ends, and the moments about the boom's pivot."""

import numpy as np
import pytest

from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.inverse_run import all_loads
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import mechanism_json, mechanism_toml, parse_mechanism
from ilmek.linkage.solve import solve
from ilmek.plane.vectors import cross


def boom_file(foot: complex, eye: complex, centre: complex) -> str:
    return f"""
inputs = {{ lift = "lift.rod" }}
gravity = "9.81m/s^2"
[bodies]
ground.points = {{ O = [0, 0], F = ["{foot.real:.17g}m", "{foot.imag:.17g}m"] }}
[bodies.boom]
points = {{ O = [0, 0], E = ["{eye.real:.17g}m", "{eye.imag:.17g}m"] }}
mass = "50kg"
centre = ["{centre.real:.17g}m", "{centre.imag:.17g}m"]
moment = "8kg*m^2"
[joints]
O.pin = ["ground", "boom"]
[cylinders]
lift.between = ["ground.F", "boom.E"]
"""


@pytest.mark.parametrize("seed", range(25))
def test_boom_and_cylinder(seed: int) -> None:
    """The angle at the pivot by the three sides; alpha by the second rate of L^2; the force by the boom's moments."""
    rng = np.random.default_rng(seed)
    foot = rng.uniform(0.4, 0.8) * np.exp(-1j * rng.uniform(0.2, 0.8))
    drawn = rng.uniform(0.5, 1.2)
    eye = rng.uniform(0.5, 0.9) * np.exp(1j * drawn)
    centre = complex(*rng.uniform(0.3, 0.8, 2))
    file = parse_mechanism(boom_file(foot, eye, centre))
    length = abs(eye - foot) + np.linspace(-0.05, 0.05, 7)
    speed, rush = 0.2, 0.1
    motion = solve(file.plan(), length, speed, rush).require()
    a, b = abs(foot), abs(eye)
    between = np.arccos((a**2 + b**2 - length**2) / (2 * a * b))
    at = np.angle(foot) + between
    np.testing.assert_allclose(motion.point("boom", "E").position, b * np.exp(1j * at), atol=1e-12)
    omega = length * speed / (a * b * np.sin(between))
    alpha = (speed**2 + length * rush) / (a * b * np.sin(between)) - omega**2 / np.tan(between)
    np.testing.assert_allclose(motion.omega("boom"), omega, rtol=1e-11)
    np.testing.assert_allclose(motion.alpha("boom"), alpha, rtol=1e-9, atol=1e-9)
    forces = inverse(motion, file.inertias, all_loads(file.machine))
    arm = centre * np.exp(1j * (at - np.angle(eye)))
    along = b * np.exp(1j * at) - foot
    along /= np.abs(along)
    push = ((8 + 50 * abs(centre) ** 2) * alpha + 50 * 9.81 * arm.real) / cross(b * np.exp(1j * at), along)
    np.testing.assert_allclose(forces.effort("lift"), push, rtol=1e-9)
    np.testing.assert_allclose(forces.pin("lift.head", "boom"), push * along, rtol=1e-9, atol=1e-7)
    carried = 50 * ((1j * alpha - omega**2) * arm + 9.81j) - push * along
    np.testing.assert_allclose(forces.pin("O", "boom"), carried, rtol=1e-9, atol=1e-7)
    assert forces.power_error < 1e-11


def test_written_cylinders_are_read_without_loss() -> None:
    machine = parse_mechanism(boom_file(0.5 - 0.3j, 0.4 + 0.6j, 0.5)).machine
    for written, toml in ((mechanism_toml(machine), True), (mechanism_json(machine), False)):
        assert parse_mechanism(written, toml=toml).machine.mechanism == machine.mechanism


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('.E"]', '.G"]', "no point 'G'"),
        ('"boom.E', '"arm.E', "of 'arm'"),
        ('"boom.E"', '"ground.F"', "one place"),
    ],
)
def test_cylinders_that_contradict_are_one_error(old: str, new: str, message: str) -> None:
    with pytest.raises(MechanismError, match=message) as error:
        parse_mechanism(boom_file(0.5 - 0.3j, 0.4 + 0.6j, 0.5).replace(old, new, 1))
    assert "cylinders.lift" in str(error.value) or "joints" in str(error.value)
