"""The lowest point of a quadratic within limits, against one that is found by trying every set of limits."""

import itertools

import numpy as np
import pytest

from ilmek.num.quadratic import LEAST, back_solve, cholesky, limited_step


def _by_trying(H, g, rows, slack):
    """Lowest allowed point over all choices of limits held as equations."""
    n, best, lowest = len(g), np.zeros(len(g)), 0.0
    for count in range(n + 1):
        for held in map(list, itertools.combinations(range(len(slack)), count)):
            A = rows[held]
            whole = np.block([[H, A.T], [A, np.zeros((count, count))]])
            if np.linalg.matrix_rank(whole) < len(whole):
                continue
            s = np.linalg.solve(whole, np.r_[-g, slack[held]])[:n]
            value = 0.5 * s @ H @ s + g @ s
            if (rows @ s <= slack + 1e-9).all() and value < lowest:
                best, lowest = s, value
    return best


@pytest.mark.parametrize("seed", range(20))
def test_limited_step_is_the_best_of_all_active_sets(seed):
    rng = np.random.default_rng(seed)
    n, m = 3, 6
    root = rng.normal(size=(n, n))
    H, g = root @ root.T + 0.1 * np.eye(n), 3 * rng.normal(size=n)
    rows, slack = rng.normal(size=(m, n)), rng.random(m) * (rng.random(m) < 0.7)
    step = np.empty(n)
    held = limited_step(H, g, rows, slack, step)
    assert 0 <= held <= n
    np.testing.assert_allclose(step, _by_trying(H, g, rows, slack), atol=1e-8)


def test_limits_that_say_the_same_twice_are_no_trouble():
    rows = np.array([[1.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0]])
    step = np.empty(2)
    limited_step(np.eye(2), np.array([-3.0, -3.0]), rows, np.array([1.0, 1.0, 2.0, 0.5]), step)
    np.testing.assert_allclose(step, [1.0, 0.5])


def test_a_matrix_that_is_not_positive_definite_is_said():
    step = np.empty(2)
    indefinite = np.array([[1.0, 2.0], [2.0, 1.0]])
    assert limited_step(indefinite, np.ones(2), np.zeros((1, 2)), np.ones(1), step) == -1


def test_cholesky_solves():
    matrix, factor, right = np.array([[4.0, 2.0], [2.0, 3.0]]), np.zeros((2, 2)), np.array([2.0, 5.0])
    assert cholesky(matrix, 2, LEAST, factor)
    x = right.copy()
    back_solve(factor, 2, x)
    np.testing.assert_allclose(matrix @ x, right, atol=1e-14)
