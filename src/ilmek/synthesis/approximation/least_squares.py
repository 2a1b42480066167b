"""Least squares of errors that are not linear in their parameters, with the gradient as proof.

S = half the sum of errors^2. First Levenberg and Marquardt's steps, then Newton's with the curvature of the errors,

    (J^T J + mu D) d = -J^T e,        (|H| + mu) z = -W^T J^T e, d = W z

D the greatest squares of the columns so far; W makes the columns of J W orthonormal, and |H| is the curvature of S by z
with its eigenvalues made positive. The first kind of step creeps round bends, the second goes round them.
[Moré, The Levenberg-Marquardt algorithm, Lecture Notes in Mathematics 630, 1978, for the scaling]
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.synthesis.approximation.exchange import Errors, Parameters

Square = Float[np.ndarray, "n n"]

STEPS = 80
"""Steps taken at most."""

FIRST = 12
"""Steps after which the curvature of the errors is asked for."""

STOP = 1e-11
"""Cosine between errors and slopes below which a sum of squares is stationary."""


class Squares(NamedTuple):
    """Where a descent ends: the parameters and the sum of squares there.

    slope  greatest cosine of the angle between the errors and a column of their slopes: 0 where S is stationary
    """

    parameters: Parameters
    squares: float
    slope: float


def squares_descent(errors: Errors, start: Parameters, x: FloatArray) -> Squares:
    """The nearest least sum of squares from a start; steps into places without an error (inf) are not taken.

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
    """Levenberg and Marquardt's step, by orthogonal factors of the slopes with the damping below them."""
    size = np.where(scale > 0, scale, 1.0)
    rows = np.vstack([slopes / size, np.sqrt(damping) * np.eye(len(size))])
    right = np.append(-errors, np.zeros(len(size)))
    return np.asarray(np.linalg.lstsq(rows, right, rcond=None)[0] / size)


class _Curved(NamedTuple):
    """S seen in parameters z in which the slopes are orthonormal: d = ways z."""

    ways: Square
    values: FloatArray
    vectors: Square
    gradient: FloatArray

    def ends(self, errors: Errors, parameters: Parameters, x: FloatArray, damping: float) -> list[Parameters]:
        """Where Newton's damped step ends, and that brought down to the valley by least squares across the step."""
        step = -self.vectors @ ((self.vectors.T @ self.gradient) / (np.abs(self.values) + damping))
        end = parameters + self.ways @ step
        lower, across = end, self.ways @ np.linalg.svd(step[None, :])[2][1:].T
        for _ in range(2):
            found, slopes = errors(lower, x)
            if not np.isfinite(found).all():
                break
            lower = lower - across @ np.linalg.lstsq(slopes @ across, found, rcond=None)[0]
        return [end, lower]


def _curved(errors: Errors, parameters: Parameters, x: FloatArray) -> _Curved:
    """Gradient and curvature of S, by differences of the gradient along each of `ways`."""
    found, slopes = errors(parameters, x)
    _, sizes, right = np.linalg.svd(slopes, full_matrices=False)
    held = sizes > 1e-12 * sizes[0]
    ways = right[held].T / sizes[held]
    length = 1e-6 * float(np.linalg.norm(found))
    rows = []
    for way in ways.T:
        (up, up_slopes), (down, down_slopes) = (errors(parameters + side * length * way, x) for side in (1, -1))
        if not (np.isfinite(up).all() and np.isfinite(down).all()):
            break
        rows.append(ways.T @ (up_slopes.T @ up - down_slopes.T @ down) / (2 * length))
    curvature = np.stack(rows) if len(rows) == len(ways.T) else np.eye(len(ways.T))
    return _Curved(ways, *np.linalg.eigh(0.5 * (curvature + curvature.T)), ways.T @ (slopes.T @ found))


def cosine(errors: FloatArray, slopes: FloatArray) -> float:
    """Greatest cosine of the angle between the errors and a column of their slopes."""
    lengths = np.linalg.norm(errors) * np.linalg.norm(slopes, axis=0)
    return float(np.max(np.abs(slopes.T @ errors) / np.where(lengths > 0, lengths, np.inf), initial=0.0))
