"""The machine `cam`: the exact cases, every law and follower, rollers and hub, what it says, bad input."""

import math

import numpy as np
import pytest
from click.testing import CliRunner
from examples.draw_cam import cam as drawn

from ilmek.cams.laws import LAWS
from ilmek.cams.programme import TURN
from ilmek.cli import main
from ilmek.elements.cam_rollers import ROLLERS, RollerDuty
from ilmek.elements.hubs import Hub, bore_for, hub_for
from ilmek.errors import ParameterError
from ilmek.machines.cam import MACHINE, CamDesign, CamParams, design
from ilmek.machines.cam.analysis import analyse
from ilmek.machines.cam.compliant_follower import compliant_follower
from ilmek.machines.cam.parts import cam_tables
from ilmek.machines.catalogue import MACHINES
from ilmek.plane import contours
from ilmek.report import results_of
from ilmek.units import deg, mm, rpm


def made(**settings):
    return design(CamParams.read(settings))


def numbers(found: CamDesign) -> dict:
    return {result.name: result.value for result in results_of(*MACHINE.results(analyse(found)))}


def results(**settings):
    return numbers(made(**settings))


SHED = dict(law="harmonic", lift="60mm", rise="90deg")


def test_cam_of_the_guide_is_what_its_page_says() -> None:
    found = numbers(drawn())
    assert found["prime_radius"] == pytest.approx(52.5 * mm, abs=0.05 * mm)
    assert found["roller"] == "CF 5"
    assert found["bore"] == 12 * mm
    assert found["spring_rate"] == pytest.approx(1980, abs=10)
    assert found["preload"] == pytest.approx(79, abs=0.5)
    assert found["lift_off_speed"] == pytest.approx(360 * rpm, rel=1e-6)
    assert found["torque_max"] == pytest.approx(8.1, abs=0.05)


def test_is_in_the_catalogue() -> None:
    assert MACHINES["cam"] is MACHINE


@pytest.mark.parametrize("follower", ["knife", "roller"])
def test_shedding_cam_from_its_pressure_angle(follower) -> None:
    found = results(**SHED, follower=follower, pressure_angle_limit="30deg")
    assert found["prime_radius"] == pytest.approx(78.16653826 * mm, rel=1e-9)
    assert found["pressure_angle_max"] == pytest.approx(30 * deg, rel=1e-12)
    assert found["pressure_angle_at"] == pytest.approx(36.948943 * deg, abs=1e-7)
    assert found["curvature_radius_min"] == pytest.approx(73.94448725 * mm, rel=1e-9)
    assert found["undercut"] is False
    assert found["fall"] == pytest.approx(90 * deg)


def test_area_is_that_of_the_parallel_curve() -> None:
    """Steiner: A = A_pitch - R L + pi R^2 by sums over 20,000 places of the pitch curve."""
    cam = made(**SHED, prime_radius="80mm", roller_radius="11mm")
    angle = np.linspace(0, TURN, 20_001)[:-1]
    pitch = cam.cam.trace(angle).pitch[::-1]
    following = np.roll(pitch, -1)
    inside = 0.5 * np.sum(np.imag(np.conj(pitch) * following))
    strip = 11 * mm * np.sum(np.abs(following - pitch))
    assert cam.area == pytest.approx(inside - strip + math.pi * (11 * mm) ** 2, rel=1e-7)


def test_flat_follower_of_a_harmonic_cam_touches_a_circle() -> None:
    """Rise and fall over half a turn each: a circle of Rb + L/2, whose centre lies L/2 off."""
    found = made(law="harmonic", lift="20mm", rise="180deg", follower="flat", prime_radius="30mm")
    surface = found.cam.trace(np.linspace(0, TURN, 97)).surface
    assert np.abs(surface + 10 * mm) == pytest.approx(np.full(97, 40 * mm), rel=1e-12)
    assert found.area == pytest.approx(math.pi * (40 * mm) ** 2, rel=1e-12)


def test_flat_follower_has_the_smallest_base_circle_that_is_convex() -> None:
    found = results(**SHED, follower="flat", curvature_least="2mm")
    assert found["prime_radius"] == pytest.approx(62 * mm, rel=1e-9)
    assert found["curvature_radius_min"] == pytest.approx(2 * mm, rel=1e-6)
    assert found["pressure_angle_max"] == 0
    assert found["undercut"] is False
    assert found["face_span"] == pytest.approx([-60 * mm, 60 * mm], rel=1e-9)
    assert results(**SHED, follower="flat", prime_radius="59mm")["undercut"] is True


def test_offset_keeps_the_limit_on_the_rise_alone() -> None:
    found = results(**SHED, follower="knife", pressure_angle_limit="25deg", offset="20mm")
    assert found["pressure_angle_max"] == pytest.approx(25 * deg, rel=1e-9)
    assert found["pressure_angle_fall_max"] > 25 * deg
    assert found["prime_radius"] < results(**SHED, follower="knife", pressure_angle_limit="25deg")["prime_radius"]


@pytest.mark.parametrize("law", LAWS)
def test_every_law_makes_a_cam(law) -> None:
    found = made(law=law, lift="20mm", rise="100deg", pressure_angle_limit="30deg")
    assert math.isfinite(found.cam.prime_radius)
    assert found.area > math.pi * (found.cam.prime_radius - found.cam.roller_radius) ** 2
    assert math.isfinite(found.extremes.torque.value)


def test_laws_take_their_parameters() -> None:
    trapezoid = made(law="scca", law_parameters="b=0.25 c=0.5 d=0.25", lift="20mm")
    named = made(law="modified-trapezoid", lift="20mm")
    assert trapezoid.cam.prime_radius == pytest.approx(named.cam.prime_radius, rel=1e-9)
    slow = made(law="harmonic", fall_law="3-4-5", fall="120deg", dwell="30deg")
    assert [segment.law.name for segment in slow.programme.segments] == ["harmonic", "rest", "3-4-5", "rest"]


@pytest.mark.parametrize(
    ("rise", "dwell", "fall"), [("90deg", "0deg", 90), ("200deg", "0deg", 160), ("150deg", "100deg", 110)]
)
def test_fall_is_as_the_rise_where_it_fits(rise, dwell, fall) -> None:
    found = made(rise=rise, dwell=dwell)
    assert found.params.fall_angle == pytest.approx(fall * deg)
    assert sum(segment.span for segment in found.programme.segments) == pytest.approx(TURN, abs=1e-12)


ARM = dict(motion="oscillating", lift="30mm", law="cycloidal", arm="90mm")


@pytest.mark.parametrize("follower", ["roller", "flat"])
def test_a_spring_at_the_end_of_an_arm_stores_the_work_of_its_stroke(follower: str) -> None:
    """Over a swing through the angle s the spring at the end is compressed by s arm: F = preload + rate s arm."""
    spring = dict(spring_rate="2N/mm", preload="40N", mass="0.7kg")
    load = made(**ARM, **spring, follower=follower, pressure_angle_limit="35deg").follower_load
    swing = 30 / 90
    work = load.preload * swing + load.rate * swing**2 / 2
    assert work == pytest.approx(40 * 0.03 + 2000 * 0.03**2 / 2)
    assert load.mass == pytest.approx(0.7 * 0.09**2)
    led = made(**ARM, kind="grooved", mass="0.7kg", load="20N").follower_load
    assert (led.mass, led.load) == pytest.approx((0.7 * 0.09**2, 20 * 0.09))


@pytest.mark.parametrize(
    "more",
    [
        dict(follower="roller"),
        dict(follower="spherical", side="leading"),
        dict(follower="flat"),
        dict(follower="flat", side="leading", face_offset="5mm"),
    ],
    ids=lambda more: "-".join(more.values()),
)
def test_arm_turns_the_shaft_by_its_virtual_work(more) -> None:
    found = made(**ARM, **more, pressure_angle_limit="35deg")
    angle = np.linspace(0.01, 6.2, 61)
    state = found.state(angle)
    assert state.torque == pytest.approx(state.force * state.trace.motion.ds, abs=1e-9)
    course = found.programme.at(angle)
    moment = (0.5 * course.dds * 0.09 * found.params.speed**2 + 100) * 0.09
    spring = found.follower_load.preload + found.follower_load.rate * course.s
    assert state.force == pytest.approx(moment + spring, rel=1e-12)
    assert not found.undercut


@pytest.mark.parametrize(
    "more",
    [
        dict(kind="grooved"),
        dict(kind="grooved", motion="oscillating"),
        dict(kind="conjugate", offset="5mm"),
        dict(kind="conjugate", follower="flat"),
        dict(kind="conjugate", motion="oscillating", side="leading"),
    ],
    ids=lambda more: "-".join(more.values()),
)
def test_cam_that_leads_both_ways_needs_no_spring(more) -> None:
    """What pulls the follower back presses on the other flank or cam; the work is the same."""
    found = made(law="cycloidal", lift="30mm", rise="100deg", speed="300rpm", load="20N", **more)
    state = found.state(np.linspace(0.01, 6.2, 61))
    assert state.force.min() < 0 < state.force.max()
    assert np.sign(state.normal) == pytest.approx(np.sign(state.force))
    assert state.torque == pytest.approx(state.force * state.trace.motion.ds, abs=1e-9)
    assert found.follower_load.rate == found.follower_load.preload == 0
    assert not found.undercut
    assert math.isfinite(found.extremes.pressure.value)


def test_groove_keeps_the_limit_both_ways_and_is_cut_into_a_disc() -> None:
    found = made(law="modified-sine", lift="30mm", kind="grooved", fall="70deg", pressure_angle_limit="32deg")
    numbers_found = numbers(found)
    assert numbers_found["pressure_angle_fall_max"] == pytest.approx(32 * deg, rel=1e-9)
    assert numbers_found["pressure_angle_max"] < 32 * deg
    (plate,) = MACHINE.plates(found)
    assert set(plate.paths) == {"pitch curve", "inner flank", "outer flank", "cutter path"}
    apart = np.abs(np.asarray(plate.paths["outer flank"]) - np.asarray(plate.paths["inner flank"]))
    assert apart == pytest.approx(np.full(apart.size, numbers_found["groove_width"]))
    most = np.abs(np.asarray(plate.paths["outer flank"])).max()
    assert plate.area == pytest.approx(math.pi * (most + 5 * mm) ** 2, rel=1e-5)


@pytest.mark.parametrize("kind", ["barrel", "face", "wedge"])
def test_strip_turns_the_shaft_by_its_virtual_work(kind) -> None:
    """tan mu = s'/rho: the mean radius of the limit is the largest s' over tan mu."""
    asked = dict(law="cycloidal", lift="30mm", rise="90deg", speed="300rpm", load="0N")
    found = made(**asked, kind=kind, pressure_angle_limit="28deg")
    assert found.cam.prime_radius == pytest.approx(2 * 30 * mm / (90 * deg) / math.tan(28 * deg), rel=1e-6)
    state = found.state(np.linspace(0.01, 1.5, 41))
    assert state.torque == pytest.approx(state.force * state.trace.motion.ds, abs=1e-9)
    assert state.normal * np.cos(state.trace.pressure_angle) == pytest.approx(state.force, abs=1e-9)
    assert not found.undercut
    assert found.params.led == (kind == "barrel") == (found.follower_load.rate == 0)


def test_friction_in_the_guide_of_a_barrel_costs_what_it_rubs() -> None:
    found = made(law="cycloidal", lift="30mm", kind="barrel", guide_friction="0.1", speed="600rpm")
    state = found.state(np.linspace(0.01, 6.2, 61))
    ds = state.trace.motion.ds
    rubbed = 0.1 * np.abs(state.normal * np.sin(state.trace.pressure_angle) * ds)
    assert state.torque - state.force * ds == pytest.approx(rubbed, abs=1e-9)
    assert state.force.min() < 0


def test_wedge_is_a_plate_of_its_area() -> None:
    found = made(law="modified-sine", lift="25mm", rise="120deg", dwell="30deg", kind="wedge", roller="CF 6")
    (plate,) = MACHINE.plates(found)
    points = np.asarray(plate.outline)
    assert 0.5 * np.sum(np.imag(np.conj(points) * np.roll(points, -1))) == pytest.approx(plate.area, rel=1e-5)
    travel = numbers(found)["travel"]
    assert np.ptp(points.real) == pytest.approx(travel, rel=1e-9)


def test_conjugate_cams_are_two_plates_of_one_prime_circle() -> None:
    found = made(law="cycloidal", lift="30mm", kind="conjugate", rise="120deg")
    other = numbers(found)["second"]
    assert other["prime_radius"] == pytest.approx(found.cam.prime_radius)
    assert other["pressure_angle_max"] == pytest.approx(30 * deg, rel=1e-6)
    assert [plate.name for plate in MACHINE.plates(found)] == ["cam", "cam-2"]


def test_arm_of_the_smallest_size_keeps_the_limit() -> None:
    found = numbers(made(**ARM, pressure_angle_limit="35deg"))
    assert found["pressure_angle_max"] == pytest.approx(35 * deg, rel=1e-6)
    assert found["swing"] == pytest.approx(1 / 3)


def test_at_gives_the_motion_per_time() -> None:
    at = results(**SHED, angle="30deg", speed="120rpm")["at"]
    w, q = 120 * rpm, 2 * 30 * deg
    assert at["position"] == pytest.approx(30 * mm * (1 - math.cos(q)))
    assert at["velocity"] == pytest.approx(60 * mm * w * math.sin(q))
    assert at["acceleration"] == pytest.approx(120 * mm * w**2 * math.cos(q))
    assert at["jerk"] == pytest.approx(-240 * mm * w**3 * math.sin(q))


def test_torque_of_a_load_alone_is_its_virtual_work() -> None:
    found = results(**SHED, load="10N", mass="0kg", spring_rate="0N/mm", preload="0N")
    assert found["torque_max"] == pytest.approx(10 * 60 * mm, rel=1e-9)
    assert found["torque_range"] == pytest.approx([-0.6, 0.6], rel=1e-9)
    assert found["lift_off_speed"] is None


def test_chosen_spring_holds_up_to_its_speed() -> None:
    found = results(lift="20mm", mass="2kg", load="0N", speed="200rpm", hold_speed="300rpm")
    assert found["lift_off_speed"] == pytest.approx(300 * rpm, rel=1e-6)
    assert found["spring_force_max"] == pytest.approx(2 * found["preload"], rel=1e-9)
    assert found["hold_force_min"] > 0


def test_spherical_and_crowned_followers_press_harder_than_a_line() -> None:
    common = dict(lift="20mm", roller_radius="8mm", prime_radius="50mm")
    line, crowned, ball = (
        made(**common, **more).extremes.pressure.value
        for more in ({}, {"crown_radius": "500mm"}, {"follower": "spherical"})
    )
    assert line < crowned < ball
    assert made(follower="knife", prime_radius="50mm").extremes.pressure is None


def test_roller_of_a_table_lasts_as_long_as_its_rating_says() -> None:
    """Under its dynamic rating a bearing lives a million turns."""
    roller = ROLLERS["CF 10"]
    assert RollerDuty(roller.dynamic, roller.dynamic, 2.0, TURN).time(roller) == pytest.approx(1e6 / 2.0)


def test_smallest_roller_that_lasts_is_taken() -> None:
    heavy = made(lift="20mm", prime_radius="80mm", load="4kN", life="1e4h")
    assert heavy.roller is not None
    assert heavy.duty.time(heavy.roller) >= heavy.params.life
    smaller = [one.name for one in ROLLERS.values() if one.diameter < heavy.roller.diameter]
    less = made(lift="20mm", prime_radius="80mm", load="4kN", life="1e4h", roller=smaller[-1])
    assert less.duty.time(less.roller) < heavy.params.life


def test_hub_has_the_keyway_of_its_bore() -> None:
    assert hub_for(20 * mm) == Hub(20 * mm, 6 * mm, 2.8 * mm)
    assert hub_for(5 * mm).key_width == 0
    hub = hub_for(38 * mm)
    assert hub.area == pytest.approx(contours.area(hub.contour))
    assert np.abs(contours.along(hub.contour, 0.01 * mm)).max() == pytest.approx(hub.reach, rel=1e-9)
    torque = 16 / 1e9 * math.pi / 16 * 30e6 * 1e9 * (0.03**3) / 16
    assert bore_for(torque * 0.999) == pytest.approx(30 * mm)


def test_plate_has_the_area_of_the_cam_and_its_cutter_path() -> None:
    found = made(**SHED, prime_radius="80mm", roller="CF 10", bore="20mm")
    (plate,) = MACHINE.plates(found)
    points = np.asarray(plate.outline)
    assert 0.5 * np.sum(np.imag(np.conj(points) * np.roll(points, -1))) == pytest.approx(plate.area, rel=1e-5)
    assert set(plate.paths) == {"pitch curve", "cutter path"}
    assert np.max(np.abs(plate.paths["cutter path"] - plate.paths["pitch curve"])) == 0
    assert len(plate.cutouts) == 1
    assert cam_tables(found)[0].motion(np.array([0.0, math.pi / 2]))[0] == pytest.approx([0.0, 60 * mm])


def test_what_undercut_leaves_no_face_of_has_no_area_mass_or_pressure() -> None:
    eaten = dict(law="harmonic", lift="40mm", rise="30deg", prime_radius="12mm", roller_radius="11.5mm")
    found = results(**eaten)
    assert [found[name] for name in ("area", "mass", "hertz_pressure_max", "hertz_at")] == [None] * 4
    assert not any("Hertz" in check.name for check in MACHINE.report(made(**eaten)).checks)


def test_a_bore_that_does_not_fit_is_neither_drawn_nor_taken_off() -> None:
    asked = dict(prime_radius="20mm", bore="100mm", face_width="10mm")
    (drawing, *_) = MACHINE.report(made(**asked)).figures
    assert not any(stroke.label.startswith("bore") for stroke in drawing.strokes)
    found = results(**asked)
    assert found["mass"] == pytest.approx(found["area"] * 10 * mm * 7850, rel=1e-2)


@pytest.mark.parametrize(("kind", "radius", "fails"), [("grooved", "7mm", True), ("plate", "7mm", False)])
def test_a_cutter_too_large_for_a_hollow_fails(kind: str, radius: str, fails: bool) -> None:
    report = MACHINE.report(made(kind=kind, roller_radius="6.5mm", cutter_radius=radius))
    assert any(check.name == "radius of the cutter" for check in report.failed) is fails


def test_a_cam_that_no_roller_of_the_table_fits_fails() -> None:
    small = dict(prime_radius="6mm", lift="3mm", rise="150deg", bore="2mm")
    failed = {check.name for check in MACHINE.report(made(**small)).failed}
    assert "a roller of the table fits the cam" in failed
    assert "a roller of the table fits the cam" not in {check.name for check in MACHINE.report(made()).failed}


def test_undercut_is_said_with_the_size_that_mends_it() -> None:
    asked = dict(law="cycloidal", lift="20mm", rise="60deg", prime_radius="24mm", roller_radius="20mm")
    found = MACHINE.report(made(**asked))
    assert {result.name: result.value for result in found.results}["undercut"] is True
    assert found.plates == ()
    (said,) = [warning for warning in found.warnings if warning.startswith("undercut")]
    mended = said.split("prime_radius=")[1].split(" ")[0]
    assert not made(**{**asked, "prime_radius": mended}).undercut


def test_corner_of_the_uniform_law_is_no_way_for_a_roller() -> None:
    assert made(law="uniform", prime_radius="60mm").undercut
    assert made(law="uniform", prime_radius="60mm", follower="flat").undercut
    assert not made(law="uniform", prime_radius="60mm", follower="knife").undercut
    assert not made(law="modified-uniform", prime_radius="60mm").undercut


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (dict(rise="200deg", fall="170deg"), "rise \\+ dwell \\+ fall = 370 deg; they must fit one turn, 360 deg"),
        (dict(rise="200deg", dwell="160deg"), "rise \\+ dwell = 360 deg; a fall of 0.1 deg or more must be left"),
        (dict(rise="90"), "did you mean 90deg\\? a bare number is in radians"),
        (dict(law="harmonik"), "did you mean harmonic\\?"),
        (
            dict(prime_radius="5mm", roller_radius="8mm"),
            "prime_radius=5 mm is too small; above 8 mm; the smallest for the limits is 3",
        ),
        (
            dict(prime_radius="15mm", offset="20mm"),
            "=15 mm is too small; above 20 mm; the smallest for the",
        ),
        (dict(roller="CF 11"), "no roller 'CF 11' in the table; the nearest offered is 'CF 1"),
        (dict(roller="CF 10", roller_radius="8mm"), "roller and roller_radius are both given"),
        (dict(follower="knife", roller_radius="8mm"), "set follower=roller or spherical"),
        (dict(follower="spherical", roller_radius="0mm"), "set follower=knife"),
        (dict(follower="flat", crown_radius="50mm"), "crown_radius with follower=flat; leave it out"),
        (dict(arm="50mm"), "set motion=oscillating"),
        (dict(motion="oscillating", arm="5mm", lift="60mm"), "the arm cannot swing so far"),
        (dict(motion="oscillating", offset="5mm"), "place the arm by arm and pivot"),
        (dict(motion="oscillating", guide_friction="0.1"), "an arm has no guide"),
        (dict(kind="grooved", follower="flat"), "a groove leads a roller"),
        (dict(kind="grooved", preload="5N"), "leave it out: the cam leads both ways"),
        (dict(kind="barrel", follower="flat"), "kind=barrel with follower=flat; roller"),
        (dict(kind="wedge", motion="oscillating"), "a slide in line with the cam"),
        (dict(kind="face", offset="3mm"), "an offset with kind=face"),
        (dict(linkage_stiffness="1e9N/mm"), "leave linkage_stiffness out: take it as rigid"),
        (dict(law_parameters="b"), "NAME=NUMBER"),
        (dict(law_parameters="b=x"), "is not a number"),
        (dict(law="scca", law_parameters="bb=0.2"), "law scca has no 'bb'"),
        (dict(law="uniform", preload="5N", spring_rate="1N/mm", angle="400deg"), "angle=400 deg is out of bounds"),
    ],
)
def test_bad_input_says_what_to_do(settings, said) -> None:
    with pytest.raises(ParameterError, match=said):
        compliant_follower(made(**settings))


def test_command_ends_with_2_and_no_traceback() -> None:
    ran = CliRunner().invoke(main, ["design", "cam", "lift=60mm", "rise=200deg", "fall=200deg"])
    assert ran.exit_code == 2
    assert "Traceback" not in ran.output


@pytest.mark.parametrize("kind", ["plate", "grooved", "conjugate", "barrel", "face"])
def test_both_flanks_of_a_steep_cam_fail_their_pressure_angle(kind: str) -> None:
    given = dict(lift="60mm", rise="40deg", prime_radius="40mm", kind=kind)
    failed = {check.name: check for check in MACHINE.report_for(given).failed}
    assert {"pressure angle on the rise", "pressure angle on the fall"} <= set(failed)
    assert "prime_radius" in failed["pressure angle on the rise"].cure
