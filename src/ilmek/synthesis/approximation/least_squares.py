"""Nonlinear least squares, with the gradient as proof.

S = half the sum of errors^2. First Levenberg-Marquardt steps, then Newton steps with the curvature of the errors,

    (J^T J + mu D) d = -J^T e,        (|H| + mu) z = -W^T J^T e, d = W z

D the greatest squares of the columns so far; W makes the columns of J W orthonormal, and |H| is the Hessian of S by z
with the absolute values of its eigenvalues. In curved valleys Newton steps need far fewer iterations.
[Moré, The Levenberg-Marquardt algorithm, Lecture Notes in Mathematics 630, 1978, for the scaling]
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.synthesis.approximation.exchange import Errors, Parameters

Square = Float[np.ndarray, "n n"]

STEPS = 80
"""Greatest number of steps."""

FIRST = 12
"""Number of Levenberg-Marquardt steps before the Newton steps."""

STOP = 1e-11
"""Cosine between errors and derivatives below which a sum of squares is stationary."""


class Squares(NamedTuple):
    """End of a descent: parameters and sum of squares.

    slope  greatest cosine between the errors and a column of their derivatives; 0 where S is stationary
    """

    parameters: Parameters
    squares: float
    slope: float


def squares_descent(errors: Errors, start: Parameters, x: FloatArray) -> Squares:
    """Local minimum of the sum of squares of errors, from a start.

    errors  (parameters, x) -> errors and their derivatives; inf where they do not exist: such steps are rejected
    start   parameters, shape (n,)
    x       points of the errors, shape (points,)

    >>> found = squares_descent(lambda p, x: (p * p - 2 * x, 2 * p[:, None]), np.ones(1), np.ones(1))
    >>> found.parameters.round(9), found.squares < 1e-20
    (array([1.41421356]), True)
    """
    parameters = np.asarray(start, dtype=float)
    found, slopes = errors(parameters, x)
    if not np.isfinite(found).all():
        return Squares(parameters, np.inf, np.inf)
    damping, scale = 1e-3, np.zeros(len(parameters))
    for count in range(STEPS):
        if cosine(found, slopes) <= STOP:
            break
        scale = np.maximum(scale, np.linalg.norm(slopes, axis=0))
        curved = None if count < FIRST else _curved(errors, parameters, x)
        for _ in range(14):
            ends = (
                [parameters + _first_step(found, slopes, damping, scale)]
                if curved is None
                else curved.ends(errors, parameters, x, damping)
            )
            trials = [errors(end, x) for end in ends]
            sums = [float(trial[0] @ trial[0]) if np.isfinite(trial[0]).all() else np.inf for trial in trials]
            best = int(np.argmin(sums))
            if sums[best] < float(found @ found):
                break
            damping = max(8 * damping, 1e-12)
        else:
            break
        parameters, (found, slopes) = ends[best], trials[best]
        damping *= 0.1 if curved is None else 0.01
    return Squares(parameters, float(found @ found), cosine(found, slopes))


def _first_step(errors: FloatArray, slopes: FloatArray, damping: float, scale: FloatArray) -> FloatArray:
    """Levenberg-Marquardt step, by least squares of the derivatives with the damping as further rows."""
    size = np.where(scale > 0, scale, 1.0)
    rows = np.vstack([slopes / size, np.sqrt(damping) * np.eye(len(size))])
    right = np.append(-errors, np.zeros(len(size)))
    return np.asarray(np.linalg.lstsq(rows, right, rcond=None)[0] / size)


class _Curved(NamedTuple):
    """S in parameters z for which the derivatives are orthonormal: d = columns z."""

    columns: Square
    values: FloatArray
    vectors: Square
    gradient: FloatArray

    def ends(self, errors: Errors, parameters: Parameters, x: FloatArray, damping: float) -> list[Parameters]:
        """End of the damped Newton step, and this end corrected by least squares across the step."""
        step = -self.vectors @ ((self.vectors.T @ self.gradient) / (np.abs(self.values) + damping))
        end = parameters + self.columns @ step
        lower, across = end, self.columns @ np.linalg.svd(step[None, :])[2][1:].T
        for _ in range(2):
            found, slopes = errors(lower, x)
            if not np.isfinite(found).all():
                break
            lower = lower - across @ np.linalg.lstsq(slopes @ across, found, rcond=None)[0]
        return [end, lower]


def _curved(errors: Errors, parameters: Parameters, x: FloatArray) -> _Curved:
    """Gradient and Hessian of S, by differences of the gradient along each of `columns`."""
    found, slopes = errors(parameters, x)
    _, sizes, right = np.linalg.svd(slopes, full_matrices=False)
    regular = sizes > 1e-12 * sizes[0]
    columns = right[regular].T / sizes[regular]
    length = 1e-6 * float(np.linalg.norm(found))
    rows = []
    for column in columns.T:
        (up, up_slopes), (down, down_slopes) = (errors(parameters + side * length * column, x) for side in (1, -1))
        if not (np.isfinite(up).all() and np.isfinite(down).all()):
            break
        rows.append(columns.T @ (up_slopes.T @ up - down_slopes.T @ down) / (2 * length))
    curvature = np.stack(rows) if len(rows) == len(columns.T) else np.eye(len(columns.T))
    return _Curved(columns, *np.linalg.eigh(0.5 * (curvature + curvature.T)), columns.T @ (slopes.T @ found))


def cosine(errors: FloatArray, slopes: FloatArray) -> float:
    """Greatest cosine [1] of the angle between the errors and a column of their derivatives: 0 at a stationary point.

    errors  shape (rows,)      slopes  shape (rows, n); a column of zeros counts as 0      [Moré 1978]
    """
    lengths = np.linalg.norm(errors) * np.linalg.norm(slopes, axis=0)
    return float(np.max(np.abs(slopes.T @ errors) / np.where(lengths > 0, lengths, np.inf), initial=0.0))
