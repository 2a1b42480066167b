"""Suprema over a turn."""

import numpy as np
import pytest

from ilmek.arrays import FloatArray
from ilmek.dynamics.peaks import peaks

PLACE = 1.2345678


def curves(angle: FloatArray) -> dict[str, FloatArray]:
    return {
        "smooth": 3 + np.cos(angle - PLACE),
        "size": np.abs(np.cos(angle - PLACE)) + 1e-4 * np.cos(angle - PLACE - np.pi),
        "sharp": 1 / (1.0001 - np.cos(angle - PLACE)),
        "constant": np.full_like(angle, 7.0),
        "at the seam": np.cos(angle),
    }


def test_finds_greatest_values_between_the_samples() -> None:
    found = peaks(curves)
    assert found["smooth"].value == pytest.approx(4.0, rel=1e-12)
    assert found["smooth"].angle == pytest.approx(PLACE, abs=1e-6)
    assert found["sharp"].value == pytest.approx(1e4, rel=1e-6)
    assert found["constant"].value == 7.0
    assert found["at the seam"].value == 1.0


def test_chooses_the_higher_of_two_peaks_that_samples_cannot_tell_apart() -> None:
    coarse = peaks(curves, samples=36)["size"]
    assert coarse.value == pytest.approx(1 + 1e-4, rel=1e-9)
    assert coarse.angle == pytest.approx(PLACE + np.pi, abs=1e-4)
