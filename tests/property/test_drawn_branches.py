"""The branch of a group is the one that its drawing shows: random drawings, the sign by its definition."""

import cmath
from dataclasses import replace

import numpy as np
import pytest
from benchmarks.random_mechanisms import random_mechanism
from hypothesis import given
from hypothesis import strategies as st
from mechanisms import triad

from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import mechanism_toml, parse_mechanism
from ilmek.linkage.drawing import as_drawn, branches_as_drawn
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.initial_pose import inputs_in_pose
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

seeds = st.integers(0, 2**32)


def in_one_frame(mechanism: Mechanism) -> Mechanism:
    """The same drawing with every body's frame in the world's place, and no pose."""
    poses = {GROUND: (0j, 0.0), **mechanism.pose}

    def world(body: str, point: complex) -> complex:
        origin, angle = poses[body]
        return origin + point * cmath.rect(1, angle)

    bodies = tuple(Body(b.name, {n: world(b.name, p) for n, p in b.points.items()}) for b in mechanism.bodies)
    joints = tuple(
        replace(joint, along=joint.along + poses[joint.guide][1], turned=0.0) if isinstance(joint, Slide) else joint
        for joint in mechanism.joints
    )
    return replace(mechanism, bodies=bodies, joints=joints, pose={}, branches={})


def sign_by_definition(mechanism: Mechanism, free: str, bodies: tuple[str, ...]) -> int:
    """The sign of a group in a drawing of one frame, from the words of the reference."""
    joint = mechanism.joint(free)

    def outer(body: str) -> Pin | Slide:
        others = [one for one in mechanism.joints if body in one.bodies and not set(one.bodies) <= set(bodies)]
        return min(others, key=lambda one: order[next(b for b in one.bodies if b != body)])

    order = {body.name: k for k, body in enumerate(mechanism.bodies)}
    ends = {body: outer(body) for body in joint.bodies}
    at = mechanism.point(joint.bodies[0], free)
    if isinstance(joint, Slide):  # the sliding body's pin ahead of the guide's, along the slide
        body, guide = (mechanism.point(one, ends[one].name) for one in joint.bodies)
        return int(np.sign(((body - guide) * cmath.rect(1, -joint.along)).real))
    if all(isinstance(one, Pin) for one in ends.values()):  # on the left of the line from first to second
        first, second = (mechanism.point(one, ends[one].name) for one in joint.bodies)
        return int(np.sign(((second - first).conjugate() * (at - first)).imag))
    slide = next(one for one in ends.values() if isinstance(one, Slide))
    pin = next(one for one in ends.values() if isinstance(one, Pin))
    link = next(one for one in joint.bodies if ends[one] is pin)
    # further along the line, of the body that is not known, than the foot of the known pin
    ahead = cmath.rect(1, slide.along) * (1 if slide.body in bodies else -1)
    return int(np.sign(((at - mechanism.point(link, pin.name)) * ahead.conjugate()).real))


@given(seeds)
def test_the_signs_of_a_random_drawing_are_those_of_the_reference_and_assemble_it(seed: int) -> None:
    drawing = in_one_frame(random_mechanism(np.random.default_rng(seed))[0])
    signs = branches_as_drawn(drawing)
    whole = as_drawn(drawing)
    steps = plan(whole).steps
    assert {step.free for step in steps} - {""} == set(signs)
    for step in steps:
        if step.free:
            assert signs[step.free] == sign_by_definition(drawing, step.free, step.bodies)
    motion = solve(plan(whole), inputs_in_pose(whole))
    if motion.ok:
        for body in whole.moving:
            assert motion.direction(body)[0] == pytest.approx(1.0, abs=1e-6)
            assert motion.origin(body)[0] == pytest.approx(0.0, abs=1e-6)


@given(seeds)
def test_a_file_needs_no_branch_that_its_drawing_shows_and_refuses_the_other(seed: int) -> None:
    drawing = in_one_frame(random_mechanism(np.random.default_rng(seed))[0])
    read = parse_mechanism(
        'confirm = ["lengths"]\n' + mechanism_toml(OwnMachine(drawing)).replace('confirm = ["lengths"]\n', "")
    )
    signs = branches_as_drawn(drawing)
    assert read.mechanism.branches == signs
    for joint, sign in signs.items():
        contrary = replace(drawing, branches={joint: -sign})
        text = mechanism_toml(OwnMachine(contrary))
        with pytest.raises(MechanismError, match=f"the drawing has {joint} = ") as refusal:
            parse_mechanism(text)
        assert f"{sign:+d}" in refusal.value.allowed
        assert "line" in refusal.value.given


@given(seeds)
def test_poses_and_rounded_coordinates_show_the_same_signs(seed: int) -> None:
    posed = random_mechanism(np.random.default_rng(seed))[0]
    drawing = in_one_frame(posed)
    expected = branches_as_drawn(drawing)
    assert branches_as_drawn(replace(posed, branches={})) == expected
    draw = np.random.default_rng(seed)
    rounded = tuple(
        Body(b.name, {n: p + 1e-5 * complex(*draw.uniform(-1, 1, 2)) for n, p in b.points.items()})
        for b in drawing.bodies
    )
    found = branches_as_drawn(replace(drawing, bodies=rounded))
    assert found.items() <= expected.items()
    assert len(found) >= len(expected) - 1  # one near its dead centre may not be shown any more


@given(st.floats(0.1, 1.0), st.sampled_from((-1, 1)))
def test_links_given_by_their_lengths_show_no_branch(part: float, branch: int) -> None:
    for mechanism in (four_bar(1.0, 0.3 * part, 0.9, 0.8, branch=branch), slider_crank(0.3 * part, 0.5, branch=branch)):
        assert branches_as_drawn(mechanism) == {}
        assert as_drawn(mechanism) is mechanism


def test_a_drawing_at_a_dead_centre_shows_no_branch() -> None:
    points = {"A": 0j, "B": 1 + 0j, "C": 3 + 0j, "D": 4 + 0j}
    links = {GROUND: "AD", "crank": "AB", "rod": "BC", "rocker": "CD"}
    bodies = tuple(Body(name, {point: points[point] for point in ends}) for name, ends in links.items())
    joints = (
        Pin("A", GROUND, "crank"),
        Pin("B", "crank", "rod"),
        Pin("C", "rod", "rocker"),
        Pin("D", "rocker", GROUND),
    )
    flat = Mechanism(bodies, joints, (Rotation("crank", "A"),))
    assert branches_as_drawn(flat) == {}
    with pytest.raises(MechanismError, match="no branch for the free pin 'C'"):
        plan(as_drawn(flat))
    assert as_drawn(replace(flat, branches={"C": -1})).branches == {"C": -1}


def other_assembly(drawn: Mechanism) -> dict[str, tuple[complex, float]]:
    """The poses of a triad's bodies in another assembly at the same crank angle, searched from random starts."""
    for seed in range(200):
        draw = np.random.default_rng(seed)
        rough = {
            body: (complex(*draw.uniform(-2, 2, 2)), float(draw.uniform(-3, 3)))
            for body in drawn.moving
            if body != "crank"
        }
        motion = solve(plan(replace(drawn, pose=rough)), 0.0)
        if motion.ok and abs(motion.direction("plate")[0] - 1) > 0.2:
            return {body: pose for body, pose in motion.pose().items() if body != "crank"}
    raise AssertionError("the triad has one assembly")


def test_a_pose_of_another_assembly_than_the_drawn_one_is_refused() -> None:
    drawn = triad()
    assert as_drawn(drawn) is drawn
    small = {body: (0.01 - 0.02j, 0.05) for body in drawn.moving if body != "crank"}
    assert as_drawn(replace(drawn, pose=small)).pose == small  # rough, and of the drawn assembly
    text = mechanism_toml(OwnMachine(replace(drawn, pose=other_assembly(drawn))))
    with pytest.raises(MechanismError, match="line .*pose.* contradicts the coordinates as drawn"):
        parse_mechanism(text)
