"""Gears, belts and racks: what is driven through them, how they are refused, and Newton's method on the same."""

import dataclasses

import numpy as np
import pytest
from mechanisms import two_motors
from periodic_samples import periodic_derivative

from ilmek.errors import MechanismError
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import (
    GROUND,
    Body,
    Coupling,
    Displacement,
    Mechanism,
    Pin,
    Rotation,
    Slide,
    degrees_of_freedom,
)
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

TURN = np.arange(128) * (2 * np.pi / 128)


def geared_five_bar(ratio=-1.0, first_at=0.0, second_at=np.pi, kind="gears") -> Mechanism:
    """Two cranks geared to one another drive a dyad."""
    return dataclasses.replace(
        two_motors(0.3, 0.3, 0.9, 0.9),
        inputs=(Rotation("left", "A0"),),
        couplings=(Coupling("mesh", kind, ("left", "A0"), ("right", "B0"), ratio, first_at, second_at),),
        name="geared five-bar",
    )


def wheel_on(mechanism: Mechanism, body: str, ratio: float, at: float) -> Mechanism:
    """A wheel on the ground, coupled with a body that turns about B0 of a four-bar."""
    bodies = [dataclasses.replace(b, points={**b.points, "W": 1j}) if b.name == GROUND else b for b in mechanism.bodies]
    return dataclasses.replace(
        mechanism,
        bodies=(*bodies, Body("wheel", {"W": 0, "rim": 0.05})),
        joints=(*mechanism.joints, Pin("W", GROUND, "wheel")),
        couplings=(Coupling("teeth", "gears", (body, "B0"), ("wheel", "W"), ratio, at, 0.0),),
    )


def rack_and_pinion(driven: str) -> Mechanism:
    """A pinion on the ground and a rack on a line at 30 degrees: 20 mm a radian; either drives."""
    return Mechanism(
        bodies=(
            Body(GROUND, {"O": 0, "way": -0.02j}),
            Body("pinion", {"O": 0, "rim": 0.02}),
            Body("rack", {"way": 0, "end": 0.3}),
        ),
        joints=(Pin("O", GROUND, "pinion"), Slide("way", "rack", GROUND, along=np.pi / 6)),
        inputs=(Rotation("pinion", "O"),) if driven == "pinion" else (Displacement("way"),),
        couplings=(Coupling("mesh", "rack", ("pinion", "O"), ("rack", "way"), 0.02, 0.5, 0.1),),
    )


def by_newton(mechanism: Mechanism, *, at: float = 0.0) -> Mechanism:
    """The same with the pose of the closed form at an input value, for Newton's method to follow."""
    motion = solve(plan(mechanism), at).require()
    pose = {body: (complex(motion.origin(body)[0]), float(motion.angle(body)[0])) for body in mechanism.moving}
    return dataclasses.replace(mechanism, pose=pose)


def test_two_sided_mechanism_is_one_model_with_one_input():
    mechanism = geared_five_bar()
    assert degrees_of_freedom(mechanism) == 1
    planned = plan(mechanism)
    assert [step.description for step in planned.steps] == [
        "left turned by the input on ground",
        "right driven by left through mesh",
        "one and two joined at C (branch +1), attached to left and right: RRR",
    ]
    motion = solve(planned, TURN, 2.0, 3.0).require()
    np.testing.assert_allclose(motion.point("two", "C").position.real, 0.5, atol=1e-14)  # the mirror line
    np.testing.assert_allclose(motion.direction("right"), np.exp(1j * (np.pi - TURN)), atol=1e-14)
    assert set(motion.omega("right")) == {-2.0}
    assert set(motion.alpha("right")) == {-3.0}


@pytest.mark.parametrize(("ratio", "turns"), [(-1.0, 1), (0.5, 2), (-1.5, 2), (2 / 3, 3)])
def test_full_turns_are_counted_and_closed_form_is_newton(ratio, turns):
    """A wheel at half speed is elsewhere after one turn and back after two; nothing depends on the sample before."""
    mechanism = geared_five_bar(ratio, 0.2, 1.1)
    angle = np.linspace(0, 2 * np.pi * turns, 97)
    motion = solve(plan(mechanism), angle, 1.5, 0.5).require()
    np.testing.assert_allclose(motion.direction("right"), np.exp(1j * (1.1 + ratio * (angle - 0.2))), atol=1e-13)
    np.testing.assert_allclose(motion.point("one", "C").position[0], motion.point("one", "C").position[-1], atol=1e-12)
    found = solve(plan(by_newton(mechanism), closed_forms=False), angle[:50:7], 1.5, 0.5).require()
    for field in ("position", "velocity", "acceleration"):
        ours, theirs = (getattr(one.point("two", "C"), field) for one in (motion, found))
        ours = ours[:50:7]
        np.testing.assert_allclose(ours, theirs, atol=1e-10 * max(1.0, np.abs(ours).max()))


@pytest.mark.parametrize("driven", ["pinion", "rack"])
def test_rack_and_pinion_drive_one_another(driven):
    mechanism = rack_and_pinion(driven)
    value = np.linspace(-3, 4, 9) if driven == "pinion" else np.linspace(0.05, 0.12, 9)
    motion = solve(plan(mechanism), value, 3.0, -2.0).require()
    angle, way = (value, 0.1 + 0.02 * (value - 0.5)) if driven == "pinion" else (0.5 + (value - 0.1) / 0.02, value)
    np.testing.assert_allclose(motion.direction("pinion"), np.exp(1j * angle), atol=1e-13)
    line = np.exp(1j * np.pi / 6)
    np.testing.assert_allclose(motion.origin("rack"), -0.02j + way * line, atol=1e-15)
    np.testing.assert_allclose(motion["rack"].velocity, motion.omega("pinion") * 0.02 * line, atol=1e-14)
    np.testing.assert_allclose(motion["rack"].acceleration, motion.alpha("pinion") * 0.02 * line, atol=1e-14)
    found = solve(plan(by_newton(mechanism), closed_forms=False), value, 3.0, -2.0).require()
    np.testing.assert_allclose(found.origin("rack"), motion.origin("rack"), atol=1e-13)
    np.testing.assert_allclose(found.alpha("pinion"), motion.alpha("pinion"), rtol=1e-12)


@pytest.mark.parametrize("ratio", [-2.5, 3.0])
def test_a_wheel_follows_a_rocker(ratio):
    mechanism = wheel_on(four_bar(0.3, 0.06, 0.2, 0.23, branch=1), "rocker", ratio, 1.6)
    planned = plan(mechanism)
    assert planned.steps[-1].description == "wheel driven by rocker through teeth"
    motion = solve(planned, TURN, 1.0).require()
    np.testing.assert_allclose(
        motion.direction("wheel"), np.exp(1j * ratio * (motion.angle("rocker") - 1.6)), atol=1e-13
    )
    np.testing.assert_allclose(motion.omega("wheel"), ratio * motion.omega("rocker"), atol=1e-14)
    found = solve(plan(by_newton(mechanism), closed_forms=False), TURN[:64:8], 1.0).require()
    np.testing.assert_allclose(found.direction("wheel"), motion.direction("wheel")[:64:8], atol=1e-12)
    np.testing.assert_allclose(found.alpha("wheel"), motion.alpha("wheel")[:64:8], atol=1e-10)


def rack_on_slider() -> Mechanism:
    """A slider-crank whose slider is a rack; its pinion turns on the ground."""
    base = slider_crank(0.05, 0.2, offset=0.01, branch=1)
    bodies = [dataclasses.replace(b, points={**b.points, "W": 0.1j}) if b.name == GROUND else b for b in base.bodies]
    return dataclasses.replace(
        base,
        bodies=(*bodies, Body("pinion", {"W": 0})),
        joints=(*base.joints, Pin("W", GROUND, "pinion")),
        couplings=(Coupling("teeth", "rack", ("pinion", "W"), ("slider", "line"), -0.015, 0.3, 0.2),),
    )


def test_a_pinion_follows_the_slider_of_a_crank():
    motion = solve(plan(rack_on_slider()), TURN, 1.0).require()
    way = motion.point("slider", "B").position.real
    np.testing.assert_allclose(motion.direction("pinion"), np.exp(1j * (0.3 - (way - 0.2) / 0.015)), atol=1e-12)
    np.testing.assert_allclose(motion.omega("pinion"), periodic_derivative(-way / 0.015), atol=1e-10)
    np.testing.assert_allclose(motion.alpha("pinion"), periodic_derivative(-way / 0.015, order=2), atol=1e-8)


def pinion_on_swinging_guide() -> Mechanism:
    """A crank's block slides on a lever that rocks; the block is a rack whose pinion turns on the lever."""
    return Mechanism(
        bodies=(
            Body(GROUND, {"A0": 0, "B": -3}),
            Body("crank", {"A0": 0, "A": 1}),
            Body("block", {"A": 0, "slot": 0.1}),
            Body("lever", {"B": 0, "slot": 0.2j, "W": 2.0 + 0.7j}),
            Body("pinion", {"W": 0, "rim": 0.5}),
        ),
        joints=(
            Pin("A0", GROUND, "crank"),
            Pin("A", "crank", "block"),
            Slide("slot", "block", "lever", along=0.1, turned=0.2),
            Pin("B", GROUND, "lever"),
            Pin("W", "lever", "pinion"),
        ),
        inputs=(Rotation("crank", "A0"),),
        branches={"slot": +1},
        couplings=(Coupling("teeth", "rack", ("pinion", "W"), ("block", "slot"), 0.5, 0.0, 3.0, "lever"),),
    )


def test_a_pinion_on_a_moving_guide_has_rates_that_are_derivatives():
    angle = np.arange(512) * (2 * np.pi / 512)
    motion = solve(plan(pinion_on_swinging_guide()), angle, 1.0).require()
    turned = motion.angle("pinion")
    np.testing.assert_allclose(motion.omega("pinion"), periodic_derivative(turned), atol=1e-10)
    np.testing.assert_allclose(motion.alpha("pinion"), periodic_derivative(turned, order=2), atol=1e-8)
    rim = motion.point("pinion", "rim")
    np.testing.assert_allclose(rim.acceleration, periodic_derivative(rim.velocity), atol=1e-9)
    found = solve(plan(by_newton(pinion_on_swinging_guide()), closed_forms=False), angle[:256:32], 1.0).require()
    np.testing.assert_allclose(found.alpha("pinion"), motion.alpha("pinion")[:256:32], atol=1e-9)


def mesh(**changes) -> Coupling:
    good = dict(first=("left", "A0"), second=("right", "B0"), ratio=-1.0, first_at=0.0, second_at=0.0, kind="gears")
    return Coupling("mesh", **{**good, **changes})


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (dict(ratio=0.0), "coupling 'mesh' of geared five-bar has ratio 0"),
        (dict(ratio=float("nan")), "ratio of coupling 'mesh' is nan; a finite number"),
        (dict(second_at=float("inf")), "second_at of coupling 'mesh' is inf; a finite number"),
        (dict(kind="worm"), "is of kind 'worm'; gears, belt, rack"),
        (dict(first=("lft", "A0")), "has no body 'lft'"),
        (dict(first=("left", "Q")), "body 'left' of geared five-bar has no point 'Q'"),
        (dict(second=("left", "A0")), "joins left, left, ground; three different bodies"),
        (dict(carrier="arm"), "has no body 'arm'"),
        (dict(kind="rack"), "requires a slide 'B0' of 'right' on 'ground'; it is a pin of ground, right"),
    ],
)
def test_bad_couplings_are_refused_in_words(changes, said):
    with pytest.raises(MechanismError) as caught:
        dataclasses.replace(geared_five_bar(), couplings=(mesh(**changes),))
    assert said in str(caught.value)
    assert caught.value.about[:1] == ("couplings",)


def test_a_coupling_too_many_is_named():
    """A ring of three gears turns in no direction; a second ratio between two wheels holds them twice."""
    mechanism = geared_five_bar()
    twice = dataclasses.replace(mechanism.couplings[0], name="again", ratio=-2.0)
    with pytest.raises(
        MechanismError, match="over-constrained at right; joints B0 and couplings mesh, again over-constrain it once"
    ):
        plan(dataclasses.replace(mechanism, couplings=(*mechanism.couplings, twice)))
