"""Conics and 3 x 3 pencils by the batch: planted meeting points and roots, double, infinite and absent ones."""

import numpy as np
import pytest

from ilmek.num.conics import meet
from ilmek.num.pencil2 import roots2
from ilmek.num.pencil3 import adjugate, determinant, null_vector, roots3

CIRCLE = np.diag([1.0, 1.0, -1.0])


def line_pair(one: list[float], other: list[float]) -> np.ndarray:
    product = np.outer(one, other).astype(float)
    return product + product.T


@pytest.mark.parametrize(("a", "b", "root"), [("nilpotent", "one", 0.0), ("one", "nilpotent", np.inf)])
def test_a_double_root_at_zero_or_infinity_is_found_twice(a: str, b: str, root: float) -> None:
    matrices = {"nilpotent": np.array([[0.0, 1.0], [0.0, 0.0]]), "one": np.eye(2)}
    found = roots2(matrices[a], matrices[b])
    assert np.hypot(found.numerator, found.denominator) == pytest.approx(1.0)
    with np.errstate(divide="ignore"):
        assert np.abs(found.numerator / found.denominator).tolist() == [root, root]


def test_a_circle_and_two_lines_meet_where_the_lines_cut_it() -> None:
    found = meet(CIRCLE, line_pair([1, 0, -0.6], [0, 1, 0.0]))
    places = (found.points.real / found.points.real[:, 2:])[:, :2]
    assert found.real.all()
    wanted = np.array([[-1, 0], [0.6, -0.8], [0.6, 0.8], [1, 0]])
    np.testing.assert_allclose(places[np.lexsort(places.T[::-1])], wanted, atol=1e-12)


def test_a_line_that_touches_is_told_once() -> None:
    found = meet(CIRCLE, line_pair([1, 0, -1], [0, 1, -5]))
    assert found.real.sum() == 1
    np.testing.assert_allclose(
        (found.points[found.real].real / found.points[found.real].real[:, 2:])[0], [1, 0, 1], atol=1e-6
    )


def test_conics_that_meet_at_infinity_are_met_there() -> None:
    found = meet(line_pair([1, 0, 0], [0, 1, 0]), line_pair([1, 0, -1], [1, 1, -3]))
    infinite = np.abs(found.points[:, 2]) < 1e-9
    assert infinite.sum() == 1
    np.testing.assert_allclose(np.abs(found.points[infinite][0]), [0, 1, 0], atol=1e-9)


def test_conics_with_a_line_in_common_say_so() -> None:
    assert meet(line_pair([1, 0, 0], [0, 1, 0]), line_pair([1, 0, 0], [1, 1, -3])).share
    assert not meet(CIRCLE, line_pair([1, 0, 0], [1, 1, -3])).share


def test_random_conics_meet_in_four_points_none_two_or_four_of_them_real() -> None:
    C, D = np.random.default_rng(6).normal(size=(2, 200, 3, 3))
    C, D = C + np.swapaxes(C, -1, -2), D + np.swapaxes(D, -1, -2)
    found = meet(C, D)
    for conic in (C, D):
        assert np.max(np.abs(np.einsum("nri,nij,nrj->nr", found.points, conic, found.points))) < 1e-12
    assert set(found.real.sum(axis=-1)) == {0, 2, 4}


def test_planted_roots_of_pencils_are_found_infinite_ones_too() -> None:
    random = np.random.default_rng(3)
    left, right = random.normal(size=(2, 100, 3, 3))
    x = random.uniform(-3, 3, size=(100, 3))
    k = np.ones((100, 3))
    x[:50, 0], k[:50, 0] = 1.0, 0.0
    eye = np.eye(3)
    found = roots3(left @ (x[:, None] * eye) @ right, -left @ (k[:, None] * eye) @ right)
    assert found.real.all()
    assert not found.free.any()
    angle = np.sort(np.mod(np.arctan2(found.numerator, found.denominator) + 1e-7, np.pi))
    wanted = np.sort(np.mod(np.arctan2(x, k) + 1e-7, np.pi))
    np.testing.assert_allclose(angle, wanted, atol=1e-6)


def test_a_pencil_that_is_singular_for_every_x_is_free_and_a_double_vector_is_not_alone() -> None:
    rank_two = np.diag([1.0, 2.0, 0.0])
    assert roots3(rank_two, 3 * rank_two + np.diag([1.0, 0, 0])).free
    twice = roots3(np.diag([1.0, 1.0, 5.0]), -np.eye(3))
    ratio = twice.numerator / twice.denominator
    assert not twice.alone[np.abs(ratio - 1) < 1e-6].any()
    assert twice.alone[np.abs(ratio - 5) < 1e-6].all()


def test_adjugate_determinant_and_null_vector_are_those_of_linear_algebra() -> None:
    rows = np.random.default_rng(11).normal(size=(20, 3, 3))
    np.testing.assert_allclose(determinant(rows), np.linalg.det(rows))
    np.testing.assert_allclose(adjugate(rows) @ rows, np.linalg.det(rows)[:, None, None] * np.eye(3), atol=1e-12)
    rows[:, 2] = rows[:, 0] - 2 * rows[:, 1]
    np.testing.assert_allclose(np.einsum("nij,nj->ni", rows, null_vector(rows)), 0, atol=1e-12)
    assert np.linalg.norm(null_vector(rows), axis=-1) == pytest.approx(np.ones(20))
