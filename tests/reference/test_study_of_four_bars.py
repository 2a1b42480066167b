"""Studies of a four-bar against its least transmission angle in closed form, at both positions in line with the frame.

cos mu = (b² + c² - (d ∓ a)²) / (2 b c),  of mu and its supplement the lesser
"""

import numpy as np
import pytest
from study_targets import FOUR_BAR

import ilmek
from ilmek.arrays import FloatArray
from ilmek.io.mechanism_file import MechanismFile, parse_mechanism
from ilmek.jobs.study.report import study_report
from ilmek.report import Plot
from ilmek.units import deg

ROCKER, FRAME = 0.23, 0.3


@pytest.fixture(scope="module")
def four_bar() -> MechanismFile:
    """The four-bar of the studies."""
    return parse_mechanism(FOUR_BAR)


def least_angle(a: FloatArray, b: FloatArray) -> FloatArray:
    """The least transmission angle [rad] by crank a and coupler b [m]."""
    ends = [np.arccos((b**2 + ROCKER**2 - (FRAME + side * a) ** 2) / (2 * b * ROCKER)) for side in (-1, 1)]
    return np.min([np.minimum(end, np.pi - end) for end in ends], axis=0)


def test_the_best_coupler_is_that_of_the_centric_crank_rocker(four_bar: MechanismFile) -> None:
    """Both angles are equal where a² + d² = b² + c²; then cos mu = a d / (b c)."""
    found = ilmek.optimise(four_bar, {"b": "190mm..215mm"}, "most transmission_angle_min", samples=64)
    (best,) = found.front
    coupler = np.sqrt(0.06**2 + FRAME**2 - ROCKER**2)
    assert found.values("b")[best] == pytest.approx(coupler, rel=1e-4)
    expected = np.arccos(0.06 * FRAME / (coupler * ROCKER))
    assert found.values("transmission_angle_min")[best] == pytest.approx(expected, rel=1e-4)


def test_lines_of_a_surface_are_where_the_result_has_their_value(four_bar: MechanismFile) -> None:
    ranges = {"a": "40mm..60mm", "b": "185mm..197mm", "weight": "0.3kg..0.5kg"}
    found = ilmek.study(four_bar, ranges, record=["transmission_angle_min"], samples=256)
    angles = found.values("transmission_angle_min")  # computed as arrays
    assert angles == pytest.approx(least_angle(found.values("a"), found.values("b")), rel=1e-12)
    (plot,) = (one for one in study_report(found).figures if one.name == "study-surface-transmission_angle_min")
    assert isinstance(plot, Plot)
    assert (plot.x.label, plot.y.label) == ("a", "b")  # the weight does nothing to it
    assert len(plot.series) >= 3
    for line in plot.series:
        drawn = np.isfinite(line.x)
        x, y = line.x[drawn], line.y[drawn]
        assert len(x) > 1
        assert least_angle(x, y) == pytest.approx(float(line.label.split()[0]) * deg, abs=0.02 * deg)
