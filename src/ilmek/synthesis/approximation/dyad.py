"""Approximate synthesis of two-link arms for many timed points.

    delta_i = |p_i - O - a1 e^{i th1_i}| - a2

The first link has its given angle, the second is free: delta is the distance between its end and the point. Expanded,
|p - O - a1 u|^2 - a2^2 is a synthesis polynomial in K = |O|^2 + a1^2 - a2^2, X, Y and a1 with the products a1 X and
a1 Y,

    K - 2 x X - 2 y Y - 2 a1 p·u + 2 a1 (X cos th1 + Y sin th1) = -|p|^2

All its stationary solutions are known; each is the start of a descent on delta itself. With four points this is exact
synthesis: `dyad.dyads_through_points`.                                           [thesis 2.28, 2.31; the rest derived]
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import ComplexArray, Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.plane.vectors import dot
from ilmek.synthesis.approximation.exchange import PROVEN, minimax_descent
from ilmek.synthesis.approximation.least_squares import squares_descent
from ilmek.synthesis.approximation.polynomial import (
    SynthesisPolynomial,
    interpolation,
    least_squares,
    minimax,
    of_table,
)
from ilmek.synthesis.dyad import TwoLinkArm
from ilmek.synthesis.task import require_angles

CRITERIA = ("interpolation", "least squares", "minimax")
"""Criteria of `dyads_along`."""

FAR = 1e3
"""Link or distance of the pivot, in sizes of the path, beyond which a search diverges."""

SAME = 1e-5
"""Difference of two arms, in sizes of the path, below which they count as the same."""

ZERO_ERROR = 1e-13
"""Error, in sizes of the path, that counts as 0."""


class DyadApproximation(NamedTuple):
    """An arm and its errors.

    dyad    pivot and links [m]; a negative first link points opposite to its angle
    errors  delta at each point [m], positive outwards
    worst   greatest magnitude [m]      rms  root mean square [m]
    bound   minimax only: lower bound of `worst` for small changes of pivot and links [m]; otherwise NaN
    gap     remaining optimality gap, as in `polynomial.Approximation`
    """

    dyad: TwoLinkArm
    errors: Float[np.ndarray, " points"]
    worst: float
    rms: float
    bound: float
    gap: float

    @property
    def proven(self) -> bool:
        """Whether it is a local optimum of its criterion, except for rounding."""
        return self.gap <= PROVEN


class DyadApproximations(NamedTuple):
    """Arms, the best by the criterion first; and descriptions of what was left out."""

    found: tuple[DyadApproximation, ...]
    left_out: tuple[str, ...]


def dyads_along(points: ComplexArray, first_angles: FloatArray, criterion: str = "minimax") -> DyadApproximations:
    """All local optima found of arms for timed points, the best first.

    points        [m], complex, shape (points,): four or more for interpolation, five or more for the other criteria
    first_angles  angles of the first link at the points [rad], shape (points,)
    criterion     "interpolation": four of the points, spaced as Chebyshev nodes, are met exactly;
                  "least squares" or "minimax" of delta at all points

    A first link of length 0 means that the points lie near a circle about the pivot, as in `dyads_through_points`.
    Raises ParameterError for another criterion, too few points, values that are not finite, angles in degrees, and
    points and angles with a family of solutions.

    >>> th1, th2 = np.radians([[10, 25, 45, 60, 80, 95], [80, 75, 40, 20, 15, 5]])
    >>> along = 1 + 1j + 2 * np.exp(1j * th1) + 1.5 * np.exp(1j * th2)
    >>> best = dyads_along(along, th1).found[0]
    >>> complex(np.round(best.dyad.pivot, 9)), round(best.dyad.first, 9), round(best.dyad.second, 9), best.worst < 1e-9
    ((1+1j), 2.0, 1.5, True)
    """
    _check(points, first_angles, criterion)
    centre = complex(np.mean(points))
    size = float(np.max(np.abs(points - centre)))
    p, u = (points - centre) / size, np.exp(1j * first_angles)
    starts, left_out = _starts(p, u, criterion)
    approximations: list[DyadApproximation] = []
    for start in starts:
        end, bound, gap = _descent(p, u, criterion, start)
        if not np.max(np.abs(end)) <= FAR:
            left_out.append(f"an arm that diverges: beyond {FAR:g} sizes of the path")
            continue
        errors = size * _deviations(p, u, end)[0]
        dyad = _dyad(end, centre, size)
        if all(_apart(dyad, other.dyad) > SAME * size for other in approximations):
            rms, worst = float(np.sqrt(np.mean(errors**2))), float(np.max(np.abs(errors)))
            approximations.append(DyadApproximation(dyad, errors, worst, rms, size * bound, gap))
    proven = [approximation for approximation in approximations if approximation.proven]
    if len(proven) < len(approximations):
        left_out.append("a search that does not converge")
    ranked = sorted(proven or approximations, key=lambda one: one.rms if criterion == "least squares" else one.worst)
    return DyadApproximations(tuple(ranked), tuple(dict.fromkeys(left_out)))


def design_polynomial(points: ComplexArray, directions: ComplexArray) -> SynthesisPolynomial:
    """The synthesis polynomial of an arm in K, X, Y, a1; its x are the indices of the points.

    points  [m], complex      directions  unit vectors of the first link
    """
    terms = np.stack([np.ones(len(points)), -2 * points.real, -2 * points.imag, -2 * dot(points, directions)], axis=-1)
    products = np.stack([2 * directions.real, 2 * directions.imag], axis=-1)
    return of_table(terms, -np.asarray(dot(points, points)), ((3, 1), (3, 2)), products)


def _starts(p: ComplexArray, u: ComplexArray, criterion: str) -> tuple[list[FloatArray], list[str]]:
    """X, Y, a1, a2 of all solutions of the synthesis polynomial, and descriptions of what was left out."""
    polynomial, points = design_polynomial(p, u), np.arange(float(len(p)))
    if criterion == "interpolation":
        nodes = np.round(0.5 * (len(p) - 1) * (1 - np.cos((2 * np.arange(4) + 1) * np.pi / 8)))
        answers, words = interpolation(polynomial, nodes, points)
    else:
        answers, words = (minimax if criterion == "minimax" else least_squares)(polynomial, points)
        if criterion == "minimax":
            answers += least_squares(polynomial, points).found
    left_out, starts = list(words), []
    for answer in answers:
        K, x, y, first = answer.parameters
        square = x * x + y * y + first * first - K
        if criterion == "interpolation" and square <= 0:
            left_out.append("an arm whose second link has no real length")
        else:
            starts.append(np.array([x, y, first, np.sqrt(max(square, 1e-6))]))
    return starts, left_out


def _deviations(p: ComplexArray, u: ComplexArray, arm: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Values of delta at each point [m], and its derivatives by X, Y, a1, a2."""
    offset = p - complex(arm[0], arm[1]) - arm[2] * u
    length = np.abs(offset)
    along = offset / np.where(length > 0, length, 1.0)
    slopes = np.stack([-along.real, -along.imag, -np.asarray(dot(along, u)), -np.ones(len(p))], axis=-1)
    return length - arm[3], slopes


def _descent(p: ComplexArray, u: ComplexArray, criterion: str, start: FloatArray) -> tuple[FloatArray, float, float]:
    """The best arm near a start, its bound and its gap."""

    def errors(arm: FloatArray, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        at = x.astype(int)
        return _deviations(p[at], u[at], arm)

    points = np.arange(float(len(p)))
    if criterion == "interpolation":
        return start, np.nan, 0.0
    squares = squares_descent(errors, start, points)
    if criterion == "least squares":
        return squares.parameters, np.nan, squares.slope if squares.squares > ZERO_ERROR**2 else 0.0
    ends = [minimax_descent(errors, begin, points, least=ZERO_ERROR) for begin in (start, squares.parameters)]
    best = min(ends, key=lambda end: (end.gap > PROVEN, end.worst))
    return best.parameters, best.level, best.gap if best.worst > ZERO_ERROR else 0.0


def _dyad(arm: FloatArray, centre: complex, size: float) -> TwoLinkArm:
    pivot = centre + size * complex(arm[0], arm[1])
    sign = -1.0 if arm[3] < 0 else 1.0
    return TwoLinkArm(pivot, abs(pivot), size * float(arm[2]), sign * size * float(arm[3]))


def _apart(one: TwoLinkArm, other: TwoLinkArm) -> float:
    return max(abs(one.pivot - other.pivot), abs(one.first - other.first), abs(one.second - other.second))


def _check(points: ComplexArray, first_angles: FloatArray, criterion: str) -> None:
    if criterion not in CRITERIA:
        raise ParameterError(f"criterion {criterion!r} of an arm's approximation", allowed=", ".join(CRITERIA))
    if points.ndim != 1 or points.shape != first_angles.shape:
        given = f"{points.size} points and {first_angles.size} angles of the first link"
        raise ParameterError(given, allowed="one angle for each point")
    needed = 4 if criterion == "interpolation" else 5
    if len(points) < needed:
        more = "use `dyads_through_points` for four points" if len(points) == 4 else "give more points"
        raise ParameterError(f"{len(points)} timed points for {criterion}", allowed=f"{needed} or more", do=more)
    if not np.isfinite(points).all():
        raise ParameterError("a timed point is not finite", do="give finite points [m]")
    require_angles("first link's angle", first_angles)
    if np.max(np.abs(points - points[0])) == 0:
        raise ParameterError("all timed points are the same", do="give different points")
