"""Drives of the arms: sleeve and shaft in one another, belts by the distances of their axes, servos of the table.

Judges: lengths of uncrossed belts on equal pulleys, 2 a + 2 pi r; the motions of links and shafts; strokes by hand.
"""

from functools import cache

import numpy as np
import pytest

from ilmek.elements.motors import MOTORS
from ilmek.machines.knotting_dyad import MACHINE, KnottingDyad, KnottingDyadParams
from ilmek.machines.knotting_dyad.arm_drives import RADIUS
from ilmek.machines.knotting_dyad.tree import tree
from ilmek.part.tree import JointKind, Tree
from ilmek.units import mm

SETTINGS = ({}, {"cloth.warp_pitch": "6.67mm"}, {"knot": "asymmetric", "cloth.warp_pitch": "2mm"})

every_head = pytest.mark.parametrize("number", range(len(SETTINGS)))


@cache
def _dyad(number: int) -> KnottingDyad:
    made: KnottingDyad = MACHINE.design(KnottingDyadParams.read(SETTINGS[number]))
    return made


def _middle(made: Tree, body: str, part: str) -> np.ndarray:
    """Middles of the places of a part, in its body's axes [m]."""
    (own,) = (
        each for each in made.body(f"knotting-dyad/{body}").occurrences if each.part.id == f"knotting-dyad/{part}"
    )
    return np.array([place.origin for place in own.positions])


@every_head
def test_belts_are_as_long_as_their_axes_are_apart(number: int) -> None:
    dyad, made = _dyad(number), tree(_dyad(number))
    assert dyad.head is not None
    lengths = {part.id: part.purchase.length for part, _ in made.occurrences() if part.purchase and "belt" in part.id}
    arm = 2 * dyad.head.arm.first + 2 * np.pi * RADIUS
    assert lengths["knotting-dyad/elbow-belt"] == pytest.approx(arm)
    pivots = [dyad.head.arm.pivot, 2 * dyad.head.section.middle - dyad.head.arm.pivot.conjugate()]
    for name, servo in (("first", "servo-pulley-1"), ("second", "servo-pulley-2")):
        servos = _middle(made, "frame", servo)[:, :2] @ [1, 1j]
        apart = np.abs(servos - np.array(pivots))
        assert lengths[f"knotting-dyad/{name}-belt"] == pytest.approx(2 * apart.mean() + 2 * np.pi * RADIUS)
        assert np.ptp(apart) < 1e-12


@every_head
def test_a_shaft_turns_as_far_as_the_second_link_that_it_drives(number: int) -> None:
    """The link turns on the first: its own angle and that of the first together are the shaft's, over the cycle."""
    made = tree(_dyad(number))
    for hand in ("", "-*"):
        first, second, shaft = (
            made.body(f"knotting-dyad/{body}{hand}").joint.motion for body in ("link-1", "link-2", "elbow-shaft")
        )
        assert first is not None
        assert second is not None
        assert shaft is not None
        turned = np.unwrap(shaft.rotation) - shaft.rotation[0]
        links = first.rotation + second.rotation
        assert turned == pytest.approx(np.unwrap(links) - links[0], abs=1e-9)
        assert np.ptp(turned) > 0.1
        (belt,) = [one for one in made.closures if one.bodies[1] == f"knotting-dyad/link-2{hand}"]
        assert belt.kind is JointKind.TRANSMISSION
        assert belt.bodies[0] == f"knotting-dyad/elbow-shaft{hand}"


def test_a_belt_that_would_slip_fails_its_check_by_name() -> None:
    def pull(**settings: str) -> tuple[float, float, bool]:
        dyad = MACHINE.design(KnottingDyadParams.read(settings))
        (check,) = [one for one in MACHINE.report(dyad).all_checks if one.name == "pull of a belt of the arms"]
        return float(check.value), float(check.limit or 0.0), check.ok

    usual, limit, ok = pull()
    assert ok
    # 9 N for a tooth and cm of width, 7 teeth in mesh, 4 mm wide
    assert limit == pytest.approx(9.0 * 0.4 * 7)
    heavy, same, holds = pull(elbow_mass="2kg")
    assert (heavy > 10 * usual, same, holds) == (True, limit, False)


def test_servos_are_the_smallest_of_the_table_that_are_enough() -> None:
    (first, *_) = sorted((one for one in MOTORS if one.kind == "servo"), key=lambda one: one.power)
    faces = {
        part.purchase.row: part.shape.mesh().points[:, 0]
        for part, _ in tree(_dyad(0)).occurrences()
        if part.id.endswith("-servo") and part.purchase and part.shape
    }
    assert set(faces) == {first.name}
    assert np.ptp(faces[first.name]) == pytest.approx(25 * mm)
