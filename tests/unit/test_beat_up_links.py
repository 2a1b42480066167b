"""Links of the beat-up as made: one material, one density, holes for the pins that bear, members with the same pins."""

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.elements.materials import MATERIALS
from ilmek.elements.pin_joints import PIN_DIAMETERS
from ilmek.machines.beat_up import MACHINE, BeatUp, BeatUpParams, design
from ilmek.machines.beat_up.strength import beat_up_strength_checks
from ilmek.machines.beat_up.use_params import CastLinkParams
from ilmek.machines.linkage_strength import pin_checks


def _pinned(params: BeatUpParams, diameter: float) -> BeatUp:
    return design(replace(params, strength=replace(params.strength, pin_diameter=diameter)))


@settings(max_examples=10)
@given(st.floats(10.0, 60.0), st.floats(1.0, 60.0), st.sampled_from(["made", "bars"]))
def test_pins_bear_the_links_that_are_bored_for_them(speed: float, mass: float, link_mass: str) -> None:
    """The links of a design are bored for its pins; the next smaller pins of stock, with links of their own, fail."""
    params = BeatUpParams(speed=speed, beater_mass=mass, width=0.04, thickness=0.02, link_mass=link_mass)
    made = design(params)
    pin = made.pin
    assert made.strength.found.pin_diameter == made.hole == pin
    assert {section.hole for section in made.strength.found.sections.values()} == {pin}
    assert made.masses == pytest.approx(_pinned(params, pin).masses, rel=1e-12)
    smaller = [size for size in PIN_DIAMETERS if size < pin]
    if smaller:
        other = _pinned(params, smaller[-1]).strength.found
        assert not all(check.ok for check in pin_checks(other.pins, other.limits))


def test_the_member_that_limits_choose_keeps_them_with_its_own_pins() -> None:
    made = design(BeatUpParams.read({"torque_max": "60Nm", "speed": "40rad/s", "objective": "force_at_beat"}))
    assert made.strength.found.pin_diameter > PIN_DIAMETERS[0]
    assert made.drive_torque_max == pytest.approx(60.0, rel=1e-6)
    assert all(check.ok for check in MACHINE.report(made).checks if "torque_max" in check.name)


def test_one_material_with_one_density() -> None:
    assert BeatUpParams().link_material is MATERIALS["grey cast iron"]
    given_density = BeatUpParams(density=7210.0).link_material
    assert (given_density.designation, given_density.density) == ("EN-GJL-250 EN 1561", 7210.0)
    steel = design(BeatUpParams(strength=CastLinkParams(material="structural steel")))
    cast = design(BeatUpParams())
    for link, mass in steel.masses.items():
        assert mass / cast.masses[link] == pytest.approx(7850 / 7200, rel=1e-12)


def test_pins_that_run_into_one_another_fail_a_check() -> None:
    made = design(BeatUpParams(strength=CastLinkParams(pin_diameter=0.05)))
    failed = {check.name for check in beat_up_strength_checks(made.strength) if not check.ok}
    assert "distance of the pins of a link, over their diameter" in failed
