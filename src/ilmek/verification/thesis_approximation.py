"""Thesis 2.1.1, 2.1.2: criteria of approximation and the determinant of interpolation, on small systems."""

from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.verification.claim import RESIDUAL, Claim, Computation, residual

Function: TypeAlias = Callable[[FloatArray], FloatArray]

POWERS: tuple[Function, ...] = (np.ones_like, lambda x: x, lambda x: x**2)
DEPENDENT: tuple[Function, ...] = (*POWERS[:2], lambda x: 2 - 3 * x)
EVEN: tuple[Function, ...] = (POWERS[0], POWERS[2])
"""A system whose determinant is 0 at x and -x too, not only where two points coincide."""

POINTS = np.array([-0.7, 0.2, 1.1])


def claims() -> tuple[Claim, ...]:
    """Eqs 2.1 to 2.22."""
    definition = "a definition: nothing follows from it"
    return (
        _open("2.1 to 2.3", "position, speed and acceleration as functions of the inputs", definition),
        _open("2.4, 2.5", "y = F(x),  y_m = F(x, c)", definition),
        _open("2.6, J1 and J2", "J1 = ∫ q [F(x,c) - F(x)]² dx,  J2 = max q |F(x,c) - F(x)|", definition),
        _equation(
            "2.7",
            "discrete: J1 = ∫ q [F(x,c) - F(x)]² dx",
            lambda: residual(_integral(_error), _integral(_bent_error)),
            "Eq 2.6 once more, which changes with the error between the points: J1 = Σ q(x_i) [...]², J2 = max_i",
            lambda: residual(np.sum(_error(POINTS) ** 2), np.sum(_bent_error(POINTS) ** 2)),
        ),
        _equation("2.8, text", "f_i = x^(i-1): Σ P_i f_i is a polynomial of degree n-1", _degree),
        _equation("2.9, 2.10", "f_1 ... f_n independent where D(x_1 ... x_n) is not 0 everywhere", _independence),
        _equation(
            "2.10 f., text",
            "D = 0 if x_i = x_k: a Chebyshev system, which interpolates",
            lambda: _interpolation(EVEN),
            "D = 0 only if x_i = x_k; as printed it holds for every system, also for 1, x², which fails at x and -x",
            lambda: _interpolation(POWERS[:2]),
        ),
        _open("2.11 to 2.22", "–", "the numbers jump from 2.10 to 2.23; a 2.11 is referred to and not printed"),
    )


def _equation(
    number: str, printed: str, compute: Computation, note: str = "", mended: Computation | None = None
) -> Claim:
    source = f"2.1.{1 if number == '2.7' else 2}, Eq {number}"
    return Claim("thesis", f"Eq {number}", printed, RESIDUAL, compute, source, note, mended=mended)


def _open(number: str, printed: str, reason: str) -> Claim:
    return Claim("thesis", f"Eqs {number}", printed, RESIDUAL, lambda: None, "2.1.1", reason)


def _error(x: FloatArray) -> FloatArray:
    """An error of approximation."""
    return np.asarray(0.3 * x - 0.1)


def _bent_error(x: FloatArray) -> FloatArray:
    """Another one, equal to it at the points."""
    return np.asarray(_error(x) + np.prod([x - point for point in POINTS], axis=0))


def _integral(error: Function) -> float:
    """J1 with q = 1, by Gauss' formula, which is exact for these polynomials."""
    at, weight = np.polynomial.legendre.leggauss(8)
    return float(weight @ error(at) ** 2)


def _degree() -> float:
    """Third difference of a sum of three powers, at equal steps."""
    values = sum(P * f(np.arange(5.0)) for P, f in zip((0.4, -1.3, 2.1), POWERS, strict=True))
    return float(np.max(np.abs(np.diff(values, 3))) / np.max(np.abs(values)))


def _matrix(system: Sequence[Function], points: FloatArray) -> FloatArray:
    return np.array([f(points) for f in system]).T


def _independence() -> float:
    """D of 1, x, x² is Vandermonde's product, that of a dependent system 0."""
    first, second, third = POINTS
    product = (second - first) * (third - first) * (third - second)
    independent = residual(np.linalg.det(_matrix(POWERS, POINTS)), product)
    dependent = float(np.linalg.det(_matrix(DEPENDENT, POINTS)))
    return max(independent, abs(dependent) / float(product))


def _interpolation(system: Sequence[Function]) -> float:
    """What the best polynomial of the system leaves of two values at the distinct points -0.5, 0.5."""
    points, values = np.array([-0.5, 0.5]), np.array([1.0, 2.0])
    matrix = _matrix(system, points)
    return residual(matrix @ np.linalg.lstsq(matrix, values, rcond=None)[0], values)
