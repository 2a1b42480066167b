"""Minimax approximation by exchange: least greatest error, with a lower bound as proof.

    min over d of  max_i |e_i - sum_k T_ik d_k|

On a reference of n + 1 rows all errors can be made equal to one level h. As sum y_i T_i = 0 for the multipliers y of
the reference, every d has an error of at least h in some row (de la Vallee-Poussin). The row of the greatest error is
exchanged for one of the reference, h grows, and where h reaches the greatest error the solution is optimal. The signs
are those of y and need not alternate: a Chebyshev system is not required.

Nonlinear errors are linearised repeatedly: each step goes towards the minimax of the tangents, within a trust region.
Where the level of the tangents equals the greatest error, no small change of the parameters reduces it.
[Stiefel, Numer. Math. 1 (1959) 1; Osborne and Watson, Comput. J. 12 (1969) 63; Powell, Approximation theory, 8, 9]
"""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple, TypeAlias

import numpy as np
import scipy

from ilmek.arrays import Float, FloatArray, Int

Parameters: TypeAlias = Float[np.ndarray, " parameters"]

Errors: TypeAlias = Callable[[Parameters, FloatArray], tuple[FloatArray, FloatArray]]
"""(parameters, x) -> errors at x, and their derivatives, shape (x, parameters); inf where the error does not exist."""

RANK = 1e-11
"""Relative singular value below which columns are dependent."""

LEVEL = 1e-12
"""Relative difference of level and greatest error at which the exchange ends."""

STEPS = 80
"""Greatest number of linearisations."""

PROVEN = 1e-7
"""Relative difference of bound and greatest error up to which a minimax counts as proven."""


class MinimaxLevel(NamedTuple):
    """The minimax of linear errors e - T d.

    change       d
    level        h, lower bound of the greatest error for any d
    worst        greatest error at d
    rows         indices of the reference
    multipliers  y of its rows: sum y T = 0, sum |y| = 1, sum y e = h
    """

    change: Parameters
    level: float
    worst: float
    rows: Int[np.ndarray, " rows"]
    multipliers: Float[np.ndarray, " rows"]


class Descent(NamedTuple):
    """End of a descent: parameters, level of the tangents (lower bound), and greatest error."""

    parameters: Parameters
    level: float
    worst: float

    @property
    def gap(self) -> float:
        """Optimality gap (worst - level) / worst; 0 where the error is 0."""
        return max(0.0, 1.0 - self.level / self.worst) if self.worst > 0 else 0.0


def linear_minimax(slopes: Float[np.ndarray, "m n"], errors: Float[np.ndarray, " m"]) -> MinimaxLevel:
    """The change d for which the greatest of |errors - slopes d| is least; of several about the shortest.

    slopes  T, shape (m, n); dependent columns share the change, by their singular values      errors  e, shape (m,)

    >>> x = np.linspace(0, 1, 101)  # sqrt(x) by a line: x + 1/8
    >>> best = linear_minimax(np.stack([np.ones(101), x], axis=-1), np.sqrt(x))
    >>> best.change.round(12), best.rows.tolist(), round(best.level, 12)
    (array([0.125, 1.   ]), [100, 0, 25], 0.125)
    """
    left, sizes, right = np.linalg.svd(slopes, full_matrices=False)
    rank = int(np.sum(sizes > RANK * max(float(sizes[0]), 1e-300)))
    rows, signs, multipliers = _first_reference(left[:, :rank], errors)
    change = left[:, :rank].T @ errors
    for _ in range(30 + 3 * len(errors)):
        if len(rows) <= rank:  # as many unknowns as errors: all errors are zero
            break
        table = np.column_stack([left[rows, :rank], signs])
        solved = np.linalg.solve(table, errors[rows])
        change, level = solved[:-1], float(solved[-1])
        left_over = errors - left[:, :rank] @ change
        enters = int(np.argmax(np.abs(left_over)))
        if abs(left_over[enters]) <= level * (1 + LEVEL) or enters in rows:
            break
        sign = float(np.sign(left_over[enters]))
        shift = -np.linalg.solve(table.T, np.append(sign * left[enters, :rank], 1.0))
        falling = -signs * shift
        steps = np.where(falling > 0, np.abs(multipliers) / np.where(falling > 0, falling, 1.0), np.inf)
        leaves = int(np.argmin(steps))
        multipliers = multipliers + steps[leaves] * shift
        multipliers[leaves] = sign * steps[leaves]
        rows[leaves], signs[leaves] = enters, sign
    worst = float(np.max(np.abs(errors - left[:, :rank] @ change)))
    bound = float(multipliers @ errors[rows]) if len(rows) > rank else 0.0
    return MinimaxLevel(right[:rank].T @ (change / sizes[:rank]), max(0.0, min(bound, worst)), worst, rows, multipliers)


def _first_reference(
    basis: Float[np.ndarray, "m r"], errors: Float[np.ndarray, " m"]
) -> tuple[Int[np.ndarray, " rows"], Float[np.ndarray, " rows"], Float[np.ndarray, " rows"]]:
    """Independent rows and one more, their signs and multipliers."""
    rank = basis.shape[1]
    order = np.asarray(scipy.linalg.qr(basis.T, mode="r", pivoting=True)[1], dtype=np.int64)
    rows = order[: rank + 1].copy()
    if len(rows) <= rank:
        return rows, np.ones(len(rows)), np.zeros(len(rows))
    parts = np.append(-np.linalg.solve(basis[rows[:rank]].T, basis[rows[rank]]), 1.0)
    parts *= 1.0 if parts @ errors[rows] >= 0 else -1.0
    return rows, np.where(parts < 0, -1.0, 1.0), parts / np.sum(np.abs(parts))


def minimax_descent(errors: Errors, start: Parameters, x: FloatArray, *, least: float = 0.0) -> Descent:
    """Local minimax of errors at points x, from a start.

    errors  (parameters, x) -> errors, shape (points,), and derivatives, (points, n)      start  parameters, (n,)
    x       shape (points,)                                least  error that counts as 0

    If the reduction of a step is too small compared with that of its tangents, the step is rejected and the trust
    region reduced: no single parameter may then change an error by more than `reach`, by further rows of the same
    minimax. Where this bound is active the errors are curved; the same step and a Newton step are then tried as well,
    each followed by making the errors of the reference equal.
    """
    parameters = np.asarray(start, dtype=float)
    found, slopes = errors(parameters, x)
    worst, reach = float(np.max(np.abs(found))), np.inf
    if not np.isfinite(worst):
        return Descent(parameters, 0.0, np.inf)
    for _ in range(STEPS):
        step = _bounded_step(found, slopes, reach)
        promised = worst - float(np.max(np.abs(found + slopes @ step.change)))
        if worst <= least or promised <= LEVEL * worst or reach <= LEVEL * worst:
            break
        ends = [parameters + step.change]
        if np.isfinite(reach):
            curved = _curved_step(errors, parameters, x, (found, slopes), step)
            ends += [_with_equal_errors(errors, parameters + change, x, step) for change in (step.change, curved)]
        trials = [errors(end, x) for end in ends]
        sizes = [float(np.max(np.abs(trial[0]))) for trial in trials]
        best = int(np.argmin(sizes))
        gained = worst - sizes[best]
        longest = float(np.max(np.abs(step.change) * np.max(np.abs(slopes), axis=0)))
        if not gained >= 0.25 * promised:
            reach = 0.25 * longest
        elif gained >= 0.75 * promised:
            reach = max(reach, 3 * longest)
        if gained > 0:
            parameters, (found, slopes), worst = ends[best], trials[best], sizes[best]
    return Descent(parameters, linear_minimax(-slopes, found).level, worst)


def _bounded_step(errors: Float[np.ndarray, " m"], slopes: Float[np.ndarray, "m n"], reach: float) -> MinimaxLevel:
    """The minimax of the tangents within the trust region `reach`."""
    if np.isinf(reach):
        return linear_minimax(-slopes, errors)
    bounds = np.diag(np.max(np.abs(slopes), axis=0)) * (np.max(np.abs(errors)) / reach)
    return linear_minimax(np.vstack([-slopes, bounds]), np.append(errors, np.zeros(len(bounds))))


def _curved_step(
    errors: Errors, parameters: Parameters, x: FloatArray, current: tuple[FloatArray, FloatArray], step: MinimaxLevel
) -> Parameters:
    """Newton step for parameters, level and multipliers on the reference of a minimax; 0 if it fails.

    H d + J^T w = 0,    J d - s h = -e,    s^T w = 1,    H = sum of w_i times the curvature of e_i
    """
    active = (step.rows < len(x)) & (np.abs(step.multipliers) > RANK)
    rows, weights = step.rows[active], step.multipliers[active]
    found, slopes = current[0][rows], current[1][rows]
    count, many, signs = len(parameters), len(rows), np.sign(weights)
    if not many:
        return np.zeros(count)
    weights = weights / np.sum(np.abs(weights))
    size = 1e-5 * np.maximum(1e-3, np.abs(parameters))
    sides = [[errors(parameters + sign * size * axis, x[rows])[1] for sign in (1, -1)] for axis in np.eye(count)]
    curvature = np.stack([weights @ (up - down) / 2 for up, down in sides]) / size[:, None]
    table = np.zeros((count + many + 1, count + many + 1))
    table[:count, :count] = 0.5 * (curvature + curvature.T)
    table[:count, count:-1], table[count:-1, :count] = slopes.T, slopes
    table[count:-1, -1] = table[-1, count:-1] = -signs
    right = np.concatenate([np.zeros(count), -found, [-1.0]])
    try:
        return np.linalg.solve(table, right)[:count]
    except np.linalg.LinAlgError:
        return np.zeros(count)


def _with_equal_errors(errors: Errors, parameters: Parameters, x: FloatArray, step: MinimaxLevel) -> Parameters:
    """Parameters nearby, about the nearest, for which the errors of a step's reference are equal."""
    active = (step.rows < len(x)) & (np.abs(step.multipliers) > RANK)
    rows, signs = step.rows[active], np.sign(step.multipliers[active])
    for _ in range(3):
        found, slopes = errors(parameters, x[rows])
        if not np.isfinite(found).all() or not len(rows):
            break
        size = np.max(np.abs(slopes), axis=0)
        size = np.where(size > 0, size, 1.0)
        table = np.column_stack([slopes / size, -signs])
        parameters = (
            parameters + np.linalg.lstsq(table, signs * np.max(signs * found) - found, rcond=None)[0][:-1] / size
        )
    return parameters


def extremes(error: Callable[[FloatArray], FloatArray], x: FloatArray) -> FloatArray:
    """All local extrema of an error, including the ends: bracketed on x, then located by golden sections.

    error  function of x      x  ascending or descending; returned itself where an error is not finite

    >>> extremes(lambda x: np.cos(3 * np.arccos(x)), np.linspace(-1, 1, 50)).round(7)
    array([-1. , -0.5,  0.5,  1. ])
    """
    values = error(x)
    if not np.isfinite(values).all():
        return x
    rising = np.sign(np.diff(values))
    inner = 1 + np.flatnonzero(rising[1:] * rising[:-1] <= 0)
    if not len(inner):
        return x[[0, -1]]
    sign = np.where(rising[inner - 1] - rising[inner] >= 0, 1.0, -1.0)
    low, high = x[inner - 1], x[inner + 1]
    part = 0.5 * (np.sqrt(5.0) - 1)
    for _ in range(30):
        one, other = high - part * (high - low), low + part * (high - low)
        better = sign * error(one) > sign * error(other)
        low, high = np.where(better, low, one), np.where(better, other, high)
    return np.concatenate([x[:1], 0.5 * (low + high), x[-1:]])


def minimax_over_range(errors: Errors, start: Parameters, x: FloatArray, *, least: float = 0.0) -> Descent:
    """Local minimax over a whole range: on points x first, then with all extrema in between added.

    The arguments are those of `minimax_descent`. The lower bound of the points also holds for the range; `worst` is the
    greatest error over the range.
    """
    points, descent = x, Descent(np.asarray(start, dtype=float), 0.0, np.inf)
    for _ in range(12):
        descent = minimax_descent(errors, descent.parameters, points, least=least)
        if not np.isfinite(descent.worst):
            break
        at = extremes(partial(_error_alone, errors, descent.parameters), points)
        worst = float(np.max(np.abs(_error_alone(errors, descent.parameters, at))))
        done = worst <= max(least, descent.worst * (1 + 1e-9)) or descent.gap > PROVEN
        descent = descent._replace(worst=max(worst, descent.worst))
        if done:
            break
        points = np.union1d(points, at)
    return descent


def _error_alone(errors: Errors, parameters: Parameters, x: FloatArray) -> FloatArray:
    return errors(parameters, x)[0]
