"""The knotting heads in space: side plates, cams on their shaft, tools at the warps, tubes; and the yarn that they tie.

The heads stand beside each other on the rail; all their parts but the cams are boxes and rods as the side view and
`machines.weaver.grippers` state them.
"""

from collections.abc import Iterator

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.arrangement.head_shape import HeadTool
from ilmek.machines.automated_loom.cyclogram import CARRIAGE
from ilmek.machines.automated_loom.in_space.maker import (
    COARSE,
    COARSEST,
    FINE,
    KNOT,
    SceneGroup,
    SceneMaker,
    along_track,
    motion,
    plate_part,
    track_angles,
)
from ilmek.machines.automated_loom.own_parts import RAIL
from ilmek.machines.weaver.grippers import Grippers
from ilmek.machines.weaver.knot import led_between
from ilmek.machines.weaver.motions import CENTRE_MOTION, SIDE_MOTION
from ilmek.machines.weaver.report import plates
from ilmek.plane.solids import box, lengthwise, moved, together, tube
from ilmek.report.scene import SceneFrame, ScenePart, SceneYarn, Solid
from ilmek.timing.track import sample
from ilmek.units import mm, turn

HEAD, CAMS = "head", "head's cams"
MACHINE = "weaver"
_ROUND = 0.05 * mm
_FRONT = (0.0, 0.0, 1.0)
_YARN_SAMPLES, _YARN_POINTS, _EACH = 91, 48, 41


def heads(made: SceneMaker) -> SceneGroup:
    """The frames and parts of a head, which stands as often as there are heads."""
    frames = [_head_frame(made), *_cam_frames(made)]
    parts = [*_case(made), *_cam_parts(made), *_tubes(made)]
    for tool in made.loom.side.head.tools:
        if tool.name in _GRIPPERS and not made.loom.weaver.params.with_arms:
            continue
        frames.append(_tool_frame(made, tool))
        parts.append(_tool(made, tool))
    if not made.loom.weaver.params.with_arms:
        found = _grippers(made)
        frames += found.frames
        parts += found.parts
    return SceneGroup(tuple(frames), tuple(parts))


_GRIPPERS = ("side grippers", "centre gripper")


def _head_frame(made: SceneMaker) -> SceneFrame:
    """Each head in the middle of its share of the row; over a knot its carriage steps to the next one.

    Its origin lies in the side view's: at the fell, in the heads' origin while they knot.
    """
    loom, rail = made.loom, made.loom.side.rail
    middle = rail.corner + rail.size / 2
    origins = np.zeros((loom.heads, 3))
    origins[:, 0] = (np.arange(loom.heads) + 0.5) / loom.heads * loom.task.cloth_width - made.half
    origins[:, 1], origins[:, 2] = -middle.imag, -middle.real
    return SceneFrame(HEAD, origins, RAIL, along_track(loom.knot_cyclogram, CARRIAGE, (1.0, 0.0, 0.0)))


def _case(made: SceneMaker) -> Iterator[ScenePart]:
    """The side plates: their thickness is designed, their outline is the room of the body."""
    head, weaver = made.loom.side.head, made.loom.weaver
    low, high = head.body, head.body + head.size
    half, plate = weaver.width / 2, weaver.params.side_plate
    one = box((-half, low.imag, low.real), (plate - half, high.imag, high.real))
    both = together(one, moved(one, (weaver.width - plate, 0.0, 0.0)))
    checks = ("weaver: knot cycle", "weaver: carriage", "heads that share", "clearance: head")
    yield made.part(
        "side plates of the head", HEAD, both, machine=MACHINE, line="knotting head", checks=checks, envelope=True
    )


def _axis(made: SceneMaker) -> complex:
    head = made.loom.side.head
    return head.body + head.size / 2


def _cam_frames(made: SceneMaker) -> Iterator[SceneFrame]:
    angle = np.linspace(0.0, turn, 3)
    turning = motion(made.loom.knot_cyclogram, angle, rotation=-angle)
    axis = _axis(made)
    yield SceneFrame(CAMS, np.array([[0.0, axis.imag, axis.real]]), HEAD, turning)


def _cam_parts(made: SceneMaker) -> Iterator[ScenePart]:
    """The cams beside each other on their shaft; that of a gear is drawn at the end of the stack."""
    weaver, params = made.loom.weaver, made.loom.weaver.params
    inner = weaver.width / 2 - params.side_plate
    shaft = tube(0j, params.shaft / 2, 0.0, -inner, inner, chord_error=_ROUND)
    yield made.part("cam shaft of the head", CAMS, shaft, machine=MACHINE, checks=("weaver: motor of the cam",))
    x = -inner + params.cam_gap
    masses = {cam.name.replace(" ", "-"): cam for cam in weaver.cams}
    for plate in plates(weaver):
        cam = masses[plate.name]
        checks = made.checked(*(f"weaver: {what}, {cam.name}" for what in _CAM_CHECKS), f"weaver: {cam.name}: ")
        yield plate_part(
            plate, CAMS, x, machine=MACHINE, mass=float("nan"), checks=checks, deviations=(FINE, COARSE, COARSEST)
        )
        if cam.actuator.startswith("cam"):
            x += plate.thickness + params.cam_gap


_CAM_CHECKS = ("pressure angle", "roller", "Hertz pressure", "diameter", "speed before lift-off")


def _tubes(made: SceneMaker) -> Iterator[ScenePart]:
    """The yarn tubes in the magazine: on the circle of a drum, or in a line."""
    magazine, head = made.loom.weaver.magazine, made.loom.side.head
    corner, size = head.magazine, head.magazine_size
    number, pitch = magazine.per_tier, magazine.pitch
    middle = corner + size / 2
    if magazine.kind == "drum":
        round_ = pitch * number / turn * np.exp(1j * turn * np.arange(number) / number)
        at = round_ + 0j
    else:
        at = (np.arange(number) - (number - 1) / 2) * pitch + 0j
    tall = max(size.imag, pitch)
    one = tube(0j, 0.4 * pitch, 0.3 * pitch, -tall / 2, tall / 2, chord_error=10 * _ROUND)
    standing = Solid(one.points[:, [2, 0, 1]], one.triangles)
    depth = max(middle.real, corner.real + float(np.max(at.imag)) + pitch / 2)
    tubes = together(*(moved(standing, (float(a.real), middle.imag, depth + float(a.imag))) for a in at))
    checks = ("weaver: tubes on", "weaver: tiers")
    yield made.part("yarn tubes", HEAD, tubes, machine=MACHINE, line="yarn tube", checks=checks, envelope=True)


def _tool_frame(made: SceneMaker, tool: HeadTool) -> SceneFrame:
    direction = (0.0, tool.direction.imag, tool.direction.real)
    moves = along_track(made.loom.knot_cyclogram, tool.track, direction, tool.limit)
    return SceneFrame(tool.name, np.zeros((1, 3)), HEAD, moves)


def _tool(made: SceneMaker, tool: HeadTool) -> ScenePart:
    """A tool as the box of the side view, as wide as what it works on: the opened warps, or the pair."""
    by = made.loom.weaver.grippers
    half = abs(by.warps[-1].real) if "opener" in tool.name else by.axis
    far = tool.corner + tool.size
    solid = box((-half, tool.corner.imag, tool.corner.real), (half, far.imag, far.real))
    checks = (f"weaver: {tool.name}", "weaver: opener" if "opener" in tool.name else f"weaver: {tool.name}: ")
    return made.part(tool.name, tool.name, solid, machine=MACHINE, checks=checks)


def _tied(made: SceneMaker) -> float:
    params, by = made.loom.weaver.params, made.loom.weaver.grippers
    return float(params.opener.front_span + params.clearance + (by.lift + by.finger) / 2)


def _grippers(made: SceneMaker) -> SceneGroup:
    """Rods and arms of the side grippers, which a screw turns about the rods, and the centre gripper."""
    loom, by, tied = made.loom, made.loom.weaver.grippers, _tied(made)
    knot = loom.knot_cyclogram
    side, face = knot.track(SIDE_MOTION), loom.side.head.body.real
    angle = track_angles(side)
    position = sample(side, angle).position
    shift = -position[:, None] * np.array(_FRONT)
    front = by.front + by.opening
    checks = tuple(
        f"weaver: {what}" for what in ("bend of a side", "stress of a side", "time of the side", "room of the side")
    )
    frames, parts = [], []
    for hand, name in ((-1, "left side gripper"), (1, "right side gripper")):
        origin = np.array([[hand * by.axis, tied + hand * by.lift / 2, front]])
        moves = motion(knot, angle, shift=shift, rotation=hand * by.turned(position))
        frames.append(SceneFrame(name, origin, HEAD, moves, axis=_FRONT))
        parts.append(made.part(name, name, _side_gripper(by, hand, face - front), machine=MACHINE, checks=checks))
    centre = SceneFrame(
        "centre gripper",
        np.array([[0.0, tied + by.height, by.stroke - by.depth]]),
        HEAD,
        along_track(knot, CENTRE_MOTION, (0.0, 0.0, -1.0)),
    )
    half = by.finger / 2
    solid = box((-half, -half, 0.0), (half, half, face + by.depth))
    parts.append(
        made.part("centre gripper", "centre gripper", solid, machine=MACHINE, checks=("weaver: centre-gripper",))
    )
    return SceneGroup((*frames, centre), tuple(parts))


def _side_gripper(by: Grippers, hand: int, reach: float) -> Solid:
    """A rod to the front from its tip at 0, and the arm across it."""
    half = by.finger / 2
    rod = lengthwise(tube(0j, half, 0.0, 0.0, reach + by.opening + by.crossing, chord_error=_ROUND))
    low, high = sorted((0.0, hand * by.arm))
    return together(rod, box((low, -half, -half), (high, half, half)))


def knot_yarn(made: SceneMaker) -> tuple[SceneYarn, ...]:
    """The yarn of a knot over its angle, as its ends are led; none of a head with arms."""
    weaver = made.loom.weaver
    if weaver.params.with_arms or weaver.tied.knot is None:
        return ()
    angle = np.linspace(0.0, turn, _YARN_SAMPLES)
    grasped, taken, released = led_between(weaver.cyclogram)
    at = np.concatenate([np.linspace(grasped, taken, 6 * _EACH), np.linspace(taken, released, 2 * _EACH)])
    ends = [_end(made, at, taken, hand) for hand in (-1, 1)]
    known = np.maximum(np.searchsorted(at, angle, side="right"), 2)
    points = np.stack([_laid(np.concatenate([ends[0][:k][::-1], ends[1][:k]])) for k in known])
    pile = made.loom.task.yarns.pile.diameter
    return (SceneYarn("yarn of the knot", "yarn of the knot", HEAD, KNOT, angle, points, pile),)


def _end(made: SceneMaker, at: FloatArray, taken: float, hand: int) -> FloatArray:
    """An end of the yarn at cam angles [rad]: led by its side gripper, then drawn by the centre gripper [m]."""
    weaver, by, tied = made.loom.weaver, made.loom.weaver.grippers, _tied(made)
    side = sample(weaver.cyclogram.track(SIDE_MOTION), at).position
    centre = sample(weaver.cyclogram.track(CENTRE_MOTION), at).position
    tip, drawn, turned = by.tip(side), by.centre(centre), by.turned(side)
    led = at <= taken
    x = np.where(led, -hand * tip.real, 0.0)
    y = np.where(led, tied + hand * by.lift / 2 + by.arm * np.sin(turned), tied + by.height)
    z = np.where(led, tip.imag, drawn.imag)
    return np.stack([x, y, z], axis=1)


def _laid(line: FloatArray) -> FloatArray:
    """The line through points [m], evenly: its front view by length, its depth with it."""
    flat = line[:, 0] + 1j * line[:, 1]
    number = np.linspace(0.0, len(line) - 1, _YARN_POINTS)
    depth = np.interp(number, np.arange(len(line)), line[:, 2])
    shown = np.interp(number, np.arange(len(line)), flat.real) + 1j * np.interp(number, np.arange(len(line)), flat.imag)
    return np.stack([shown.real, shown.imag, depth], axis=1)
