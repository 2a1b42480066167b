"""What lays the wefts, in space: the bodies of its tree where the carrier runs, and the wefts that it draws."""

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.automated_loom.cyclogram import BEATER, weft_windows
from ilmek.machines.automated_loom.in_space.maker import ROW, SceneGroup, SceneMaker, motion, track_angles
from ilmek.machines.automated_loom.in_space.standing import GROUND
from ilmek.machines.weft import Shuttle
from ilmek.machines.weft.tree import DRAGGING, RAPIER_BODY, RIGHT_BOX, SINUOUS, STRAIGHT
from ilmek.part.placement import placement
from ilmek.part.space import frames_of, parts_of
from ilmek.report.scene import SceneYarn
from ilmek.timing.track import sample
from ilmek.units import turn


def weft(made: SceneMaker) -> SceneGroup:
    """The bodies of the weft side over a row.

    The shuttle of the straight weft goes to the right and waits there, that of the sinuous weft comes from there.
    """
    angle, at = _position(made)
    stroke, half = made.loom.weft.passage.stroke, angle < turn / 2
    across, up, row = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), made.loom.row_cyclogram
    runs = {DRAGGING: at[:, None] * across, RAPIER_BODY: at[:, None] * across}
    if isinstance(made.loom.weft.carried, Shuttle):
        low = _shifted(made, angle)[:, None] * up
        kept = np.minimum.accumulate(low)
        runs |= {
            STRAIGHT: np.where(half, at, stroke)[:, None] * across + low,
            SINUOUS: np.where(half, 0.0, at - stroke)[:, None] * across + kept,
            RIGHT_BOX: low,
        }
    motions = {name: motion(row, angle, shift=shift) for name, shift in runs.items()}
    bodies = made.loom.weft.bodies.tree.moving(motions)
    position = placement(0.0, *_middle(made))
    return SceneGroup(frames_of(bodies, GROUND, position), parts_of(bodies, "weft", position, made.checks))


def _shifted(made: SceneMaker, angle: FloatArray) -> FloatArray:
    """Shift of the right box [m]: its upper cell comes in line between the passages, and leaves after the second.

    Both shuttles are in it while it shifts; the sinuous weft's has left it when it shifts back.
    """
    (_, first), (second, last) = weft_windows(made.loom.row_cyclogram)
    share = np.interp(angle, [first, second, last, turn], [0.0, 1.0, 1.0, 0.0])
    return np.asarray(-share * made.loom.weft.bodies.guide.pitch)


def _middle(made: SceneMaker) -> tuple[float, float]:
    """Height and depth of the carrier's middle in the shed [m]."""
    at = made.loom.side.carrier.corner + made.loom.side.carrier.size / 2
    return float(at.imag), float(at.real)


def _position(made: SceneMaker) -> tuple[FloatArray, FloatArray]:
    """Angles of the row [rad], and the carrier's position on its axis [m]."""
    row = made.loom.row_cyclogram
    track = row.track(made.loom.row_timing.carrier)
    angle = track_angles(track)
    angle = np.unique(np.concatenate([angle, np.ravel(weft_windows(row))]))
    return angle, sample(track, angle).position


def wefts(made: SceneMaker) -> tuple[SceneYarn, ...]:
    """Both wefts over a row: from the edge to the carrier, then across, and beaten to the fell."""
    loom, row = made.loom, made.loom.row_cyclogram
    carrier = row.track(loom.row_timing.carrier)
    angle = np.unique(np.concatenate([track_angles(carrier), [one.end for one in row.track(BEATER).segments]]))
    at = sample(carrier, angle).position
    shuttle = isinstance(loom.weft.carried, Shuttle)
    run = (loom.weft.passage.stroke - loom.task.cloth_width) / 2 if shuttle else loom.weft.passage.run
    reached = np.clip(at - run, 0.0, loom.task.cloth_width) - made.half
    height, depth = _middle(made)
    beats = [part.end for part in row.track(BEATER).segments[::2]]
    names = ("straight weft", "sinuous weft")
    yarns = []
    for number, ((start, end), beaten) in enumerate(zip(weft_windows(row), beats, strict=True)):
        edge = made.half if number and shuttle else -made.half
        tip = np.where(angle <= start, edge, np.where(angle < end, reached, -edge if shuttle else made.half))
        down = angle >= beaten
        points = np.zeros((len(angle), 2, 3))
        points[:, 0, 0], points[:, 1, 0] = edge, tip
        points[:, :, 1] = np.where(down, 0.0, height)[:, None]
        points[:, :, 2] = np.where(down, 0.0, depth)[:, None]
        yarn = loom.task.yarns.straight_weft if number == 0 else loom.task.yarns.sinuous_weft
        yarns.append(SceneYarn(names[number], names[number], GROUND, ROW, angle, points, yarn.diameter))
    return tuple(yarns)
