"""What stands, and what turns with the warps: frame, heads' rail, cylinders, back rest, carpet roll, motors."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ilmek.elements.columns import HollowSquare
from ilmek.machines.automated_loom.cyclogram import HEADS, TAKE_UP
from ilmek.machines.automated_loom.in_space.maker import (
    COARSE,
    SceneGroup,
    SceneMaker,
    along_track,
    in_side_view,
    motion,
    track_angles,
)
from ilmek.machines.automated_loom.in_space.warps_behind import compensator
from ilmek.machines.automated_loom.own_parts import own_tree
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.machines.warp_tension.tree import LOWER, SPACER, UPPER, turning
from ilmek.machines.warp_tension.tree import tree as cylinder_tree
from ilmek.part.placement import ALONG_WIDTH, placement
from ilmek.part.space import frames_of, parts_of
from ilmek.plane.solids import box, lengthwise, moved, square_tube, together, tube, upright
from ilmek.report.scene import SceneFrame, ScenePart, Solid
from ilmek.timing.track import sample
from ilmek.units import mm

GROUND, RAIL = "ground", "heads' rail"
_MOTOR_FACE = {"NEMA 17": 42.3 * mm, "NEMA 23": 57.2 * mm, "NEMA 34": 86.4 * mm, "NEMA 42": 107.9 * mm}
"""Sides of stepper motors' faces [NEMA ICS 16]; others: 80 mm. Length: twice the face, assumed by this project."""


def standing(made: SceneMaker) -> SceneGroup:
    """Frame with its rail, cylinders, and motors."""
    ground = SceneFrame(GROUND, np.zeros((1, 3)))
    rail = made.loom.side.rail
    middle = rail.corner + rail.size / 2
    retreat = along_track(made.loom.row_cyclogram, HEADS, (0.0, 0.0, 1.0))
    own, behind, cylinders = own_tree(made.loom), compensator(made, GROUND), _warp_cylinders(made)
    frames = (
        ground,
        SceneFrame(RAIL, in_side_view(np.array([middle])), motion=retreat),
        *cylinders.frames,
        *frames_of(own, GROUND),
        *behind.frames,
    )
    parts = (*_frame_parts(made), *cylinders.parts, *_motors(made))
    return SceneGroup(frames, (*parts, *parts_of(own, "automated-loom", checks=made.checks), *behind.parts))


def _frame_parts(made: SceneMaker) -> Iterator[ScenePart]:
    found = parts_of_loom(made.loom).frame
    column, rail = found.column, found.rail

    def part(name: str, solid: Solid, section: HollowSquare, length: float, check: str) -> ScenePart:
        frame = RAIL if section is rail else GROUND
        made_of = made.part(name, frame, solid, machine="automated-loom", line="frame", checks=(check,))
        return replace(made_of, title=f"{name}, {section.name}", mass=section.line_mass * length)

    task = found.task
    yield part("columns", _columns(made, column), column, 2 * task.height, "frame: ")
    if task.rail_spans > 1:
        yield part("posts", _posts(made, column), column, (task.rail_spans - 1) * task.height / 2, "frame: ")
    yield part("beams across", _across(made, column), column, 2 * task.width, "frame: stress")
    yield part("feet", _feet(made, column), column, 4 * task.depth, "frame: against")
    wide = square_tube(rail.side, rail.wall, -task.width / 2, task.width / 2)
    yield part("rail of the heads", wide, rail, task.width, "frame: sag")


def _columns(made: SceneMaker, section: HollowSquare) -> Solid:
    side = made.loom.side
    one = upright(square_tube(section.side, section.wall, side.floor, side.top))
    at = made.width / 2 + section.side / 2
    return together(*(moved(one, (x, 0.0, side.column)) for x in (-at, at)))


def _posts(made: SceneMaker, section: HollowSquare) -> Solid:
    """Posts under the rail, which rests on them where the heads have retreated."""
    side, spans = made.loom.side, parts_of_loom(made.loom).frame.task.rail_spans
    one = upright(square_tube(section.side, section.wall, side.floor, side.floor + (side.top - side.floor) / 2))
    front = (side.rail.corner + side.rail.size).real + side.retreat + section.side / 2
    origins = (np.arange(1, spans) / spans - 0.5) * made.width
    return together(*(moved(one, (float(x), 0.0, front)) for x in origins))


def _across(made: SceneMaker, section: HollowSquare) -> Solid:
    side = made.loom.side
    one = square_tube(section.side, section.wall, -made.width / 2, made.width / 2)
    heights = (side.floor + section.side / 2, side.top - section.side / 2)
    return together(*(moved(one, (0.0, y, side.column)) for y in heights))


def _feet(made: SceneMaker, section: HollowSquare) -> Solid:
    side, depth = made.loom.side, parts_of_loom(made.loom).frame.task.depth
    one = lengthwise(square_tube(section.side, section.wall, 0.0, depth))
    x, edge = made.width / 2 + section.side / 2, section.side / 2
    origins = [(at, z) for at in (-x, x) for z in (side.column + edge, side.column - edge - depth)]
    return together(*(moved(one, (at, side.floor + section.side / 2, z)) for at, z in origins))


def _warp_cylinders(made: SceneMaker) -> SceneGroup:
    """The cylinders of the warps with bearings and drives where the side view has them, and the whole carpet's roll."""
    side, row = made.loom.side, made.loom.row_cyclogram
    axes = {UPPER: side.upper, SPACER: side.spacer, LOWER: side.lower}
    track = row.track(TAKE_UP)
    angle = track_angles(track)
    taken = sample(track, angle).position
    radii = {name: side.roll if name == LOWER else axis.radius for name, axis in axes.items()}
    motions = {name: motion(row, angle, rotation=taken / radius) for name, radius in radii.items()}
    positions = {name: placement(0.0, axis.at.imag, axis.at.real).after(ALONG_WIDTH) for name, axis in axes.items()}
    bodies = turning(cylinder_tree(made.loom.warp_tension, positions), motions)
    parts = parts_of(bodies, "warp-tension", checks=made.checks, deviation=COARSE)
    roll = tube(side.lower.at, side.roll, side.lower.radius, -made.half, made.half, chord_error=COARSE)
    carpet = made.part("whole carpet on the lower cylinder", GROUND, roll, machine="automated-loom", envelope=True)
    return SceneGroup(frames_of(bodies, GROUND), (*parts, carpet))


def _motors(made: SceneMaker) -> Iterator[ScenePart]:
    """Motors of the cam shafts, at the right column: their position there is assumed by this project."""
    for index, cam in enumerate(made.loom.side.cams):
        line_name = next((one for one in made.lines if one.startswith("motor of the cam shaft")), "")
        if line_name:
            suffix = f" {index + 1}" if index else ""
            yield _motor(made, f"motor of the cam shaft{suffix}", line_name, cam.at, "shedding")


def _motor(made: SceneMaker, name: str, line: str, at: complex, machine: str) -> ScenePart:
    face = next((side for kind, side in _MOTOR_FACE.items() if kind in made.lines[line].description), 80 * mm)
    section = parts_of_loom(made.loom).frame.column.side
    low = made.width / 2 + section
    half = face / 2
    solid = box((low, at.imag - half, at.real - half), (low + 2 * face, at.imag + half, at.real + half))
    return made.part(
        name,
        GROUND,
        solid,
        machine=machine,
        line=line,
        checks=(f"{machine}: motor torque",),
        envelope=True,
        title=f"{name}: {made.lines[line].description}",
    )
