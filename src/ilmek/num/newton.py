"""Newton's method: for many small systems at once, and damped for one system from afar."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from ilmek.arrays import Float
from ilmek.num.linear import Matrices, Vectors, solve_many

System: TypeAlias = Callable[[Vectors], tuple[Vectors, Matrices]]
"""x -> (f(x), f'(x)), system by system."""


def newton(system: System, start: Vectors, *, tolerance: float, steps: int = 30) -> Vectors:
    """Root x (..., n) of f(x) = 0 for every system of the batch; NaN without convergence.

    system  x -> f(x) (..., n) and f'(x) (..., n, n)      start  (..., n), near the root: steps are not damped
    A system has converged after a step of at most `tolerance` in every unknown; by quadratic convergence the error is
    far below it.    [Nocedal and Wright, Numerical Optimization, chapter 11]

    >>> newton(lambda x: (x * x - 2, 2 * x[..., None]), np.array([[1.0], [3.0]]), tolerance=1e-9).round(12)
    array([[1.41421356],
           [1.41421356]])
    """
    found = np.array(start, dtype=float)
    moved = np.full(found.shape[:-1], np.inf)
    for _ in range(steps):
        value, slope = system(found)
        step = solve_many(slope, value)
        found = found - step
        moved = np.max(np.abs(step), axis=-1)
        if not (moved > tolerance).any():  # a diverged system remains NaN
            break
    return np.where((moved <= tolerance)[..., None], found, np.nan)


Single: TypeAlias = Callable[[Float[np.ndarray, " n"]], tuple[Float[np.ndarray, " m"], Float[np.ndarray, "m n"]]]
"""x -> (f(x), f'(x)) of one system, m <= n."""

SHORTEST = 1e-6
"""Shortest part of a damped step that is tried."""


def damped_newton(
    system: Single, start: Float[np.ndarray, " n"], *, tolerance: float, steps: int = 100
) -> Float[np.ndarray, " n"]:
    """Root of f(x) = 0 near a rough start, m equations in n >= m unknowns; NaN where none is found.

    tolerance  of the last step, and of f at the root

    Each step is the shortest one that solves the linearised equations, halved until |f| decreases. So a system with
    more unknowns than equations is moved to a root near the start.    [Nocedal and Wright, chapters 10 and 11]

    >>> damped_newton(lambda x: (x[:1] ** 2 + x[1:] ** 2 - 1, 2 * x[None, :]), np.array([3.0, 4.0]), tolerance=1e-12)
    array([0.6, 0.8])
    """
    found = np.array(start, dtype=float)
    value, slope = system(found)
    for _ in range(steps):
        if not (np.isfinite(value).all() and np.isfinite(slope).all()):
            break
        step, share = np.linalg.lstsq(slope, value)[0], 1.0
        least = float(np.linalg.norm(value))
        small = float(np.max(np.abs(step))) <= tolerance
        value, slope = system(found - step)
        while not small and not np.linalg.norm(value) <= (1 - 0.1 * share) * least:
            share *= 0.5
            if share < SHORTEST:
                return np.full(found.shape, np.nan)
            value, slope = system(found - share * step)
        found = found - share * step
        if small:
            return found if float(np.max(np.abs(value))) <= tolerance else np.full(found.shape, np.nan)
    return np.full(found.shape, np.nan)
