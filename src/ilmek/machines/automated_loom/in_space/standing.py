"""What stands, and what turns with the warps: frame, heads' rail, cylinders, back rest, carpet roll, motors."""

from ilmek.machines.arrangement.cylinders import RoundPart
from ilmek.machines.arrangement.side_view import RETREAT
from ilmek.machines.automated_loom.cyclogram import HEADS, TAKE_UP
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.maker import (
    COARSE,
    FINE,
    STANDS,
    MachineTree,
    along_track,
    motion,
    room_part,
    track_angles,
)
from ilmek.machines.automated_loom.in_space.warps_behind import compensator
from ilmek.machines.automated_loom.own_parts import carried_tree, frame_tree
from ilmek.machines.automated_loom.parts import needs_of, parts_of_loom
from ilmek.machines.warp_tension import WarpTensionDesign
from ilmek.machines.warp_tension.cylinders import LOWER, SPACER, UPPER, cylinders
from ilmek.machines.warp_tension.slot import over, turned_slot
from ilmek.machines.warp_tension.tree import tree as cylinder_tree
from ilmek.machines.warp_tension.tree import turning
from ilmek.part.placement import ALONG_WIDTH, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism
from ilmek.part.tree import JointKind, Tree
from ilmek.plane.contours import circle
from ilmek.report.scene import ScenePart, Solid
from ilmek.timing.track import sample
from ilmek.units import mm


def standing(loom: LoomDesign) -> tuple[MachineTree, ...]:
    """Frame with its rail, what it carries, cylinders, and compensator."""
    listed = parts_of_loom(loom)
    away = (0.0, RETREAT.imag, RETREAT.real)
    retreat = along_track(loom.row_cyclogram, HEADS, away) if loom.heads else None
    warps = _warp_cylinders(loom).bodies
    turned = [body for body in warps if body.joint.kind is JointKind.PIN]
    winding, slotted = (tuple(body for body in turned if (SPACER in body.id) is own) for own in (False, True))
    beside = tuple(body for body in warps if body not in turned)
    return (
        MachineTree("automated-loom", frame_tree(loom, listed.frame, needs_of(loom, listed.parts), retreat)),
        MachineTree("automated-loom", carried_tree(loom, listed.frame), deviations=(FINE, COARSE)),
        MachineTree("warp-tension", Tree(winding), deviations=(FINE, COARSE)),
        MachineTree("warp-tension", Tree(slotted), deviations=(COARSE,)),
        MachineTree("warp-tension", Tree(beside)),  # finer: screws in their holes
        *compensator(loom),
    )


def _warp_cylinders(loom: LoomDesign) -> Tree:
    """The cylinders of the warps with bearings and drives where the side view has them."""
    side, row = loom.side, loom.row_cyclogram
    axes = {UPPER: side.upper, SPACER: side.spacer, LOWER: side.lower}
    track = row.track(TAKE_UP)
    angle = track_angles(track)
    taken = sample(track, angle).position
    radii = {name: side.roll if name == LOWER else axis.radius for name, axis in axes.items()}
    motions = {name: motion(row, angle, rotation=taken / radius) for name, radius in radii.items()}
    positions = {name: placement(0.0, axis.at.imag, axis.at.real).after(ALONG_WIDTH) for name, axis in axes.items()}
    return turning(cylinder_tree(loom.warp_tension, positions), motions)


def carpet_roll(winding: WarpTensionDesign, lower: RoundPart, roll: float) -> ScenePart:
    """The room of the whole carpet on the lower cylinder, open over its attachment bar and where this goes in a row.

    lower  cylinder in the side view      roll  radius with the carpet [m]
    """
    cloth, slotted = winding.params.cloth, cylinders(winding)[1]
    deep, half = over(slotted) + cloth.carpet_yarns.warp.diameter, cloth.width / 2
    bore = turned_slot(slotted, deep, 4 * cloth.row_distance)
    radius = max(roll, slotted.outer + deep + mm)  # a short carpet lies over the bar
    carpet = Prism(Profile(circle(0j, radius), (bore,)), 2 * half).mesh(FINE)
    along = placement(-half, lower.at.imag, lower.at.real).after(ALONG_WIDTH)
    solid = Solid(along.points(carpet.points), carpet.triangles)
    return room_part("whole carpet on the lower cylinder", STANDS, solid, "warp-tension")
