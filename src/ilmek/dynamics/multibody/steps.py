# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""Compiled integration of a planar multibody system: right-hand side, projection, steps of order 8.

A state consists of positions, velocities, work, and one number per clearance pin (see `multibody.contact`).
Equations, method and sources: `multibody.kernel` [Hairer, Norsett and Wanner, II.10].
"""

from typing import TypeAlias

import numpy as np

from ilmek.dynamics.multibody.contact import contacts, settle, stride, until_touch
from ilmek.dynamics.multibody.kernel import Model, applied, constrained, factor, joints, penalties, row_product
from ilmek.num.compiled import compiled

DONE, TOO_SMALL, TOO_MANY, STEPPED = 0, 1, 2, 3
"""How an integration ended: at the last time, at a step below rounding, at the limit of steps, after a single step."""

TIME, NEXT_STEP, STEPS, REACHED, FASTEST, FASTEST_SPIN, PEAKS = 0, 1, 2, 3, 4, 5, 6
"""Indices in the clock of a run, see `advance`."""

Method: TypeAlias = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Coefficients: stages and, in the last row, the step; error of third order; of fifth."""

SampleArrays: TypeAlias = tuple[np.ndarray, np.ndarray, np.ndarray]
"""States, slopes and reactions at the sample times, to be filled."""

REST = 1e-6
"""Least angular velocity times the system's length over the greatest speed, and the inverse, in scales of errors."""

STAGES = 12
"""Stages of the method; one more evaluation at the end of a step is used for its error and for the next step."""


@compiled
def rates(model: Model, y: np.ndarray, out: np.ndarray, reaction: np.ndarray) -> None:
    """Time derivative of a state [SI]; joint reactions (f of J^T f on the left side) and forces on the journals [N].

    y, out  state and its derivative, shape (2 * 3 bodies + 1 + contacts,); out and reaction are written
    """
    count, size = model.joint_bodies.shape[0], model.masses.shape[0]
    q, v = y[:size], y[size : 2 * size]
    gap, bias, rows = np.empty(count), np.empty(count), np.empty((count, 6))
    force, root, penalty = np.empty(size), np.empty((size, model.band + 1)), np.empty((count // 2, 3))
    joints(model, q, v, gap, rows, bias)
    out[2 * size] = applied(model, q, v, force) + contacts(model, y, force, reaction[count:])
    for i in range(2 * size + 1, out.shape[0]):
        out[i] = 0.0
    penalties(model, rows, penalty)
    factor(model, rows, penalty, root)
    for k in range(count):
        bias[k] = -bias[k]
    constrained(model, rows, penalty, root, force, bias, out[size : 2 * size], reaction[:count])
    for i in range(size):
        out[i] = v[i]


@compiled
def project(model: Model, y: np.ndarray) -> float:
    """Project positions, then velocities, onto the joint equations in the norm of the masses; the remaining gap [m]."""
    count, size = model.joint_bodies.shape[0], model.masses.shape[0]
    q, v = y[:size], y[size : 2 * size]
    gap, bias, rows = np.empty(count), np.empty(count), np.empty((count, 6))
    none, move, reaction = np.zeros(size), np.empty(size), np.empty(count)
    root, penalty = np.empty((size, model.band + 1)), np.empty((count // 2, 3))
    open_by, before = 0.0, np.inf
    for _ in range(6):
        joints(model, q, v, gap, rows, bias)
        penalties(model, rows, penalty)
        factor(model, rows, penalty, root)
        open_by = 0.0
        for k in range(count):
            open_by = max(open_by, abs(gap[k]))
            gap[k] = -gap[k]
        if open_by <= 1e-15 * model.length or open_by > 0.5 * before:
            break
        before = open_by
        constrained(model, rows, penalty, root, none, gap, move, reaction)
        for i in range(size):
            q[i] += move[i]
    for _ in range(2):
        for k in range(count):
            bias[k] = -row_product(model, rows[k], k, v)
        constrained(model, rows, penalty, root, none, bias, move, reaction)
        for i in range(size):
            v[i] += move[i]
    return open_by


@compiled
def _error_scales(model: Model, clock: np.ndarray, y: np.ndarray, slope: np.ndarray, h: float, out: np.ndarray) -> None:
    """Scale of each error: the system's length, 1 rad, the greatest speeds so far, the energy.

    Where nothing rotates, or all only rotates, rounding alone must not count: see REST.
    """
    size = model.masses.shape[0]
    fast, spin, energy = clock[FASTEST], clock[FASTEST_SPIN], 0.0
    for i in range(size):
        v, reach = abs(y[size + i]), abs(slope[size + i]) * h
        energy += 0.5 * model.masses[i] * (v * v + reach * reach)
        if i % 3 == 2:
            spin = max(spin, v + reach)
        else:
            fast = max(fast, v + reach)
    fast, spin = max(fast, REST * spin * model.length), max(spin, REST * fast / model.length)
    for i in range(size):
        turning = i % 3 == 2
        out[i] = 1.0 if turning else model.length
        out[size + i] = (spin if turning else fast) + 1e-12
    out[2 * size] = energy + abs(slope[2 * size]) * h + 1e-300
    for i in range(2 * size + 1, out.shape[0]):
        out[i] = 1.0


@compiled
def _error(k: np.ndarray, h: float, scale: np.ndarray, method: Method) -> float:
    """Estimated error of a step relative to its scale [Hairer, Norsett and Wanner, II.10: fifth and third order]."""
    _, e3, e5 = method
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
    estimate: float = h * fifth / np.sqrt((fifth + 0.01 * third) * scale.shape[0])
    return estimate


@compiled
def _copy(source: np.ndarray, target: np.ndarray) -> None:
    for i in range(source.shape[0]):
        target[i] = source[i]


@compiled
def _combined(y: np.ndarray, h: float, shares: np.ndarray, k: np.ndarray, count: int, out: np.ndarray) -> None:
    """Write y + h Σ shares k to `out`."""
    _copy(y, out)
    for j in range(count):
        if shares[j] != 0.0:
            for i in range(y.shape[0]):
                out[i] += h * shares[j] * k[j, i]


@compiled
def _stages(
    model: Model, y: np.ndarray, h: float, a: np.ndarray, k: np.ndarray, f: np.ndarray, new: np.ndarray
) -> None:
    """All stages of a step from y with the slope k[0]; its end, not yet projected, is written to `new`."""
    for s in range(1, STAGES + 1):
        _combined(y, h, a[s], k, s, new)
        rates(model, new, k[s], f)


@compiled
def _trial_step(
    model: Model,
    clock: np.ndarray,
    y: np.ndarray,
    h: float,
    method: Method,
    k: np.ndarray,
    f: np.ndarray,
    new: np.ndarray,
) -> float:
    """A trial step, written to `new`; returns its error relative to the scales."""
    scale = np.empty(y.shape[0])
    _stages(model, y, h, method[0], k, f, new)
    _error_scales(model, clock, y, k[0], h, scale)
    for i in range(y.shape[0]):
        scale[i] += max(abs(y[i]), abs(new[i]))
    return _error(k, h, scale, method)


@compiled
def single_step(
    model: Model,
    y: np.ndarray,
    slope: np.ndarray,
    h: float,
    method: Method,
    new: np.ndarray,
    end: np.ndarray,
    f: np.ndarray,
) -> None:
    """One step h [s] without error control: state, slope and reactions at its end."""
    k = np.empty((STAGES + 1, y.shape[0]))
    _copy(slope, k[0])
    _stages(model, y, h, method[0], k, f, new)
    project(model, new)
    rates(model, new, end, f)


@compiled
def advance(
    model: Model,
    clock: np.ndarray,
    y: np.ndarray,
    slope: np.ndarray,
    f: np.ndarray,
    times: np.ndarray,
    rtol: float,
    max_steps: int,
    single: bool,
    method: Method,
    samples: SampleArrays,
) -> int:
    """Integrate to the last of the times, or by one step if `single`; returns how it ended.

    clock         time [s], next step [s], number of steps, index of the last time reached, greatest speed [m/s] and
                  angular velocity [rad/s], greatest contact forces [N]
    y, slope, f   state, its derivative, reactions: changed in place; copied to `samples` at the times
    """
    last, k, new = times.shape[0] - 1, np.empty((STAGES + 1, y.shape[0])), np.empty(y.shape[0])
    _copy(slope, k[0])
    while clock[REACHED] < last:
        clock[STEPS] += 1
        if clock[STEPS] > max_steps:
            return TOO_MANY
        left = times[int(clock[REACHED]) + 1] - clock[TIME]
        step = min(clock[NEXT_STEP], stride(model, y, k[0]))
        reaches = step >= left * (1 - 1e-10)
        now = left if reaches else step
        if not now > 1e-14 * max(abs(clock[TIME]), 1e-300):
            return TOO_SMALL
        error = _trial_step(model, clock, y, now, method, k, f, new) / rtol
        factor = 0.9 * error**-0.125 if 0.0 < error < 1e300 else (6.0 if error == 0.0 else 0.2)
        if not error < 1.0:
            clock[NEXT_STEP] = now * max(0.2, factor)
            continue
        touch = until_touch(model, y, new, now)
        if touch < now:
            clock[NEXT_STEP] = touch
            continue
        grown = now * min(6.0, factor)
        clock[NEXT_STEP] = max(clock[NEXT_STEP], grown) if reaches else grown
        clock[TIME] = times[int(clock[REACHED]) + 1] if reaches else clock[TIME] + now
        _accept(model, clock, y, new, k, f)
        if reaches:
            clock[REACHED] += 1
            _store(int(clock[REACHED]), y, k[0], f, samples)
        if single:
            _copy(k[0], slope)
            return STEPPED
    _copy(k[0], slope)
    return DONE


@compiled
def _accept(model: Model, clock: np.ndarray, y: np.ndarray, new: np.ndarray, k: np.ndarray, f: np.ndarray) -> None:
    """Accept a step: projection, contact states, slope and reactions at its end, greatest speeds and forces."""
    _copy(new, y)
    project(model, y)
    settle(model, y)
    rates(model, y, k[0], f)
    joint_forces, size = model.joint_bodies.shape[0], model.masses.shape[0]
    for i in range(size):
        greatest = FASTEST_SPIN if i % 3 == 2 else FASTEST
        clock[greatest] = max(clock[greatest], abs(y[size + i]))
    for c in range(model.contacts.shape[0]):
        clock[PEAKS + c] = max(clock[PEAKS + c], np.hypot(f[joint_forces + 2 * c], f[joint_forces + 2 * c + 1]))


@compiled
def _store(at: int, y: np.ndarray, slope: np.ndarray, f: np.ndarray, samples: SampleArrays) -> None:
    """Store a sample."""
    states, slopes, reactions = samples
    _copy(y, states[at])
    _copy(slope, slopes[at])
    _copy(f, reactions[at])


@compiled
def begin(model: Model, y: np.ndarray, slope: np.ndarray, f: np.ndarray, samples: SampleArrays) -> None:
    """Close the joints, determine the contacts, and store the first sample."""
    project(model, y)
    settle(model, y)
    rates(model, y, slope, f)
    _store(0, y, slope, f, samples)
