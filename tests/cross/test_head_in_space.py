"""The tools of a head over a knot, by booleans of their meshes: none is through another, and the head is one machine.

The positions of the tools are those of the tracks, without the scene's poses; volumes by `manifold3d`.
"""

import math
from functools import cache
from itertools import combinations
from typing import Any

import numpy as np
import pytest
from manifold3d import Manifold, Mesh

from ilmek.machines.weaver import MACHINE, Weaver, WeaverParams
from ilmek.machines.weaver.case import BRACKET, FACE
from ilmek.machines.weaver.followers import follower_id
from ilmek.machines.weaver.motions import CENTRE_MOTION, SIDE_MOTION, SLEY
from ilmek.machines.weaver.parts import cam_id
from ilmek.machines.weaver.tool_parts import CENTRE, LEFT, PLATES, RIGHT, SLEY_BODY
from ilmek.machines.weaver.tree import CAM_SHAFT, HEAD, head_tree
from ilmek.part.contacts import groups
from ilmek.part.placement import Placement, placement
from ilmek.part.tree import RigidBody
from ilmek.timing.track import sample
from ilmek.units import mm, turn

ANGLES = np.arange(0.0, turn, turn / 36)
VOLUME = 50 * mm**3

HEADS: tuple[dict[str, Any], ...] = ({}, {"opening": 24 * mm}, {"tubes": 5, "sley_stroke": 60 * mm})


@cache
def _head(number: int) -> Weaver:
    made: Weaver = MACHINE.design(WeaverParams(**HEADS[number]))
    return made


def _solid(body: RigidBody, names: tuple[str, ...] = ()) -> Manifold:
    """All parts of a body, or those of some names, in the body's frame."""
    solids = []
    for occurrence in body.occurrences:
        if occurrence.part.shape is None or (names and occurrence.part.id not in names):
            continue
        mesh = occurrence.part.shape.mesh(0.02 * mm)
        for position in occurrence.positions:
            points = position.points(mesh.points)
            solids.append(Manifold(Mesh(points.astype(np.float32), mesh.triangles.astype(np.uint32))))
    return sum(solids[1:], solids[0])


def _at(solid: Manifold, position: Placement) -> Manifold:
    return solid.transform(np.column_stack([position.rotation, position.origin]))


@pytest.mark.parametrize("number", range(len(HEADS)))
def test_no_tool_is_through_another_or_through_the_face(number: int) -> None:
    made = _head(number)
    tree = head_tree(made)
    by = made.grippers
    names = (LEFT, RIGHT, CENTRE, PLATES, SLEY_BODY)
    bodies = {name: tree.body(name) for name in names}
    solids = {name: _solid(body) for name, body in bodies.items()}
    face = _solid(tree.body(HEAD), (FACE,))
    side, centre, sley = (
        sample(made.cyclogram.track(name), ANGLES).position for name in (SIDE_MOTION, CENTRE_MOTION, SLEY)
    )
    for step in range(len(ANGLES)):
        turned = float(by.turned(side)[step])
        moved = {
            LEFT: placement(z=-side[step], about=(0.0, 0.0, 1.0), angle=-turned),
            RIGHT: placement(z=-side[step], about=(0.0, 0.0, 1.0), angle=turned),
            CENTRE: placement(z=-centre[step]),
            PLATES: placement(z=-min(side[step], by.opening)),
            SLEY_BODY: placement(y=-sley[step]),
        }
        posed = {name: _at(solids[name], bodies[name].positions[0].after(moved[name])) for name in names}
        for first, other in combinations(names, 2):
            assert (posed[first] ^ posed[other]).volume() < VOLUME, (first, other, math.degrees(ANGLES[step]))
        for name in names:
            assert (posed[name] ^ face).volume() < VOLUME, (name, math.degrees(ANGLES[step]))


@pytest.mark.parametrize("number", range(len(HEADS)))
def test_each_roller_rides_on_its_cam_over_the_turn(number: int) -> None:
    """By the outline of the plate, turned, and the axis of the roller, lifted: a radius apart within 0.03 mm."""
    made = _head(number)
    tree = head_tree(made)
    (shaft,) = tree.body(CAM_SHAFT).positions
    plates = {one.part.id: one.part.shape for one in tree.body(CAM_SHAFT).occurrences}
    for cam in made.cams:
        (at,) = tree.body(follower_id(cam.name)).positions
        axis = shaft.inverse.points(at.origin)
        outline = plates[cam_id(cam.name)].section.outline.points  # type: ignore[union-attr]
        points = np.interp(np.arange(0, len(outline), 0.05), np.arange(len(outline) + 1), [*outline, outline[0]])
        lift = np.interp(ANGLES, cam.angle, cam.motion.s) - cam.motion.s[0]
        centre = complex(axis[0], axis[1]) * (1 + lift / abs(complex(axis[0], axis[1]))) * np.exp(-1j * ANGLES)
        gap = np.abs(points - centre[:, None]).min(axis=1) - made.params.roller_radius
        assert np.abs(gap).max() < 0.03 * mm, cam.name


@pytest.mark.parametrize("number", range(len(HEADS)))
def test_every_part_of_a_head_touches_the_others(number: int) -> None:
    """One group; the motor of the carriage, under the rail's axis, is no part of what the carriage moves."""
    (group,) = groups(head_tree(_head(number)))
    assert {FACE, BRACKET} <= set(group.parts)
