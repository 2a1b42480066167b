"""Moving bars with round ends: their distance, and its minimum over the whole motion.

The minimum is found by bisection. If no point moves faster than V by a parameter, the distance over an interval of half
length e is at least f - V e, with f at its middle. Intervals whose bound is not below the present minimum by more than
the tolerance are dropped; the others are halved. The result is a distance that occurs, and no distance is smaller by
more than the tolerance. [derived from the bound V of the rate, the Lipschitz constant]
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Complex, Float, FloatArray
from ilmek.plane.outlines import between_segments
from ilmek.records import record

TOLERANCE, RELATIVE = 1e-6, 5e-3
"""Absolute [m] and relative tolerance of a least distance."""

PIECES, MOST = 16, 60_000
"""Initial number of intervals in each direction; maximum number of intervals, beyond which the tolerance grows."""


@dataclass(frozen=True, slots=True)
class LeastDistance:
    """A least distance.

    name   of the two bodies         value  [m], below 0 for overlap
    at     parameters s of the minimum, one for each arm concerned
    sure   tolerance: greatest excess over the true minimum [m]
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
    """Least distance of two sets of bars [m], at each position; `but`: a pair that is joined and left out."""
    a, b = (one.starts[:, :, None], one.ends[:, :, None]), (other.starts[:, None], other.ends[:, None])
    pairs = between_segments(*a, *b) - one.radii[:, None] - other.radii
    if but is not None:
        pairs[:, but[0], but[1]] = np.inf
    least: Float[np.ndarray, " n"] = np.min(pairs, axis=(1, 2))
    return least


def least(name: str, f: Callable[[FloatArray], FloatArray], speeds: tuple[float, ...]) -> LeastDistance:
    """The least value of f over the unit cube.

    f  points, one per row -> distances [m]      speeds  bounds of the rate of f by each parameter [m]

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
