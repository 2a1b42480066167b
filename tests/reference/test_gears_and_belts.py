"""Gears and belts: textbook pairs, the involute's own laws, Hertz against ISO 6336's factors, belts' exact lengths."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.elements.belts import BELTS, BeltDrive, belt_length
from ilmek.elements.gear_pair import GearPair, pair_at
from ilmek.elements.gears import EqualGears, lewis
from ilmek.elements.involute import Gear, involute, involute_angle, least_shift, outline
from ilmek.elements.materials import MATERIALS
from ilmek.errors import ParameterError
from ilmek.plane.teeth import PRESSURE_ANGLE
from ilmek.units import deg, mm

INCH = 0.0254
STEEL = MATERIALS["case-hardened steel"]


def test_norton_example_9_1() -> None:
    """6 teeth an inch, 19 and 37, 20 deg: 4.667 in apart, contact ratio 1.62; 2 % farther apart works at 22.89 deg."""
    module = INCH / 6
    pair = GearPair(Gear(module, 19), Gear(module, 37), INCH)
    assert pair.distance / INCH == pytest.approx(4.667, abs=5e-4)
    assert pair.contact_ratio == pytest.approx(1.62, abs=5e-3)
    assert pair_at(1.02 * pair.distance, module, (19, 37), INCH).pressure_angle / deg == pytest.approx(22.89, abs=0.01)


def test_undercut_begins_at_seventeen_teeth() -> None:
    """z = 2 / sin² 20 deg = 17.097; 14 teeth (DIN's 'practical' limit) need a shift of 0.181."""
    assert [Gear(0.001, teeth).undercut for teeth in (17, 18)] == [True, False]
    assert least_shift(14) == pytest.approx(0.1812, abs=1e-4)
    assert not Gear(0.001, 14, least_shift(14)).undercut


def test_shigley_table_14_2() -> None:
    assert [lewis(teeth) for teeth in (12, 17, 18, 24, 60, 400)] == [0.245, 0.303, 0.309, 0.337, 0.422, 0.480]


@settings(max_examples=25)
@given(st.floats(1e-9, 20.0))
def test_inverse_involute(value) -> None:
    assert involute(involute_angle(value)) == pytest.approx(value, rel=1e-10)


@settings(max_examples=25)
@given(st.integers(12, 60), st.integers(12, 60), st.floats(-0.2, 0.6), st.floats(-0.2, 0.6))
def test_laws_of_a_pair(first, second, shift, other) -> None:
    """Base circles roll with the pair's ratio; the teeth fill the rolling circle without backlash; the roots clear."""
    pair = GearPair(Gear(2 * mm, first, shift), Gear(2 * mm, second, other), 20 * mm)
    one, two = pair.rolling_radii
    assert two / one == pytest.approx(second / first)
    assert one * math.cos(pair.pressure_angle) == pytest.approx(pair.first.base_radius)
    taken = one * float(pair.first.half_thickness(one)) + two * float(pair.second.half_thickness(two))
    assert 2 * taken == pytest.approx(2 * math.pi * one / first)
    tips = pair.tip_radii
    for tip, gear in ((tips[0], pair.second), (tips[1], pair.first)):
        assert pair.distance - tip - gear.root_radius == pytest.approx(0.25 * 2 * mm)


def test_contact_ratio_of_long_gears_tends_to_the_racks() -> None:
    """Two racks: 4 / (π sin 2α) = 1.981 (Niemann)."""
    pair = GearPair(Gear(1 * mm, 200_000), Gear(1 * mm, 200_000), 10 * mm)
    assert pair.contact_ratio == pytest.approx(4 / (math.pi * math.sin(2 * PRESSURE_ANGLE)), rel=1e-4)


def test_general_pair_agrees_with_equal_gears() -> None:
    equal = EqualGears(0.075, 0.001, 74, 0.005)
    pair = pair_at(0.075, 0.001, (74, 74), 0.005)
    assert pair.first.shift + pair.second.shift == pytest.approx(equal.profile_shift)
    assert pair.pressure_angle == pytest.approx(equal.pressure_angle)
    assert pair.bending(2.0) == pytest.approx(equal.bending(equal.force(2.0)))
    with pytest.raises(ParameterError, match=r"allowed|more than 0.069"):
        pair_at(0.065, 0.001, (74, 74), 0.005)


@pytest.mark.parametrize("shifts", [(0.0, 0.0), (0.4, 0.3)])
def test_hertz_pressure_by_the_factors_of_iso_6336(shifts) -> None:
    """ZH = sqrt(2 cos αw / (cos² α sin αw)), ZE = 189.8 sqrt(N/mm²) of steel of 206 GPa; Ft at the reference circle."""
    pair = GearPair(Gear(3 * mm, 21, shifts[0]), Gear(3 * mm, 55, shifts[1]), 30 * mm)
    torque, angle, pitch = 180.0, pair.pressure_angle, 63 * mm
    zone = math.sqrt(2 * math.cos(angle) / (math.cos(PRESSURE_ANGLE) ** 2 * math.sin(angle)))
    elastic = math.sqrt(206e9 / (2 * math.pi * (1 - 0.3**2)))
    assert elastic == pytest.approx(189.8e3, rel=2e-4)
    nominal = zone * elastic * math.sqrt(2 * torque / pitch / (pitch * 30 * mm) * (pair.ratio + 1) / pair.ratio)
    assert pair.pressure(torque, STEEL, STEEL) == pytest.approx(nominal * math.sqrt(210 / 206))


def test_outline_is_a_gear() -> None:
    """Closed about the centre, between root and tip; half of the pitch circle is tooth; flanks are involutes."""
    gear = Gear(4 * mm, 24)
    drawn = outline(gear, points=41)
    assert len(drawn) % 24 == 0
    assert np.min(np.abs(drawn)) == pytest.approx(gear.root_radius)
    assert np.max(np.abs(drawn)) == pytest.approx(gear.tip_radius)
    assert np.sum(np.angle(np.roll(drawn, -1) / drawn)) == pytest.approx(2 * math.pi)
    assert 2 * 24 * float(gear.half_thickness(gear.pitch_radius)) == pytest.approx(math.pi)
    flank = drawn[1:42]
    unrolled = np.sqrt(np.abs(flank) ** 2 - gear.base_radius**2)
    lengths = np.cumsum(np.abs(np.diff(flank)))
    np.testing.assert_allclose(lengths, (unrolled[1:] ** 2 - unrolled[0] ** 2) / (2 * gear.base_radius), rtol=2e-3)


def test_belt_about_equal_pulleys() -> None:
    """L = 2 a + z p; half of the teeth are in mesh."""
    drive = BeltDrive(BELTS["HTD 5M"], 30, 30, 130)
    assert drive.distance == pytest.approx((130 - 30) * 5 * mm / 2)
    assert drive.meshing == pytest.approx(15)
    assert drive.shaft_load(3.0) == pytest.approx(drive.pull(3.0)) == pytest.approx(3.0 / (150 * mm / 2 / math.pi))


@settings(max_examples=15)
@given(st.integers(15, 40), st.integers(0, 60), st.integers(1, 100))
def test_belt_is_as_long_as_its_teeth(small, more, spare) -> None:
    belt, large = BELTS["AT5"], small + more
    radii = (small + large) * belt.pitch / (2 * math.pi)
    least = math.ceil(belt_length(belt, small, large, radii) / belt.pitch)
    drive = BeltDrive(belt, small, large, least + spare)
    assert belt_length(belt, small, large, drive.distance) == pytest.approx(drive.length, rel=1e-9)
    assert 0 < drive.meshing <= small / 2 + 1e-9


def test_belt_width_grows_with_the_torque() -> None:
    drive = BeltDrive(BELTS["AT10"], 20, 20, 100)
    widths = [drive.width_for(torque) for torque in (5.0, 20.0, 60.0, 500.0)]
    assert widths == pytest.approx([16 * mm, 16 * mm, 50 * mm, None])
    assert BeltDrive(BELTS["HTD 8M"], 22, 22, 100).width_for(5.0) is None


def test_impossible_belts_are_refused() -> None:
    with pytest.raises(ParameterError, match="15 or more"):
        BeltDrive(BELTS["AT5"], 10, 20, 100)
    with pytest.raises(ParameterError, match="so that the pulleys do not touch"):
        BeltDrive(BELTS["AT5"], 20, 40, 40)
