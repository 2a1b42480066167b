"""Forces of a judged mechanism against the kinetic energy, finite differences and the friction of a pin by hand."""

import numpy as np
import pytest

import ilmek
from ilmek.dynamics.joint_friction import PinFriction
from ilmek.units import rpm

LINKAGE = ilmek.four_bar(0.300, 0.060, 0.200, 0.230)
ROCKER = ilmek.bar(0, 0.230, mass=0.4)
SPEED = 150 * rpm


def judged(**more) -> ilmek.dynamics.JudgedMachine:
    return ilmek.judged(LINKAGE, inertias={"rocker": ROCKER}, speed=SPEED, **more)


def rocker_angle(crank: np.ndarray) -> np.ndarray:
    """By the cosine theorem, branch +1."""
    A = 0.060 * np.exp(1j * crank)
    gap = 0.300 - A
    at_pivot = np.arccos((0.230**2 + np.abs(gap) ** 2 - 0.200**2) / (2 * 0.230 * np.abs(gap)))
    return np.angle(-gap) - at_pivot


def test_the_flywheel_takes_up_the_change_of_the_kinetic_energy() -> None:
    crank = np.linspace(0, 2 * np.pi, 7201)
    omega = SPEED * np.gradient(np.unwrap(rocker_angle(crank)), crank, edge_order=2)
    energy = 0.5 * (ROCKER.moment + ROCKER.mass * abs(ROCKER.centre) ** 2) * omega**2
    assert judged().flywheel(0.02) == pytest.approx(np.ptp(energy) / (0.02 * SPEED**2), rel=1e-3)


def test_shaking_is_the_inertia_of_the_mass_centre() -> None:
    machine = judged()
    crank = np.linspace(0, 2 * np.pi, 72001)
    centre = 0.300 + 0.115 * np.exp(1j * rocker_angle(crank))
    step = crank[1] - crank[0]
    acceleration = SPEED**2 * (centre[2:] - 2 * centre[1:-1] + centre[:-2]) / step**2
    assert np.abs(machine.shaking.force).max() == pytest.approx(0.4 * np.abs(acceleration).max(), rel=1e-4)
    assert machine.balance().shaking_force_max_balanced < np.abs(machine.shaking.force).max()


def test_the_drive_pays_for_friction() -> None:
    free, rubbing = judged(), judged(joint_frictions=[PinFriction("B0", 0.01, 0.1)])
    lost = rubbing.friction_power
    assert free.friction_power is None
    assert lost is not None
    rate = np.abs(rubbing.forces.motion.omega("rocker"))
    np.testing.assert_allclose(lost, 0.1 * 0.01 * np.abs(rubbing.forces.pin("B0")) * rate, rtol=1e-9, atol=1e-12)
    assert rubbing.run.drive_torque_mean > free.run.drive_torque_mean


def test_a_file_brings_its_masses_and_loads() -> None:
    press = ilmek.judged(ilmek.read_mechanism("examples/slider_crank_press.toml"), speed="60rpm")
    assert np.abs(press.forces.effort(press.moved.name)).max() > 0


@pytest.mark.parametrize("change", [{"inertias": {}}, {"speed": 0.0}])
def test_without_masses_or_speed_it_says_so(change) -> None:
    given = {"inertias": {"rocker": ROCKER}, "speed": SPEED, **change}
    with pytest.raises(ilmek.IlmekError, match="judged without"):
        _ = ilmek.judged(LINKAGE, **given).forces
