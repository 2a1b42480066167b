"""Textile mechanics: yarn materials, the shed, the tension between take-ups, the yarn that grippers lead."""

import math

import numpy as np
import pytest

from ilmek.elements.carpet_yarns import CarpetYarnParams, carpet_yarns, usual_warp
from ilmek.elements.yarns import COTTON, SILK, WOOL, usual_warp_density
from ilmek.errors import CarpetError
from ilmek.weaving import ShedWarp, capstan, shed_lengthening, take_up_tension, tension_history, usual_tension
from ilmek.weaving.knots import SampledPath, end_path, knot_of_ends, yarn_between
from ilmek.weaving.tension import bars_needed, compensated_tension


def test_yarn_of_a_material_is_as_thick_stiff_and_strong_as_its_mass_makes_it() -> None:
    """A section of 0.45 wool at 1310 kg/m³; cotton of 2.1 N/tex and 17 cN/tex."""
    assert math.pi / 4 * WOOL.diameter(1e-3) ** 2 * 1310 * 0.45 == pytest.approx(1e-3, rel=1e-14)
    assert COTTON.stiffness(1e-3) == pytest.approx(2100.0)
    assert COTTON.breaking_force(1e-3) == pytest.approx(170.0)
    assert WOOL.breaking_force(1e-3) == pytest.approx(120.0)
    assert WOOL.stiffness(1e-3) == pytest.approx(1000.0)


def test_the_usual_warp_follows_its_pitch() -> None:
    """Wool 3/7 g/m for a millimetre; cotton beyond its table in proportion; silk as thick; tension as the mass."""
    assert usual_warp_density(2e-3, "wool") == pytest.approx(6 / 7 * 1e-3)
    assert usual_warp_density(8e-3) == pytest.approx(2 * usual_warp_density(4e-3))
    assert usual_warp_density(0.25e-3) == pytest.approx(usual_warp_density(0.5e-3) / 2)
    assert SILK.diameter(usual_warp_density(1e-3, "silk")) == pytest.approx(usual_warp(1e-3).diameter)
    assert usual_warp(2e-3).stiffness == pytest.approx(2.1e6 * usual_warp_density(2e-3))
    assert usual_tension(1e-3) == pytest.approx(15 * usual_warp_density(1e-3) / usual_warp_density(2e-3))
    assert usual_tension(2e-3, 2 * usual_warp_density(2e-3)) == pytest.approx(30.0)


def test_what_is_given_of_a_yarn_stays() -> None:
    params = CarpetYarnParams(warp="silk", warp_diameter=0.4e-3, warp_stiffness=3e3, straight_weft_density=1e-3)
    yarns = carpet_yarns(params, 1e-3)
    assert (yarns.warp.material, yarns.warp.diameter, yarns.warp.stiffness) == ("silk", 0.4e-3, 3e3)
    assert yarns.straight_weft.diameter == pytest.approx(COTTON.diameter(1e-3))
    assert yarns.sinuous_weft.linear_density == pytest.approx(yarns.warp.linear_density / 2)


def test_the_shed_lengthens_a_warp_by_both_hypotenuses() -> None:
    lift = np.array([0.0, 0.01, 0.06])
    wanted = np.hypot(0.25, lift) - 0.25 + np.hypot(0.4, lift) - 0.4
    np.testing.assert_allclose(shed_lengthening(lift, 0.25, 0.4), wanted, rtol=1e-12, atol=1e-16)
    assert float(shed_lengthening(0.060, 0.170, 0.170)) == 0.020555127546398926


def test_small_lifts_keep_their_digits() -> None:
    """s²/2 (1/a + 1/b) to first order; the difference of hypotenuse and span would leave 0."""
    assert float(shed_lengthening(1e-9, 0.25, 0.4)) == pytest.approx(0.5e-18 * (4 + 2.5), rel=1e-12)


def test_a_warp_without_stiffness_keeps_its_tension() -> None:
    warp = ShedWarp(15.0, 0.2, 0.2, 0.0)
    assert float(warp.tension_at(0.06)) == 15.0
    assert float(warp.force(0.06)) == pytest.approx(2 * 15 * 0.06 / math.hypot(0.06, 0.2))
    assert warp.work(0.06) == pytest.approx(15 * float(warp.lengthening(0.06)))


def test_tension_between_take_ups_as_of_a_spring() -> None:
    found = take_up_tension(15.0, 1200.0, 0.012, 0.03, 0.02)
    assert found.rest == 15.0
    assert found.woven - found.rest == pytest.approx(1200 * 0.012 * 0.03)
    assert found.shed - found.woven == pytest.approx(24.0)
    rows, tension = tension_history(found, 3, 3)
    assert (len(rows), rows[-1], tension[-1]) == (19, 3.0, 15.0)
    assert tension.max() == pytest.approx(found.shed - (found.woven - found.rest) / 6)


def test_capstan_multiplies_over_angles() -> None:
    assert capstan(0.2, 1.0) * capstan(0.2, 2.0) == pytest.approx(capstan(0.2, 3.0))


WARPS = np.array([0j, 2 + 0j])


def led(samples: int, side: float) -> SampledPath:
    """An end round the outside of its warp to the back, then in the middle between both warps to the front."""
    angle = np.linspace(0.5 * math.pi, 1.5 * math.pi, samples)
    about = (0.0 if side < 0 else 2.0) + 0.9 * (np.cos(angle) * -side + 1j * np.sin(angle))
    up = np.linspace(1 - 0.9j, 1 + 3j, samples)
    arc = math.pi * 0.9 / (samples - 1)
    return end_path([(about, np.full(samples - 1, arc)), (up, np.abs(np.diff(up)))])


def test_two_led_ends_tie_the_symmetric_knot_once_the_samples_are_fine_enough() -> None:
    tried: list[int] = []

    def ends(samples: int) -> tuple[SampledPath, SampledPath]:
        tried.append(samples)
        count = 4 if len(tried) == 1 else samples
        return led(count, -1.0), led(count, 1.0)

    found = knot_of_ends(ends, WARPS, keep_out=0.8)
    assert found.words == "symmetric knot over warps 1 and 2"
    assert tried == [201, 1601]


def test_an_end_that_is_missed_ties_no_knot_and_says_why() -> None:
    def ends(samples: int) -> tuple[SampledPath, SampledPath]:
        raise CarpetError(f"the end is lost at {samples} samples")

    assert knot_of_ends(ends, WARPS).words == "no knot: the end is lost at 12801 samples"


def test_bounds_of_the_yarn_are_never_below_its_chords() -> None:
    short = SampledPath(np.array([0j, 1 + 0j]), np.array([0.5]))
    assert yarn_between(short, short).lengths.tolist() == [1.0, 0.0, 1.0]


def test_a_sprung_back_rest_against_springs_in_series() -> None:
    """Brute force: the bar where its spring and its warps have equal forces; one bar bears both halves of the warps."""
    rate, longer, share = 900.0, 0.02, 0.25
    for bars, lengthenings in ((2, [longer]), (1, [longer, 0.0])):
        at = np.linspace(0.0, longer, 200_001)
        warps = sum(rate * (one - at) for one in lengthenings) / len(lengthenings)
        given = at[np.argmin(np.abs(warps - share * rate * at))]
        high, low = compensated_tension(15.0, rate * longer, bars, share)
        assert high == pytest.approx(15.0 + rate * (longer - given), abs=1e-3)
        assert low == pytest.approx(15.0 if bars == 2 else 15.0 - rate * given, abs=1e-3)


@pytest.mark.parametrize(("gain", "bars"), [(0.0, 1), (13.0, 1), (14.5, 2), (40.0, 2)])
def test_a_bar_for_each_parity_where_one_leaves_too_much(gain: float, bars: int) -> None:
    assert bars_needed(15.0, gain) == bars
