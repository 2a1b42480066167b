# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""Minimum of a convex quadratic under linear inequalities: a few unknowns, compiled, called from other kernels.

    minimise  1/2 s^T H s + g^T s    subject to  rows s <= slack,    H positive definite,  slack >= 0

By active sets from the feasible s = 0: step to the minimum on the active constraints, stop at the first new constraint
and activate it; at the minimum release the constraint with the most negative multiplier.
                                                              [Nocedal and Wright, Numerical Optimization, alg. 16.3]
"""

import math

import numpy as np

from ilmek.arrays import Float, Int
from ilmek.num.compiled import compiled

Matrix = Float[np.ndarray, "n n"]
Vector = Float[np.ndarray, " n"]

ROUNDS = 40
"""Maximum number of changes of the active set; the last feasible step is kept."""

LEAST = 1e-18
"""Least pivot of a positive definite H, relative to its diagonal."""

SAME = 1e-10
"""Least pivot of a constraint that is independent of the active ones, relative to its own size."""


@compiled
def cholesky(matrix: Matrix, size: int, least: float, factor: Matrix) -> bool:
    """Lower L with L L^T = matrix (its leading `size` rows), written to `factor`; False if a pivot is below `least`."""
    for i in range(size):
        for j in range(i + 1):
            total = matrix[i, j]
            for k in range(j):
                total -= factor[i, k] * factor[j, k]
            if i > j:
                factor[i, j] = total / factor[j, j]
            elif total > least * abs(matrix[i, i]):
                factor[i, i] = math.sqrt(total)
            else:
                return False
    return True


@compiled
def back_solve(factor: Matrix, size: int, vector: Vector) -> None:
    """`vector` becomes the solution x of L L^T x = vector."""
    for i in range(size):
        for k in range(i):
            vector[i] -= factor[i, k] * vector[k]
        vector[i] /= factor[i, i]
    for i in range(size - 1, -1, -1):
        for k in range(i + 1, size):
            vector[i] -= factor[k, i] * vector[k]
        vector[i] /= factor[i, i]


@compiled
def limited_step(
    H: Matrix, g: Vector, rows: Float[np.ndarray, "m n"], slack: Float[np.ndarray, " m"], step: Vector
) -> int:
    """Write the minimum s to `step`; the number of active constraints, -1 if H is not positive definite."""
    n = g.size
    factor, within = np.empty((n, n)), np.empty((n, n))
    if not cholesky(H, n, LEAST, factor):
        return -1
    active = np.empty(n, np.int64)
    count = active.size - n  # a literal 0 would be compiled twice, as a constant and as an integer
    multipliers, move = np.empty(n), np.empty(n)
    spread = np.empty((n, n))
    for i in range(n):
        step[i] = 0.0
    for _ in range(ROUNDS):
        if not _towards(H, g, rows, step, factor, active, count, spread, within, multipliers, move):
            return count - 1
        reach, blocking = _first_limit(rows, slack, step, move, active, count)
        for i in range(n):
            step[i] += reach * move[i]
        if blocking >= 0:
            if count == n:
                return count
            active[count] = blocking
            count += 1
            continue
        worst = _most_negative(multipliers, count)
        if worst < 0:
            return count
        count -= 1
        for k in range(worst, count):
            active[k] = active[k + 1]
    return count


@compiled
def _towards(
    H: Matrix,
    g: Vector,
    rows: Float[np.ndarray, "m n"],
    step: Vector,
    factor: Matrix,
    active: Int[np.ndarray, " n"],
    count: int,
    spread: Matrix,
    within: Matrix,
    multipliers: Vector,
    move: Vector,
) -> bool:
    """Write the step to the minimum on the active constraints to `move`, and their multipliers; False if the
    constraints are dependent.

    v = -H^-1 (H s + g),    (A H^-1 A^T) multipliers = A v,    move = v - H^-1 A^T multipliers
    """
    n = g.size
    for i in range(n):
        move[i] = -g[i]
        for j in range(n):
            move[i] -= H[i, j] * step[j]
    back_solve(factor, n, move)
    if count == 0:
        return True
    crossed = np.zeros((count, count))
    _spread(rows, factor, active, count, spread, crossed)
    if not cholesky(crossed, count, SAME, within):
        return False
    for k in range(count):
        multipliers[k] = 0.0
        for i in range(n):
            multipliers[k] += rows[active[k], i] * move[i]
    back_solve(within, count, multipliers)
    for k in range(count):
        for i in range(n):
            move[i] -= multipliers[k] * spread[k, i]
    return True


@compiled
def _spread(
    rows: Float[np.ndarray, "m n"],
    factor: Matrix,
    active: Int[np.ndarray, " n"],
    count: int,
    spread: Matrix,
    crossed: Float[np.ndarray, "count count"],
) -> None:
    """Write H^-1 A^T of the active constraints to the rows of `spread`, and A H^-1 A^T to `crossed`."""
    n = rows.shape[1]
    column = np.empty(n)
    for m in range(count):
        for i in range(n):
            column[i] = rows[active[m], i]
        back_solve(factor, n, column)
        for i in range(n):
            spread[m, i] = column[i]
            for k in range(count):
                crossed[k, m] += rows[active[k], i] * column[i]


@compiled
def _most_negative(multipliers: Vector, count: int) -> int:
    """The active constraint with the most negative multiplier; -1 for none."""
    worst = -1
    for k in range(count):
        if multipliers[k] < 0.0 and (worst < 0 or multipliers[k] < multipliers[worst]):
            worst = k
    return worst


@compiled
def _first_limit(
    rows: Float[np.ndarray, "m n"],
    slack: Float[np.ndarray, " m"],
    step: Vector,
    move: Vector,
    active: Int[np.ndarray, " n"],
    count: int,
) -> tuple[float, int]:
    """Feasible share of `move`, at most 1, and the constraint that limits it (-1: none)."""
    reach, blocking = 1.0, -1
    for row in range(slack.size):
        climb, used = 0.0, 0.0
        for i in range(step.size):
            climb += rows[row, i] * move[i]
            used += rows[row, i] * step[i]
        if climb <= 0.0 or slack[row] - used >= reach * climb:
            continue
        holding = False
        for k in range(count):
            holding = holding or active[k] == row
        if not holding:
            reach, blocking = max(0.0, (slack[row] - used) / climb), row
    return reach, blocking
