"""Circuits, branches and the input's range: against Grashof's theory, closed forms and brute force."""

import dataclasses
import functools
import itertools

import mechanisms
import numpy as np
import pytest

from ilmek.errors import MechanismError
from ilmek.linkage.circuits import assembly_ranges, circuits
from ilmek.linkage.extremes import extremes
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.model import Body
from ilmek.linkage.one_input import one_input
from ilmek.linkage.outputs import RelativeAngle
from ilmek.linkage.quality import grashof, input_range
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

FOUR_BARS = {
    "crank-rocker": (3.0, 1.0, 2.7, 1.3 + 1e-5),  # four parts in a million from its change point
    "double-rocker": (2.0, 2.5, 1.0, 2.5),
    "rocker-crank": (1.1, 1.0, 1.2, 0.4),
    "triple-rocker": (0.300, 0.200, 0.200, 0.230),
}


@functools.cache
def circuits_of(kind):
    return circuits(one_input(plan(four_bar(*FOUR_BARS[kind], branch=+1))))


@pytest.mark.parametrize("kind", FOUR_BARS)
def test_four_bars_have_the_circuits_that_grashofs_theory_gives_them(kind):
    """Two circuits if the shortest link turns fully, else one; each of two branches where the crank swings."""
    sizes = FOUR_BARS[kind]
    verdict = grashof(*sizes)
    assert verdict.kind == kind
    found = circuits_of(kind)
    assert len(found) == (1 if kind == "triple-rocker" else 2)
    for circuit in found:
        assert circuit.closed
        assert not circuit.crossings
        assert circuit.turns == verdict.crank_turns
        assert len(circuit.branches) == (1 if verdict.crank_turns else 2)
        signs = [branch.branches["B"] for branch in circuit.branches]
        assert len(set(signs)) == len(signs)
    ranges = sorted((part.start, part.stop) for one in found for part in one.branches if part.branches["B"] == 1)
    np.testing.assert_allclose(ranges, input_range(*sizes), rtol=1e-12)


def test_ranges_end_where_the_links_are_in_line_and_the_rate_is_without_bound():
    sizes = FOUR_BARS["triple-rocker"]
    (circuit,) = circuits_of("triple-rocker")
    stop, start = circuit.dead_centres
    for end, inward in ((start, 1), (stop, -1)):
        closed = solve(plan(four_bar(*sizes, branch=-1)), end + inward * np.array([1e-10, 1e-12, -1e-11]), 1.0)
        assert (closed.status[:2] != 1).all()
        assert closed.status[2] == 1
        assert abs(closed.omega("rocker")[0]) > 1e3


def test_toggles_of_a_circuit_are_the_extremes_on_its_branches():
    sizes = FOUR_BARS["double-rocker"]
    for circuit in circuits_of("double-rocker"):
        seen = []
        for branch in circuit.branches:
            moved = one_input(plan(four_bar(*sizes, branch=branch.branches["B"])))
            seen += [
                (one.input, one.value)
                for one in extremes(moved, RelativeAngle("rocker"), branch.start + 1e-9, branch.stop - 1e-9)
            ]
        np.testing.assert_allclose(sorted(circuit.toggles(RelativeAngle("rocker"))), sorted(seen), atol=1e-9)


def test_bodies_along_a_circuit_close_their_loops_with_their_rates():
    (circuit,) = circuits_of("triple-rocker")
    lengths = np.linspace(0, circuit.stop, 40, endpoint=False) + 1e-3
    step = 1e-5
    before, at, after = (circuit.bodies(lengths + by) for by in (-step, 0, step))
    for joint in circuit.mechanism.joints:
        one, other = (at[body].carry(circuit.mechanism.point(body, joint.name)) for body in joint.bodies)
        for part in ("position", "velocity", "acceleration"):
            np.testing.assert_allclose(getattr(one, part), getattr(other, part), atol=1e-12)
    there, back = (body["coupler"].carry(0.1j) for body in (after, before))
    here = at["coupler"].carry(0.1j)
    np.testing.assert_allclose((there.position - back.position) / (2 * step), here.velocity, atol=1e-8)
    curved = (there.position - 2 * here.position + back.position) / step**2
    np.testing.assert_allclose(curved, here.acceleration, atol=1e-4)


def test_a_six_bars_branches_are_all_the_runs_in_which_it_closes():
    """The second loop too short to follow the rocker: ranges against a fine scan, for every pair of signs."""
    whole = mechanisms.watt_six_bar()
    bodies = {body.name: body for body in whole.bodies}
    bodies["link"] = Body("link", {"C": 0, "D": 0.95})
    bodies["out"] = Body("out", {"D0": 0, "D": 0.8})
    mechanism = dataclasses.replace(whole, bodies=tuple(bodies.values()))
    found = circuits(one_input(plan(mechanism)))
    parts = [part for circuit in found for part in circuit.branches]
    scan = np.arange(-np.pi, np.pi, 2e-3) + 1e-4
    for signs in itertools.product((+1, -1), repeat=2):
        branches = dict(zip(("B", "D"), signs, strict=True))
        closes = solve(plan(dataclasses.replace(mechanism, branches=branches)), scan).status == 0
        own = [part for part in parts if part.branches == branches]
        inside = np.zeros(len(scan), dtype=bool)
        for part in own:
            inside |= np.mod(scan - part.start, 2 * np.pi) < part.stop - part.start
        np.testing.assert_array_equal(inside, closes)
        assert len(own) == max(np.count_nonzero(closes & ~np.roll(closes, 1)), 1)
    assert sum(len(circuit.dead_centres) for circuit in found) == sum(not part.full for part in parts) > 0
    assert all(circuit.closed for circuit in found)


def test_at_a_change_point_the_circuits_cross():
    """A parallelogram: both circuits, the parallel and the crossed one, meet with all links in line."""
    found = circuits(one_input(plan(four_bar(3.0, 1.0, 3.0, 1.0, branch=+1))))
    assert grashof(3, 1, 3, 1).kind == "change point"
    assert len(found) == 2
    for circuit in found:
        np.testing.assert_allclose(np.sin(circuit.crossings), 0, atol=1e-6)
        assert len(circuit.crossings) == 2


def test_a_driven_slider_runs_between_its_dead_centres():
    moved = one_input(plan(mechanisms.pushed_slider_crank()))
    ends = (np.sqrt(0.2**2 - 0.02**2), np.sqrt(0.4**2 - 0.02**2))
    np.testing.assert_allclose(assembly_ranges(moved), [(-ends[1], -ends[0]), ends], rtol=1e-13)


def test_one_of_two_motors_held_leaves_a_five_bars_range():
    """With the other arm held the five-bar is a four-bar from its pin."""
    held = 1.0
    moved = one_input(plan(mechanisms.two_motors()), "left", {"right": held})
    pin = 1.0 + 0.3 * np.exp(1j * held)
    ((start, stop),) = assembly_ranges(moved)
    assert (start, stop) == (-np.pi, np.pi)
    assert input_range(abs(pin), 0.4, 0.9, 0.8) == ((-np.pi, np.pi),)


def test_a_group_without_closed_form_is_followed_from_its_pose():
    """A plate on three links, one on the crank (class III): the circuit goes through the poses of Newton's method."""
    moved = one_input(plan(mechanisms.triad()))
    (found,) = circuits(moved)
    assert (found.turns, found.closed, found.dead_centres) == (1, True, ())
    places = np.linspace(0.1, found.stop, 12, endpoint=False)
    motion = moved.motion(found.inputs(places)).require()
    for name, body in found.bodies(places).items():
        np.testing.assert_allclose(motion.origin(name), body.anchor.position, atol=1e-12)


def test_a_linkage_that_never_closes_has_no_circuit():
    moved = one_input(plan(four_bar(10.0, 1.0, 2.0, 3.0, branch=+1)))
    assert circuits(moved) == ()
    assert assembly_ranges(moved) == ()
    with pytest.raises(MechanismError, match="input 'rocker' of four-bar; one of crank"):
        one_input(moved.plan, "rocker")
