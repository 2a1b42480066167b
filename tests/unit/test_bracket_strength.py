"""The bracket of a head: its sag by integrating the curvature, its stress by hand, heads that are too heavy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import cumulative_trapezoid

from ilmek.machines.weaver import MACHINE, WeaverParams
from ilmek.machines.weaver.bracket_strength import BracketReach, bracket_load

SECTION = 0.088, 0.040, 0.005
MODULUS, GRAVITY = 70e9, 9.81
UPRIGHT = (0.088 * 0.040**3 - 0.078 * 0.030**3) / 12
SIDEWAYS = (0.040 * 0.088**3 - 0.030 * 0.078**3) / 12


@given(st.floats(1.0, 100.0), st.floats(0.02, 0.3), st.floats(0.0, 0.2), st.floats(0.0, 0.4))
def test_sag_is_the_curvature_integrated_twice(mass, length, beyond, tools) -> None:
    centre = length + beyond
    x = np.linspace(0.0, length, 4001)
    curvature = mass * GRAVITY * (centre - x) / (MODULUS * UPRIGHT)
    slope = cumulative_trapezoid(curvature, x, initial=0.0)
    deflection = cumulative_trapezoid(slope, x, initial=0.0)
    load = bracket_load(mass, 0.0, SECTION, BracketReach(length, centre, tools))
    assert load.sag == pytest.approx(deflection[-1] + slope[-1] * tools, rel=1e-5)


@given(st.floats(1.0, 100.0), st.floats(0.0, 30.0))
def test_stress_of_weight_and_step(mass, acceleration) -> None:
    load = bracket_load(mass, acceleration, SECTION, BracketReach(0.07, 0.17, 0.2))
    weight, step = mass * GRAVITY * 0.17 * 0.020 / UPRIGHT, mass * acceleration * 0.17 * 0.044 / SIDEWAYS
    assert load.stress == pytest.approx(weight + step)


@pytest.mark.parametrize(
    ("name", "settings"),
    [
        ("sag of the head at its tools", dict(head_mass=200.0)),
        ("stress of the head's bracket", dict(head_mass=400.0)),
    ],
)
def test_a_head_that_is_too_heavy_fails(name, settings) -> None:
    checks = {check.name: check for check in MACHINE.report(MACHINE.design(WeaverParams(**settings))).checks}
    assert not checks[name].ok
    assert checks[name].cure
    usual = {check.name: check for check in MACHINE.report(MACHINE.design(WeaverParams())).checks}
    assert usual[name].ok
