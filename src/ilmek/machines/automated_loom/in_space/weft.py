"""What lays the wefts, in space: the bodies of its tree where the carrier runs, and the wefts that it draws."""

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.automated_loom.cyclogram import BEATER, weft_windows
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.maker import ROW, STANDS, MachineTree, half_width, motion, track_angles
from ilmek.machines.weft import Shuttle
from ilmek.machines.weft.rapier_tree import RAPIER_BODY
from ilmek.machines.weft.tree import DRAGGING, RIGHT_BOX, SINUOUS, STRAIGHT
from ilmek.part.placement import placement
from ilmek.report.scene import SceneYarn
from ilmek.timing.track import sample
from ilmek.units import turn


def weft(loom: LoomDesign) -> MachineTree:
    """The bodies of the weft side over a row.

    The shuttle of the straight weft goes to the right and waits there, that of the sinuous weft comes from there.
    """
    angle, at = _position(loom)
    stroke, half = loom.weft.passage.stroke, angle < turn / 2
    across, up, row = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), loom.row_cyclogram
    runs = {DRAGGING: at[:, None] * across, RAPIER_BODY: at[:, None] * across}
    if isinstance(loom.weft.carried, Shuttle):
        low = _shifted(loom, angle)[:, None] * up
        kept = np.minimum.accumulate(low)
        runs |= {
            STRAIGHT: np.where(half, at, stroke)[:, None] * across + low,
            SINUOUS: np.where(half, 0.0, at - stroke)[:, None] * across + kept,
            RIGHT_BOX: low,
        }
    motions = {name: motion(row, angle, shift=shift) for name, shift in runs.items()}
    return MachineTree("weft", loom.weft.bodies.tree.moving(motions), placement(0.0, *_middle(loom)))


def _shifted(loom: LoomDesign, angle: FloatArray) -> FloatArray:
    """Shift of the right box [m]: its upper cell comes in line between the passages, and leaves after the second.

    Both shuttles are in it while it shifts; the sinuous weft's has left it when it shifts back.
    """
    (_, first), (second, last) = weft_windows(loom.row_cyclogram)
    share = np.interp(angle, [first, second, last, turn], [0.0, 1.0, 1.0, 0.0])
    return np.asarray(-share * loom.weft.bodies.guide.pitch)


def _middle(loom: LoomDesign) -> tuple[float, float]:
    """Height and depth of the carrier's middle in the shed [m]."""
    at = loom.side.carrier.corner + loom.side.carrier.size / 2
    return float(at.imag), float(at.real)


def _position(loom: LoomDesign) -> tuple[FloatArray, FloatArray]:
    """Angles of the row [rad], and the carrier's position on its axis [m]."""
    row = loom.row_cyclogram
    track = row.track(loom.row_timing.carrier)
    angle = track_angles(track)
    angle = np.unique(np.concatenate([angle, np.ravel(weft_windows(row))]))
    return angle, sample(track, angle).position


def wefts(loom: LoomDesign) -> tuple[SceneYarn, ...]:
    """Both wefts over a row: from the edge to the carrier, then across, and beaten to the fell."""
    row = loom.row_cyclogram
    carrier = row.track(loom.row_timing.carrier)
    angle = np.unique(np.concatenate([track_angles(carrier), [segment.end for segment in row.track(BEATER).segments]]))
    at = sample(carrier, angle).position
    shuttle = isinstance(loom.weft.carried, Shuttle)
    run = (loom.weft.passage.stroke - loom.task.cloth.width) / 2 if shuttle else loom.weft.passage.run
    reached = np.clip(at - run, 0.0, loom.task.cloth.width) - half_width(loom)
    height, depth = _middle(loom)
    beats = [part.end for part in row.track(BEATER).segments[::2]]
    names = ("straight weft", "sinuous weft")
    yarns = []
    for number, ((start, end), beaten) in enumerate(zip(weft_windows(row), beats, strict=True)):
        edge = half_width(loom) if number and shuttle else -half_width(loom)
        tip = np.where(angle <= start, edge, np.where(angle < end, reached, -edge if shuttle else half_width(loom)))
        down = angle >= beaten
        points = np.zeros((len(angle), 2, 3))
        points[:, 0, 0], points[:, 1, 0] = edge, tip
        points[:, :, 1] = np.where(down, 0.0, height)[:, None]
        points[:, :, 2] = np.where(down, 0.0, depth)[:, None]
        yarn = loom.task.yarns.straight_weft if number == 0 else loom.task.yarns.sinuous_weft
        yarns.append(SceneYarn(names[number], names[number], STANDS, ROW, angle, points, yarn.diameter))
    return tuple(yarns)
