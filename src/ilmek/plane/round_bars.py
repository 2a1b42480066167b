"""Bars with round ends that move: how far they stay apart, and the least distance over the whole motion.

A least distance is found by bisection: where no point moves faster than V by a parameter, the distance over an interval
of half length e is no less than f - V e, f that at its middle. Intervals that cannot go below the least distance found
so far by more than the tolerance are dropped; the others are halved. The result is a distance that occurs, and none is
less by more than the tolerance.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Complex, Float, FloatArray
from ilmek.plane.outlines import between
from ilmek.records import record

TOLERANCE, RELATIVE = 1e-6, 5e-3
"""Absolute [m] and relative tolerance of a least distance."""

PIECES, MOST = 16, 60_000
"""Intervals at first in each direction; intervals at most, after which the tolerance is not met."""


@dataclass(frozen=True, slots=True)
class LeastDistance:
    """A least distance.

    name   of what, from what        value  [m], below 0 where they overlap
    at     s there, one for each arm that matters
    sure   tolerance: how much less it might be at most [m]
    """

    name: str
    value: float
    at: tuple[float, ...]
    sure: float


@record
class RoundBars:
    """Bars with round ends: (positions, bars) ends [m], and the radii of each [m]."""

    starts: Complex[np.ndarray, "n bars"]
    ends: Complex[np.ndarray, "n bars"]
    radii: Float[np.ndarray, " bars"]


def apart(one: RoundBars, other: RoundBars, but: tuple[int, int] | None = None) -> Float[np.ndarray, " n"]:
    """Least distance of two sets of bars [m], at each position; `but` a pair of them that meets on purpose."""
    pairs = [
        between(np.stack([one.starts[:, i], one.ends[:, i]], -1), np.stack([other.starts[:, j], other.ends[:, j]], -1))
        - one.radii[i]
        - other.radii[j]
        for i in range(len(one.radii))
        for j in range(len(other.radii))
        if (i, j) != but
    ]
    least: Float[np.ndarray, " n"] = np.min(np.stack(pairs), axis=0)
    return least


def least(name: str, f: Callable[[FloatArray], FloatArray], speeds: tuple[float, ...]) -> LeastDistance:
    """The least value of f over the unit cube, whose points are its rows; f changes by speeds at most [m].

    >>> found = least("x", lambda at: np.abs(at[:, 0] - 0.3), (1.0,))
    >>> round(found.value, 5), round(found.at[0], 5), found.sure < 2e-6
    (0.0, 0.3, True)
    """
    bound, size = np.array(speeds), len(speeds)
    grid = np.meshgrid(*[(np.arange(PIECES) + 0.5) / PIECES] * size, indexing="ij")
    middles, half = np.stack([axis.ravel() for axis in grid], axis=-1), 0.5 / PIECES
    corners = np.stack([axis.ravel() for axis in np.meshgrid(*[np.array([0.0, 1.0])] * size, indexing="ij")], axis=-1)
    value, at, spent = np.inf, middles[0], 0
    for points in (corners, middles):
        values = f(points)
        if np.min(values) < value:
            value, at = float(np.min(values)), points[np.argmin(values)]
    while True:
        lows = values - half * float(np.sum(bound))
        tolerance = TOLERANCE + RELATIVE * abs(value)
        kept = lows < value - tolerance
        spent += len(middles)
        if not kept.any() or spent > MOST:
            sure = max(value - float(np.min(lows)), tolerance)
            return LeastDistance(name, value, tuple(float(one) for one in at), sure)
        half /= 2
        middles = (middles[kept][:, None, :] + half * (2 * corners - 1)).reshape(-1, size)
        values = f(middles)
        if np.min(values) < value:
            value, at = float(np.min(values)), middles[np.argmin(values)]
