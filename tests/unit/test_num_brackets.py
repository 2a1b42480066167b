"""Bracketed roots: to the last digit, whatever the shape of the function."""

import numpy as np

from ilmek.num.brackets import bracketed_roots


def test_flat_steep_and_broken_functions_are_solved_to_rounding():
    powers = np.array([1.0, 3.0, 9.0, 1 / 9])

    def f(x):
        return np.sign(x - 0.3) * np.abs(x - 0.3) ** powers

    np.testing.assert_allclose(bracketed_roots(f, np.zeros(4), np.ones(4)), 0.3, rtol=1e-15)
    step = bracketed_roots(lambda x: np.where(x < 0.7, -1.0, 1.0), np.array([1.0]), np.array([0.0]))
    np.testing.assert_allclose(step, 0.7, rtol=1e-15)


def test_ends_of_one_sign_have_no_root():
    found = bracketed_roots(lambda x: x * x + np.array([1.0, np.nan, 0.0]), np.full(3, -1.0), np.array([1.0, 1.0, 0.0]))
    np.testing.assert_array_equal(found, [np.nan, np.nan, 0.0])
