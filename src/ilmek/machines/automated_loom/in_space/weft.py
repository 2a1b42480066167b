"""What lays the wefts, in space: shuttles with their carriage, or the rapier; and the wefts that they draw."""

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.automated_loom.cyclogram import BEATER, weft_windows
from ilmek.machines.automated_loom.in_space.maker import ROW, SceneGroup, SceneMaker, motion, track_angles
from ilmek.machines.automated_loom.in_space.standing import GROUND
from ilmek.machines.weft import Shuttle
from ilmek.machines.weft.rapier import Rapier
from ilmek.plane.solids import box, prism
from ilmek.report.scene import SceneFrame, ScenePart, SceneYarn, Solid
from ilmek.timing.track import sample
from ilmek.units import mm, turn

CARRIER = "carrier of the weft"
CARRIAGE_DEPTH = 40 * mm
"""Room that is drawn for the carriage of the shuttles in front of the warps; assumed by this project."""


def weft(made: SceneMaker) -> SceneGroup:
    """The carrier with its frames."""
    carried = made.loom.weft.carried
    return _shuttles(made, carried) if isinstance(carried, Shuttle) else _rapier(made, carried)


def _middle(made: SceneMaker) -> tuple[float, float]:
    """Height and depth of the carrier's middle in the shed [m]."""
    at = made.loom.side.carrier.corner + made.loom.side.carrier.size / 2
    return at.imag, at.real


def _position(made: SceneMaker) -> tuple[FloatArray, FloatArray]:
    """Angles of the row [rad], and the carrier's position on its axis [m]."""
    track = made.loom.row_cyclogram.track(made.loom.row_timing.carrier)
    angle = track_angles(track)
    return angle, sample(track, angle).position


def _shuttles(made: SceneMaker, one: Shuttle) -> SceneGroup:
    """The shuttle of the straight weft goes to the right and waits there, that of the sinuous weft comes from there."""
    angle, at = _position(made)
    stroke, row = made.loom.weft.passage.stroke, made.loom.row_cyclogram
    height, depth = _middle(made)
    half = angle < turn / 2
    origins = np.array([[-stroke / 2, height, depth]])
    runs = {
        "shuttle of the straight weft": np.where(half, at, stroke),
        "shuttle of the sinuous weft": np.where(half, stroke, at),
        "carriage of the shuttle": at,
    }
    frames = tuple(
        SceneFrame(name, origins, GROUND, motion(row, angle, shift=sense[:, None] * np.array([1.0, 0.0, 0.0])))
        for name, sense in runs.items()
    )
    checks = ("weft: opening", "weft: force on", "weft: lifted", "weft: room")
    parts: list[ScenePart] = [
        made.part(name, name, _shuttle(one), machine="weft", line="shuttle", checks=checks) for name in list(runs)[:2]
    ]
    front = one.depth / 2 + made.loom.side.room.clearance + made.loom.task.yarns.warp.diameter
    reach = made.loom.side.lift
    low, high = (
        (-one.length / 4, -one.width / 2, front + reach),
        (one.length / 4, one.width / 2, front + reach + CARRIAGE_DEPTH),
    )
    parts.append(
        made.part(
            "carriage of the shuttle",
            "carriage of the shuttle",
            box(low, high),
            machine="weft",
            checks=checks,
            envelope=True,
        )
    )
    return SceneGroup(frames, tuple(parts))


def _shuttle(one: Shuttle) -> Solid:
    """The shuttle's outside: its bay, and noses that narrow to an edge; the room of the bobbin is not cut."""
    bay = one.bobbin.length
    nose = (one.length - bay) / 2
    middle, tip, half = one.length / 2 - nose, one.length / 2, one.depth / 2
    plan = np.array(
        [-tip + 0j, -middle - 1j * half, middle - 1j * half, tip + 0j, middle + 1j * half, -middle + 1j * half]
    )
    lying = prism(plan, -one.width / 2, one.width / 2)
    return Solid(lying.points[:, [2, 0, 1]], lying.triangles)


def _rapier(made: SceneMaker, one: Rapier) -> SceneGroup:
    """The rapier from the left; its tip rests before the cloth."""
    angle, at = _position(made)
    height, depth = _middle(made)
    origins = np.array([[-made.half - made.loom.weft.passage.run, height, depth]])
    shift = at[:, None] * np.array([1.0, 0.0, 0.0])
    frame = SceneFrame(CARRIER, origins, GROUND, motion(made.loom.row_cyclogram, angle, shift=shift))
    tall, wide, wall = one.tube
    outer = np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j]) / 2

    def section(width: float, height: float) -> np.ndarray:
        return np.asarray(outer.real * width + 1j * outer.imag * height)

    hollow = prism(section(wide, tall), -one.length, -one.gripper, (section(wide - 2 * wall, tall - 2 * wall),))
    jaw = one.gripper / 2
    gripper = box((-one.gripper, -jaw, -jaw), (0.0, jaw, jaw))
    checks = ("weft: sag", "weft: safety", "weft: opening")
    parts = (
        made.part("rapier", CARRIER, hollow, machine="weft", checks=checks),
        made.part("gripper of the rapier", CARRIER, gripper, machine="weft", checks=("weft: pull",), envelope=True),
    )
    return SceneGroup((frame,), parts)


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
