"""Derivatives by dimensions: against differences of sixth order, the law of scale, and closed forms."""

import dataclasses

import mechanisms
import numpy as np
import pytest

from ilmek.errors import MechanismError
from ilmek.linkage.dimensions import BodyPoint, FixedAngle, LineDirection, dimensions
from ilmek.linkage.extremes import dwells, extreme_derivatives, extremes, rate_extreme_derivatives, rate_extremes
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import Body
from ilmek.linkage.one_input import one_input
from ilmek.linkage.outputs import Coordinate, RelativeAngle, Travel, output_history
from ilmek.linkage.quality import dead_centres
from ilmek.linkage.sensitivity import derivatives, spread
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

WEIGHTS = (3 / 4, -3 / 20, 1 / 60)
STEP = 5e-4

CASES = [
    (mechanisms.six_bar_with_moving_guide(), [RelativeAngle("link"), Coordinate("block", "D", 0.3), Travel("s")]),
    (mechanisms.quick_return(), [Coordinate("on_ground", "C"), Travel("t"), RelativeAngle("lever", "crank")]),
    (mechanisms.watt_six_bar(), [RelativeAngle("out"), Coordinate("link", "D", 1.0)]),
]


def difference(f):
    """f'(0) by central differences of sixth order."""
    return sum(weight * (f(k * STEP) - f(-k * STEP)) for k, weight in enumerate(WEIGHTS, 1)) / STEP


def changed(mechanism, changes):
    """The mechanism with dimensions changed: pairs of a dimension and by how much."""
    points = {body.name: dict(body.points) for body in mechanism.bodies}
    angles = {joint.name: {} for joint in mechanism.joints}
    for dimension, by in changes:
        if isinstance(dimension, BodyPoint):
            points[dimension.body][dimension.point] += by * np.exp(1j * dimension.along)
        else:
            name = "along" if isinstance(dimension, LineDirection) else "turned"
            angles[dimension.slide][name] = getattr(mechanism.joint(dimension.slide), name) + by
    return dataclasses.replace(
        mechanism,
        bodies=tuple(Body(name, own) for name, own in points.items()),
        joints=tuple(dataclasses.replace(joint, **angles[joint.name]) for joint in mechanism.joints),
    )


@pytest.mark.parametrize(("mechanism", "outputs"), CASES, ids=lambda case: getattr(case, "name", ""))
def test_all_dimensions_changed_at_once_act_as_their_derivatives_say(mechanism, outputs):
    """Along random directions in the space of all dimensions, so that a wrong one of them would show."""
    angle, speed, every = np.linspace(0.1, 6.0, 5), 1.3, dimensions(mechanism)
    motion = solve(plan(mechanism), angle, speed).require()
    found = [derivatives(motion, output, every) for output in outputs]
    for shares in np.random.default_rng(1).uniform(-1, 1, (3, len(every))):

        def courses(by, shares=shares):
            varied = changed(mechanism, zip(every, by * shares, strict=True))
            moved = solve(plan(varied), angle, speed).require()
            followers = [output_history(moved, output) for output in outputs]
            return np.array([[one.value, one.rate] for one in followers])

        exact = np.array([[shares @ one.value, shares @ one.rate] for one in found])
        np.testing.assert_allclose(exact, difference(courses), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize(("mechanism", "outputs"), CASES, ids=lambda case: getattr(case, "name", ""))
def test_lengths_times_derivatives_give_lengths_once_and_angles_never(mechanism, outputs):
    """Euler's theorem: a length is of first degree in all lengths of the drawing, an angle of degree zero."""
    lengths = [one for one in dimensions(mechanism) if one.length]
    motion = solve(plan(mechanism), np.linspace(0, 6, 50), 1.0).require()
    sizes = np.array([one.value(mechanism) for one in lengths])
    for output in outputs:
        course, found = output_history(motion, output), derivatives(motion, output, lengths)
        degree = 0 if isinstance(output, RelativeAngle) else 1
        np.testing.assert_allclose(sizes @ found.value, degree * course.value, atol=1e-12)
        np.testing.assert_allclose(sizes @ found.rate, degree * course.rate, atol=1e-11)


def test_two_inputs_are_held_alike():
    mechanism = mechanisms.two_motors()
    held = {"left": np.array([1.0, 1.5]), "right": np.array([2.0, 1.9])}
    motion = solve(plan(mechanism), held, {"left": 1.0, "right": -2.0}).require()
    arm, output = BodyPoint("left", "A"), Coordinate("one", "C")
    found = derivatives(motion, output, [arm])

    def courses(by):
        course = output_history(
            solve(plan(changed(mechanism, [(arm, by)])), held, {"left": 1.0, "right": -2.0}), output
        )
        return np.array([course.value, course.rate])

    np.testing.assert_allclose([found.value[0], found.rate[0]], difference(courses), atol=1e-10)


def test_dead_centres_move_with_each_link_as_their_closed_form_does():
    sizes = mechanisms.BEAT_UP
    links = [BodyPoint("ground", "B0"), BodyPoint("crank", "A"), BodyPoint("coupler", "B"), BodyPoint("rocker", "B")]
    moved, rocker = one_input(plan(four_bar(*sizes, branch=+1))), RelativeAngle("rocker")
    folded, extended = extremes(moved, rocker, -np.pi, np.pi)
    for extreme, place in ((extended, 0), (folded, 1)):
        found = extreme_derivatives(moved, rocker, extreme, links)
        for i in range(4):

            def closed(by, i=i, place=place):
                varied = [size + by * (k == i) for k, size in enumerate(sizes)]
                one = dead_centres(*varied, branch=+1)[place]
                return np.array([one.rocker_angle, one.crank_angle])

            step = difference(lambda by, closed=closed: closed(by / 10) * 10)
            np.testing.assert_allclose([found.value[i], found.input[i]], step, rtol=1e-9)
        assert np.dot(found.input, sizes) == pytest.approx(0, abs=1e-12)


def test_greatest_speed_scales_with_the_drawing():
    mechanism = mechanisms.quick_return()
    moved, output = one_input(plan(mechanism)), Coordinate("on_ground", "C")
    lengths = [one for one in dimensions(mechanism) if one.length]
    found = rate_extremes(moved, output, 0.0, 2 * np.pi)
    fastest = max(found, key=lambda one: abs(one.value))
    grown = rate_extreme_derivatives(moved, output, fastest, lengths)
    assert np.dot(grown, [one.value(mechanism) for one in lengths]) == pytest.approx(fastest.value, rel=1e-12)
    course = output_history(moved.motion(np.linspace(0, 2 * np.pi, 20001)), output)
    assert np.abs(course.rate).max() <= abs(fastest.value) * (1 + 1e-13)
    assert np.abs(course.rate).max() == pytest.approx(abs(fastest.value), rel=1e-6)
    assert fastest.greatest == (fastest.value > 0)


def test_two_extremes_between_neighbouring_samples_are_both_found():
    """At 12 samples a turn the coupler's direction of a near-parallel crank turns back and on between two of them."""
    mechanism = four_bar(1.0, 0.3, 0.9, 0.8, branch=+1, points={"coupler": {"P": 0.5 + 0.7j}})
    moved = one_input(plan(mechanism))
    for along in (0.1, 1.2, 2.0):
        output = Coordinate("coupler", "P", along)
        coarse = extremes(moved, output, -np.pi, np.pi, samples=12)
        fine = extremes(moved, output, -np.pi, np.pi, samples=1000)
        np.testing.assert_allclose([one.input for one in coarse], [one.input for one in fine], atol=1e-9)


def test_a_slider_dwells_about_its_dead_centres_as_long_as_its_closed_form_says():
    crank, rod, tolerance = 0.1, 0.3, 1e-3
    moved = one_input(plan(slider_crank(crank, rod, branch=+1)))
    inner, outer = dwells(moved, Travel("line"), tolerance, -1.0, 5.0)
    for found, reach, middle in ((outer, rod + crank, 0.0), (inner, rod - crank, np.pi)):
        at = reach - tolerance if middle == 0 else reach + tolerance
        half = abs(np.arccos((crank**2 + at**2 - rod**2) / (2 * crank * at)) - middle)
        assert (found.start, found.stop) == (pytest.approx(middle - half), pytest.approx(middle + half))
    (cut,) = dwells(moved, Travel("line"), tolerance, -0.05, 1.0)
    assert (cut.start, cut.stop) == (-0.05, pytest.approx(outer.stop))


def test_a_dead_sample_has_no_derivative():
    motion = solve(plan(four_bar(1.0, 2.0, 1.4, 1.1, branch=+1)), np.array([0.1, 3.0]), 1.0)
    found = derivatives(motion, RelativeAngle("rocker"), [BodyPoint("crank", "A")])
    assert np.isfinite(found.value[0, 0])
    assert np.isnan(found.value[0, 1])


def test_what_has_no_derivative_is_refused():
    mechanism = mechanisms.quick_return()
    motion = solve(plan(mechanism), 0.3, 1.0)
    with pytest.raises(MechanismError, match="'B' is not a slide; a travel"):
        derivatives(motion, Travel("B"), [BodyPoint("crank", "A")])
    with pytest.raises(MechanismError, match="'B' is not a slide; only a slide"):
        derivatives(motion, Travel("t"), [FixedAngle("B")])
    with pytest.raises(MechanismError, match="has no point 'Z'"):
        derivatives(motion, Travel("t"), [BodyPoint("crank", "Z")])
    with pytest.raises(MechanismError, match="1 tolerances for 2 dimensions"):
        spread(np.ones((2, 3)), [0.1])
    with pytest.raises(MechanismError, match="a tolerance is -0.1"):
        spread(np.ones((1, 3)), [-0.1])
    with pytest.raises(MechanismError, match="while left moves, a value for each of: right"):
        one_input(plan(mechanisms.two_motors()), "left")
    with pytest.raises(MechanismError, match="dwell within 0; a tolerance above 0"):
        dwells(one_input(plan(mechanism)), Travel("t"), 0, 0.0, 1.0)
    with pytest.raises(MechanismError, match="from 1.0 to 0.0"):
        extremes(one_input(plan(mechanism)), Travel("t"), 1.0, 0.0)
