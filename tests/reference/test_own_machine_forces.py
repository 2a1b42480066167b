"""Forces of own machines against calculations that share no code with the engine's force equations.

Slider-crank: closed-form kinematics and the 8 equations of Newton and Euler as one matrix [Norton, Design of Machinery,
section 11.4]. Jansen's leg: drive torque by virtual power, rates by Fourier series of the positions. Class III: all
equations of all bodies as one matrix in world coordinates.
"""

from pathlib import Path

import numpy as np
import pytest
from tests.support.mechanisms import triad

from ilmek.dynamics.inertia import Inertia, bar
from ilmek.dynamics.inverse_run import InverseRun, inverse_run
from ilmek.dynamics.loads import PointForce, Torque
from ilmek.dynamics.own_machine import NamedLoad, OwnMachine
from ilmek.io.mechanism_file import read_mechanism
from ilmek.linkage.fourbar import slider_crank
from ilmek.linkage.model import Mechanism, Pin
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.plane.vectors import cross, dot

EXAMPLES = Path(__file__).parents[2] / "examples"
GRAVITY = -9.81j


def moved(machine: OwnMachine, values: np.ndarray, speed: float) -> InverseRun:
    name = machine.mechanism.inputs[0].name
    motion = solve(plan(machine.mechanism), values, speed)
    return inverse_run(machine, motion, name, (values - values[0]) / speed)


def test_a_slider_crank_has_the_forces_of_newton_and_euler_by_hand() -> None:
    """Crank r, rod l, slider: crank and rod of uniform bars, 5 kg slider, press force P against the motion."""
    r, length, omega, push = 0.05, 0.2, 40.0, -800.0
    crank, rod, mass = bar(0, r, mass=1.0, width=0.04), bar(0, length, mass=1.2, width=0.03), 5.0
    machine = OwnMachine(
        slider_crank(r, length, branch=+1),
        {"crank": crank, "rod": rod, "slider": Inertia(mass, 0j, 0.0)},
        gravity=GRAVITY,
        loads=(NamedLoad("press", PointForce("slider", "B", complex(push))),),
    )
    angle = np.linspace(0, 2 * np.pi, 73)
    found = moved(machine, angle, omega)
    forces = found.forces
    for k, q in enumerate(angle):
        # The rod's angle phi, its rates, and the centres' accelerations, from the loop r e^iq + l e^iphi = x.
        sine = -r / length * np.sin(q)
        cosine = np.sqrt(1 - sine**2)
        phi1 = -r * omega * np.cos(q) / (length * cosine)
        phi2 = (r * omega**2 * np.sin(q) + length * sine * phi1**2) / (length * cosine)
        e, f = complex(np.cos(q), np.sin(q)), complex(cosine, sine)
        a_pin, centre = -(omega**2) * r * e, length / 2 * f
        a_rod = a_pin + (1j * phi2 - phi1**2) * centre
        a_slider = (a_pin + (1j * phi2 - phi1**2) * length * f).real
        # Unknowns: F01x F01y F12x F12y F23x F23y N T; the force Fij acts from body i on body j.
        m, y = np.zeros((8, 8)), np.zeros(8)
        arm = r / 2 * e
        m[0, [0, 2]], m[1, [1, 3]] = (1, -1), (1, -1)
        change = crank.mass * (-(omega**2) * arm - GRAVITY)
        y[0], y[1] = change.real, change.imag
        m[2] = [arm.imag, -arm.real, arm.imag, -arm.real, 0, 0, 0, 1]  # about the crank's centre, at constant speed
        m[3, [2, 4]], m[4, [3, 5]] = (1, -1), (1, -1)
        y[3], y[4] = (rod.mass * (a_rod - GRAVITY)).real, (rod.mass * (a_rod - GRAVITY)).imag
        m[5] = [0, 0, centre.imag, -centre.real, centre.imag, -centre.real, 0, 0]
        y[5] = rod.moment * phi2
        m[6, 4], y[6] = 1, mass * a_slider - push
        m[7, [5, 6]], y[7] = (1, 1), mass * 9.81
        by_hand = np.linalg.solve(m, y)
        pins = [forces.pin("A0", "crank")[k], forces.pin("A", "rod")[k], forces.pin("B", "slider")[k]]
        ours = [part for force in pins for part in (force.real, force.imag)]
        ours += [forces.pin("line", "slider")[k].imag, forces.effort("crank")[k]]
        np.testing.assert_allclose(ours, by_hand, atol=1e-10 * np.abs(by_hand).max())
        shaking = -(crank.mass * -(omega**2) * arm + rod.mass * a_rod + mass * a_slider)
        assert found.shaking.force[k] == pytest.approx(shaking, rel=1e-11)
        assert found.frame.force[k] == pytest.approx(-complex(by_hand[0], by_hand[1] + by_hand[6]), abs=1e-8)


def fourier_rate(values: np.ndarray) -> np.ndarray:
    """d/dq of samples at equal steps over a turn, without its end."""
    number = np.fft.fftfreq(len(values), 1 / len(values))
    return np.fft.ifft(1j * number * np.fft.fft(values))


def test_jansens_leg_needs_the_torque_of_virtual_power() -> None:
    """T omega = Σ (m a · v + J alpha omega) - Σ F · v, with rates by Fourier series of the positions alone."""
    mechanism = read_mechanism(EXAMPLES / "jansen_leg.toml").mechanism
    inertias = {
        body: Inertia(0.1 * (k + 1), complex(np.mean(list(mechanism.body(body).points.values()))), 1e-5 * (k + 1))
        for k, body in enumerate(mechanism.moving)
    }
    foot = NamedLoad("ground", PointForce("leg", "F", 12 + 30j))
    machine = OwnMachine(mechanism, inertias, gravity=GRAVITY, loads=(foot,))
    speed, samples = 7.0, 1024
    angle = np.arange(samples) * 2 * np.pi / samples
    run = moved(machine, angle, speed)
    motion, power = run.forces.motion, np.zeros(samples)
    for body, inertia in inertias.items():
        position = motion.origin(body) + motion.direction(body) * inertia.centre
        velocity = speed * fourier_rate(position)
        acceleration = speed * fourier_rate(velocity)
        omega = speed * (fourier_rate(motion.direction(body)) / (1j * motion.direction(body))).real
        alpha = speed * fourier_rate(omega).real
        power += inertia.mass * dot(acceleration - GRAVITY, velocity) + inertia.moment * alpha * omega
    position = motion.origin("leg") + motion.direction("leg") * mechanism.point("leg", "F")
    power -= dot(12 + 30j, speed * fourier_rate(position))
    np.testing.assert_allclose(run.effort, power / speed, atol=1e-9 * np.abs(power).max())
    assert run.power_residual < 1e-12
    assert run.balance < 1e-12


def test_a_class_three_mechanism_has_the_forces_of_all_equations_at_once() -> None:
    """Three equations of each body in world coordinates, two unknowns of each pin and the torque: one square system."""
    mechanism = triad()
    inertias = {
        body: Inertia(1.0 + k, complex(np.mean(list(mechanism.body(body).points.values()))) + 0.1j, 0.2 + 0.1 * k)
        for k, body in enumerate(mechanism.moving)
    }
    loads = (
        NamedLoad("work", PointForce("plate", "P", 50 - 20j)),
        NamedLoad("brake", Torque("left", -3.0)),
    )
    machine = OwnMachine(mechanism, inertias, gravity=GRAVITY, loads=loads)
    run = moved(machine, np.linspace(-0.2, 0.25, 13), 3.0)
    assert run.forces.motion.ok
    for k in range(13):
        found = dict(zip([one.name for one in mechanism.joints], _all_at_once(machine, run, k), strict=False))
        size = max(abs(force) for force in found.values())
        for joint in mechanism.joints:
            assert run.forces.reactions[joint.name][k] == pytest.approx(found[joint.name], abs=1e-10 * size)
    assert run.power_residual < 1e-12


def _all_at_once(machine: OwnMachine, run: InverseRun, k: int) -> list[complex]:
    """Pin forces on the second body of each pin at one sample."""
    mechanism: Mechanism = machine.mechanism
    motion, bodies = run.forces.motion, machine.mechanism.moving
    pins = [joint for joint in mechanism.joints if isinstance(joint, Pin)]
    m, y = np.zeros((3 * len(bodies), 2 * len(pins) + 1)), np.zeros(3 * len(bodies))
    at = {body: (motion.origin(body)[k], motion.direction(body)[k]) for body in bodies}
    for row, body in enumerate(bodies):
        inertia, (origin, direction) = machine.inertias[body], at[body]
        arm = direction * inertia.centre
        rates = 1j * motion.alpha(body)[k] - motion.omega(body)[k] ** 2
        change = inertia.mass * (motion.acceleration_of_origin(body)[k] + rates * arm - GRAVITY)
        y[3 * row : 3 * row + 3] = change.real, change.imag, inertia.moment * motion.alpha(body)[k]
        for column, pin in enumerate(pins):
            if body in pin.bodies:
                sign = 1.0 if body == pin.second else -1.0
                lever = origin + direction * mechanism.point(body, pin.name) - (origin + arm)
                m[3 * row, 2 * column], m[3 * row + 1, 2 * column + 1] = sign, sign
                m[3 * row + 2, 2 * column : 2 * column + 2] = -sign * lever.imag, sign * lever.real
    plate, left, crank = (3 * bodies.index(name) for name in ("plate", "left", "crank"))
    origin, direction = at["plate"]
    lever = direction * (mechanism.point("plate", "P") - machine.inertias["plate"].centre)
    y[plate] -= 50
    y[plate + 1] += 20
    y[plate + 2] -= cross(lever, 50 - 20j)
    y[left + 2] += 3.0
    m[crank + 2, -1] = 1.0
    found = np.linalg.solve(m, y)
    return [complex(*found[2 * column : 2 * column + 2]) for column in range(len(pins))]
