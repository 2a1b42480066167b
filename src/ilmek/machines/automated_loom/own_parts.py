"""The loom's own parts that are in none of its machines, as bodies: frame, heads' rail, back rest, control.

Axes of the scene: x along the width, 0 in the middle of the cloth, y up from the fell, z to the front.
"""

import cmath
import math

from ilmek.elements.drive_parts import PULLEY
from ilmek.elements.materials import GRAVITY
from ilmek.elements.motors import smallest_motor
from ilmek.machines.arrangement.side_view import RETREAT
from ilmek.machines.automated_loom.cyclogram import HEADS
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import LoomFrame, member, part_id
from ilmek.machines.automated_loom.rail_supports import rail_brackets, rail_middle, rail_supports
from ilmek.machines.automated_loom.standing_frame import standing_frame
from ilmek.machines.weaver import head_mass
from ilmek.machines.weaver.head_shape import RAIL_AXIS
from ilmek.part import catalogue
from ilmek.part.part import Bought, Part
from ilmek.part.placement import ALONG_WIDTH, placement
from ilmek.part.shapes import box
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.report.scene import SceneMotion
from ilmek.timing.track import peak_acceleration, peak_speed

RAIL = "heads' rail"
"""Id of the body that carries the heads."""

RETREAT_MOTOR = part_id("retreat-motor")


def carried_tree(loom: LoomDesign, frame: LoomFrame) -> Tree:
    """What the frame carries beside the machines: axes and motor of the rail's retreat."""
    return Tree((_retreat(loom, frame),))


def _retreat(loom: LoomDesign, frame: LoomFrame) -> RigidBody:
    """The axes of the rail's retreat at its ends and between, and their motor at an end.

    The motor accelerates heads and rail, and lifts them: m (a + g sin) along the retreat.
    """
    row, held = loom.row_cyclogram, rail_supports(loom, frame)
    heads, room = row.track(HEADS), loom.side.rail.size.real / 2  # the axes carry the rail beyond both ends of its run
    mass = loom.heads * head_mass(loom.weaver) + frame.rail.line_mass * frame.task.width
    moved = mass * (peak_acceleration(heads, row.period) - GRAVITY * RETREAT.imag)
    torque, turning = moved * PULLEY, peak_speed(heads, row.period) / PULLEY
    axis = Part(
        part_id("retreat-axis"),
        "axis of the rail's retreat",
        "linear axis",
        "belt drive, one at each support of the rail",
        box(RAIL_AXIS, RAIL_AXIS, heads.stroke + 2 * room),
        purchase=Bought("belt drive", length=heads.stroke),
        envelope=True,
    )
    chosen = smallest_motor(torque, turning)
    motor = catalogue.motor(RETREAT_MOTOR, "motor of the rail's retreat", chosen, torque, turning)
    # At the upper end, above the post; wider than its axis, it reaches outwards.
    outwards, slope = ((chosen.face if chosen else catalogue.SPECIAL_FACE) - RAIL_AXIS) / 2, -cmath.phase(RETREAT)
    ends = [
        placement(x, own.axis.imag, own.axis.real, about=(1.0, 0.0, 0.0), angle=slope)
        for own in held
        for x in own.stations
    ]
    flange = placement(outwards, z=-room)
    if not loom.beat.crank_rockers:  # At the lower end: the posts of vertical axes stand behind the rail.
        flange = placement(outwards, z=heads.stroke + room, about=(1.0, 0.0, 0.0), angle=math.pi)
    return RigidBody(
        part_id("retreat"),
        (
            Occurrence(axis, tuple(end.after(placement(z=-room)) for end in ends)),
            Occurrence(motor, (ends[0].after(flange),)),
        ),
    )


def frame_tree(loom: LoomDesign, frame: LoomFrame, axes: int, retreat: SceneMotion | None = None) -> Tree:
    """The frame with all that stands on it, and the rail that retreats with the heads.

    axes  of the control      retreat  motion of the rail to the front; default: it stands
    """
    rail = member("rail", "rail of the heads", frame.rail, frame.task.width)
    axis = Part(
        part_id("rail-axis"),
        "axes of the heads on their rail",
        "linear axis",
        "with a belt for each head",
        box(RAIL_AXIS, RAIL_AXIS, frame.task.width),
        purchase=Bought("linear axis", length=frame.task.width),
        envelope=True,
    )
    middle = rail_middle(loom)
    along = placement(-frame.task.width / 2, z=frame.rail.side / 2).after(ALONG_WIDTH)
    before = placement(-frame.task.width / 2, z=-RAIL_AXIS / 2).after(ALONG_WIDTH)
    return Tree(
        (
            standing_frame(loom, frame, axes),
            RigidBody(
                RAIL,
                (Occurrence(rail, (along,)), Occurrence(axis, (before,)), *rail_brackets(loom, frame)),
                joint=Joint(JointKind.SLIDE, motion=retreat, motor=RETREAT_MOTOR),
                positions=(placement(0.0, middle.imag, middle.real),),
            ),
        )
    )
