"""Coordinates of bodies, closures of loops, degrees of freedom."""

import math
from dataclasses import replace

import numpy as np
import pytest

from ilmek.elements.materials import MATERIALS
from ilmek.errors import ParameterError
from ilmek.part.mobility import TreeMobility, coordinates
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.shapes import box
from ilmek.part.tree import Closure, Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.report.scene import SceneMotion
from ilmek.units import turn

_PART = Part("bar", "bar", "bar", box(0.1, 0.1, 0.1), MATERIALS["structural steel"])
_ANGLE = np.linspace(0.0, turn, 25)
_STILL = np.zeros(25)


def _body(name: str, parent: str, kind: JointKind, x: float = 0.0, motion: SceneMotion | None = None) -> RigidBody:
    return RigidBody(name, (Occurrence(_PART),), parent, Joint(kind, motion=motion), (placement(x),))


def _four_bar(*closures: Closure) -> Tree:
    """A crank at 0, a coupler at its end, a rocker at 3, open but for the closures."""
    crank, coupler = _body("crank", "", JointKind.PIN), _body("coupler", "crank", JointKind.PIN, 1.0)
    coupler = replace(coupler, positions=(placement(1.0, 0.5),))
    return Tree((crank, coupler, _body("rocker", "", JointKind.PIN, 3.0)), closures)


def test_a_pin_that_closes_a_loop_leaves_one_of_three_coordinates() -> None:
    assert TreeMobility(_four_bar()).degrees_of_freedom == 3
    closed = TreeMobility(_four_bar(Closure(JointKind.PIN, ("coupler", "rocker"), placement(2.0, 1.0))))
    assert closed.degrees_of_freedom == 1
    assert [closed.coordinates[number][0][-1].name for number in closed.driven] == ["crank"]


def test_a_second_pin_locks_the_linkage_and_a_ratio_takes_a_coordinate() -> None:
    pins = (Closure(JointKind.PIN, ("coupler", "rocker"), placement(2.0, y)) for y in (1.0, 2.0))
    assert TreeMobility(_four_bar(*pins)).degrees_of_freedom == 0
    assert TreeMobility(_four_bar(Closure(JointKind.ROLLING, ("crank", "rocker"), ratio=-2.0))).degrees_of_freedom == 2
    assert TreeMobility(_four_bar(Closure(JointKind.FIXED, ("crank", "rocker")))).degrees_of_freedom == 1


def test_cranks_on_one_shaft_move_as_one() -> None:
    crank = replace(_body("crank", "", JointKind.PIN), positions=(placement(), placement(z=1.0), placement(z=2.0)))
    assert TreeMobility(Tree((crank,))).degrees_of_freedom == 3
    assert TreeMobility(Tree((crank,), (Closure(JointKind.ROLLING, ("crank", "crank")),))).degrees_of_freedom == 1


@pytest.mark.parametrize("pivot", [(0.0, 0.0), (0.12, 0.0), (-0.3, 0.4)])
def test_a_body_that_turns_about_a_point_has_one_coordinate(pivot: tuple[float, float]) -> None:
    point, turned = complex(*pivot), 0.3 * np.sin(_ANGLE)
    shift = point - point * np.exp(1j * turned)
    motion = SceneMotion("turn", _ANGLE, np.stack([shift.real, shift.imag, _STILL], axis=1), turned)
    (only,) = coordinates(_body("rod", "", JointKind.PIN, motion=motion))
    assert only.turns
    assert only.point == pytest.approx((*pivot, 0.0), abs=1e-12)
    assert only.at("turn", math.pi / 2) == pytest.approx(0.3)
    assert only.at("other", math.pi / 2) == 0.0


def test_a_body_that_slides_on_a_line_has_one_coordinate_and_across_it_two() -> None:
    line = np.outer(np.sin(_ANGLE), [0.0, 0.6, -0.8])
    (only,) = coordinates(_body("rail", "", JointKind.SLIDE, motion=SceneMotion("row", _ANGLE, line, _STILL)))
    assert (only.turns, only.axis) == (False, pytest.approx((0.0, -0.6, 0.8)))
    assert only.at("row", math.pi / 2) == pytest.approx(-1.0)
    bent = np.stack([np.sin(_ANGLE), np.cos(_ANGLE) - 1, _STILL], axis=1)
    both = coordinates(_body("shuttle", "", JointKind.SLIDE, motion=SceneMotion("row", _ANGLE, bent, _STILL)))
    assert [one.axis for one in both] == [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0)]


def test_a_screw_turns_and_slides_and_what_is_fixed_does_neither() -> None:
    assert [one.turns for one in coordinates(_body("nut", "", JointKind.SCREW))] == [False, True]
    assert coordinates(_body("stand", "", JointKind.FIXED)) == coordinates(_body("hung", "", JointKind.MISSING)) == ()


def test_closures_of_unknown_bodies_and_of_unequal_numbers_are_errors() -> None:
    with pytest.raises(ParameterError, match="a loop closed at 'tool'; bodies of the tree"):
        _four_bar(Closure(JointKind.PIN, ("coupler", "tool")))
    two, three = (
        replace(_body(name, "", JointKind.PIN), positions=tuple(placement(z=float(k)) for k in range(number)))
        for name, number in (("two", 2), ("three", 3))
    )
    with pytest.raises(ParameterError, match="2 bodies closed with 3; as many, or one with many"):
        TreeMobility(Tree((two, three), (Closure(JointKind.PIN, ("two", "three")),))).driven  # noqa: B018
