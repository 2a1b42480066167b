"""Figures of elements: gears that mesh without cutting into one another, a beam's lines in both planes."""

import math

import numpy as np
import pytest
from examples.draw_gears import OUT, gear_drawing, pair

from ilmek.elements.involute import outline


@pytest.mark.parametrize("turned", [0.0, 0.1, 0.37, 0.5])
def test_flanks_touch_and_never_cut(turned) -> None:
    """At any turn the first gear's points lie outside of the second's teeth, and one touches: conjugate flanks."""
    gears = pair()
    pitch = 2 * math.pi / gears.first.teeth
    first = outline(gears.first, gears.tip_radii[0], points=200) * np.exp(1j * turned * pitch)
    seen = (first - gears.distance) * np.exp(-1j * (math.pi / gears.second.teeth + math.pi))
    seen = seen * np.exp(1j * turned * pitch / gears.ratio)
    near = seen[(np.abs(seen) < gears.tip_radii[1]) & (np.abs(seen) > gears.second.base_radius)]
    step = 2 * math.pi / gears.second.teeth
    from_tooth = np.abs((np.angle(near) + step / 2) % step - step / 2)
    room = (from_tooth - gears.second.half_thickness(np.abs(near))) * np.abs(near)
    assert -2e-7 < np.min(room) < 2e-5


def test_gears_of_the_drawing_stand_at_their_distance() -> None:
    gears = pair()
    drawn = gear_drawing(gears)
    assert gears.distance == pytest.approx(0.070)
    assert not gears.first.undercut
    assert [abs(dot.at) for dot in drawn.dots] == pytest.approx([0, 0.070])
    assert f"contact ratio {gears.contact_ratio:.3f}" in drawn.note
    assert (OUT / "gear-pair.svg").exists()
