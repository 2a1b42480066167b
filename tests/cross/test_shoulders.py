"""Notch factors of shoulders: DIN 743-2 against the polynomials of Peterson's charts."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.elements.shoulders import Shoulder, concentrations
from ilmek.machines.shedding import MACHINE, SheddingParams

BENDING = (
    ((0.947, 1.206, -0.131), (0.022, -3.405, 0.915), (0.869, 1.777, -0.555), (-0.810, 0.422, -0.260)),
    ((1.232, 0.832, -0.008), (-3.813, 0.968, -0.260), (7.423, -4.868, 0.869), (-3.839, 3.070, -0.600)),
)
TORSION = ((0.905, 0.783, -0.075), (-0.437, -1.969, 0.553), (1.557, 1.073, -0.578), (-1.061, 0.171, 0.086))
"""Pilkey, Peterson's Stress Concentration Factors, charts 3.10 and 3.12: t/r from 0.1 and from 2; from 0.25 to 4."""


def peterson(rows, shaft: float, journal: float, fillet: float) -> float:
    deep = (shaft - journal) / 2 / fillet
    terms = [a + b * math.sqrt(deep) + c * deep for a, b, c in rows]
    return float(np.polyval(terms[::-1], (shaft - journal) / shaft))


@given(st.floats(1.1, 2.5), st.floats(0.04, 0.2))
def test_bending_agrees_with_petersons_chart(wide, slender) -> None:
    deep = (wide - 1) / 2 / slender
    if 0.1 <= deep <= 20:
        expected = peterson(BENDING[deep >= 2], wide, 1.0, slender)
        assert concentrations(wide, 1.0, slender)[0] == pytest.approx(expected, rel=0.1)


@given(st.floats(1.1, 1.8), st.floats(0.04, 0.2))
def test_torsion_agrees_with_petersons_chart(wide, slender) -> None:
    if 0.25 <= (wide - 1) / 2 / slender <= 4:
        expected = peterson(TORSION, wide, 1.0, slender)
        assert concentrations(wide, 1.0, slender)[1] == pytest.approx(expected, rel=0.1)


@given(st.floats(0.02, 0.06), st.floats(1.0, 500.0), st.floats(1.0, 500.0))
def test_safety_by_hand(journal, moment, torque) -> None:
    """1 / n = sqrt((Kb 32 M / pi d^3)^2 + 3 (Kt 16 T / pi d^3)^2) / Se, Se with Marin's factors written out."""
    one = Shoulder(0.065, journal, 360e6, moment, torque)
    bending, torsion = one.notches
    size = journal * 1e3
    factor = (size / 7.62) ** -0.107 if size <= 51 else 1.51 * size**-0.157
    limit = min(4.51 * 360**-0.265, 1.0) * factor * 0.814 * 180e6
    stress = math.hypot(32 * bending * moment, math.sqrt(3) * 16 * torsion * torque) / (math.pi * journal**3)
    assert one.safety == pytest.approx(limit / stress, rel=1e-9)


def test_a_journal_of_20_mm_on_the_bar_breaks() -> None:
    """The bearing that has life enough, UC 204, asks for a journal that the torque and the notch break."""
    report = MACHINE.report(MACHINE.design(SheddingParams(bearing="UC 204")))
    failed = {check.name for check in report.failed}
    assert {"fatigue of the driven journal at its shoulder", "stress of the driven journal"} <= failed
    assert MACHINE.report(MACHINE.design(SheddingParams())).failed == ()


def test_a_plain_end_has_no_notch() -> None:
    assert Shoulder(0.03, 0.03, 360e6, 10.0, 10.0).notches == (1.0, 1.0)
