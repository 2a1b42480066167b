# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""Local optimisation of a four-bar for a path: Levenberg-Marquardt method within limits, compiled, for many starts.

    minimise  sum |P(x, th_k) - p_k|^2    over the ten numbers x and, without timing, the crank angles th_k

Each point depends only on its own angle, so the angles are eliminated from the normal equations one by one (Schur
complement of an arrow matrix). The remaining system is ten by ten; its step is kept within the limits by
`num.quadratic`.

    (H' - sum_k h_k h_k^T / d_k) s = -g + sum_k h_k b_k / d_k,    t_k = -(b_k + h_k s) / d_k

H' and d_k include the damping, lambda times the diagonal. [Marquardt 1963; Nielsen 1999 for the update of lambda]
"""

import math

import numpy as np

from ilmek.arrays import Complex, Float, Int
from ilmek.num.compiled import compiled
from ilmek.num.quadratic import limited_step
from ilmek.synthesis.path.extent import add_penalty, penalised
from ilmek.synthesis.path.limits import LIMITS, TOLERANCE, Rows, Slack, excess, limit_rows, ratio_excess
from ilmek.synthesis.path.model import SIZE, START, Angles, Design, Points, normal_equations

EXACT = 1e-29
"""Squared error per point, in squared sizes of the path, at the level of rounding; the descent ends there."""

MIN_REDUCTION = 1e-13
"""Relative reduction of the error by a step; after eight successive steps with less the descent ends."""

RIDGE = 1e-13
"""Term added to the diagonals, for numbers that do not affect the path."""


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
    ratio: float,
    size_max: float,
    state: Float[np.ndarray, "5"],
    rounds: int,
) -> None:
    """Descent from `design` and `angles`, in place, for at most `rounds` evaluations.

    design, angles  ten numbers [m, rad] and crank angles [rad] of the points [m], changed in place
    low, high       bounds of the numbers; kind, kappa, ratio: see `path.limits`
    size_max        greatest overall size [m], kept by a penalty in the squared error (`path.extent`); inf: none
    state  squared error [m²], damping, its next growth factor, number of successive small steps (8 or more: ended), and
           number of evaluations; kept between calls
    """
    count = blocks.max() + 1
    H, g = np.empty((SIZE, SIZE)), np.empty(SIZE)
    mixed_hessian, angle_hessian, angle_gradient = np.empty((count, SIZE)), np.empty(count), np.empty(count)
    A, b, step, turn = np.empty((SIZE, SIZE)), np.empty(SIZE), np.empty(SIZE), np.empty(count)
    rows, slack = np.empty((LIMITS, SIZE)), np.empty(LIMITS)
    trial, ahead = design.copy(), angles.copy()
    fresh = True
    for _ in range(rounds):
        if state[3] >= 8.0 or state[0] <= EXACT * points.size:
            state[3] = 8.0
            return
        if fresh:
            normal_equations(design, angles, points, blocks, branch, H, g, mixed_hessian, angle_hessian, angle_gradient)
            if math.isfinite(size_max):
                add_penalty(design, branch, size_max, points.size, H, g)
            limit_rows(design, low, high, kind, kappa, ratio, rows, slack)
        gain = _reduced(H, g, mixed_hessian, angle_hessian, angle_gradient, low, high, state[1], A, b)
        if not _step_within(A, b, rows, slack, design, low, high, kind, kappa, ratio, step, trial):
            state[1] *= 10.0
            fresh = False
            continue
        _angle_steps(mixed_hessian, angle_hessian, angle_gradient, state[1], step, turn)
        for k in range(points.size):
            ahead[k] = angles[k] + (turn[blocks[k]] if blocks[k] >= 0 else step[START])
        gain -= _quadratic_model(A, b, step)
        error = penalised(trial, ahead, points, branch, size_max)
        state[4] += 1.0
        fresh = error < state[0]
        _update_damping(state, error, gain)
        if fresh:
            _copy(trial, design)
            _copy(ahead, angles)


@compiled
def _angle_steps(
    mixed_hessian: Float[np.ndarray, "blocks 10"],
    angle_hessian: Float[np.ndarray, " blocks"],
    angle_gradient: Float[np.ndarray, " blocks"],
    damping: float,
    step: Design,
    turn: Float[np.ndarray, " blocks"],
) -> None:
    """Steps of the free angles for a step of the ten numbers, written to `turn`."""
    for k in range(angle_hessian.size):
        total = angle_gradient[k]
        for i in range(SIZE):
            total += mixed_hessian[k, i] * step[i]
        turn[k] = -total / (angle_hessian[k] * (1.0 + damping) + RIDGE)


@compiled
def _quadratic_model(A: Float[np.ndarray, "10 10"], b: Design, step: Design) -> float:
    """Change of the quadratic model by a step of the ten numbers."""
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
def _update_damping(state: Float[np.ndarray, "5"], error: float, gain: float) -> None:
    """Update the damping after a step with a predicted reduction of the squared error by 2 gain, and its `error`."""
    if error < state[0]:
        ratio = (state[0] - error) / max(2.0 * gain, 1e-300)
        state[3] = state[3] + 1.0 if state[0] - error <= MIN_REDUCTION * state[0] else 0.0
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
    mixed_hessian: Float[np.ndarray, "blocks 10"],
    angle_hessian: Float[np.ndarray, " blocks"],
    angle_gradient: Float[np.ndarray, " blocks"],
    low: Design,
    high: Design,
    damping: float,
    A: Float[np.ndarray, "10 10"],
    b: Design,
) -> float:
    """Damped equations of the ten numbers, written to A and b; returns half the reduction by the angles alone."""
    gain = 0.0
    for i in range(SIZE):
        b[i] = g[i]
        for j in range(SIZE):
            A[i, j] = H[i, j]
        A[i, i] += damping * H[i, i] + RIDGE
    for k in range(angle_hessian.size):
        weight = 1.0 / (angle_hessian[k] * (1.0 + damping) + RIDGE)
        gain += 0.5 * weight * angle_gradient[k] * angle_gradient[k]
        for i in range(SIZE):
            scaled = weight * mixed_hessian[k, i]
            b[i] -= scaled * angle_gradient[k]
            for j in range(SIZE):
                A[i, j] -= scaled * mixed_hessian[k, j]
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
    ratio: float,
    step: Design,
    trial: Design,
) -> bool:
    """Best step within the limits and its end, written to `step` and `trial`; False where there is none."""
    if limited_step(A, b, rows, slack, step) < 0:
        return False
    for i in range(SIZE):
        trial[i] = min(max(design[i] + step[i], low[i]), high[i])
    violation = excess(trial, kind, kappa)
    if violation > 0.0:  # the curved limit is violated to second order: shorten the shortest link
        shortest = 1 if kind > 0 else 0
        trial[shortest] = max(trial[shortest] - violation, low[shortest])
        violation = excess(trial, kind, kappa)
    return violation <= TOLERANCE and ratio_excess(trial, kind, ratio) <= TOLERANCE


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
    ratio: float,
    size_max: float,
    rounds: int,
) -> None:
    """`descend` from many starts, in place."""
    for k in range(branches.size):
        of = (designs[k], angles[k], points, blocks[k], branches[k])
        descend(*of, low, high, kind, kappa, ratio, size_max, states[k], rounds)
