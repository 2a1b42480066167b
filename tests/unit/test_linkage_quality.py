"""Four-bars judged: Grashof's classes, dead centres, transmission angle against the solved motion."""

import dataclasses

import numpy as np
import pytest

from ilmek.errors import MechanismError
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import Body
from ilmek.linkage.quality import (
    dead_centres,
    grashof,
    input_range,
    least_transmission_angle,
    transmission_angle,
    transmission_extremes,
)
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.linkage.transmission import pressure_angle

BEAT_UP = (0.300, 0.0597, 0.2007, 0.2308)


@pytest.mark.parametrize(
    ("sizes", "kind", "turns"),
    [
        (BEAT_UP, "crank-rocker", True),
        ((1, 3, 3, 3), "double-crank", True),
        ((3, 3, 1, 3), "double-rocker", False),
        ((3, 3, 3, 1), "rocker-crank", False),
        ((3, 1, 3, 1), "change point", False),
        ((5, 2, 3, 3), "triple-rocker", False),
    ],
)
def test_grashof_kinds(sizes, kind, turns):
    verdict = grashof(*sizes)
    assert (verdict.kind, verdict.crank_turns) == (kind, turns)
    assert turns == (input_range(*sizes) == ((-np.pi, np.pi),)) or kind == "change point"


@pytest.mark.parametrize("branch", [+1, -1])
@pytest.mark.parametrize("sizes", [BEAT_UP, (1.0, 0.9, 1.3, 1.6), (1.0, 2.0, 1.4, 1.1)])
def test_rocker_stands_still_at_its_dead_centres(sizes, branch):
    found = dead_centres(*sizes, branch=branch)
    motion = solve(plan(four_bar(*sizes, branch=branch)), np.array([one.crank_angle for one in found]), 1.0)
    np.testing.assert_allclose(motion.omega("rocker"), 0, atol=1e-12)
    np.testing.assert_allclose(motion.direction("rocker"), np.exp(1j * np.array([one.rocker_angle for one in found])))
    apart = np.abs(motion.point("rocker", "B").position)
    expected = [sizes[1] + sizes[2] if one.extended else abs(sizes[1] - sizes[2]) for one in found]
    np.testing.assert_allclose(apart, expected)


def test_double_crank_has_no_dead_centre():
    assert dead_centres(1, 3, 3, 3, branch=1) == ()


def test_links_that_never_meet_have_no_input_range():
    assert input_range(10, 1, 2, 3) == ()
    assert input_range(1, 1, 9, 2) == ()


def test_range_about_the_far_side_is_one_interval():
    ((start, end),) = input_range(1.0, 0.9, 2.0, 0.5)
    assert 0 < start < np.pi < end == pytest.approx(2 * np.pi - start)


def test_transmission_angle_of_the_motion_reaches_the_extremes():
    motion = solve(plan(four_bar(*BEAT_UP, branch=-1)), np.arange(360) * (2 * np.pi / 360))
    mu = transmission_angle(motion, "B")
    assert (mu.min(), mu.max()) == pytest.approx(transmission_extremes(*BEAT_UP), rel=1e-12)
    assert least_transmission_angle(motion, "B") == pytest.approx(np.pi - mu.max())


def test_what_has_no_transmission_angle_is_refused():
    motion = solve(plan(slider_crank(0.1, 0.3, branch=1)), 0.0)
    with pytest.raises(MechanismError, match="'line' is a slide"):
        transmission_angle(motion, "line")
    with pytest.raises(MechanismError, match="body 'slider' of slider-crank has no pin but 'B'"):
        transmission_angle(motion, "B")
    with pytest.raises(MechanismError, match="branch of the four-bar is 0"):
        dead_centres(*BEAT_UP, branch=0)
    with pytest.raises(MechanismError, match="rocker of four-bar"):
        grashof(1, 1, 1, 0)


def test_the_pressure_angle_does_not_depend_on_the_frame_of_the_link() -> None:
    """The rod's own frame turned and shifted: asin((A.y - offset) / rod) of a slider-crank all the same."""
    plain = slider_crank(0.1, 0.2, branch=+1, offset=0.03)
    own = {"A": 0.05 + 0.02j, "B": 0.05 + 0.02j + 0.2 * np.exp(0.7j)}
    bodies = tuple(Body("rod", own) if body.name == "rod" else body for body in plain.bodies)
    angle = np.linspace(0.0, 6.0, 13)
    expected = np.arcsin(np.abs(0.1 * np.sin(angle) - 0.03) / 0.2)
    for mechanism in (plain, dataclasses.replace(plain, bodies=bodies)):
        np.testing.assert_allclose(pressure_angle(solve(plan(mechanism), angle), "line"), expected, atol=1e-12)
