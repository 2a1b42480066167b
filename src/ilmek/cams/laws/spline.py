"""Spline through points: polynomials of degree 3, 5 or 7 with all derivatives but the last continuous.

    s(u_i) = s_i,     s^(k) continuous, k < degree;     the first (degree - 1)/2 derivatives given at both ends

Degree 3 is C2 (the jerk steps at the points), degree 5 is C4, degree 7 is C6. Each piece is the Hermite polynomial of
the derivatives 1..m, m = (degree - 1)/2, at its two ends; those at the inner points are the unknowns. Continuity of
the derivatives m + 1..2m there is the linear system for them.              [de Boor, A Practical Guide to Splines]
"""

import itertools
import math
from collections.abc import Sequence
from functools import cache

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.laws.law import Law, LawFamily
from ilmek.cams.laws.piecewise import Piecewise, law_of_pieces
from ilmek.cams.laws.polynomial import Condition, solved
from ilmek.errors import ParameterError

DEGREES = (3, 5, 7)
MOST = 400
"""Largest number of inner points."""


def law(
    u: Sequence[float], s: Sequence[float], start: Sequence[float], end: Sequence[float], degree: float = 5.0
) -> Law:
    """The spline from (0, 0) through the points (u, s) to (1, 1).

    u, s         inner points, u ascending in (0, 1), of one length, up to 400
    start, end   s', s'', s''' at the ends [-], at most (degree - 1)/2 of them; default: 0
    degree       3, 5 or 7
    Raises ParameterError for points that do not ascend, too many points or end values, and another degree.

    >>> round(float(law((0.5,), (0.5,), (), (), 3).s(0.25)), 6)
    0.15625
    """
    m = _order(degree)
    knots, values = _points(u, s)
    ends = _end_values(start, m), _end_values(end, m)
    rows = pieces(knots, values, ends)
    given: dict[str, float | tuple[float, ...]] = {
        "u": tuple(map(float, u)),
        "s": tuple(map(float, s)),
        "start": tuple(map(float, start)),
        "end": tuple(map(float, end)),
        "degree": float(degree),
    }
    return law_of_pieces("spline", Piecewise(knots, rows), given)


FAMILY = LawFamily(law, {"u": (0.25, 0.5, 0.75), "s": (0.1, 0.5, 0.9), "start": (), "end": (), "degree": 5.0})


def pieces(knots: FloatArray, values: FloatArray, ends: tuple[FloatArray, FloatArray]) -> FloatArray:
    """Coefficients of each piece by its own t in [0, 1], the constant first, (pieces, 2m + 2).

    knots, values  points of the spline, (points,)      ends  derivatives 1..m at both ends, (m,) each
    """
    m, count = ends[0].size, knots.size
    unknown = np.zeros((count, m))
    unknown[0], unknown[-1] = ends
    hermite = _hermite(m)
    lengths = np.diff(knots)
    if count > 2:
        unknown[1:-1] = _inner(hermite, values, lengths, unknown)
    return _rows(hermite, values, lengths, unknown)


@cache
def _hermite(m: int) -> FloatArray:
    """Coefficients of the polynomials for each of s..s^(m) at t = 0, then at t = 1: (2m + 2) x (2m + 2)."""
    spots = [(at, order) for at in (0.0, 1.0) for order in range(m + 1)]
    return np.array([solved([Condition(*spot, float(spot == one)) for spot in spots]) for one in spots])


def _rows(hermite: FloatArray, values: FloatArray, lengths: FloatArray, slopes: FloatArray) -> FloatArray:
    m = slopes.shape[1]
    scale = lengths[:, None] ** np.arange(m + 1)
    all_values = np.column_stack([values, slopes])
    return np.asarray(np.hstack([all_values[:-1] * scale, all_values[1:] * scale]) @ hermite)


def _inner(hermite: FloatArray, values: FloatArray, lengths: FloatArray, known: FloatArray) -> FloatArray:
    """Derivatives 1..m at the inner points: they make the derivatives m + 1..2m continuous.

    The steps are linear in the unknowns; a unit of each unknown gives a column. A point's unknowns change the steps at
    itself and its two neighbours only, so every third point is probed at once.
    """
    m, inner = known.shape[1], known.shape[0] - 2

    def steps(slopes: FloatArray, at: FloatArray) -> FloatArray:
        rows = _rows(hermite, at, lengths, slopes)
        orders = range(m + 1, 2 * m + 1)
        after = np.column_stack([math.factorial(k) * rows[1:, k] / lengths[1:] ** k for k in orders])
        powers = np.arange(rows.shape[1])
        falling = np.array([[math.perm(int(p), k) for p in powers] for k in orders])
        before = rows[:-1] @ falling.T / lengths[:-1, None] ** np.array(orders)
        return np.asarray(after - before)

    matrix = np.zeros((inner, m, inner, m))
    nothing = np.zeros(values.shape)
    for first, order in itertools.product(range(min(3, inner)), range(m)):
        probe = np.zeros(known.shape)
        probe[1 + first : -1 : 3, order] = 1.0
        found = steps(probe, nothing)
        for point in range(first, inner, 3):
            near = slice(max(point - 1, 0), point + 2)
            matrix[near, :, point, order] = found[near]
    right = -steps(known, values)
    size = inner * m
    return np.linalg.solve(matrix.reshape(size, size), right.reshape(size)).reshape(inner, m)


def _order(degree: float) -> int:
    if degree not in DEGREES:
        raise ParameterError(f"spline with degree={degree:g}", allowed="3, 5 or 7")
    return (int(degree) - 1) // 2


def _points(u: Sequence[float], s: Sequence[float]) -> tuple[FloatArray, FloatArray]:
    if len(u) != len(s) or len(u) > MOST:
        raise ParameterError(f"spline: {len(u)} points u, {len(s)} values s", allowed=f"equal numbers, up to {MOST}")
    knots, values = np.array([0.0, *u, 1.0]), np.array([0.0, *s, 1.0])
    if not (np.all(np.isfinite(values)) and np.all(np.diff(knots) > 0)):
        shown = ", ".join(f"{at:g}" for at in u)
        raise ParameterError(f"spline: u = {shown}", allowed="ascending between 0 and 1, with finite s")
    return knots, values


def _end_values(given: Sequence[float], m: int) -> FloatArray:
    if len(given) > m:
        most = ["s'", "s''", "s'''"][:m]
        raise ParameterError(f"spline: {len(given)} values at an end", allowed=f"for this degree {', '.join(most)}")
    return np.array([*map(float, given), *[0.0] * (m - len(given))])
