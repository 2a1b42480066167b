"""The time-optimal speed along a path as an optimisation over a spline, by a banded interior-point method.

    minimise ∫ du / sqrt(w)   so that   c + k / sqrt(w) + R w >= 0 at every point,     w = u'² a cubic spline of u

R acts on w and its first two derivatives. The objective is convex, every c + R w is linear. k / sqrt(w) is convex, so
its tangent lies below it: a step that keeps the tangent's constraint keeps the true one, and no iterate ever breaks a
limit. Newton's matrix uses the tangents of the constraints. It is positive definite and banded, because only four
coefficients act at a point: the time of a step is proportional to the number of points. The integral is a sum over the
same points, so w cannot vanish at one of them.
                       [primal-dual steps: S. Boyd and L. Vandenberghe, Convex Optimization, 11.7; tangents of a convex
                       function: A. Yuille and A. Rangarajan, The concave-convex procedure, 2003]
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
import scipy

from ilmek.arrays import Float, FloatArray, IntArray

ORDER = 4
"""Number of coefficients of a cubic spline that act at a point."""

GAP, STEPS = 1e-6, 300
"""Duality gap over the time at which the search ends, and largest number of steps."""

_TO_WALL, _SPREAD, _SHRINK = 0.95, 10.0, 0.1
"""Share of the distance to the nearest constraint that a step covers; allowed spread of the products of slack and
multiplier about their mean; least factor by which that mean is reduced in a step."""


@dataclass(frozen=True, slots=True, eq=False)
class SpeedTask:
    """The optimisation task; the points are in order of u, the same number in every interval of the knots.

    knots   of u, ascending [-]    basis  values of the four B-splines at the points
    weight  of the integral        rows   R by coefficient        constant, root   c and k
    by_root  number of the first constraint whose k is not 0
    """

    knots: Float[np.ndarray, " knots"]
    basis: Float[np.ndarray, "points 4"]
    weight: Float[np.ndarray, " points"]
    rows: Float[np.ndarray, "points constraints 4"]
    constant: Float[np.ndarray, "points constraints"]
    root: Float[np.ndarray, "points constraints"]
    by_root: int

    @property
    def seen(self) -> IntArray:
        """The coefficients that act at each point, (points, 4)."""
        intervals = len(self.knots) - 1
        return _seen(intervals, len(self.basis) // intervals)

    def time(self, w: FloatArray) -> float:
        """The time [s] for w [1/s²] at the points."""
        return float(np.sum(self.weight / np.sqrt(w)))

    def scaled(self, scale: float) -> "SpeedTask":
        """The same task for w / scale."""
        return replace(self, rows=self.rows * scale, root=self.root / np.sqrt(scale))


@dataclass(frozen=True, slots=True, eq=False)
class _State:
    """Coefficients, w at the points, and the slacks of the constraints."""

    x: FloatArray
    w: FloatArray
    slack: FloatArray


def local_basis(knots: FloatArray, share: FloatArray, order: int = 0) -> FloatArray:
    """The four B-splines, or their derivative of an order, at shares [-] of every interval, (points, 4)."""
    width = np.diff(knots)[:, None]
    u = (knots[:-1, None] + width * share).ravel()
    apart = ORDER + 1  # of a column's B-splines; one more than act at a point, as a rounded point may be beside a knot
    columns = np.eye(apart)[np.arange(len(knots) + ORDER - 2) % apart]
    values = scipy.interpolate.BSpline(clamped(knots), columns, ORDER - 1)(u, nu=order)
    return np.asarray(np.take_along_axis(values, _seen(len(knots) - 1, len(share)) % apart, 1))


def clamped(knots: FloatArray) -> FloatArray:
    """The knots with their ends repeated."""
    return np.pad(knots, ORDER - 1, mode="edge")


@lru_cache(maxsize=8)
def _seen(intervals: int, points: int) -> IntArray:
    return np.repeat(np.arange(intervals), points)[:, None] + np.arange(ORDER)


def quickest(task: SpeedTask, start: float) -> FloatArray:
    """Coefficients of the optimal w [1/s²]; the constant w = `start` must strictly fulfil all constraints."""
    scaled = task.scaled(start)
    state = _state(scaled, np.ones(len(task.knots) + ORDER - 2))
    assert state is not None  # precondition: w = start is strictly feasible
    mean = scaled.time(state.w) / state.slack.size
    duals = mean / state.slack
    shrink = 0.3
    for _ in range(STEPS):
        gap = float(np.sum(duals * state.slack))
        if gap < GAP * scaled.time(state.w):
            break
        mean = gap / state.slack.size * shrink
        step, change, gain = _newton(scaled, state, duals, mean)
        dual_share = min(1.0, _to_wall(duals, gain))
        state, share = _moved(scaled, state, step, change)
        if share == 0.0:
            break
        near = mean / state.slack
        duals = np.clip(duals + dual_share * gain, near / _SPREAD, near * _SPREAD)
        shrink = min(1.0, max(_SHRINK, 1 - min(share, dual_share)))
    return state.x * start


def _state(task: SpeedTask, x: FloatArray) -> _State | None:
    """The state of coefficients; None where w is not above 0, or a constraint does not hold."""
    local = x[task.seen]
    w = (task.basis * local).sum(1)
    if not w.min() > 0:
        return None
    slack = task.constant + task.root / np.sqrt(w)[:, None] + (task.rows @ local[..., None])[..., 0]
    return _State(x, w, slack) if slack.min() > 0 else None


def _newton(
    task: SpeedTask, state: _State, duals: FloatArray, mean: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Step of the coefficients, and the changes of slacks and multipliers with it."""
    intervals, seen = len(task.knots) - 1, task.seen
    first = task.by_root
    bent = -0.5 * task.root[:, first:] / state.w[:, None] ** 1.5
    gradients = task.rows.copy()
    gradients[:, first:] += bent[..., None] * task.basis[:, None]
    slope = _summed(seen, (-0.5 * task.weight * state.w**-1.5)[:, None] * task.basis, len(state.x))
    slope += _summed(seen, -((mean / state.slack)[:, None] @ gradients)[:, 0], len(state.x))
    curvature = _blocks((0.75 * task.weight * state.w**-2.5)[:, None] * task.basis, task.basis, intervals)
    steep = gradients * (duals / state.slack)[..., None]
    curvature += _blocks(steep.reshape(-1, ORDER), gradients.reshape(-1, ORDER), intervals)
    step = scipy.linalg.solveh_banded(_banded(curvature), -slope, lower=True)
    change = (gradients @ step[seen][..., None])[..., 0]
    return step, change, (mean - duals * change) / state.slack - duals


def _summed(seen: IntArray, values: FloatArray, size: int) -> FloatArray:
    """Sums of the values by the numbers of their coefficients."""
    return np.bincount(seen.ravel(), values.ravel(), minlength=size)


def _blocks(left: FloatArray, right: FloatArray, intervals: int) -> FloatArray:
    """Sum of the products over an interval's rows: (intervals, 4, 4)."""
    shape = (intervals, -1, ORDER)
    return np.asarray(np.swapaxes(left.reshape(shape), 1, 2) @ right.reshape(shape))


def _banded(blocks: FloatArray) -> FloatArray:
    """Lower bands of the overlapping sum of the blocks; the ridge regularises unused coefficients."""
    intervals = len(blocks)
    bands = np.zeros((ORDER, intervals + ORDER - 1))
    for row in range(ORDER):
        for column in range(row + 1):
            bands[row - column, column : column + intervals] += blocks[:, row, column]
    bands[0] *= 1 + 1e-12
    return bands


def _to_wall(values: FloatArray, change: FloatArray) -> float:
    """Share of a change that reduces a positive value nearly to 0."""
    with np.errstate(divide="ignore"):
        shares = np.where(change < 0, -values / change, np.inf)
    return float(_TO_WALL * np.min(shares))


def _moved(task: SpeedTask, state: _State, step: FloatArray, change: FloatArray) -> tuple[_State, float]:
    """The state after the largest feasible share of a step, and that share; 0 where there is none."""
    share = min(1.0, _to_wall(state.slack, change))
    while share > 1e-9:
        moved = _state(task, state.x + share * step)
        if moved is not None and (moved.slack > 0.01 * state.slack).all():
            return moved, share
        share *= 0.7
    return state, 0.0
