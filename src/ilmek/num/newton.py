"""Newton's method for many small systems at once."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

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
