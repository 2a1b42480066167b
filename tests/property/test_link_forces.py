"""Internal forces of links: equilibrium in random mechanisms, no moment at free pins, the law of the squared speed."""

import numpy as np
import pytest
from benchmarks.random_mechanisms import random_inertias, random_mechanism

from ilmek.dynamics.inertia import bar
from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.joint_friction import PinFriction
from ilmek.dynamics.link_forces import internal_forces
from ilmek.dynamics.link_strength import link_strength
from ilmek.dynamics.loads import Gravity, PointForce, Torque
from ilmek.elements.flat_section import FlatSection
from ilmek.elements.materials import MATERIALS
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import Pin
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

ANGLES = np.linspace(0, 2 * np.pi, 73)


@pytest.mark.parametrize("seed", range(12))
def test_all_that_acts_on_a_body_is_in_equilibrium(seed: int) -> None:
    draw = np.random.default_rng(seed)
    mechanism, values = random_mechanism(draw)
    motion = solve(plan(mechanism), values, dict.fromkeys(values, 2.0), dict.fromkeys(values, 3.0))
    inertias = random_inertias(draw, mechanism)
    first, *_, last = mechanism.moving
    loads = (Gravity(1 - 9j), PointForce((last, 0.1 - 0.2j), 30 + 10j), Torque(first, 5.0))
    frictions = [PinFriction(one.name, 0.05, 0.1) for one in mechanism.joints if isinstance(one, Pin)][:1]
    for friction in ((), frictions):
        forces = inverse(motion, inertias, loads, friction)
        for body in mechanism.moving:
            found = internal_forces(forces, body, inertias, loads, line_mass=0.3)
            assert not found.equilibrium_error > 1e-9, body


def test_a_pin_without_torque_bends_nothing_at_the_ends() -> None:
    mechanism = slider_crank(0.1, 0.35, branch=1)
    inertias = {"crank": bar(0, 0.1, mass=1.0), "rod": bar(0, 0.35, mass=2.0)}
    forces = inverse(solve(plan(mechanism), ANGLES, 30.0), inertias)
    beam = internal_forces(forces, "rod", inertias, line_mass=2.0 / 0.35).beams[0]
    assert np.abs(beam.moment[[0, -1]]).max() < 1e-9 * np.abs(beam.moment).max()
    slope = np.gradient(beam.moment, beam.at, axis=0)[2:-2]
    np.testing.assert_allclose(slope, -beam.shear[2:-2], atol=3e-3 * np.abs(beam.shear).max())  # dM/ds = -V


@pytest.mark.parametrize("ratio", [2.0, 3.7])
def test_stress_grows_with_the_square_of_the_speed(ratio: float) -> None:
    def strength(speed: float):
        mechanism = four_bar(0.3, 0.06, 0.25, 0.2, branch=1, points={"rocker": {"E": 0.3}})
        inertias = {"crank": bar(0, 0.06, mass=0.2), "coupler": bar(0, 0.25, mass=0.6), "rocker": bar(0, 0.3, mass=3.0)}
        forces = inverse(solve(plan(mechanism), ANGLES, speed), inertias)
        found = internal_forces(forces, "rocker", inertias, line_mass=2.0, points=("E",))
        return link_strength(found, FlatSection(0.03, 0.01, 0.01), MATERIALS["structural steel"])

    slow, fast = strength(10.0), strength(10.0 * ratio)
    assert fast.stress == pytest.approx(slow.stress * ratio**2, rel=1e-9)
    assert fast.fatigue == pytest.approx(slow.fatigue / ratio**2, rel=1e-9)
    assert fast.frequency == slow.frequency
