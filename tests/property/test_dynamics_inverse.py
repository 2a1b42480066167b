"""Inverse dynamics against virtual power, Lagrange, momentum, statics, and the slider-crank by hand."""

from typing import TypeAlias

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from mechanisms import slotted_lever

from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.loads import Gravity, Load, PointForce, Torque
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import GROUND, Mechanism
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

ANGLES = np.arange(128) * (2 * np.pi / 128)
GRAVITY = 3.0 - 9.0j


# Numbers only: what stands for a task is built in the test, because the run-time type checks draw random items.
coordinates = st.floats(-0.3, 0.3)
numbers = st.tuples(st.floats(0.1, 3.0), coordinates, coordinates, st.floats(1e-4, 0.1))
kinds = st.sampled_from(("four-bar", "crossed four-bar", "slider-crank"))
tasks = st.tuples(kinds, st.floats(0.2, 0.8), st.tuples(numbers, numbers, numbers), st.floats(0.5, 20.0))
# Solved by Newton's method, which takes its time under the type checks: one task is enough.
LEVER = ("slotted lever", 0.5, ((0.5, 0.03, 0.01, 0.01), (0.2, 0.01, -0.02, 0.002), (2.0, 0.2, 0.05, 0.06)), 12.0)
Numbers: TypeAlias = tuple[str, float, tuple[tuple[float, float, float, float], ...], float]


def built(task: Numbers) -> tuple[Mechanism, dict[str, Inertia], float]:
    kind, part, given, speed = task
    if kind == "slider-crank":
        mechanism = slider_crank(0.1, 0.2 + 0.2 * part, branch=+1, offset=0.1 * part - 0.05)
    elif kind == "slotted lever":
        mechanism = slotted_lever()
    else:
        branch = +1 if kind == "four-bar" else -1
        mechanism = four_bar(0.3, 0.03 + 0.05 * part, 0.2 + 0.1 * part, 0.25, branch=branch)
    bodies = (Inertia(mass, complex(x, y), moment) for mass, x, y, moment in given)
    return mechanism, dict(zip(mechanism.moving, bodies, strict=True)), speed


def energies(motion: Motion, bodies: dict[str, Inertia]) -> tuple[np.ndarray, np.ndarray]:
    """Kinetic energy and potential energy of the weight: positions and velocities only."""
    kinetic, potential = np.zeros(len(motion)), np.zeros(len(motion))
    for body, inertia in bodies.items():
        centre = motion.carried(body, inertia.centre)
        kinetic += (inertia.mass * np.abs(centre.velocity) ** 2 + inertia.moment * motion.omega(body) ** 2) / 2
        potential -= inertia.mass * np.real(np.conj(GRAVITY) * centre.position)
    return kinetic, potential


def slope(periodic: np.ndarray) -> np.ndarray:
    """Derivative over the angle of a periodic function, by its Fourier series."""
    return np.fft.irfft(1j * np.arange(periodic.size // 2 + 1) * np.fft.rfft(periodic), periodic.size)


@settings(max_examples=30)
@given(tasks, st.floats(-50.0, 50.0))
@example(LEVER, 7.0)
def test_virtual_power_is_zero(task: Numbers, alpha: float) -> None:
    mechanism, bodies, speed = built(task)
    last = mechanism.moving[-1]
    loads: tuple[Load, ...] = (
        Gravity(GRAVITY),
        PointForce((last, 0.1 - 0.05j), lambda motion: -20 * motion.carried(last, 0.1 - 0.05j).velocity),
        Torque(mechanism.moving[1], np.cos(ANGLES)),
    )
    forces = inverse(solve(plan(mechanism), ANGLES, speed, alpha).require(), bodies, loads)
    assert forces.power_error < 1e-10
    np.testing.assert_allclose(forces.input_power, forces.effort("crank") * speed, rtol=1e-12, atol=1e-12)


@settings(max_examples=30)
@given(tasks)
@example(LEVER)
def test_drive_torque_is_that_of_lagrange(task: Numbers) -> None:
    mechanism, bodies, speed = built(task)
    motion = solve(plan(mechanism), ANGLES, speed).require()
    forces = inverse(motion, bodies, (Gravity(GRAVITY),))
    kinetic, potential = energies(motion, bodies)
    # T = J' ω²/2 + V' at constant speed, with J = 2 E / ω².
    expected = slope(kinetic) + slope(potential)
    torque = forces.effort("crank")
    np.testing.assert_allclose(torque, expected, atol=1e-8 * np.max(np.abs(expected)) + 1e-8)
    assert np.mean(torque) == pytest.approx(0.0, abs=1e-9 * np.max(np.abs(torque)) + 1e-12)


@settings(max_examples=30)
@given(tasks)
@example(LEVER)
def test_the_ground_takes_up_the_momentum(task: Numbers) -> None:
    mechanism, bodies, speed = built(task)
    motion = solve(plan(mechanism), ANGLES, speed).require()
    forces = inverse(motion, bodies, (Gravity(GRAVITY),))
    force, moment = np.zeros(len(motion), complex), forces.effort("crank").copy()
    for joint in mechanism.joints:
        if GROUND not in joint.bodies:
            continue
        moving = next(body for body in joint.bodies if body != GROUND)
        pushed = forces.pin(joint.name, on=moving)
        force += pushed
        moment += np.imag(np.conj(motion.point(moving, joint.name).position) * pushed)
        moment += forces.couples.get(joint.name, 0.0)
    for body, inertia in bodies.items():
        centre = motion.carried(body, inertia.centre)
        change = inertia.mass * (centre.acceleration - GRAVITY)
        force -= change
        moment -= np.imag(np.conj(centre.position) * change) + inertia.moment * motion.alpha(body)
    scale = 1e-10 * max(np.max(np.abs(forces.pin(joint.name))) for joint in mechanism.joints) + 1e-12
    assert np.max(np.abs(force)) < scale
    assert np.max(np.abs(moment)) < scale
