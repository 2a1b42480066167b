# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""Compiled integration of a planar multibody system: right-hand side, projection, steps of order 8."""

import numpy as np

from ilmek.dynamics.multibody_kernel import Model, along, applied, factor, grips, held, joints
from ilmek.num.compiled import compiled

DONE, TOO_SMALL, TOO_MANY = 0, 1, 2
"""How an integration ended: at its last time, at a step below rounding, at the most steps."""

STAGES = 12
"""Stages of the method; one more evaluation, at the step's end, serves the error and the next step."""


@compiled
def rates(model: Model, y: np.ndarray, out: np.ndarray, reaction: np.ndarray) -> None:
    """Derivative of positions, velocities, work; and the joints' reactions (forces f of J^T f on the left side)."""
    count, size = reaction.shape[0], model.weights.shape[0]
    q, v = y[:size], y[size : 2 * size]
    gap, bias, rows = np.empty(count), np.empty(count), np.empty((count, 6))
    force, root, grip = np.empty(size), np.empty((size, model.band + 1)), np.empty((count // 2, 3))
    joints(model, q, v, gap, rows, bias)
    out[2 * size] = applied(model, q, v, force)
    grips(model, rows, grip)
    factor(model, rows, grip, root)
    for k in range(count):
        bias[k] = -bias[k]
    held(model, rows, grip, root, force, bias, out[size : 2 * size], reaction)
    for i in range(size):
        out[i] = v[i]


@compiled
def project(model: Model, y: np.ndarray) -> float:
    """Move positions, then velocities, onto the joints by the least move in the masses' norm; the gap left [m]."""
    count, size = model.touched.shape[0], model.weights.shape[0]
    q, v = y[:size], y[size : 2 * size]
    gap, bias, rows = np.empty(count), np.empty(count), np.empty((count, 6))
    none, move, reaction = np.zeros(size), np.empty(size), np.empty(count)
    root, grip = np.empty((size, model.band + 1)), np.empty((count // 2, 3))
    open_by, before = 0.0, np.inf
    for _ in range(6):
        joints(model, q, v, gap, rows, bias)
        grips(model, rows, grip)
        factor(model, rows, grip, root)
        open_by = 0.0
        for k in range(count):
            open_by = max(open_by, abs(gap[k]))
            gap[k] = -gap[k]
        if open_by <= 1e-15 * model.length or open_by > 0.5 * before:
            break
        before = open_by
        held(model, rows, grip, root, none, gap, move, reaction)
        for i in range(size):
            q[i] += move[i]
    for _ in range(2):
        for k in range(count):
            bias[k] = -along(model, rows[k], k, v)
        held(model, rows, grip, root, none, bias, move, reaction)
        for i in range(size):
            v[i] += move[i]
    return open_by


@compiled
def _sizes(model: Model, y: np.ndarray, slope: np.ndarray, h: float, out: np.ndarray) -> None:
    """What each number's error is small against: the mechanism's length, a radian, the fastest body, the energy."""
    size = model.weights.shape[0]
    fast, spin, energy = 0.0, 0.0, 0.0
    for i in range(size):
        v, reach = abs(y[size + i]), abs(slope[size + i]) * h
        energy += 0.5 * model.weights[i] * (v * v + reach * reach)
        if i % 3 == 2:
            spin = max(spin, v + reach)
        else:
            fast = max(fast, v + reach)
    for i in range(size):
        turning = i % 3 == 2
        out[i] = 1.0 if turning else model.length
        out[size + i] = (spin if turning else fast) + 1e-12
    out[2 * size] = energy + abs(slope[2 * size]) * h + 1e-300


@compiled
def _error(k: np.ndarray, h: float, scale: np.ndarray, e3: np.ndarray, e5: np.ndarray) -> float:
    """Estimated error of a step over its allowance [Hairer, Norsett and Wanner, II.10: fifth and third order]."""
    fifth, third = 0.0, 0.0
    for i in range(scale.shape[0]):
        a, b = 0.0, 0.0
        for s in range(STAGES + 1):
            a += e5[s] * k[s, i]
            b += e3[s] * k[s, i]
        fifth += (a / scale[i]) ** 2
        third += (b / scale[i]) ** 2
    if fifth == 0.0 and third == 0.0:
        return 0.0
    return h * fifth / np.sqrt((fifth + 0.01 * third) * scale.shape[0])


@compiled
def _combined(y: np.ndarray, h: float, shares: np.ndarray, k: np.ndarray, count: int, out: np.ndarray) -> None:
    """Into out goes y + h Σ shares k."""
    for i in range(y.shape[0]):
        out[i] = y[i]
    for j in range(count):
        if shares[j] != 0.0:
            for i in range(y.shape[0]):
                out[i] += h * shares[j] * k[j, i]


@compiled
def _keep(
    at: int, y: np.ndarray, slope: np.ndarray, f: np.ndarray, states: np.ndarray, slopes: np.ndarray, kept: np.ndarray
) -> None:
    """Write a sample."""
    for i in range(y.shape[0]):
        states[at, i], slopes[at, i] = y[i], slope[i]
    for i in range(f.shape[0]):
        kept[at, i] = f[i]


@compiled
def advance(
    model: Model,
    y: np.ndarray,
    times: np.ndarray,
    rtol: float,
    most: int,
    method: tuple[np.ndarray, np.ndarray, np.ndarray],
    states: np.ndarray,
    slopes: np.ndarray,
    reactions: np.ndarray,
) -> tuple[int, int, int, float]:
    """States, derivatives, reactions at the times, the first being the start's; ending, times reached, steps, time."""
    a, e3, e5 = method
    size = y.shape[0]
    k, new, scale, sizes = np.empty((STAGES + 1, size)), np.empty(size), np.empty(size), np.empty(size)
    f = np.empty(reactions.shape[1])
    t, steps, done = times[0], 0, 0
    rates(model, y, k[0], f)
    _keep(0, y, k[0], f, states, slopes, reactions)
    h = 1e-4 * (times[-1] - times[0])
    while done < times.shape[0] - 1:
        steps += 1
        if steps > most:
            return TOO_MANY, done, steps, t
        left = times[done + 1] - t
        last = h >= left * (1 - 1e-10)
        now = left if last else h
        if not now > 1e-14 * max(abs(t), 1e-300):
            return TOO_SMALL, done, steps, t
        for s in range(1, STAGES + 1):
            _combined(y, now, a[s], k, s, new)
            rates(model, new, k[s], f)
        _sizes(model, y, k[0], now, sizes)
        for i in range(size):
            scale[i] = rtol * (sizes[i] + max(abs(y[i]), abs(new[i])))
        error = _error(k, now, scale, e3, e5)
        if not error < 1.0:
            h = now * (max(0.2, 0.9 * error**-0.125) if error < 1e300 else 0.2)
            continue
        wish = now * (min(6.0, 0.9 * error**-0.125) if error > 0.0 else 6.0)
        h = max(h, wish) if last else wish
        for i in range(size):
            y[i] = new[i]
        t = times[done + 1] if last else t + now
        project(model, y)
        rates(model, y, k[0], f)
        if last:
            done += 1
            _keep(done, y, k[0], f, states, slopes, reactions)
    return DONE, done, steps, t
