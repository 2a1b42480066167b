"""The edges of solving: batches, inputs, failures as values, failures in words."""

import dataclasses
import pickle

import numpy as np
import pytest

from ilmek.errors import MechanismError
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import GROUND, Body, Displacement, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Status
from ilmek.linkage.solve import BLOCK, solve
from ilmek.linkage.structure import plan

BEAT_UP = plan(four_bar(0.300, 0.0597, 0.2007, 0.2308, branch=+1, points={"rocker": {"E": 0.3001}}, name="beat-up"))
SHORT = plan(four_bar(0.300, 0.200, 0.200, 0.230, branch=+1, name="beat-up"))


def test_samples_of_a_long_batch_do_not_depend_on_the_block_they_fall_in():
    angle = np.linspace(0, 6, 2 * BLOCK + 77)
    speed, acceleration = 15 + np.sin(angle), np.cos(angle)
    whole = solve(BEAT_UP, angle, speed, acceleration)
    for at in (0, BLOCK - 1, BLOCK, 2 * BLOCK + 76):
        one = solve(BEAT_UP, angle[at], speed[at], acceleration[at])
        assert one.alpha("rocker")[0] == pytest.approx(whole.alpha("rocker")[at], rel=1e-12)
        assert one.direction("coupler")[0] == pytest.approx(whole.direction("coupler")[at], rel=1e-14)


def test_constants_are_spread_over_the_samples():
    motion = solve(BEAT_UP, np.linspace(0, 6, 50), 15.5)
    assert motion.omega("crank").shape == motion.origin("rocker").shape == motion.origin(GROUND).shape == (50,)
    assert (motion.alpha("crank") == 0).all()
    assert (motion.point(GROUND, "B0").position == 0.3).all()
    assert len(motion) == 50


def test_angle_is_unwrapped_over_several_turns():
    angle = np.linspace(0.5, 20, 400)
    np.testing.assert_allclose(solve(BEAT_UP, angle).angle("crank"), angle, atol=1e-12)


def test_failing_samples_are_values_and_the_others_go_on():
    angle = np.radians(np.arange(0.0, 360.0, 1.0))
    motion = solve(SHORT, angle)
    lost = motion.status == Status.CANNOT_CLOSE
    assert motion.status.dtype == np.int8
    assert (np.flatnonzero(lost) == np.arange(118, 243)).all()
    assert np.isnan(motion.point("rocker", "B").position[lost]).all()
    assert np.isfinite(motion.point("rocker", "B").acceleration[~lost]).all()


def test_require_says_where_by_how_much_and_what_to_do():
    with pytest.raises(MechanismError) as caught:
        solve(SHORT, np.radians(np.arange(0.0, 360.0, 1.0))).require()
    assert str(caught.value) == (
        "beat-up cannot close for crank 118.0°..242.0°: |A-B0| reaches 500 mm, coupler + rocker = 430 mm; "
        "lengthen one by 70 mm or limit the crank"
    )


def test_require_names_pins_that_come_too_near():
    narrow = plan(four_bar(0.10, 0.09, 0.30, 0.20, branch=+1))
    with pytest.raises(
        MechanismError, match=r"\|A-B0\| falls to 10 mm, coupler - rocker = 100 mm; lengthen rocker by 90"
    ):
        solve(narrow, np.radians(np.arange(0.0, 360.0, 10.0))).require()


def test_require_names_a_rod_too_short_and_every_range():
    with pytest.raises(MechanismError) as caught:
        solve(plan(slider_crank(0.3, 0.2, branch=1)), np.radians(np.arange(0.0, 360.0, 1.0))).require()
    assert "for crank 42.0°..138.0°, 222.0°..318.0°: the line of slider is 300 mm" in str(caught.value)
    assert "rod = 200 mm; lengthen rod by 100 mm or limit the crank" in str(caught.value)


def test_require_gives_back_a_motion_that_is_whole():
    motion = solve(BEAT_UP, 1.0)
    assert motion.require() is motion


def test_links_in_line_are_a_dead_centre_not_a_number():
    parallel = plan(four_bar(0.3, 0.1, 0.3, 0.1, branch=-1))
    motion = solve(parallel, np.array([0.0, 1.0, np.pi]), 1.0)
    assert list(motion.status) == [Status.DEAD_CENTRE, Status.OK, Status.DEAD_CENTRE]
    with pytest.raises(MechanismError, match=r"dead centre for crank 0\.0°, 180\.0°; coupler and rocker are in line"):
        motion.require()


@pytest.mark.parametrize("away", [0j, 10 + 3j, 100j])
def test_accelerations_beside_a_limit_do_not_depend_on_the_origin(away):
    near = four_bar(0.1, 0.07, 0.001, 0.03, branch=1)
    bodies = tuple(
        Body(body.name, {name: at + away for name, at in body.points.items()}) if body.name == GROUND else body
        for body in near.bodies
    )
    limit = np.arccos((0.1**2 + 0.07**2 - 0.031**2) / (2 * 0.1 * 0.07))
    angle = limit - np.array([1e-3, 1e-4, 1e-5])
    here, there = (solve(plan(one), angle, 1.0) for one in (near, dataclasses.replace(near, bodies=bodies)))
    assert here.ok
    assert there.ok
    np.testing.assert_allclose(there.alpha("rocker"), here.alpha("rocker"), rtol=1e-3)


def test_a_small_link_beside_its_limit_is_not_ok_where_rounding_leaves_no_digits():
    motion = solve(plan(four_bar(1, 0.7, 0.001, 0.3, branch=1)), 0.029302437856667495, 1.0)
    assert motion.status[0] == Status.DEAD_CENTRE


def test_near_a_dead_centre_rates_are_large_but_right():
    motion = solve(plan(four_bar(0.3, 0.1, 0.3, 0.1, branch=+1)), np.array([1e-4]), 2.0)
    assert motion.ok
    assert motion.omega("rocker")[0] == pytest.approx(2.0, rel=1e-6)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (dict(angle=np.array([0.0, np.nan])), "value of input 'crank' is not finite"),
        (dict(angle=np.zeros(3), speed=np.zeros(4)), r"shapes \(3,\) and \(4,\)"),
        (dict(angle=np.zeros(0)), "no samples"),
        (dict(angle=np.zeros((2, 2))), r"shapes \(2, 2\)"),
        (dict(angle={"rocker": 0.0}), "unknown input 'rocker'"),
        (dict(angle={}), "no value given for input 'crank'"),
    ],
)
def test_bad_inputs_are_refused(given, said):
    with pytest.raises(MechanismError, match=said):
        solve(BEAT_UP, **given)


def test_unknown_bodies_and_points_are_named():
    motion = solve(BEAT_UP, 0.0)
    with pytest.raises(MechanismError, match="did you mean 'rocker'"):
        motion.omega("roker")
    with pytest.raises(MechanismError, match="it has E, B0, B"):
        motion.point("rocker", "F")


def table() -> Mechanism:
    """A cross table: an x slide driven by 100 mm, a y slide on it, and a disc turning on that."""
    return Mechanism(
        bodies=(
            Body(GROUND, {"x": 1j}),
            Body("saddle", {"x": 0, "y": 0.5}),
            Body("table", {"y": 0, "centre": 0.2}),
            Body("disc", {"centre": 0, "rim": 0.1}),
        ),
        joints=(
            Slide("x", "saddle", GROUND),
            Slide("y", "saddle", "table", along=np.pi / 2),
            Pin("centre", "table", "disc"),
        ),
        inputs=(Displacement("x"), Displacement("y"), Rotation("table", "centre")),
    )


def test_several_inputs_by_name_also_seen_from_the_other_body():
    time = np.linspace(0, 1, 5)
    motion = solve(
        plan(table()),
        {"x": 0.3 * time, "y": -0.2 * time, "table": -0.5 * time},
        {"x": 0.3, "y": -0.2, "table": -0.5},
    )
    rim = motion.point("disc", "rim")
    at = 1j + 0.3 * time + 0.5 + 0.2j * time + 0.2 + 0.1 * np.exp(0.5j * time)
    np.testing.assert_allclose(rim.position, at, atol=1e-15)
    np.testing.assert_allclose(rim.velocity, 0.3 + 0.2j + 0.05j * np.exp(0.5j * time), atol=1e-15)
    np.testing.assert_allclose(rim.acceleration, -0.025 * np.exp(0.5j * time), atol=1e-15)


def test_a_lone_speed_for_several_inputs_is_refused():
    with pytest.raises(MechanismError, match="one speed given for the inputs x, y, table; give a mapping"):
        solve(plan(table()), {"x": 0.0, "y": 0.0, "table": 0.0}, 1.0)


def test_plans_and_motions_travel_between_processes():
    motion = pickle.loads(pickle.dumps(solve(BEAT_UP, np.array([0.0, 1.0]), 15.5)))
    assert motion.omega("rocker")[1] == solve(BEAT_UP, 1.0, 15.5).omega("rocker")[0]
