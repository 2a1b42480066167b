"""Laws that every motion obeys: loops close, rates are derivatives, mirror and scale, closed form = Newton."""

import dataclasses

import numpy as np
from effort import examples
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from mechanisms import check_newton
from periodic_samples import periodic_derivative

from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.quality import grashof, input_range
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

TURN = np.arange(512) * (2 * np.pi / 512)
SIGN = st.sampled_from([+1, -1])
LENGTH = st.floats(0.2, 3.0)
FEW = settings(max_examples=40)


@st.composite
def crank_rockers(draw, least_angle=0.35):
    """Ground, crank, coupler, rocker of a crank that turns fully: from the extremes of its transmission angle."""
    coupler, rocker = draw(LENGTH), draw(LENGTH)
    least = draw(st.floats(least_angle, np.pi / 2))
    greatest = draw(st.floats(least + 0.2, np.pi - least_angle))
    near, far = (abs(coupler - rocker * np.exp(1j * angle)) for angle in (least, greatest))
    return (near + far) / 2, (far - near) / 2, coupler, rocker


@st.composite
def slider_cranks(draw):
    """Crank, rod and offset of a crank that turns fully."""
    crank, offset = draw(st.floats(0.1, 1.0)), draw(st.floats(-1.0, 1.0))
    return crank, (crank + abs(offset)) * draw(st.floats(1.2, 3.0)), offset


def six_bar(sizes, branches, slide_on_rocker=False) -> Mechanism:
    """A crank-rocker whose coupler point C drives a second dyad, RRR on the ground or RRP on the moving rocker."""
    ground, crank, coupler, rocker = sizes
    base = four_bar(*sizes, branch=branches[0], points={"coupler": {"C": (0.4 + 0.6j) * coupler}})
    reach = 3 * (ground + crank + coupler + rocker)
    bodies, joints = list(base.bodies), list(base.joints)
    if slide_on_rocker:
        bodies[3] = Body("rocker", {**base.body("rocker").points, "s": (0.3 - 0.2j) * rocker})
        bodies += [Body("link", {"C": 0.1j, "D": reach}), Body("block", {"D": 0.1 + 0.2j, "s": -0.3j})]
        joints += [Slide("s", "block", "rocker", along=0.7, turned=-0.4)]
    else:
        bodies[0] = Body(GROUND, {**base.body(GROUND).points, "E": reach * (0.5 + 0.2j)})
        bodies += [Body("link", {"C": 0.1j, "D": reach}), Body("block", {"D": 0.1 + 0.2j, "E": -reach})]
        joints += [Pin("E", "block", GROUND)]
    joints += [Pin("C", "coupler", "link"), Pin("D", "link", "block")]
    inputs = (Rotation("crank", "A0"),)
    return Mechanism(tuple(bodies), tuple(joints), inputs, {"B": branches[0], "D": branches[1]})


def loop_gap(motion: Motion) -> float:
    """The worst distance between the two sides of any joint, and of their velocities and accelerations."""
    worst = 0.0
    for joint in motion.plan.mechanism.joints:
        one, other = (motion.point(body, joint.name) for body in joint.bodies)
        for field in ("position", "velocity", "acceleration"):
            gap = getattr(one, field) - getattr(other, field)
            if isinstance(joint, Slide):
                line = motion.direction(joint.guide) * np.exp(1j * joint.along)
                gap = (gap * np.conj(line)).imag if field == "position" else 0 * gap.real
            worst = max(worst, float(np.abs(gap).max() / max(1.0, np.abs(getattr(one, field)).max())))
    return worst


def check_derivatives(motion: Motion, points) -> None:
    """Velocity and acceleration are the spectral derivatives of position, at unit input speed."""
    for body, point in points:
        moved = motion.point(body, point)
        for order, rate in ((1, moved.velocity), (2, moved.acceleration)):
            expected = periodic_derivative(moved.position, order=order)
            assert np.abs(expected - rate).max() <= 1e-9 * max(1.0, np.abs(rate).max())
        assert np.abs(periodic_derivative(motion.omega(body)) - motion.alpha(body)).max() <= 1e-9 * max(
            1.0, np.abs(motion.alpha(body)).max()
        )


@FEW
@given(crank_rockers(), SIGN)
def test_four_bar(sizes, branch):
    mechanism = four_bar(*sizes, branch=branch, points={"coupler": {"P": 0.3 + 0.4j}})
    motion = solve(plan(mechanism), TURN, 1.0).require()
    assert loop_gap(motion) <= 1e-12
    check_derivatives(motion, [("coupler", "P"), ("rocker", "B")])


@FEW
@given(slider_cranks(), SIGN)
def test_slider_crank(sizes, branch):
    crank, rod, offset = sizes
    mechanism = slider_crank(crank, rod, offset=offset, branch=branch)
    motion = solve(plan(mechanism), TURN, 1.0).require()
    assert loop_gap(motion) <= 1e-12
    check_derivatives(motion, [("rod", "B"), ("slider", "B")])
    assert (
        np.sign(motion.point("slider", "B").position.real - motion.point("crank", "A").position.real) == branch
    ).all()


@settings(max_examples=20)
@given(crank_rockers(), st.tuples(SIGN, SIGN), st.booleans())
def test_six_bar_with_the_second_dyad_on_moving_bodies(sizes, branches, slide_on_rocker):
    mechanism = six_bar(sizes, branches, slide_on_rocker)
    motion = solve(plan(mechanism), TURN, 1.0).require()
    assert loop_gap(motion) <= 1e-12
    check_derivatives(motion, [("link", "D"), ("block", "D")])


@FEW
@given(crank_rockers(), st.tuples(SIGN, SIGN))
def test_a_slide_is_the_same_seen_from_either_of_its_bodies(sizes, branches):
    mechanism = six_bar(sizes, branches, slide_on_rocker=True)
    turned_round = Slide("s", "rocker", "block", along=0.7 + 0.4 + np.pi, turned=0.4)
    joints = tuple(turned_round if isinstance(joint, Slide) else joint for joint in mechanism.joints)
    one = solve(plan(mechanism), TURN, 1.0).require()
    other = solve(plan(dataclasses.replace(mechanism, joints=joints)), TURN, 1.0).require()
    for field in ("position", "velocity", "acceleration"):
        ours, theirs = (getattr(motion.point("block", "D"), field) for motion in (one, other))
        assert np.abs(ours - theirs).max() <= 1e-11 * max(1.0, np.abs(ours).max())


@FEW
@given(crank_rockers(), SIGN)
def test_mirror_image_turns_the_other_way_on_the_other_branch(sizes, branch):
    one = solve(plan(four_bar(*sizes, branch=branch)), TURN, 1.0).point("rocker", "B")
    other = solve(plan(four_bar(*sizes, branch=-branch)), -TURN, -1.0).point("rocker", "B")
    for field in ("position", "velocity", "acceleration"):
        np.testing.assert_allclose(np.conj(getattr(one, field)), getattr(other, field), rtol=1e-12, atol=1e-12)


@FEW
@given(crank_rockers(), SIGN, st.floats(1e-3, 1e3), st.floats(0.1, 100.0))
def test_lengths_and_speeds_scale(sizes, branch, scale, speed):
    one = solve(plan(four_bar(*sizes, branch=branch)), TURN, 1.0).point("rocker", "B")
    other = solve(plan(four_bar(*(scale * size for size in sizes), branch=branch)), TURN, speed).point("rocker", "B")
    for field, power in (("position", 0), ("velocity", 1), ("acceleration", 2)):
        expected = getattr(one, field) * scale * speed**power
        assert np.abs(getattr(other, field) - expected).max() <= 1e-11 * np.abs(expected).max()


@FEW
@given(LENGTH, LENGTH, LENGTH, LENGTH, SIGN)
def test_the_four_bar_closes_exactly_in_its_input_range(ground, crank, coupler, rocker, branch):
    status = solve(plan(four_bar(ground, crank, coupler, rocker, branch=branch)), TURN).status
    intervals = [(a + k, b + k) for a, b in input_range(ground, crank, coupler, rocker) for k in (0, 2 * np.pi)]
    inside = np.any([(a + 1e-6 < TURN) & (b - 1e-6 > TURN) for a, b in intervals] or [np.zeros(512, bool)], axis=0)
    outside = ~np.any([(a - 1e-6 < TURN) & (b + 1e-6 > TURN) for a, b in intervals] or [np.zeros(512, bool)], axis=0)
    assert (status[inside] != 1).all()
    assert (status[outside] == 1).all()


@examples(100)
@given(st.floats(1e-9, 1e-4), SIGN, st.sampled_from([36, 72, 360]), LENGTH, LENGTH)
def test_no_wrong_branch_close_to_a_change_point(short, branch, steps, coupler, rocker):
    """Grashof ratio up to 1 - 1e-9: the orientation of the triangle A B0 B never changes over the turn."""
    ground = 0.7 * (coupler + rocker)
    crank = (coupler + rocker - ground) * (1 - short)
    assume(grashof(ground, crank, coupler, rocker).kind == "crank-rocker")
    angle = np.arange(steps) * (2 * np.pi / steps)
    motion = solve(plan(four_bar(ground, crank, coupler, rocker, branch=branch)), angle, 1.0)
    assert (motion.status != 1).all()
    A, B = motion.point("crank", "A").position, motion.point("rocker", "B").position
    side = (np.conj(ground - A) * (B - A)).imag
    assert (np.sign(side) == branch).all()
    assert loop_gap(motion) <= 1e-12 / short


@settings(max_examples=6)
@given(st.data())
def test_closed_form_is_newton(data):
    kind = data.draw(st.sampled_from(["four-bar", "slider-crank", "six-bar"]))
    if kind == "slider-crank":
        crank, rod, offset = data.draw(slider_cranks())
        check_newton(slider_crank(crank, rod, offset=offset, branch=data.draw(SIGN)), TURN[::16])
    elif kind == "four-bar":
        check_newton(four_bar(*data.draw(crank_rockers()), branch=data.draw(SIGN)), TURN[::16])
    else:
        check_newton(
            six_bar(data.draw(crank_rockers()), (data.draw(SIGN), data.draw(SIGN)), data.draw(st.booleans())),
            TURN[::16],
        )
