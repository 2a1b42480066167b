"""Degrees of freedom of looms and of small trees against their motors; faults planted in what moves."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from planted_faults import without

from ilmek.machines.automated_loom import AutomatedLoomParams
from ilmek.machines.automated_loom import design as loom_design
from ilmek.machines.automated_loom.drives import drive_checks
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.part.drive_balance import drive_balance
from ilmek.part.mobility import TreeMobility, independent_rows
from ilmek.part.tree import Joint, JointKind, RigidBody, Tree

_LOOMS: tuple[dict[str, object], ...] = (
    {},
    {"beat": "linkage", "heads": 4},
    {"beat": "comb", "heads": 2},
    {"beat": "guide-cams"},
    {"weft.carrier": "rapier", "heads": 3},
    {"beat": "travelling", "knotting": "hand"},
)


@cache
def _loom(number: int) -> tuple[Tree, int]:
    settings = {name: str(value) for name, value in _LOOMS[number].items()}
    loom = loom_design(AutomatedLoomParams.read({"aim": "price", **settings}))
    return loom_tree(loom), parts_of_loom(loom).axes


def _failed(tree: Tree) -> dict[str, str]:
    return {check.name: check.source for check in drive_checks(tree) if not check.ok}


@pytest.mark.parametrize("number", range(len(_LOOMS)), ids=map(str, _LOOMS))
def test_a_loom_has_a_degree_of_freedom_for_each_axis_of_its_list(number: int) -> None:
    tree, axes = _loom(number)
    free = drive_balance(tree)
    assert free.number == free.driven == free.axes == axes
    assert free.undriven == free.excess == ()
    assert all("bar" in name for name in free.passive)
    assert not _failed(tree)


@pytest.mark.parametrize("number", [0, 1, 3])
def test_the_degrees_of_freedom_are_the_null_space_of_the_jacobian(number: int) -> None:
    """Judge: singular values; the motors are not asked."""
    tree, axes = _loom(number)
    mobility = TreeMobility(tree)
    rank = int(np.linalg.matrix_rank(mobility.jacobian, tol=1e-7))
    assert len(mobility.coordinates) - rank == axes + len(drive_balance(tree).passive)
    assert len(independent_rows(mobility.jacobian)) == rank


@pytest.mark.parametrize(
    ("part", "freed"),
    [
        ("weaver/sley-spring", "weaver/sley-follower"),
        ("weaver/pile-handler-spring", "weaver/pile-handler-follower"),
        ("weaver/centre-wire", "weaver/centre gripper's finger"),
        ("weaver/left-screw", "weaver/left side gripper"),
        ("weaver/freewheel", "weaver/turning pile handler"),
        ("weft/magnet", "weft/shuttle of the straight weft, weft/shuttle of the sinuous weft"),
    ],
)
def test_what_keeps_nothing_any_more_leaves_a_body_that_no_motor_holds(part: str, freed: str) -> None:
    tree, axes = _loom(0)
    faulty = without(tree, part)
    assert drive_balance(faulty).number == axes + len(freed.split(", "))
    assert _failed(faulty) == {"degrees of freedom": f"no motor holds: {freed}"}


def test_a_motor_less_leaves_a_shaft_and_one_more_is_in_excess() -> None:
    tree, _ = _loom(0)
    assert _failed(without(tree, "weaver/motor")) == {
        "degrees of freedom": "no motor holds: weaver/turning cam shaft",
    }
    own = next(own for body in tree.bodies for own in body.occurrences if own.part.id == "beat-up/motor")
    second = replace(own, part=replace(own.part, id="beat-up/second-motor"))

    def doubled(body: RigidBody, motor: str) -> RigidBody:
        joint = replace(body.joint, motor=motor)
        return replace(body, occurrences=(*body.occurrences, second), joint=joint)

    for motor in ("beat-up/second-motor", ""):  # on the rocker of the crank's loop, or on nothing
        faulty = tree.replaced(doubled(body, motor) if body.id == "beat-up/rocker" else body for body in tree.bodies)
        failed = _failed(faulty)
        assert failed.pop("axes that motors drive") == "in excess: beat-up/second-motor"
        assert failed.keys() == {"motors with power"}  # the cabinet has no amplifier for it


def test_a_slide_without_a_motor_is_a_degree_of_freedom_more_unless_it_is_passive() -> None:
    tree, axes = _loom(0)
    slide = RigidBody("slide", (), "weaver/head", Joint(JointKind.SLIDE))
    assert _failed(tree.replaced((*tree.bodies, slide))) == {"degrees of freedom": "no motor holds: slide"}
    held = replace(slide, joint=replace(slide.joint, passive="a spring holds it"))
    free = drive_balance(tree.replaced((*tree.bodies, held)))
    assert (free.number, len(free.passive)) == (axes, 2)


def test_a_motor_has_an_amplifier_and_a_power() -> None:
    tree, _ = _loom(0)
    assert _failed(without(tree, "automated-loom/control-axis")).keys() == {"motors with power"}
    bodies = []
    for body in tree.bodies:
        own = tuple(
            replace(one, part=replace(one.part, purchase=replace(one.part.purchase, power=0.0)))
            if one.part.id == "weft/motor" and one.part.purchase
            else one
            for one in body.occurrences
        )
        bodies.append(replace(body, occurrences=own))
    assert _failed(tree.replaced(bodies)) == {"motors with power": "no power: weft/motor"}
