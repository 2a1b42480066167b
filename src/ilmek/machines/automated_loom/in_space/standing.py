"""What stands, and what turns with the warps: frame, heads' rail, cylinders, back rest, carpet roll, motors."""

import numpy as np

from ilmek.machines.arrangement.side_view import RETREAT
from ilmek.machines.automated_loom.cyclogram import HEADS, TAKE_UP
from ilmek.machines.automated_loom.in_space.maker import (
    COARSE,
    SceneGroup,
    SceneMaker,
    along_track,
    motion,
    room_part,
    track_angles,
)
from ilmek.machines.automated_loom.in_space.warps_behind import compensator
from ilmek.machines.automated_loom.own_parts import carried_tree, frame_tree
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.machines.warp_tension.tree import LOWER, SPACER, UPPER, turning
from ilmek.machines.warp_tension.tree import tree as cylinder_tree
from ilmek.part.placement import ALONG_WIDTH, placement
from ilmek.part.shapes import tube
from ilmek.part.space import frames_of, parts_of
from ilmek.report.scene import SceneFrame, Solid
from ilmek.timing.track import sample

GROUND = "ground"


def standing(made: SceneMaker) -> SceneGroup:
    """Frame with its rail, what it carries, cylinders, and compensator."""
    retreat = along_track(made.loom.row_cyclogram, HEADS, (0.0, RETREAT.imag, RETREAT.real))
    own = frame_tree(made.loom, parts_of_loom(made.loom).frame, retreat)
    carried = carried_tree(made.loom)
    groups = (_warp_cylinders(made), compensator(made, GROUND))
    return SceneGroup(
        (
            SceneFrame(GROUND, np.zeros((1, 3))),
            *frames_of(own, GROUND),
            *frames_of(carried, GROUND),
            *(frame for group in groups for frame in group.frames),
        ),
        (
            *parts_of(own, "automated-loom", checks=made.checks),
            *parts_of(carried, "automated-loom", checks=made.checks, deviations=(COARSE,)),
            *(part for group in groups for part in group.parts),
        ),
    )


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
    parts = parts_of(bodies, "warp-tension", checks=made.checks, deviations=(COARSE,))
    roll = tube(2 * side.roll, side.roll - side.lower.radius, 2 * made.half).mesh(COARSE)
    along = placement(-made.half, side.lower.at.imag, side.lower.at.real).after(ALONG_WIDTH)
    roll = Solid(along.points(roll.points), roll.triangles)
    carpet = room_part("whole carpet on the lower cylinder", GROUND, roll, "automated-loom")
    return SceneGroup(frames_of(bodies, GROUND), (*parts, carpet))
