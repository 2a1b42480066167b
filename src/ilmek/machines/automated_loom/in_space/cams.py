"""The shedding cams in space: a plate for each warp on its square shaft, guide cams or reed beside it.

The rule of the outline (`machines.shedding.workshop`): the point at the polar angle a of an outline is under the warp
at the cam angle -a, so that a cam turns by its angle counter-clockwise in the side view, about x by minus it.
"""

from collections.abc import Iterator

import numpy as np

from ilmek.arrays import FloatArray, IntArray
from ilmek.machines.automated_loom.bodies import beat_displacement, beat_joints
from ilmek.machines.automated_loom.cyclogram import EVEN, ODD
from ilmek.machines.automated_loom.in_space.maker import (
    COARSE,
    COARSEST,
    FINE,
    SceneGroup,
    SceneMaker,
    in_side_view,
    motion,
    plate_part,
    track_angles,
)
from ilmek.machines.automated_loom.room import GUIDED
from ilmek.machines.shedding.cam_shaft import CamShaft
from ilmek.machines.shedding.workshop import plates
from ilmek.plane.solids import box
from ilmek.report import Plate
from ilmek.report.scene import SceneFrame, SceneMotion, ScenePart
from ilmek.units import turn

MACHINE = "shedding"


def warp_positions(made: SceneMaker) -> FloatArray:
    """Positions of the warps across [m]."""
    number = made.loom.warps
    return (np.arange(number) + 0.5) * made.loom.params.pitch - made.half


def warp_shafts(made: SceneMaker) -> tuple[IntArray, IntArray]:
    """Number of the shaft of each warp, and whether it is an odd one; the first is (see `shedding.positions.dealt`)."""
    index = np.arange(made.loom.warps)
    return index % len(made.loom.shedding.shafts), (index + 1) % 2


def cams(made: SceneMaker) -> SceneGroup:
    """Shafts, cams, guide cams, spacers and dents of all shafts."""
    frames: list[SceneFrame] = []
    parts: list[ScenePart] = []
    for index in range(len(made.loom.shedding.shafts)):
        found = _of_shaft(made, index)
        frames += found.frames
        parts += found.parts
    return SceneGroup(tuple(frames), tuple(parts))


def shaft_name(index: int) -> str:
    """Name of the frame of a cam shaft."""
    return f"cam shaft {index + 1}"


def _of_shaft(made: SceneMaker, index: int) -> SceneGroup:
    one, name = made.loom.shedding.shafts[index], shaft_name(index)
    axis = made.loom.side.cams[index].at
    still, half, side = f"cam shaft {index + 1}, not turning", made.width / 2, one.shaft.bar / 2
    frames = [
        SceneFrame(still, in_side_view(np.array([axis])), motion=_down(made)),
        SceneFrame(name, np.zeros((1, 3)), still, _turning(made)),
    ]
    bar = box((-half, -side, -side), (half, side, side))
    checks = tuple(f"shedding: {what}" for what in ("slope", "deflection", "twist", "stress of the shaft", "fatigue"))
    parts = [made.part(name, name, bar, machine=MACHINE, line="cam shaft", checks=checks)]
    for plate in _plates_of(made, index):
        frame = _frame_of(made, plate, index, still if plate.name.startswith("reed") else name)
        frames.append(frame)
        parts.append(_cam_part(made, plate, frame.name, one))
    return SceneGroup(tuple(frames), tuple(parts))


def _plates_of(made: SceneMaker, index: int) -> Iterator[Plate]:
    suffix = f"-shaft-{index + 1}"
    for plate in plates(made.loom.shedding):
        if plate.name.endswith(suffix) if index else "-shaft-" not in plate.name:
            yield plate


def _cam_part(made: SceneMaker, plate: Plate, frame: str, one: CamShaft) -> ScenePart:
    stack = one.stack
    kinds = {
        "shedding-cam": (
            stack.cam_mass,
            ("pressure angle", "convex radius", "thickness of a cam", "buckling", "stress at"),
        ),
        "guide-cam": (stack.guide_mass, ("thickness of a guide", "groove", "lateral play", "guides and cams")),
        "reed-dent": (stack.guide_mass, ("thickness of a guide", "lateral play", "guides and cams")),
        "spacer": (stack.spacer_mass, ("cam, guides",)),
    }
    mass, words = next(found for kind, found in kinds.items() if plate.name.startswith(kind))
    checks = made.checked(*(f"shedding: {word}" for word in words))
    return plate_part(
        plate,
        frame,
        -plate.thickness / 2,
        machine=MACHINE,
        mass=mass,
        checks=checks,
        deviations=(FINE, COARSE, COARSEST),
    )


def _frame_of(made: SceneMaker, plate: Plate, index: int, parent: str) -> SceneFrame:
    """Places of the plates of a kind on their shaft."""
    one = made.loom.shedding.shafts[index]
    x, odd = _warps_of(made, index)
    stack, pitch = one.stack, made.loom.params.pitch
    beside = (stack.thickness + stack.guide_thickness) / 2
    lags = np.zeros(len(x))
    if plate.name.startswith("shedding-cam"):
        group, lags = _groups(one, odd)
        chosen = group == _number(plate.name)
        x, odd, lags = x[chosen], odd[chosen], lags[chosen]
    elif plate.name.startswith("guide-cam"):
        sides = (1.0,) if stack.shares.guides == 1 else (-1.0, 1.0)
        x, odd = np.concatenate([x + sense * beside for sense in sides]), np.tile(odd, len(sides))
        lags = np.zeros(len(x))
    elif plate.name.startswith("spacer"):
        x = x + (stack.thickness + plate.thickness) / 2 + stack.shares.guides / 2 * stack.guide_thickness
    else:
        x = np.append(x - pitch / 2, x[-1] + pitch / 2)
        odd = lags = np.zeros(len(x))
    origins = np.zeros((len(x), 3))
    origins[:, 0] = x
    phases = (odd * turn / 2 + lags) if plate.name.startswith("shedding-cam") else np.zeros(len(x))
    return SceneFrame(f"{plate.name} on {shaft_name(index)}", origins, parent, phases=phases)


def _warps_of(made: SceneMaker, index: int) -> tuple[FloatArray, FloatArray]:
    shaft, odd = warp_shafts(made)
    return warp_positions(made)[shaft == index], odd[shaft == index].astype(float)


def _groups(one: CamShaft, odd: FloatArray) -> tuple[IntArray, FloatArray]:
    """Number and lag [rad] of each cam's group: those of a parity are taken in turn along the shaft."""
    order = np.where(odd > 0, np.cumsum(odd) - 1, np.cumsum(1 - odd) - 1).astype(int)
    group = order % one.shed.groups
    return group, np.asarray(one.shed.offsets)[group]


def _number(name: str) -> int:
    """The number of the group in the name of a plate, from 0."""
    last = name.removesuffix(name[name.find("-shaft-") :] if "-shaft-" in name else "").rsplit("-", 1)[-1]
    return int(last) - 1 if last.isdigit() else 0


def _turning(made: SceneMaker) -> SceneMotion:
    row = made.loom.row_cyclogram
    angle = track_angles(row.track(EVEN), row.track(ODD))
    cam = made.loom.row_timing.cam_angle(np.minimum(angle, turn * (1 - 1e-15)))
    cam[-1] = turn
    return motion(row, angle, rotation=-cam)


def _down(made: SceneMaker) -> SceneMotion | None:
    """The stroke of the whole cam system where the comb is carried by the guide cams."""
    if made.loom.params.beat != GUIDED:
        return None
    row = made.loom.row_cyclogram
    angle = np.unique(np.concatenate([[0.0, turn], beat_joints(made.loom.beat.path, row)]))
    return motion(row, angle, shift=in_side_view(beat_displacement(made.loom.beat.path, row)(angle)))
