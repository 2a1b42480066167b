# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""Compiled kernels for planar multibody systems: equations, augmented Lagrangian, projection, and the integrator.

Coordinates are x, y, theta of every mass centre, so the masses M are a diagonal. With joints c(q) = 0, J = dc/dq:

    M a + J^T f = F,      J a = -b(q, v)                                              [index 1]

is solved by the augmented Lagrangian:  (M + J^T W J) da = r1 + J^T W r2,  f -= W (r2 - J da),  from a = f = 0, where
r1 and r2 are what is left of the two equations. M + J^T W J is positive definite whatever the rank of J: where joints
are redundant or the mechanism stands in a singular pose the answer is the one of least norm, and directions that J
holds by less than about 1e-5 of the rest are let go for that instant [Bayo and Ledesma, Nonlinear Dynamics 9 (1996)].
Each joint's own W = w / (J M^-1 J^T), not one number for all, so that bodies of any masses are held alike; the least
norm of the reactions is Σ f^T W^-1 f: what each joint's force alone would give its two bodies in (acceleration)² mass.
Positions and velocities are projected onto the joints after every step, in the norm of the masses. The integrator is
Dormand and Prince's of order 8 [Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, II.10].
"""

from typing import NamedTuple

import numpy as np

from ilmek.num.compiled import compiled

GRIP = 1e9
"""Weight w of the joints against the masses: W times a joint's mobility J M^-1 J^T."""

ROUNDS = 5
"""Most iterations of the augmented Lagrangian; one or two are enough away from singular poses."""


class Model(NamedTuple):
    """A system as arrays; body -1 is the ground, whose arms are places in the world.

    weights   of the coordinates [kg, kg, kg m²]      gravity  free fall [m/s²]
    ends      bodies of each element, arms their points from the mass centres [m], numbers what else it needs:
              pins, slides (line's direction, angle held), springs (stiffness, free length, damping), pushes (force);
              pins, slides, springs, pushes: how many there are, in this order, clearance pins last
    contacts  of each clearance pin: stiffness, exponent, hysteresis, journal's radius, clearance, friction, slip, and
              the two bodies' masses in series
    twists    torque [N m] and viscous drag [N m s] on each body
    touched   bodies of each joint equation           length  of the system [m]      band  of M + J^T W J
    """

    weights: np.ndarray
    gravity: complex
    ends: np.ndarray
    arms: np.ndarray
    numbers: np.ndarray
    pins: int
    slides: int
    springs: int
    pushes: int
    contacts: np.ndarray
    twists: np.ndarray
    touched: np.ndarray
    length: float
    band: int


@compiled
def arm_of(model: Model, q: np.ndarray, v: np.ndarray, at: int, side: int) -> tuple[complex, complex, complex, complex]:
    """World arm, position and velocity of one side of an element, and its bias -w² r."""
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
    """Scalar product of two plane vectors."""
    return a.real * b.real + a.imag * b.imag


@compiled
def _row(rows: np.ndarray, at: int, first: complex, turned: float, second: complex, back: float) -> None:
    rows[at, 0], rows[at, 1], rows[at, 2] = first.real, first.imag, turned
    rows[at, 3], rows[at, 4], rows[at, 5] = second.real, second.imag, back


@compiled
def joints(model: Model, q: np.ndarray, v: np.ndarray, gap: np.ndarray, rows: np.ndarray, bias: np.ndarray) -> None:
    """Gaps c, Jacobian rows (x, y, theta of the first body, then of the second) and bias b of all joints."""
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
        apart, turned = p - g, 1j * f
        gap[2 * k] = dot(f, apart)
        _row(rows, 2 * k, f, dot(f, 1j * r), -f, dot(turned, apart) - dot(f, 1j * s))
        bias[2 * k] = dot(f, first - second) + 2 * spin * dot(turned, pv - gv) - spin * spin * gap[2 * k]
        gap[2 * k + 1] = model.length * (own - theta - model.numbers[k, 1])
        _row(rows, 2 * k + 1, 0j, model.length, 0j, -model.length)
        bias[2 * k + 1] = 0.0


@compiled
def applied(model: Model, q: np.ndarray, v: np.ndarray, out: np.ndarray) -> float:
    """Applied forces F on the mass centres, and the power of all but weights and springs' stiffness [W]."""
    power = 0.0
    for k in range(model.weights.shape[0] // 3):
        mass = model.weights[3 * k]
        out[3 * k], out[3 * k + 1] = mass * model.gravity.real, mass * model.gravity.imag
        out[3 * k + 2] = model.twists[k, 0] - model.twists[k, 1] * v[3 * k + 2]
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
    for k in range(start, start + model.pushes):
        r, _, pv, _ = arm_of(model, q, v, k, 0)
        force = complex(model.numbers[k, 0], model.numbers[k, 1])
        push(out, model.ends[k, 0], r, force)
        power += dot(force, pv)
    return power


@compiled
def push(out: np.ndarray, body: int, arm: complex, force: complex) -> None:
    """Add a force at an arm to the forces on a body's mass centre."""
    if body >= 0:
        out[3 * body] += force.real
        out[3 * body + 1] += force.imag
        out[3 * body + 2] += arm.real * force.imag - arm.imag * force.real


@compiled
def grips(model: Model, rows: np.ndarray, out: np.ndarray) -> None:
    """Weight W of each joint, a symmetric 2 by 2 (xx, xy, yy): GRIP / (J M^-1 J^T) of this joint alone."""
    for k in range(out.shape[0]):
        xx, xy, yy = 0.0, 0.0, 0.0
        for a in range(6):
            body = model.touched[2 * k, a // 3]
            if body >= 0:
                ease = 1.0 / model.weights[3 * body + a % 3]
                xx += ease * rows[2 * k, a] ** 2
                xy += ease * rows[2 * k, a] * rows[2 * k + 1, a]
                yy += ease * rows[2 * k + 1, a] ** 2
        scale = GRIP / max(xx * yy - xy * xy, 1e-14 * xx * yy)
        out[k, 0], out[k, 1], out[k, 2] = scale * yy, -scale * xy, scale * xx


@compiled
def _weigh(touched: np.ndarray, pair: np.ndarray, grip: np.ndarray, band: int, root: np.ndarray) -> None:
    """Add J^T W J of one joint, two rows, to the lower band."""
    for a in range(6):
        i = 3 * touched[a // 3] + a % 3
        first = grip[0] * pair[0, a] + grip[1] * pair[1, a]
        second = grip[1] * pair[0, a] + grip[2] * pair[1, a]
        if i < 0:
            continue
        for b in range(6):
            j = 3 * touched[b // 3] + b % 3
            if 0 <= j <= i:
                root[i, j - i + band] += first * pair[0, b] + second * pair[1, b]


@compiled
def factor(model: Model, rows: np.ndarray, grip: np.ndarray, root: np.ndarray) -> None:
    """Cholesky factor of M + J^T W J within its band: root[i, j - i + band] = L_ij."""
    weights, touched, band = model.weights, model.touched, model.band
    count = weights.shape[0]
    for i in range(count):
        for j in range(band):
            root[i, j] = 0.0
        root[i, band] = weights[i]
    for k in range(grip.shape[0]):
        _weigh(touched[2 * k], rows[2 * k : 2 * k + 2], grip[k], band, root)
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
def along(model: Model, row: np.ndarray, k: int, x: np.ndarray) -> float:
    """One row of J times x."""
    total = 0.0
    for a in range(6):
        if model.touched[k, a // 3] >= 0:
            total += row[a] * x[3 * model.touched[k, a // 3] + a % 3]
    return total


@compiled
def _back(model: Model, row: np.ndarray, k: int, size: float, x: np.ndarray) -> None:
    """To x is added J^T of one row times a size."""
    for a in range(6):
        if model.touched[k, a // 3] >= 0:
            x[3 * model.touched[k, a // 3] + a % 3] += row[a] * size


@compiled
def _pull(grip: np.ndarray, missing: np.ndarray, k: int) -> float:
    """One row of W times what is missing."""
    joint, second = k // 2, k % 2
    pulled: float = grip[joint, second] * missing[2 * joint] + grip[joint, second + 1] * missing[2 * joint + 1]
    return pulled


@compiled
def _round(
    model: Model,
    rows: np.ndarray,
    grip: np.ndarray,
    root: np.ndarray,
    force: np.ndarray,
    wanted: np.ndarray,
    found: np.ndarray,
    reaction: np.ndarray,
    step: np.ndarray,
    missing: np.ndarray,
) -> None:
    """One iteration of the augmented Lagrangian; into `step` goes what it added to `found`."""
    count = reaction.shape[0]
    for i in range(found.shape[0]):
        step[i] = force[i] - model.weights[i] * found[i]
    for k in range(count):
        missing[k] = wanted[k] - along(model, rows[k], k, found)
    for k in range(count):
        _back(model, rows[k], k, _pull(grip, missing, k) - reaction[k], step)
    _substitute(root, model.band, step)
    for k in range(count):
        missing[k] -= along(model, rows[k], k, step)
    for k in range(count):
        reaction[k] -= _pull(grip, missing, k)
    for i in range(found.shape[0]):
        found[i] += step[i]


@compiled
def constrained(
    model: Model,
    rows: np.ndarray,
    grip: np.ndarray,
    root: np.ndarray,
    force: np.ndarray,
    wanted: np.ndarray,
    found: np.ndarray,
    reaction: np.ndarray,
) -> None:
    """`found` and `reaction` of M found + J^T reaction = force, J found = wanted; `root` from `factor`."""
    size, count = found.shape[0], reaction.shape[0]
    step, missing = np.empty(size), np.empty(count)
    for i in range(size):
        found[i] = 0.0
    for k in range(count):
        reaction[k] = 0.0
    for _ in range(ROUNDS):
        _round(model, rows, grip, root, force, wanted, found, reaction, step, missing)
        most, moved = 0.0, 0.0
        for i in range(size):
            most = max(most, found[i] * found[i] * model.weights[i])
            moved = max(moved, step[i] * step[i] * model.weights[i])
        if not moved > 1e-28 * most:
            break
