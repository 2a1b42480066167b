"""Pareto's front against its definition, pair by pair; greatest values of curves whose summits are known."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from ilmek.arrays import FloatArray, IntArray
from ilmek.num.pareto import front
from ilmek.num.periodic_maxima import periodic_maxima

# Few different numbers, so that members are often alike in some costs or in all.
costs = hnp.arrays(
    float,
    st.tuples(st.integers(0, 30), st.integers(1, 5)),
    elements=st.one_of(st.integers(0, 4).map(float), st.just(np.nan)),
)


@given(costs)
def test_the_front_is_what_no_other_member_beats(table: FloatArray) -> None:
    usable = table[~np.isnan(table).any(axis=1)]
    for row, unbeaten in zip(table, front(table), strict=True):
        beaten = np.isnan(row).any() or ((usable <= row).all(axis=1) & (usable < row).any(axis=1)).any()
        assert unbeaten == (not beaten)


@pytest.mark.parametrize("kinds", [2, 3, 4])
def test_long_fronts_are_found_whole_across_blocks(kinds: int) -> None:
    along = np.random.default_rng(kinds).uniform(size=3000)
    dear = along + 1.0
    table = np.stack([along, -along, along**2, np.sin(9 * along)], axis=1)[:, :kinds]
    # A copy of every member, a little dearer in everything, behind the front.
    found = front(np.concatenate([table + 1e-9 * dear[:, None], table]))
    assert found[3000:].all()
    assert not found[:3000].any()


@given(st.floats(0, 6.28), st.floats(1e-3, 2.0), st.floats(0.0, 6.28))
def test_a_narrow_peak_at_a_sharp_angle_is_climbed(centre: float, width: float, off: float) -> None:
    def curves(row: IntArray, angle: FloatArray) -> dict[str, FloatArray]:
        far = 1 - np.cos(angle - centre - 0.1 * width)
        return {
            "peak": 3.0 * (row + 1) / (1 + far / width**2),
            "wave": np.cos(angle - off) + 0 * row,
            "flat": 0 * angle,
        }

    found = periodic_maxima(curves, np.full((2, 1), centre))
    np.testing.assert_allclose(found["peak"], [3.0, 6.0], rtol=1e-8)
    np.testing.assert_allclose(found["wave"], 1.0, rtol=1e-9)
    assert found["flat"].tolist() == [0.0, 0.0]


def test_the_higher_of_two_rivals_wins_though_samples_favour_the_lower() -> None:
    def curves(_row: IntArray, angle: FloatArray) -> dict[str, FloatArray]:
        high, low = np.exp(-((angle - 2.0) ** 2) * 20), np.exp(-((angle - 4.0) ** 2) * 20)
        return {"two": high + 0.999 * low}

    # The lower one has a sample on its top.
    assert periodic_maxima(curves, np.array([[4.0]]))["two"][0] == pytest.approx(1.0, rel=1e-9)


def test_a_curve_that_is_not_finite_has_no_greatest_value() -> None:
    def curves(_row: IntArray, angle: FloatArray) -> dict[str, FloatArray]:
        return {"broken": np.where(angle > 3, np.nan, angle)}

    assert np.isnan(periodic_maxima(curves, np.zeros((1, 1)))["broken"]).all()
