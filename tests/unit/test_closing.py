"""Closing ranges: at any number of steps, however short, beyond a turn, at change points, with several inputs."""

import math

import mechanisms
import numpy as np
import pytest

from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import mechanism_toml, parse_mechanism
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.linkage.closing import closing
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.one_input import one_input
from ilmek.linkage.pose_branch import pose_branch
from ilmek.linkage.quality import input_range
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.units import deg

TURN = 2 * math.pi


def class_three():
    """A plate on three links, one on a crank that swings between dead centres; drawn in place at 0 degrees."""
    return mechanisms.triad(crank_pin=2.2 - 2.4j)


@pytest.fixture(scope="module")
def file():
    return parse_mechanism(mechanism_toml(OwnMachine(class_three())))


def ends(file):
    branch = pose_branch(file.plan(), "crank", {})
    return branch.start, branch.stop


def test_the_ranges_are_the_same_at_any_number_of_steps(file):
    low, high = ends(file)
    assert -math.pi < low < -0.1 < 0.1 < high < math.pi
    expected = ((0.0, high), (TURN + low, TURN))
    for steps in (7, 72, 361):
        np.testing.assert_allclose(run(file, MotionRequest({}, steps=steps)).closing, expected, atol=1e-14)
    both = run(file, MotionRequest({}, over="-180deg..180deg", steps=7)).closing
    np.testing.assert_allclose(both, [(low, high)], atol=1e-14)
    back = run(file, MotionRequest({}, over="180deg..-180deg", steps=7)).closing
    np.testing.assert_allclose(back, [(high, low)], atol=1e-14)


def test_an_angle_beyond_the_branch_is_reduced_by_whole_turns(file):
    low, _ = ends(file)
    near = low + 0.01
    found, again = (run(file, MotionRequest({"": f"{value!r}rad"})).motion.pose() for value in (near, near + TURN))
    for body, (origin, angle) in found.items():
        np.testing.assert_allclose(again[body], (origin, angle), atol=1e-12)


def test_where_it_does_not_close_the_message_names_the_range_in_which_it_does(file):
    low, high = (f"{end / deg:.3f}°" for end in ends(file))
    with pytest.raises(MechanismError, match=f"branch of the mechanism's pose goes from {low} to {high}"):
        run(file, MotionRequest({"": "180deg"}))
    with pytest.raises(MechanismError, match=f"branch of the mechanism's pose goes from {low} to {high}"):
        solve(file.plan(), np.linspace(0, math.pi, 9)).require()
    triple_rocker = parse_mechanism(mechanism_toml(OwnMachine(four_bar(0.300, 0.200, 0.200, 0.230, branch=1))))
    with pytest.raises(MechanismError, match=r"it closes for crank -117\.226°\.\.117\.226°"):
        run(triple_rocker, MotionRequest({"": "180deg"}))


@pytest.mark.parametrize("sizes", [(10.0, 1.0, 4.5, 4.5 + 1e-7), (3.0, 1.0, 2.0, 2.0 - 1e-7)])
def test_ranges_and_gaps_far_shorter_than_a_step_are_found(sizes):
    """Links that barely reach at 0 degrees (closed over 0.05 degrees), or barely fail at 180 degrees."""
    found = closing(one_input(plan(four_bar(*sizes, branch=1))), -1.0, TURN - 1.0)
    ((low, high),) = input_range(*sizes)
    expected = [(low, high)] if high < 1 else [(-1.0, high), (TURN + low, TURN - 1.0)]
    np.testing.assert_allclose(found.ranges, expected, atol=1e-8)


def test_change_points_are_reported_and_do_not_end_a_range():
    found = closing(one_input(plan(four_bar(3.0, 1.0, 3.0, 1.0, branch=1))), -1.0, 5.0)
    assert found.ranges == ((-1.0, 5.0),)
    assert found.dead_centres == ()
    np.testing.assert_allclose(found.change_points, [0, math.pi], atol=1e-7)


def test_one_of_two_inputs_held():
    motors = mechanisms.two_motors(left=0.9)
    moved = one_input(plan(motors), "left", {"right": 2.0})
    pin = 1.0 + 0.3 * np.exp(2.0j)
    found = closing(moved, -math.pi, math.pi)
    turned = input_range(abs(pin), 0.9, 0.9, 0.8)
    np.testing.assert_allclose(found.ranges, np.array(turned) + np.angle(pin), atol=1e-12)


def test_a_mechanism_without_a_branch_closes_nowhere():
    assert closing(one_input(plan(four_bar(10.0, 1.0, 2.0, 3.0, branch=1))), 0.0, 1.0).ranges == ()
