"""Internal forces of links and their strength against textbook results."""

import math

import numpy as np
import pytest

from ilmek.dynamics.inertia import Inertia, bar
from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.link_forces import internal_forces
from ilmek.dynamics.link_strength import link_strength
from ilmek.dynamics.loads import Gravity, PointForce
from ilmek.dynamics.pin_strength import pin_duty, pin_strength
from ilmek.elements.flat_section import FlatSection, hole_notch
from ilmek.elements.materials import MATERIALS
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

STEEL = MATERIALS["structural steel"]
LENGTH, MASS = 0.8, 3.0
ROD = Inertia(MASS, LENGTH / 2, MASS * LENGTH**2 / 12)


def rod(angle, speed, alpha, loads=()):
    """A uniform rod on a pin at its left end, free at the right end."""
    mechanism = Mechanism(
        bodies=(Body(GROUND, {"O": 0}), Body("rod", {"O": 0, "tip": LENGTH})),
        joints=(Pin("O", GROUND, "rod"),),
        inputs=(Rotation("rod", "O"),),
    )
    forces = inverse(solve(plan(mechanism), np.array([angle]), speed, alpha), {"rod": ROD}, loads)
    found = internal_forces(forces, "rod", {"rod": ROD}, loads, line_mass=MASS / LENGTH, points=("tip",))
    assert found.equilibrium_error < 1e-14
    return found.beams[0], forces


def test_a_rod_that_turns_steadily_is_pulled_by_its_outer_part():
    beam, _ = rod(0.3, 40.0, 0.0)
    expected = MASS / LENGTH * 40**2 * (LENGTH**2 - beam.at**2) / 2
    np.testing.assert_allclose(beam.axial[:, 0], expected, rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(beam.moment, 0, atol=1e-9)


def test_a_falling_chimney_bends_most_at_a_third_of_its_height():
    """Released horizontally: M = m g L / 27 at L / 3 from the foot, and no torque at the foot (Routh; Meriam)."""
    gravity = 9.81
    beam, forces = rod(0.0, 0.0, -1.5 * gravity / LENGTH, (Gravity(-1j * gravity),))
    assert forces.effort("rod")[0] == pytest.approx(0, abs=1e-12)
    x = beam.at / LENGTH
    expected = MASS * gravity * LENGTH * x * (1 - x) ** 2 / 4
    np.testing.assert_allclose(np.abs(beam.moment[:, 0]), expected, atol=1e-12)
    assert np.abs(beam.moment).max() == pytest.approx(MASS * gravity * LENGTH / 27, rel=1e-3)


def test_a_side_rod_is_bent_by_its_inertia_as_a_beam_under_an_even_load():
    """Coupling rod of a locomotive: all points have the acceleration r ω²; M = m r ω² l / 8, σ = M / W."""
    radius, speed = 0.3, 25.0
    section = FlatSection(0.08, 0.03)
    line = section.line_mass(STEEL.density)
    side = bar(0, 2.0, mass=2.0 * line, width=0.0)
    mechanism = four_bar(2.0, radius, 2.0, radius, branch=1)
    motion = solve(plan(mechanism), np.array([0.2, math.pi / 2, 2.5]), speed)
    forces = inverse(motion, {"coupler": side})
    found = internal_forces(forces, "coupler", {"coupler": side}, line_mass=line)
    moment = np.abs(found.beams[0].moment[16]).max()
    assert moment == pytest.approx(2.0 * line * radius * speed**2 * 2.0 / 8, rel=1e-9)


def test_a_beam_with_a_load_in_its_middle():
    beam = loaded_link(1000.0)
    assert np.abs(beam.moment).max() == pytest.approx(1000.0 * 0.5 / 4, rel=1e-12)  # F l / 4
    np.testing.assert_allclose(np.abs(beam.shear[5]), 500.0, rtol=1e-9)


def loaded_link(force):
    """The coupler of a standing square four-bar, with a force across its middle."""
    mechanism = four_bar(0.5, 0.2, 0.5, 0.2, branch=1)
    motion = solve(plan(mechanism), np.array([math.pi / 2]), 0.0)
    loads = (PointForce(("coupler", 0.25 + 0j), lambda it: force * 1j * it.direction("coupler")),)
    found = internal_forces(inverse(motion, {}, loads), "coupler", {}, loads)
    assert len(found.beams) == 2
    # Both halves as one beam.
    assert found.beams[0].length == pytest.approx(0.25)
    return found.beams[0]


def test_a_hinged_link_has_the_frequency_of_the_hinged_beam():
    section = FlatSection(0.03, 0.01)
    line = section.line_mass(STEEL.density)
    mechanism = four_bar(0.5, 0.2, 0.6, 0.4, branch=1)
    inertias = {"coupler": bar(0, 0.6, mass=0.6 * line)}
    forces = inverse(solve(plan(mechanism), np.linspace(0, 6, 9), 5.0), inertias)
    found = internal_forces(forces, "coupler", inertias, line_mass=line)
    strength = link_strength(found, section, STEEL)
    expected = (math.pi / 0.6) ** 2 * math.sqrt(STEEL.modulus * section.inertia / line)
    assert strength.frequency == pytest.approx(expected, rel=1e-6)


def test_a_heavy_mass_beyond_the_pin_of_a_rocker():
    """Overhang a beyond the span l, mass m at its end: k = 3 E I / (a² (l + a)) [beam tables]."""
    section, span, over = FlatSection(0.03, 0.01), 0.4, 0.2
    inertias = {"rocker": Inertia(50.0, span + over, 0.0)}
    mechanism = four_bar(0.5, 0.15, 0.5, span, branch=1, points={"rocker": {"E": span + over}})
    forces = inverse(solve(plan(mechanism), np.linspace(0, 6, 9), 5.0), inertias)
    found = internal_forces(forces, "rocker", inertias, points=("E",))
    stiffness = 3 * STEEL.modulus * section.inertia / (over**2 * (span + over))
    assert link_strength(found, section, STEEL).frequency == pytest.approx(math.sqrt(stiffness / 50.0), rel=1e-6)


def test_the_notch_of_a_pin_hole_is_that_of_the_charts():
    """Kt 2.9 at d / w = 0.4 for a pin-loaded hole, read from the chart; grey cast iron hardly feels it."""
    section = FlatSection(0.05, 0.01, 0.02)
    assert 2.0 < hole_notch(section, STEEL) < 2.9
    assert hole_notch(section, MATERIALS["grey cast iron"]) == pytest.approx(1.37, abs=0.02)


def test_a_pin_in_a_fork_by_hand():
    """F = 12 kN, d = 20 mm, l = 30 mm, cheeks of 15 mm: τ 19.1 MPa, σ 114.6 MPa, p 20 MPa, by hand."""
    mechanism = four_bar(0.5, 0.2, 0.5, 0.2, branch=1)
    motion = solve(plan(mechanism), np.array([1.2, 1.3]), 2.0)
    loads = (PointForce("rocker.B", lambda it: 12000 * it.direction("coupler")),)
    duty = pin_duty(inverse(motion, {}, loads), "A")
    found = pin_strength(duty, 0.020, 0.030)
    assert found.force == pytest.approx(12000, rel=1e-9)
    assert found.shear / 1e6 == pytest.approx(19.099, abs=1e-3)
    assert found.bending / 1e6 == pytest.approx(114.59, abs=1e-2)
    assert found.pressure / 1e6 == pytest.approx(20.0)
    assert found.wear == pytest.approx(20e6 * 0.01 * 2.0, rel=1e-9)  # coupler does not turn, the crank does
