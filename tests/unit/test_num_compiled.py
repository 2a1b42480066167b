"""The leaf formulas compiled: the same numbers as on arrays, and NaN where there is no answer."""

import numpy as np

from ilmek.linkage.groups import rrp, rrr
from ilmek.num.compiled import compiled

RNG = np.random.default_rng(7)
A, B = (RNG.normal(size=200) + 1j * RNG.normal(size=200) for _ in range(2))


def test_rrr_position_is_the_same_compiled():
    kernel = compiled(rrr.position)
    with np.errstate(invalid="ignore"):
        on_arrays = rrr.position(A, B, 1.0, 1.5, -1)
    one_by_one = np.array([kernel(a, b, 1.0, 1.5, -1) for a, b in zip(A, B, strict=True)])
    assert 0 < np.isnan(on_arrays).sum() < 200
    np.testing.assert_allclose(one_by_one, on_arrays, rtol=0, atol=1e-13)


def test_rrp_position_is_the_same_compiled():
    kernel = compiled(rrp.position)
    e = np.exp(0.3j)
    with np.errstate(invalid="ignore"):
        on_arrays = rrp.position(A, B, e, 1.2, +1)
    one_by_one = np.array([kernel(a, b, e, 1.2, +1) for a, b in zip(A, B, strict=True)])
    assert 0 < np.isnan(on_arrays).sum() < 200
    np.testing.assert_allclose(one_by_one, on_arrays, rtol=0, atol=1e-13)


def test_division_by_zero_is_infinite_not_an_error():
    kernel = compiled(rrr.first_rate)
    assert np.isinf(kernel(1 + 0j, 1 + 0j, 0.0))
