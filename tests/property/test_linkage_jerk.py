"""Jerk of every group, driven bodies, couplings and Newton's method: the acceleration's derivative, one for all."""

import dataclasses

import numpy as np
import pytest
from periodic_samples import periodic_derivative

from ilmek.errors import MechanismError
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import GROUND, Body, Coupling, Displacement, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

TIME = np.arange(256) * (2 * np.pi / 256)


def crank_and(ground, crank, bodies, joints, *more) -> Mechanism:
    """A crank about the origin, with the points given, drives the group; more: branches, couplings."""
    branches, couplings = (*more, (), ())[:2]
    return Mechanism(
        bodies=(Body(GROUND, {"A0": 0, **ground}), Body("crank", {"A0": 0, **crank}), *bodies),
        joints=(Pin("A0", GROUND, "crank"), *joints),
        inputs=(Rotation("crank", "A0"),),
        branches=dict(branches),
        couplings=couplings,
    )


LEVER = (
    (Body("block", {"A": 0.1j, "slot": 0.2}), Body("lever", {"B": 0.1, "slot": 0.3j, "t": 0.5 + 0.2j, "W": 1 + 1j})),
    (Pin("A", "crank", "block"), Slide("slot", "block", "lever", 0.2, 0.5), Pin("B", GROUND, "lever")),
)
"""A block on the crank's pin slides along a lever that rocks: an RPR dyad."""


def six_bar() -> Mechanism:
    """A four-bar whose coupler point drives a link and a block on the moving rocker: RRR and RRP."""
    base = four_bar(1.2, 0.4, 1.0, 0.9, branch=1, points={"coupler": {"C": 0.4 + 0.6j}, "rocker": {"s": 0.3 - 0.2j}})
    bodies = (Body("link", {"C": 0.1j, "D": 5.0}), Body("block", {"D": 0.1 + 0.2j, "s": -0.3j}))
    joints = (Pin("C", "coupler", "link"), Pin("D", "link", "block"), Slide("s", "block", "rocker", 0.7, -0.4))
    return dataclasses.replace(
        base, bodies=base.bodies + bodies, joints=base.joints + joints, branches={"B": 1, "D": -1}
    )


MECHANISMS = {
    "RRR": four_bar(1.2, 0.4, 1.0, 0.9, branch=-1, points={"coupler": {"P": 0.3 + 0.4j}}),
    "RRP": slider_crank(0.4, 1.3, offset=0.2, branch=1),
    "RRP on a moving guide": six_bar(),
    "RPR": crank_and({"B": -3}, {"A": 1}, *LEVER, {"slot": 1}),
    "PRP": crank_and(
        {"B": -3, "u": 0.2},
        {"A": 1},
        (*LEVER[0], Body("one", {"t": 0.1j, "C": 0.2}), Body("two", {"C": 0.3, "u": 0.1 + 0.2j})),
        (*LEVER[1], Slide("t", "one", "lever", 0.1, 0.3), Pin("C", "one", "two"), Slide("u", "two", GROUND, 1.4, 0.6)),
        {"slot": 1},
    ),
    "RPP": crank_and(
        {"B": -3, "E": 0.5 - 1j},
        {"A": 1},
        (*LEVER[0], Body("slider", {"t": 0.1, "v": 0.2j}), Body("arm", {"v": 0.3, "E": 0.4j})),
        (
            *LEVER[1],
            Slide("t", "slider", "lever", 0.1, 0.3),
            Slide("v", "arm", "slider", 1.2, 0.4),
            Pin("E", "arm", GROUND),
        ),
        {"slot": 1},
    ),
    "wheel on a rocking carrier": crank_and(
        {"B": -3},
        {"A": 1},
        (*LEVER[0], Body("wheel", {"W": 0, "rim": 0.4})),
        (*LEVER[1], Pin("W", "lever", "wheel")),
        {"slot": 1},
        (Coupling("mesh", "gears", (GROUND, "B"), ("wheel", "W"), -1.7, 0.1, 0.2, "lever"),),
    ),
    "pinion on a moving rack": crank_and(
        {"B": -3},
        {"A": 1},
        (*LEVER[0], Body("wheel", {"W": 0, "rim": 0.4})),
        (*LEVER[1], Pin("W", "lever", "wheel")),
        {"slot": 1},
        (Coupling("mesh", "rack", ("wheel", "W"), ("block", "slot"), 0.8, 0.0, 3.0, "lever"),),
    ),
    "geared five-bar": crank_and(
        {"B0": 1},
        {"A": 0.3},
        (Body("right", {"B0": 0, "B": 0.25}), Body("one", {"A": 0, "P": 0.9}), Body("two", {"B": 0, "P": 1.1})),
        (Pin("B0", GROUND, "right"), Pin("A", "crank", "one"), Pin("B", "right", "two"), Pin("P", "one", "two")),
        {"P": 1},
        (Coupling("mesh", "gears", ("crank", "A0"), ("right", "B0"), -2.0, 0.3, 2.0),),
    ),
}  # fmt: skip


def moved(planned, course=TIME) -> Motion:
    """The input runs a full turn, unevenly, so that each of its rates counts."""
    value, speed = course + 0.3 * np.sin(course), 1 + 0.3 * np.cos(course)
    return solve(planned, value, speed, -0.3 * np.sin(course), -0.3 * np.cos(course)).require()


def jerks(motion: Motion):
    for body in motion.plan.mechanism.bodies:
        yield body.name, motion.alpha(body.name), motion[body.name].beta
        for point in body.points:
            yield (
                f"{point} of {body.name}",
                motion.point(body.name, point).acceleration,
                motion[body.name, point].jerk,
            )


@pytest.mark.parametrize("mechanism", MECHANISMS.values(), ids=MECHANISMS.keys())
def test_jerk_is_the_derivative_of_the_acceleration(mechanism):
    for name, acceleration, jerk in jerks(moved(plan(mechanism))):
        error = np.abs(periodic_derivative(np.array(acceleration)) - jerk).max()
        assert error <= 1e-8 * max(1.0, np.abs(jerk).max()), name


@pytest.mark.parametrize("mechanism", MECHANISMS.values(), ids=MECHANISMS.keys())
def test_newton_finds_the_same_jerk(mechanism):
    few = TIME[:64:8]
    motion = moved(plan(mechanism), few)
    pose = {body: (complex(motion.origin(body)[0]), float(motion.angle(body)[0])) for body in mechanism.moving}
    found = moved(plan(dataclasses.replace(mechanism, pose=pose), closed_forms=False), few)
    for (name, _, ours), (_, _, theirs) in zip(jerks(motion), jerks(found), strict=True):
        assert np.abs(ours - theirs).max() <= 1e-9 * max(1.0, np.abs(theirs).max()), name


def test_jerk_of_a_driven_slide_on_a_turning_body():
    """A bead along a spoke: p = s(t) e^{i theta(t)} differentiated by hand at one instant."""
    mechanism = Mechanism(
        bodies=(Body(GROUND, {"O": 0}), Body("spoke", {"O": 0, "way": 0}), Body("bead", {"way": 0})),
        joints=(Pin("O", GROUND, "spoke"), Slide("way", "bead", "spoke")),
        inputs=(Rotation("spoke", "O"), Displacement("way")),
    )
    rates = (
        {"spoke": 0.0, "way": 2.0},
        {"spoke": 3.0, "way": 5.0},
        {"spoke": 4.0, "way": 7.0},
        {"spoke": 6.0, "way": 1.0},
    )
    motion = solve(plan(mechanism), *rates)
    expected = 1 - 3 * 9 * 5 - 3 * 3 * 4 * 2 + 1j * (6 * 2 + 3 * 4 * 5 + 3 * 3 * 7 - 27 * 2)
    np.testing.assert_allclose(motion["bead", "way"].jerk, expected, rtol=1e-14)
    np.testing.assert_allclose(motion["bead"].beta, 6.0)


def test_the_ground_has_none_and_strangers_are_refused():
    motion = moved(plan(MECHANISMS["RRR"]))
    assert not motion[GROUND].beta.any()
    with pytest.raises(MechanismError, match="no body 'arm'"):
        _ = motion["arm"].beta
    with pytest.raises(MechanismError, match="the jerk of input 'crank' is not finite"):
        solve(motion.plan, TIME, 1.0, 0.0, np.full(256, np.nan))
