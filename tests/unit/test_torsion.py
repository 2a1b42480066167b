"""Torsion of shafts with discs: against the closed form of equal discs, of a uniform shaft, and scipy's integration."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ilmek.elements.materials import MATERIALS
from ilmek.elements.torsion import steady_twist, torsion_modes
from ilmek.errors import ParameterError

STEEL = MATERIALS["heat-treatable steel"]
SPRING = STEEL.shear_modulus * math.pi * 0.04**4 / 32 / 0.4
"""Stiffness of 0.4 m of a shaft of 40 mm [N m/rad]."""


@pytest.mark.parametrize("count", [2, 3, 10, 40])
def test_equal_discs_have_the_frequencies_of_the_closed_form(count: int) -> None:
    found = torsion_modes(np.arange(count) * 0.4, np.full(count, 0.03), 0.04, STEEL, massless=True)
    expected = 2 * math.sqrt(SPRING / 0.03) * np.sin(np.arange(count) * np.pi / (2 * count))
    assert np.allclose(found.frequencies, expected, rtol=1e-9, atol=1e-9 * expected[-1])


def test_a_shaft_without_discs_has_the_frequencies_of_waves() -> None:
    """Free ends: w = pi n c / L, c the speed of shear waves; linear elements err by (pi n / N)² / 24."""
    count = 201
    found = torsion_modes(np.linspace(0, 4.0, count), np.full(count, 1e-12), 0.04, STEEL).frequencies
    speed = math.sqrt(STEEL.shear_modulus / STEEL.density)
    assert np.allclose(found[1:4], np.pi * np.arange(1, 4) * speed / 4.0, rtol=2e-4)


def test_the_steady_twist_is_what_integration_in_time_comes_to() -> None:
    """Equations of motion written out here with their matrices, integrated until only the period is left."""
    rng, count, speed, damping, samples = np.random.default_rng(3), 5, 16.75, 0.3, 64
    inertias, length = np.array([0.5, 0.03, 0.04, 0.03, 0.03]), 0.4
    weight = STEEL.density * math.pi * 0.04**4 / 32 * length
    stiff, mass = np.zeros((count, count)), np.diag(inertias)
    for place in range(count - 1):
        stiff[place : place + 2, place : place + 2] += SPRING * np.array([[1, -1], [-1, 1]])
        mass[place : place + 2, place : place + 2] += weight / 6 * np.array([[2, 1], [1, 2]])
    first = math.sqrt(sorted(np.linalg.eigvals(np.linalg.solve(mass, stiff)).real)[1])
    drag = 2 * damping / first * stiff
    parts = rng.normal(size=(count, 4)) * 30, rng.normal(size=(count, 4)) * 30
    order = np.arange(1, 5)

    def torque(time: float) -> np.ndarray:
        turned = order * speed * time
        return np.asarray(parts[0] @ np.cos(turned) + parts[1] @ np.sin(turned))

    inverse = np.linalg.inv(mass)

    def rates(time: float, state: np.ndarray) -> np.ndarray:
        twist, pace = state[:count], state[count:]
        return np.concatenate((pace, inverse @ (torque(time) - stiff @ twist - drag @ pace)))

    period, turns = 2 * math.pi / speed, 12
    times = turns * period + np.arange(samples) * period / samples
    run = solve_ivp(
        rates, (0, (turns + 1) * period), np.zeros(2 * count), t_eval=times, rtol=1e-9, atol=1e-12, method="Radau"
    )
    modes = torsion_modes(np.arange(count) * length, inertias, 0.04, STEEL)
    torques = np.array([torque(time) for time in np.arange(samples) * period / samples]).T
    found = steady_twist(modes, torques, speed, damping)
    # Rotation as a whole drifts in the integration: twists against the first disc are compared.
    expected = run.y[:count] - run.y[0]
    assert np.abs(found - found[0] - expected).max() < 1e-5 * np.abs(expected).max()
    assert np.abs(expected).max() > 1e-4


def test_balanced_constant_torques_twist_as_a_spring() -> None:
    modes = torsion_modes(np.array([0.0, 0.4]), np.array([0.1, 0.2]), 0.04, STEEL, massless=True)
    twist = steady_twist(modes, np.array([[50.0] * 8, [-50.0] * 8]), 10.0, 0.02)
    assert twist[0] - twist[1] == pytest.approx(np.full(8, 50 / SPRING), rel=1e-9)


def test_one_disc_is_refused() -> None:
    with pytest.raises(ParameterError, match="two or more"):
        torsion_modes(np.zeros(1), np.ones(1), 0.04, STEEL)
