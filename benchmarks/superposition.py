"""Two-link arms by the method of superposition of the papers, in corrected form: a cross-check of `dyad`.

Products of unknowns are treated as further unknowns lam, so that the equations of the points are linear. The parameters
are combined from the solutions for each right side, P = l + lam1 m + lam2 n; the conditions lam = product remain.

The method contains divisions that `dyad` does not have. It fails where its matrix is singular (all points at the same
distance from the origin) or n5 = 0; the error names the method to use instead. Its only purpose is the comparison: both
methods agree to 1e-9.
"""

import numpy as np
import scipy
from numpy.polynomial import Polynomial

from ilmek.arrays import Complex, ComplexArray, Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.plane.vectors import dot
from ilmek.synthesis.dyad import TwoLinkArm

SINGULAR = 1e-11
"""Ratio of the smallest to the largest singular value, or of a divisor to its neighbours, that counts as 0."""

REAL = 1e-6
"""Imaginary part of a root, relative to its magnitude or 1, below which it counts as real."""


def superposed_through_points(
    points: Complex[np.ndarray, "4"], first_angles: Float[np.ndarray, "4"]
) -> tuple[TwoLinkArm, ...]:
    """All arms through four points with given angles of the first link, by two virtual parameters; sorted by `first`.

    points  [m], complex      first_angles  [rad]

        P0 f0 + P1 f1 + P4 f4 + P5 f5 = F - 2 lam1 f2 - 2 lam2 f3,    lam1 = P1 P4, lam2 = P1 P5
        f = 1, rho^2, -x, -y, cos th1, sin th1,    F = x cos th1 + y sin th1
        a1 = 1 / (2 P1),    O = P4 + i P5,    a2^2 = |O|^2 + a1^2 - 2 a1 P0

    Corrected misprints. Eqs 2.26, 2.27: the right side has the opposite sign (it is squared). 2.32: the product of the
    two brackets, not their sum. 2.34 equals 2.35 except for a factor of -2 a1. Text below 2.37: P2 = 2 lam1,
    P3 = 2 lam2; then 2.38 to 2.42 hold, with -1, not -1/2, in 2.43, 2.44 and A3, and n4 / n5, not n4 / (2 n5), in A4.
    As printed, a2 differs from point to point. The coefficient of lam1^4 is zero: three solutions, one or three real.

    Raises ParameterError where the method fails.                                                [thesis 2.36 to 2.46]

    >>> th1, th2 = np.radians([[10, 25, 45, 60], [80, 75, 40, 20]])
    >>> arms = superposed_through_points(1 + 1j + 2 * np.exp(1j * th1) + 1.5 * np.exp(1j * th2), th1)
    >>> [round(arm.second, 9) for arm in arms if abs(arm.first - 2) < 1e-9]
    [1.5]
    """
    size = _size(points, first_angles)
    p, u = points / size, np.exp(1j * first_angles)
    f = np.stack([np.ones(4), np.abs(p) ** 2, u.real, u.imag], axis=-1)
    ell, m, n = _superposed(f, np.asarray(dot(p, u)), 2 * p.real, 2 * p.imag)
    (_, l1, l4, l5), (_, m1, m4, m5), (_, n1, n4, n5) = ell, m, n
    if abs(n5) <= SINGULAR * max(abs(n4), abs(m5), 1.0):
        raise _breakdown("n5 = 0, the divisor of eqs 2.45 and 2.46", "dyads_through_points")
    share = n4 / n5
    A1, A2 = m1 * m4 - m1 * m5 * share, m4 * n1 - m5 * n1 * share
    A3 = l4 * m1 + l1 * m4 - (l5 * m1 + l1 * m5) * share - 1
    A4, A5 = l4 * n1 + share - l5 * n1 * share, l1 * l4 - l1 * l5 * share
    lam, below, above = (
        Polynomial([0, 1]),
        Polynomial([A4, A2]),
        -Polynomial([A5, A3, A1]),
    )  # 2.46: lam2 = above / below
    whole = (
        (m1 * m4 * lam**2 + (l1 * m4 + l4 * m1 - 1) * lam + l1 * l4) * below**2
        + ((m1 * n4 + m4 * n1) * lam + (l1 * n4 + l4 * n1)) * below * above
        + n1 * n4 * above**2
    )
    found = []
    for root in _real_roots(whole.coef[:4]):
        lam1, lam2 = _refined(np.array([root, float(above(root) / below(root))]), ell, m, n)
        P0, P1, P4, P5 = ell + lam1 * m + lam2 * n
        first, pivot = 1 / (2 * P1), complex(P4, P5)
        second = np.sqrt(abs(pivot) ** 2 + first**2 - 2 * first * P0)
        found.append(TwoLinkArm(pivot * size, abs(pivot) * size, float(first) * size, float(second) * size))
    return tuple(sorted(found, key=lambda arm: arm.first))


def superposed_through_poses(
    points: Complex[np.ndarray, "3"], second_angles: Float[np.ndarray, "3"], ground_angle: float
) -> tuple[TwoLinkArm, ...]:
    """All arms through three poses with the pivot on the ray of `ground_angle`, by one virtual parameter.

    points  [m], complex      second_angles, ground_angle  [rad]

        P1 + P2 f2 + P3 f3 = F - lam f4,    lam = P2 P3
        f2 = 2 p · e0,    f3 = 2 p · e2,    f4 = -rho^2,    F = 2 cos(th2 - th0)
        a2 = 1 / P2,    a0 = 1 / P3,    a1^2 = P1 a0 a2 + a0^2 + a2^2

    Corrected misprints. The argument of the cosine in F is the difference of the angles. The right side of m is
    +rho^2; the report inserts -rho^2 (+849.955 and +900.96 for -850 and -901), a sign error that affects all later
    numbers. The link-by-link difference of the two results has no meaning: each result is an arm, and both together
    form a four-bar (`dyad.four_bar`).

    Sorted by `ground`. Raises ParameterError where the method fails.                            [knotting report, 2]
    """
    size = _size(points, second_angles)
    p, e0, e2 = points / size, np.exp(1j * ground_angle), np.exp(1j * second_angles)
    f = np.stack([np.ones(3), 2 * np.asarray(dot(p, e0)), 2 * np.asarray(dot(p, e2))], axis=-1)
    ell, m = _superposed(f, 2 * np.asarray(dot(e2, e0)), np.abs(p) ** 2)
    found = []
    for lam in _real_roots(np.array([ell[1] * ell[2], ell[1] * m[2] + ell[2] * m[1] - 1, m[1] * m[2]])):
        P1, P2, P3 = ell + lam * m
        ground, second = 1 / P3, 1 / P2
        first = np.sqrt(P1 * ground * second + ground**2 + second**2)
        found.append(
            TwoLinkArm(complex(ground * e0) * size, float(ground) * size, float(first) * size, float(second) * size)
        )
    return tuple(sorted(found, key=lambda arm: arm.ground))


def _superposed(matrix: FloatArray, *right: FloatArray) -> list[FloatArray]:
    """Solutions for each right side, by one factorisation; raises ParameterError for a singular matrix."""
    singular = np.linalg.svd(matrix, compute_uv=False)
    if singular[-1] <= SINGULAR * singular[0]:
        raise _breakdown("the matrix of eq. 2.40 is singular", "dyads_through_points or dyads_through_poses")
    factors = scipy.linalg.lu_factor(matrix)
    return [np.asarray(scipy.linalg.lu_solve(factors, side)) for side in right]


def _refined(lam: FloatArray, ell: FloatArray, m: FloatArray, n: FloatArray) -> FloatArray:
    """Newton's method on 2.41 and 2.42; the elimination loses digits."""
    columns = np.stack([m, n], axis=-1)
    for _ in range(3):
        P = ell + columns @ lam
        residual = lam - P[1] * P[2:]
        slopes = np.eye(2) - P[1] * columns[2:] - np.outer(P[2:], columns[1])
        if abs(np.linalg.det(slopes)) <= SINGULAR:
            break
        lam = lam - np.linalg.solve(slopes, residual)
    return lam


def _real_roots(coefficients: FloatArray) -> list[float]:
    """Real roots of a polynomial, constant term first; leading coefficients at the level of rounding are left out."""
    size = float(np.max(np.abs(coefficients)))
    many = int(np.max(np.flatnonzero(np.abs(coefficients) > SINGULAR * size), initial=0))
    roots = np.asarray(np.polynomial.polynomial.polyroots(coefficients[: many + 1]))
    return [float(root.real) for root in roots if abs(root.imag) <= REAL * max(1.0, abs(root))]


def _size(points: ComplexArray, angles: FloatArray) -> float:
    """Greatest distance of the points from the origin [m]; the method depends on the origin, so it is not shifted."""
    if not (np.isfinite(points).all() and np.isfinite(angles).all()) or np.max(np.abs(points)) == 0:
        raise ParameterError("a point of the arm is not finite, or all are the origin", do="give finite points")
    return float(np.max(np.abs(points)))


def _breakdown(why: str, instead: str) -> ParameterError:
    return ParameterError(f"superposition fails: {why}", do=f"use {instead} for the same task")
