"""A tree in space: its bodies as frames of a scene, its parts as solids in them.

A frame of a scene has the axes of the scene at rest. The rotation of a body's place is therefore turned into its
solids, its motion and the positions of what it carries.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from ilmek.arrays import Float
from ilmek.errors import ParameterError
from ilmek.part.blanks import size_of
from ilmek.part.part import Part
from ilmek.part.placement import IDENTITY, Placement
from ilmek.part.shapes import CHORD
from ilmek.part.tree import GROUND, Occurrence, RigidBody, Tree
from ilmek.report import Check
from ilmek.report.scene import SceneFrame, SceneMotion, ScenePart, Solid

_SAME = 1e-9
"""Difference of rotation matrices that counts as rounding."""


def frames_of(tree: Tree, parent: str, position: Placement = IDENTITY) -> tuple[SceneFrame, ...]:
    """The frames of the bodies; the tree's ground lies at a place in a frame of the scene, `parent`.

    Raises ParameterError for a body at positions of different rotations: they are bodies of their own.
    """
    turned = rotations(tree, position)
    frames = []
    for body in tree.bodies:
        if body.parent == GROUND:
            origins, carrier = [position.points(own.origin) for own in body.positions], parent
        else:
            origins, carrier = [turned[body.parent] @ position.origin for position in body.positions], body.parent
        axis = turned[body.id] @ np.array(body.joint.axis)
        frames.append(
            SceneFrame(
                name=body.id,
                origins=np.array(origins),
                parent=carrier,
                motion=_turned_motion(body.joint.motion, turned[body.id]),
                axis=(float(axis[0]), float(axis[1]), float(axis[2])),
            )
        )
        frames += (_row(body, occurrence, turned[body.id]) for occurrence in body.occurrences if _alike(occurrence))
    return tuple(frames)


def rotations(tree: Tree, position: Placement) -> Mapping[str, Float[np.ndarray, "3 3"]]:
    """The rotation of each body's frame in the scene, at rest."""
    turned = {GROUND: position.rotation}
    for body in tree.bodies:
        first, *others = (position.rotation for position in body.positions)
        if any(np.abs(other - first).max() > _SAME for other in others):
            raise ParameterError(f"body {body.id!r} at positions of different rotations", do="give each its own body")
        turned[body.id] = turned[body.parent] @ first
    return turned


def _turned_motion(motion: SceneMotion | None, rotation: Float[np.ndarray, "3 3"]) -> SceneMotion | None:
    if motion is None:
        return None
    return SceneMotion(motion.drive, motion.angle, motion.shift @ rotation.T, motion.rotation)


def _alike(occurrence: Occurrence) -> bool:
    """Whether a part is in its body many times, turned about its own z axis only: it then has a frame of its own."""
    first, *others = (position.rotation for position in occurrence.positions)
    return bool(others) and all(np.abs(other[:, 2] - first[:, 2]).max() <= _SAME for other in others)


def _row_name(body: RigidBody, occurrence: Occurrence) -> str:
    return f"{body.id}: {occurrence.part.id}"


def _row(body: RigidBody, occurrence: Occurrence, rotation: Float[np.ndarray, "3 3"]) -> SceneFrame:
    """The frame of a part that is in its body many times: an origin and a phase about the part's z axis for each."""
    first = occurrence.positions[0].rotation
    relative = np.array([first.T @ position.rotation for position in occurrence.positions])
    axis = rotation @ first[:, 2]
    return SceneFrame(
        name=_row_name(body, occurrence),
        origins=np.array([rotation @ position.origin for position in occurrence.positions]),
        parent=body.id,
        phases=np.arctan2(relative[:, 1, 0], relative[:, 0, 0]),
        axis=(float(axis[0]), float(axis[1]), float(axis[2])),
    )


def parts_of(
    tree: Tree,
    machine: str,
    position: Placement = IDENTITY,
    checks: Sequence[Check] = (),
    deviations: tuple[float, ...] = (CHORD,),
) -> tuple[ScenePart, ...]:
    """The parts of a tree that have a shape, in the frames of `frames_of`, each with the checks that concern it.

    machine  that they belong to      position  of the tree's ground, as in `frames_of`
    deviations  of the meshes, from the finest to the coarsest [m]
    """
    turned = rotations(tree, position)
    numbers = {part.id: number for part, number in tree.occurrences()}
    parts = []
    for body in tree.bodies:
        for occurrence in body.occurrences:
            part = occurrence.part
            if part.shape is None:
                continue
            alike = _alike(occurrence)
            positions = [Placement(np.zeros(3), occurrence.positions[0].rotation)] if alike else occurrence.positions
            several = len(_bodies_with(tree, part)) > 1
            parts.append(
                ScenePart(
                    name=f"{part.id} of {body.id}" if several else part.id,
                    title=_title(part, body, several=several),
                    machine=machine,
                    frame=_row_name(body, occurrence) if alike else body.id,
                    solids=tuple(
                        _placed(part.shape.mesh(deviation), positions, turned[body.id]) for deviation in deviations
                    ),
                    deviations=deviations,
                    material=part.material.name if part.material else "",
                    mass=part.mass,
                    number=numbers[part.id],
                    checks=tuple(check for check in checks if part.id in check.parts),
                    envelope=part.envelope,
                    copies=len(positions),
                    ids=(part.id, body.id),
                )
            )
    return tuple(parts)


def _title(part: Part, body: RigidBody, *, several: bool) -> str:
    """Title and size of a part; of one that is in several bodies, that of its body too."""
    named = f"{part.title} ({body.id.rpartition('/')[2]})" if several else part.title
    size = part.size if part.purchase else size_of(part)
    return f"{named}, {size}" if size else named


def _bodies_with(tree: Tree, part: Part) -> list[str]:
    return [body.id for body in tree.bodies if any(occurrence.part is part for occurrence in body.occurrences)]


def _placed(mesh: Solid, positions: Sequence[Placement], rotation: Float[np.ndarray, "3 3"]) -> Solid:
    """The mesh at all positions of its body, whose axes are turned."""
    begins = np.arange(len(positions)) * len(mesh.points)
    return Solid(
        np.concatenate([position.points(mesh.points) for position in positions]) @ rotation.T,
        np.concatenate([mesh.triangles + begin for begin in begins]),
    )
