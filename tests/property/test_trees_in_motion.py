"""Machines in space: at every pose their loops close, their rollers touch their cams, and their needles meet.

The poses are chained here from the positions and motions of the bodies, by complex numbers.
"""

from typing import Any

import numpy as np
import pytest

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.machines.catalogue import MACHINES
from ilmek.part.shapes import Prism, Sum
from ilmek.part.tree import GROUND, Tree

POSES_OF_HAND = "(0mm,0mm,10deg) (25mm,15mm,3deg) (30mm,1mm,-25deg)"


def made(machine: str, **settings: str) -> tuple[Any, Tree]:
    component = MACHINES[machine]
    design = component.designed(component.params.read(settings))
    assert component.tree is not None
    return design, component.tree(design)


def moved(tree: Tree, body: str) -> tuple[ComplexArray, ComplexArray]:
    """Origin [m] and direction of a body's x axis in the plane of the ground, at every pose."""
    if body == GROUND:
        return np.zeros(1, complex), np.ones(1, complex)
    found = tree.body(body)
    (position,), motion = found.positions, found.joint.motion
    at = complex(*position.origin[:2])
    turned = complex(position.rotation[0, 0], position.rotation[1, 0])
    shift: ComplexArray = np.zeros(1, complex)
    rotation: FloatArray = np.zeros(1)
    if motion is not None:
        shift, rotation = motion.shift[:, 0] + 1j * motion.shift[:, 1], motion.rotation
    origin, direction = moved(tree, found.parent)
    return origin + direction * (at + turned * shift), direction * turned * np.exp(1j * rotation)


def seat(tree: Tree, body: str, name: str) -> ComplexArray:
    """A seat of a body's plate in the plane of the ground, at every pose."""
    part = next(one.part for one in tree.body(body).occurrences if name in one.part.seats)
    origin, direction = moved(tree, body)
    return np.asarray(origin + direction * complex(*part.seats[name].position.origin[:2]))


@pytest.mark.parametrize(
    ("machine", "settings", "pin", "bodies"),
    [
        ("function-four-bar", {}, "B", ("coupler", "rocker")),
        ("knotting-four-bar", {"poses": POSES_OF_HAND}, "O2'", ("coupler", "rocker")),
        ("knotting-four-bar", {"poses": POSES_OF_HAND, "sides": "2"}, "O2'", ("coupler-*", "rocker-*")),
        ("tufting", {}, "B", ("coupler", "rocker")),
        ("tufting", {"bars": "2", "phase": "70deg"}, "D", ("arm 2", "rod 2")),
        ("tufting-machine", {"needle.phase": "36deg"}, "B", ("looper-coupler 3", "looper-rocker 3")),
    ],
)
def test_loops_close_at_every_pose(machine: str, settings: dict[str, str], pin: str, bodies: tuple[str, str]) -> None:
    _, tree = made(machine, **settings)
    first, second = (seat(tree, f"{machine}/{body}", pin) for body in bodies)
    assert np.ptp(first.real) + np.ptp(first.imag) > 1e-3
    assert np.abs(first - second).max() < 1e-9


@pytest.mark.parametrize(
    "settings",
    [
        {},
        {"lift": "12mm", "offset": "8mm"},
        {"motion": "oscillating"},
        {"kind": "conjugate"},
        {"kind": "conjugate", "motion": "oscillating"},
    ],
)
def test_rollers_touch_their_cams_at_every_pose(settings: dict[str, str]) -> None:
    """The least distance of a roller's middle from the corners of the cam's outline is its radius."""
    design, tree = made("cam", **settings)
    rollers = next(one for one in tree.body("cam/follower").occurrences if one.part.id == "cam/roller")
    origin, direction = moved(tree, "cam/follower")
    _, turned = moved(tree, "cam/cam")
    for cam, position in zip(tree.body("cam/cam").occurrences, rollers.positions, strict=True):
        assert isinstance(cam.part.shape, Prism)
        middle = (origin + direction * complex(*position.origin[:2])) * np.conj(turned)
        apart = np.abs(middle[:, None] - cam.part.shape.section.outline.points).min(axis=1)
        assert np.abs(apart - design.cam.roller_radius).max() < 2e-5


def test_a_roller_runs_in_its_groove() -> None:
    design, tree = made("cam", kind="grooved")
    (cam,) = tree.body("cam/cam").occurrences
    assert isinstance(cam.part.shape, Sum)
    land, ring = (one.shape for one in cam.part.shape.members[1:])
    assert isinstance(land, Prism)
    assert isinstance(ring, Prism)
    roller = next(one for one in tree.body("cam/follower").occurrences if one.part.id == "cam/roller")
    origin, _ = moved(tree, "cam/follower")
    middle = (origin + complex(*roller.positions[0].origin[:2])) * np.conj(moved(tree, "cam/cam")[1])
    for flank in (land.section.outline, ring.section.holes[0]):
        apart = np.abs(middle[:, None] - flank.points).min(axis=1)
        assert np.abs(apart - design.cam.roller_radius).max() < 2e-5


def test_both_needles_come_to_the_hand_over_and_back() -> None:
    """Tips as the meshes of the blades end: the arms' paths, mirrored in the middle of the pair."""
    design, tree = made("knotting-dyad")
    section, tips = design.head.section, []
    for side in ("", "-*"):
        body = tree.body(f"knotting-dyad/link-2{side}")
        blade = next(one for one in body.occurrences if one.part.id == "knotting-dyad/needle")
        origin, direction = moved(tree, body.id)
        assert blade.part.shape is not None
        (position,) = blade.positions
        tips.append(origin + direction * position.points(blade.part.shape.mesh(1e-5).points)[:, 0].max())
    for tip in tips:
        assert np.abs(tip - section.handover).min() < 2e-4
        assert abs(tip[0] - tip[-1]) < 1e-9
    rest = 2 * section.middle - np.conj(tips[0][0])
    assert abs(rest - tips[1][0]) < 1e-9
