"""Beams against closed forms: Gere and Goodno (appendix H), Roark (table 8.1), Clapeyron's continuous beams."""

import numpy as np
import pytest

from ilmek.elements.beam.uniform import Beam, Couple, LineLoad, PointLoad, bend, deflection
from ilmek.errors import ParameterError

L, P, Q, C = 1.7, 130.0, 900.0, 45.0


def simple(*loads: LineLoad | PointLoad | Couple, length: float = L) -> Beam:
    return Beam(length, (0.0, length), loads)


@pytest.mark.parametrize("a", [0.2, 0.85, 1.3])
def test_point_load_anywhere(a) -> None:
    """H-2, case 5: slopes Pab(L+b)/6LEI, Pab(L+a)/6LEI; the largest deflection stands at sqrt((L²-b²)/3), a >= b."""
    b = L - a
    bent = bend(simple(PointLoad(a, P)))
    left, right = bent.slope(np.array([0.0, L]), 1.0)
    assert left == pytest.approx(P * a * b * (L + b) / (6 * L))
    assert right == pytest.approx(-P * a * b * (L + a) / (6 * L))
    far, near = max(a, b), min(a, b)
    largest = bent.deflection_max(1.0)
    assert largest.size == pytest.approx(P * near * (L * L - near * near) ** 1.5 / (9 * np.sqrt(3) * L))
    place = np.sqrt((L * L - near * near) / 3)
    assert largest.at == pytest.approx(place if a == far else L - place)
    assert bent.moment_max.size == pytest.approx(P * a * b / L)
    assert bent.moment_max.at == pytest.approx(a)


def test_triangular_load() -> None:
    """H-2, case 14: M = q L² / 9 sqrt 3 at L / sqrt 3; y = 0.00652 q L⁴ / EI at 0.5193 L; slopes 7/360, 8/360."""
    bent = bend(simple(LineLoad(0.0, L, 0.0, Q)))
    assert bent.moment_max.size == pytest.approx(Q * L * L / (9 * np.sqrt(3)))
    assert bent.moment_max.at == pytest.approx(L / np.sqrt(3))
    assert bent.deflection_max(1.0).at == pytest.approx(0.5193 * L, abs=1e-4 * L)
    assert bent.deflection_max(1.0).size == pytest.approx(0.00652 * Q * L**4, rel=1e-3)
    np.testing.assert_allclose(bent.slope(np.array([0, L]), 1.0), np.array([7, -8]) / 360 * Q * L**3, rtol=1e-12)
    np.testing.assert_allclose(bent.reactions, [Q * L / 6, Q * L / 3], rtol=1e-12)


def test_load_on_a_part() -> None:
    """H-2, case 2 with a on the left: R_A = q a (2L - a) / 2L; slope at A = q a² (2L - a)² / 24 L EI."""
    a = 0.6
    bent = bend(simple(LineLoad(0.0, a, Q)))
    assert bent.reactions[0] == pytest.approx(Q * a * (2 * L - a) / (2 * L))
    assert bent.slope(0.0, 1.0) == pytest.approx(Q * a * a * (2 * L - a) ** 2 / (24 * L))
    assert bent.deflection(a, 1.0) == pytest.approx(Q * a**3 / (24 * L) * (4 * L * L - 7 * a * L + 3 * a * a))


def test_couple_at_an_end_and_within() -> None:
    """H-2, cases 7 and 9: slopes C L / 3 EI and C L / 6 EI; within, y at it = C a b (b - a) / 3 L EI."""
    bent = bend(simple(Couple(0.0, C)))
    np.testing.assert_allclose(bent.slope(np.array([0, L]), 1.0), [C * L / 3, -C * L / 6], rtol=1e-12)
    assert bent.deflection_max(1.0).size == pytest.approx(C * L * L / (9 * np.sqrt(3)))
    for a in (0.5, 1.2):
        bent, b = bend(simple(Couple(a, C))), L - a
        assert abs(bent.deflection(a, 1.0)) == pytest.approx(C * a * b * abs(b - a) / (3 * L))
        np.testing.assert_allclose(bent.reactions, [-C / L, C / L], rtol=1e-12)


def test_overhanging_beam() -> None:
    """Load at the end of an overhang a: y = P a² (l + a) / 3 EI there, -P a l² / 9 sqrt 3 EI between [Gere, 9-5]."""
    for start, end in ((0.0, L), (0.4, L + 0.4)):
        span, over = L, 0.4
        at = end + over if start == 0 else 0.0
        bent = bend(Beam(L + over, (start, end), (PointLoad(at, P),)))
        assert bent.deflection(at, 1.0) == pytest.approx(P * over**2 * (span + over) / 3)
        inside = bent.deflection(np.linspace(start, end, 2001), 1.0).real
        assert inside.min() == pytest.approx(-P * over * span**2 / (9 * np.sqrt(3)), rel=1e-5)
        assert sorted(abs(r) for r in bent.reactions) == pytest.approx([P * over / span, P * (1 + over / span)])


def test_cantilever_and_clamped_beams() -> None:
    """H-1, cases 1, 4, 8: q L⁴/8, P L³/3, q L⁴/30; clamped: q L⁴/384, q L²/12; propped: q L⁴/184.6, q L²/8."""
    for at, free in ((0.0, L), (L, 0.0)):
        tip = [
            bend(Beam(L, (at,), (load,), (at,))).deflection(free, 1.0)
            for load in (LineLoad(0.0, L, Q), PointLoad(free, P))
        ]
        np.testing.assert_allclose(tip, [Q * L**4 / 8, P * L**3 / 3], rtol=1e-12)
    bent = bend(Beam(L, (0.0,), (LineLoad(0.0, L, Q, 0.0),), (0.0,)))
    assert bent.deflection(L, 1.0) == pytest.approx(Q * L**4 / 30)
    both = bend(Beam(L, (0.0, L), (LineLoad(0.0, L, Q),), (0.0, L)))
    assert both.deflection_max(1.0).size == pytest.approx(Q * L**4 / 384)
    np.testing.assert_allclose(both.clamps, [Q * L * L / 12, -Q * L * L / 12])
    propped = bend(Beam(L, (0.0, L), (LineLoad(0.0, L, Q),), (0.0,)))
    assert propped.clamps[0] == pytest.approx(Q * L * L / 8)
    assert propped.deflection_max(1.0).size == pytest.approx(Q * L**4 / 184.6, rel=1e-3)
    assert propped.deflection_max(1.0).at == pytest.approx(0.5785 * L, abs=1e-4 * L)


@pytest.mark.parametrize(
    ("spans", "reactions"),
    [
        (2, [3 / 8, 10 / 8, 3 / 8]),
        (3, [4 / 10, 11 / 10, 11 / 10, 4 / 10]),
        (4, [11 / 28, 32 / 28, 26 / 28, 32 / 28, 11 / 28]),
        (5, [15 / 38, 43 / 38, 37 / 38, 37 / 38, 43 / 38, 15 / 38]),
    ],
)
def test_continuous_beams(spans, reactions) -> None:
    """Reactions over q l of equal spans [Timoshenko, Strength of Materials I, 46]."""
    supports = tuple(float(place) for place in range(spans + 1))
    bent = bend(Beam(float(spans), supports, (LineLoad(0.0, float(spans), 1.0),)))
    np.testing.assert_allclose(bent.reactions, reactions, rtol=1e-12)


def test_forty_spans_stay_exact() -> None:
    """Inner spans of a long row are as good as clamped: q l²/12 over their supports, q l⁴/384 between."""
    bent = bend(Beam(40.0, tuple(range(41)), (LineLoad(0.0, 40.0, 1.0),)))
    assert bent.moment(20.0) == pytest.approx(-1 / 12, rel=1e-10)
    assert bent.deflection(20.5, 1.0) == pytest.approx(1 / 384, rel=1e-9)
    assert np.max(np.abs(bent.deflection(np.arange(41.0), 1.0))) < 1e-15


def test_agrees_with_the_simple_formulas() -> None:
    x = np.linspace(0, L, 50)
    bent = bend(simple(LineLoad(0.0, L, Q)))
    np.testing.assert_allclose(bent.deflection(x, 7.0).real, deflection(x, Q, L, 7.0, inertia=1.0), atol=1e-12)


def test_two_planes_at_once_are_the_two_alone() -> None:
    weight, pull = LineLoad(0.0, L, Q), PointLoad(0.4, P)
    both = bend(simple(weight, PointLoad(0.4, 1j * P)))
    x = np.linspace(0, L, 40)
    alone = bend(simple(weight)).moment(x).real, bend(simple(pull)).moment(x).real
    np.testing.assert_allclose(both.moment(x), alone[0] + 1j * alone[1], atol=1e-9)
    fine = np.linspace(0, L, 20001)
    assert both.deflection_max(1.0).size == pytest.approx(np.max(np.abs(both.deflection(fine, 1.0))), rel=1e-7)
    assert both.moment_max.size == pytest.approx(np.max(np.abs(both.moment(fine))), rel=1e-4)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Beam(1.0, (0.0, 1.2)), "1200 mm; 0 to 1000 mm"),
        (lambda: Beam(1.0, (0.0,)), "two or more, or one clamped"),
        (lambda: Beam(1.0, (0.5, 0.2)), "ascending positions"),
        (lambda: Beam(1.0, (0.0, 0.5), (), (0.5,)), "clamped at 500 mm"),
        (lambda: Beam(1.0, (0.0, 1.0), (LineLoad(0.5, 0.5, 1.0),)), "a start before its end"),
        (lambda: Beam(0.0, (0.0, 1.0)), "a beam 0 mm long"),
    ],
)
def test_impossible_beams_are_refused(make, said) -> None:
    with pytest.raises(ParameterError, match=said):
        make()
