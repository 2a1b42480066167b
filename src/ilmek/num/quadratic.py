# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""The lowest point of a convex quadratic within linear limits: a few unknowns, compiled, called from other kernels.

    least  1/2 s^T H s + g^T s    with  rows s <= slack,    H positive definite,  slack >= 0

By active sets from s = 0, which is allowed: go to the lowest point on the limits held so far, stop at the first new
one and hold it too; where the lowest point is reached, let go of the limit that pulls the wrong way.
                                                              [Nocedal and Wright, Numerical Optimization, alg. 16.3]
"""

import math

import numpy as np

from ilmek.arrays import Float, Int
from ilmek.num.compiled import compiled

Matrix = Float[np.ndarray, "n n"]
Vector = Float[np.ndarray, " n"]

ROUNDS = 40
"""Changes of the active set at most; the last allowed step is kept."""

LEAST = 1e-18
"""Pivot of H, against its diagonal, below which it is not positive definite."""

SAME = 1e-10
"""Pivot of a limit's row, against its own size, below which the limits already held say the same."""


@compiled
def cholesky(matrix: Matrix, size: int, least: float, factor: Matrix) -> bool:
    """Lower L with L L^T = matrix (its leading `size` rows) into `factor`; False where a pivot is below `least`."""
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
    H: Matrix,
    g: Vector,
    rows: Float[np.ndarray, "m n"],
    slack: Float[np.ndarray, " m"],
    step: Vector,
) -> int:
    """The lowest point s into `step`; number of limits held there, -1 where H is not positive definite."""
    n = g.size
    factor, within = np.empty((n, n)), np.empty((n, n))
    if not cholesky(H, n, LEAST, factor):
        return -1
    held = np.empty(n, np.int64)
    count = held.size - n  # a plain 0 would be compiled for twice, as that number and as any
    pulls, move = np.empty(n), np.empty(n)
    spread = np.empty((n, n))
    for i in range(n):
        step[i] = 0.0
    for _ in range(ROUNDS):
        if not _towards(H, g, rows, step, factor, held, count, spread, within, pulls, move):
            return count - 1
        reach, blocking = _first_limit(rows, slack, step, move, held, count)
        for i in range(n):
            step[i] += reach * move[i]
        if blocking >= 0:
            if count == n:
                return count
            held[count] = blocking
            count += 1
            continue
        worst = _pulling_wrong(pulls, count)
        if worst < 0:
            return count
        count -= 1
        for k in range(worst, count):
            held[k] = held[k + 1]
    return count


@compiled
def _towards(
    H: Matrix,
    g: Vector,
    rows: Float[np.ndarray, "m n"],
    step: Vector,
    factor: Matrix,
    held: Int[np.ndarray, " n"],
    count: int,
    spread: Matrix,
    within: Matrix,
    pulls: Vector,
    move: Vector,
) -> bool:
    """Way to the lowest point on the held limits into `move`, their multipliers into `pulls`; False where they say
    the same twice.

    v = -H^-1 (H s + g),    (A H^-1 A^T) pulls = A v,    move = v - H^-1 A^T pulls
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
    _spread(rows, factor, held, count, spread, crossed)
    if not cholesky(crossed, count, SAME, within):
        return False
    for k in range(count):
        pulls[k] = 0.0
        for i in range(n):
            pulls[k] += rows[held[k], i] * move[i]
    back_solve(within, count, pulls)
    for k in range(count):
        for i in range(n):
            move[i] -= pulls[k] * spread[k, i]
    return True


@compiled
def _spread(
    rows: Float[np.ndarray, "m n"],
    factor: Matrix,
    held: Int[np.ndarray, " n"],
    count: int,
    spread: Matrix,
    crossed: Float[np.ndarray, "count count"],
) -> None:
    """H^-1 A^T of the held limits into the rows of `spread`, A H^-1 A^T into `crossed`."""
    n = rows.shape[1]
    column = np.empty(n)
    for m in range(count):
        for i in range(n):
            column[i] = rows[held[m], i]
        back_solve(factor, n, column)
        for i in range(n):
            spread[m, i] = column[i]
            for k in range(count):
                crossed[k, m] += rows[held[k], i] * column[i]


@compiled
def _pulling_wrong(pulls: Vector, count: int) -> int:
    """The held limit whose multiplier is furthest below 0; -1 where none is."""
    worst = -1
    for k in range(count):
        if pulls[k] < 0.0 and (worst < 0 or pulls[k] < pulls[worst]):
            worst = k
    return worst


@compiled
def _first_limit(
    rows: Float[np.ndarray, "m n"],
    slack: Float[np.ndarray, " m"],
    step: Vector,
    move: Vector,
    held: Int[np.ndarray, " n"],
    count: int,
) -> tuple[float, int]:
    """Part of `move` that is allowed, at most 1, and the limit that ends it (-1: none)."""
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
            holding = holding or held[k] == row
        if not holding:
            reach, blocking = max(0.0, (slack[row] - used) / climb), row
    return reach, blocking
