"""What breaks first in a needle mechanism: stresses, pins, shafts and bearings against the speed."""

import pytest

from ilmek.machines.tufting import MACHINE, TuftingParams, design
from ilmek.machines.tufting.strength import NeedleStrength, link_sections, needle_strength
from ilmek.units import rpm


def failed(**settings: str) -> set[str]:
    return {check.name for check in MACHINE.report_for(settings).failed}


def strength(**settings: str) -> NeedleStrength:
    return needle_strength(design(TuftingParams.read(settings)))


def test_the_paper_s_speed_is_borne_and_five_times_it_wears_out_the_crank_s_bush() -> None:
    assert failed() == set()
    assert failed(speed="800rpm") == {"wear of the pins, p v"}
    report = MACHINE.report_for({"speed": "800rpm"})
    (check,) = report.failed
    assert "pin A" in check.source
    assert "lower speed" in check.cure


def test_at_3000_rpm_pins_and_drive_fail() -> None:
    assert failed(speed="3000rpm") >= {"wear of the pins, p v", "pressure of the pins", "a servo turns the main shaft"}


def test_without_backing_and_weight_stresses_go_with_the_square_of_the_speed() -> None:
    free = {"friction_force": "0N", "gravity": "0m/s^2", "strength.pin_diameter": "12mm"}
    slow, fast = strength(speed="200rpm", **free).linkage, strength(speed="600rpm", **free).linkage
    assert fast.link_stress == pytest.approx({name: 9 * one for name, one in slow.link_stress.items()}, rel=1e-9)
    assert fast.pin_wear == pytest.approx(27 * slow.pin_wear, rel=1e-9)
    assert fast.link_frequency == slow.link_frequency


def test_links_are_no_heavier_than_the_masses_given() -> None:
    params = TuftingParams()
    for link, (width, thickness) in link_sections(params).items():
        mass = width * thickness * getattr(params, link) * params.strength.of_links.density
        assert 0.3 * getattr(params, f"{link}_mass") < mass <= getattr(params, f"{link}_mass")


def test_a_bearing_lives_as_long_as_its_cubed_load_says() -> None:
    one = strength()
    assert one.main.life >= one.limits.bearing_life
    thrice = strength(**{"strength.bearing_life": "900000h"})
    assert thrice.main.bearing.dynamic >= one.main.bearing.dynamic
    assert one.linkage.speed == pytest.approx(160 * rpm)


def test_pins_and_shafts_that_do_not_fit_fail() -> None:
    assert "diameter of the pins, over the width of their links" in failed(**{"strength.pin_diameter": "500mm"})
    assert "life of the main shaft's bearings" in failed(**{"strength.shaft_diameter": "400mm"})
