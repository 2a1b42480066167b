"""The shedding cams in space: a cam for each warp on its square shaft, guide cams or reed beside it."""

import numpy as np

from ilmek.machines.automated_loom.beat_motion import beat_displacement, beat_joints
from ilmek.machines.automated_loom.cyclogram import EVEN, ODD
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.maker import COARSE, COARSEST, FINE, ROW, MachineTree, track_angles
from ilmek.machines.beat import GUIDED
from ilmek.machines.shedding.tree import tree
from ilmek.part.placement import IN_SIDE_VIEW, placement
from ilmek.report.scene import SceneMotion
from ilmek.units import turn


def cams(loom: LoomDesign) -> MachineTree:
    """Shafts, cams, guide cams, spacers and dents of all shafts, with their bearings and drives."""
    positions = [placement(0.0, cam.at.imag, cam.at.real).after(IN_SIDE_VIEW) for cam in loom.side.cams]
    bodies = tree(loom.shedding, positions, _turning(loom), _sinking(loom))
    return MachineTree("shedding", bodies, deviations=(FINE, COARSE, COARSEST))


def _turning(loom: LoomDesign) -> SceneMotion:
    """The cams' angle over the row."""
    row = loom.row_cyclogram
    angle = track_angles(row.track(EVEN), row.track(ODD))
    cam = loom.row_timing.cam_angle(np.minimum(angle, turn * (1 - 1e-15)))
    cam[-1] = turn
    return SceneMotion(ROW, angle, np.zeros((len(angle), 3)), cam)


def _sinking(loom: LoomDesign) -> SceneMotion | None:
    """The stroke of the whole cam system where the comb is carried by the guide cams, in the axes of a shaft."""
    if loom.params.beat != GUIDED:
        return None
    row = loom.row_cyclogram
    angle = np.unique(np.concatenate([[0.0, turn], beat_joints(loom.beat.path, row)]))
    down = beat_displacement(loom.beat.path, row, angle)
    return SceneMotion(ROW, angle, np.stack([down.real, down.imag, np.zeros(len(down))], axis=1), np.zeros(len(angle)))
