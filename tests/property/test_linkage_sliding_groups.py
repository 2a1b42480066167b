"""RPR, PRP and RPP dyads on moving bodies, offset and turned: loops close, rates are derivatives, Newton agrees."""

import dataclasses

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from mechanisms import check_newton
from periodic_samples import periodic_derivative

from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

TURN = np.arange(512) * (2 * np.pi / 512)
SIGN = st.sampled_from([+1, -1])
ANGLE = st.floats(-3.0, 3.0)
PLACE = st.builds(complex, st.floats(-0.5, 0.5), st.floats(-0.5, 0.5))
FEW = settings(max_examples=8)


def crank_and(ground, crank, bodies, joints, branches=None) -> Mechanism:
    """A unit crank about the origin, with the points given, drives the group."""
    return Mechanism(
        bodies=(Body(GROUND, {"A0": 0, **ground}), Body("crank", {"A0": 0, **crank}), *bodies),
        joints=(Pin("A0", GROUND, "crank"), *joints),
        inputs=(Rotation("crank", "A0"),),
        branches=branches or {},
    )


RPR = st.tuples(ANGLE, ANGLE, PLACE, PLACE, PLACE, PLACE, st.floats(4.5, 8.0), ANGLE, st.booleans(), SIGN)
PRP = st.tuples(st.floats(0.9, np.pi - 0.9), PLACE, PLACE, PLACE, PLACE, PLACE, PLACE, ANGLE, ANGLE, st.booleans())
RPP = st.tuples(ANGLE, ANGLE, ANGLE, ANGLE, PLACE, PLACE, PLACE, PLACE, PLACE, PLACE, st.booleans())


def rpr(numbers) -> Mechanism:
    """A slide between a body on the crank's pin and one on a ground pin farther away than crank and offset."""
    along, turned, first, second, at_a, at_b, far, bearing, guide_first, branch = numbers
    bodies = (Body("one", {"A": at_a, "s": first}), Body("two", {"B": at_b, "s": second}))
    slide = Slide("s", "two", "one", along, turned) if guide_first else Slide("s", "one", "two", along, turned)
    joints = (Pin("A", "crank", "one"), Pin("B", GROUND, "two"), slide)
    return crank_and({"B": far * np.exp(1j * bearing)}, {"A": 1}, bodies, joints, {"s": branch})


def prp(numbers) -> Mechanism:
    """A slider on a rocking lever (an RPR dyad on the crank) pinned to one on a line of the ground.

    The lever rocks by asin(1/3) about x, so that the two lines never are parallel.
    """
    tilt, first, second, reach, other, root, zero, turned, also, lever_guides = numbers
    bodies = (
        Body("block", {"A": 0, "slot": 0}),
        Body("lever", {"B": 0, "slot": 0, "t": first}),
        Body("on_lever", {"t": second, "C": reach}),
        Body("on_ground", {"u": other, "C": root}),
    )
    if lever_guides:
        on_lever = Slide("t", "on_lever", "lever", 0.0, turned)
    else:  # the line of the slider that is along the lever's x
        on_lever = Slide("t", "lever", "on_lever", -turned, -turned)
    joints = (
        Pin("A", "crank", "block"),
        Slide("slot", "block", "lever"),
        Pin("B", GROUND, "lever"),
        on_lever,
        Pin("C", "on_lever", "on_ground"),
        Slide("u", "on_ground", GROUND, tilt, also),
    )
    return crank_and({"B": -3, "u": zero}, {"A": 1}, bodies, joints, {"slot": +1})


def rpp(numbers) -> Mechanism:
    """An Oldham coupling whose middle slides on the crank in any direction and is attached to the ground anywhere."""
    along, between, turned, twist, on_crank, at, first, second, hinge, ground, middle_guides = numbers
    lead = between if middle_guides else between - twist  # of the line between the two, in the middle's frame
    assume(abs(np.sin(turned + lead)) > 0.2)
    inner = (
        Slide("v", "out", "middle", between, twist) if middle_guides else Slide("v", "middle", "out", between, twist)
    )
    bodies = (Body("middle", {"u": at, "v": first}), Body("out", {"v": second, "B": hinge}))
    joints = (Slide("u", "middle", "crank", along, turned + along), inner, Pin("B", "out", GROUND))
    return crank_and({"B": ground}, {"u": on_crank}, bodies, joints)


def worst_gap(motion: Motion) -> float:
    """The worst miss of any joint in position, velocity and acceleration, of the size of the motion."""
    worst = 0.0
    for joint in motion.plan.mechanism.joints:
        one, other = (motion.point(body, joint.name) for body in joint.bodies)
        if isinstance(joint, Slide):
            e = motion.direction(joint.guide) * np.exp(1j * joint.along)
            turned = motion.direction(joint.body) * np.conj(motion.direction(joint.guide))
            gaps = [((one.position - other.position) * np.conj(e)).imag, turned - np.exp(1j * joint.turned)]
        else:
            gaps = [one.position - other.position, one.velocity - other.velocity, one.acceleration - other.acceleration]
        size = max(1.0, *(np.abs(field).max() for field in (one.position, one.velocity, one.acceleration)))
        worst = max(worst, *(float(np.abs(gap).max()) / size for gap in gaps))
    return worst


def check(mechanism: Mechanism, kind: str) -> None:
    """All the laws at once for a mechanism whose last group is of that kind."""
    solving = plan(mechanism)
    assert solving.steps[-1].description.endswith(f": {kind}")
    motion = solve(solving, TURN, 1.0).require()
    assert worst_gap(motion) <= 1e-12
    for body in mechanism.moving:
        for point in mechanism.body(body).points:
            moved = motion.point(body, point)
            for order, rate in ((1, moved.velocity), (2, moved.acceleration)):
                expected = periodic_derivative(moved.position, order=order)
                assert np.abs(expected - rate).max() <= 1e-9 * max(1.0, np.abs(rate).max())
        assert np.abs(periodic_derivative(motion.omega(body)) - motion.alpha(body)).max() <= 1e-9 * max(
            1.0, np.abs(motion.alpha(body)).max()
        )
    check_newton(mechanism, np.linspace(0.0, 0.6, 9))


@FEW
@given(RPR)
def test_rpr(numbers):
    check(rpr(numbers), "RPR")


@FEW
@given(PRP)
def test_prp(numbers):
    check(prp(numbers), "PRP")


@FEW
@given(RPP)
def test_rpp(numbers):
    check(rpp(numbers), "RPP")


@FEW
@given(RPR)
def test_the_branches_of_an_rpr_are_either_side_of_the_guides_pin(numbers):
    mechanism = rpr(numbers)
    (slide,) = (joint for joint in mechanism.joints if isinstance(joint, Slide))
    for branch in (+1, -1):
        motion = solve(plan(dataclasses.replace(mechanism, branches={"s": branch})), TURN).require()
        pins = {"one": motion.point("one", "A").position, "two": motion.point("two", "B").position}
        line = motion.direction(slide.guide) * np.exp(1j * slide.along)
        ahead = ((pins[slide.body] - pins[slide.guide]) * np.conj(line)).real
        assert (np.sign(ahead) == branch).all()
