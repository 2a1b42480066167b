"""Counterweight and flywheel of a mechanism against closed forms and brute force."""

from pathlib import Path

import numpy as np
import pytest

from ilmek.dynamics.machine_balance import machine_balance
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import parse_mechanism
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.mechanism.run import MechanismRun, run
from ilmek.plane.enclosing_circle import enclosing_circle

CRANK = """
name = "crank with a load"
motions = { O = "10rad/s" }
inputs = { O = "crank" }
[bodies]
ground.points = { O = [0, 0] }
crank = { points = { O = [0, 0] }, mass = "2kg", centre = ["100mm", "30mm"], moment = "0.01kg*m^2" }
[joints]
O.pin = ["ground", "crank"]
[loads]
step = { torque = "8N*m", on = "crank", while = { from = "0deg", to = "90deg" } }
"""


def moved(text: str, **request: object) -> MechanismRun:
    """The run of a text."""
    return run(parse_mechanism(text), MotionRequest({}, **request))  # type: ignore[arg-type]


def test_a_crank_alone_is_balanced_wholly_and_its_flywheel_is_in_closed_form() -> None:
    """The static moment m r opposite the centre; a torque of T over a quarter turn: excess T (pi / 2) (3 / 4)."""
    found = moved(CRANK)
    assert found.forces is not None
    balance = machine_balance(found.forces, 10.0, 0.02)
    assert balance.counterweight_moment == pytest.approx(2 * abs(0.1 + 0.03j), rel=1e-12)
    assert balance.counterweight_angle == pytest.approx(np.pi + np.angle(0.1 + 0.03j), rel=1e-12)
    assert balance.shaking_force_max_balanced == pytest.approx(0.0, abs=1e-10)
    assert balance.shaking_moment_max_balanced == pytest.approx(0.0, abs=1e-10)
    assert balance.work_excess == pytest.approx(8 * np.pi / 2 * 3 / 4, rel=1e-5)
    assert balance.flywheel_inertia == pytest.approx(balance.work_excess / (0.02 * 100), rel=1e-12)


def test_no_counterweight_on_a_grid_leaves_less() -> None:
    found = moved(Path("examples/slider_crank_press.toml").read_text())
    assert found.forces is not None
    assert found.speed is not None
    balance = machine_balance(found.forces, found.speed, 0.05)
    force, angle = found.forces.shaking.force, found.forces.forces.motion.angle("crank")
    centre = balance.counterweight_moment * np.exp(1j * balance.counterweight_angle)

    def greatest(moment: complex) -> float:
        return float(np.abs(force + moment * found.speed**2 * np.exp(1j * angle)).max())  # type: ignore[operator]

    assert greatest(centre) == pytest.approx(balance.shaking_force_max_balanced, rel=1e-9)
    size = balance.counterweight_moment
    around = [centre + size * r * np.exp(1j * a) for r in (1e-3, 0.01, 0.1, 1.0) for a in np.linspace(0, 2 * np.pi, 73)]
    assert min(map(greatest, around)) >= balance.shaking_force_max_balanced
    assert balance.shaking_force_max_balanced < found.forces.shaking_force_max


@pytest.mark.parametrize("request_", [{"over": "0deg..90deg"}, {"over": "0deg..720deg"}])
def test_a_balance_needs_one_whole_turn(request_: dict[str, str]) -> None:
    found = moved(CRANK, **request_)
    assert found.forces is not None
    with pytest.raises(MechanismError, match="one whole turn"):
        machine_balance(found.forces, 10.0, 0.02)


def test_the_circle_is_the_smallest() -> None:
    """Each circle has all points, and two on a diameter, or three of which no arc between two exceeds half a turn."""
    rng = np.random.default_rng(7)
    for number in (1, 2, 3, 5, 40, 400):
        points = rng.normal(size=number) + 1j * rng.normal(size=number)
        centre, radius = enclosing_circle(points)
        away = np.abs(points - centre)
        assert away.max() <= radius * (1 + 1e-9) + 1e-15
        on = np.sort(np.angle(points[away >= radius * (1 - 1e-9)] - centre))
        if number > 1:
            assert np.diff(np.append(on, on[0] + 2 * np.pi)).max() <= np.pi + 1e-6
