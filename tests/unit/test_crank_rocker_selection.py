"""Choice of a crank-rocker: the three criteria, and what is said where none exists."""

import math

import numpy as np
import pytest

from ilmek.errors import ParameterError
from ilmek.synthesis.crank_rocker.dead_centres import (
    best_ratio,
    links_of_ratio,
    ratio_limits,
    rotation_limits,
    transmission_angle_min,
)
from ilmek.synthesis.crank_rocker.selection import CENTRIC, member, select_ratio
from ilmek.units import deg


def test_chooses_the_greatest_ratio_up_to_0_3_on_the_centric_curve() -> None:
    chosen = member(30 * deg)
    assert chosen.crank / chosen.coupler == pytest.approx(0.3, rel=1e-14)
    assert chosen.beta / deg == pytest.approx(48.229920, abs=5e-7)
    assert float(transmission_angle_min(chosen.links)) / deg == pytest.approx(67.136707, abs=5e-7)


def test_lowers_the_ratio_where_the_transmission_angle_asks_for_it() -> None:
    for rotation in np.linspace(106, 284, 90) * deg:
        ratio = select_ratio(30 * deg, rotation)
        least = max(0.1, float(ratio_limits(30 * deg, rotation).low))
        ratios = np.linspace(least, 0.3, 4001)[1:-1] if least < 0.3 else np.array([])
        angles = transmission_angle_min(links_of_ratio(30 * deg, rotation, ratios))
        wanted = next((limit for limit in (50 * deg, 40 * deg) if np.max(angles, initial=0) > limit), None)
        if wanted is not None:
            assert ratio == pytest.approx(ratios[angles >= wanted].max(), abs=1e-4)
        else:
            best = max(best_ratio(30 * deg, rotation), 0.1)
            assert ratio == pytest.approx(best)


def test_the_centric_linkage_has_the_best_transmission_angle_at_any_ratio() -> None:
    for swing in np.array([5, 30, 60, 120, 170]) * deg:
        low, high = rotation_limits(swing)
        rotations = np.linspace(low, high, 2003)[1:-1]
        for ratio in (0.1, 0.3, 0.6):
            exists = ratio_limits(swing, rotations).low < ratio
            angles = transmission_angle_min(links_of_ratio(swing, rotations[exists], ratio))
            assert np.max(angles) <= float(transmission_angle_min(links_of_ratio(swing, CENTRIC, ratio))) + 1e-12


@pytest.mark.parametrize(
    ("swing", "rotation", "beta", "said"),
    [
        (30, 100, None, "above 105 deg, below 285 deg"),
        (30, 290, None, "above 105 deg, below 285 deg"),
        (0, 180, None, "above 0 deg, below 180 deg"),
        (30, 160, 20, "above 20 deg, below 75 deg"),
        (30, 160, 80, "above 20 deg, below 75 deg"),
        (30, 180, 75, "above 0 deg, below 75 deg"),
        (30, 200, -1, "above 0 deg, below 75 deg"),
        (30, 230, 70, "above 75 deg, below 130 deg"),
        (30, 210, 70, "only 75 deg"),
    ],
)
def test_says_the_allowed_interval_in_degrees(swing: float, rotation: float, beta: float | None, said: str) -> None:
    with pytest.raises(ParameterError) as refused:
        member(swing * deg, rotation * deg, None if beta is None else beta * deg)
    assert said in str(refused.value)
    assert "radians" not in str(refused.value)


def test_guesses_degrees_typed_as_radians() -> None:
    with pytest.raises(ParameterError, match="a bare number is in radians"):
        member(30 * deg, math.pi, 48.0)


def test_beta_may_be_repeated_where_it_is_forced() -> None:
    assert member(30 * deg, 210 * deg, 75 * deg) == member(30 * deg, 210 * deg)


@pytest.mark.parametrize("swing", [0.2, 0.5, 1.0])
@pytest.mark.parametrize("limit", [0.1, 0.3, 0.5, 0.8])
def test_the_selected_ratio_is_the_limit_or_has_the_transmission_angle_required(swing: float, limit: float) -> None:
    """50 degrees, and 40 degrees where no ratio has 50: the least transmission angle falls above the selected ratio."""
    ratio = select_ratio(swing, CENTRIC, limit)
    least = float(transmission_angle_min(links_of_ratio(swing, CENTRIC, ratio)))
    if ratio == limit:
        assert least >= math.radians(50)
    else:
        assert least == pytest.approx(math.radians(50), abs=1e-9)
        assert ratio < limit
