"""Compiled kernels of clearance pins: force, penetration, and the time of the touch of a journal in flight.

The contact law and its sources are in `clearance` [Hunt and Crossley 1975]. The state of a pin is one number: -1 in
flight (no contact); in contact the greatest speed |d'| since the contact began. In flight no force acts at any
penetration, so that a step into the bearing is smooth and the time of the touch can be located. Contact begins when a
step ends at the touch.
"""

import numpy as np

from ilmek.dynamics.multibody.kernel import Model, arm_of, dot, push
from ilmek.num.compiled import compiled

FLIGHT = -1.0
"""State of a pin without contact."""

TOUCH = 1e-7
"""Penetration at which a touch is located, relative to the clearance."""

STRIDE = 0.5
"""Greatest motion of a journal in flight in one step, relative to the clearance."""

REST_SHARE = 0.25
"""Lower bound of the speed v, relative to the impact speed with the same penetration; see `clearance`."""

SCAN = 16
"""Points within a step at which the penetration is evaluated."""


@compiled
def apart(model: Model, y: np.ndarray, contact: int) -> tuple[complex, complex]:
    """Position [m] and velocity [m/s] of the journal's centre relative to the bearing's."""
    size = model.masses.shape[0]
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
    """Add the contact forces to those on the bodies; store those on the journals. Returns their power [W].

    The power is that of damping and friction, negative where they dissipate energy.
    """
    size = model.masses.shape[0]
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
        against = REST_SHARE * np.sqrt(2.0 * elastic * deep / ((exponent + 1.0) * numbers[7]))
        normal = elastic * max(1.0 + hysteresis * rate / max(began, abs(rate), against), 0.0)
        rubbing = friction * normal * sliding / np.sqrt(sliding * sliding + slip * slip)
        force = -(normal + 1j * rubbing) * n
        push(out, journal, r + inward * n, force)
        push(out, bearing, s + outward * n, -force)
        found[2 * k], found[2 * k + 1] = force.real, force.imag
        power -= (normal - elastic) * rate + rubbing * sliding
    return power


@compiled
def _acceleration(model: Model, y: np.ndarray, slope: np.ndarray, contact: int, side: int) -> complex:
    """Acceleration of one side's centre [m/s²]."""
    size = model.masses.shape[0]
    at = model.ends.shape[0] - model.contacts.shape[0] + contact
    arm, _, _, bias = arm_of(model, y[:size], y[size : 2 * size], at, side)
    body = model.ends[at, side]
    if body < 0:
        return 0j
    a = slope[size + 3 * body : size + 3 * body + 3]
    value: complex = complex(a[0], a[1]) + 1j * a[2] * arm + bias
    return value


@compiled
def stride(model: Model, y: np.ndarray, slope: np.ndarray) -> float:
    """Longest step in which no journal in flight moves by more than `STRIDE` of its clearance [s].

    model, y, slope  the system, its state, the state's rate of change [SI]; inf where no journal is in flight
    """
    size, longest = model.masses.shape[0], np.inf
    for k in range(model.contacts.shape[0]):
        if y[2 * size + 1 + k] < 0.0:
            _, speed = apart(model, y, k)
            acceleration = _acceleration(model, y, slope, k, 1) - _acceleration(model, y, slope, k, 0)
            reach = STRIDE * model.contacts[k, 4]
            longest = min(longest, reach / (abs(speed) + np.sqrt(abs(acceleration) * reach) + 1e-300))
    return longest


@compiled
def _cubic(s: float, h: float, start: tuple[float, float], end: tuple[float, float]) -> float:
    """Cubic Hermite interpolation of the penetration [m] at the share s of a step h [s]."""
    rest = 1.0 - s
    value: float = rest * rest * ((1 + 2 * s) * start[0] + s * h * start[1])
    return value + s * s * ((3 - 2 * s) * end[0] - rest * h * end[1])


@compiled
def until_touch(model: Model, y: np.ndarray, new: np.ndarray, h: float) -> float:
    """Time from the start of a step h to the first touch of a journal in flight [s]; h where there is none before.

    y, new  states at the start and the end of the step [SI]; between them the penetration is a cubic of Hermite
    """
    size, first = model.masses.shape[0], h
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
    """Begin, keep or end each contact at the end of a step.

    y  state [SI]: its contact numbers are changed in place, to the speed |d'| [m/s], or -1 in flight
    """
    size = model.masses.shape[0]
    for k in range(model.contacts.shape[0]):
        deep, rate = depth(model, y, k)
        began = y[2 * size + 1 + k]
        if began >= 0.0:
            y[2 * size + 1 + k] = FLIGHT if deep <= 0.0 else max(began, abs(rate))
        elif deep >= -TOUCH * model.contacts[k, 4] and (rate > 0.0 or deep > 0.0):
            y[2 * size + 1 + k] = abs(rate)
