"""The example that draws the knotting head for the documentation."""

import math

import pytest
from examples.draw_knotting_head import OUT, figures, head

from ilmek.units import mm
from ilmek.viz.svg import svg


def test_its_needle_keeps_what_the_formula_says_and_the_drawings_are_there() -> None:
    made = head()
    tilt = math.atan2(2.0, 4.0)
    assert made.clearance_min / mm == pytest.approx(math.cos(tilt) - 0.65, abs=1e-9)
    for name, drawing in figures(made).items():
        assert "<svg" in svg(drawing)
        assert (OUT / f"{name}.svg").is_file()
