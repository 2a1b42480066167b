"""Back rest and tension compensator in space: behind the cam shafts, on the level run of the warps."""

import numpy as np

from ilmek.machines.automated_loom.cyclogram import EVEN as EVEN_WARPS
from ilmek.machines.automated_loom.cyclogram import ODD as ODD_WARPS
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.maker import ROW, MachineTree, track_angles
from ilmek.machines.tension_compensator.analysis import lever_rotations
from ilmek.machines.tension_compensator.tree import EVEN, ODD, lever_motion, tree
from ilmek.part.placement import Placement
from ilmek.report.scene import SceneMotion
from ilmek.timing.track import sample

COMPENSATOR = "tension-compensator"

_BEHIND = np.array([[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
"""Axes of a compensator on warps that run level to the back: its x up, its y to the back."""


def compensator(loom: LoomDesign) -> tuple[MachineTree, ...]:
    """The compensator, on the ground; nothing where the loom has none."""
    machine = loom.machines.get(COMPENSATOR)
    if machine is None:
        return ()
    return (MachineTree(COMPENSATOR, tree(machine.design, _motions(loom)), compensator_position(loom)),)


def compensator_position(loom: LoomDesign) -> Placement:
    """Where the middle of the compensator lies: in the middle of the room that the side view keeps for it."""
    room = loom.side.compensator
    middle = room.corner + room.size / 2
    return Placement(np.array([0.0, middle.imag, middle.real]), _BEHIND)


def _motions(loom: LoomDesign) -> dict[str, SceneMotion]:
    """The motions of the levers over a row: in equilibrium with the warps that the cams lift."""
    row, design = loom.row_cyclogram, loom.machines[COMPENSATOR].design
    tracks = row.track(EVEN_WARPS), row.track(ODD_WARPS)
    angle = track_angles(*tracks)
    shares = (sample(track, angle).position / loom.row_timing.lift for track in tracks)
    rotations = lever_rotations(design, *(share * design.params.lift for share in shares))
    return {parity: lever_motion(ROW, angle, rotation) for parity, rotation in zip((EVEN, ODD), rotations, strict=True)}
