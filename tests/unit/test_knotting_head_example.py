"""The example that draws the knotting head for the documentation."""

import math

import pytest
from examples.draw_knotting_head import OUT, figures, head

from ilmek.viz.svg import svg


def test_its_needle_keeps_what_the_formula_says_and_the_drawings_are_there() -> None:
    made = head()
    section = made.section
    tilt = math.atan2(1.0, 2.0)
    assert section.outer * math.cos(tilt) == pytest.approx(section.warp + section.needle + section.yarn, rel=1e-9)
    assert made.clearance_min == pytest.approx(section.yarn / 2, abs=1e-9)
    for name, drawing in figures(made).items():
        assert "<svg" in svg(drawing)
        assert (OUT / f"{name}.svg").is_file()
