# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""Paths of solutions while the task changes from one to another (parameter homotopy), compiled.

    task(t) = task_0 + t (task_1 - task_0),     u(t + h) = sum_k U_k h^k,    T(t + h) = sum_k T_k h^k

The coefficients of each order solve a linear system with the matrix of Newton's method, from those of lower orders. A
step is as long as the last coefficients allow, and Newton's method corrects its end. T is eliminated throughout.
[Sommese and Wampler, The Numerical Solution of Systems of Polynomials, 2005, chapters 2 and 7]
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import Complex, Float, Int
from ilmek.num.compiled import compiled
from ilmek.synthesis.alt_burmester.equations import (
    UNKNOWNS,
    LinkValues,
    Order,
    Poses,
    Positions,
    Square,
    Unknowns,
    abs2,
    factorise,
    joined,
    linearised,
    products,
    reciprocal,
    rotation_step,
    substitute,
)

ORDER = 7
"""Order of the Taylor polynomials."""

TOLERANCE = 1e-4
"""Greatest terms of the last two orders in a step, relative to the unknowns."""

CORRECTION = 1e-2
"""Greatest first correction of Newton's method after a step; beyond it the step is halved."""

CORRECTED = 1e-5
"""Correction after which the end of a step is accepted: by quadratic convergence the error is far below it."""

SHORTEST, MOST_STEPS = 1e-9, 1000
"""Step at which a path counts as broken off, and greatest number of steps."""

CORRECTIONS, POLISHING = 4, 3
"""Newton steps after a step at most, and at the end of a path."""

ENDED, BROKEN, LONG = 1, 2, 3
"""How a path ends: at t = 1, at a singular configuration or at infinity, or after too many steps."""


class Workspace(NamedTuple):
    """Arrays of one thread; coefficients of the orders along the first axis.

    U, T, S = 1/T  of unknowns and rotations      P, E  of the vectors p and e, see `equations`
    """

    U: Complex[np.ndarray, "orders 8"]
    T: Complex[np.ndarray, "orders positions"]
    S: Complex[np.ndarray, "orders positions"]
    P: Complex[np.ndarray, "orders 2 positions 2"]
    E: Complex[np.ndarray, "orders 2 positions 2"]
    matrix: Square
    weights: LinkValues
    values: LinkValues
    right: Unknowns
    order: Order
    scale: Float[np.ndarray, "8"]
    d: Positions
    primed: Positions
    u: Unknowns
    turn: Positions


Task = Complex[np.ndarray, "3 positions"]
"""Displacements d and d', and of poses the rotations T."""


@compiled
def newton_step(work: Workspace, u: Unknowns, T: Positions, pose: Poses) -> float:
    """One step of Newton's method in place, for the displacements of the workspace.

    Its greatest relative change; NaN where the matrix is singular. The factors remain in the workspace.
    """
    p, e, d, primed = work.P[0], work.E[0], work.d, work.primed
    products(u, T, d, primed, p, e)
    linearised(u, T, pose, d, primed, p, e, work.matrix, work.weights)
    for link in range(2):
        at = 4 * link
        r, r1 = u[at + 2] - u[at], u[at + 3] - u[at + 1]
        for j in range(T.size):
            turned = p[0, j, link] * e[1, j, link] + p[1, j, link] * e[0, j, link]
            work.values[j, link] = turned + d[j] * (r1 + primed[j]) + primed[j] * r
    joined(pose, work.values, work.weights, work.right)
    if not factorise(work.matrix, work.order, work.scale):
        return np.nan
    substitute(work.matrix, work.order, work.right)
    moved, size, step = 0.0, 1.0, 0.0
    for j in range(T.size):
        if not pose[j]:
            change = rotation_step(work.right, T, d, primed, p, e, work.values, work.weights, j)
            T[j] *= 1.0 + change
            moved = max(moved, abs2(change))
    for i in range(UNKNOWNS):
        u[i] += work.right[i]
        size = max(size, abs2(u[i]))
        step = max(step, abs2(work.right[i]))
    moved = max(moved, step / size)
    return np.sqrt(moved) if moved < np.inf else np.nan


@compiled
def known_terms(work: Workspace, pose: Poses, change: Task, k: int) -> None:
    """Terms of order k in both links' equations that lower orders and the task determine, in `work.values`."""
    U, T, S, P, E = work.U, work.T, work.S, work.P, work.E
    for j in range(pose.size):
        T[k, j] = change[2, j] if pose[j] and k == 1 else 0.0
        total = 0.0j
        for i in range(1, k + 1):
            total += T[i, j] * S[k - i, j]
        S[k, j] = -total * S[0, j]
    for link in range(2):
        at = 4 * link
        before, before1 = U[k - 1, at + 2] - U[k - 1, at], U[k - 1, at + 3] - U[k - 1, at + 1]
        for j in range(pose.size):
            a = T[k, j] * U[0, at + 2]
            b = S[k, j] * U[0, at + 3]
            value = change[0, j] * before1 + change[1, j] * before
            for i in range(1, k):
                a += T[i, j] * U[k - i, at + 2]
                b += S[i, j] * U[k - i, at + 3]
                value += P[i, 0, j, link] * E[k - i, 1, j, link] + P[i, 1, j, link] * E[k - i, 0, j, link]
            P[k, 0, j, link] = a
            P[k, 1, j, link] = b
            E[k, 0, j, link] = change[0, j] if k == 1 else 0.0
            E[k, 1, j, link] = change[1, j] if k == 1 else 0.0
            value += a * E[0, 1, j, link] + b * E[0, 0, j, link]
            if k == 1:
                value += (P[0, 0, j, link] + work.d[j]) * change[1, j] + (P[0, 1, j, link] + work.primed[j]) * change[
                    0, j
                ]
            if k == 2:
                value += change[0, j] * change[1, j]
            work.values[j, link] = value


@compiled
def series(work: Workspace, pose: Poses, change: Task) -> None:
    """Taylor coefficients of orders 1 to ORDER; order 0 and the factors of the matrix are in the workspace."""
    U, T, S, P, E, right = work.U, work.T, work.S, work.P, work.E, work.right
    for k in range(1, ORDER + 1):
        known_terms(work, pose, change, k)
        joined(pose, work.values, work.weights, right)
        substitute(work.matrix, work.order, right)
        for i in range(UNKNOWNS):
            U[k, i] = right[i]
        for j in range(pose.size):
            turned = 0.0j
            if not pose[j]:
                turned = rotation_step(right, T[0], work.d, work.primed, P[0], E[0], work.values, work.weights, j)
                T[k, j] = turned * T[0, j]
                S[k, j] -= turned * S[0, j]
            for link in range(2):
                at = 4 * link
                P[k, 0, j, link] += T[0, j] * turned * U[0, at + 2] + (T[0, j] - 1.0) * right[at + 2]
                P[k, 1, j, link] += (S[0, j] - 1.0) * right[at + 3] - S[0, j] * turned * U[0, at + 3]
                E[k, 0, j, link] -= right[at]
                E[k, 1, j, link] -= right[at + 1]


@compiled
def longest_step(work: Workspace, pose: Poses) -> float:
    """Step at which the terms of the last two orders are at most TOLERANCE, relative to the unknowns."""
    size, found = 1.0, np.inf
    for i in range(UNKNOWNS):
        size = max(size, abs2(work.U[0, i]))
    for k in range(ORDER - 1, ORDER + 1):
        most = 1e-60
        for i in range(UNKNOWNS):
            most = max(most, abs2(work.U[k, i]) / size)
        for j in range(pose.size):
            if not pose[j]:
                most = max(most, abs2(work.T[k, j] * work.S[0, j]))
        found = min(found, (TOLERANCE * TOLERANCE / most) ** (0.5 / k))
    return found


@compiled
def predict(work: Workspace, pose: Poses, task: Task, change: Task, t: float, h: float) -> None:
    """Unknowns and rotations of the Taylor polynomials at t + h, and the displacements there, in the workspace."""
    for i in range(UNKNOWNS):
        total = work.U[ORDER, i]
        for k in range(ORDER - 1, -1, -1):
            total = total * h + work.U[k, i]
        work.u[i] = total
    for j in range(pose.size):
        total = work.T[ORDER, j]
        for k in range(ORDER - 1, -1, -1):
            total = total * h + work.T[k, j]
        work.turn[j] = total
        work.d[j] = task[0, j] + (t + h) * change[0, j]
        work.primed[j] = task[1, j] + (t + h) * change[1, j]
        if pose[j]:
            work.turn[j] = task[2, j] + (t + h) * change[2, j]


@compiled
def advance(work: Workspace, pose: Poses, task: Task, change: Task, t: float) -> float:
    """Step from the state of order 0 at t; the new t, or t itself where no step succeeds."""
    for j in range(pose.size):
        work.S[0, j] = reciprocal(work.T[0, j])
    series(work, pose, change)
    h = longest_step(work, pose)
    while True:
        h = min(h, 1.0 - t)
        if not h > min(SHORTEST, 0.5 * (1.0 - t)):
            return t
        predict(work, pose, task, change, t, h)
        first = newton_step(work, work.u, work.turn, pose)
        moved = first
        for _ in range(CORRECTIONS - 1):
            if not moved > CORRECTED:
                break
            moved = newton_step(work, work.u, work.turn, pose)
        if first <= CORRECTION and moved <= CORRECTED:
            break
        h *= 0.5
    work.U[0, :] = work.u
    work.T[0, :] = work.turn
    products(work.u, work.turn, work.d, work.primed, work.P[0], work.E[0])
    return 1.0 if h == 1.0 - t else t + h


@compiled
def workspace(positions: int) -> Workspace:
    """Arrays for a number of positions."""
    orders, most = ORDER + 1, np.complex128
    return Workspace(
        np.zeros((orders, UNKNOWNS), most),
        np.zeros((orders, positions), most),
        np.zeros((orders, positions), most),
        np.zeros((orders, 2, positions, 2), most),
        np.zeros((orders, 2, positions, 2), most),
        np.zeros((UNKNOWNS, UNKNOWNS), most),
        np.zeros((positions, 2), most),
        np.zeros((positions, 2), most),
        np.zeros(UNKNOWNS, most),
        np.zeros(UNKNOWNS, np.int64),
        np.zeros(UNKNOWNS),
        np.zeros(positions, most),
        np.zeros(positions, most),
        np.zeros(UNKNOWNS, most),
        np.zeros(positions, most),
    )


@compiled
def track_all(
    unknowns: Complex[np.ndarray, "paths 8"],
    rotations: Complex[np.ndarray, "paths positions"],
    pose: Poses,
    task: Task,
    change: Task,
    ends: Int[np.ndarray, " paths"],
    steps: Int[np.ndarray, " paths"],
    moved: Float[np.ndarray, " paths"],
) -> None:
    """Track each row of unknowns and rotations in place, from t = 0 to 1.

    task, change  at t = 0, and how it changes to t = 1
    ends, steps   how each path ended: ENDED, BROKEN or LONG; number of its steps
    moved         relative change by the last Newton step
    """
    work = workspace(pose.size)
    for path in range(unknowns.shape[0]):
        work.U[0, :] = unknowns[path]
        work.T[0, :] = rotations[path]
        for j in range(pose.size):
            work.d[j], work.primed[j] = task[0, j], task[1, j]
            if pose[j]:
                work.T[0, j] = task[2, j]
        newton_step(work, work.U[0], work.T[0], pose)
        products(work.U[0], work.T[0], work.d, work.primed, work.P[0], work.E[0])
        t, ends[path], steps[path], moved[path] = 0.0, ENDED, 0, np.nan
        while t < 1.0:
            to = advance(work, pose, task, change, t)
            steps[path] += 1
            if to == t or steps[path] >= MOST_STEPS:
                ends[path] = BROKEN if to == t else LONG
                break
            t = to
        if ends[path] == ENDED:
            for _ in range(POLISHING):
                moved[path] = newton_step(work, work.U[0], work.T[0], pose)
        unknowns[path] = work.U[0]
        rotations[path] = work.T[0]
