"""Angles counted through full turns, against closed forms of the four-bar and of gears; springs by virtual work."""

import numpy as np
import pytest

from ilmek.dynamics.forward import EndKind, ForwardState, forward
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.reduced import reduce
from ilmek.dynamics.springs import TorsionSpring
from ilmek.errors import MechanismError
from ilmek.linkage.followed import followed_angle
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import GROUND, Body, Coupling, Displacement, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

DRAG_LINK = (0.1, 0.25, 0.3, 0.22)
"""Ground shortest: crank, coupler and rocker all turn fully."""


def rocker_angle(lengths: tuple[float, float, float, float], crank: np.ndarray) -> np.ndarray:
    """Rocker of a four-bar at crank angles, the pin left of crank pin -> pivot, by two triangles; in (-pi, pi]."""
    ground, a, b, c = lengths
    offset = ground - a * np.exp(1j * crank)
    base = np.angle(offset)
    inner = np.arccos((b**2 + np.abs(offset) ** 2 - c**2) / (2 * b * np.abs(offset)))
    pin = a * np.exp(1j * crank) + b * np.exp(1j * (base + inner))
    return np.asarray(np.angle(pin - ground))


def counted(lengths: tuple[float, float, float, float], crank: float) -> float:
    """The rocker's angle, followed in steps of a thousandth of a turn from the crank's 0."""
    way = np.linspace(0.0, crank, 2 + int(abs(crank) * 1000 / (2 * np.pi)))
    return float(np.unwrap(rocker_angle(lengths, way))[-1])


@pytest.mark.parametrize("turns", [0.0, 0.3, 0.99, -0.7, 7.25, -12.6, 400.1])
def test_a_drag_link_counts_the_turns_of_its_rocker(turns: float) -> None:
    """One turn of the rocker in each of the crank, from a single pose, and against the crank none."""
    planned, angle = plan(four_bar(*DRAG_LINK, branch=+1)), 2 * np.pi * turns
    motion = solve(planned, np.array([angle]), 3.0)
    right = counted(DRAG_LINK, angle)
    assert followed_angle(planned, motion.drives, "rocker", GROUND)[0] == pytest.approx(right, abs=1e-9)
    assert followed_angle(planned, motion.drives, "rocker", "crank")[0] == pytest.approx(right - angle, abs=1e-9)


def test_steps_of_many_turns_are_exact() -> None:
    planned = plan(four_bar(*DRAG_LINK, branch=+1))
    values = 2 * np.pi * np.array([0.1, 5.9, 2.4, 30.0, -8.8])
    motion = solve(planned, values)
    right = [counted(DRAG_LINK, value) for value in values]
    np.testing.assert_allclose(followed_angle(planned, motion.drives, "rocker", GROUND), right, atol=1e-9)
    np.testing.assert_allclose(motion.angle("rocker"), np.array(right), atol=1e-9)  # the first is within half a turn
    np.testing.assert_allclose(np.diff(motion.angle("crank")), np.diff(values), atol=1e-9)


@pytest.mark.parametrize("gap", [1e-3, 1e-6, 1e-9])
def test_a_rocker_that_turns_over_in_a_narrow_range_is_followed(gap: float) -> None:
    """Next to the change point of a parallelogram the rocker turns over by nearly half a turn at once."""
    lengths = (0.2, 0.1 + gap, 0.2, 0.1)  # crank longer than the rocker: it does not close all over
    planned = plan(four_bar(*lengths, branch=+1))
    values = np.linspace(0.3, 2.6, 24)
    motion = solve(planned, values)
    way = np.unwrap(rocker_angle(lengths, np.linspace(0.3, 2.6, 24_000)))
    picked = np.interp(values, np.linspace(0.3, 2.6, 24_000), way)
    np.testing.assert_allclose(followed_angle(planned, motion.drives, "rocker", GROUND), picked, atol=1e-5)


def test_a_swing_counts_from_the_place_nearest_to_zero() -> None:
    """A driven rocker that closes around half a turn: no jump at 180 degrees, and the same one whole turn later."""
    lengths = (0.3, 0.22, 0.25, 0.1)
    planned = plan(four_bar(*lengths, branch=+1))
    values = np.linspace(-np.pi, np.pi, 2000)
    motion = solve(planned, values)
    angle = followed_angle(planned, motion.drives, "rocker", GROUND)
    closed = np.isfinite(angle)
    assert 0 < closed.mean() < 1
    ranges = np.split(np.flatnonzero(closed), np.flatnonzero(np.diff(np.flatnonzero(closed)) > 1) + 1)
    for rows in ranges:
        assert np.abs(np.diff(angle[rows])).max() < 0.5
    later = solve(planned, values + 2 * np.pi)
    np.testing.assert_allclose(followed_angle(planned, later.drives, "rocker", GROUND), angle, atol=1e-9)


def test_a_spring_on_the_rocker_needs_the_torque_of_virtual_work() -> None:
    """M = dV/dq, V = k (theta - theta_0)² / 2, over five turns of the crank, by differences of the closed form."""
    planned, k, start = plan(four_bar(*DRAG_LINK, branch=+1)), 2.5, -7.0
    values = np.linspace(-4.0, 30.0, 9)
    forces = inverse(solve(planned, values, 2.0), {}, (TorsionSpring(GROUND, "rocker", k, start),)).require()
    step = 1e-5
    energy = [[k * (counted(DRAG_LINK, v + d) - start) ** 2 / 2 for v in values] for d in (-step, step)]
    np.testing.assert_allclose(forces.effort("crank"), np.diff(energy, axis=0)[0] / (2 * step), rtol=1e-6)
    alone = [
        inverse(solve(planned, np.array([v]), 2.0), {}, (TorsionSpring(GROUND, "rocker", k, start),)) for v in values
    ]
    np.testing.assert_allclose([one.effort("crank")[0] for one in alone], forces.effort("crank"), rtol=1e-12)


def test_a_driven_pin_of_two_moving_bodies_has_the_angle_of_its_input() -> None:
    """Neither body's angle follows from the inputs alone; their difference does: the value of the input."""
    base = slider_crank(0.1, 0.3, branch=+1, points={"rod": {"K": 0.15}})
    mechanism = Mechanism(
        (*base.bodies, Body("flap", {"K": 0, "tip": 0.05})),
        (*base.joints, Pin("K", "rod", "flap")),
        (*base.inputs, Rotation("flap", "K")),
        base.branches,
    )
    planned = plan(mechanism)
    flap = np.array([0.0, 40.0, -100.0])
    motion = solve(planned, {"crank": np.array([0.0, 1.0, 90.0]), "flap": flap}, {"crank": 1.0, "flap": 1.0})
    np.testing.assert_allclose(followed_angle(planned, motion.drives, "flap", "rod"), flap, atol=1e-12)
    held = inverse(motion, {}, (TorsionSpring("rod", "flap", 3.0, 0.5),))
    np.testing.assert_allclose(held.effort("flap"), 3.0 * (flap - 0.5), rtol=1e-12)


def test_two_moving_inputs_are_followed_from_sample_to_sample() -> None:
    """A five-bar whose cranks turn three and minus two turns: against its own fine steps."""
    mechanism = Mechanism(
        (
            Body(GROUND, {"A": 0, "D": 0.1}),
            Body("left", {"A": 0, "B": 0.3}),
            Body("one", {"B": 0, "C": 0.45}),
            Body("two", {"C": 0, "E": 0.5}),
            Body("right", {"D": 0, "E": 0.05}),
        ),
        (Pin("A", GROUND, "left"), Pin("D", GROUND, "right"), Pin("B", "left", "one"), Pin("C", "one", "two"),
         Pin("E", "two", "right")),
        (Rotation("left", "A"), Rotation("right", "D")),
        {"C": 1},
    )  # fmt: skip
    planned = plan(mechanism)
    share = np.linspace(0.0, 1.0, 4001)
    fine = solve(planned, {"left": 6 * np.pi * share, "right": -4 * np.pi * share})
    assert fine.ok
    right = np.unwrap(np.angle(fine.direction("two")))
    coarse = solve(planned, {"left": 6 * np.pi * share[::1000], "right": -4 * np.pi * share[::1000]})
    np.testing.assert_allclose(followed_angle(planned, coarse.drives, "two", GROUND), right[::1000], atol=1e-9)


def test_gears_whose_mechanism_repeats_after_several_turns() -> None:
    """A dyad between a crank and one geared 1 : -1/2: the same position after two turns of the input, not after one."""
    wheels = Coupling("mesh", "gears", ("left", "A"), ("right", "D"), -0.5, 0.3, 2.0)
    mechanism = Mechanism(
        (
            Body(GROUND, {"A": 0, "D": 1 + 0.1j}),
            Body("left", {"A": 0, "B": 0.3}),
            Body("one", {"B": 0, "C": 0.9}),
            Body("two", {"C": 0, "E": 1.1}),
            Body("right", {"D": 0, "E": 0.25}),
        ),
        (Pin("A", GROUND, "left"), Pin("D", GROUND, "right"), Pin("B", "left", "one"), Pin("E", "right", "two"),
         Pin("C", "one", "two")),
        (Rotation("left", "A"),),
        {"C": 1},
        couplings=(wheels,),
    )  # fmt: skip
    planned = plan(mechanism)
    fine = solve(planned, np.linspace(0, 40.0, 20_001)).require()
    right = np.unwrap(np.angle(fine.direction("two")))
    coarse = solve(planned, np.linspace(0, 40.0, 6))
    np.testing.assert_allclose(followed_angle(planned, coarse.drives, "two", GROUND), right[::4000], atol=1e-9)
    np.testing.assert_allclose(
        followed_angle(planned, coarse.drives, "right", GROUND), 2.0 - 0.5 * (np.linspace(0, 40.0, 6) - 0.3), atol=1e-12
    )


def test_a_cylinder_turns_its_boom_without_a_jump_at_half_a_turn() -> None:
    """An inverted slider-crank driven along its slide: law of cosines, the boom on both sides of 180 degrees."""
    mechanism = Mechanism(
        (
            Body(GROUND, {"A": 0, "D": 0.5}),
            Body("boom", {"D": 0, "B": 0.4}),
            Body("rod", {"B": 0, "cylinder": 0}),
            Body("tube", {"A": 0, "cylinder": 0}),
        ),
        (Pin("A", GROUND, "tube"), Pin("D", GROUND, "boom"), Pin("B", "boom", "rod"), Slide("cylinder", "rod", "tube")),
        (Displacement("cylinder"),),
        {"B": 1},
        pose={"tube": (0j, 0.9), "rod": (0.3 + 0.4j, 0.9), "boom": (0.5, 1.9)},
    )
    planned = plan(mechanism)
    length = np.array([0.3, 0.85, 0.5, 0.2])
    motion = solve(planned, length)
    opened = np.pi - np.arccos((0.5**2 + 0.4**2 - length**2) / (2 * 0.5 * 0.4))
    angle = followed_angle(planned, motion.drives, "boom", GROUND)
    np.testing.assert_allclose(angle, opened, atol=1e-9)


def test_an_unknown_body_is_refused() -> None:
    planned = plan(four_bar(*DRAG_LINK, branch=+1))
    with pytest.raises(MechanismError, match="no body 'lever'"):
        followed_angle(planned, solve(planned, 0.0).drives, "lever", GROUND)


def test_a_spring_wound_three_turns_swings_its_arm_as_a_harmonic() -> None:
    """J theta'' = -k (theta - theta_0): theta - theta_0 = -6 pi cos(sqrt(k / J) t): six turns from end to end."""
    arm = Mechanism(
        (Body(GROUND, {"O": 0}), Body("arm", {"O": 0})), (Pin("O", GROUND, "arm"),), (Rotation("arm", "O"),)
    )
    inertia, k, start = 0.02, 0.05, 6 * np.pi
    reduced = reduce(plan(arm), {"arm": Inertia(1.0, 0j, inertia)}, (TorsionSpring(GROUND, "arm", k, start),))
    run = forward(reduced, ForwardState(0.0), 4.0, every=0.01, rtol=1e-10)
    assert run.end.kind is EndKind.TIME
    np.testing.assert_allclose(run.position, start * (1 - np.cos(np.sqrt(k / inertia) * run.time)), atol=1e-7)
    assert np.ptp(run.position) > 2 * np.pi * 5.9
    assert run.energy_error < 1e-7


def test_a_spring_on_a_rocker_keeps_its_energy_over_many_turns() -> None:
    """A drag link flung by a spring on its rocker: J q'² / 2 + k (theta - theta_0)² / 2, theta by the closed form."""
    planned, k, start = plan(four_bar(*DRAG_LINK, branch=+1)), 0.01, 40.0
    reduced = reduce(planned, {"crank": Inertia(1.0, 0j, 0.01)}, (TorsionSpring(GROUND, "rocker", k, start),))
    run = forward(reduced, ForwardState(0.0), 2.0, every=0.1)
    stored = np.array([k * (counted(DRAG_LINK, float(value)) - start) ** 2 / 2 for value in run.position])
    assert np.ptp(run.position) > 4 * np.pi
    np.testing.assert_allclose(run.kinetic + stored, stored[0], rtol=1e-6)
