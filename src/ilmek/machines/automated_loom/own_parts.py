"""The loom's own parts that are in none of its machines, as bodies: frame, heads' rail, back rest, control.

Axes of the scene: x along the width, 0 in the middle of the cloth, y up from the fell, z to the front.
"""

import cmath
import math
from collections.abc import Iterator

from ilmek.elements.columns import STEEL
from ilmek.elements.drive_parts import PULLEY
from ilmek.elements.materials import GRAVITY
from ilmek.elements.motors import smallest_motor
from ilmek.machines.arrangement.side_view import RAIL as RAIL_ROOM
from ilmek.machines.arrangement.side_view import RETREAT
from ilmek.machines.automated_loom.brackets import brackets_of
from ilmek.machines.automated_loom.cabinet import ControlNeeds
from ilmek.machines.automated_loom.cyclogram import HEADS
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import BEYOND, CARRIAGE, ROOM, LoomFrame, member, part_id
from ilmek.machines.automated_loom.joints import seams, with_throats
from ilmek.machines.automated_loom.on_rail import guide_parts, trough
from ilmek.machines.automated_loom.rail_supports import (
    RailSupport,
    rail_brackets,
    rail_supports,
)
from ilmek.machines.automated_loom.standing_frame import standing_frame
from ilmek.machines.automated_loom.supports import post_depth, rail_middle, supports
from ilmek.machines.weaver import head_mass
from ilmek.machines.weaver.head_shape import RAIL_AXIS
from ilmek.part import catalogue
from ilmek.part.part import LASER_CUT, Bought, Part, bought_part
from ilmek.part.placement import ALONG_WIDTH, IN_SIDE_VIEW, Placement, placement
from ilmek.part.shapes import box, shape_box
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.report.scene import SceneMotion
from ilmek.timing.track import peak_acceleration, peak_speed
from ilmek.units import in_mm

RAIL = "heads' rail"
"""Id of the body that carries the heads."""

RETREAT_MOTOR, RETREAT_BRAKE = part_id("retreat-motor"), part_id("retreat-brake")
RETREAT_ADAPTERS = part_id("retreat-adapter-right"), part_id("retreat-adapter-left")


def carried_tree(loom: LoomDesign, frame: LoomFrame) -> Tree:
    """What the frame carries beside the machines: caps of its brackets, axes and motors of the rail's retreat."""
    caps = tuple(_caps(loom))
    bodies = (RigidBody(part_id("bracket-caps"), caps),) if caps else ()
    return Tree((*bodies, _retreat(loom, frame)) if loom.heads else bodies)


def _caps(loom: LoomDesign) -> Iterator[Occurrence]:
    """The caps of brackets in which bearings slide, on both sides."""
    for bracket in brackets_of(loom).plates:
        if bracket.cap is not None:
            shape, middle = bracket.cap
            part = Part(
                part_id(f"{bracket.name}-cap"),
                f"cap of the {bracket.title}",
                LASER_CUT,
                shape,
                STEEL,
                machined=True,
            )
            positions = (placement(x, middle.imag, middle.real) for x in (-bracket.inner, bracket.outer))
            yield Occurrence(part, tuple(own.after(IN_SIDE_VIEW) for own in positions))


def mass_of_rail(loom: LoomDesign, frame: LoomFrame) -> float:
    """Mass of the rail with what lies along it and what is fixed to it, which retreats with the heads [kg]."""
    fixed = RigidBody(RAIL, tuple(rail_brackets(loom, frame))).moments.zeroth
    section, task = frame.guide
    return task.rail_mass(section) * task.width + 2 * BEYOND * section.line_mass + fixed


def _retreat(loom: LoomDesign, frame: LoomFrame) -> RigidBody:
    """The axes of the rail's retreat at its ends and between; each of those at the ends has its motor.

    The motors accelerate heads and rail, and lift them: m (a + g sin) along the retreat, m at an end half of the rail
    with its cargo and, where the n heads stand at the beginnings of their shares, (n + 1) / 2 of them.
    """
    row, held = loom.row_cyclogram, rail_supports(loom, frame)
    heads, room = row.track(HEADS), RAIL_ROOM / 2  # the axes carry the rail beyond both ends of its run
    mass = ((loom.heads + 1) * head_mass(loom.weaver) + mass_of_rail(loom, frame)) / 2
    moved = mass * (peak_acceleration(heads, row.period) - GRAVITY * RETREAT.imag)
    torque, turning = moved * PULLEY, peak_speed(heads, row.period) / PULLEY
    chosen = smallest_motor(torque, turning)
    motor = catalogue.motor(
        RETREAT_MOTOR, "motor of the rail's retreat", chosen, torque, turning, together=2, rear=True
    )
    brake = catalogue.holding_brake(
        RETREAT_BRAKE, "brake of the rail's retreat", motor, -mass * GRAVITY * RETREAT.imag * PULLEY
    )
    aside = _aside(catalogue.face_of(motor))
    low = heads.stroke + room
    if not loom.beat.crank_rockers:
        low = _before_posts(loom, frame, held[0], (motor, brake), low)
    axis = bought_part(
        part_id("retreat-axis"),
        "axis of the rail's retreat",
        "linear axis",
        box(RAIL_AXIS, RAIL_AXIS, low + room),
        Bought(
            "belt drive",
            length=heads.stroke,
            data=f"linear axis {in_mm(RAIL_AXIS)} wide, belt drive, {catalogue.stroke_of(heads.stroke)}",
        ),
        size="belt drive, one at each support of the rail",
    )
    slope, upper = -cmath.phase(RETREAT), placement(z=-room)
    stations = [
        placement(x, own.axis.imag, own.axis.real, about=(1.0, 0.0, 0.0), angle=slope)
        for own in held
        for x in own.stations
    ]
    # At the upper end, above the post; at the lower end where the posts of vertical axes stand behind the rail.
    flange = upper if loom.beat.crank_rockers else placement(z=low, about=(1.0, 0.0, 0.0), angle=math.pi)
    ends = zip(stations[: len(held[0].stations)], (placement(aside), placement(-aside)), strict=True)
    adapters, flanges = _adapted(motor, tuple(end.after(out).after(flange) for end, out in ends))
    parts = (
        Occurrence(axis, tuple(station.after(upper) for station in stations)),
        *adapters,
        *(Occurrence(part, flanges) for part in (motor, brake)),
    )
    return RigidBody(part_id("retreat"), parts)


def _adapted(motor: Part, ends: tuple[Placement, ...]) -> tuple[tuple[Occurrence, ...], tuple[Placement, ...]]:
    """Adapters and flanges of the motors at the right and the left end, as `catalogue.adapted`.

    Each end has an adapter of its own: its axis lies beside the motor, to the other side.
    """
    titles = (f"{side} adapter of the rail's retreat" for side in ("right", "left"))
    sides = [
        catalogue.adapted(name, title, motor, RAIL_AXIS, (end,))
        for name, title, end in zip(RETREAT_ADAPTERS, titles, ends, strict=True)
    ]
    return tuple(part for own, _ in sides for part in own), tuple(flange for _, own in sides for flange in own)


def _aside(face: float) -> float:
    """From an axis of the retreat to that of a motor with a face [m]: a large one keeps off the rail's plate."""
    return max((face - RAIL_AXIS) / 2 - CARRIAGE[2] + BEYOND, 0.0)


def _before_posts(loom: LoomDesign, frame: LoomFrame, held: RailSupport, drive: tuple[Part, Part], low: float) -> float:
    """Lower end of the axes of the retreat [m], at least `low`: motors and brakes there lie before the posts beside."""
    face = catalogue.face_of(drive[0])
    adapter = catalogue.ADAPTER * face if face > RAIL_AXIS else 0.0
    rear_end = min(float(shape_box(part.shape)[0][2]) for part in drive if part.shape is not None)
    aside, beat = -face / 2 * RETREAT.imag, supports(loom, frame).post.side / 2
    front = aside + (adapter - rear_end) * RETREAT.real
    posts = [(post_depth(loom, frame) - held.axis.real, beat)]
    if (face - RAIL_AXIS) / 2 + _aside(face) > held.reach - ROOM:
        posts.append((held.depth - held.axis.real, held.post.side / 2))
    for depth, half in sorted(posts):
        begin = low * RETREAT.real
        if begin - aside < depth + half + ROOM and depth - half - ROOM < begin + front:
            low = (depth + half + ROOM + aside) / RETREAT.real
    return low


def frame_tree(loom: LoomDesign, frame: LoomFrame, needs: ControlNeeds, retreat: SceneMotion | None = None) -> Tree:
    """The frame with all that stands on it, and the rail that retreats with the heads, if any.

    needs  of the control      retreat  motion of the rail to the front; default: it stands
    """
    standing = with_throats(standing_frame(loom, frame, needs), seams(loom, frame))
    return Tree((standing, _rail(loom, frame, retreat)) if loom.heads else (standing,))


def _rail(loom: LoomDesign, frame: LoomFrame, retreat: SceneMotion | None) -> RigidBody:
    """The rail with the guide and the belt of the heads."""
    (section, task), middle = frame.guide, rail_middle(loom)
    long = task.width + 2 * BEYOND
    rail = member("rail", "rail of the heads", section, long)
    along = placement(-long / 2, z=section.side / 2).after(ALONG_WIDTH)
    welded = Occurrence(rail, (along,)), trough(loom, section.side)
    parts = (*welded, *guide_parts(loom), *rail_brackets(loom, frame))
    joint = Joint(JointKind.SLIDE, motion=retreat, motor=RETREAT_MOTOR)
    return RigidBody(RAIL, parts, joint=joint, positions=(placement(0.0, middle.imag, middle.real),))
