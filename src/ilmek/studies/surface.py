"""Response surfaces: a result as a quadratic function of the variables, fitted to the designs of a study.

f ~ b + sum b_i u_i + sum b_ij u_i u_j,  i <= j,    u_i from -1 to 1 over the designs      [Box and Wilson 1951]
"""

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.records import record

SPARE = 2
"""Designs for each coefficient at least."""


@record
class ResponseSurface:
    """A quadratic function of the variables.

    low, high  range of each variable [SI]      coefficients  in the order of the terms
    explained  share of the variance of the result that it explains [1]
    """

    low: Float[np.ndarray, " variables"]
    high: Float[np.ndarray, " variables"]
    coefficients: Float[np.ndarray, " terms"]
    explained: float

    def at(self, points: Float[np.ndarray, "n variables"]) -> Float[np.ndarray, " n"]:
        """The result [SI] of designs."""
        return np.asarray(_terms(2 * (points - self.low) / (self.high - self.low) - 1) @ self.coefficients)

    def influence(self, points: Float[np.ndarray, "n variables"]) -> Float[np.ndarray, " variables"]:
        """What each variable does: the mean square change of the result as it moves to the middle of its range."""
        middle, found = (self.low + self.high) / 2, self.at(points)
        moved = (np.where(np.arange(len(middle)) == number, middle, points) for number in range(len(middle)))
        return np.array([np.mean((self.at(one) - found) ** 2) for one in moved])


def surface_of(points: Float[np.ndarray, "n variables"], values: Float[np.ndarray, " n"]) -> ResponseSurface | None:
    """The surface of least squares; None of too few designs, and where a variable or the result does not vary.

    >>> x, y = (one.ravel() for one in np.meshgrid(np.linspace(1, 3, 5), np.linspace(0, 1, 5)))
    >>> surface = surface_of(np.column_stack([x, y]), 2 + x * y - y**2)
    >>> round(surface.explained, 12), surface.at(np.array([[2.5, 0.5]])).round(12).tolist()
    (1.0, [3.0])
    """
    varied, spread = points.shape[1], np.var(values) if len(values) else 0.0
    if len(points) < SPARE * (varied + 1) * (varied + 2) // 2 or not spread or not np.ptp(points, axis=0).all():
        return None
    low, high = points.min(axis=0), points.max(axis=0)
    terms = _terms(2 * (points - low) / (high - low) - 1)
    coefficients = np.linalg.lstsq(terms, values, rcond=None)[0]
    return ResponseSurface(low, high, coefficients, float(1 - np.var(values - terms @ coefficients) / spread))


def _terms(u: FloatArray) -> FloatArray:
    """1, all variables, all products of two."""
    first, second = np.triu_indices(u.shape[1])
    return np.column_stack([np.ones(len(u)), u, u[:, first] * u[:, second]])
