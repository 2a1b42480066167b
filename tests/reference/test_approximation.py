"""Best approximations that are known in closed form or from the literature, and peers for the squares."""

import math

import numpy as np
import pytest
from scipy.optimize import least_squares as peer

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError
from ilmek.synthesis.approximation.polynomial import (
    SynthesisPolynomial,
    Terms,
    chebyshev_nodes,
    interpolation,
    least_squares,
    minimax,
    of_table,
    range_nodes,
)


def powers(count: int) -> Terms:
    return lambda x: np.stack([x**k for k in range(count)], axis=-1)


def line_error(f: Terms, slope: float, touches: float) -> float:
    """Greatest error of the best line for a convex or concave f on [0, 1]: half the gap of chord and tangent."""
    ends = f(np.array([0.0, 1.0, touches]))
    return abs(ends[0] - ends[2] + slope * touches) / 2


@pytest.mark.parametrize(
    ("f", "start", "stop", "count", "error"),
    [
        (np.sqrt, 0.0, 1.0, 2, 1 / 8),
        (
            lambda x: np.sqrt(1 + x),
            0.0,
            1.0,
            2,
            line_error(lambda x: np.sqrt(1 + x), 2**0.5 - 1, 0.25 / (2**0.5 - 1) ** 2 - 1),
        ),
        (np.exp, 0.0, 1.0, 2, (2 - math.e + (math.e - 1) * math.log(math.e - 1)) / 2),
        (np.abs, -1.0, 1.0, 3, 1 / 8),  # x^2 + 1/8
        (lambda x: 1 / (x - 2), -1.0, 1.0, 4, (2 - 3**0.5) ** 3 / 3),  # Chebyshev: 1 / (x - a), degree n
    ],
)
def test_the_greatest_error_is_that_of_the_closed_form(
    f: Terms, start: float, stop: float, count: int, error: float
) -> None:
    best = minimax(SynthesisPolynomial(powers(count), f), range_nodes(start, stop)).found[0]
    assert best.worst == pytest.approx(error, rel=1e-12)
    assert best.bound == pytest.approx(error, rel=1e-12)
    touching = best.errors[np.abs(best.errors) > best.worst * (1 - 1e-9)]
    assert len(touching) >= count + 1
    assert (np.sign(touching[1:]) == -np.sign(touching[:-1])).all()


@pytest.mark.parametrize(("degree", "error"), [(1, 0.278802), (2, 0.045017), (3, 0.0055284), (4, 0.00054667)])
def test_the_exponential_function_has_the_errors_of_the_literature(degree: int, error: float) -> None:
    """Meinardus, Approximation of functions, 1967, 6.2: e^x on [-1, 1]."""
    best = minimax(SynthesisPolynomial(powers(degree + 1), np.exp), range_nodes(-1.0, 1.0)).found[0]
    assert best.worst == pytest.approx(error, rel=3e-5)


@pytest.mark.parametrize("degree", [2, 5, 9])
def test_a_power_less_its_best_polynomial_is_chebyshevs(degree: int) -> None:
    best = minimax(SynthesisPolynomial(powers(degree), lambda x: x**degree), range_nodes(-1.0, 1.0)).found[0]
    assert best.worst == pytest.approx(2.0 ** (1 - degree), rel=1e-11)
    np.testing.assert_allclose(np.sort(best.at), np.cos(np.pi * np.arange(degree, -1, -1) / degree), atol=1e-6)
    np.testing.assert_allclose(np.abs(best.errors), best.worst, rtol=1e-9)


def test_squares_without_products_are_those_of_numpy() -> None:
    random = np.random.default_rng(3)
    table, wanted = random.normal(size=(30, 5)), random.normal(size=30)
    found = least_squares(of_table(table, wanted), np.arange(30.0)).found
    assert len(found) == 1
    np.testing.assert_allclose(found[0].parameters, np.linalg.lstsq(table, wanted, rcond=None)[0], rtol=1e-10)
    assert found[0].kind == "minimum"


@pytest.mark.parametrize("products", [((0, 1),), ((0, 1), (0, 2)), ((0, 1), (2, 3))])
def test_squares_with_products_lose_none_that_a_peer_finds(products: tuple[tuple[int, int], ...]) -> None:
    random = np.random.default_rng(11)
    for _ in range(3):
        table, more = random.normal(size=(6, 4)), random.normal(size=(6, len(products)))
        wanted = random.normal(size=6)
        found = least_squares(of_table(table, wanted, products, more), np.arange(6.0)).found
        assert all(one.proven for one in found)

        def errors(p: FloatArray, table: FloatArray, more: FloatArray, wanted: FloatArray) -> FloatArray:
            return table @ p + more @ np.array([p[a] * p[b] for a, b in products]) - wanted

        sums = []
        for _ in range(25):
            end = peer(errors, random.normal(size=4) * 2, args=(table, more, wanted), xtol=1e-14, ftol=1e-14)
            if end.optimality < 1e-7:
                sums.append(math.sqrt(2 * end.cost / 6))
        minima = [one.rms for one in found if one.kind == "minimum"]
        assert min(minima) <= min(sums) * (1 + 1e-6)
        if products != ((0, 1), (2, 3)):
            assert all(min(abs(one - minimum) for minimum in minima) < 1e-6 for one in sums)


def test_nodes_of_chebyshev_keep_the_error_near_the_least() -> None:
    root = SynthesisPolynomial(powers(4), lambda x: np.sqrt(1 + x))
    places = range_nodes(0.0, 1.0)
    through = interpolation(root, chebyshev_nodes(0.0, 1.0, 4), places).found[0]
    best = minimax(root, places).found[0]
    assert best.worst < through.worst < 1.4 * best.worst
    assert through.proven


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda p: interpolation(p, np.array([0.0, 1.0]), range_nodes(0.0, 1.0)), "2 different nodes for 3 parameters"),
        (lambda p: interpolation(p, np.array([0.0, 1.0, 1.0]), range_nodes(0.0, 1.0)), "2 different nodes"),
        (lambda p: minimax(p, np.array([0.0, 1.0, 2.0])), "3 points for 3 parameters"),
        (lambda p: minimax(p, range_nodes(1.0, 0.0)), "x from 1 to 0"),
        (lambda p: SynthesisPolynomial(p.terms, p.target, ((0, 1),)), "without their terms"),
        (lambda p: SynthesisPolynomial(p.terms, p.target, ((0, 1), (1, 0)), p.terms), "two at most"),
        (lambda p: minimax(SynthesisPolynomial(p.terms, np.log), range_nodes(0.0, 1.0)), "not finite"),
        (
            lambda p: least_squares(SynthesisPolynomial(lambda x: np.ones((len(x), 2)), p.target), range_nodes(0, 1)),
            "dependent",
        ),
    ],
)
@pytest.mark.filterwarnings("ignore:divide by zero")
def test_a_wrong_question_is_answered_in_words(ask: object, words: str) -> None:
    assert callable(ask)
    with pytest.raises(ParameterError, match=words):
        ask(SynthesisPolynomial(powers(3), np.exp))
