"""Three cylinders under the warps and their own weight; bearings, shaft ends, slots; the tension over a row."""

import math
from functools import cache

import numpy as np
import pytest
from cloths import cloth
from hypothesis import given
from hypothesis import strategies as st

from ilmek.elements.beam.model import Beam, LineLoad
from ilmek.elements.beam.solve import bend
from ilmek.elements.bearings import find_bearing
from ilmek.elements.carpet_yarns import usual_warp
from ilmek.elements.tubes import TUBES
from ilmek.elements.yarns import usual_warp_density
from ilmek.errors import ParameterError
from ilmek.machines.warp_tension import MACHINE, WarpTensionDesign, WarpTensionParams
from ilmek.machines.warp_tension.analysis import history, tension_of
from ilmek.machines.warp_tension.attachment import ATTACHMENT_BAR, on_cylinder, slot_stress
from ilmek.machines.warp_tension.cylinders import STUB, cylinders, shaft_end, slots_of, spacer_load, tension_beyond
from ilmek.machines.warp_tension.design import keeps_limits, lightest_tube, worst_load
from ilmek.machines.warp_tension.slot import depth, diameter, slotted, width
from ilmek.part.part import Part
from ilmek.units import deg, mm, turn
from ilmek.weaving.shed import shed_lengthening


@cache
def usual() -> WarpTensionDesign:
    return MACHINE.design(WarpTensionParams())


def results(**settings: str) -> dict:
    return MACHINE.report(MACHINE.design(WarpTensionParams.read(settings))).as_json()["results"]


def failed(**settings: str) -> list[str]:
    return [check.name for check in MACHINE.report(MACHINE.design(WarpTensionParams.read(settings))).failed]


def test_the_weight_adds_above_and_relieves_below() -> None:
    upper, lower, _ = cylinders(usual())
    worst = usual().loads.worst / 1.2
    assert abs(upper.load) == pytest.approx(worst + usual().self_weight)
    assert abs(lower.load) == pytest.approx(worst - usual().self_weight)
    assert upper.deflection == pytest.approx(usual().deflection_loaded)
    assert upper.deflection_bare == lower.deflection_bare == pytest.approx(usual().deflection * worst / usual().load)


def test_the_three_cases_of_the_loads_by_hand() -> None:
    """600 warps of 15 N, half of them lifted, at the beat 10 N more, of which the cloth takes three quarters."""
    rate = usual_warp(2 * mm).stiffness / 1.5
    lifted = 15 + rate * (0.004 * 0.03 + 2 * (math.hypot(0.17, 0.06) - 0.17))
    loads = usual().loads
    assert loads.cases == pytest.approx({"standing": 15.0, "shed open": (lifted + 15) / 2, "beat": 15 + 10 / 4})
    assert loads.worst == pytest.approx(300 * (lifted + 15))
    assert (loads.worst_case, loads.worst_tension) == ("shed open", pytest.approx(lifted))


@given(least=st.floats(16.0, 60.0), more=st.floats(0.1, 30.0))
def test_more_tension_in_the_shed_never_relieves_a_cylinder(least: float, more: float) -> None:
    one, other = (MACHINE.design(WarpTensionParams(tension_shed=tension)) for tension in (least, least + more))
    assert one.loads.worst <= other.loads.worst
    assert one.slope == other.slope
    for weak, strong in zip(cylinders(one), cylinders(other), strict=True):
        assert weak.bearing.static <= strong.bearing.static


def test_the_worst_case_is_checked_where_standing_warps_would_pass() -> None:
    """608 warps of 15 N and 39.8 N when lifted: the pull is 16.7 kN, not 9.1 kN."""
    loom = {"cloth.warps": "608", "width": "1.316m", "spacer_tube": "114.3x6.3", "bearing": "UCF 207"}
    held = failed(**loom, tension_shed="15N", tension_beat="15N")
    assert held == []
    worst = failed(**loom, tension_shed="39.8N")
    assert {"deflection of the spacer", "static safety, UCF 207"} <= set(worst)


@pytest.mark.parametrize("wrap", [0, 60, 90, 180])
def test_the_spacer_bears_both_strands(wrap: float) -> None:
    load = spacer_load(WarpTensionParams(spacer_wrap=wrap * deg), 7500.0)
    assert abs(load) == pytest.approx(2 * 7500.0 * math.sin(wrap * deg / 2), abs=1e-9)
    assert load.real <= 1e-9
    assert load.imag <= 1e-9


def test_every_cylinder_bends_as_a_beam_of_its_section() -> None:
    """Against the general beam with the same complex load."""
    width, modulus = usual().params.span, usual().params.modulus
    for one in cylinders(usual()):
        rigidity = modulus * math.pi / 4 * (one.outer**4 - one.inner**4)
        bent = bend(Beam(width, (0.0, width), (LineLoad(0.0, width, one.load),)))
        assert bent.deflection_max(rigidity).size == pytest.approx(one.deflection, rel=1e-9)
        assert bent.slope_at_supports(rigidity).size == pytest.approx(one.slope, rel=1e-9)


def test_the_lightest_stock_tube_is_the_lightest_that_keeps_the_limits() -> None:
    found = lightest_tube(usual().params, TUBES.values())
    assert keeps_limits(usual().params, found.inner_radius, found.outer_radius, worst_load(usual().params))
    assert results(tube="lightest")["cylinder_tube"]["upper"] == found.name
    assert results(tube="140 x 5")["deflection"] == pytest.approx(usual().deflection)
    assert found.area < math.pi * (0.070**2 - 0.065**2)


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"tube": "141x5"}, "the nearest offered is '140x5'"),
        ({"bearing": "UCF 270"}, "the nearest offered is 'UCF"),
        ({"tube": "140x5", "outer_radius": "70mm"}, "leave the radii out"),
    ],
)
def test_what_is_not_in_the_tables_is_said_with_the_nearest(settings: dict[str, str], said: str) -> None:
    with pytest.raises(ParameterError) as caught:
        results(**settings)
    assert said in str(caught.value)


def test_slots_that_cut_through_and_tubes_that_are_too_weak_fail_their_checks() -> None:
    assert "metal under the slots" in failed(spacer_tube="110x5", slot_depth="6mm")
    assert {"slope in the bearings", "deflection"} <= set(failed(tube="lightest", width="20m"))


def test_the_thesis_bearing_lives_long_and_stands_safe() -> None:
    """UCF 207: C 25.7 kN, C0 15.4 kN; 4.6 kN with the tube's weight, the warps standing."""
    found = results(tension_shed="15N", tension_beat="15N")
    load = found["cylinder_reaction"]["upper"]
    assert found["bearing"]["upper"] == "UCF 207"
    assert found["bearing_life"]["upper"] == pytest.approx((25700 / load) ** 3 * 1e6)
    assert found["bearing_static_safety"]["upper"] == pytest.approx(15400 / load)
    turns = 0.004 / (turn * 0.070) / 150.0
    assert found["bearing_time"]["upper"] == pytest.approx(found["bearing_life"]["upper"] / turns)


WIDE = {"cloth.warps": "3200", "cloth.warp_pitch": "1.25mm"}


def test_a_wide_loom_takes_larger_bearings_and_small_ones_fail() -> None:
    wide = results(**WIDE)
    assert find_bearing(wide["bearing"]["upper"]).static >= 1.5 * wide["cylinder_reaction"]["upper"]
    assert "static safety, UCF 207" in failed(**WIDE, bearing="UCF 207")


def test_stress_of_a_shaft_end() -> None:
    bending, twisting = 32 * 4500 * 0.04 / (math.pi * 0.035**3), 16 * 630 / (math.pi * 0.035**3)
    assert shaft_end(usual().params, 4500.0, 630.0, 0.035).stress == pytest.approx(
        math.hypot(bending, math.sqrt(3) * twisting)
    )


@pytest.mark.parametrize("pitch", ["0.5mm", "2mm", "10mm"])
def test_slots_have_the_warps_pitch_and_leave_metal(pitch: str) -> None:
    slots = slots_of(WarpTensionParams.read({"cloth.warp_pitch": pitch}))
    assert slots.warp < slots.width < slots.pitch
    assert slots.depth == slots.warp


def test_slots_that_do_not_fit_fail() -> None:
    assert failed(**{"cloth.yarns.warp_diameter": "1.8mm"}) == []
    assert failed(slot_width="0.9mm") == ["warp in its slot"]
    assert failed(slot_width="2.5mm") == ["land between slots"]
    assert {"warps beside each other", "land between slots"} <= set(failed(**{"cloth.yarns.warp_diameter": "2.2mm"}))


def test_the_tension_over_a_row_is_the_stretch_of_a_spring() -> None:
    """EA / L = 2.1 N/tex of the usual cotton over 1.5 m: 900 N/m."""
    made = tension_of(usual())
    found = made.over
    assert found.rate == pytest.approx(2.1e6 * usual_warp_density(2 * mm) / 1.5)
    assert found.woven - found.rest == pytest.approx(found.rate * 0.004 * 0.03)
    assert found.locked - found.woven == pytest.approx(found.rate * 0.004)
    assert found.shed - found.woven == pytest.approx(found.rate * 2 * (math.hypot(0.17, 0.06) - 0.17))
    assert made.correction * usual().outer_radius * found.rate == pytest.approx(found.woven - found.rest)


def test_no_lift_no_lengthening() -> None:
    assert shed_lengthening(0.0, 0.17, 0.17) == 0.0


@pytest.mark.parametrize("between", [1, 3])
def test_every_take_up_brings_the_tension_back(between: int) -> None:
    design = MACHINE.design(WarpTensionParams(rows_between=between))
    at, over = history(design, 6)
    found = tension_of(design).over
    assert over[-1] == pytest.approx(found.rest)
    assert over.min() == pytest.approx(found.rest)
    assert over[at == between].tolist() == pytest.approx([found.woven, found.rest, found.rest])
    assert (np.diff(at) >= 0).all()


def test_warps_that_slip_on_the_spacer_pull_more_behind_it() -> None:
    assert tension_beyond(WarpTensionParams(spacer_wrap=math.pi / 2)) == pytest.approx(15 * math.exp(0.1 * math.pi))


@pytest.mark.parametrize("settings", [{}, {"spacer_wrap": "120deg"}, {"width": "2.4m"}], ids=str)
def test_the_key_of_each_cylinder_bears_the_torque_that_its_warps_exert(settings: dict[str, str]) -> None:
    """The spacer's: the difference of its strands while they slip over it, Euler-Eytelwein; pressure by DIN 6892, C."""
    design = MACHINE.design(WarpTensionParams.read(settings))
    made, params = cylinders(design), design.params
    slack = design.loads.worst * made[2].shell.outer_radius
    assert made[2].torque == pytest.approx(slack * math.expm1(params.cloth.yarns.friction * params.spacer_wrap))
    for own in made:
        end, row = own.driven_end, own.driven_end.keyway
        bearing = {1: 1.0, 2: 1.5}[end.number]  # of two keys, by the standard
        height = row.height - row.in_shaft
        assert end.pressure == pytest.approx(own.torque / (bearing * end.diameter / 2 * end.length * height))
        assert end.pressure <= end.allowed
    checked = {check.name for check in MACHINE.report(design).checks if check.name.startswith("key of the")}
    assert checked == {f"key of the {own.name} cylinder" for own in made}
    by_hand = MACHINE.design(WarpTensionParams.read(settings | {"winding": "hand"}))
    assert cylinders(by_hand)[2].torque == 0  # the warps turn it


def test_a_step_of_the_motor_is_fine_enough() -> None:
    found = tension_of(usual())
    assert found.step == pytest.approx(found.over.rate * 70 * mm * turn / 200 / 200)
    assert failed(free_length="20mm", ratio="1", motor_torque="1e4Nm") != []


def test_a_spacer_that_no_tube_can_be_fails_its_checks() -> None:
    made = MACHINE.report(MACHINE.design(WarpTensionParams(cloth=cloth(tension=1e4), width=6.0)))
    assert {"slope of the spacer", "deflection of the spacer"} <= {check.name for check in made.failed}
    assert not MACHINE.report(usual()).warnings


def test_the_slot_takes_its_metal_from_the_tube_and_holds_the_bar_by_half() -> None:
    made = usual()
    params, upper = made.params, cylinders(made)[0]
    tube = slotted(upper, params.span)
    _, rod = on_cylinder(upper, Part("tube", "tube", "steel tube", tube, STUB), params)
    whole = math.pi * (upper.outer**2 - upper.inner**2)
    sagitta = upper.outer - math.sqrt(upper.outer**2 - (width(upper) / 2) ** 2)
    taken = whole - tube.section.area
    assert width(upper) * (depth(upper) - sagitta) < taken < width(upper) * depth(upper)
    # The bending as if its plane went through the slot, by the exact moments of the section.
    middle = tube.section.moment(1, 0) / tube.section.area
    inertia = tube.section.moment(2, 0) - tube.section.area * middle**2
    bent = abs(upper.load) * params.span**2 / 8 * (upper.outer - depth(upper)) / inertia
    twisted = upper.torque / (2 * math.pi * (upper.inner + upper.outer - depth(upper)) ** 2 / 4)
    twisted /= upper.outer - upper.inner - depth(upper)
    assert slot_stress(params, upper) == pytest.approx(math.sqrt(bent**2 + 3 * twisted**2), rel=0.01)
    lowest = math.hypot(*rod.positions[0].origin[:2]) - diameter(upper) / 2
    assert lowest == pytest.approx(upper.outer - depth(upper))
    assert {line.number for line in MACHINE.parts(made) if line.part == ATTACHMENT_BAR} == {2}
