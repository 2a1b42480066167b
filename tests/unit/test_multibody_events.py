"""Events of general systems, their energy, and reactions that nothing determines."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.special import ellipk

from ilmek.dynamics.clearance import ClearancePin
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.multibody.system import BodyState, MultibodyHistory, System, SystemEvent, simulate
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND, Body, Pin, Slide

QUARTER = float(ellipk(0.5)) / math.sqrt(9.81)
"""Time from level to the lowest place of a pendulum of 1 m let go at rest."""


def pendulum() -> System:
    bodies = (Body(GROUND, {"O": 0}), Body("bob", {"O": -1, "tip": 0}))
    bob = Inertia(1.0, 0j, 1e-13)
    return System(bodies, (Pin("O", GROUND, "bob"),), {"bob": bob}, {"bob": BodyState(1 + 0j)}, gravity=-9.81j)


def across(course: MultibodyHistory) -> float:
    return float(np.real(course.position("bob", "tip")))


def test_passing_the_lowest_place_is_found_to_the_error_of_the_run() -> None:
    lowest = SystemEvent("lowest", across)
    run = simulate(pendulum(), np.array([0.0, 4.0]), events=(lowest,), rtol=1e-12)
    assert run.end is not None
    assert run.end.name == "lowest"
    assert run.time[-1] == run.end.time == pytest.approx(QUARTER, abs=1e-11)
    assert abs(across(run.end.state)) < 1e-14
    assert run.omega("bob")[-1] == pytest.approx(-math.sqrt(2 * 9.81), rel=1e-10)
    assert run.pin("O")[-1] == pytest.approx(3j * 9.81, rel=1e-9)


def test_events_that_do_not_end_the_run_are_told_with_their_times_and_directions() -> None:
    either = SystemEvent("lowest", across, terminal=False)
    rightward = SystemEvent("to the right", across, direction=+1, terminal=False)
    late = SystemEvent("clock", lambda course: float(course.time) - 7.2 * QUARTER)
    run = simulate(pendulum(), np.linspace(0.0, 9.0, 10), events=(either, rightward, late), rtol=1e-12)
    times = [one.time / QUARTER for one in run.events if one.name == "lowest"]
    assert np.allclose(times, [1, 3, 5, 7], rtol=0, atol=1e-9)
    assert [round(one.time / QUARTER) for one in run.events if one.name == "to the right"] == [3, 7]
    assert run.time[-1] == pytest.approx(7.2 * QUARTER, rel=1e-12)
    assert np.all(np.diff(run.time) > 0)


def test_an_event_at_the_start_is_not_met_there() -> None:
    rest = SystemEvent("at rest", lambda course: float(course.omega("bob")))
    run = simulate(pendulum(), np.array([0.0, 5.0]), events=(rest,), rtol=1e-12)
    assert run.time[-1] == pytest.approx(2 * QUARTER, abs=1e-9)


def test_the_end_of_travel_of_a_slide_ends_the_run() -> None:
    bodies = (Body(GROUND, {"S": 0}), Body("block", {"S": 0}))
    slope = Slide("S", "block", GROUND, along=-math.pi / 2, turned=0.0)
    system = System(bodies, (slope,), {"block": Inertia(1.0, 0j, 0.1)}, {"block": BodyState(0j)}, gravity=-9.81j)
    stop = SystemEvent("end of travel", lambda course: float(course.travel("S")) - 0.5, direction=+1)
    run = simulate(system, np.array([0.0, 1.0]), events=(stop,))
    assert run.time[-1] == pytest.approx(math.sqrt(2 * 0.5 / 9.81), rel=1e-12)
    with pytest.raises(MechanismError, match="no slide 'T'"):
        run.travel("T")


def test_touching_a_bearing_is_an_event() -> None:
    pin = ClearancePin("P", GROUND, "disc", 1e-4, 9e-3, 1e10)
    bodies = (Body(GROUND, {"P": 0}), Body("disc", {"P": 0}))
    system = System(bodies, (pin,), {"disc": Inertia(0.2, 0j, 1e-5)}, {"disc": BodyState(0j)}, gravity=-9.81j)
    touch = SystemEvent("touch", lambda course: float(np.abs(course.eccentricity("P"))) - 1e-4, +1, terminal=False)
    run = simulate(system, np.array([0.0, 0.02]), events=(touch,))
    assert run.events[0].time == pytest.approx(math.sqrt(2e-4 / 9.81), rel=1e-6)
    assert len(run.events) > 1


def parallelogram(angle: float) -> System:
    """Two equal cranks and a coupler of the ground's length; in line at angle 0."""
    turned = np.exp(1j * angle)
    bodies = (Body(GROUND, {"A": 0, "D": 1}), Body("one", {"A": 0, "B": 0.5}), Body("two", {"D": 0, "C": 0.5}),
              Body("coupler", {"B": 0, "C": 1}))  # fmt: skip
    joints = (Pin("A", GROUND, "one"), Pin("D", GROUND, "two"), Pin("B", "one", "coupler"), Pin("C", "coupler", "two"))
    poses = {
        "one": BodyState(0j, angle),
        "two": BodyState(1 + 0j, angle),
        "coupler": BodyState(complex(0.5 * turned), 0.0),
    }
    return System(bodies, joints, dict.fromkeys(poses, Inertia(1.0, 0.25 + 0j, 0.1)), poses, gravity=-9.81j)


def test_reactions_are_indeterminate_where_links_stand_in_one_line_and_where_joints_are_redundant() -> None:
    at_once = np.array([0.0, 1e-9])
    assert simulate(parallelogram(0.7), at_once).indeterminate() == ()
    in_line = simulate(parallelogram(0.0), at_once)
    assert in_line.indeterminate() == ("A", "D", "B", "C")
    assert np.all(np.isfinite(in_line.reactions))
    plain = parallelogram(0.7)
    second = {GROUND: {"A2": 0j}, "one": {"A2": 0j}}
    doubled = [Body(one.name, {**one.points, **second.get(one.name, {})}) for one in plain.bodies]
    twice = replace(plain, bodies=tuple(doubled), joints=(*plain.joints, Pin("A2", GROUND, "one")))
    run = simulate(twice, at_once)
    assert run.indeterminate() == ("A", "A2")
    assert run.pin("A")[0] == pytest.approx(run.pin("A2")[0])
    assert run.pin("A")[0] * 2 == pytest.approx(simulate(plain, at_once).pin("A")[0])
