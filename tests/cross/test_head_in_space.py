"""A head over a knot, by booleans of its parts' meshes: none is through another, each is driven, all are one machine.

Volumes by `manifold3d`; poses of the bodies by their joints.
"""

from functools import cache
from itertools import combinations, pairwise
from typing import Any

import numpy as np
import pytest
from manifold3d import Manifold, Mesh

from ilmek.arrays import Float
from ilmek.machines.automated_loom import MACHINE as LOOM
from ilmek.machines.automated_loom.in_space.heads import head_alone
from ilmek.machines.weaver import MACHINE, Weaver, WeaverParams
from ilmek.machines.weaver.case import BRACKET, FACE
from ilmek.machines.weaver.followers import follower_id
from ilmek.machines.weaver.knife import EYE
from ilmek.machines.weaver.parts import TUBE, cam_id
from ilmek.machines.weaver.transmissions import CAM_SHAFT
from ilmek.machines.weaver.tree import HEAD, MAGAZINE, head_tree
from ilmek.machines.weaver.yarn_lead import YARN_GUIDE, yarn_line
from ilmek.part.contacts import groups
from ilmek.part.part import Part
from ilmek.part.poses import chains, poses
from ilmek.part.tree import JointKind, Tree
from ilmek.units import mm, turn

ANGLES = np.arange(0.0, turn, turn / 36)
FEW = np.arange(0.0, turn, turn / 12)

VOLUME = 3.0
"""Volume of two meshes in each other that is rounding of pins in bores [mm³]; arms of grippers cross with 2.4 mm³."""

FACETS = 0.04
"""Mean thickness of what two meshes share that is rounding of a long pin in its bore [mm]: that of both meshes."""

HEADS: tuple[dict[str, Any], ...] = ({}, {"opening": 24 * mm}, {"tubes": 5, "sley_stroke": 60 * mm})

LOOMS = (
    {"knotting": "cams"},
    {"knotting": "arms"},
    {"knotting": "cams", "warp_pitch": "1.5 mm"},
    {"knotting": "arms", "knot": "asymmetric", "knots_across": "15/dm"},
)


@cache
def _head(number: int) -> Weaver:
    made: Weaver = MACHINE.design(WeaverParams(**HEADS[number]))
    return made


@cache
def _moving(number: int) -> Tree:
    """The head of a loom, by itself, over a knot."""
    return head_alone(LOOM.design(LOOM.params.read(LOOMS[number])))


class _Piece:
    """A part in a body, at one place."""

    def __init__(self, body: str, part: Part, solid: Manifold, matrices: Float[np.ndarray, "angles 3 4"]) -> None:
        self.body, self.part, self.solid, self.matrices = body, part, solid, matrices

    def at(self, step: int) -> Manifold:
        return self.solid.transform(self.matrices[step])


def _pieces(tree: Tree) -> list[_Piece]:
    solids: dict[str, Manifold] = {}
    pieces = []
    for chain in chains(tree):
        body, posed = chain[-1].body, poses(chain, "knot", FEW)
        for occurrence in body.occurrences:
            assert occurrence.part.shape is not None
            if occurrence.part.id not in solids:
                mesh = occurrence.part.shape.mesh(0.02 * mm)
                points = (mesh.points / mm).astype(np.float32)
                solids[occurrence.part.id] = Manifold(Mesh(points, mesh.triangles.astype(np.uint32)))
            for position in occurrence.positions:
                origin = (posed.origin + posed.rotation @ position.origin) / mm
                matrices = np.concatenate([posed.rotation @ position.rotation, origin[:, :, None]], axis=2)
                pieces.append(_Piece(body.id, occurrence.part, solids[occurrence.part.id], matrices))
    return pieces


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize("number", range(len(LOOMS)))
def test_no_part_of_a_head_is_through_another_over_a_knot(number: int) -> None:
    pieces = _pieces(_moving(number))
    for step in range(len(FEW)):
        posed = [piece.at(step) for piece in pieces]
        boxes = np.array([solid.bounding_box() for solid in posed])
        low, high = boxes[:, :3], boxes[:, 3:]
        for (k, first), (j, other) in combinations(enumerate(pieces), 2):
            if first.body != other.body and (low[k] < high[j]).all() and (low[j] < high[k]).all():
                common = posed[k] ^ posed[j]
                volume = common.volume()
                assert volume < VOLUME or 2 * volume / common.surface_area() < FACETS, (
                    first.part.id,
                    other.part.id,
                    round(np.degrees(FEW[step])),
                    volume,
                )


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize("number", range(len(LOOMS)))
def test_something_moves_every_body_of_a_head_and_something_holds_it(number: int) -> None:
    """Each is held by a joint that is designed, on the head or on a body before it, and has a motion over the knot."""
    bodies = _moving(number).bodies
    plates = {"knotting-dyad/frame"} if LOOMS[number]["knotting"] == "arms" else set()
    assert all(body.joint.kind is not JointKind.MISSING for body in bodies)
    assert {body.id for body in bodies if body.joint.kind is JointKind.FIXED} == plates
    assert {body.id for body in bodies if body.joint.motion is None} == {MAGAZINE, *plates}
    assert {body.id for body in bodies if not body.parent} == {HEAD}


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


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize("number", range(len(LOOMS)))
def test_the_yarn_from_its_tube_to_the_eye_meets_no_part_of_the_head(number: int) -> None:
    """As a thin bar along its line, beside the parts through which it is led."""
    weaver = LOOM.design(LOOM.params.read(LOOMS[number])).weaver
    led, line = {TUBE, YARN_GUIDE, EYE, FACE}, yarn_line(weaver) / mm
    bars = [_bar(begin, end, weaver.params.yarn / mm / 2) for begin, end in pairwise(line)]
    for piece in _pieces(_moving(number)):
        if piece.part.id not in led:
            for step in range(len(FEW)):
                met = sum((piece.at(step) ^ bar).volume() for bar in bars)
                assert met < VOLUME, (piece.part.id, round(np.degrees(FEW[step])), met)


def _bar(begin: Float[np.ndarray, " 3"], end: Float[np.ndarray, " 3"], radius: float) -> Manifold:
    along = end - begin
    length = float(np.linalg.norm(along))
    level = float(np.degrees(np.arccos(along[2] / length)))
    return (
        Manifold.cylinder(length, radius, circular_segments=12)
        .rotate((0.0, level, float(np.degrees(np.arctan2(along[1], along[0])))))
        .translate(tuple(begin.tolist()))
    )
