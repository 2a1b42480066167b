"""Thesis 2.1.3: the equations of the two-link arm through four timed points, tested on a known arm.

The thesis mixes two choices of lam1, lam2. With lam1 = P1 P4 and lam2 = P1 P5 its Eqs 2.38 to 2.42 are right as
printed; the 1/2 of the later ones belongs to lam1 = P2, lam2 = P3.
"""

from functools import partial

import numpy as np

from ilmek.verification import thesis_arm as arm
from ilmek.verification.claim import COUNT, Claim, equation, residual
from ilmek.verification.thesis_arm import HALF_TOO_MUCH, WHOLE


def claims() -> tuple[Claim, ...]:
    """The equations, in the thesis' order."""
    return (*_loop(), *_error_function(), *_superposition(), *_elimination())


_equation = partial(equation, "thesis", "2.1.3, Eq {}")


def _loop() -> tuple[Claim, ...]:
    return (
        _equation("2.23 to 2.25", "ρ e^{jα} = a0 e^{jθ0} + a1 e^{jθ1} + a2 e^{jθ2}", arm.eq_2_24),
        _equation(
            "2.26, 2.27",
            "a2 e^{jθ2} = a0 e^{jθ0} + a1 e^{jθ1} - ρ e^{jα}",
            lambda: residual(arm.second(), -arm.remainder()),
            "the right side has the other sign; harmless, it is squared next",
            lambda: residual(arm.second(), arm.remainder()),
        ),
        _equation(
            "2.28",
            "a2² = ρ² + a0² + a1² - 2 a0 ρ·e0 - 2 a1 ρ·e1 + 2 a0 a1 e0·e1",
            lambda: residual(arm.a2_squared(), arm.ARM.second**2),
        ),
        _equation(
            "2.29, 2.30",
            "a2²/(2 a1) = ρ²/(2 a1) + (a0²+a1²)/(2 a1) - a0 ρ·e0/a1 + a0 e0·e1 - ρ cos(α-θ1)",
            lambda: residual(arm.ARM.second**2 / (2 * arm.ARM.first), arm.a2_squared() / (2 * arm.ARM.first)),
        ),
    )


def _error_function() -> tuple[Claim, ...]:
    """Eqs 2.31 to 2.36 with required second links a2 instead of the arm's ã2."""
    required, had = np.array([0.5, 0.6, 0.7]), arm.ARM.second
    delta = required - had
    return (
        _equation(
            "2.31, 2.33", "Δ = a2 - ã2, to first order (a2² - ã2²)/(2 a2)", lambda: residual(1.0, _first_order(had))
        ),
        _equation(
            "2.32",
            "Δ (a2+ã2) = (a2-ã2) + (a2+ã2)",
            lambda: residual(delta * (required + had), (required - had) + (required + had)),
            "the two brackets are multiplied: Δ (a2+ã2) = (a2-ã2)(a2+ã2)",
            lambda: residual(delta * (required + had), (required - had) * (required + had)),
        ),
        _equation(
            "2.34 with 2.35",
            "Δq = a2² - ã2² and Δq = P0 f0 + ... - F",
            lambda: residual(required**2 - had**2, arm.objective(required)),
            "Eq 2.35 is (ã2² - a2²)/(2 a1): other sign and scale; the zeros are the same",
            lambda: residual((had**2 - required**2) / (2 * arm.ARM.first), arm.objective(required)),
        ),
        _equation("2.36", "P0 f0 + P1 f1 + P2 f2 + P3 f3 + P4 f4 + P5 f5 - F = 0", arm.eq_2_36),
    )


def _first_order(a2: float) -> float:
    """d/dΔ of (a2² - (a2-Δ)²)/(2 a2) at Δ = 0, by a complex step."""
    step = 1e-20
    return float(((a2**2 - (a2 - 1j * step) ** 2) / (2 * a2)).imag / step)


def _superposition() -> tuple[Claim, ...]:
    return (
        _equation("2.37", "P2 = 2 P1 P4,  P3 = 2 P1 P5", arm.eq_2_37),
        _equation(
            "2.37 f., text",
            "P2 = λ1,  P3 = λ2",
            lambda: arm.against_lambda(1),
            "printed as P2 = λ2, P3 = λ3, later P2 = λ1, P2 = λ2; with the λ of Eqs 2.38 to 2.42 P2 = 2 λ1, P3 = 2 λ2",
            lambda: arm.against_lambda(2),
        ),
        _equation("2.38", "Σ (l + λ1 m + λ2 n) f = F - 2 λ1 f2 - 2 λ2 f3", arm.eq_2_38),
        _equation("2.39, 2.40", "P = l + λ1 m + λ2 n from three systems of one 4x4 matrix", arm.eq_2_40),
        _equation("2.41, 2.42", "λ1 = P1 P4,  λ2 = P1 P5 in l, m, n", arm.eq_2_41),
    )


def _elimination() -> tuple[Claim, ...]:
    half = ("half in λ",)
    return (
        _equation(
            "2.43",
            "... + λ1 (l1 m4 + l4 m1 - 1/2) + ... = 0",
            lambda: arm.eq_2_43(4, HALF_TOO_MUCH),
            "l1 m4 + l4 m1 - 1",
            lambda: arm.eq_2_43(4, WHOLE),
            slips=half,
        ),
        _equation(
            "2.44",
            "... + λ2 (l1 n5 + l5 n1 - 1/2) + ... = 0",
            lambda: arm.eq_2_43(5, HALF_TOO_MUCH),
            "l1 n5 + l5 n1 - 1",
            lambda: arm.eq_2_43(5, WHOLE),
            slips=half,
        ),
        _equation("2.45, A1 to A5", "Eq 2.43 - n4/n5 Eq 2.44 has no λ2²", arm.eq_2_45),
        _equation(
            "2.46",
            "λ2 = -(A1 λ1² + A3 λ1 + A5)/(A4 + A2 λ1)",
            lambda: arm.eq_2_46(HALF_TOO_MUCH),
            "... - 1 in A3 and n4/n5 in A4",
            lambda: arm.eq_2_46(WHOLE),
            slips=half,
        ),
        _equation("2.46 f., text", "the coefficient of λ1⁴ becomes zero", arm.quartic),
        Claim("thesis", "solutions of the third-order equation", "3", COUNT, arm.solutions, "2.1.3, text"),
        Claim(
            "thesis",
            "precision points and lengths of the knotting arm",
            "figure",
            "mm",
            lambda: None,
            "Fig 2.3",
            "no points are printed",
        ),
    )
