"""Groups without a closed form: Newton's method against answers known otherwise, and its ways to fail."""

import numpy as np
import pytest
from mechanisms import triad, two_motors

from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND, Body, Displacement, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Status
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

CRANK, APART = 0.1, 0.3
LEVER_POSE = {"lever": (0j, 0.0), "block": (APART + CRANK, 0.0)}


def quick_return(pose=LEVER_POSE) -> Mechanism:
    """A crank at (0.3, 0) whose block slides along a lever that turns about the origin: an RPR group."""
    return Mechanism(
        bodies=(
            Body(GROUND, {"O": 0, "A0": APART}),
            Body("crank", {"A0": 0, "A": CRANK}),
            Body("block", {"A": 0, "slot": 0}),
            Body("lever", {"O": 0, "slot": 0}),
        ),
        joints=(
            Pin("A0", GROUND, "crank"),
            Pin("A", "crank", "block"),
            Slide("slot", "block", "lever"),
            Pin("O", GROUND, "lever"),
        ),
        inputs=(Rotation("crank", "A0"),),
        name="quick return",
        pose={} if pose is None else {"crank": (APART + 0j, 0.0), **pose},
    )


def test_quick_return_lever_points_at_the_crank_pin():
    angle = np.linspace(-9.0, 11.0, 301)
    speed, acceleration = 3 + np.sin(angle), np.cos(angle)
    motion = solve(plan(quick_return()), angle, speed, acceleration).require()
    arm = CRANK * np.exp(1j * angle)
    at, velocity = APART + arm, 1j * speed * arm
    gain = (1j * acceleration - speed**2) * arm
    np.testing.assert_allclose(motion.direction("lever"), at / np.abs(at), atol=1e-13)
    omega = (velocity / at).imag
    np.testing.assert_allclose(motion.omega("lever"), omega, atol=1e-12)
    np.testing.assert_allclose(motion.alpha("lever"), (gain / at - (velocity / at) ** 2).imag, atol=1e-11)
    np.testing.assert_allclose(motion.origin("block"), at, atol=1e-14)


def test_plan_says_in_words_what_is_left_to_newton():
    assert [step.description for step in plan(quick_return()).steps] == [
        "crank turned by the input on ground",
        "block, lever with joints A, slot, O: Newton's method on the loop equations",
    ]


def test_class_three_group_drawn_in_place_closes_all_round():
    angle = np.arange(128) * (2 * np.pi / 128)
    motion = solve(plan(triad()), angle, 1.0).require()
    for joint in triad().joints:
        one, other = (motion.point(body, joint.name) for body in joint.bodies)
        np.testing.assert_allclose(one.position, other.position, atol=1e-13)
        np.testing.assert_allclose(one.velocity, other.velocity, atol=1e-13)
        np.testing.assert_allclose(one.acceleration, other.acceleration, atol=1e-12)


def test_class_three_group_comes_back_to_where_it_was_drawn():
    motion = solve(plan(triad()), np.array([0.0, 2 * np.pi])).require()
    np.testing.assert_allclose(motion.origin("plate"), 0, atol=1e-13)
    np.testing.assert_allclose(motion.direction("plate"), 1, atol=1e-13)


def test_a_sample_does_not_depend_on_its_neighbours():
    angle = np.array([0.3, 5.0, 1.0])
    together = solve(plan(triad()), angle).point("plate", "P").position
    alone = [solve(plan(triad()), one).point("plate", "P").position[0] for one in angle]
    np.testing.assert_allclose(together, alone, atol=1e-13)


def test_out_of_reach_is_not_converged_and_said_so():
    mechanism = quick_return()
    bodies = tuple(
        Body("lever", {"O": 0.35j, "slot": 0}) if body.name == "lever" else body for body in mechanism.bodies
    )  # the slot passes 350 mm from the pivot: the crank pin comes nearer than that
    pose = {"crank": (APART + 0j, 0.0), "lever": (APART, 1.0), "block": (APART + CRANK, 1.0)}
    broken = Mechanism(bodies, mechanism.joints, mechanism.inputs, name="quick return", pose=pose)
    motion = solve(plan(broken), np.linspace(0, 3, 31))
    assert motion.status[0] == Status.OK
    assert motion.status[-1] == Status.NOT_CONVERGED
    assert np.isnan(motion.omega("lever")[-1])
    with pytest.raises(MechanismError, match=r"no position of block and lever found for crank .*\.\.171\.9°"):
        motion.require()


def test_two_inputs_followed_from_the_pose_agree_with_the_dyad():
    time = np.linspace(0, 1, 9)
    values = {"left": 1.2 + time, "right": 1.9 - 0.5 * time**2}
    speeds, accelerations = {"left": 1.0, "right": -time}, {"right": -1.0}
    direct = solve(plan(two_motors()), values, speeds, accelerations).require()
    pose = {body: (complex(direct.origin(body)[0]), float(direct.angle(body)[0])) for body in two_motors().moving}
    posed = Mechanism(two_motors().bodies, two_motors().joints, two_motors().inputs, pose=pose)
    found = solve(plan(posed, closed_forms=False), values, speeds, accelerations).require()
    for field in ("position", "velocity", "acceleration"):
        ours, theirs = (getattr(motion.point("two", "C"), field) for motion in (direct, found))
        np.testing.assert_allclose(ours, theirs, atol=1e-12)


def test_driven_slide_inside_a_group_is_a_telescope():
    """A strut of driven length between a pivot and a door: the cosine rule."""
    mechanism = Mechanism(
        bodies=(
            Body(GROUND, {"O": 0, "H": 1}),
            Body("door", {"H": 1, "D": 1 + 0.6j}),
            Body("tube", {"O": 0, "strut": 0}),
            Body("rod", {"D": 0, "strut": 0}),
        ),
        joints=(
            Pin("H", GROUND, "door"),
            Pin("O", GROUND, "tube"),
            Pin("D", "door", "rod"),
            Slide("strut", "rod", "tube"),
        ),
        inputs=(Displacement("strut"),),
        pose={"tube": (0j, 0.5), "rod": (1 + 0.6j, 0.5)},
    )
    length = np.linspace(0.9, 1.4, 11)
    motion = solve(plan(mechanism), length, 0.2).require()
    place = motion.point("door", "D")
    np.testing.assert_allclose(np.abs(place.position), length, atol=1e-13)
    np.testing.assert_allclose((place.velocity * np.conj(place.position)).real / length, 0.2, atol=1e-13)
    door = np.pi - np.arccos((1 + 0.36 - length**2) / 1.2) - np.pi / 2
    np.testing.assert_allclose(motion.angle("door"), door, atol=1e-12)
