"""Geared mechanisms against published numbers and theorems."""

import numpy as np
import pytest

from ilmek.linkage.model import GROUND, Body, Coupling, Mechanism, Pin, Rotation
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.units import deg


@pytest.mark.parametrize(("branch", "theta3", "theta4"), [(+1, 173.642, -177.715), (-1, -115.407, -124.050)])
def test_norton_geared_five_bar(branch, theta3, theta4):
    """Norton, Design of Machinery, Table P4-2 row a (problem 4-11): 6, 1, 7, 9, 4; ratio 2, phase 30, theta2 60 deg."""
    mechanism = Mechanism(
        bodies=(
            Body(GROUND, {"O2": 0, "O5": 6}),
            Body("two", {"O2": 0, "A": 1}),
            Body("three", {"A": 0, "B": 7}),
            Body("four", {"C": 0, "B": 9}),
            Body("five", {"O5": 0, "C": 4}),
        ),
        joints=(
            Pin("O2", GROUND, "two"),
            Pin("O5", GROUND, "five"),
            Pin("A", "two", "three"),
            Pin("C", "five", "four"),
            Pin("B", "three", "four"),
        ),
        inputs=(Rotation("two", "O2"),),
        branches={"B": branch},
        couplings=(Coupling("gears", "gears", ("two", "O2"), ("five", "O5"), 2.0, 0.0, 30 * deg),),
    )
    motion = solve(plan(mechanism), 60 * deg).require()
    assert float(motion.angle("three")[0]) / deg == pytest.approx(theta3, abs=6e-4)
    assert float(motion.angle("four")[0]) / deg == pytest.approx(theta4, abs=6e-4)


SUN, PLANET = 24, 18
RING = SUN + 2 * PLANET


def planetary(driven: str, held: str | None) -> Mechanism:
    """Sun, planet, ring, arm: the sun, the ring or the arm driven; what is held is the ground."""
    wheel = {"sun": "S", "ring": "R", "arm": "C"}
    body = {name: GROUND if name == held else name for name in wheel}
    bodies = [Body(name, {wheel[name]: 0}) for name in ("sun", "ring") if name != held]
    bodies += [Body("arm", {"C": 0, "P": 0.042}), Body("planet", {"P": 0, "Q": 0.018})]
    return Mechanism(
        bodies=(Body(GROUND, dict.fromkeys(wheel.values(), 0)), *bodies),
        joints=(
            *(Pin(wheel[name], GROUND, name) for name in ("sun", "ring", "arm") if name != held),
            Pin("P", "arm", "planet"),
        ),
        inputs=tuple(Rotation(name, wheel[name]) for name in driven.split()),
        couplings=(
            Coupling("outside", "gears", (body["sun"], "S"), ("planet", "P"), -SUN / PLANET, 0.0, 0.0, "arm"),
            Coupling("inside", "gears", (body["ring"], "R"), ("planet", "P"), RING / PLANET, 0.0, 0.0, "arm"),
        ),
    )


def test_planetary_gear_with_the_ring_held():
    """Willis' equation: n_arm / n_sun = z_sun / (z_sun + z_ring) = 2/7."""
    angle = np.linspace(0, 50, 101)
    motion = solve(plan(planetary("sun", "ring")), angle, 1.0).require()
    np.testing.assert_allclose(motion.omega("arm"), 2 / 7, rtol=1e-15)
    np.testing.assert_allclose(motion.direction("arm"), np.exp(1j * 2 / 7 * angle), atol=1e-13)
    np.testing.assert_allclose(motion.omega("planet"), -2 / 3, rtol=1e-15)


def test_planetary_gear_with_the_arm_driven_and_the_sun_held():
    """n_ring / n_arm = 1 + z_sun / z_ring = 1.4."""
    motion = solve(plan(planetary("arm", "sun")), np.linspace(0, 9, 11), 1.0).require()
    np.testing.assert_allclose(motion.omega("ring"), 1.4, rtol=1e-15)


def test_differential_adds_two_inputs():
    """Willis: n_arm = (z_sun n_sun + z_ring n_ring) / (z_sun + z_ring)."""
    time = np.linspace(0, 3, 7)
    motion = solve(
        plan(planetary("sun ring", None)), {"sun": 5 * time, "ring": -time}, {"sun": 5.0, "ring": -1.0}
    ).require()
    np.testing.assert_allclose(motion.omega("arm"), (SUN * 5 - RING) / (SUN + RING), rtol=1e-14)


def test_cardano_a_point_of_a_wheel_inside_one_twice_as_large_goes_straight():
    """Cardano's (de la Hire's) theorem: the rim's points of the inner wheel run along diameters of the outer one."""
    mechanism = Mechanism(
        bodies=(Body(GROUND, {"O": 0, "R": 0}), Body("arm", {"O": 0, "P": 0.1}), Body("wheel", {"P": 0, "Q": 0.1})),
        joints=(Pin("O", GROUND, "arm"), Pin("P", "arm", "wheel")),
        inputs=(Rotation("arm", "O"),),
        couplings=(Coupling("inside", "gears", (GROUND, "R"), ("wheel", "P"), 2.0, 0.0, 0.0, "arm"),),
    )
    angle = np.linspace(0, 7, 71)
    place = solve(plan(mechanism), angle, 1.0).require().point("wheel", "Q")
    np.testing.assert_allclose(place.position, 0.2 * np.cos(angle), atol=1e-15)
    np.testing.assert_allclose(place.velocity, -0.2 * np.sin(angle), atol=1e-15)
    np.testing.assert_allclose(place.acceleration, -0.2 * np.cos(angle), atol=1e-15)
