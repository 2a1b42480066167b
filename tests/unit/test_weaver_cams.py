"""The head's cams: motion kept, limits met, forces by energy; drive, cutter, selector, plates and tables."""

from functools import cache

import numpy as np
import pytest

from ilmek.cams import limits as cam_limits
from ilmek.cams.loaded_plate_cam import FASTER, STEEL, WALL, torque_at
from ilmek.cams.sizing import CamLimits, pressure_prime
from ilmek.machines.weaver import MACHINE, Weaver, WeaverParams, design
from ilmek.machines.weaver.cams import programme_of
from ilmek.machines.weaver.limits import cut_share, cycle_limits
from ilmek.machines.weaver.motions import HANDLER, SLEY
from ilmek.machines.weaver.tool_params import ToolForces
from ilmek.timing.track import sample
from ilmek.units import deg, mm, turn


@cache
def usual() -> Weaver:
    return design(WeaverParams())


ANGLE = np.linspace(0.0, turn, 2001)


def test_every_follower_moves_as_its_track_asks() -> None:
    for track, cam in zip(usual().cyclogram.tracks, usual().cams, strict=True):
        asked, given = sample(track, ANGLE), cam.programme.at(ANGLE)
        stays = track.segments[-1].end if track.name == HANDLER else 7.0
        forward = stays > ANGLE
        lowest = asked.position.min()
        assert (given.s * cam.ratio)[forward] == pytest.approx((asked.position - lowest)[forward], abs=1e-9)
        assert (given.ds * cam.ratio)[forward] == pytest.approx(asked.slope[forward], abs=1e-9)


def test_the_handlers_rack_comes_back_while_the_handler_stands() -> None:
    track = usual().cyclogram.track(HANDLER)
    programme = programme_of(track, 1 / usual().params.pinion)
    back = [part for part in programme.segments if part.name == "back"]
    assert back[0].change == pytest.approx(-turn * usual().params.pinion)
    behind = programme.at(ANGLE).ds < -1e-9
    assert (ANGLE[behind] > track.segments[-1].end).all()


@pytest.mark.parametrize("limit", [20, 35])
def test_cams_are_as_small_as_the_limits_let_them(limit: float) -> None:
    """Against the exact bounds of `cams.limits`."""
    params = WeaverParams(pressure_angle_limit=limit * deg)
    for cam in design(params).cams:
        exact = pressure_prime(cam.programme, CamLimits(limit * deg, limit * deg)).value
        hub = 0.7 * params.shaft + WALL + params.roller_radius
        grown = cam.cam.prime_radius > max(exact, hub) + 1.001 * mm
        assert cam.cam.prime_radius >= exact - 1e-6
        assert cam_limits.pressure_angle_max(cam.cam).value == pytest.approx(cam.pressure_angle, rel=5e-4)
        assert cam_limits.area(cam.cam) == pytest.approx(cam.area, rel=1e-4)
        sharpest = cam_limits.convex_radius_min(cam.cam).value
        assert cam.convex_radius == pytest.approx(sharpest, rel=2e-3)
        if grown:  # then the roller asked for it: a step smaller it would not have had its room
            smaller = cam.cam.resized(cam.cam.prime_radius / 1.07)
            assert cam_limits.convex_radius_min(smaller).value < 1.25 * params.roller_radius


@pytest.mark.parametrize("closure", ["spring", "groove"])
def test_the_cams_torque_does_the_work_of_brake_and_tools(closure: str) -> None:
    """Springs and inertia give back what they take; the brake keeps its force times the rack's path, the tools theirs.

    The tools' works are computed here by themselves, from their forces over their paths.
    """
    head = design(WeaverParams(closure=closure))
    params, opener = head.params, head.opener
    even = np.arange(20_000) * (turn / 20_000)
    handler = next(cam for cam in head.cams if cam.name == HANDLER)
    braked = handler.brake * turn * params.pinion
    path = np.linspace(0.0, opener.travel, 20_001)
    friction = np.trapezoid(opener.force(path, np.ones(20_001)) - opener.force(path, -np.ones(20_001)), path)
    along = head.grippers.crossing * 2 * params.friction * 2 * (opener.sides[-1] + opener.slots[-1])
    led = 2 * params.forces.yarn_pull * head.grippers.crossing
    forces = params.forces
    drawn = 2 * forces.yarn_pull * params.centre_stroke
    tight = 2 * (forces.tightening - forces.yarn_pull) * forces.tightening_travel / 2
    packed = forces.sley * forces.sley_travel / 2
    fetched = forces.yarn_pull * head.drawn
    work = braked + friction + along + led + drawn + tight + packed + fetched
    assert float(np.mean(torque_at(head.cams, even))) * turn == pytest.approx(work, rel=5e-3)
    assert head.drive.power_mean == pytest.approx(work / head.cycle, rel=1e-2)
    assert head.drive.torque_max == pytest.approx(float(np.abs(torque_at(head.cams, even)).max()), rel=1e-2)


def test_springs_hold_the_followers_and_no_more() -> None:
    for cam in usual().cams:
        assert cam.force.min() >= usual().params.contact_force - 1e-9
        assert cam.lift_off >= FASTER * usual().cyclogram.speed
    free = ToolForces(yarn_pull=0.0, tightening=0.0, sley=0.0)
    bare = design(WeaverParams(contact_force=0.0, forces=free))
    jaws = [cam for cam in bare.cams if cam.name.endswith("grasp")]
    assert all(cam.lift_off == pytest.approx(FASTER * bare.cyclogram.speed, rel=1e-6) for cam in jaws)


def test_a_groove_needs_no_spring_and_room_on_its_outer_flank() -> None:
    made = MACHINE.report(design(WeaverParams(closure="groove")))
    assert set(made.as_json()["results"]["spring_rate"].values()) == {0.0}
    assert any(check.name.startswith("roller in the groove") for check in made.checks)


def test_the_inertia_of_a_cam_is_between_those_of_its_circles() -> None:
    for cam in usual().cams:
        inner = float(np.abs(cam.trace.surface).min())
        mass = cam.area * cam.thickness * STEEL.density
        assert mass * inner**2 / 2 < cam.inertia < mass * cam.radius**2 / 2


def test_six_cams_stand_beside_each_other_on_the_shaft() -> None:
    results = MACHINE.report(usual()).as_json()["results"]
    params = usual().params
    assert results["cam_stack_width"] == pytest.approx(6 * params.cam_thickness + params.cam_belt + 8 * params.cam_gap)
    assert [cam.actuator for cam in usual().cams if cam.name == SLEY] == ["cam 6"]
    failed = [check.name for check in MACHINE.report(design(WeaverParams(head_width=0.05, cam_room=0.15))).failed]
    assert failed == [
        "cams beside each other",
        "diameter, side-gripper motion",
        "opener: width of the warps that it displaces",
    ]


@pytest.mark.parametrize("faster", [0.999, 1.001])
def test_the_limits_of_the_cycle_are_where_they_are_stated(faster: float) -> None:
    """Designed for a cycle a little shorter or longer than a limit, the head breaks or keeps it."""
    found = cycle_limits(usual())
    assert max(found, key=lambda name: found[name]) == "tools"
    free = WeaverParams(cycle=faster * found["cutter"], acceleration_limit=1e4, speed_limit=10.0)
    head = design(free)
    assert (head.params.cutting_time <= cut_share(head) * head.cycle) == (faster > 1)


def test_plates_and_tables_of_all_tracks() -> None:
    made = MACHINE.report(usual())
    plates = [plate for plate in made.plates if plate.paths]
    assert len(plates) == len(made.cam_tables) == 6
    for plate, cam in zip(plates, usual().cams, strict=True):
        assert plate.notes
        one, then = plate.outline, np.roll(plate.outline, -1)
        polygon = float(np.sum((np.conj(one) * then).imag)) / 2
        assert polygon == pytest.approx(cam.area, rel=1e-9)
        assert plate.area == pytest.approx(cam.area)
    for table in made.cam_tables:
        rows = table.motion(ANGLE)
        assert rows.shape == (3, len(ANGLE))
        assert np.gradient(rows[0], ANGLE)[1:-1] == pytest.approx(rows[1][1:-1], abs=2e-2 * np.abs(rows[1]).max())
        assert table.knots[0] == 0.0
        assert table.knots[-1] == pytest.approx(turn)
        assert rows[0][-1] - rows[0][0] == pytest.approx(table.revolves, abs=1e-12)


def test_motions_stretched_within_their_order_are_gentler_and_quicker() -> None:
    plain, better = usual(), design(WeaverParams(optimise=True))
    assert better.cycle == plain.cycle
    assert max(p.acceleration for p in better.peaks.values()) < max(p.acceleration for p in plain.peaks.values())
    assert better.shortest < plain.shortest
    assert MACHINE.report(better).failed == ()
    assert better.knot_tied == "symmetric"
    quickest = design(WeaverParams(optimise=True, cycle=0.1))
    assert quickest.cycle < design(WeaverParams(cycle=0.1)).cycle
    assert quickest.cycle == pytest.approx(quickest.shortest, rel=1e-6)


def test_the_selector_and_the_masses() -> None:
    results = MACHINE.report(usual()).as_json()["results"]
    assert results["selector_step"] == pytest.approx(16 * 0.012 / 200)  # a turn of the drum passes all tubes
    assert results["mass"] == pytest.approx(sum(results["masses"].values()))
    assert results["cutting_force"] == pytest.approx(96.0)
