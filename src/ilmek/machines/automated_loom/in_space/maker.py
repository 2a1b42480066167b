"""The branches of a loom's tree, and the motions of its bodies by the tracks of its cyclograms."""

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.part.placement import IDENTITY, Placement
from ilmek.part.shapes import CHORD
from ilmek.part.tree import GROUND, Tree
from ilmek.records import record
from ilmek.report.scene import SceneMotion, ScenePart, Solid
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import Track, laid, sample
from ilmek.units import mm, turn

ROW, KNOT = "row", "knot"
STANDS = "ground"
"""Name of the scene's frame that stands."""

FINE, COARSE, COARSEST = 0.05 * mm, 1 * mm, 4 * mm
"""Deviations of the outlines of a plate's solids [m]."""

_STEPS = 24
"""Samples of each motion of a track."""


@record
class MachineTree:
    """The tree of a machine of the loom, and where its ground lies.

    parent      id of the body that carries it      position    in that body's frame
    deviations  of its meshes on a screen, from the finest to the coarsest [m]
    """

    machine: str
    tree: Tree
    position: Placement = IDENTITY
    parent: str = GROUND
    deviations: tuple[float, ...] = (CHORD,)


def half_width(loom: LoomDesign) -> float:
    """Half of the cloth's width [m]."""
    return loom.task.cloth.width / 2


def room_part(name: str, frame: str, solid: Solid, machine: str) -> ScenePart:
    """A room that the design keeps for what is in no list of parts."""
    return ScenePart(
        name=name, title=name, machine=machine, frame=frame, solids=(solid,), deviations=(0.0,), envelope=True, number=0
    )


def track_angles(*tracks: Track) -> FloatArray:
    """Angles at which tracks are sampled [rad]: both ends of the turn, and each of their motions in even parts."""
    spans = [
        np.linspace(max(segment.start, 0.0), min(segment.end, turn), _STEPS + 1)
        for track in tracks
        for segment in laid(track)
    ]
    return np.unique(np.concatenate([[0.0, turn], *spans]))


def along_track(cyclogram: Cyclogram, name: str, direction: tuple[float, float, float]) -> SceneMotion:
    """A motion along a direction (x, y, z) by a track."""
    track = cyclogram.track(name)
    angle = track_angles(track)
    return motion(cyclogram, angle, shift=np.outer(sample(track, angle).position, direction))


def motion(
    cyclogram: Cyclogram,
    angle: FloatArray,
    *,
    shift: Float[np.ndarray, "samples 3"] | None = None,
    rotation: FloatArray | None = None,
) -> SceneMotion:
    """A motion over the angle of a cyclogram, whose name is that of the scene's drive."""
    still = np.zeros(len(angle))
    return SceneMotion(
        cyclogram.name,
        angle,
        np.zeros((len(angle), 3)) if shift is None else shift,
        still if rotation is None else rotation,
    )
