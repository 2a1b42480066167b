"""The example that draws the four-bars of two how-to pages gives what the pages say."""

import pytest
from examples.draw_four_bars import figure, function, motion

from ilmek.report import Drawing, Plot
from ilmek.units import deg


def test_the_flap_is_carried_through_four_poses_and_four_bars_that_are_too_large_are_left_out() -> None:
    said = motion()
    results = said.as_json()["results"]
    assert results["found"] > 1000
    assert results["left_out"]["size"] > 1000
    assert results["size"] <= 0.2 * (1 + 1e-9)
    drawn, curves = figure(said, "motion-four-bar"), figure(said, "motion-four-bar-curves")
    assert isinstance(drawn, Drawing)
    assert isinstance(curves, Drawing)
    assert {"1", "2", "3", "4", "A0", "B0"} <= {dot.label for dot in drawn.dots}
    assert {"pivots", "pins"} <= {stroke.label for stroke in curves.strokes}


def test_the_power_is_generated_to_the_error_that_is_said() -> None:
    said = function()
    results = said.as_json()["results"]
    assert f"{results['error_max'] / deg:.4f}" == "0.0172"
    assert results["removed"][0]["reasons"]["link_ratio"].startswith("longest link 10.73 times the shortest")
    assert len(results["solutions"][0]["extremes"]) == 6
    shown = figure(said, "function-four-bar-error")
    assert isinstance(shown, Plot)
    assert max(shown.series[0].y) == pytest.approx(results["error_max"], rel=1e-3)
