"""The example that draws every kind of cam, and the cam that is a four-bar."""

import numpy as np
import pytest
from examples.draw_cams import CIRCLE, KINDS, SHIFT, arm_on_circle, four_bar_drawing


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_every_kind_is_drawn_with_its_roller_or_face_on_it(kind) -> None:
    drawing = kind()
    points = np.concatenate([stroke.points for stroke in drawing.strokes])
    assert np.isfinite(points).all()
    assert 0.05 < np.ptp(points.real) < 0.4


def test_pressure_angle_is_the_transmission_angles_and_the_pitch_curve_the_couplers_circle() -> None:
    trace, leaning = arm_on_circle(np.linspace(0.0, 2 * np.pi, 73))
    np.testing.assert_allclose(np.abs(trace.pressure_angle), leaning, atol=1e-12)
    np.testing.assert_allclose(np.abs(trace.surface - SHIFT), CIRCLE, rtol=1e-12)
    assert {stroke.label for stroke in four_bar_drawing().strokes} >= {"crank", "coupler", "rocker", "cam"}
