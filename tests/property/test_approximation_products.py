"""Products of parameters: planted and stationary answers are all found, no neighbour of a minimax is better."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from ilmek.errors import ParameterError
from ilmek.num.newton import newton
from ilmek.synthesis.approximation.polynomial import SynthesisPolynomial, interpolation, minimax, of_table, range_nodes
from ilmek.synthesis.approximation.products import EquationRows, errors_of, gradient, solve_products, stationary

PRODUCTS = [(), ((0, 1),), ((0, 1), (0, 2)), ((0, 1), (2, 3))]


@settings(max_examples=40)
@given(st.integers(0, 2**32 - 1), st.sampled_from(PRODUCTS))
def test_planted_parameters_are_found_and_every_answer_solves_the_equations(seed: int, products: tuple) -> None:
    random = np.random.default_rng(seed)
    table, more, planted = random.normal(size=(4, 4)), random.normal(size=(4, len(products))), random.normal(size=4)
    rows = EquationRows(table, more, np.zeros(4))
    rows = rows._replace(target=-errors_of(rows, products, planted)[0])
    slopes = errors_of(rows, products, planted)[1]
    assume(np.linalg.cond(slopes) < 1e4)  # a double root is known to half the digits
    found = solve_products(rows, products)
    assert min(np.max(np.abs(one - planted)) for one in found.parameters) < 1e-8
    for one in found.parameters:
        assert np.max(np.abs(errors_of(rows, products, one)[0])) < 1e-9 * max(1, np.max(np.abs(one)) ** 2)
    assert len(found.parameters) <= {0: 1, 1: 2, 2: 3 if products == PRODUCTS[2] else 4}[len(products)]


@settings(max_examples=12)
@given(st.integers(0, 2**32 - 1), st.sampled_from(PRODUCTS[:3]))
def test_newtons_method_from_anywhere_finds_no_stationary_answer_that_is_missing(seed: int, products: tuple) -> None:
    random = np.random.default_rng(seed)
    rows = EquationRows(random.normal(size=(5, 4)), random.normal(size=(5, len(products))), random.normal(size=5))
    found = stationary(rows, products).parameters
    assert len(found) % 2  # a form of odd degree
    ends = newton(lambda p: gradient(rows, products, p), random.standard_cauchy(size=(60, 4)), tolerance=1e-9, steps=80)
    for end in ends[np.isfinite(ends).all(axis=-1)]:
        size = max(1.0, float(np.max(np.abs(end))))
        if size < 1e3 and np.max(np.abs(gradient(rows, products, end)[0])) < 1e-9 * size**3:
            assert min(np.max(np.abs(end - one)) for one in found) < 1e-5 * size


@pytest.mark.parametrize("products", PRODUCTS[1:])
def test_no_neighbour_of_a_minimax_with_products_has_a_smaller_greatest_error(products: tuple) -> None:
    bent = SynthesisPolynomial(
        lambda x: np.stack([np.ones_like(x), x, x**2, x**3], axis=-1),
        np.exp,
        products,
        lambda x: np.stack([np.sin(3 * x), np.cos(4 * x)][: len(products)], axis=-1),
        weight=lambda x: 1 + x**2,
    )
    random = np.random.default_rng(2)
    x = np.linspace(-1, 1, 801)
    for best in minimax(bent, range_nodes(-1.0, 1.0)).found:
        assert best.proven
        assert best.bound <= best.worst
        for size in (1e-2, 1e-4):
            near = best.parameters + random.normal(size=(60, 4)) * size
            errors = errors_of(bent.rows(x), products, near)[0]
            assert np.min(np.max(np.abs(errors), axis=-1)) > best.worst * (1 - 1e-4)


def test_an_answer_infinitely_far_and_complex_ones_are_told() -> None:
    # With P_1 = 1: P_0 + P_0 P_1 = 0 where the product counts: t = -1 sends P_0 away.
    table = of_table(np.array([[1.0, 0.0], [0.0, 1.0]]), np.array([1.0, -1.0]), ((0, 1),), np.array([[1.0], [0.0]]))
    assert interpolation(table, np.arange(2.0), np.arange(2.0)) == ((), ("2 infinitely far",))
    circle = EquationRows(np.array([[1.0, 1.0], [1.0, -1.0]]), np.array([[0.0], [-4.0]]), np.array([0.0, 1.0]))
    assert solve_products(circle, ((0, 1),)).parameters[0].size == 2
    no_root = EquationRows(np.array([[1.0, 1.0], [0.0, 0.0]]), np.array([[0.0], [1.0]]), np.array([0.0, 1.0]))
    assert solve_products(no_root, ((0, 1),)) == ((), ("2 complex",))  # P_0 = -P_1, P_0 P_1 = 1


def test_a_family_is_refused() -> None:
    same = EquationRows(np.array([[1.0, 1.0], [2.0, 2.0]]), np.zeros((2, 0)), np.array([1.0, 2.0]))
    with pytest.raises(ParameterError, match="family"):
        solve_products(same, ())
