"""Piecewise smooth functions: suprema and integrals of a turn."""

import numpy as np
import pytest

from ilmek.arrays import FloatArray
from ilmek.num.piecewise import around, crossings, roots, suprema, supremum

PLACE = 1.2345678


def curves(angle: FloatArray, _: FloatArray) -> dict[str, FloatArray]:
    return {
        "smooth": 3 + np.cos(angle - PLACE),
        "size": np.abs(np.cos(angle - PLACE)) + 1e-4 * np.cos(angle - PLACE - np.pi),
        "sharp": 1 / (1.0001 - np.cos(angle - PLACE)),
        "constant": np.full_like(angle, 7.0),
        "at the seam": np.cos(angle),
    }


def test_finds_greatest_values_between_the_samples() -> None:
    found = suprema(curves, around())
    assert found["smooth"].value == pytest.approx(4.0, rel=1e-12)
    assert found["smooth"].at == pytest.approx(PLACE, abs=1e-6)
    assert found["sharp"].value == pytest.approx(1e4, rel=1e-6)
    assert found["constant"].value == 7.0
    assert found["at the seam"].value == 1.0


def test_chooses_the_higher_of_two_peaks_that_samples_cannot_tell_apart() -> None:
    coarse = suprema(curves, around(), samples=36)["size"]
    assert coarse.value == pytest.approx(1 + 1e-4, rel=1e-9)
    assert coarse.at == pytest.approx(PLACE + np.pi, abs=1e-4)


def test_a_curve_that_is_nan_somewhere_has_no_supremum() -> None:
    assert np.isnan(supremum(lambda x: np.where(x > 1.5, np.nan, x), np.array([0.0, 1.0, 2.0])).value)
    assert supremum(lambda x: np.where(x > 1.5, np.inf, x), np.array([0.0, 1.0, 2.0])).value == np.inf


def test_a_jump_across_the_level_is_no_crossing() -> None:
    def curve(x: FloatArray, side: FloatArray) -> FloatArray:
        return np.where(np.mod(x + 1e-9 * side, 2 * np.pi) < 3.0, x - 1.0, -1.0)

    np.testing.assert_allclose(crossings(curve, around([0.0, 3.0])), [1.0], rtol=1e-14)


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ((-1.0, 0.0, 0.0, 1.0), [2.0]),  # the last zero of a stretch
        ((1.0, 0.0, 1.0, 1.0), []),  # touches
        ((0.0, 1.0, 1.0, 0.0), [0.0]),  # the first node counts, the last does not
        ((0.0, 0.0, 0.0, 0.0), []),
        ((-1.0, 1.0, np.nan, -1.0), [0.5]),
    ],
)
def test_zeros_at_nodes(values: tuple[float, ...], expected: list[float]) -> None:
    nodes = np.arange(4.0)
    np.testing.assert_allclose(roots(lambda x: np.interp(x, nodes, values), nodes), expected, rtol=1e-14)
