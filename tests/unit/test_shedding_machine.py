"""The shedding machine: masses, load, shuttle window, drive, checks and warnings, and what it refuses."""

import functools
import math

import numpy as np
import pytest
from cloths import cloth
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.cams.laws import SMOOTH_LAWS
from ilmek.errors import ParameterError
from ilmek.machines.shedding import MACHINE, SheddingDesign, SheddingParams
from ilmek.report import Drawing, Plot, Report
from ilmek.units import deg, mm

WIDE = {"cloth.warps": "6000", "cloth.warp_pitch": "1mm"}


def made(**given_settings: str) -> SheddingDesign:
    return MACHINE.design(SheddingParams.read(given_settings))


@functools.cache
def answer(**given_settings: str) -> Report:
    return MACHINE.report(made(**given_settings))


def failed(report: Report) -> list[str]:
    return [check.name for check in report.failed]


def test_the_thesis_loom_passes_its_checks() -> None:
    report = answer()
    assert failed(report) == []
    assert len(report.checks) == 31
    assert len(report.warnings) == 1
    assert "bridges the hollow" in report.warnings[0]


def test_load_is_the_vector_sum_of_weight_and_one_parity_with_safety_2() -> None:
    design = made()
    weight, across = design.stack.mass * 9.81, 300 * 10.0
    assert design.shaft.load == pytest.approx(2 * math.hypot(weight, across) / 1.2)
    assert made(safety="1").shaft.load == pytest.approx(design.shaft.load / 2, rel=1e-4)  # of a thinner bar


def test_the_stack_weighs_cams_guides_and_the_shaft_in_their_bores() -> None:
    design = made()
    stack, bar = design.stack, design.shaft.bar
    shaft = bar**2 * 1.2 * 7850
    assert stack.mass == pytest.approx(600 * stack.cam_mass + 601 * stack.guide_mass + shaft)  # guides at both ends


def test_overlapping_sheds_load_the_shaft_with_all_warps_and_fail() -> None:
    design, report = made(rise="120deg"), answer(rise="120deg")
    assert design.shaft.load == pytest.approx(2 * math.hypot(design.stack.mass * 9.81, 6000) / 1.2)
    assert "one parity down while the other is up" in failed(report)


def test_half_turn_rises_balance_each_other() -> None:
    """While one parity rises the other comes down: the torques cancel, and there is no work left for the motor."""
    design = made(rise="180deg")
    assert np.max(np.abs(design.shed.torque(np.linspace(0, 7, 200)))) < 1e-11
    assert design.drive.torque_rms < 1e-11


def test_shuttle_window_of_the_harmonic_law() -> None:
    """30 (1 - cos 2q) = 40 mm at q = acos(-1/3)/2."""
    first, last = made().shuttle_window
    assert first == pytest.approx(math.acos(-1 / 3) / 2, abs=1e-14)
    assert last == pytest.approx(math.pi - first, abs=1e-14)


def test_a_raised_dwell_keeps_the_shed_open() -> None:
    short, long = made(rise="60deg", dwell="0deg"), made(rise="60deg", dwell="60deg")
    spans = [design.shuttle_window[1] - design.shuttle_window[0] for design in (short, long)]
    assert spans[1] - spans[0] == pytest.approx(60 * deg)
    assert [segment.name for segment in long.even.segments] == ["rise", "dwell", "fall", "dwell"]


def test_a_shed_too_low_for_the_shuttle_fails() -> None:
    report = answer(lift="30mm")
    assert "shed for the shuttle" in failed(report)
    assert report.as_json()["results"]["shuttle_time"] == 0.0


@settings(max_examples=12)
@given(
    law=st.sampled_from(list(SMOOTH_LAWS)),
    lift=st.floats(0.02, 0.12),
    rise=st.floats(40 * deg, 89 * deg),
    tension=st.floats(5.0, 30.0),
)
def test_work_of_the_torque_is_the_work_on_the_warps(law, lift, rise, tension) -> None:
    """Virtual power: the torque over the rise does what stretches the warps; over the turn nothing is left."""
    design = MACHINE.design(SheddingParams(lift=lift, rise=rise, law=law, cloth=cloth(tension=tension), half_span=0.2))
    angle = np.linspace(0, rise, 4001)
    work = np.trapezoid(design.shed.torque(angle), angle)
    assert work == pytest.approx(300 * 2 * tension * (math.hypot(lift, 0.2) - 0.2), rel=1e-5)
    whole = np.linspace(0, 2 * math.pi, 20_001)
    assert abs(np.trapezoid(design.shed.torque(whole), whole)) < 1e-3 * work


def test_opposed_cams_are_half_a_turn_apart() -> None:
    design = made(law="3-4-5")
    angle = np.linspace(0, 6, 50)
    np.testing.assert_allclose(design.shed.opening(angle), -design.shed.opening(angle + math.pi), atol=1e-14)


def test_fine_pitch_takes_thin_cams() -> None:
    """Thin warps between guide cams: half of the pitch each."""
    fine = {"cloth.warp_pitch": "0.5mm", "cloth.warps": "2400", "cloth.yarns.warp_diameter": "0.1mm"}
    design = made(shafts="1", guides="cams", **fine)
    assert design.stack.thickness == pytest.approx(0.2 * mm)
    assert design.stack.thickness + design.stack.guide_thickness == pytest.approx(0.5 * mm)
    assert design.shaft.length == pytest.approx(1.2)


def test_prime_circle_too_small_for_the_limit_or_the_bore_fails_and_says_the_size() -> None:
    report = answer(prime_radius="40mm")
    assert failed(report) == ["pressure angle", "prime radius round the bore"]
    assert "prime_radius" in next(check.cure for check in report.failed)
    assert failed(answer(prime_radius="90mm")) == []


def test_roller_larger_than_the_curvature_undercuts() -> None:
    assert "convex radius of the pitch curve (no undercut)" in failed(
        answer(roller_radius="75mm", prime_radius="78.2mm")
    )


def test_more_cams_than_the_shaft_is_long() -> None:
    assert failed(answer(shaft_length="1m")) == ["width of the cams on the shaft"]
    several = answer(shaft_length="1m", shafts="2", front_span="0.5m", back_span="0.5m", **{"cloth.tension": "5N"})
    assert "width of the cams on the shaft" in failed(several)


def test_motor_is_chosen_or_judged() -> None:
    assert made().drive.motor.torque >= made().drive.motor_torque == pytest.approx(180 / 85)
    assert failed(answer(motor_torque="2Nm")) == ["motor torque"]
    report = answer(ratio="1", efficiency="1")
    assert failed(report) == ["motor torque"]
    assert made(ratio="1", efficiency="1").drive.motor.torque == report.failed[0].limit


def test_foil_cams_fail() -> None:
    foil = failed(answer(shafts="1", guides="cams", **{"cloth.warp_pitch": "0.3mm", "cloth.warps": "4000"}))
    assert {"thickness of a cam", "thickness of a guide cam"} <= set(foil)
    assert failed(answer(**{"cloth.warp_pitch": "1mm", "cloth.warps": "1200"})) == []


def test_a_quick_shaft_is_warned_of() -> None:
    assert any("the thesis allows 5 rpm" in warning for warning in answer(speed="10rpm").warnings)


def test_shaft_beyond_the_stock_is_the_largest_of_stock_and_fails() -> None:
    design = made(shaft_load="2000kN/m")
    assert design.shaft.side > design.shaft.bar == 150 * mm
    assert {"slope of the shaft", "deflection of the shaft", "life of the bearings"} <= set(
        failed(answer(shaft_load="2000kN/m"))
    )


def test_supports_between_shorten_the_span_not_the_shaft() -> None:
    """l/2 over the same load per length: the side goes with l^(3/4) by slope and with l by deflection."""
    one, two = made(shaft_load="14kN/m", shaft_length="2.4m"), made(shaft_load="14kN/m", shaft_length="2.4m", spans="2")
    assert (one.shaft.load, one.shaft.length) == (two.shaft.load, two.shaft.length)
    assert two.shaft.side_slope == pytest.approx(one.shaft.side_slope / 2**0.75)
    assert two.shaft.side_deflection == pytest.approx(one.shaft.side_deflection / 2)
    assert two.shaft.side_twist == one.shaft.side_twist


def test_the_bar_of_the_thesis_is_judged() -> None:
    """80 mm at 14 kN/m: 1.4766e-3 rad and 0.5537 mm; 50 mm would not do."""
    thesis = made(shaft_load="14kN/m", shaft_bar="80mm", modulus="200GPa")
    assert thesis.shaft.slope == pytest.approx(1.4766e-3, rel=1e-4)
    assert thesis.shaft.deflection == pytest.approx(0.5537 * mm, rel=1e-4)
    assert failed(answer(shaft_load="14kN/m", shaft_bar="50mm")) == [
        "step of the shuttle's guideway on the tips",
        "slope of the shaft",
        "deflection of the shaft",
        "fatigue of the shaft",
    ]


def test_a_long_thin_shaft_fails_by_twist_and_stress() -> None:
    report = answer(shaft_bar="20mm", spans="60", bore_wall="0mm", **WIDE)
    assert failed(report) == [
        "step of the shuttle's guideway on the tips",
        "twist of the shaft",
        "stress of the shaft",
        "fatigue of the shaft",
        "bore of the bearing for the torque",
        "stress of the driven journal",
        "fatigue of the driven journal at its shoulder",
        "nut of the cams over the journal",
        "key of the cam shaft",
        "deflection of the reed across the warps",
    ]
    chosen = made(spans="60", **WIDE).shaft
    assert chosen.bar >= max(chosen.side_twist, chosen.side_strength) > chosen.side


def test_the_window_is_found_where_the_other_parity_is_still_coming_down_at_the_top() -> None:
    """Up from 60 to 210 deg while the odd warps come down until 90 deg and go up from 180 deg on."""
    design = made(rise="60deg", dwell="150deg", shuttle_height="40mm")
    first, last = design.shuttle_window
    room = design.shed.opening(np.array([first, last]))
    assert room == pytest.approx([40 * mm, 40 * mm])
    assert 60 * deg < first < 90 * deg
    assert 180 * deg < last < 210 * deg
    between = np.linspace(first, last, 1001)[1:-1]
    assert design.shed.opening(between).min() > 40 * mm


def test_a_motor_that_no_one_makes_is_judged_against_the_largest() -> None:
    check = next(check for check in answer(ratio="1", efficiency="1").failed)
    assert (check.value, check.limit) == pytest.approx((180.0, 95.5), rel=1e-3)
    too_quick = next(check for check in answer(ratio="1000").failed)
    assert too_quick.limit == 0.0


def test_report_is_whole() -> None:
    report = answer(law="parabolic", dwell="10deg", rise="80deg")
    names = [figure.name for figure in report.figures]
    assert len(set(names)) == len(names) == 11
    assert [type(figure) for figure in report.figures].count(Drawing) == 2
    for figure in report.figures:
        for series in figure.series if isinstance(figure, Plot) else ():
            assert series.x.shape == series.y.shape
            assert np.all(np.isfinite(series.y))
    assert {table.name for table in report.tables} == {
        "shedding-phases",
        "shedding-stagger",
        "shedding-laws",
        "shedding-shaft",
        "shedding-cam-points",
    }
    for table in report.tables:
        assert {len(row) for row in table.rows} == {len(table.columns)}
    assert [row[0] for row in report.tables[2].rows] == list(SMOOTH_LAWS)


def test_law_table_agrees_with_a_design_by_that_law() -> None:
    for row in answer().tables[2].rows[::6]:
        found = answer(law=str(row[0])).as_json()["results"]
        wanted = [found[n] for n in ("prime_radius", "curvature_radius_min", "velocity_max", "acceleration_max")]
        assert list(row[1:5]) == pytest.approx(wanted, rel=1e-9)
        assert row[5] == len(found["acceleration_jumps"])


@pytest.mark.parametrize(
    ("given_settings", "said"),
    [
        ({"rise": "200deg"}, "rise \\+ dwell \\+ fall = 400 deg; they must fit one turn"),
        ({"rise": "90"}, "did you mean 90deg"),
        ({"lift": "60"}, "did you mean 60mm"),
        ({"lift": "0mm"}, "lift=0 mm is out of bounds"),
        ({"law": "harmonik"}, "did you mean harmonic"),
        ({"cam_thickness": "2mm"}, "cam_thickness=2 mm does not fit cloth.warp_pitch=2 mm; below 2 mm"),
        ({"cam_thickness": "1mm", "cloth.warp_pitch": "0.8mm"}, "leave it out for half the pitch"),
        ({"cloth.tension": "15N"}, "cloth.tension without half_span"),
        ({"pressure_angle_limit": "90deg"}, "below 90 deg"),
        ({"cloth.warps": "1"}, "at least 2"),
        ({"safety": "0.5"}, "at least 1"),
        ({"prime_radius": "10mm", "roller_radius": "12mm"}, "prime_radius=10 mm is too small; above 12 mm"),
        ({"pressure_angel_limit": "30deg"}, "did you mean pressure_angle_limit"),
    ],
)
def test_refuses_in_one_line(given_settings, said) -> None:
    with pytest.raises(ParameterError, match=said):
        made(**given_settings)
