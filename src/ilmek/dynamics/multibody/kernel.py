# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""Compiled kernels for planar multibody systems: equations, augmented Lagrangian, projection, and the integrator.

Coordinates are x, y, theta of every mass centre; the mass matrix M is diagonal. With joints c(q) = 0, J = dc/dq:

    M a + J^T f = F,      J a = -b(q, v)                                              [index 1]

is solved by the augmented Lagrangian method:  (M + J^T W J) da = r1 + J^T W r2,  f -= W (r2 - J da),  from a = f = 0,
with r1 and r2 the residuals of the two equations. M + J^T W J is positive definite for any rank of J. With redundant
joints or in a singular pose the solution is that of least norm; directions whose constraint in J is weaker than about
1e-5 of the others are free at that instant [Bayo and Ledesma, Nonlinear Dynamics 9 (1996)]. Each joint has its own
W = w / (J M^-1 J^T), so that joints of light and of heavy bodies are equally stiff. The norm of the reactions is
Σ f^T W^-1 f: mass times (acceleration)² that the force of each joint alone would give to its two bodies. Positions and
velocities are projected onto the joint equations after every step, in the norm of the masses. The integrator is the
Dormand-Prince method of order 8 [Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, II.10].
"""

from typing import NamedTuple

import numpy as np

from ilmek.num.compiled import compiled

PENALTY = 1e9
"""Penalty factor w of the joints: W times a joint's inverse effective mass J M^-1 J^T."""

MAX_ITERATIONS = 5
"""Greatest number of iterations of the augmented Lagrangian; one or two suffice away from singular poses."""


class Model(NamedTuple):
    """A system as arrays; body -1 is the ground.

    masses        of the coordinates [kg, kg, kg m²], three per body
    gravity       acceleration [m/s²], complex
    ends          the two bodies of each element
    arms          their points relative to the mass centres [m], complex; of the ground relative to its origin
    numbers       further values of an element: slide (direction of the line, relative angle), spring (stiffness, free
                  length, damping), force (its components)
    pins, slides, springs, forces   number of elements of each kind, in this order; clearance pins are last
    contacts      per clearance pin: stiffness, exponent, hysteresis, journal's radius, clearance, friction, slip, and
                  the effective mass of its two bodies
    torques       torque [N m] and viscous drag [N m s] on each body
    joint_bodies  the two bodies of each joint equation
    length        characteristic length of the system [m]
    band          half bandwidth of M + J^T W J
    """

    masses: np.ndarray
    gravity: complex
    ends: np.ndarray
    arms: np.ndarray
    numbers: np.ndarray
    pins: int
    slides: int
    springs: int
    forces: int
    contacts: np.ndarray
    torques: np.ndarray
    joint_bodies: np.ndarray
    length: float
    band: int


@compiled
def arm_of(model: Model, q: np.ndarray, v: np.ndarray, at: int, side: int) -> tuple[complex, complex, complex, complex]:
    """Arm, position [m], velocity [m/s], acceleration bias -w² r [m/s²] of one side of an element, in the ground frame.

    q, v  coordinates [m, rad] and their rates, shape (3 bodies,)      at, side  element; 0 first body, 1 second body
    """
    body, arm = model.ends[at, side], model.arms[at, side]
    if body < 0:
        return arm, arm, 0j, 0j
    angle, omega = q[3 * body + 2], v[3 * body + 2]
    arm = arm * complex(np.cos(angle), np.sin(angle))
    position = complex(q[3 * body], q[3 * body + 1]) + arm
    velocity = complex(v[3 * body], v[3 * body + 1]) + 1j * omega * arm
    return arm, position, velocity, -omega * omega * arm


@compiled
def dot(a: complex, b: complex) -> float:
    """Scalar product of two planar vectors."""
    return a.real * b.real + a.imag * b.imag


@compiled
def _row(rows: np.ndarray, at: int, first: complex, rotated: float, second: complex, back: float) -> None:
    rows[at, 0], rows[at, 1], rows[at, 2] = first.real, first.imag, rotated
    rows[at, 3], rows[at, 4], rows[at, 5] = second.real, second.imag, back


@compiled
def joints(model: Model, q: np.ndarray, v: np.ndarray, gap: np.ndarray, rows: np.ndarray, bias: np.ndarray) -> None:
    """Gaps c [m], Jacobian rows (x, y, theta of the first body, then of the second) and bias b of all joints."""
    for k in range(model.pins):
        r, p, _, first = arm_of(model, q, v, k, 0)
        s, g, _, second = arm_of(model, q, v, k, 1)
        apart, extra = p - g, first - second
        _row(rows, 2 * k, 1 + 0j, -r.imag, -1 + 0j, s.imag)
        _row(rows, 2 * k + 1, 1j, r.real, -1j, -s.real)
        gap[2 * k], gap[2 * k + 1] = apart.real, apart.imag
        bias[2 * k], bias[2 * k + 1] = extra.real, extra.imag
    for k in range(model.pins, model.pins + model.slides):
        body, guide = model.ends[k, 0], model.ends[k, 1]
        r, p, pv, first = arm_of(model, q, v, k, 0)
        s, g, gv, second = arm_of(model, q, v, k, 1)
        theta, spin = (q[3 * guide + 2], v[3 * guide + 2]) if guide >= 0 else (0.0, 0.0)
        own = q[3 * body + 2] if body >= 0 else 0.0
        line = theta + model.numbers[k, 0]
        f = 1j * complex(np.cos(line), np.sin(line))
        apart, rotated = p - g, 1j * f
        gap[2 * k] = dot(f, apart)
        _row(rows, 2 * k, f, dot(f, 1j * r), -f, dot(rotated, apart) - dot(f, 1j * s))
        bias[2 * k] = dot(f, first - second) + 2 * spin * dot(rotated, pv - gv) - spin * spin * gap[2 * k]
        gap[2 * k + 1] = model.length * (own - theta - model.numbers[k, 1])
        _row(rows, 2 * k + 1, 0j, model.length, 0j, -model.length)
        bias[2 * k + 1] = 0.0


@compiled
def applied(model: Model, q: np.ndarray, v: np.ndarray, out: np.ndarray) -> float:
    """Applied forces F at the mass centres; returns the power of all except gravity and elastic springs [W]."""
    power = 0.0
    for k in range(model.masses.shape[0] // 3):
        mass = model.masses[3 * k]
        out[3 * k], out[3 * k + 1] = mass * model.gravity.real, mass * model.gravity.imag
        out[3 * k + 2] = model.torques[k, 0] - model.torques[k, 1] * v[3 * k + 2]
        power += out[3 * k + 2] * v[3 * k + 2]
    start = model.pins + model.slides
    for k in range(start, start + model.springs):
        r, p, pv, _ = arm_of(model, q, v, k, 0)
        s, g, gv, _ = arm_of(model, q, v, k, 1)
        size = abs(p - g)
        along = (p - g) / size if size > 0 else 0j
        rate = dot(along, pv - gv)
        force = -(model.numbers[k, 0] * (size - model.numbers[k, 1]) + model.numbers[k, 2] * rate) * along
        power -= model.numbers[k, 2] * rate * rate
        push(out, model.ends[k, 0], r, force)
        push(out, model.ends[k, 1], s, -force)
    start += model.springs
    for k in range(start, start + model.forces):
        r, _, pv, _ = arm_of(model, q, v, k, 0)
        force = complex(model.numbers[k, 0], model.numbers[k, 1])
        push(out, model.ends[k, 0], r, force)
        power += dot(force, pv)
    return power


@compiled
def push(out: np.ndarray, body: int, arm: complex, force: complex) -> None:
    """Add a force [N] at an arm [m] to the force and moment at a body's mass centre."""
    if body >= 0:
        out[3 * body] += force.real
        out[3 * body + 1] += force.imag
        out[3 * body + 2] += arm.real * force.imag - arm.imag * force.real


@compiled
def penalties(model: Model, rows: np.ndarray, out: np.ndarray) -> None:
    """Penalty W of each joint, a symmetric 2 by 2 matrix (xx, xy, yy): PENALTY / (J M^-1 J^T) of this joint alone.

    rows  J, shape (2 joints, 6)      out  shape (joints, 3), written
    """
    for k in range(out.shape[0]):
        xx, xy, yy = 0.0, 0.0, 0.0
        for a in range(6):
            body = model.joint_bodies[2 * k, a // 3]
            if body >= 0:
                ease = 1.0 / model.masses[3 * body + a % 3]
                xx += ease * rows[2 * k, a] ** 2
                xy += ease * rows[2 * k, a] * rows[2 * k + 1, a]
                yy += ease * rows[2 * k + 1, a] ** 2
        scale = PENALTY / max(xx * yy - xy * xy, 1e-14 * xx * yy)
        out[k, 0], out[k, 1], out[k, 2] = scale * yy, -scale * xy, scale * xx


@compiled
def _add_penalty(joint_bodies: np.ndarray, pair: np.ndarray, penalty: np.ndarray, band: int, root: np.ndarray) -> None:
    """Add J^T W J of one joint (two rows) to the lower band."""
    for a in range(6):
        i = 3 * joint_bodies[a // 3] + a % 3
        first = penalty[0] * pair[0, a] + penalty[1] * pair[1, a]
        second = penalty[1] * pair[0, a] + penalty[2] * pair[1, a]
        if i < 0:
            continue
        for b in range(6):
            j = 3 * joint_bodies[b // 3] + b % 3
            if 0 <= j <= i:
                root[i, j - i + band] += first * pair[0, b] + second * pair[1, b]


@compiled
def factor(model: Model, rows: np.ndarray, penalty: np.ndarray, root: np.ndarray) -> None:
    """Cholesky factor of M + J^T W J within its band: root[i, j - i + band] = L_ij."""
    masses, joint_bodies, band = model.masses, model.joint_bodies, model.band
    count = masses.shape[0]
    for i in range(count):
        for j in range(band):
            root[i, j] = 0.0
        root[i, band] = masses[i]
    for k in range(penalty.shape[0]):
        _add_penalty(joint_bodies[2 * k], rows[2 * k : 2 * k + 2], penalty[k], band, root)
    for i in range(count):
        for j in range(max(0, i - band), i + 1):
            total = root[i, j - i + band]
            for m in range(max(0, i - band), j):
                total -= root[i, m - i + band] * root[j, m - j + band]
            root[i, j - i + band] = np.sqrt(total) if i == j else total / root[j, band]


@compiled
def _substitute(root: np.ndarray, band: int, x: np.ndarray) -> None:
    count = x.shape[0]
    for i in range(count):
        for m in range(max(0, i - band), i):
            x[i] -= root[i, m - i + band] * x[m]
        x[i] /= root[i, band]
    for i in range(count - 1, -1, -1):
        x[i] /= root[i, band]
        for m in range(max(0, i - band), i):
            x[m] -= root[i, m - i + band] * x[i]


@compiled
def row_product(model: Model, row: np.ndarray, k: int, x: np.ndarray) -> float:
    """One row of J times x."""
    total = 0.0
    for a in range(6):
        if model.joint_bodies[k, a // 3] >= 0:
            total += row[a] * x[3 * model.joint_bodies[k, a // 3] + a % 3]
    return total


@compiled
def _add_transposed(model: Model, row: np.ndarray, k: int, size: float, x: np.ndarray) -> None:
    """Add one row of J, times `size`, to x."""
    for a in range(6):
        if model.joint_bodies[k, a // 3] >= 0:
            x[3 * model.joint_bodies[k, a // 3] + a % 3] += row[a] * size


@compiled
def _penalty_force(penalty: np.ndarray, residual: np.ndarray, k: int) -> float:
    """One row of W times the residual."""
    joint, second = k // 2, k % 2
    total: float = penalty[joint, second] * residual[2 * joint] + penalty[joint, second + 1] * residual[2 * joint + 1]
    return total


@compiled
def _iterate(
    model: Model,
    rows: np.ndarray,
    penalty: np.ndarray,
    root: np.ndarray,
    force: np.ndarray,
    required: np.ndarray,
    solution: np.ndarray,
    reaction: np.ndarray,
    step: np.ndarray,
    residual: np.ndarray,
) -> None:
    """One iteration of the augmented Lagrangian; the increment of `solution` is written to `step`."""
    count = reaction.shape[0]
    for i in range(solution.shape[0]):
        step[i] = force[i] - model.masses[i] * solution[i]
    for k in range(count):
        residual[k] = required[k] - row_product(model, rows[k], k, solution)
    for k in range(count):
        _add_transposed(model, rows[k], k, _penalty_force(penalty, residual, k) - reaction[k], step)
    _substitute(root, model.band, step)
    for k in range(count):
        residual[k] -= row_product(model, rows[k], k, step)
    for k in range(count):
        reaction[k] -= _penalty_force(penalty, residual, k)
    for i in range(solution.shape[0]):
        solution[i] += step[i]


@compiled
def constrained(
    model: Model,
    rows: np.ndarray,
    penalty: np.ndarray,
    root: np.ndarray,
    force: np.ndarray,
    required: np.ndarray,
    solution: np.ndarray,
    reaction: np.ndarray,
) -> None:
    """Solve M solution + J^T reaction = force, J solution = required; `root` is from `factor`.

    rows               J, shape (2 joints, 6)          penalty   of `penalties`, shape (joints, 3)
    force, solution    shape (3 bodies,), [N, N m] and [m/s², rad/s²] for accelerations; solution is written
    required, reaction shape (2 joints,); reaction is written
    """
    size, count = solution.shape[0], reaction.shape[0]
    step, residual = np.empty(size), np.empty(count)
    for i in range(size):
        solution[i] = 0.0
    for k in range(count):
        reaction[k] = 0.0
    for _ in range(MAX_ITERATIONS):
        _iterate(model, rows, penalty, root, force, required, solution, reaction, step, residual)
        most, moved = 0.0, 0.0
        for i in range(size):
            most = max(most, solution[i] * solution[i] * model.masses[i])
            moved = max(moved, step[i] * step[i] * model.masses[i])
        if not moved > 1e-28 * most:
            break
