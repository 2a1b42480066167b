"""Both sides of the knotting machine: one mechanism, its gears and clearances, and the knot that its hands tie."""

import json
from functools import cache

import numpy as np
import pytest

from ilmek.elements.gears import LEAST_TEETH, MODULES, EqualGears, equal_gears, lewis
from ilmek.errors import IlmekError, ParameterError
from ilmek.linkage.clearance import OutlinedBody, distances
from ilmek.linkage.configuration_path import InputPath
from ilmek.linkage.mirror import other
from ilmek.linkage.model import degrees_of_freedom
from ilmek.linkage.one_input import one_input
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.knotting_four_bar import MACHINE, KnottingFourBar, KnottingFourBarParams, design
from ilmek.machines.knotting_four_bar.sides import KnottingSides, clearances, hands, outlines
from ilmek.plane.teeth import PRESSURE_ANGLE
from ilmek.report import Animation, Drawing, Report
from ilmek.units import MPa, mm
from ilmek.weaving.knots.two_hands import knot_of_hands, pitch_range

PUBLISHED = {"poses": "(0mm,0mm,10deg) (25mm,15mm,3deg) (30mm,1mm,-25deg)", "ground_angle": "275deg", "sides": "2"}


@cache
def made(**given: str) -> KnottingFourBar:
    return design(KnottingFourBarParams.read({**PUBLISHED, **given}))


def sides_of(design: KnottingFourBar) -> KnottingSides:
    assert design.sides is not None
    return design.sides


@pytest.fixture(scope="module")
def quick() -> KnottingFourBar:
    """At a speed and an acceleration at which masses count."""
    return made(speed="-30rad/s", acceleration="400rad/s^2", grip_angle="70deg")


def test_both_sides_are_one_mechanism_of_one_freedom_and_mirror_images(quick) -> None:
    sides = sides_of(quick)
    assert degrees_of_freedom(sides.plan.mechanism) == 1
    assert [one.name for one in sides.plan.mechanism.inputs] == ["crank"]
    motion = sides.moving.motion
    for body, point in (("crank", "O2"), ("coupler", "O2'"), ("coupler", "H"), ("rocker", "O2'")):
        one, two = motion.point(body, point), motion.point(other(body), other(point))
        np.testing.assert_allclose(two.position, 2 * sides.mirror - np.conj(one.position), atol=1e-15)
        np.testing.assert_allclose(two.acceleration, -np.conj(one.acceleration), rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(motion.omega(other("crank")), -motion.omega("crank"))


def test_the_motor_bears_the_sum_of_both_sides_alone(quick) -> None:
    sides = sides_of(quick)
    course = sides.moving
    np.testing.assert_allclose(
        course.torque, course.alone[0] - course.alone[1], atol=1e-12 * np.abs(course.torque).max()
    )
    np.testing.assert_allclose(course.torque, 2 * course.alone[0], rtol=1e-9)
    assert course.forces.power_error < 1e-12
    # What the teeth pass on is the second side's torque, with its gear's inertia.
    np.testing.assert_allclose(course.tooth, np.abs(course.alone[1]) / sides.gears.pitch_radius, rtol=1e-9)
    # The gears' discs turn with the cranks: at 400 rad/s² they are felt.
    disc = np.pi * sides.gears.pitch_radius**2 * sides.gears.width * quick.params.density
    added = 2 * disc * sides.gears.pitch_radius**2 / 2 * 400
    np.testing.assert_allclose(course.torque, 2 * quick.moving.torque + added, rtol=1e-9)


def test_axes_stand_as_near_as_clearance_and_teeth_allow() -> None:
    sides = sides_of(made())
    assert sides.gears.teeth * sides.gears.module == pytest.approx(sides.gears.distance)
    assert 0 <= sides.gears.distance - sides.least_distance < sides.gears.module
    assert np.min(sides.gap) == pytest.approx(2 * (sides.mirror - 30 * mm), abs=1e-12)


@cache
def told() -> Report:
    return MACHINE.report(made())


def test_every_answer_by_its_name() -> None:
    found, sides = told(), sides_of(made())
    said = found.as_json()["results"]
    names = {"axis_distance", "mirror", "gears", "motor_torque_max", "side_pin_forces_max", "side_clearance_min"}
    assert names | {"gripper_clearance_min", "hand_distance_min", "knot_tied", "knot_why", "knot_pitches"} < set(said)
    assert said["motor_torque_max"] == pytest.approx(2 * said["drive_torque_max"], rel=1e-9)
    assert said["servo_torque"] == pytest.approx(said["motor_torque_max"] / (0.9 * said["gear_ratio"]))
    assert set(said["side_pin_forces_max"]) == {"O1", "O2", "O2'", "O1'", "O1*", "O2*", "O2'*", "O1'*"}
    assert json.dumps(said)
    shown = {figure.name: figure for figure in found.figures}
    assert isinstance(shown["knotting-sides"], Drawing)
    assert isinstance(shown["knotting-sides-moving"], Animation)
    assert {"knotting-sides-torque", "knotting-sides-distance"} < set(shown)
    # All of the clearance is used but for the rest to the next tooth.
    wanted = 1 * mm + sides.gears.distance - sides.least_distance
    assert said["side_clearance_min"] == pytest.approx(wanted, abs=1e-6)
    assert not {"knot_tied", "gears"} & set(MACHINE.report(design(KnottingFourBarParams())).as_json()["results"])


def test_two_bodies_of_different_kinds_never_come_nearer() -> None:
    """Why only a body and its own mirror image are looked at."""
    sides, params = sides_of(made()), made().params
    way = InputPath(one_input(sides.plan), *sides.moving.angle[[0, -1]])
    least = min(one.least for one in clearances(params, sides).values())
    rocker = outlines(params, sides.plan.mechanism, "rocker")
    coupler = outlines(params, sides.plan.mechanism, "coupler")
    crossed = distances(way, coupler, OutlinedBody(other("rocker"), rocker.outlines), sides.moving.angle[::20])
    assert np.min(crossed) > least


def test_a_given_distance_shifts_the_teeth_and_too_small_a_one_fails_its_checks() -> None:
    sides = sides_of(made(axis_distance="80.3mm", gear_module="1mm"))
    assert sides.gears.teeth == 80
    assert sides.gears.profile_shift == pytest.approx(0.303, abs=2e-3)
    assert 2 * sides.gears.pitch_radius == pytest.approx(80.3 * mm)
    near = MACHINE.report(made(axis_distance="70mm", gear_stress="1MPa", gear_module="0.5mm"))
    failed = [check.name for check in near.failed]
    assert {"clearance of the two sides", "bending of the gears' teeth"} < set(failed)
    assert near.as_json()["results"]["side_clearance_min"] < 0
    with pytest.raises(ParameterError, match="axes 70 mm apart for gears of module 5 mm; 90 mm or more"):
        made(axis_distance="70mm", gear_module="5mm")


def test_links_without_poses_have_two_sides_too() -> None:
    sides = sides_of(design(KnottingFourBarParams(sides=2)))
    assert sides.gears.distance >= sides.least_distance
    assert sides.moving.torque_error < 1e-9
    assert sides.facing == -1


def test_the_published_hands_tie_no_knot_on_warps_2_mm_apart_but_on_opened_ones() -> None:
    """A hand that ends 8 mm before the mirror never goes between warps 1 mm from it."""
    said = told().as_json()["results"]
    assert said["knot_tied"] == "no knot"
    assert said["knot_why"].startswith("at every height of the warps: ")
    assert said["knot_pitches"][0] == pytest.approx(said["hand_distance_min"], abs=0.2 * mm)
    (failed,) = (check for check in told().failed if check.name == "knots tied on the two warps")
    assert (failed.value, failed.limit) == (0.0, 1.0)
    assert "there the hands tie a symmetric knot" in failed.cure
    first, second = (way[made().onward] for way in hands(sides_of(made()).moving.motion))
    assert knot_of_hands(first, second, 20 * mm).name == "symmetric knot over warps 1 and 2"
    assert knot_of_hands(first, second, 15 * mm).tied is None


def test_hands_that_go_round_a_warp_each_tie_it_and_others_do_not() -> None:
    way = np.array([-3 - 0.5j, -2 + 3j, -0.5 + 3j, -0.5 - 1j])
    tied = knot_of_hands(way, -way.conj(), 3.0)
    assert tied.tied is not None
    assert tied.tied.knot is not None
    assert tied.name == "symmetric knot over warps 1 and 2"
    least, most = pitch_range(way, -way.conj()) or (0.0, 0.0)
    assert least == pytest.approx(1.0, abs=1e-3)
    assert 5.5 < most <= 6.0
    front = np.array([-3 + 0j, -2 + 0j])
    assert knot_of_hands(front, -front.conj(), 3.0).name == "no knot"
    assert pitch_range(front, -front.conj()) is None


def test_the_ways_of_the_hands_are_led_in_the_order_of_the_poses(quick) -> None:
    first, _ = hands(sides_of(quick).moving.motion)
    onward = first[quick.onward]
    np.testing.assert_allclose([onward[0], onward[-1]], [0, (30 + 1j) * mm], atol=1e-12)


@pytest.mark.parametrize("distance", [0.02, 0.0331, 0.08, 0.1234])
@pytest.mark.parametrize("torque", [0.01, 1.0, 30.0])
def test_equal_gears_mesh_at_their_distance(distance, torque) -> None:
    gears = equal_gears(distance, torque, width=8 * mm, stress=20 * MPa)
    base = gears.module * gears.teeth * np.cos(PRESSURE_ANGLE)
    assert gears.distance == distance
    assert base == pytest.approx(distance * np.cos(gears.pressure_angle))
    assert gears.teeth >= LEAST_TEETH
    standard = equal_gears(distance, torque, width=8 * mm, stress=20 * MPa, standard=True)
    assert standard.profile_shift == pytest.approx(0, abs=1e-9)
    assert 0 <= standard.distance - distance < standard.module
    finer = [module for module in MODULES if module < gears.module]
    for module in finer:
        fine = EqualGears(distance, module, round(distance / module), 8 * mm)
        assert fine.bending(fine.force(torque)) > 20 * MPa


def test_profile_shift_of_a_worked_pair() -> None:
    """z 24/24, m 3 mm, a 73 mm: cos αw = 72 cos 20° / 73, αw 22.06°; x1 + x2 = 48 (inv αw - inv α) / (2 tan α)."""
    gears = EqualGears(73 * mm, 3 * mm, 24, 20 * mm)
    assert np.degrees(gears.pressure_angle) == pytest.approx(22.0556, abs=1e-4)
    angle = gears.pressure_angle
    more = (np.tan(angle) - angle) - (np.tan(PRESSURE_ANGLE) - PRESSURE_ANGLE)
    assert gears.profile_shift == pytest.approx(48 * more / (2 * np.tan(PRESSURE_ANGLE)))
    assert gears.separating(100.0) == pytest.approx(100 * np.tan(angle))


def test_no_room_for_teeth_is_said() -> None:
    with pytest.raises(IlmekError, match="9 mm or more: fewer than 18 teeth are undercut"):
        equal_gears(8 * mm, 1.0, width=5 * mm, stress=20 * MPa)
    assert lewis(18) == pytest.approx(0.309)


@pytest.mark.parametrize(("pitch", "tied"), [("2mm", False), ("12mm", False), ("20mm", True), ("40mm", True)])
@pytest.mark.one_in(2)
def test_hands_that_tie_no_knot_on_the_warps_fail(pitch: str, tied: bool) -> None:
    """The report's poses: a knot is tied on warps that are farther from each other than the hands at their nearest."""
    poses = "(0,0,10deg) (25mm,15mm,3deg) (30mm,1mm,-25deg)"
    report = MACHINES["knotting-four-bar"].report_for(
        {"poses": poses, "sides": "2", "width": "8mm", "warp_pitch": pitch}
    )
    (knot,) = (check for check in report.checks if check.name == "knots tied on the two warps")
    assert (knot.ok, knot.value, knot.limit) == (tied, float(tied), 1.0)
    assert [check.name for check in report.failed] == ([] if tied else [knot.name])
    (nearest,) = (result.value for result in report.results if result.name == "hand_distance_min")
    assert (float(pitch.removesuffix("mm")) * mm > nearest) is tied
