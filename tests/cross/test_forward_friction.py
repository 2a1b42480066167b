"""Forward runs with a motor and Coulomb friction, and with two inputs, against equations of motion of the one machine.

The slider-crank's are Newton and Euler for three bodies, with the friction found by repeated substitution; the
five-bar's Lagrange's, with derivatives of its positions by differences. scipy's `solve_ivp` integrates both.
"""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import ilmek
from ilmek.dynamics.forward import EndKind, ForwardState, forward
from ilmek.dynamics.friction import Friction
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.joint_friction import PinFriction, SlideFriction
from ilmek.dynamics.loads import Gravity, Load
from ilmek.dynamics.motor_drive import MotorDrive
from ilmek.dynamics.reduced import ReducedMechanism, reduce
from ilmek.dynamics.springs import Spring
from ilmek.linkage.fourbar import slider_crank
from ilmek.linkage.model import Body, Displacement, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.structure import plan

FALL = 9.81
CRANK, ROD, GUIDE = 0.05, 0.17, 0.1
M2, M3, M4, J2, J3 = 0.8, 0.6, 0.9, 2e-3, 1.5e-3
C2, C3 = 0.02, 0.07
MU, RADIUS, DRAG = 0.12, 0.012, 0.4
STALL, IDLE, WHEEL = 6.0, 30.0, 4e-3


def slider_crank_machine() -> ReducedMechanism:
    inertias = {"crank": Inertia(M2, C2, J2), "rod": Inertia(M3, C3, J3), "slider": Inertia(M4, 0j, 0.0)}
    pins = (PinFriction(name, RADIUS, MU) for name in ("A0", "A", "B"))
    planned = plan(slider_crank(CRANK, ROD, branch=+1))
    slide = next(joint.name for joint in planned.mechanism.joints if type(joint).__name__ == "Slide")
    frictions = (SlideFriction(slide, GUIDE, MU, DRAG), *pins)
    return reduce(planned, inertias, (Gravity(-FALL * 1j),), flywheel=WHEEL, frictions=frictions)


def newton_euler(torque: float, theta: float, omega: float) -> float:
    """Angular acceleration of the crank: eight equations for it and the joint forces, friction by substitution.

    Unknown: theta''; forces of A0 on the crank, of A on the rod, of B on the slider; N of the guide on the slider.
    """
    c, s = math.cos(theta), math.sin(theta)
    phi = -math.asin(CRANK * s / ROD)
    cp, sp = math.cos(phi), math.sin(phi)
    spin = -CRANK * c * omega / (ROD * cp)
    gain, bias = -CRANK * c / (ROD * cp), (CRANK * s * omega**2 + ROD * sp * spin**2) / (ROD * cp)
    a_gain, a_bias = np.array([-CRANK * s, CRANK * c]), -CRANK * omega**2 * np.array([c, s])
    across, along = np.array([-sp, cp]), np.array([cp, sp])
    g3 = a_gain + C3 * gain * across, a_bias + C3 * (bias * across - spin**2 * along)
    g4 = a_gain + ROD * gain * across, a_bias + ROD * (bias * across - spin**2 * along)
    speed = -CRANK * s * omega - ROD * sp * spin
    weight = np.array([0.0, -FALL])
    matrix, fixed = np.zeros((8, 8)), np.zeros(8)
    for k in range(2):
        matrix[k, [0, 1 + k, 3 + k]] = M2 * C2 / CRANK * a_gain[k], -1, 1
        matrix[3 + k, [0, 3 + k, 5 + k]] = M3 * g3[0][k], -1, 1
        matrix[6 + k, [0, 5 + k]] = M4 * g4[0][k], -1
        fixed[k] = M2 * (weight[k] - C2 / CRANK * a_bias[k])
        fixed[3 + k], fixed[6 + k] = M3 * (weight[k] - g3[1][k]), M4 * (weight[k] - g4[1][k])
    matrix[7, 7] = -1
    matrix[2, [0, 3, 4]] = J2 + M2 * C2**2 + WHEEL, -CRANK * s, CRANK * c
    matrix[5, [0, 3, 4, 5, 6]] = J3 * gain, -C3 * sp, C3 * cp, (ROD - C3) * -sp, (ROD - C3) * cp
    found = np.linalg.solve(matrix, fixed)
    for _ in range(100):
        before, right = found, fixed.copy()
        at_a0 = -MU * RADIUS * math.hypot(*found[1:3]) * np.sign(omega)
        at_a = -MU * RADIUS * math.hypot(*found[3:5]) * np.sign(spin - omega)
        at_b = -MU * RADIUS * math.hypot(*found[5:7]) * np.sign(-spin)
        pressed = max(abs(found[7]), 2 * abs(at_b) / GUIDE)
        right[2] += torque - M2 * C2 * c * FALL + at_a0 - at_a
        right[5] += at_a - at_b - J3 * bias
        right[6] += -MU * pressed * np.sign(speed) - DRAG * speed
        found = np.linalg.solve(matrix, right)
        if np.max(np.abs(found - before)) < 1e-14 * np.max(np.abs(found)):
            break
    return float(found[0])


def test_slider_crank_with_motor_and_friction_runs_as_newton_and_euler_say() -> None:
    motor = MotorDrive(STALL, IDLE, slip=1.0, sharp=True)
    run = forward(slider_crank_machine(), ForwardState(2.6, 12.0), 0.1, drive=motor, every=0.02, rtol=1e-9)

    def rates(_time: float, row: np.ndarray) -> tuple[float, float]:
        return row[1], newton_euler(STALL * (1 - row[1] / IDLE), row[0], row[1])

    wanted = solve_ivp(rates, (0.0, 0.1), (2.6, 12.0), t_eval=run.time, method="DOP853", rtol=1e-9, atol=1e-9)
    assert run.position[0] < math.pi < run.position[-1]
    assert np.max(np.abs(run.position - wanted.y[0])) < 1e-6
    assert np.max(np.abs(run.speed / wanted.y[1] - 1)) < 1e-6
    assert run.energy_error < 1e-8


G, A, B = 0.2, 0.1, 0.2
MASS = {"left": 0.5, "first": 0.4, "second": 0.3, "right": 0.6}
ENDS = {"left": A, "first": B, "second": B, "right": A}


def five_bar() -> Mechanism:
    links = {"ground": ("A", "E", G), "left": ("A", "B", A), "first": ("B", "C", B)}
    links |= {"second": ("D", "C", B), "right": ("E", "D", A)}
    pairs = {"A": ("ground", "left"), "B": ("left", "first"), "C": ("first", "second")}
    pairs |= {"D": ("right", "second"), "E": ("ground", "right")}
    return Mechanism(
        tuple(Body(name, {first: 0, last: length}) for name, (first, last, length) in links.items()),
        tuple(Pin(name, *pair) for name, pair in pairs.items()),
        (Rotation("left", "A"), Rotation("right", "E")),
        {"C": -1},
    )


def centres_and_angles(q: np.ndarray) -> np.ndarray:
    """Mass centres of the four bars, x and y in turn, then their angles."""
    b, d = A * np.exp(1j * q[0]), G + A * np.exp(1j * q[1])
    half = abs(d - b) / 2
    c = (b + d) / 2 - 1j * math.sqrt(B**2 - half**2) * (d - b) / (2 * half)
    points = np.array([b / 2, (b + c) / 2, (c + d) / 2, (G + d) / 2])
    return np.concatenate((points.real, points.imag, [q[0], np.angle(c - b), np.angle(c - d), q[1]]))


def accelerations(q: np.ndarray, v: np.ndarray, torque: np.ndarray, wheel: float) -> np.ndarray:
    """q'' of  J^T W (J q'' + X_vv) = torque + J^T F,  with J and the second derivative X_vv along v by differences."""

    def along(way: np.ndarray, h: float, order: int) -> np.ndarray:
        weights = {1: (1, -8, 0, 8, -1), 2: (-1, 16, -30, 16, -1)}[order]
        steps = zip(weights, range(-2, 3), strict=True)
        return sum(w * centres_and_angles(q + k * h * way) for w, k in steps if w) / (12 * h**order)

    jacobian = np.stack([along(way, 1e-3, 1) for way in np.eye(2)], axis=1)
    pace = max(float(np.linalg.norm(v)), 1e-9)
    bend = along(v / pace, 2e-3, 2) * pace**2
    mass = np.array(list(MASS.values()))
    weights = np.concatenate((mass, mass, mass * np.array(list(ENDS.values())) ** 2 / 12))
    force = np.concatenate((np.zeros(4), -FALL * mass, np.zeros(4)))
    matrix = jacobian.T * weights @ jacobian + np.diag([wheel, 0.0])
    return np.linalg.solve(matrix, torque + jacobian.T @ (force - weights * bend))


def test_five_bar_with_a_motor_and_a_free_input_runs_as_lagrange_says() -> None:
    motor = ilmek.MotorDrive(0.9, 8.0, slip=0.6, inertia=0.002)
    inertias = {name: ilmek.bar(0, length, mass=MASS[name]) for name, length in ENDS.items()}
    start, pace = {"left": 2.0, "right": 1.0}, {"left": 1.0, "right": 0.5}
    run = ilmek.forward_dynamics(
        five_bar(),
        inertias,
        0.15,
        position=start,
        speed=pace,
        drive={"left": motor},
        loads=[ilmek.Gravity(-FALL * 1j)],
        every=0.05,
    )

    def rates(_time: float, row: np.ndarray) -> np.ndarray:
        torque = np.array([0.9 * math.tanh((8.0 - row[2]) / (0.6 * 8.0)), 0.0])
        return np.concatenate((row[2:], accelerations(row[:2], row[2:], torque, 0.002)))

    wanted = solve_ivp(rates, (0.0, 0.15), (2.0, 1.0, 1.0, 0.5), t_eval=run.time, method="DOP853", rtol=1e-9, atol=1e-9)
    assert np.max(np.abs(run.position - wanted.y[:2])) < 1e-7
    assert np.max(np.abs(run.speed - wanted.y[2:])) < 1e-6
    assert run.energy_error < 1e-8
    assert set(run.table()) >= {"left position [rad]", "right effort [N*m]"}


@pytest.mark.parametrize("rubbing", ["a load", "a joint"])
def test_a_block_on_a_spring_swings_out_as_coulomb_says_and_is_held(rubbing: str) -> None:
    """Each half swing loses 2 F / c of its amplitude, at the period without friction, until c |x| <= F."""
    mass, stiffness, force, first = 2.0, 200.0, 24.0, 1.0
    bodies = (Body("ground", {"O": 0j, "line": 0j}), Body("block", {"line": 0j}))
    block = Mechanism(bodies, (Slide("line", "block", "ground"),), (Displacement("line"),))
    loads: tuple[Load, ...] = (Spring(("ground", "O"), ("block", "line"), stiffness, 0.0, 0.0), Gravity(-FALL * 1j))
    frictions: tuple[SlideFriction, ...] = ()
    if rubbing == "a load":
        loads += (Friction(("block", "line"), force, "line"),)
    else:
        frictions = (SlideFriction("line", GUIDE, force / (mass * FALL)),)
    reduced = reduce(plan(block), {"block": Inertia(mass, 0j, 0.0)}, loads, frictions=frictions)
    run = forward(reduced, ForwardState(first, -1e-8), 10.0)
    assert run.end.kind is EndKind.HELD
    loss, half = 2 * force / stiffness, math.pi * math.sqrt(mass / stiffness)
    swings = math.ceil((first - force / stiffness) / loss)
    assert abs(run.end.state.time - swings * half) < 1e-6
    assert abs(run.end.state.position - (-1) ** swings * (first - swings * loss)) < 1e-6
