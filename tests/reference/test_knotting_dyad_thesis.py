"""Thesis 2.1.3, the arm through four timed points: the machine's solutions in the thesis' own equations.

The thesis prints no points, so an arm is planted; every solution of the machine, not the planted one alone, must meet
Eqs 2.36, 2.37, and the mended Eqs 2.43 to 2.46, which the printed 1/2 does not.
"""

from functools import cache

import numpy as np
import pytest

from ilmek.machines.knotting_dyad import KnottingDyad, KnottingDyadParams, design
from ilmek.synthesis.dyad import TwoLinkArm
from ilmek.units import mm
from ilmek.verification import thesis_arm


@cache
def made() -> KnottingDyad:
    """The planted arm of `ilmek reproduce --paper thesis`, its 1 taken for 100 mm."""
    points = " ".join(f"({100 * p.real!r}mm,{100 * p.imag!r}mm)" for p in thesis_arm.POINTS.tolist())
    angles = " ".join(f"{angle!r}rad" for angle in thesis_arm.TH1.tolist())
    return design(KnottingDyadParams.read({"points": points, "angles": angles, "link_limit": "1m"}))


def parameters(dyad: TwoLinkArm) -> np.ndarray:
    """P0 to P5 of an arm, lengths in units of 100 mm: a1 = 1/(2 P1), X = P4, Y = P5."""
    a1, a2, pivot = dyad.first / (100 * mm), dyad.second / (100 * mm), dyad.pivot / (100 * mm)
    K = abs(pivot) ** 2 + a1**2 - a2**2
    return np.array([K / (2 * a1), 1 / (2 * a1), pivot.real / a1, pivot.imag / a1, pivot.real, pivot.imag])


def test_the_planted_arm_is_among_the_solutions() -> None:
    planted = thesis_arm.ARM
    missed = [
        abs(dyad.pivot / (100 * mm) - planted.pivot)
        + abs(dyad.first / (100 * mm) - planted.first)
        + abs(dyad.second / (100 * mm) - planted.second)
        for dyad in made().dyads
    ]
    assert min(missed) < 1e-10


def test_every_solution_meets_the_error_function_and_its_ties() -> None:
    """Eq 2.36, P0 f0 + ... + P5 f5 - F = 0, and Eq 2.37, P2 = 2 P1 P4 and P3 = 2 P1 P5."""
    planted = thesis_arm.planted()
    for dyad in made().dyads:
        P = parameters(dyad)
        assert P @ planted.f - planted.F == pytest.approx(np.zeros(4), abs=1e-9)
        assert P[2:4] == pytest.approx(2 * P[1] * P[4:6], rel=1e-12)


@pytest.mark.parametrize("which", [4, 5])
def test_every_solution_meets_the_mended_elimination_and_not_the_printed_one(which: int) -> None:
    """Eqs 2.43 (P4) and 2.44 (P5): (l1 + lam1 m1 + lam2 n1)(l + lam1 m + lam2 n) = lam; printed with lam/2."""
    L, m, n = (getattr(thesis_arm.planted(), name) for name in ("L", "m", "n"))
    for dyad in made().dyads:
        P = parameters(dyad)
        lam = np.array([P[1] * P[4], P[1] * P[5]])
        product = (L[1] + lam[0] * m[1] + lam[1] * n[1]) * (L[which] + lam[0] * m[which] + lam[1] * n[which])
        assert product - lam[which - 4] == pytest.approx(0, abs=1e-9)
        assert abs(product - lam[which - 4] / 2) > 1e-2


def test_three_roots_as_the_thesis_says() -> None:
    """Text after Eq 2.46: the equation is of third order; the roots of the machine are three, real or not."""
    assert made().arms.found.shape == (3,)
    assert len(made().dyads) in (1, 3)
