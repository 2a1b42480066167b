"""Shaking force, counterweights, torque over a turn and flywheels, against derivations by hand and forward runs."""

import numpy as np
import pytest
from benchmarks.random_mechanisms import random_inertias, random_mechanism

from ilmek.dynamics.balance import (
    counterweighted,
    crank_counterweight,
    first_harmonic,
    four_bar_counterweights,
    harmonics,
    on_frame,
    shaking,
)
from ilmek.dynamics.flywheel import cyclic_torque, flywheel
from ilmek.dynamics.forward import ForwardState, forward
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.joint_friction import PinFriction, SlideFriction
from ilmek.dynamics.loads import Gravity
from ilmek.dynamics.reduced import reduce
from ilmek.errors import MechanismError
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation
from ilmek.linkage.solve import solve
from ilmek.linkage.status import Status
from ilmek.linkage.structure import plan

TURN = 2 * np.pi
ANGLES = np.arange(256) * (TURN / 256)
ABOUT = 0.3 - 0.2j


def test_the_joints_pass_the_shaking_on_to_the_frame() -> None:
    draw, usable = np.random.default_rng(3), 0
    for _ in range(15):
        mechanism, values = random_mechanism(draw)
        at = {name: value + np.linspace(-0.1, 0.1, 3) for name, value in values.items()}
        motion = solve(plan(mechanism), at, dict.fromkeys(values, 5.0))
        bodies = random_inertias(draw, mechanism)
        rubbing = tuple(
            PinFriction(joint.name, 0.02, 0.1) if isinstance(joint, Pin) else SlideFriction(joint.name, 1.0, 0.05)
            for joint in mechanism.joints
        )
        forces = inverse(motion, bodies, (), rubbing)
        masses, frame = shaking(motion, bodies, ABOUT), on_frame(forces, ABOUT)
        good = forces.status == Status.OK
        if not good.any():
            continue
        size = max(np.abs(forces.pin(joint.name)[good]).max() for joint in mechanism.joints)
        np.testing.assert_allclose(frame.force[good], masses.force[good], atol=1e-9 * size)
        np.testing.assert_allclose(frame.moment[good], masses.moment[good], atol=1e-9 * size)
        usable += 1
    assert usable > 8


def test_harmonics_are_those_of_the_series() -> None:
    found = harmonics(2j + 3 * np.exp(1j * ANGLES) - 1j * np.exp(-2j * ANGLES), 2)
    np.testing.assert_allclose([found[k] for k in range(-2, 3)], [-1j, 0, 2j, 3, 0], atol=1e-13)


def test_a_slider_crank_is_balanced_on_its_crank_by_all_that_turns_and_half_of_what_slides() -> None:
    radius, sliding, turning, speed = 0.1, 2.0, 1.5, 20.0
    motion = solve(plan(slider_crank(radius, 50.0, branch=+1)), ANGLES, speed)  # so long a rod makes it harmonic
    bodies = {"slider": Inertia(sliding, 0j, 0.0), "crank": Inertia(turning, radius + 0j, 0.0)}
    force = shaking(motion, bodies).force
    pair = first_harmonic(force, speed)
    np.testing.assert_allclose(pair, (-radius * (turning + sliding / 2), -radius * sliding / 2), atol=1e-5)
    assert crank_counterweight(force, speed, share=0.5) == pytest.approx(pair.with_crank / 2)

    def left(static_moment: complex) -> np.ndarray:
        weighted = {**bodies, "crank": counterweighted(bodies["crank"], static_moment, 0.08)}
        first = harmonics(shaking(motion, weighted).force, 1)
        return first[1] * np.exp(1j * ANGLES) + first[-1] * np.exp(-1j * ANGLES)

    scale = sliding * radius * speed**2
    np.testing.assert_allclose(np.abs(left(pair.with_crank)), scale / 2, rtol=1e-9)
    in_line = left(crank_counterweight(force, speed, along=0.0))
    np.testing.assert_allclose(in_line.real, 0, atol=1e-9 * scale)
    assert np.max(np.abs(in_line.imag)) == pytest.approx(scale, rel=1e-6)
    tilted = left(crank_counterweight(force, speed, along=0.7)) * np.exp(-0.7j)
    np.testing.assert_allclose(tilted.real, 0, atol=1e-9 * scale)
    turning_back = pair.against_crank * speed**2 * np.exp(-1j * ANGLES)
    np.testing.assert_allclose(left(pair.with_crank) + turning_back, 0, atol=1e-9 * scale)


def test_two_counterweights_balance_a_four_bar_wholly() -> None:
    lengths = {"crank": 0.0597, "coupler": 0.2007, "rocker": 0.2308}
    bodies = {
        "crank": Inertia(0.13, 0.03 + 0.01j, 1e-4),
        "coupler": Inertia(0.43, 0.09 - 0.02j, 2e-3),
        "rocker": Inertia(3.1, 0.26 + 0.03j, 3e-2),
    }
    motion = solve(plan(four_bar(0.3, *lengths.values(), branch=+1)), ANGLES, 15.5, 40.0)
    before = np.max(np.abs(shaking(motion, bodies).force))
    on_crank, on_rocker = four_bar_counterweights(lengths, bodies)
    balanced = bodies | {
        "crank": counterweighted(bodies["crank"], on_crank, 0.05),
        "rocker": counterweighted(bodies["rocker"], on_rocker, 0.2),
    }
    np.testing.assert_allclose(shaking(motion, balanced).force, 0, atol=1e-13 * before)
    # Berkof and Lowen's conditions: m2 r2 = m3 r3' a2/a3 opposite to r3', m4 r4 = m3 r3 a4/a3 opposite to r3
    crank, coupler, rocker = (balanced[name] for name in lengths)
    other_end = coupler.centre - lengths["coupler"]
    expected = coupler.mass * other_end * lengths["crank"] / lengths["coupler"]
    assert crank.mass * crank.centre == pytest.approx(expected, rel=1e-12)
    expected = -coupler.mass * coupler.centre * lengths["rocker"] / lengths["coupler"]
    assert rocker.mass * rocker.centre == pytest.approx(expected, rel=1e-12)


def test_duty_of_an_even_wave() -> None:
    found = cyclic_torque(lambda angle, _: 3.0 + 2.0 * np.cos(angle - 0.4))
    assert (found.mean, found.rms, found.peak.value) == pytest.approx((3.0, np.sqrt(11.0), 5.0), rel=1e-12)
    assert found.excess == pytest.approx(4.0, rel=1e-12)
    np.testing.assert_allclose([found.slowest, found.fastest], [0.4 + np.pi / 2, 0.4 + 3 * np.pi / 2], atol=1e-6)


def test_duty_of_a_press_that_works_in_a_window() -> None:
    def torque(angle: np.ndarray, side: np.ndarray) -> np.ndarray:
        at = np.mod(angle + 1e-9 * side - 5.5, TURN)
        return np.where(at < 1.5, 100.0, 4.0)

    found = cyclic_torque(torque, (5.5, 7.0))
    mean = (100 * 1.5 + 4 * (TURN - 1.5)) / TURN
    assert (found.mean, found.peak.value) == pytest.approx((mean, 100.0), rel=1e-12)
    assert found.excess == pytest.approx((100 - mean) * 1.5, rel=1e-12)
    assert (found.fastest, found.slowest) == pytest.approx((5.5, 7.0 - TURN), rel=1e-12)


def test_duty_of_a_needle_of_a_torque() -> None:
    width = 2e-3
    found = cyclic_torque(lambda angle, _: np.exp(np.cos(angle - 1.0) / width**2 - 1 / width**2))
    assert found.mean == pytest.approx(width / np.sqrt(TURN), rel=1e-5)
    assert found.peak.value == pytest.approx(1.0, rel=1e-9)


def test_a_flywheel_keeps_the_speed_within_its_fluctuation() -> None:
    rotor = Mechanism(
        bodies=(Body(GROUND, {"O": 0}), Body("rotor", {"O": 0})),
        joints=(Pin("O", GROUND, "rotor"),),
        inputs=(Rotation("rotor", "O"),),
    )
    planned, out_of_balance = plan(rotor), {"rotor": Inertia(2.0, 0.05 + 0.02j, 0.01)}

    def asked(angle: np.ndarray, _: np.ndarray) -> np.ndarray:
        return inverse(solve(planned, angle, 12.0), out_of_balance, (Gravity(-9.81j),)).effort("rotor")

    found = cyclic_torque(asked)
    assert found.excess == pytest.approx(2 * 2.0 * 9.81 * abs(0.05 + 0.02j), rel=1e-12)
    wheel = flywheel(found.excess, 12.0, 0.03) - out_of_balance["rotor"].about(0)
    reduced = reduce(planned, out_of_balance, (Gravity(-9.81j),), flywheel=wheel)
    run = forward(reduced, ForwardState(found.fastest, 12.0 * 1.015), 1.2, every=1e-4)
    most, least = run.speed.max(), run.speed.min()
    assert (most - least) / ((most + least) / 2) == pytest.approx(0.03, rel=1e-4)
    slowest = float(np.mod(run.position[np.argmin(run.speed)], TURN))
    assert slowest == pytest.approx(found.slowest, abs=0.02)


def test_bad_numbers_are_refused() -> None:
    with pytest.raises(MechanismError, match="speed fluctuation is 0"):
        flywheel(1.0, 1.0, 0.0)
    with pytest.raises(MechanismError, match="give a speed"):
        flywheel(1.0, 0.0, 0.1)
    with pytest.raises(MechanismError, match="radius of a counterweight is 0"):
        counterweighted(Inertia(1.0, 0j, 0.0), 1 + 0j, 0.0)
