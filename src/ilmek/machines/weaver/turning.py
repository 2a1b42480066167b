"""The pile handler's turning: rack on its cam's follower, pinion with a freewheel, shaft through the face, arm.

The handler turns in a plane along the warps, before the opener's points at rest, and shows the pile to the right side
gripper. Its shaft runs from its arm through the face to a pinion behind the carriages. The rack stands at the right
of the pinion's axis, so that a rising follower turns the handler counter-clockwise, seen from the weaver; on its way
back the pinion turns alone, by the freewheel.
"""

import math
from collections.abc import Iterator

import numpy as np

from ilmek.elements.involute import Gear, outline
from ilmek.elements.materials import MATERIALS
from ilmek.machines.weaver.cyclogram import PRESENT_TURN, TUBE_TURN
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.head_shape import HANDLER_ARM, LOWER_PLATE
from ilmek.machines.weaver.motions import HANDLER
from ilmek.machines.weaver.opener import STEEL
from ilmek.machines.weaver.return_springs import longest
from ilmek.machines.weaver.stations import follower_half, sheet, station
from ilmek.machines.weaver.tool_parts import HANDLER_SHAFT as SHAFT
from ilmek.machines.weaver.tool_parts import part_id
from ilmek.part.part import Bought, Part, Seat
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, bar, tube
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody
from ilmek.plane.contours import circle, polygon
from ilmek.plane.teeth import PRESSURE_ANGLE
from ilmek.sentences import Sentence
from ilmek.units import format_quantity, in_mm, mm, turn

HANDLER_BODY, PINION_BODY = part_id("turning pile handler"), part_id("turning pinion")
HANDLER_SHAFT, PINION, RACK, FREEWHEEL = (
    part_id("handler-shaft"),
    part_id("handler-pinion"),
    part_id("handler-rack"),
    part_id("freewheel"),
)
"""Ids of bodies and parts."""

SHAFT_STEEL = MATERIALS["bearing steel"]
"""Of the shaft, on which the rollers of the freewheel run."""

BEFORE = 2.5 * mm
"""From the handler's arm to the opener's points [m]; assumed by this project, as all sizes here."""

TEETH, SHIFT, FACE, BACK, BACKLASH, STUB = 15, 0.125, 5 * mm, 3 * mm, 0.1 * mm, 0.6
"""Of the pinion, and its profile shift [modules], above which a hob does not undercut it; its width, the rack's
back from the pitch circle, play of the teeth [m], and addendum of the rack [modules]."""

BESIDE = 1.5 * mm
"""Of the rack's back at the right of its follower [m]."""

CLUTCH = (8 * mm, 6 * mm)
"""Outer diameter and width of the freewheel [m]: HF0406."""


def pivot(weaver: Weaver) -> complex:
    """The axis of the handler, x + i y [m]: its pinion beside the rack, its tip at the right side gripper's yarn.

    Where arms tie it passes under their grippers.
    """
    aside = _pivot_aside(weaver)
    if weaver.params.with_arms:
        return complex(aside, weaver.tool_bodies.tools.handler)
    return complex(aside, weaver.tool_bodies.tied - _reach(weaver).imag)


def _pivot_aside(weaver: Weaver) -> float:
    """From the middle of the pair to the axis of the handler [m]."""
    return station(weaver, HANDLER) + weaver.params.cam_thickness / 2 + BESIDE - BACK - weaver.params.pinion


def _reach(weaver: Weaver) -> complex:
    """From the axis of the handler to its tip where it shows the pile, x + i y [m]."""
    by, radius = weaver.grippers, weaver.handler_radius
    aside = weaver.params.arms.aside if weaver.params.with_arms else by.axis + by.arm
    across = min(max((aside - _pivot_aside(weaver)) / radius, -1.0), 1.0)
    return radius * complex(across, math.sqrt(1 - across**2))


def home(weaver: Weaver) -> float:
    """Direction of its arm at angle 0 [rad], counter-clockwise from the right."""
    shown = float(np.angle(_reach(weaver)))
    return shown - TUBE_TURN - weaver.drawn / weaver.handler_radius - PRESENT_TURN


def rack_top(weaver: Weaver) -> float:
    """Height of the rack's upper end while its follower is lowest [m]: a tooth over the pinion."""
    return pivot(weaver).imag + weaver.params.pinion + 2 * _gear(weaver).module


def follower_top(weaver: Weaver) -> float:
    """Height of the follower behind the rack while it is lowest [m]: under its spring, which stands under the top."""
    under = (weaver.shape.body + weaver.shape.size).imag - sheet(weaver) - longest(weaver, HANDLER)
    return min(under, rack_top(weaver))


def _gear(weaver: Weaver) -> Gear:
    return Gear(2 * weaver.params.pinion / TEETH, TEETH, SHIFT)


def wheel_at(weaver: Weaver) -> float:
    """Where the pinion begins behind the carriages [m from the warps]: before the followers' line."""
    return weaver.shape.axis.real - follower_half(weaver) - FACE


def rack(weaver: Weaver) -> Part:
    """The rack, in the front view turned half round: x to the left from its pitch line, y down from its upper end."""
    gear, teeth = _gear(weaver), math.ceil(weaver.cam(HANDLER).lift / (math.pi * _gear(weaver).module)) + 3
    pitch, module = math.pi * gear.module, gear.module
    deep, wide = math.tan(math.radians(20.0)) * module, pitch / 4 - BACKLASH / 2
    back = BACK - SHIFT * module
    corners = [complex(-back, teeth * pitch), complex(-back, 0.0), complex(-1.25 * module, 0.0)]
    for k in range(teeth):
        at = (k + 0.5) * pitch
        root, tip = wide + 1.25 * deep, wide - STUB * deep
        corners += [
            complex(-1.25 * module, at - root),
            complex(STUB * module, at - tip),
            complex(STUB * module, at + tip),
            complex(-1.25 * module, at + root),
        ]
    corners.append(complex(-1.25 * module, teeth * pitch))
    shape = Prism(Profile(polygon(np.array(corners))), FACE)
    sizes = {"pitch": in_mm(pitch), "tip": in_mm(STUB * module), "back": in_mm(back)}
    note = Sentence("sheet.rack", **_tooth_data(gear, teeth), **sizes)
    return Part(RACK, "rack of the pile handler", "machined link", shape, STEEL, notes=(note,))


def _tooth_data(gear: Gear, teeth: int) -> dict[str, str]:
    """Module, teeth, pressure angle, quality of a gear or its rack, in words."""
    return {
        "module": in_mm(gear.module),
        "teeth": str(teeth),
        "angle": format_quantity(PRESSURE_ANGLE, "deg"),
        "quality": QUALITY,
    }


QUALITY = "8 ISO 1328-1"
"""Tolerance class of the teeth: hobbed, or cut by wire; assumed by this project."""


def rack_at(weaver: Weaver, upper: float) -> Placement:
    """Where the rack is while its upper end is at a height [m]: on the side of the follower next to the warps."""
    line = pivot(weaver).real + weaver.params.pinion + SHIFT * _gear(weaver).module
    return placement(line, upper, wheel_at(weaver), about=(0.0, 0.0, 1.0), angle=turn / 2)


def turning_bodies(weaver: Weaver, parent: str) -> Iterator[RigidBody]:
    """The handler on its shaft, and the pinion with its freewheel on it, at angle 0."""
    at, about = pivot(weaver), (0.0, 0.0, 1.0)
    (points,) = (tool.corner.real for tool in weaver.shape.tools if tool.name == LOWER_PLATE)
    begin, end = points - BEFORE - HANDLER_ARM[1], wheel_at(weaver) + FACE
    arm = weaver.tool_bodies.handler_arm
    shape, seats = bar(SHAFT, end - begin), {"journal": Seat(placement(z=end - begin - FACE), SHAFT)}
    shaft = Part(HANDLER_SHAFT, "shaft of the pile handler", "pin or bush", shape, SHAFT_STEEL, seats=seats)
    parts = (Occurrence(arm, (placement(z=begin),)), Occurrence(shaft, (placement(z=begin),)))
    positions = (placement(at.real, at.imag, 0.0, about=about, angle=home(weaver)),)
    yield RigidBody(HANDLER_BODY, parts, parent, Joint(JointKind.PIN, about), positions)
    outer, wide = CLUTCH
    wheel = Profile(polygon(outline(_gear(weaver))), (circle(0j, outer / 2),))
    gear = _gear(weaver)
    radii = {"tip": in_mm(2 * gear.tip_radius), "root": in_mm(2 * gear.root_radius)}
    note = Sentence("sheet.gear", **_tooth_data(gear, TEETH), shift=f"{SHIFT:+g}", **radii)
    pinion = Part(PINION, "pinion of the pile handler", "machined link", Prism(wheel, FACE), STEEL, notes=(note,))
    clutch = Part(
        FREEWHEEL,
        "freewheel of the pile handler",
        "bearing",
        shape=tube(outer, (outer - SHAFT) / 2, wide),
        purchase=Bought("HF0406", 0.001, housing="N7", hardness=58),
        seats={"bore": Seat(placement(), SHAFT)},
        envelope=True,
    )
    yield RigidBody(
        PINION_BODY,
        (Occurrence(pinion), Occurrence(clutch, (placement(z=FACE - wide),))),
        parent,
        Joint(JointKind.PIN, about, seats=(f"{FREEWHEEL}:bore", f"{HANDLER_SHAFT}:journal")),
        (placement(at.real, at.imag, wheel_at(weaver), about=about, angle=_meshing(weaver)),),
    )


def _meshing(weaver: Weaver) -> float:
    """Angle of the pinion at angle 0 [rad], with a gap of its teeth at a tooth of the rack, which is at its right."""
    gear = _gear(weaver)
    pitch = math.pi * gear.module
    upper = rack_top(weaver) + float(weaver.cam(HANDLER).motion.s[0])
    above = (upper - pitch / 2 - pivot(weaver).imag) % pitch
    return turn / (2 * TEETH) + above / gear.pitch_radius
