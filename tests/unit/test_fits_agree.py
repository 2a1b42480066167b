"""Over the trees of head, shedding and warps: fits, notes and hardness agree; rollers have play along their pins."""

from functools import cache

import numpy as np
import pytest

from ilmek.machines.making_checks import making_checks
from ilmek.machines.shedding import MACHINE as SHEDDING
from ilmek.machines.shedding.tree import tree as shedding_tree
from ilmek.machines.warp_tension import MACHINE as WARPS
from ilmek.machines.warp_tension.tree import tree as warps_tree
from ilmek.machines.weaver import MACHINE as HEAD
from ilmek.machines.weaver.tree import head_tree
from ilmek.part.colliders import collider
from ilmek.part.contacts import contacts
from ilmek.part.meetings import meetings
from ilmek.part.placement import Placement, placement
from ilmek.part.tolerances import Characteristic, FitDuty
from ilmek.part.tolerancing import tolerances_of
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.units import mm, um

TREES = {
    "head": lambda: head_tree(HEAD.design(HEAD.params.read({}))),
    "shedding": lambda: shedding_tree(SHEDDING.design(SHEDDING.params.read({}))),
    "warps": lambda: warps_tree(WARPS.design(WARPS.params.read({}))),
}


@cache
def tree_of(name: str) -> Tree:
    return TREES[name]()


@pytest.mark.parametrize("name", TREES)
def test_a_datum_has_no_position_to_itself(name: str) -> None:
    """Nor has a bore one to what is bored in one line with it."""
    for features in tolerances_of(tree_of(name)).values():
        for own in features:
            position = [one for one in own.geometric if one.characteristic is Characteristic.POSITION]
            for datum in (one for limit in position for one in features if one.datum in limit.datums):
                away = own.position.origin - datum.position.origin
                assert np.linalg.norm(np.cross(away, datum.position.rotation[:, 2])) > 1 * um, own.part
                assert own.datum != datum.datum


@pytest.mark.parametrize("name", TREES)
def test_what_is_bonded_on_a_motor_does_not_run_on_it(name: str) -> None:
    motors = {part.id for part, _ in tree_of(name).occurrences() if part.purchase and part.purchase.drives}
    features = [one for own in tolerances_of(tree_of(name)).values() for one in own]
    on_motors = [one for one in features if motors & {*one.mates}]
    assert not [one.part for one in on_motors if one.duty is FitDuty.RUNNING]
    assert len(on_motors) >= 2 * (name == "head")


def test_a_freewheel_runs_on_a_hard_shaft() -> None:
    (check,) = (one for one in making_checks(tree_of("head")) if "HF0406" in one.name)
    assert check.ok
    assert check.limit == 58


@pytest.mark.parametrize("name", TREES)
def test_shafts_on_bearings_are_held_along_their_axis(name: str) -> None:
    """By grub screws of inserts, by what the bearing states, or by what its rings lie against, to both sides."""
    shafts, bodies = 0, {body.id: body for body in tree_of(name).bodies}
    in_bodies = [(body, own) for body in bodies.values() for own in body.occurrences]
    for meeting in meetings(tree_of(name)):
        bearing, own = meeting.bore.part, {one.part.id for one in bodies[meeting.body].occurrences}
        if bearing.process == "bearing" and meeting.inner.part.id in own and bearing.id not in own:
            assert bearing.purchase is not None
            shafts += 1
            held = "grub screws" in bearing.purchase.data or bearing.fixing or bearing.purchase.hardness
            stops = (_stops(body, own) for body, own in in_bodies if own.part.id == bearing.id)
            assert held or {-1, 1} in stops, bearing.id
    assert shafts


def _stops(body: RigidBody, bearings: Occurrence) -> set[int]:
    """Senses along the axis in which one of some bearings meets more of its body when it moves by 0.3 mm."""
    return {
        sense
        for sense in (-1, 1)
        for lies in bearings.positions
        if _common(body, bearings, sense * 0.3 * mm, lies) > _common(body, bearings, 0.0, lies) + 0.5
    }


def _common(body: RigidBody, roller: Occurrence, aside: float, lies: Placement | None = None) -> float:
    """Volume [mm³] that a roller of a body, moved along its pin [m], has in common with the others of it.

    lies  its position, of several
    """
    lies = lies or roller.positions[0]
    back, solid, whole = lies.after(placement(z=aside)).inverse, collider(roller.part.shape).manifold(), 0.0
    for own in (own for own in body.occurrences if own is not roller):
        for each in map(back.after, own.positions):
            moved = collider(own.part.shape).manifold().transform(np.column_stack([each.rotation, each.origin]))
            whole += (solid ^ moved).volume() / mm**3
    return whole


def test_rollers_have_play_along_their_pins_and_no_more() -> None:
    """Moved by 0.1 mm to both sides they meet nothing more of their body, by 0.4 mm they do."""
    bodies = [(body, own) for body in tree_of("head").bodies for own in body.occurrences if own.turning]
    assert len(bodies) == 8
    for body, roller in bodies:
        rest = _common(body, roller, 0.0)
        for sense in (-1, 1):
            assert _common(body, roller, sense * 0.1 * mm) < rest + 0.05, roller.part.id
            assert _common(body, roller, sense * 0.4 * mm) > rest + 0.5, roller.part.id


def test_the_head_is_one_without_parts_through_each_other() -> None:
    whole = contacts(tree_of("head"))
    assert len(whole.groups) == 1
    assert not whole.through


def test_a_roller_is_ground_and_true_to_its_bore() -> None:
    features = tolerances_of(tree_of("head"))["weaver/cam-roller"]
    (outside,) = (one for one in features if one.duty is FitDuty.ROLLING)
    assert (outside.tolerance, outside.roughness) == ("h6", pytest.approx(0.4 * um))
    (run_out,) = outside.geometric
    assert run_out.characteristic is Characteristic.RUN_OUT
    assert run_out.datums == ("A",)
    assert run_out.value < 10 * um


def test_squares_are_as_rough_as_a_laser_cuts_them() -> None:
    features = tolerances_of(tree_of("shedding"))["shedding/guide-cam"]
    assert {(one.tolerance, round(one.roughness / um, 6)) for one in features} == {("H12", 12.5)}
