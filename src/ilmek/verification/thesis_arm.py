"""A planted two-link arm, and the residuals of the thesis' equations on it [thesis 2.1.3].

Symbols as in the thesis: P0 .. P5 the construction parameters, f0 .. f5 and F the given ones, l, m, n the solutions of
the three linear systems, lam1 = P1 P4 and lam2 = P1 P5.
"""

from functools import cache
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.polynomial import Polynomial

from ilmek.arrays import ComplexArray, Float, FloatArray
from ilmek.synthesis.dyad import TwoLinkArm
from ilmek.verification.claim import residual

Six: TypeAlias = Float[np.ndarray, "6"]

TH1 = np.array([0.3, 1.1, 2.0, 2.6])
TH2 = np.array([-0.4, 0.5, 1.9, 3.3])
ARM = TwoLinkArm(pivot=0.31 - 0.52j, ground=abs(0.31 - 0.52j), first=0.83, second=0.57)
POINTS = ARM.end_position(TH1, TH2)

HALF_TOO_MUCH, WHOLE = 0.5, 1.0
"""The subtrahends of the coefficients of lam1 and lam2 in Eqs 2.43 and 2.44: as printed, and correct."""


class Superposition(NamedTuple):
    """The planted arm in the thesis' terms; f by number and point; l (here L), m, n by the number of their P."""

    P: Six
    f: Float[np.ndarray, "6 4"]
    F: Float[np.ndarray, "4"]
    L: Six
    m: Six
    n: Six
    lam1: float
    lam2: float


class EliminatedCoefficients(NamedTuple):
    """Coefficients of Eq 2.45."""

    A1: float
    A2: float
    A3: float
    A4: float
    A5: float


@cache
def planted() -> Superposition:
    """P, f, F of the planted arm and the solutions of the three systems, Eqs 2.39 and 2.40."""
    a1, pivot = ARM.first, ARM.pivot
    pivot_xy = [pivot.real, pivot.imag]
    P = np.array(
        [(ARM.ground**2 + a1**2 - ARM.second**2) / (2 * a1), 1 / (2 * a1), *(x / a1 for x in pivot_xy), *pivot_xy]
    )
    rho = np.abs(POINTS)
    f = np.array([np.ones(4), rho**2, -POINTS.real, -POINTS.imag, np.cos(TH1), np.sin(TH1)])
    F = np.asarray(rho * np.cos(np.angle(POINTS) - TH1))
    kept = [0, 1, 4, 5]
    solutions = np.zeros((3, 6))
    solutions[:, kept] = np.linalg.solve(f[kept].T, np.array([F, -2 * f[2], -2 * f[3]]).T).T
    L, m, n = solutions
    return Superposition(P, f, F, L, m, n, float(P[1] * P[4]), float(P[1] * P[5]))


def first() -> ComplexArray:
    """The first link at the four points, complex."""
    return np.asarray(ARM.first * np.exp(1j * TH1))


def second() -> ComplexArray:
    """The second link at the four points, complex."""
    return np.asarray(ARM.second * np.exp(1j * TH2))


def remainder() -> ComplexArray:
    """The remainder for the second link: rho - a0 - a1."""
    return np.asarray(POINTS - ARM.pivot - first())


def eq_2_24() -> float:
    """Residual of the loop, Eqs 2.24 and 2.25, whose points come from it: of its polar writing."""
    rho, alpha, th0 = np.abs(POINTS), np.angle(POINTS), np.angle(ARM.pivot)
    return residual(rho * np.exp(1j * alpha), ARM.ground * np.exp(1j * th0) + first() + second())


def a2_squared() -> FloatArray:
    """The right side of Eq 2.28, term by term."""
    rho, alpha, th0 = np.abs(POINTS), np.angle(POINTS), np.angle(ARM.pivot)
    a0, a1 = ARM.ground, ARM.first
    squares = rho**2 + a0**2 + a1**2
    mixed = 2 * a0 * a1 * np.cos(TH1 - th0) - 2 * a0 * rho * np.cos(alpha - th0)
    return np.asarray(squares + mixed - 2 * a1 * rho * np.cos(alpha - TH1))


def objective(a2: FloatArray | float) -> FloatArray:
    """The left side of Eq 2.35 for the arm with another second link, at the first point."""
    known = planted()
    P0 = (ARM.ground**2 + ARM.first**2 - np.asarray(a2) ** 2) / (2 * ARM.first)
    return np.asarray(P0 + known.P[1:] @ known.f[1:, 0] - known.F[0])


def eq_2_36() -> float:
    """Residual of the objective function in P and f."""
    known = planted()
    return residual(known.P @ known.f, known.F)


def eq_2_37() -> float:
    """Residual of the two products among P."""
    P = planted().P
    return residual(P[[2, 3]], 2 * P[1] * P[[4, 5]])


def against_lambda(factor: float) -> float:
    """Residual of P2, P3 = factor lam1, lam2."""
    known = planted()
    return residual(known.P[[2, 3]], factor * np.array([known.lam1, known.lam2]))


def eq_2_38() -> float:
    """Residual of the superposed objective function."""
    known = planted()
    kept = [0, 1, 4, 5]
    right = known.F - 2 * known.lam1 * known.f[2] - 2 * known.lam2 * known.f[3]
    return residual(superposed()[kept] @ known.f[kept], right)


def eq_2_40() -> float:
    """Residual of P = l + lam1 m + lam2 n."""
    kept = [0, 1, 4, 5]
    return residual(superposed()[kept], planted().P[kept])


def eq_2_41() -> float:
    """Residual of lam1 = P1 P4, lam2 = P1 P5 with P superposed."""
    known, P = planted(), superposed()
    return residual(np.array([known.lam1, known.lam2]), P[1] * P[[4, 5]])


def superposed() -> Six:
    """The construction parameters l + lam1 m + lam2 n."""
    known = planted()
    return np.asarray(known.L + known.lam1 * known.m + known.lam2 * known.n)


def conic(k: int, lam1: float, lam2: float, less: float) -> Six:
    """The terms of Eq 2.43 (k = 4) or 2.44 (k = 5); `less` is subtracted from the coefficient of lam1 or lam2."""
    _, _, _, L, m, n, _, _ = planted()
    return np.array(
        [
            lam1**2 * m[1] * m[k],
            lam2**2 * n[1] * n[k],
            lam1 * lam2 * (m[1] * n[k] + m[k] * n[1]),
            lam1 * (L[1] * m[k] + L[k] * m[1] - less * (k == 4)),
            lam2 * (L[1] * n[k] + L[k] * n[1] - less * (k == 5)),
            L[1] * L[k],
        ]
    )


def eq_2_43(k: int, less: float) -> float:
    """Residual of Eq 2.43 (k = 4) or 2.44 (k = 5) at the planted arm."""
    known = planted()
    terms = conic(k, known.lam1, known.lam2, less)
    return float(abs(np.sum(terms)) / np.max(np.abs(terms)))


def eliminated(less: float) -> EliminatedCoefficients:
    """A1 .. A5; `less` is 1/2 as printed."""
    _, _, _, L, m, n, _, _ = planted()
    part = n[4] / n[5]
    return EliminatedCoefficients(
        A1=float(m[1] * m[4] - m[1] * m[5] * part),
        A2=float(m[4] * n[1] - m[5] * n[1] * part),
        A3=float(L[4] * m[1] + L[1] * m[4] - L[5] * m[1] * part - L[1] * m[5] * part - less),
        A4=float(L[4] * n[1] + less * part - L[5] * n[1] * part),
        A5=float(L[1] * L[4] - L[1] * L[5] * part),
    )


def eq_2_45() -> float:
    """Residual of the elimination itself, as printed: Eq 2.45 = Eq 2.43 - n4/n5 Eq 2.44 whatever lam1, lam2 are."""
    A, n = eliminated(HALF_TOO_MUCH), planted().n
    lam1, lam2 = 0.7, -1.3
    left = A.A1 * lam1**2 + A.A2 * lam1 * lam2 + A.A3 * lam1 + A.A4 * lam2 + A.A5
    conics = [float(np.sum(conic(k, lam1, lam2, HALF_TOO_MUCH))) for k in (4, 5)]
    return residual(left, conics[0] - float(n[4] / n[5]) * conics[1])


def eq_2_46(less: float) -> float:
    """Residual of lam2 from lam1."""
    A, known = eliminated(less), planted()
    found = -(A.A1 * known.lam1**2 + A.A3 * known.lam1 + A.A5) / (A.A4 + A.A2 * known.lam1)
    return residual(found, known.lam2)


def resolvent() -> Polynomial:
    """Eq 2.43 times (A4 + A2 lam1)² with lam2 from Eq 2.46, in lam1; coefficients that vanish are still there."""
    A = eliminated(WHOLE)
    _, _, _, L, m, n, _, _ = planted()
    x = Polynomial([0.0, 1.0])
    top, under = -Polynomial([A.A5, A.A3, A.A1]), Polynomial([A.A4, A.A2])
    squares = m[1] * m[4] * x**2 * under**2 + n[1] * n[4] * top**2 + (m[1] * n[4] + m[4] * n[1]) * x * top * under
    linear = (L[1] * m[4] + L[4] * m[1] - WHOLE) * x * under**2 + (L[1] * n[4] + L[4] * n[1]) * top * under
    whole: Polynomial = squares + linear + L[1] * L[4] * under**2
    return whole


def quartic() -> float:
    """Size of the coefficient of lam1⁴, relative to its own terms."""
    A = eliminated(WHOLE)
    _, _, _, _, m, n, _, _ = planted()
    terms = m[1] * m[4] * A.A2**2, n[1] * n[4] * A.A1**2, -(m[1] * n[4] + m[4] * n[1]) * A.A1 * A.A2
    return float(abs(sum(terms)) / max(abs(term) for term in terms))


def solutions() -> int:
    """The number of roots lam1 of the resolvent: its degree without vanishing coefficients."""
    coefficients = np.abs(resolvent().coef)
    return int(np.flatnonzero(coefficients > 1e-9 * np.max(coefficients))[-1])
