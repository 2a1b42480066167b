"""Arms that tie the knots as bodies of a loom: where their tips are, what drives and weighs them, what is in their way.

Judges: the path of the arm that was synthesised, the phases of the cyclogram, the parts list.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from ilmek.machines.automated_loom import MACHINE
from ilmek.machines.automated_loom.assembly import assembly
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.knotting_dyad import KnottingDyad
from ilmek.machines.weaver.motions import CENTRE_ARM, LEFT_ARM, RIGHT_ARM
from ilmek.machines.weaver.tree import HEAD
from ilmek.part.contacts import contacts
from ilmek.part.drive_balance import drive_balance
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.poses import chains, poses
from ilmek.part.tree import Tree
from ilmek.timing.track import sample
from ilmek.units import mm, turn

DYAD = "knotting-dyad"
SERVOS = (f"{DYAD}/first-servo", f"{DYAD}/second-servo", f"{DYAD}/centre-motor", f"{DYAD}/solenoid")
LOOMS: tuple[dict[str, str], ...] = (
    {"knotting": "arms", "beat": "travelling"},
    {"knot": "asymmetric", "knotting": "arms", "beat": "travelling", "width": "0.6 m", "heads": "2"},
    {"knotting": "arms", "beat": "travelling", "knotting-dyad.elbow_drive": "direct", "warp_pitch": "2.5 mm"},
)

every_loom = pytest.mark.parametrize("number", range(len(LOOMS)))


@cache
def _loom(number: int) -> LoomDesign:
    made: LoomDesign = MACHINE.design(MACHINE.params.read(LOOMS[number]))
    return made


def _of_the_arms(tree: Tree) -> dict[str, tuple[Part, int]]:
    return {part.id: (part, number) for part, number in tree.occurrences() if part.id.startswith(DYAD)}


@every_loom
def test_every_line_of_the_arms_is_a_part_of_the_tree_and_back(number: int) -> None:
    loom = _loom(number)
    child = loom.machines[DYAD]
    counted = {part.title: pieces for part, pieces in _of_the_arms(loom_tree(loom)).values()}
    assert counted == {line.name: child.number * line.number for line in child.parts}
    assert child.number == loom.heads


@every_loom
def test_they_weigh_what_the_head_carries(number: int) -> None:
    loom = _loom(number)
    mass = sum(pieces * part.mass for part, pieces in _of_the_arms(loom_tree(loom)).values() if not np.isnan(part.mass))
    assert mass == pytest.approx(loom.heads * loom.weaver.params.arms.mass, rel=1e-9)


@every_loom
def test_motors_drive_each_degree_of_freedom_and_none_is_in_excess(number: int) -> None:
    """Two arms of two joints, a slide and three fingers for each head; without a motor its joint is free."""
    tree = loom_tree(_loom(number))
    free = drive_balance(tree)
    assert free.number == free.axes == free.driven
    assert not free.undriven + free.excess
    heads = _loom(number).heads
    assert [_of_the_arms(tree)[servo][1] for servo in SERVOS] == [2 * heads, 2 * heads, heads, 3 * heads]
    for servo in SERVOS:
        without = tree.replaced(
            replace(body, joint=replace(body.joint, motor="" if body.joint.motor == servo else body.joint.motor))
            for body in tree.bodies
        )
        assert drive_balance(without).excess == (servo,)
        assert all(body.startswith(DYAD) for body in drive_balance(without).undriven)


@every_loom
def test_tips_are_on_the_synthesised_path_when_the_cyclogram_says_so(number: int) -> None:
    """At rest in front of the warps, at the hand-over behind them; level with the middle of the opener."""
    loom = _loom(number)
    head = loom.machines[DYAD].design_as(KnottingDyad).head
    assert head is not None
    opener, angles = loom.weaver.params.opener, np.linspace(0.0, turn, 721)
    level = opener.front_span + opener.height / 2
    path = head.arm.tip(np.array([0.0, 1.0])) - head.section.middle
    for body, name, hand, tip in (
        ("link-2", LEFT_ARM, 1, head.arm.second),
        ("link-2-*", RIGHT_ARM, -1, head.arm.second),
        ("centre-gripper", CENTRE_ARM, 0, 0.0),
    ):
        place = _place(loom, f"{DYAD}/{body}", tip, angles)
        assert place[:, 1] == pytest.approx(level, abs=1e-9)
        position = sample(loom.knot_cyclogram.track(name), angles).position
        for end in (0.0, loom.knot_cyclogram.track(name).stroke):
            there = place[np.abs(position - end) < 1e-9]
            along = head.section.front - end if not hand else float(path[int(end > 0)].imag)
            aside = hand * float(path[int(end > 0)].real)
            assert len(there) > 5
            assert there[:, 0] == pytest.approx(aside, abs=0.05 * mm)
            assert there[:, 2] == pytest.approx(along, abs=0.05 * mm)
            assert (along < 0) == (end > 0)


def _place(loom: LoomDesign, name: str, x: float, angles: np.ndarray) -> np.ndarray:
    """A point of a body, x along its needle and amid this, over the knot, from the head's middle, fell, warps [m]."""
    tree = loom_tree(loom)
    (needle,) = (one for one in tree.body(name).occurrences if one.part.id == f"{DYAD}/needle")
    assert needle.part.shape is not None
    low = needle.positions[0].points(needle.part.shape.mesh(1 * mm).points)
    amid = (low[:, 2].min() + low[:, 2].max()) / 2
    (chain,) = [chain for chain in chains(tree) if chain[-1].body.id == name][:1]
    (head,) = [chain for chain in chains(tree) if chain[-1].body.id == HEAD][:1]
    posed, carried = poses(chain, "knot", angles), poses(head, "knot", angles)
    point = posed.origin + posed.rotation @ np.array([x, 0.0, amid]) - carried.origin
    return np.asarray(np.einsum("nji,nj->ni", carried.rotation, point))


@pytest.mark.parametrize("number", [0, 1])
def test_nothing_is_in_the_way_of_the_arms(number: int) -> None:
    """Over rows and knots, with clearances, in one group: all that the comparison in space says."""
    assert [check.name for check in assembly(_loom(number)).checks if not check.ok] == []


def test_a_servo_moved_into_the_case_is_found() -> None:
    """A planted fault: 5 mm towards the side plate, the servos of the first links are in it."""
    tree = loom_tree(_loom(0))
    (frame,) = (body for body in tree.bodies if body.id == f"{DYAD}/frame")
    aside = placement(5 * mm)
    moved = replace(
        frame,
        occurrences=tuple(
            replace(own, positions=tuple(aside.after(place) for place in own.positions))
            if own.part.id == SERVOS[0]
            else own
            for own in frame.occurrences
        ),
    )
    through = {
        frozenset(pair.parts)
        for pair in contacts(tree.replaced(moved if body.id == moved.id else body for body in tree.bodies)).through
    }
    assert frozenset({"weaver/right-side-plate", SERVOS[0]}) in through
