"""Interval arithmetic encloses exact results; Krawczyk's operator proves what is true and nothing else."""

from fractions import Fraction
from math import isqrt

import numpy as np

from ilmek.num.intervals import Intervals, stacked
from ilmek.num.krawczyk import certified_roots


def fractions(values: np.ndarray) -> list[Fraction]:
    return [Fraction(float(one)) for one in values]


def test_results_enclose_the_exact_ones() -> None:
    rng = np.random.default_rng(0)
    a, b = rng.normal(size=(2, 300)) * 10.0 ** rng.integers(-9, 9, (2, 300))
    one, other = Intervals.of(a), Intervals.of(b)
    exact = {
        "sum": (one + other, [x + y for x, y in zip(fractions(a), fractions(b), strict=True)]),
        "difference": (one - other, [x - y for x, y in zip(fractions(a), fractions(b), strict=True)]),
        "product": (one * other, [x * y for x, y in zip(fractions(a), fractions(b), strict=True)]),
        "square": (one.square, [x * x for x in fractions(a)]),
    }
    for name, (found, true) in exact.items():
        rows = zip(fractions(found.low), true, fractions(found.high), strict=True)
        assert all(low <= value <= high for low, value, high in rows), name


def test_products_of_intervals_with_all_signs() -> None:
    ends = np.array([-2.0, -1.0, 0.0, 1.0, 3.0])
    pairs = [(low, high) for low in ends for high in ends if low <= high]
    for low, high in pairs:
        for under, over in pairs:
            found = Intervals(np.array(low), np.array(high)) * Intervals(np.array(under), np.array(over))
            points = np.outer(np.linspace(low, high, 7), np.linspace(under, over, 7))
            assert found.low <= points.min() <= points.max() <= found.high


def square_root(X: Intervals) -> tuple[Intervals, Intervals]:
    """x² = 2, and of a second unknown y (y - 1) = -1/4, a double root."""
    x, y = X[..., 0], X[..., 1]
    zero = Intervals.of(np.zeros(x.low.shape))
    f = stacked([x.square - 2.0, y * (y - 1.0) + 0.25], -1)
    return f, stacked([stacked([x * 2.0, zero], -1), stacked([zero, y * 2.0 - 1.0], -1)], -2)


def only_root(X: Intervals) -> tuple[Intervals, Intervals]:
    return X.square - 2.0, (X * 2.0)[..., None]


def test_the_proven_distance_contains_the_exact_root() -> None:
    exact = Fraction(isqrt(2 * 10**60), 10**30)
    near = np.sqrt(2) + np.array([0.0, 1e-12, -1e-9, 1e-6])[:, None]
    found = certified_roots(only_root, near)
    assert found.certified.all()
    for value, radius in zip(found.roots[:, 0], found.radius[:, 0], strict=True):
        assert abs(Fraction(float(value)) - exact) <= Fraction(float(radius))
        assert radius < 1e-14


def test_a_double_root_and_points_far_from_a_root_are_not_certified() -> None:
    assert not certified_roots(square_root, np.array([[2**0.5, 0.5]])).certified.any()
    assert not certified_roots(only_root, np.array([[0.1], [0.0], [np.nan]])).certified.any()
