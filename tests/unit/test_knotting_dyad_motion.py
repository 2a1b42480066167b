"""The knotting dyad in time: the cycle, the torques of its joints, the servos."""

import dataclasses
import functools
import itertools
import json

import numpy as np
import pytest

from ilmek.arrays import FloatArray
from ilmek.machines.knotting_dyad import MACHINE, design
from ilmek.machines.knotting_dyad.arm_drives import behind
from ilmek.machines.knotting_dyad.arms import carried, inertias
from ilmek.machines.knotting_dyad.drives import HeadMotion, drives_of, head_motion
from ilmek.machines.knotting_dyad.figures import cyclogram, motion_figures
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.jaw_parts import FOOT_WIDTH, finger_part, on_link
from ilmek.machines.knotting_dyad.jaws import openness
from ilmek.machines.knotting_dyad.motion import LEFT, RIGHT, KnotCycle
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.tree import tree
from ilmek.report import Plot, Timing, results_of
from ilmek.timing.s_curve import AxisLimits, move_time
from ilmek.units import turn

Settings = tuple[tuple[str, str], ...]


@functools.cache
def head_of(knot: str, opens: str) -> Head:
    head = design(KnottingDyadParams(knot=knot, opens=opens)).head
    assert head is not None
    return head


@functools.cache
def made(settings: Settings = ()) -> tuple[KnottingDyadParams, Head, HeadMotion]:
    params = KnottingDyadParams.read(dict(settings))
    head = head_of(params.knot, params.opens)
    return params, head, head_motion(params, head)


POINTS = {"points": "(12mm,4mm) (18.5mm,9.5mm) (24mm,8mm) (27mm,3mm)", "angles": "20deg 65deg 100deg 150deg"}
DIRECT: Settings = (("elbow_drive", "direct"), ("elbow_mass", "20g"))
ASYMMETRIC: Settings = (("knot", "asymmetric"), ("opens", "right"), ("gravity", "0"))


def links_of(head: Head) -> tuple[float, float]:
    return abs(head.arm.first), head.arm.second


def equations(params: KnottingDyadParams, head: Head, motion: HeadMotion, side: str) -> FloatArray:
    """Generalised torques of the absolute angles of both links, by Lagrange's equations of the RR arm.

    Q1 = I1 a1 + h cos(t1 - t2) a2 + h sin(t1 - t2) w2² + (m1 c1 + m2 l1) g cos t1 - F . l1 i e^{i t1}
    Q2 = I2 a2 + h cos(t1 - t2) a1 - h sin(t1 - t2) w1² + m2 c2 g cos t2 - F . l2 i e^{i t2}
    I1 = J1 + m1 c1² + m2 l1²,   I2 = J2 + m2 c2²,   h = m2 l1 c2
    """
    arm = motion.cycle.arms[side]
    (t1, t2), (w1, w2), (a1, a2) = arm.angle.T, arm.speed.T, arm.acceleration.T
    one, two = inertias(params, head, motion.hole).values()
    l1, l2 = links_of(head)
    c1, c2 = one.centre.real, two.centre.real
    I1, I2, h = one.moment + one.mass * c1**2 + two.mass * l1**2, two.moment + two.mass * c2**2, two.mass * l1 * c2
    first = I1 * a1 + h * np.cos(t1 - t2) * a2 + h * np.sin(t1 - t2) * w2**2
    second = I2 * a2 + h * np.cos(t1 - t2) * a1 - h * np.sin(t1 - t2) * w1**2
    first += (one.mass * c1 + two.mass * l1) * params.gravity * np.cos(t1)
    second += two.mass * c2 * params.gravity * np.cos(t2)
    pull = pulls(params, head, motion.cycle, side)
    along = [length * 1j * np.exp(1j * angle) for length, angle in ((l1, t1), (l2, t2))]
    return np.stack([q - (np.conj(pull) * way).real for q, way in zip((first, second), along, strict=True)], 1)


def pulls(params: KnottingDyadParams, head: Head, cycle: KnotCycle, side: str) -> np.ndarray:
    """Force of the yarn on the tip."""
    arm = cycle.arms[side]
    velocity = (np.array(links_of(head)) * 1j * np.exp(1j * arm.angle) * arm.speed).sum(1)
    size = np.abs(velocity)
    return np.where(arm.leads & (size > 0), -params.yarn_pull * velocity / np.maximum(size, 1e-300), 0)


@pytest.mark.parametrize("settings", [(), DIRECT, ASYMMETRIC], ids=["belt", "direct", "asymmetric"])
@pytest.mark.parametrize("side", [LEFT, RIGHT])
def test_torques_are_those_of_the_closed_equations_of_the_arm(settings: Settings, side: str) -> None:
    params, head, motion = made(settings)
    absolute = equations(params, head, motion, side)
    expected = absolute if params.elbow_drive == "belt" else np.stack([absolute.sum(1), absolute[:, 1]], 1)
    found = motion.arms[side].torque
    assert np.abs(found - expected).max() <= 1e-9 * np.abs(expected).max()
    assert motion.power_error < 1e-12


@pytest.mark.parametrize("settings", [(), DIRECT, ASYMMETRIC], ids=["belt", "direct", "asymmetric"])
def test_limits_hold_at_the_drives_and_some_are_reached(settings: Settings) -> None:
    params, _, motion = made(settings)
    worst = 0.0
    for course in motion.cycle.arms.values():
        for rate, limit in (("speed", "joint_speed"), ("acceleration", "joint_acceleration"), ("jerk", "joint_jerk")):
            links = getattr(course, rate)
            elbow = links[:, 1] if params.elbow_drive == "belt" else links[:, 1] - links[:, 0]
            worst = max(worst, float(np.abs(np.stack([links[:, 0], elbow])).max()) / getattr(params, limit))
    assert 0.99 < worst <= 1 + 1e-3
    assert motion.cycle.used.max() == pytest.approx(worst, rel=1e-12)
    assert motion.cycle.usage <= 1 + 1e-9


@pytest.mark.parametrize("name", ["centre_speed", "centre_acceleration", "centre_jerk"])
def test_the_limit_that_holds_the_centre_gripper_back_is_used_up(name: str) -> None:
    params = KnottingDyadParams(**{name: 0.01 * getattr(KnottingDyadParams(), name)})
    made_ = design(params)
    assert made_.head is not None
    assert head_motion(params, made_.head).cycle.usage == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("settings", [(), ASYMMETRIC], ids=["symmetric", "asymmetric"])
def test_the_cycle_goes_round_without_a_jump_and_follows_the_paths(settings: Settings) -> None:
    params, head, motion = made(settings)
    cycle = motion.cycle
    assert cycle.time[0] == 0.0
    assert cycle.time[-1] == pytest.approx(cycle.period, rel=1e-12)
    assert (np.diff(cycle.time) >= 0).all()
    assert (cycle.arms[LEFT].s + cycle.arms[RIGHT].s).max() <= 1 + 1e-9
    for side, course in cycle.arms.items():
        assert course.s[0] == pytest.approx(course.s[-1], abs=1e-12)
        exact = head.arm.path(np.clip(course.s, 0.0, 1.0)).theta
        assert np.abs(course.angle - (exact if side == LEFT else np.pi - exact)).max() < 1e-9
        steps = np.diff(cycle.time)[:, None]
        trapezoid = (course.speed[1:] + course.speed[:-1]) / 2 * steps
        room = params.joint_jerk * steps**3 / 12 * (1 + 1e-3) + params.joint_acceleration * 1e-12
        assert (np.abs(np.diff(course.angle, axis=0) - trapezoid) <= room + 1e-9).all()
    height, rate = cycle.centre[:2]
    assert height.min() == pytest.approx(-head.section.depth)
    assert height[0] == height[-1] == head.section.front
    assert np.abs(np.diff(height) - (rate[1:] + rate[:-1]) / 2 * np.diff(cycle.time)).max() < 1e-5


def test_parts_follow_one_another_and_every_grip_has_its_grippers() -> None:
    params, head, motion = made()
    parts = motion.cycle.parts
    assert [part.name for part in parts if not part.grippers] == [phase.name for phase in head.sequence]
    assert all(first.end == then.start for first, then in itertools.pairwise(parts))
    grips = [(part.name, part.grippers) for part in parts if part.grippers]
    assert grips == [
        ("grasp", ("left", "right")),
        ("grasp", ("centre",)),
        ("release", ("left",)),
        ("release", ("centre",)),
        ("grasp", ("centre",)),
        ("release", ("right",)),
        ("release", ("centre",)),
    ]
    pauses = sum(part.end - part.start for part in parts if part.grippers)
    assert pauses == pytest.approx(3 * params.grasp_time + 4 * params.release_time)
    centre = AxisLimits(params.centre_speed, params.centre_acceleration, params.centre_jerk)
    assert parts[2].end - parts[2].start == pytest.approx(move_time(head.centre_stroke, centre))


def test_tighter_limits_take_longer_and_grips_without_time_are_no_parts() -> None:
    quick = made()[2].cycle.period
    assert made((("joint_jerk", "2e4"),))[2].cycle.period > quick
    no_grips = made((("grasp_time", "0"), ("release_time", "0")))[2].cycle
    assert no_grips.period == pytest.approx(quick - 0.1)
    assert len(no_grips.parts) == 7


def test_servos_are_strong_and_quick_enough_with_their_own_rotors() -> None:
    params, head, motion = made((("gear_ratio", "5"), ("rotor_inertia", "1e-5kg*m^2")))
    for at, drive in enumerate(motion.joints):
        assert drive.motor is not None
        assert drive.gear_ratio == 5
        assert drive.servo_speed == pytest.approx(5 * drive.speed_max)
        assert drive.motor.speed >= drive.servo_speed
        assert drive.motor.torque >= max(drive.servo_torque_rms, drive.servo_torque_max / params.servo_overload)
        arms = motion.cycle.arms
        expected = max(
            float(
                np.abs(
                    motion.arms[side].torque[:, at] / (5 * params.gear_efficiency)
                    + 5e-5 * arms[side].acceleration[:, at]
                ).max()
            )
            for side in arms
        )
        assert drive.servo_torque_max == pytest.approx(expected, rel=1e-12)
    heavy = dataclasses.replace(params, elbow_mass=9.0, gear_ratio=None)
    stronger = drives_of(heavy, head, motion.cycle, motion.hole)[1][0].motor
    assert stronger is None or stronger.power > 100


def test_no_servo_is_reported_and_results_have_the_promised_names() -> None:
    params, _, motion = made((("gear_ratio", "9000"),))
    assert len([warning for warning in MACHINE.report(design(params)).warnings if "no servo" in warning]) == 2
    values = {result.name: result.value for result in results_of(motion)}
    assert json.dumps(values)
    assert values["servo"] is None
    assert {"cycle_time", "torque_max", "torque_rms", "joint_speed_max", "drives", "cycle"} < set(values)
    assert values["cycle_time"] == motion.cycle.period


def test_figures_cover_the_cycle() -> None:
    _, _, motion = made()
    timing, *plots = motion_figures(motion)
    assert isinstance(timing, Timing)
    for lane in cyclogram(motion.cycle).lanes:
        assert lane.angle[0] == 0.0
        assert lane.angle[-1] == pytest.approx(turn)
        assert (np.diff(lane.angle) > 0).all()
        assert lane.position.min() == 0.0
        assert lane.position.max() == pytest.approx(1.0)
    assert len(plots) == 4
    for plot in plots:
        assert isinstance(plot, Plot)
        assert len(plot.series) == (3 if plot.name.endswith("limits") else 4)
        assert len(plot.marks) == 7


def test_parts_and_work_of_the_arms_of_a_head() -> None:
    made_ = design(KnottingDyadParams())
    parts = {part.name: part for part in MACHINE.parts(made_)}
    assert made_.head is not None
    one, two = inertias(made_.params, made_.head, head_motion(made_.params, made_.head).hole).values()
    on_first = ("link 1 of an arm", "pin of an arm", "sleeve of a first link, with its pulley", "belt of an elbow")
    on_second = {"link 2 of an arm": 1, "hub of an elbow": 1, "pulley of an elbow": 1, "blade of a needle": 1}
    on_second |= {f"{name} of a finger": 1 for name in ("pin", "spring", "solenoid")}
    on_second |= {"neck of a solenoid": 1, "cap of a neck": 1}
    on_second |= {"lug of a finger's pin": 2, "finger of an arm": 1, "rod of the finger of an arm": 1}
    assert sum(parts[name].mass for name in on_first) == pytest.approx(one.mass)
    assert sum(number * parts[name].mass for name, number in on_second.items()) == pytest.approx(two.mass)
    driven = [part.number for part in parts.values() if part.drives]
    assert sum(driven) == 8  # two servos an arm, the motor of the centre gripper, a solenoid for each finger
    work, jaws = MACHINE.work(made_)
    assert (jaws.name, jaws.per) == ("jaws", "knot")
    motion, energy = head_motion(made_.params, made_.head), 0.0
    for name, arm in motion.cycle.arms.items():
        power = motion.arms[name].torque * arm.speed
        steps = np.diff(motion.cycle.time)[:, None]
        energy += float((np.maximum((power[1:] + power[:-1]) / 2, 0.0) * steps).sum())
    assert work.per == "knot"
    assert work.energy == pytest.approx(energy, rel=1e-2)
    assert MACHINE.parts(design(KnottingDyadParams.read(POINTS))) == ()


def test_the_machine_itself_reports_its_cycle() -> None:
    said = MACHINE.report(MACHINE.design(KnottingDyadParams())).as_json()
    assert 0.1 < said["results"]["cycle_time"] < 1.0
    assert said["results"]["torque_max"] > 0
    assert all(check["ok"] for check in said["checks"])


def test_jaws_hold_the_yarn_open_within_their_time_and_stay_in_the_needles_strip() -> None:
    """Judged by the finger's lever, and by the corners of its mesh: across the gap nothing is wider than the needle."""
    params, head, motion = made()
    jaws = motion.jaws
    pressed = jaws.preload + jaws.rate * jaws.strokes["left"] * params.pressed / jaws.opening
    pull = pressed * jaws.arm / jaws.tip * 2 * params.cloth.yarns.friction
    assert pull >= params.grip_safety * params.yarn_pull * (1 - 1e-9)
    assert jaws.opening > params.yarn
    assert jaws.opens_in < params.release_time
    assert jaws.closes_in < params.grasp_time
    shape = finger_part(params, head, jaws, False).shape
    assert shape is not None
    points = shape.mesh(1e-6).points
    beyond = points[points[:, 0] > jaws.tip - head.section.needle_length + 0.2e-3]
    assert np.ptp(beyond[:, 1]) <= params.needle_diameter * (1 + 1e-9)
    assert np.abs(points[:, 1]).max() < params.link_width / 2
    for part in motion.cycle.parts:
        for gripper in part.grippers:
            open_ = openness(motion.cycle, gripper, np.array([part.start, part.end]))
            assert open_.tolist() == ([1.0, 0.0] if part.name == "grasp" else [0.0, 1.0])


def test_arms_with_broad_blades_or_a_deep_hand_over_have_their_parts_whatever_is_kept_of_them() -> None:
    """What was designed between arms and tree drops the parts that are kept: a loom's choice found that."""
    made_ = design(KnottingDyadParams.read({"needle_breadth": "14mm", "depth": "100mm"}))
    assert made_.head is not None
    motion = head_motion(made_.params, made_.head)
    carried(made_.params, made_.head, motion.hole)
    on_link.cache_clear()
    parts = {part.id: part for part, _ in tree(made_).occurrences()}
    shapes = {name: parts[f"knotting-dyad/{name}"].shape for name in ("finger", "centre-bar")}
    finger, bar = (shape.mesh(1e-5).points for shape in shapes.values() if shape is not None)
    clear = finger[finger[:, 0] > motion.jaws.tip - made_.head.section.needle_length + 0.2e-3, 2]
    assert clear.min() > made_.params.needle_breadth / 2 - motion.jaws.deep
    assert clear.max() == pytest.approx(finger[:, 2].max())
    nose = made_.head.arm.second + made_.head.section.front - behind(made_.head)
    assert nose - bar[:, 0].min() >= FOOT_WIDTH - 1e-9
