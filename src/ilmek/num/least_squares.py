"""Parameters of a model by least squares, with their standard deviations.

min sum r_i(p)²,     cov p = s² (J^T J)^-1,     s² = sum r_i² / (n - k)
                                                [Levenberg-Marquardt within bounds: scipy's trust region reflective]
"""

from collections.abc import Callable

import numpy as np
from scipy.optimize import least_squares

from ilmek.arrays import Float, FloatArray
from ilmek.records import record

STEP = 1e-4
"""Relative step of the derivatives: models have errors of interpolation."""


@record
class LeastSquares:
    """Values of parameters and their standard deviations; inf where the residuals do not depend on one.

    evaluations  of the residuals
    """

    values: Float[np.ndarray, " parameters"]
    deviations: Float[np.ndarray, " parameters"]
    evaluations: int


def fitted(
    residuals: Callable[[FloatArray], FloatArray], start: FloatArray, bounds: tuple[FloatArray, FloatArray]
) -> LeastSquares:
    """Parameters whose residuals have the least sum of squares, from a start within the bounds.

    >>> x = np.linspace(0.0, 1.0, 20)
    >>> line = fitted(lambda p: p[0] + p[1] * x - (2.0 - 3.0 * x), np.ones(2), (np.full(2, -9.0), np.full(2, 9.0)))
    >>> np.round(line.values, 6).tolist()
    [2.0, -3.0]
    """
    # A start on a bound has no interior; parameters are scaled by themselves.
    low, high = bounds
    inner = np.clip(start, np.nextafter(low, np.inf), np.nextafter(high, -np.inf))
    scale = np.where(inner == 0, 1.0, np.abs(inner))
    found = least_squares(residuals, inner, bounds=bounds, x_scale=scale, diff_step=STEP)
    free = max(1, found.fun.size - start.size)
    normal = found.jac.T @ found.jac
    dependent = np.diag(normal) > 0
    deviations = np.full(start.size, np.inf)
    inverse = np.linalg.pinv(normal[np.ix_(dependent, dependent)], hermitian=True)
    deviations[dependent] = np.sqrt(np.maximum(np.diag(inverse), 0.0) * 2 * found.cost / free)
    return LeastSquares(found.x, deviations, int(found.nfev))
