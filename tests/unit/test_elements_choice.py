"""Choosing elements: bearings for a slope, motors for a torque, stock bars; worms that lock."""

import math

import pytest

from ilmek.elements.bearings import BEARINGS, bearings_for
from ilmek.elements.materials import MATERIALS, find_material, hertz_limit
from ilmek.elements.motors import MOTORS, most_torque, smallest_motor
from ilmek.elements.shafts import (
    SQUARE_SHEAR,
    SQUARE_TORSION,
    STOCK_SIDES,
    side_for_strength,
    side_for_twist,
    square_stress,
    square_twist,
    stock_side,
)
from ilmek.errors import ParameterError
from ilmek.machines import warp_tension
from ilmek.units import GPa, deg, mm, rpm


def test_slope_limits_of_the_bearings() -> None:
    """0.004 deep groove, 0.001 cylindrical, 0.0005 tapered (thesis 3.1)."""
    assert [bearing.slope_limit for bearing in BEARINGS] == [0.004, 0.001, 0.0005]
    assert [len(bearings_for(slope)) for slope in (0.0004, 0.0005, 0.0006, 0.001, 0.003, 0.0041)] == [3, 3, 2, 2, 1, 0]


@pytest.mark.parametrize("torque", [0.1, 0.5, 3.9, 4.0, 7.0, 7.1, 30.0])
def test_smallest_motor_is_enough_and_none_smaller_is(torque) -> None:
    chosen = smallest_motor(torque)
    assert chosen is not None
    assert chosen.torque >= torque
    assert not [motor for motor in MOTORS if torque <= motor.torque and motor.power < chosen.power]


def test_motor_must_also_be_quick_enough() -> None:
    assert smallest_motor(6.0, 1000 * rpm).kind == "servo"
    assert smallest_motor(6.0, 200 * rpm, kind="stepper").name == "stepper NEMA 34, 7 N m"
    assert smallest_motor(6.0, 200 * rpm, kind="servo").speed == pytest.approx(3000 * rpm)
    assert smallest_motor(1e4) is None
    assert smallest_motor(1.0, 9000 * rpm) is None


def test_servo_torque_is_power_over_speed() -> None:
    assert smallest_motor(1.0, 3000 * rpm).torque == pytest.approx(400 / (3000 * rpm))


def test_a_motor_is_taken_by_its_power_not_its_torque() -> None:
    """9.4 N m at 230 rpm: a stepper of 12 N m (377 W), not the servo of 3000 W that has the nearer torque."""
    assert smallest_motor(9.4, 230 * rpm).name == "stepper NEMA 42, 12 N m"
    assert smallest_motor(7.0 * (1 + 1e-12)).torque == 7.0
    assert most_torque(3000 * rpm) == max(m.torque for m in MOTORS if m.speed >= 3000 * rpm)
    assert most_torque(4000 * rpm) == 0.0


@pytest.mark.parametrize(("constant", "power"), [(SQUARE_TORSION, 1), (SQUARE_SHEAR, 2)])
def test_torsion_of_a_square_bar_by_saint_venants_series(constant, power) -> None:
    """J/B^4 = 1/3 - 64/pi^5 sum tanh(k pi/2)/k^5; tau B^3/T = J^-1 (1 - 8/pi^2 sum sech(k pi/2)/k^2); k odd."""
    odd = range(1, 200, 2)
    inertia = 1 / 3 - 64 / math.pi**5 * sum(math.tanh(k * math.pi / 2) / k**5 for k in odd)
    sech = sum(2 * math.exp(-k * math.pi / 2) / (1 + math.exp(-k * math.pi)) / k**2 for k in odd)
    expected = inertia if power == 1 else inertia / (1 - 8 / math.pi**2 * sech)
    assert constant == pytest.approx(expected, abs=1e-6)


def test_least_sides_keep_just_the_twist_and_the_strength() -> None:
    side = side_for_twist(900.0, 6.0, 200 * GPa, 2 * deg)
    assert square_twist(900.0, 6.0, 200 * GPa, side) == pytest.approx(2 * deg)
    side = side_for_strength(2000.0, 900.0, 235e6)
    assert square_stress(2000.0, 900.0, side) == pytest.approx(235e6)
    assert square_stress(2000.0, 0.0, side) == pytest.approx(6 * 2000.0 / side**3)


def test_a_reducer_that_locks_in_theory_only_fails_a_check() -> None:
    reports = [warp_tension.MACHINE.report(design) for design in map(cylinder, (0.45, 0.48, 0.55))]
    locking = [
        next(check for check in report.checks if check.name == "efficiency, to lock itself") for report in reports
    ]
    assert [check.ok for check in locking] == [True, False, False]
    assert "does not lock itself" in reports[2].warnings[0]


def cylinder(efficiency: float) -> warp_tension.WarpTensionDesign:
    return warp_tension.MACHINE.design(warp_tension.WarpTensionParams(efficiency=efficiency))


def test_stock_bars() -> None:
    assert stock_side(69.0098 * mm) == pytest.approx(70 * mm)
    assert stock_side(70 * mm * (1 + 1e-12)) == pytest.approx(70 * mm)
    assert stock_side(max(STOCK_SIDES) + 1 * mm) is None


def test_materials_are_of_their_kind() -> None:
    assert MATERIALS["structural steel"].modulus == 210 * GPa
    for name, material in MATERIALS.items():
        if name != "POM":
            assert 60 * GPa <= material.modulus <= 215 * GPa
            assert 2600 <= material.density <= 9000
        assert " EN " in material.designation
        assert material.strength <= material.tensile
        assert 0.25 < material.poisson < 0.4
        assert material.fatigue is None or 0.1 <= material.fatigue / material.tensile <= 0.45
        assert material.hertz is None or material.hertz > 0.6 * material.strength
    assert MATERIALS["structural steel"].shear_modulus == pytest.approx(80.77 * GPa, rel=1e-3)


def test_the_softer_surface_limits_the_pressure() -> None:
    """ISO 6336-5: case-hardened 1500 MPa, hot-rolled steel HB + 190; no limit is known of austenitic steel."""
    hard, soft, stainless = (
        find_material(name) for name in ("case-hardened steel", "structural steel", "stainless steel")
    )
    assert hertz_limit(hard, soft) == pytest.approx(300e6)
    assert hertz_limit(hard, hard, 1.2) == pytest.approx(1250e6)
    assert hertz_limit(hard, stainless) is None
    with pytest.raises(ParameterError, match="nearest offered is 'structural steel'"):
        find_material("constructional steel")
