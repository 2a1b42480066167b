"""Time-optimal motion of several axes along a given path, from rest to rest, within speed, acceleration and jerk.

In the parameter u of `path_speed.path`, with w = u'², the limits of an axis are

    Q' sqrt(w) <= V      |Q'' w + Q' w_u / 2| <= A      |Q''' w + 3/2 Q'' w_u + 1/2 Q' w_uu| <= J / sqrt(w)

The first two are linear in w [D. Verscheure and others, IEEE Trans. Automatic Control 54 (2009) 2318, for torques]; the
third has a convex right-hand side. w is a cubic spline, so speed, acceleration and jerk are continuous;
`path_speed.barrier` finds it. The limits hold at four points of every interval. Where they are exceeded between the
points, the interval is divided or its limits are tightened, and the spline is computed again. The motion is then slowed
down until every limit holds. The result is a local optimum within the spline: the jerk's limit is not convex.
"""

from dataclasses import dataclass, replace

import numpy as np
import scipy

from ilmek.arrays import Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.timing.path_speed.barrier import SpeedTask, clamped, local_basis, quickest
from ilmek.timing.path_speed.path import AxesLimits, JointPath, Three, rates, rise

__all__ = ["AxesLimits", "JointPath", "PathMotion", "Trajectory", "quickest_motion"]

INTERVALS, COARSE = 300, 80
"""Intervals of the spline, and of the first coarse spline, which determines the knots."""

TOLERANCE, GROSS, ROUNDS = 1e-3, 1.05, 6
"""Relative excess between the points that is left to slowing down; use of a limit above which an interval is divided;
largest number of rounds."""

_POINTS, _SHARES = np.array([0.0, 1 / 3, 2 / 3, 1.0]), np.array([1.0, 3.0, 3.0, 1.0]) / 8
_FINE = np.linspace(0.0, 1.0, 21)
_GAUSS, _WEIGHT = np.polynomial.legendre.leggauss(5)


@dataclass(frozen=True, slots=True, eq=False)
class Trajectory:
    """A motion at times [s]: the path's parameter and its rates by time, (times,); those of the axes, (times, axes)."""

    time: FloatArray
    s: FloatArray
    s_speed: FloatArray
    s_acceleration: FloatArray
    s_jerk: FloatArray
    position: FloatArray
    speed: FloatArray
    acceleration: FloatArray
    jerk: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class PathMotion:
    """The motion along a path, from rest to rest.

    knots, times   of the spline [-], and the times at them [s]     square  w(u) = u'² [1/s²], cubic between the knots
    usage          largest speed, acceleration and jerk over their limits on a fine grid, (3, axes): at most 1
    """

    path: JointPath
    limits: AxesLimits
    knots: FloatArray
    times: FloatArray
    square: "scipy.interpolate.BSpline"
    usage: Float[np.ndarray, "3 axes"]

    @property
    def duration(self) -> float:
        """Time from rest to rest [s]."""
        return float(self.times[-1])

    def even(self, count: int) -> Trajectory:
        """The motion at `count` even times, with both ends."""
        return self.at(np.linspace(0.0, self.duration, count))

    def at(self, time: FloatArray) -> Trajectory:
        """The motion at times [s], (times,); at rest before and after."""
        u = self._parameter(np.clip(time, 0.0, self.duration))
        g, *slopes = (self.path.length * one for one in rise(u))
        s = self.path.s[0] + g
        square = _derivatives(self.square, u)
        moves = (time >= 0) & (time <= self.duration)
        s1, s2, s3 = (np.where(moves, rate, 0.0) for rate in rates((slopes[0], slopes[1], slopes[2]), square))
        every = rates(self.path.derivatives(u), (square[0][:, None], square[1][:, None], square[2][:, None]))
        speed, acceleration, jerk = (np.where(moves[:, None], one, 0.0) for one in every)
        return Trajectory(time, s, s1, s2, s3, self.path.at(s), speed, acceleration, jerk)

    def _parameter(self, time: FloatArray) -> FloatArray:
        """U at times, by Newton's method on t(u) = ∫ du / sqrt(w) from the knot before."""
        interval = np.clip(np.searchsorted(self.times, time, side="right") - 1, 0, len(self.knots) - 2)
        low, high = self.knots[interval], self.knots[interval + 1]
        gone = time - self.times[interval]
        u = low + (high - low) * gone / np.diff(self.times)[interval]
        for _ in range(6):
            late = _passing(self.square, low, u) - gone
            u = np.clip(u - late * np.sqrt(self.square(u)), low, high)
        return np.asarray(u)


def quickest_motion(path: JointPath, limits: AxesLimits, intervals: int = INTERVALS) -> PathMotion:
    """The fastest motion along a path, from rest to rest, within the limits of every axis.

    intervals  of the spline; the excess time is proportional to the square of their width
    Raises ParameterError where limits and path have different numbers of axes, and for fewer than ten intervals.

    >>> one = np.ones((5, 1))
    >>> straight = JointPath(np.linspace(0, 2, 5), np.linspace(0, 2, 5)[:, None], one, 0 * one)
    >>> motion = quickest_motion(straight, AxesLimits(np.array([1.0]), np.array([2.0]), np.array([4.0])))
    >>> round(motion.duration, 2)  # s_curve: 3 s
    3.0
    """
    if path.positions.shape[1] != len(limits.jerk) or intervals < 10:
        raise ParameterError(
            f"{path.positions.shape[1]} axes with limits of {len(limits.jerk)}, in {intervals} intervals",
            allowed="limits of every axis, ten intervals or more",
        )
    even = np.linspace(0.0, 1.0, COARSE + 1)
    knots = _knots(path, _found(path, limits, even, rounds=2)[1], intervals)
    return _timed(path, limits, *_found(path, limits, knots, ROUNDS))


def _found(
    path: JointPath, limits: AxesLimits, knots: FloatArray, rounds: int
) -> "tuple[FloatArray, scipy.interpolate.BSpline]":
    """The optimal w, and its knots; each further round divides or tightens the intervals that exceed a limit."""
    share = np.ones((len(knots) - 1, 1 + 4 * len(limits.jerk)))
    while True:
        fine, points = _derivatives_at(path, knots)
        square = _best(points, fine, limits, knots, share)
        over = _overstep(fine, limits, knots, square)
        rounds -= 1
        if rounds == 0 or over.max() <= 1 + TOLERANCE:
            return knots, square
        parts = np.where(over.max(axis=1) > GROSS, 4, 1)
        tight = np.where(parts[:, None] > 1, share, np.maximum(share / np.maximum(over, 1.0), 0.2))
        share = np.repeat(tight, parts, axis=0)
        knots = np.append(0.0, np.cumsum(np.repeat(np.diff(knots) / parts, parts)))


def _derivatives_at(path: JointPath, knots: FloatArray) -> tuple[Three, Three]:
    """The path's derivatives at the fine shares of every interval, and at the points."""
    every = [
        derivative.reshape(len(knots) - 1, -1, derivative.shape[-1])
        for derivative in path.derivatives(_at(knots, np.append(_FINE, _POINTS)))
    ]
    fine, points = (
        [one[:, part].reshape(-1, one.shape[-1]) for one in every]
        for part in (slice(len(_FINE)), slice(len(_FINE), None))
    )
    return (fine[0], fine[1], fine[2]), (points[0], points[1], points[2])


def _best(
    points: Three, fine: Three, limits: AxesLimits, knots: FloatArray, share: FloatArray
) -> "scipy.interpolate.BSpline":
    """The optimal w where every interval may use a share of the limits."""
    task, tight = _task(points, limits, knots), np.repeat(share, len(_POINTS), axis=0)
    task = replace(task, constant=task.constant * tight, root=task.root * tight)
    x = quickest(task, 0.8 * float(share.min()) ** 2 / max(_slowness(fine, limits), _slowness(points, limits)) ** 2)
    return scipy.interpolate.BSpline(clamped(knots), x, 3)


def _slowness(slopes: Three, limits: AxesLimits) -> float:
    """Factor of time by which the motion u = t must be slowed down to keep every limit where its derivatives are."""
    q1, q2, q3 = (np.abs(slope) for slope in slopes)
    return float(
        max(np.max(q1 / limits.speed), np.sqrt(np.max(q2 / limits.acceleration)), np.cbrt(np.max(q3 / limits.jerk)))
    )


def _task(points: Three, limits: AxesLimits, knots: FloatArray) -> SpeedTask:
    """The limits at the points, each over its value: speeds together, then accelerations and jerks of both signs."""
    q1, q2, q3 = (point[..., None] for point in points)
    b0, b1, b2 = (local_basis(knots, _POINTS, order) for order in range(3))
    quick = np.max((q1[..., 0] / limits.speed) ** 2, axis=1)[:, None, None] * b0[:, None]
    bend = (q2 * b0[:, None] + q1 * b1[:, None] / 2) / limits.acceleration[:, None]
    jerk = (q3 * b0[:, None] + 1.5 * q2 * b1[:, None] + q1 * b2[:, None] / 2) / limits.jerk[:, None]
    rows = np.concatenate([-quick, -bend, bend, -jerk, jerk], axis=1)
    first = 2 * len(limits.jerk) + 1
    by_root = np.arange(rows.shape[1]) >= first
    constant = np.broadcast_to(np.where(by_root, 0.0, 1.0), rows.shape[:2])
    weight = (np.diff(knots)[:, None] * _SHARES).ravel()  # Simpson's second rule
    return SpeedTask(knots, b0, weight, rows, constant, 1.0 - constant, first)


def _overstep(fine: Three, limits: AxesLimits, knots: FloatArray, square: "scipy.interpolate.BSpline") -> FloatArray:
    """Largest use of every constraint in every interval, (intervals, constraints)."""
    used = _used(fine, limits, _at(knots, _FINE), square)
    speed = np.max(used[0] ** 2, axis=1)[:, None]
    every = np.concatenate([speed, used[1], -used[1], used[2], -used[2]], axis=1)
    return np.asarray(every.reshape(len(knots) - 1, len(_FINE), -1).max(axis=1))


def _used(slopes: Three, limits: AxesLimits, u: FloatArray, square: "scipy.interpolate.BSpline") -> Three:
    """Speed, acceleration and jerk over their limits, signed, (points, axes) each; slopes: of the path at u."""
    w, w1, w2 = (derivative[:, None] for derivative in _derivatives(square, u))
    speed, acceleration, jerk = rates(slopes, (w, w1, w2))
    return speed / limits.speed, acceleration / limits.acceleration, jerk / limits.jerk


def _knots(path: JointPath, square: "scipy.interpolate.BSpline", intervals: int) -> FloatArray:
    """Knots: a third each even in u, even in time, and by the curvature of the path."""
    u = np.linspace(0.0, 1.0, 16 * COARSE + 1)
    middle = (u[1:] + u[:-1]) / 2
    leading = rise(middle)
    s = path.s[0] + path.length * leading[0]
    slope, bend, twist = (np.linalg.norm(path.at(s, order), axis=1) for order in (1, 2, 3))
    slope = np.maximum(slope, 1e-6 * slope.max())
    shares = (np.ones(len(middle)), 1 / np.sqrt(square(middle)), (bend / slope + np.sqrt(twist / slope)) * leading[1])
    density = sum(share / share.sum() for share in shares if share.any())
    grown = np.append(0.0, np.cumsum(density))
    return np.interp(np.linspace(0.0, grown[-1], intervals + 1), grown, u)


def _timed(path: JointPath, limits: AxesLimits, knots: FloatArray, square: "scipy.interpolate.BSpline") -> PathMotion:
    """The motion of a spline, scaled in time until the tightest limit is just kept on the fine grid."""
    u = np.append(_at(knots, _FINE), _beside_nodes(path))
    used = [np.abs(one).max(axis=0) for one in _used(path.derivatives(u), limits, u, square)]
    slow = max(used[0].max(), np.sqrt(used[1].max()), np.cbrt(used[2].max()))
    square = scipy.interpolate.BSpline(square.t, square.c / slow**2, square.k)
    takes = _passing(square, knots[:-1], knots[1:])
    usage = np.stack([one / slow**power for power, one in enumerate(used, 1)])
    return PathMotion(path, limits, knots, np.append(0.0, np.cumsum(takes)), square, usage)


def _beside_nodes(path: JointPath) -> FloatArray:
    """U just before and after the inner nodes of a path, where its third derivative may jump."""
    share = (path.s[1:-1] - path.s[0]) / path.length
    low, high = np.zeros(len(share)), np.ones(len(share))
    for _ in range(50):
        middle = (low + high) / 2
        below = rise(middle)[0] < share
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return np.append(low, high)


def _passing(square: "scipy.interpolate.BSpline", low: FloatArray, high: FloatArray) -> FloatArray:
    """Times [s] from one u to another of the same interval, by Gauss's five points."""
    half = (high - low) / 2
    u = low[..., None] + half[..., None] * (1 + _GAUSS)
    return np.asarray(half * np.sum(_WEIGHT / np.sqrt(square(u)), axis=-1))


def _derivatives(square: "scipy.interpolate.BSpline", u: FloatArray) -> Three:
    """W and its first two derivatives by u."""
    w, first, second = (np.asarray(square(u, nu=order)) for order in range(3))
    return w, first, second


def _at(knots: FloatArray, share: FloatArray) -> FloatArray:
    """Points at shares of every interval."""
    return np.asarray((knots[:-1, None] + np.diff(knots)[:, None] * share).ravel())
