"""Compiled kernels of clearance pins: force, depth, and when a journal in flight will touch its bearing.

See `clearance` for the law. A pin's state is one number beside positions and velocities: -1 in flight, in contact the
greatest speed |d'| since the contact began. In flight no force acts, whatever the trial's depth, so that a step into
the bearing is smooth and its crossing can be found; contact begins where the integrator has landed on it.
"""

import numpy as np

from ilmek.dynamics.multibody.kernel import Model, arm_of, dot, push
from ilmek.num.compiled import compiled

FLIGHT = -1.0
"""State of a pin out of contact."""

TOUCH = 1e-7
"""Depth at which a touch is found, of the clearance."""

STRIDE = 0.5
"""How far a journal in flight may go in one step, of the clearance."""

SETTLED = 0.25
"""Least speed against which damping is measured, of the impact speed that would go as deep: see `clearance`."""

SCAN = 16
"""Places within a step at which the depth is looked at."""


@compiled
def apart(model: Model, y: np.ndarray, contact: int) -> tuple[complex, complex]:
    """Journal's centre from the bearing's [m] and its velocity [m/s]."""
    size = model.weights.shape[0]
    q, v = y[:size], y[size : 2 * size]
    at = model.ends.shape[0] - model.contacts.shape[0] + contact
    _, bearing, bearing_speed, _ = arm_of(model, q, v, at, 0)
    _, journal, journal_speed, _ = arm_of(model, q, v, at, 1)
    return journal - bearing, journal_speed - bearing_speed


@compiled
def depth(model: Model, y: np.ndarray, contact: int) -> tuple[float, float]:
    """Penetration [m], negative in flight, and its rate [m/s]."""
    e, speed = apart(model, y, contact)
    size = abs(e)
    rate = dot(e, speed) / size if size > 0.0 else abs(speed)
    return size - model.contacts[contact, 4], rate


@compiled
def contacts(model: Model, y: np.ndarray, out: np.ndarray, found: np.ndarray) -> float:
    """Add the contact forces to those on the bodies, write those on the journals; power taken by damping, friction."""
    size = model.weights.shape[0]
    q, v, power = y[:size], y[size : 2 * size], 0.0
    for k in range(model.contacts.shape[0]):
        found[2 * k], found[2 * k + 1] = 0.0, 0.0
        deep, rate = depth(model, y, k)
        began = y[2 * size + 1 + k]
        if began < 0.0 or deep <= 0.0:
            continue
        numbers = model.contacts[k]
        stiffness, exponent, hysteresis = numbers[0], numbers[1], numbers[2]
        radius, friction, slip = numbers[3], numbers[5], numbers[6]
        at = model.ends.shape[0] - model.contacts.shape[0] + k
        bearing, journal = model.ends[at, 0], model.ends[at, 1]
        s, g, gv, _ = arm_of(model, q, v, at, 0)
        r, p, pv, _ = arm_of(model, q, v, at, 1)
        n = (p - g) / abs(p - g)
        outward, inward = abs(p - g) + radius, radius
        spin = (v[3 * journal + 2] if journal >= 0 else 0.0) * inward
        spin -= (v[3 * bearing + 2] if bearing >= 0 else 0.0) * outward
        sliding = dot(1j * n, pv - gv) + spin
        elastic = stiffness * deep**exponent
        against = SETTLED * np.sqrt(2.0 * elastic * deep / ((exponent + 1.0) * numbers[7]))
        normal = elastic * max(1.0 + hysteresis * rate / max(began, abs(rate), against), 0.0)
        rubbing = friction * normal * sliding / np.sqrt(sliding * sliding + slip * slip)
        force = -(normal + 1j * rubbing) * n
        push(out, journal, r + inward * n, force)
        push(out, bearing, s + outward * n, -force)
        found[2 * k], found[2 * k + 1] = force.real, force.imag
        power -= (normal - elastic) * rate + rubbing * sliding
    return power


@compiled
def _gain(model: Model, y: np.ndarray, slope: np.ndarray, contact: int, side: int) -> complex:
    """Acceleration of one side's centre [m/s²]."""
    size = model.weights.shape[0]
    at = model.ends.shape[0] - model.contacts.shape[0] + contact
    arm, _, _, bias = arm_of(model, y[:size], y[size : 2 * size], at, side)
    body = model.ends[at, side]
    if body < 0:
        return 0j
    a = slope[size + 3 * body : size + 3 * body + 3]
    gained: complex = complex(a[0], a[1]) + 1j * a[2] * arm + bias
    return gained


@compiled
def stride(model: Model, y: np.ndarray, slope: np.ndarray) -> float:
    """Longest step in which no journal in flight goes further than `STRIDE` of its clearance [s]."""
    size, longest = model.weights.shape[0], np.inf
    for k in range(model.contacts.shape[0]):
        if y[2 * size + 1 + k] < 0.0:
            _, speed = apart(model, y, k)
            gain = _gain(model, y, slope, k, 1) - _gain(model, y, slope, k, 0)
            reach = STRIDE * model.contacts[k, 4]
            longest = min(longest, reach / (abs(speed) + np.sqrt(abs(gain) * reach) + 1e-300))
    return longest


@compiled
def _cubic(s: float, h: float, start: tuple[float, float], end: tuple[float, float]) -> float:
    """Hermite's cubic through two depths with two rates, at the share s of the step."""
    rest = 1.0 - s
    value: float = rest * rest * ((1 + 2 * s) * start[0] + s * h * start[1])
    return value + s * s * ((3 - 2 * s) * end[0] - rest * h * end[1])


@compiled
def until_touch(model: Model, y: np.ndarray, new: np.ndarray, h: float) -> float:
    """The part of the step h up to the first touch of a journal in flight; h where none is, or where it ends on one."""
    size, first = model.weights.shape[0], h
    for k in range(model.contacts.shape[0]):
        start, end = depth(model, y, k), depth(model, new, k)
        near = TOUCH * model.contacts[k, 4]
        if y[2 * size + 1 + k] >= 0.0 or abs(end[0]) <= near:
            continue
        late = 0.0
        for j in range(1, SCAN + 1):
            if _cubic(j / SCAN, h, start, end) > 0.5 * near:
                late = j / SCAN
                break
        if late > 0.0:
            early = late - 1.0 / SCAN
            for _ in range(50):
                middle = 0.5 * (early + late)
                if _cubic(middle, h, start, end) > 0.5 * near:
                    late = middle
                else:
                    early = middle
            first = min(first, late * h)
    return first


@compiled
def settle(model: Model, y: np.ndarray) -> None:
    """Begin, keep or end each contact at the end of a step."""
    size = model.weights.shape[0]
    for k in range(model.contacts.shape[0]):
        deep, rate = depth(model, y, k)
        began = y[2 * size + 1 + k]
        if began >= 0.0:
            y[2 * size + 1 + k] = FLIGHT if deep <= 0.0 else max(began, abs(rate))
        elif deep >= -TOUCH * model.contacts[k, 4] and (rate > 0.0 or deep > 0.0):
            y[2 * size + 1 + k] = abs(rate)
