"""What beats, in space: the tree of its machine, moved by the cyclogram of a row.

A travelling beater and a comb on crank-rockers turn with their rockers, whose swing from the beat is that of the path:
d = p (1 - e^(-i s)), d the displacement of the tip from the fell, p the pivot in front of it, s the swing.
"""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.linkage.solve import solve
from ilmek.machines.automated_loom.beat_motion import beat_tip, beat_windows
from ilmek.machines.automated_loom.cyclogram import SLIDE
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.maker import MachineTree, along_track
from ilmek.machines.beat import BeatDrive, BeatPath
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.links import PART_IDS
from ilmek.machines.beat_up.tree import CARRIAGE, in_side_view, link_motions, travelling
from ilmek.machines.hammer.tree import COMB
from ilmek.machines.hammer.tree import tree as hammer_tree
from ilmek.part.placement import IN_SIDE_VIEW, Placement
from ilmek.part.tree import Tree
from ilmek.report.scene import SceneMotion
from ilmek.timing.cyclogram import Cyclogram
from ilmek.units import turn

_TABLE = 721


def beating(loom: LoomDesign) -> MachineTree:
    """The machine of the beat, on the ground."""
    return beat_branch(loom.beat, loom.row_cyclogram)


def beat_branch(beat: BeatDrive, row: Cyclogram) -> MachineTree:
    """The tree of a drive of the beat, moved by the beater's track of a cyclogram and by that of its slide, if any."""
    return MachineTree(beat.name, *_placed(beat, row))


def _placed(beat: BeatDrive, row: Cyclogram) -> tuple[Tree, Placement]:
    """The bodies with their motions, and where their axes lie."""
    angle, tip = _beat(beat.path, row)
    if isinstance(beat.design, BeatUp):
        one, cloth = beat.design, beat.task.cloth
        slides = any(track.name == SLIDE for track in row.tracks)
        slide = along_track(row, SLIDE, (0.0, 0.0, 1.0)) if slides else None
        motions = _of_links(one, row.name, angle, tip) | ({CARRIAGE: slide} if slide else {})
        # At angle 0 the beater stands at the left edge of the cloth, or beside it.
        start = (beat.beaten * cloth.warp_pitch - cloth.width) / 2 - beat.beat.park if slide else 0.0
        return travelling(one, beat.use, motions, start), in_side_view(one)
    if beat.design.linkage is None:
        shift = np.stack([tip.real, tip.imag, np.zeros(tip.size)], axis=1)
        return hammer_tree(beat.design, {COMB: SceneMotion(row.name, angle, shift, np.zeros(tip.size))}), IN_SIDE_VIEW
    one = beat.design.linkage.one
    motions = _of_links(one, row.name, angle, tip)
    return hammer_tree(beat.design, motions | {COMB: motions[PART_IDS["rocker"]]}), in_side_view(one)


def _beat(path: BeatPath, row: Cyclogram) -> tuple[FloatArray, ComplexArray]:
    """Angles of a cyclogram [rad], and the tip of what beats from the fell in the side view [m]."""
    inner = [start + path.share * (end - start) for start, end in beat_windows(row)]
    angle = np.unique(np.clip(np.concatenate([[0.0, turn], *inner]), 0.0, turn))
    return angle, beat_tip(path, row, angle)


def _of_links(beat_up: BeatUp, drive: str, angle: FloatArray, tip: ComplexArray) -> dict[str, SceneMotion]:
    """The motions of crank, coupler and rocker by the tip of what beats from the fell [m]."""
    swing = np.maximum(-np.angle(1 - tip / beat_up.lengths["beater"]), 0.0)
    return link_motions(beat_up, drive, angle, crank_angles(beat_up, swing))


def crank_angles(beat_up: BeatUp, swing: FloatArray) -> FloatArray:
    """Angles of the crank [rad] that follow one another for swings of the rocker from the beat [rad].

    While the swing falls the crank is before the beat, while it rises behind it.
    """
    table = beat_up.dead_centres.beta + np.linspace(
        float(beat_up.dead_centres.rotation) - turn, float(beat_up.dead_centres.rotation), _TABLE
    )
    at = np.abs(np.unwrap(solve(beat_up.plan, table).angle("rocker")) - beat_up.rocker_angles[0])
    least = int(np.argmin(at))
    falling = np.gradient(swing) < 0
    before = np.interp(swing, at[: least + 1][::-1], table[: least + 1][::-1])
    after = np.interp(swing, at[least:], table[least:])
    return np.asarray(np.unwrap(np.where(falling, before, after)))
