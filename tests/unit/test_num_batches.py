"""Small systems in batches: one bad system never spoils the others; derivatives of periodic samples."""

import numpy as np
import pytest
from periodic_samples import periodic_derivative, periodic_mean

from ilmek.errors import IlmekError
from ilmek.num.linear import reciprocal_condition, solve_many
from ilmek.num.newton import newton


def test_singular_and_nan_systems_are_nan_and_the_rest_solved():
    matrix = np.stack([np.diag([1.0, 2.0]), np.zeros((2, 2)), np.full((2, 2), np.nan), np.diag([4.0, 5.0])])
    found = solve_many(matrix, np.ones((4, 2)))
    np.testing.assert_allclose(found[[0, 3]], [[1, 0.5], [0.25, 0.2]])
    assert np.isnan(found[[1, 2]]).all()
    condition = reciprocal_condition(matrix)
    np.testing.assert_allclose(condition[[0, 3]], [0.5, 0.8])
    assert np.isnan(condition[2])


def test_newton_without_a_root_is_nan():
    found = newton(lambda x: (x * x + 1, 2 * x[..., None]), np.array([[0.7], [0.1]]), tolerance=1e-9)
    assert np.isnan(found).all()


@pytest.mark.parametrize("count", [31, 32])
def test_periodic_derivatives_of_a_smooth_function(count):
    t = np.arange(count) * (3.0 / count)
    w = 2 * np.pi / 3.0
    f = np.exp(np.sin(w * t))
    np.testing.assert_allclose(periodic_derivative(f, 3.0), w * np.cos(w * t) * f, atol=1e-10)
    second = w * w * (np.cos(w * t) ** 2 - np.sin(w * t)) * f
    np.testing.assert_allclose(periodic_derivative(f, 3.0, order=2), second, atol=1e-8)
    circle = np.exp(1j * w * t)
    np.testing.assert_allclose(periodic_derivative(circle, 3.0), 1j * w * circle, atol=1e-12)
    assert periodic_mean(np.sin(w * t) ** 2) == pytest.approx(0.5)


def test_two_samples_have_no_derivative():
    with pytest.raises(IlmekError, match="at least 3"):
        periodic_derivative(np.array([0.0, 1.0]))
