"""The example that draws error curves gives what the documentation says."""

import numpy as np
import pytest
from examples.draw_approximation import best, figure

from ilmek.units import deg


def test_the_drawn_minimax_alternates_six_times_at_its_bound():
    found = {"minimax": best("minimax"), "interpolation": best("interpolation")}
    drawing = figure(found)
    assert [mark.label for mark in drawing.marks] == list("123456")
    assert found["minimax"].greatest / deg == pytest.approx(0.0122, abs=5e-5)
    assert found["interpolation"].greatest / deg == pytest.approx(0.0277, abs=5e-5)
    # Chebyshev's places spread the error nearly evenly: free start angles gain most, the criterion the rest.
    assert found["minimax"].proven
    assert np.nanmax(np.abs(drawing.series[-1].y)) == pytest.approx(found["minimax"].greatest, rel=1e-6)
