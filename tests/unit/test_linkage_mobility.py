"""DriveBalance by count and by rank, constraints that repeat others, poses that are special."""

import dataclasses

import numpy as np
import pytest

from ilmek.errors import MechanismError
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.mobility import mobility
from ilmek.linkage.model import GROUND, Body, Coupling, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan


def parallelogram(links: int, third: float = 1.0) -> Mechanism:
    """A coupler on so many parallel cranks, drawn in place; the last one's length over the others'."""
    tops = {f"B{k}": complex(k, 1) for k in range(links)}
    cranks = [Body(f"crank{k}", {f"A{k}": k, f"B{k}": k + 1j}) for k in range(links)]
    last = f"B{links - 1}"
    coupler = Body("coupler", {**tops, last: tops[last].real + 1j * third})
    return Mechanism(
        (Body(GROUND, {f"A{k}": k for k in range(links)}), *cranks, coupler),
        (
            *(Pin(f"A{k}", GROUND, f"crank{k}") for k in range(links)),
            *(Pin(f"B{k}", f"crank{k}", "coupler") for k in range(links)),
        ),
        (Rotation("crank0", "A0"),),
        name="parallelogram",
    )


@pytest.mark.parametrize("mechanism", [four_bar(0.3, 0.06, 0.2, 0.23, branch=1), slider_crank(0.05, 0.2, branch=1)])
def test_count_and_rank_agree_where_nothing_repeats(mechanism):
    found = mobility(mechanism, solve(plan(mechanism), 0.7).pose())
    assert (found.counted, found.ranked, found.beside, found.surplus, found.redundant) == (1, 1, 1, 0, ())
    assert found.description == "1 degree of freedom by count and by rank"


@pytest.mark.parametrize("links", [3, 4])
def test_further_cranks_of_a_parallelogram_repeat_the_others(links):
    """By count 0 and -1; it moves all the same. Every joint of the coupler is in the dependence."""
    found = mobility(parallelogram(links), None)
    assert (found.counted, found.ranked, found.beside) == (3 - links, 1, 1)
    assert found.surplus == links - 2
    assert not found.singular
    assert set(found.redundant) == {f"{letter}{k}" for letter in "AB" for k in range(links)}
    assert (
        f"{found.counted} degree{'' if found.counted == 1 else 's'} of freedom by count, 1 by rank: "
        in found.description
    )


def test_a_crank_of_another_length_locks_it():
    """The third crank's pins are as far apart as before only in one pose, where it has a degree of freedom."""
    twisted = parallelogram(3)
    ground, *bodies = twisted.bodies
    ground = Body(GROUND, {**ground.points, "A2": 2 - 0.5j})
    bodies[2] = Body("crank2", {"A2": 2 - 0.5j, "B2": 2 + 1j})
    found = mobility(dataclasses.replace(twisted, bodies=(ground, *bodies)))
    assert found.ranked == 1
    assert found.beside == 0
    assert found.singular
    assert "0 in neighbouring poses" in found.description


def test_a_flat_parallelogram_has_a_surplus_degree_of_freedom_in_this_pose_only():
    flat = parallelogram(2)
    right = -np.pi / 2  # drawn upright, both cranks are turned to the right about their pivots
    pose = {"crank0": (0j, right), "crank1": (1 + 1j, right), "coupler": (1 - 1j, 0.0)}
    found = mobility(flat, pose)
    assert (found.counted, found.ranked, found.beside) == (1, 2, 1)
    assert found.singular


def test_two_guides_in_one_line_repeat_one_another():
    """A bar led twice along the same line: 3 - 4 = -1 by count, 1 by rank."""
    mechanism = Mechanism(
        (Body(GROUND, {"s": 0, "t": 1}), Body("bar", {"s": 0, "t": 1})),
        (Slide("s", "bar", GROUND), Slide("t", "bar", GROUND)),
        (),
    )
    found = mobility(mechanism)
    assert (found.counted, found.ranked, found.surplus, found.redundant) == (-1, 1, 2, ("s", "t"))
    assert found.description == "-1 degrees of freedom by count, 1 by rank: 2 constraints are redundant; among s, t"


def test_couplings_count():
    ring = Mechanism(
        (Body(GROUND, {"A": 0, "B": 1, "C": 1j}), *(Body(name.lower(), {name: 0}) for name in "ABC")),
        tuple(Pin(name, GROUND, name.lower()) for name in "ABC"),
        (),
        couplings=tuple(
            Coupling(one + two, "gears", (one.lower(), one), (two.lower(), two), -1.0, 0.0, 0.0)
            for one, two in ("AB", "BC", "CA")
        ),
        pose={"b": (1 + 0j, 0.0), "c": (1j, 0.0)},
    )
    found = mobility(ring)
    assert (found.counted, found.ranked) == (0, 0)  # three wheels in a ring lock one another
    two = mobility(dataclasses.replace(ring, couplings=ring.couplings[:2]))
    assert (two.counted, two.ranked) == (1, 1)


def test_what_cannot_be_assembled_is_said():
    apart = parallelogram(2)
    bodies = (Body(GROUND, {"A0": 0, "A1": 9}), *apart.bodies[1:])
    with pytest.raises(MechanismError, match="parallelogram cannot be assembled near its pose: .*B1.* do not close"):
        mobility(dataclasses.replace(apart, bodies=bodies))


def test_a_repeated_crank_has_no_plan_and_its_joints_are_named():
    mechanism = dataclasses.replace(parallelogram(3), branches={"B1": +1})
    with pytest.raises(
        MechanismError, match="over-constrained at crank2; joints A2, B2 over-constrain it once; remove"
    ):
        plan(mechanism)
