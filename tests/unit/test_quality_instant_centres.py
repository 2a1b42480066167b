"""Instant centres, centrodes, pressure angle, velocity ratio: theorems and constructions of the drawing board."""

import itertools

import mechanisms
import numpy as np
import pytest

from ilmek.errors import MechanismError
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.instant_centres import centrodes, instant_centre, instant_centres
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.one_input import one_input
from ilmek.linkage.outputs import RelativeAngle, Travel
from ilmek.linkage.quality import transmission_angle
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.linkage.transmission import mechanical_advantage, pressure_angle, velocity_ratio
from ilmek.plane.vectors import cross

TURN = np.arange(360) * (2 * np.pi / 360) + 0.003

ANY = [mechanisms.six_bar_with_moving_guide(), mechanisms.quick_return(), mechanisms.watt_six_bar()]


@pytest.mark.parametrize("mechanism", ANY, ids=lambda one: one.name)
def test_three_centres_of_three_bodies_stand_in_line(mechanism):
    """Aronhold and Kennedy, for all triples of bodies."""
    motion = solve(plan(mechanism), TURN, 1.0).require()
    centres = instant_centres(motion)
    count = len(mechanism.bodies)
    assert len(centres) == count * (count - 1) // 2
    for three in itertools.combinations([body.name for body in mechanism.bodies], 3):
        a, b, c = (centres[pair] for pair in itertools.combinations(three, 2))
        seen = ~(a.far | b.far | c.far)
        p, q, r = (one.position[seen] for one in (a, b, c))
        spans = np.maximum.reduce([np.abs(q - p), np.abs(r - p), np.abs(r - q)])
        reach = np.maximum.reduce([np.abs(p), np.abs(q), np.abs(r), np.ones(len(p))])
        assert (np.abs(cross(q - p, r - p)) <= 1e-9 * spans * reach).all()


@pytest.mark.parametrize("mechanism", ANY, ids=lambda one: one.name)
def test_the_centre_of_pinned_bodies_is_the_pin_and_that_of_a_slide_is_square_to_it_at_infinity(mechanism):
    motion = solve(plan(mechanism), TURN, 1.0).require()
    for joint in mechanism.joints:
        first, second = joint.bodies
        found = instant_centre(motion, first, second)
        if isinstance(joint, Pin):
            np.testing.assert_allclose(found.position, motion.point(first, joint.name).position, atol=1e-9)
        else:
            line = motion.direction(joint.guide) * np.exp(1j * joint.along)
            assert found.far.all()
            np.testing.assert_allclose(np.real(np.conj(line) * found.direction), 0, atol=1e-9)


def test_a_four_bars_centres_are_where_its_links_lines_meet():
    motion = solve(plan(four_bar(*mechanisms.BEAT_UP, branch=+1)), TURN, 1.0).require()
    coupler = instant_centre(motion, "coupler").position
    for pin, body in (("A", "crank"), ("B", "rocker")):
        assert np.allclose(cross(motion.direction(body), coupler - motion.point(body, pin).position), 0, atol=1e-12)
    crank = instant_centre(motion, "crank", "rocker").position
    assert np.allclose(crank.imag, 0)
    np.testing.assert_allclose(motion.omega("rocker"), crank.real / (crank.real - 0.300))  # Freudenstein's ratio


def test_trammel_rolls_on_cardans_circles():
    """A bar with both ends on lines at right angles: a circle of its length as diameter rolls in one twice as large."""
    bar = Mechanism(
        bodies=(
            Body(GROUND, {"O": 0, "x": 0, "y": 0}),
            Body("crank", {"O": 0, "M": 0.5}),
            Body("bar", {"M": 0, "X": 0.5}),
            Body("shoe", {"X": 0, "x": 0}),
        ),
        joints=(
            Pin("O", GROUND, "crank"),
            Pin("M", "crank", "bar"),
            Pin("X", "bar", "shoe"),
            Slide("x", "shoe", GROUND),
        ),
        inputs=(Rotation("crank", "O"),),
        branches={"X": +1},
    )
    motion = solve(plan(bar), np.linspace(0.1, 1.4, 100), 1.0).require()
    found = centrodes(motion, "bar")
    np.testing.assert_allclose(np.abs(found.fixed), 1.0)
    np.testing.assert_allclose(np.abs(found.moving), 0.5)


def test_moving_centrode_rolls_on_the_fixed_one():
    """Both pass through the centre, along the same way at the same speed: by differences of fourth order."""
    where, step = np.linspace(0.5, 2.0, 8), 1e-3
    around = [
        centrodes(solve(plan(mechanisms.watt_six_bar()), where + k * step, 1.0), "link", "crank")
        for k in (-2, -1, 0, 1, 2)
    ]
    motion = solve(plan(mechanisms.watt_six_bar()), where).require()
    ways = {}
    for name, body in (("fixed", "crank"), ("moving", "link")):
        back, less, here, more, on = (getattr(one, name) for one in around)
        ways[body] = motion.direction(body) * (back - 8 * less + 8 * more - on) / (12 * step)
        centre = motion.origin(body) + here * motion.direction(body)
        np.testing.assert_allclose(centre, instant_centre(solve(motion.plan, where, 1.0), "link", "crank").position)
    np.testing.assert_allclose(ways["crank"], ways["link"], rtol=1e-6)


def test_pressure_angle_and_virtual_power_of_a_slider_crank():
    mechanism = slider_crank(0.1, 0.3, branch=+1, offset=0.02)
    motion = solve(plan(mechanism), TURN, 1.0)
    sine = (0.1 * np.sin(TURN) - 0.02) / 0.3
    np.testing.assert_allclose(pressure_angle(motion, "line"), np.abs(np.arcsin(sine)))
    moved = one_input(plan(mechanism))
    ratio = velocity_ratio(moved, Travel("line"), TURN)
    by_rod = -0.1 * np.sin(TURN - np.angle(motion.direction("rod"))) / np.cos(np.angle(motion.direction("rod")))
    np.testing.assert_allclose(ratio, by_rod)
    np.testing.assert_allclose(mechanical_advantage(moved, Travel("line"), TURN) * ratio, 1.0)


def test_a_driven_slider_reads_the_same_ratio_the_other_way_round():
    pump = plan(mechanisms.pushed_slider_crank())
    moved = one_input(pump)
    way = np.linspace(0.25, 0.38, 20)
    angle = np.angle(moved.motion(way).direction("crank"))
    crank = one_input(plan(slider_crank(0.1, 0.3, branch=+1, offset=0.02)))
    np.testing.assert_allclose(
        velocity_ratio(moved, RelativeAngle("crank"), way),
        mechanical_advantage(crank, Travel("line"), angle),
        rtol=1e-9,
    )


def test_a_ternary_links_transmission_angle_is_taken_from_the_point_said():
    motion = solve(plan(mechanisms.watt_six_bar()), TURN).require()
    said = transmission_angle(motion, "D", from_points=("C", "D0"))
    np.testing.assert_array_equal(said, transmission_angle(motion, "D"))
    other = transmission_angle(motion, "B", from_points=("A", "C"))
    assert np.abs(other - transmission_angle(motion, "B")).max() > 0.1


def test_what_has_no_centre_or_pressure_angle_is_refused():
    motion = solve(plan(mechanisms.quick_return()), 0.3)
    with pytest.raises(MechanismError, match="is at rest: it has no instant centres; solve it with speed=1"):
        instant_centres(motion)
    with pytest.raises(MechanismError, match="'crank' against itself"):
        instant_centre(motion, "crank", "crank")
    with pytest.raises(MechanismError, match="'A0' is a pin"):
        pressure_angle(motion, "A0")
    with pytest.raises(MechanismError, match="one of them on 'on_lever' of quick return: none"):
        pressure_angle(motion, "t")
