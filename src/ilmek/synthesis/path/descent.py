# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""From a start to the nearest best four-bar of a path: Levenberg-Marquardt within limits, compiled, many starts a call.

    least  sum |P(x, th_k) - p_k|^2    over the ten numbers x and, where there is no timing, the crank's angles th_k

Each point knows its own angle only, so that the angles leave the normal equations one by one (Schur complement of an
arrow matrix); what remains is ten by ten, and its step is kept within the limits by `num.quadratic`.

    (H' - sum_k h_k h_k^T / d_k) s = -g + sum_k h_k b_k / d_k,    t_k = -(b_k + h_k s) / d_k

H' and d_k carry the damping, lambda times the diagonal.     [Marquardt 1963; Nielsen 1999 for lambda from step to step]
"""

import numpy as np

from ilmek.arrays import Complex, Float, Int
from ilmek.num.compiled import compiled
from ilmek.num.quadratic import limited_step
from ilmek.synthesis.path.limits import GRACE, LIMITS, Rows, Slack, excess, limit_rows
from ilmek.synthesis.path.model import SIZE, START, Angles, Design, Points, normal_equations, squared_error

EXACT = 1e-29
"""Squared error a point, in squared sizes of the path, that is rounding: the search of a start ends there."""

STILL = 1e-13
"""Part of the error that a step must take away; eight steps that take less end the search of a start."""

FLOOR = 1e-13
"""Added to the diagonals against a number that does not move the path."""


@compiled
def descend(
    design: Design,
    angles: Angles,
    points: Points,
    blocks: Int[np.ndarray, " points"],
    branch: int,
    low: Design,
    high: Design,
    kind: int,
    kappa: float,
    state: Float[np.ndarray, "5"],
    rounds: int,
) -> None:
    """Go on from `design` and `angles`, in place, for at most `rounds` evaluations.

    state  squared error, damping, its next growth, and still steps so far (8 or more: at rest), and
           evaluations so far; kept between calls
    """
    count = blocks.max() + 1
    H, g = np.empty((SIZE, SIZE)), np.empty(SIZE)
    mixed, own, pull = np.empty((count, SIZE)), np.empty(count), np.empty(count)
    A, b, step, turn = np.empty((SIZE, SIZE)), np.empty(SIZE), np.empty(SIZE), np.empty(count)
    rows, slack = np.empty((LIMITS, SIZE)), np.empty(LIMITS)
    trial, ahead = design.copy(), angles.copy()
    fresh = True
    for _ in range(rounds):
        if state[3] >= 8.0 or state[0] <= EXACT * points.size:
            state[3] = 8.0
            return
        if fresh:
            normal_equations(design, angles, points, blocks, branch, H, g, mixed, own, pull)
            limit_rows(design, low, high, kind, kappa, rows, slack)
        gain = _reduced(H, g, mixed, own, pull, low, high, state[1], A, b)
        if not _step_within(A, b, rows, slack, design, low, high, kind, kappa, step, trial):
            state[1] *= 10.0
            fresh = False
            continue
        _own_steps(mixed, own, pull, state[1], step, turn)
        for k in range(points.size):
            ahead[k] = angles[k] + (turn[blocks[k]] if blocks[k] >= 0 else step[START])
        gain -= _taken(A, b, step)
        error = squared_error(trial, ahead, points, branch)
        state[4] += 1.0
        fresh = error < state[0]
        _settle(state, error, gain)
        if fresh:
            _copy(trial, design)
            _copy(ahead, angles)


@compiled
def _own_steps(
    mixed: Float[np.ndarray, "blocks 10"],
    own: Float[np.ndarray, " blocks"],
    pull: Float[np.ndarray, " blocks"],
    damping: float,
    step: Design,
    turn: Float[np.ndarray, " blocks"],
) -> None:
    """The steps of the free angles that go with a step of the ten numbers, into `turn`."""
    for k in range(own.size):
        total = pull[k]
        for i in range(SIZE):
            total += mixed[k, i] * step[i]
        turn[k] = -total / (own[k] * (1.0 + damping) + FLOOR)


@compiled
def _taken(A: Float[np.ndarray, "10 10"], b: Design, step: Design) -> float:
    """What a step adds to the quadratic of the ten numbers."""
    total = 0.0
    for i in range(SIZE):
        total += step[i] * b[i]
        for j in range(SIZE):
            total += 0.5 * step[i] * A[i, j] * step[j]
    return total


@compiled
def _copy(source: Angles, target: Angles) -> None:
    for k in range(source.size):
        target[k] = source[k]


@compiled
def _settle(state: Float[np.ndarray, "5"], error: float, gain: float) -> None:
    """The next damping after a step that promised to take 2 gain off the squared error, and led to `error`."""
    if error < state[0]:
        ratio = (state[0] - error) / max(2.0 * gain, 1e-300)
        state[3] = state[3] + 1.0 if state[0] - error <= STILL * state[0] else 0.0
        state[1] = max(state[1] * max(0.1, 1.0 - (2.0 * ratio - 1.0) ** 3), 1e-12)
        state[0], state[2] = error, 2.0
        return
    state[1] *= state[2]
    state[2] *= 2.0
    if state[1] > 1e12:
        state[3] = 8.0


@compiled
def _reduced(
    H: Float[np.ndarray, "10 10"],
    g: Design,
    mixed: Float[np.ndarray, "blocks 10"],
    own: Float[np.ndarray, " blocks"],
    pull: Float[np.ndarray, " blocks"],
    low: Design,
    high: Design,
    damping: float,
    A: Float[np.ndarray, "10 10"],
    b: Design,
) -> float:
    """The damped equations of the ten numbers alone into A and b; half of what the angles alone take off."""
    gain = 0.0
    for i in range(SIZE):
        b[i] = g[i]
        for j in range(SIZE):
            A[i, j] = H[i, j]
        A[i, i] += damping * H[i, i] + FLOOR
    for k in range(own.size):
        weight = 1.0 / (own[k] * (1.0 + damping) + FLOOR)
        gain += 0.5 * weight * pull[k] * pull[k]
        for i in range(SIZE):
            scaled = weight * mixed[k, i]
            b[i] -= scaled * pull[k]
            for j in range(SIZE):
                A[i, j] -= scaled * mixed[k, j]
    for i in range(SIZE):
        if low[i] == high[i]:
            for j in range(SIZE):
                A[i, j] = A[j, i] = 0.0
            A[i, i], b[i] = 1.0, 0.0
    return gain


@compiled
def _step_within(
    A: Float[np.ndarray, "10 10"],
    b: Design,
    rows: Rows,
    slack: Slack,
    design: Design,
    low: Design,
    high: Design,
    kind: int,
    kappa: float,
    step: Design,
    trial: Design,
) -> bool:
    """The best step within the limits, and where it leads; False where there is none."""
    if limited_step(A, b, rows, slack, step) < 0:
        return False
    for i in range(SIZE):
        trial[i] = min(max(design[i] + step[i], low[i]), high[i])
    beyond = excess(trial, kind, kappa)
    if beyond > 0.0:  # a step along the tangent leaves the curved limit by its square: the shortest link gives way
        shortest = 1 if kind > 0 else 0
        trial[shortest] = max(trial[shortest] - beyond, low[shortest])
        beyond = excess(trial, kind, kappa)
    return beyond <= GRACE


@compiled
def descend_all(
    designs: Float[np.ndarray, "starts 10"],
    angles: Float[np.ndarray, "starts points"],
    branches: Int[np.ndarray, " starts"],
    states: Float[np.ndarray, "starts 5"],
    blocks: Int[np.ndarray, "starts points"],
    points: Complex[np.ndarray, " points"],
    low: Design,
    high: Design,
    kind: int,
    kappa: float,
    rounds: int,
) -> None:
    """`descend` from many starts, in place."""
    for k in range(branches.size):
        descend(designs[k], angles[k], points, blocks[k], branches[k], low, high, kind, kappa, states[k], rounds)
