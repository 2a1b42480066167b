"""Functions that are smooth between knots: least upper bound and integral over a turn.

The curves of a cam are smooth within a segment and may jump from one to the next, so every search and every integral
goes piece by piece and takes the one-sided values at the knots.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ilmek.arrays import FloatArray

Function: TypeAlias = Callable[[FloatArray], FloatArray]

_INSIDE = 1e-13
"""How far inside its piece a one-sided value is taken [rad]: above an angle's rounding, below any slope's reach."""

_GRIDS = (257, 33, 33, 33, 33, 33)
"""Points of the first grid and of the zooms: the place is found to 1e-8 of the piece, the value to rounding."""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(40)


@dataclass(frozen=True, slots=True)
class Extremum:
    """An extreme value and the angle [rad] where it is taken."""

    at: float
    value: float


def supremum(function: Function, knots: FloatArray) -> Extremum:
    """Least upper bound of `function` over the pieces between consecutive knots.

    A grid finds the basin in each piece, zooming grids close in on the top; all pieces are searched at once.

    >>> supremum(np.sin, np.array([0.0, 1.0, 3.0])).value
    1.0
    """
    low, high = _inside(knots)
    row = np.arange(low.size)
    for count in _GRIDS:
        angle = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, count)
        value = function(angle)
        best = np.argmax(value, axis=1)
        low, high = angle[row, np.maximum(best - 1, 0)], angle[row, np.minimum(best + 1, count - 1)]
    piece = int(np.argmax(value[row, best]))
    place, top = float(angle[piece, best[piece]]), float(value[piece, best[piece]])
    knot = float(knots[np.argmin(np.abs(knots - place))])
    return Extremum(knot if abs(knot - place) < 2 * _INSIDE else place, top)


def infimum(function: Function, knots: FloatArray) -> Extremum:
    """Greatest lower bound of `function` over the pieces between consecutive knots."""
    found = supremum(lambda angle: -function(angle), knots)
    return Extremum(found.at, -found.value)


def integral(function: Function, knots: FloatArray) -> float:
    """Integral of `function` from the first knot to the last, by Gauss' rule with 40 points a piece."""
    low, high = _inside(knots)
    half = 0.5 * (high - low)
    value = function(0.5 * (low + high)[:, None] + half[:, None] * _NODES)
    return float(np.sum(half[:, None] * _WEIGHTS * value))


def crossing(function: Function, low: float, high: float) -> float:
    """The place [rad] where a function that rises from `low` to `high` passes 0; `low` where it never is below 0.

    high < low is allowed: the function then rises backwards.
    >>> crossing(lambda x: x**2 - 2.0, 0.0, 2.0) == 2.0**0.5
    True
    """
    for _ in range(11):
        place = np.linspace(low, high, 33)
        first = int(np.argmax(function(place) >= 0))
        low, high = float(place[max(first - 1, 0)]), float(place[first])
    return high


def _inside(knots: FloatArray) -> tuple[FloatArray, FloatArray]:
    low, high = knots[:-1] + _INSIDE, knots[1:] - _INSIDE
    real = high > low
    return low[real], high[real]
