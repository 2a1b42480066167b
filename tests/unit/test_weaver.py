"""The knotting head: order of motions, limits, cycle."""

import math
from itertools import combinations

import numpy as np
import pytest
from cloths import cloth

from ilmek.cams.laws import SMOOTH_LAWS
from ilmek.cams.loaded_plate_cam import torque_at
from ilmek.errors import ParameterError
from ilmek.machines.weaver import MACHINE, WeaverParams, design, mass_of
from ilmek.machines.weaver.cyclogram import DRAW_TURN
from ilmek.machines.weaver.motions import HANDLER, SLEY
from ilmek.machines.weaver.rods import rod_frequency
from ilmek.timing.s_curve import AxisLimits, move_time, s_curve, travel_time
from ilmek.timing.track import sample
from ilmek.units import deg


def test_the_default_head_passes_all_checks_and_beats_the_hand() -> None:
    made = MACHINE.report(design(WeaverParams()))
    assert made.failed == ()
    assert made.results[0].name == "cycle_time_knot"
    assert made.results[0].value == 2.0
    assert any("hand weaver" in check.source and check.limit == 2.4 for check in made.checks)


@pytest.mark.parametrize(("law", "limit"), [*((law, 20.0) for law in SMOOTH_LAWS), ("scca", 5.0), ("3-4-5", 80.0)])
def test_no_tool_exceeds_its_limits_at_the_shortest_cycle(law: str, limit: float) -> None:
    head = design(WeaverParams(cycle=0.01, law=law, acceleration_limit=limit))
    assert head.cycle == pytest.approx(head.shortest)
    angle = np.linspace(0, 2 * math.pi, 20001)
    largest = 0.0
    for track in head.cyclogram.tracks:
        arm = head.handler_radius if track.name == HANDLER else 1.0
        motion = sample(track, angle)
        speed = np.abs(motion.slope).max() * arm * head.cyclogram.speed
        acceleration = np.abs(motion.bend).max() * arm * head.cyclogram.speed**2
        assert speed <= 1.0 + 1e-9
        assert acceleration <= limit * (1 + 1e-9)
        largest = max(largest, float(speed), float(acceleration) / limit)
    assert largest == pytest.approx(1.0, abs=2e-3)


def test_a_cycle_that_is_too_short_fails() -> None:
    weaver = design(WeaverParams(cycle=0.5))
    (failed,) = MACHINE.report(weaver).failed
    assert (failed.name, failed.value, failed.limit) == ("knot cycle, as required", weaver.cycle, 0.5)
    assert "limits of the sley allow no less" in failed.source


def test_a_slow_head_fails_against_the_hand() -> None:
    failed = MACHINE.report(design(WeaverParams(cycle=3.0))).failed
    assert [check.name for check in failed] == ["knot cycle"]


@pytest.mark.parametrize("shift", [-20, 0, 20])
def test_the_order_holds_wherever_the_steps_end(shift: float) -> None:
    moved = WeaverParams(open_end=(172 + shift) * deg, knot_end=(250 - shift / 2) * deg, relation_gap=0.5 * deg)
    assert [check.name for check in MACHINE.report(design(moved)).failed if " after " in check.name] == []


def test_a_gap_that_does_not_fit_is_found() -> None:
    failed = MACHINE.report(design(WeaverParams(relation_gap=20 * deg))).failed
    assert failed
    assert all("after" in check.name for check in failed)


def test_the_handler_draws_the_yarn_of_a_knot() -> None:
    head = design(WeaverParams(knot_yarn=0.05))
    draw = head.cyclogram.track(HANDLER).segment("draw")
    assert head.handler_radius * (draw.finish - draw.begin) == pytest.approx(0.05)
    assert draw.finish - draw.begin == pytest.approx(DRAW_TURN)


def test_the_screw_turns_the_grippers() -> None:
    assert design(WeaverParams(crossing=0.02, crossing_turn=180 * deg)).grippers.screw_lead == pytest.approx(0.04)


@pytest.mark.parametrize("tubes", [1, 2, 3, 16, 40])
def test_colour_change_is_the_mean_over_all_pairs_of_tubes(tubes: int) -> None:
    """Along a tier and from tier to tier at the same time; a tier of the drum has 16 tubes at most here."""
    most = -(-tubes // -(-tubes // 16))
    at = [divmod(k, most) for k in range(tubes)]
    axis = AxisLimits(0.2, 1.0, 50.0)
    times = [
        max(move_time(0.012 * abs(then[k] - one[k]), axis) if then[k] != one[k] else 0.0 for k in (0, 1))
        for one, then in combinations(at, 2)
    ]
    assert design(WeaverParams(tubes=tubes)).colour_change == pytest.approx(sum(times) / max(len(times), 1))


@pytest.mark.parametrize("cycle", [0.1, 0.28, 0.3, 0.35, 0.5, 1.0, 2.0])
@pytest.mark.parametrize("jerk", [2.0, 100.0, 1e9])
@pytest.mark.parametrize(("pitch", "speed", "pull"), [(0.004, 0.25, 2.0), (0.0006, 1.0, 0.5), (0.008, 0.05, 40.0)])
def test_no_move_takes_longer_than_the_window_and_its_further_pitches(cycle, pitch, speed, pull, jerk) -> None:
    params = WeaverParams(
        cloth=cloth(warp_pitch=pitch / 2),
        carriage_speed=speed,
        carriage_acceleration=pull,
        carriage_jerk=jerk,
    )
    window = 0.44 * cycle
    room, travel = max(window, move_time(pitch, params.carriage)), travel_time(pitch, window, params.carriage)
    limits = AxisLimits(speed, pull, jerk)
    pitches = [*range(1, 60), *range(60, 3000, 37)]
    excess = [move_time(d * pitch, limits) - room - (d - 1) * travel for d in pitches]
    assert max(excess) <= 1e-12
    asked = max(excess[1:])
    assert travel == pytest.approx(pitch / speed) or asked >= -travel  # no more than some move asks


def test_steps_must_follow_each_other() -> None:
    with pytest.raises(ParameterError, match="open_end=100 deg leaves the step after prepare_end no room"):
        WeaverParams(open_end=100 * deg)


def test_the_machine_reads_its_parameters() -> None:
    made = MACHINE.report_for({"cycle": "2.2s", "law": "cycloidal", "tubes": "8"})
    assert made.as_json()["results"]["knots_per_minute"] == pytest.approx(60 / 2.2)
    assert {"knot", "weaver-plan", "weaver-moving"} <= {figure.name for figure in made.figures}


def test_the_selector_has_time_for_the_longest_travel_while_a_knot_is_tied() -> None:
    """From the cut to the next grasp, 0.62 and 0.285 of the first step: 1.81 s of 2 s; the longest takes 1.12 s."""
    head = design(WeaverParams())
    assert head.selector_window == pytest.approx(2 * (360 - 0.62 * 104 + 0.285 * 104) / 360)
    assert head.colour_change < head.colour_change_longest == pytest.approx(0.18 / 0.2 + 0.2 + 1 / 50)
    assert head.colour_change_longest < head.selector_window


def test_tools_too_heavy_for_a_motor_are_reported() -> None:
    heavy = MACHINE.report(design(WeaverParams(tool_mass=100.0, cycle=0.1, speed_limit=100.0, acceleration_limit=1e5)))
    assert heavy.as_json()["results"]["motor"] is None
    assert "motor of the cam shaft" in [check.name for check in heavy.failed]
    (warning,) = MACHINE.report(design(WeaverParams())).warnings
    assert "more yarn than the bill's" in warning


def test_the_angles_of_a_tool_can_be_set_and_its_motions_keep_their_shares() -> None:
    usual = design(WeaverParams()).cyclogram.track(HANDLER)
    quick = design(WeaverParams.read({"pile_handler.rise": "60deg"}))
    track = quick.cyclogram.track(HANDLER)
    assert track.segment("to tube").start == 0.0
    assert track.segment("present").end == pytest.approx(60 * deg)
    shares = [[edge / track.segments[2].end for edge in (one.start, one.end)] for one in track.segments[:3]]
    then = [[edge / usual.segments[2].end for edge in (one.start, one.end)] for one in usual.segments[:3]]
    assert np.array(shares) == pytest.approx(np.array(then))
    assert track.event("cut").angle == pytest.approx(60 / (0.89 * 104) * 0.62 * 104 * deg)
    assert track.segment("home") == usual.segment("home")
    assert quick.peaks[HANDLER].acceleration > design(WeaverParams()).peaks[HANDLER].acceleration
    later = WeaverParams.read({"sley.start": "300deg", "sley.rise": "20deg", "sley.return_start": "325deg"})
    down, up = design(later).cyclogram.track(SLEY).segments
    assert (down.start, down.end, up.start) == pytest.approx((300 * deg, 320 * deg, 325 * deg))


def test_angles_of_a_tool_that_break_the_order_of_the_tools_fail_a_check() -> None:
    failed = MACHINE.report_for({"pile_handler.fall": "55deg"}).failed
    assert failed[0].name.startswith("side-gripper motion: open warps")


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"pile_handler.rise": "150deg"}, "pile_handler.rise=150 deg: the motions forward end at 150 deg, those back"),
        ({"sley.fall": "45deg"}, "sley.fall=45 deg: the motions back end at"),
        ({"sley.rise": "10deg", "optimise": "yes"}, "optimise chooses the cam angles .* sley.rise is set"),
        ({"sley.raise": "10deg"}, "did you mean sley.rise"),
    ],
)
def test_angles_of_a_tool_that_contradict_are_refused_by_their_names(settings: dict[str, str], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        WeaverParams.read(settings)


def test_parts_and_work_of_one_head() -> None:
    head = design(WeaverParams())
    parts = {part.name: part for part in MACHINE.parts(head)}
    mass = sum(part.mass_all for part in parts.values())
    assert mass == pytest.approx(sum(mass_of(head).values()))
    assert parts["yarn tube"].number == 16
    assert [part.name for part in parts.values() if part.drives] == [
        "motor of the cutter",
        "motor of a head",
        "motor of the colours",
        "motor of a carriage",
    ]
    work = {one.name: one for one in MACHINE.work(head)}
    even = np.arange(20_000) * (2 * math.pi / 20_000)
    torque = np.maximum(torque_at(head.cams, even), 0.0)
    assert work["knotting"].energy == pytest.approx(float(torque.mean()) * 2 * math.pi, rel=1e-3)
    step = s_curve(0.004, AxisLimits(0.25, 1.0, 100.0))
    assert work["carriages"].energy == pytest.approx(0.5 * mass * step.speed**2)
    heavy = design(WeaverParams(head_mass=2 * mass))
    (carriages,) = (one for one in MACHINE.work(heavy) if one.name == "carriages")
    assert carriages.energy == pytest.approx(2 * work["carriages"].energy)
    assert [one.per for one in work.values()] == ["knot", "knot", "knot", "colour change"]


def test_work_of_the_moves_is_their_greatest_kinetic_energy() -> None:
    params = WeaverParams(head_mass=3.0)
    radius, tube = 16 * 12e-3 / (2 * np.pi) + 6e-3, 0.3 * 12e-3
    drum = np.pi * (radius**2 - 16 * tube**2) * 3e-3 * 2700  # aluminium, open below each tube
    tubes = params.tubes * params.tube_mass + drum
    carriage = AxisLimits(params.carriage_speed, params.carriage_acceleration, params.carriage_jerk)
    selector = AxisLimits(params.selector_speed, params.selector_acceleration, params.selector_jerk)
    work = {one.name: one for one in MACHINE.work(design(params))}
    assert {name: one.per for name, one in work.items()} == {
        "knotting": "knot",
        "cutting": "knot",
        "carriages": "knot",
        "colours": "colour change",
    }
    for name, mass, travel, limits in (
        ("carriages", 3.0, params.cloth.knot_pitch, carriage),
        ("colours", tubes, 16 * 12e-3 / 3, selector),
    ):
        time = np.linspace(0.0, move_time(travel, limits), 20001)
        speed = np.gradient(s_curve(travel, limits).at(time)[0], time)
        assert work[name].energy == pytest.approx(mass * speed.max() ** 2 / 2, rel=1e-3)


def test_a_gripper_s_rod_vibrates_as_a_cantilever_with_a_mass_at_its_end() -> None:
    """Rao, 1.5 and table of equivalent masses: f = sqrt(3 E I / (l³ (M + 0.236 m))) / 2π, M the arm."""
    weaver = design(WeaverParams())
    params, by = weaver.params, weaver.grippers
    outer, bore = params.finger, params.finger / 2
    length, area = params.opening + by.crossing, math.pi * (outer**2 - bore**2) / 4
    mass, inertia = 7900 * area, math.pi * (outer**4 - bore**4) / 64
    expected = math.sqrt(3 * 200e9 * inertia / (length**3 * mass * (by.arm + 0.236 * length)))
    assert rod_frequency(params, by) == pytest.approx(expected, rel=0.01)
    thin = {check.name for check in MACHINE.report_for({"finger": "0.5mm"}).failed}
    assert "stress of a side gripper's rod" in thin
