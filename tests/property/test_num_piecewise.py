"""Piecewise smooth functions against closed forms: cubics with jumps between them, pieces of cosine waves."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from ilmek.arrays import FloatArray
from ilmek.num.piecewise import around, crossings, infimum, integral, integrals, roots, suprema, supremum
from ilmek.units import turn

coefficient = st.integers(-3000, 3000).map(lambda number: number / 1000)
cubic = st.lists(coefficient, min_size=4, max_size=4)
widths = st.lists(st.floats(0.1, 2.0), min_size=1, max_size=5)


def pieced(cubics: list[list[float]], knots: FloatArray) -> tuple[list[Polynomial], FloatArray]:
    """A cubic for each piece, by the distance from the start of its piece."""
    return [Polynomial(cubics[k % len(cubics)]) for k in range(knots.size - 1)], knots


@given(st.lists(cubic, min_size=1, max_size=5), widths)
def test_extremes_and_integrals_of_cubics_with_jumps(cubics: list[list[float]], sizes: list[float]) -> None:
    polynomials, knots = pieced(cubics, np.concatenate([[0.0], np.cumsum(sizes)]))

    def curve(x: FloatArray) -> FloatArray:
        piece = np.clip(np.searchsorted(knots, x, side="right") - 1, 0, len(polynomials) - 1)
        return np.array([polynomials[k](one - knots[k]) for k, one in zip(piece, x, strict=True)])

    candidates = []
    for polynomial, size in zip(polynomials, sizes, strict=True):
        stationary = [r.real for r in polynomial.deriv().roots() if abs(r.imag) < 1e-12 and 0 < r.real < size]
        candidates += [polynomial(x) for x in (0.0, size, *stationary)]
    area = sum(polynomial.integ()(size) for polynomial, size in zip(polynomials, sizes, strict=True))
    top, bottom = supremum(curve, knots), infimum(curve, knots)
    np.testing.assert_allclose([top.value, bottom.value], [max(candidates), min(candidates)], rtol=1e-12, atol=5e-12)
    np.testing.assert_allclose(integral(curve, knots), area, rtol=1e-12, atol=5e-12)
    inward = curve(np.array([np.clip(top.at + 1e-13 * top.side, knots[0], knots[-1])]))[0]
    np.testing.assert_allclose(inward, top.value, rtol=1e-9, atol=1e-9)


@given(st.floats(0.1, 5.0), st.floats(0.0, 6.28), st.integers(1, 6), st.lists(st.floats(-9.0, 9.0), max_size=4))
def test_a_wave_round_a_turn_wherever_it_is_cut(height: float, late: float, count: int, breaks: list[float]) -> None:
    def wave(x: FloatArray, _: FloatArray) -> FloatArray:
        return height * np.cos(count * (x - late))

    pieces = around(breaks)
    found = suprema(lambda x, side: {"wave": wave(x, side), "down": -wave(x, side)}, pieces)
    np.testing.assert_allclose([found["wave"].value, found["down"].value], height, rtol=1e-10)
    assert 0 <= found["wave"].at < turn
    np.testing.assert_allclose(np.cos(count * (found["wave"].at - late)), 1.0, rtol=1e-10)
    squared = integrals(lambda x, side: {"all": wave(x, side) ** 2}, around(breaks, parts=16))["all"]
    np.testing.assert_allclose(np.sum(squared), np.pi * height**2, rtol=1e-12)


@given(st.floats(-0.95, 0.95), st.floats(0.1, 3.0))
def test_crossings_and_roots_are_those_of_the_wave(level: float, late: float) -> None:
    expected = np.sort(np.mod(late + np.arccos(level) * np.array([-1.0, 1.0]), turn))
    passed = np.sort(np.mod(crossings(lambda x, _: np.cos(x - late), around([0.7]), level), turn))
    np.testing.assert_allclose(passed, expected, atol=1e-13)
    found = roots(lambda x: np.cos(x - late) - level, np.linspace(0.0, turn, 100))
    np.testing.assert_allclose(found, expected, atol=1e-13)
