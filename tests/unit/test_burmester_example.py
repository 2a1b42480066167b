"""The example that draws the curves of four poses draws links that take them."""

import numpy as np
from examples.draw_burmester import ANGLES, MIDDLE, POINTS, WINDOW, figure

from ilmek.synthesis.burmester.curve import burmester_curve


def test_the_drawn_link_is_as_long_at_every_pose_and_the_curves_stay_in_the_window() -> None:
    drawing = figure(burmester_curve(POINTS, ANGLES))
    pivot, *pins = (dot.at for dot in drawing.dots)
    assert np.ptp(np.abs(np.array(pins) - pivot)) < 1e-12
    curves = [stroke for stroke in drawing.strokes if stroke.role == "path"]
    assert {stroke.label for stroke in curves} == {"pivots", "pins"}
    assert all(np.max(np.abs(stroke.points - MIDDLE)) < WINDOW for stroke in curves)
