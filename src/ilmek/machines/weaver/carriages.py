"""What carries the tools in a head's case: their carriages, the plate that guides them, screws, rods and springs.

Behind the face is the carriage of opener and side grippers, behind the plate across the case, the partition, that of
the centre gripper; the sley's block slides on an upright rod. The side grippers turn in their carriage: each ends in a
square bar that is twisted where the carriage goes on from the opened warps, in a nut on the partition.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from ilmek.machines.weaver.case import ALUMINIUM, GuideHole, apart, bar_hole
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.head_shape import (
    ABOVE_CENTRE,
    BAR,
    DRAWBAR,
    LOWER_PLATE,
    OPENER_FOOT,
    PARTITION,
    SLEY_BLOCK,
    SLEY_HEIGHT,
    SLEY_PIN,
    SLEY_TOOL,
    UPPER_PLATE,
)
from ilmek.machines.weaver.jaws import LUG, jaw_springs, lugs, rocker
from ilmek.machines.weaver.lever_parts import drawbar, pinned
from ilmek.machines.weaver.levers import HALF
from ilmek.machines.weaver.motions import (
    CENTRE_GRASP,
    CENTRE_MOTION,
    HANDLER,
    OPENER,
    SIDE_GRASP,
    SIDE_MOTION,
    SLEY,
)
from ilmek.machines.weaver.opener import STEEL
from ilmek.machines.weaver.outlines import bored
from ilmek.machines.weaver.return_springs import longest, shortest, spring_part
from ilmek.machines.weaver.stations import sheet, station
from ilmek.machines.weaver.tool_parts import (
    CENTRE,
    CENTRE_BAR,
    HANDLER_SHAFT,
    LEFT,
    PLATES,
    RIGHT,
    SIDE_GRIPPER,
    SLEY_ARM,
    SLEY_BODY,
    SLEY_LUG,
    part_id,
)
from ilmek.machines.weaver.turning import pivot
from ilmek.machines.weaver.widths import stack_width
from ilmek.part.part import Part
from ilmek.part.placement import UPRIGHT, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Shape, Sum, bar, box, rectangle, tube
from ilmek.part.tree import Occurrence
from ilmek.part.twisted import TwistedBar
from ilmek.plane.contours import circle, polygon
from ilmek.sentences import Sentence
from ilmek.units import mm

ROD, COLLAR = 5 * mm, 4 * mm
"""Diameter of the carriages' rods, and length of their collars [m]; assumed by this project, as all sizes here."""

RODS, BELOW_TOP, HIGH = (-9.5 * mm, 9.5 * mm), 3 * mm, 3.8 * mm
"""The side carriage's rods from its middle and below the opener's top, and half the width of the centre gripper's
carriage between them [m]."""

SEAT, SPIGOT = 12 * mm, 8 * mm
"""Diameters of the seat of the centre gripper's spring, and of its spigot in the partition [m]."""

LUG_END = 4.3 * mm
"""From a side gripper's rod to the outer side of the lug beside it [m]."""

SCREW, NUT, IN_NUT = 4 * mm, 1 * mm, 0.2 * mm
"""Side of the twisted bars, thickness of their nut and room in it [m]."""

EAR = (7 * mm, 9 * mm, 4 * mm)
"""Width, height and thickness of the ears by which the nut is screwed [m]."""

ROD_WELD = 0.7 * mm
"""Throat of the weld of a twisted bar on the rod of its gripper [m]."""

SUPPORT, LEAST_WALL = 6 * mm, 1 * mm
"""Thickness of the support of the sley's rod, and its wall about that at least [m]."""


def opener_track(weaver: Weaver) -> str:
    """The track that moves the carriage of the opener."""
    return OPENER if weaver.params.with_arms else SIDE_MOTION


def carried_parts(weaver: Weaver) -> Mapping[str, tuple[Occurrence, ...]]:
    """What the bodies of the tools carry beside the tools, in their frames, by their ids."""
    parts = {PLATES: tuple(_side_carriage(weaver)), SLEY_BODY: tuple(_sley_block(weaver))}
    if weaver.params.with_arms:
        return parts
    origin = weaver.tool_bodies.frame(CENTRE).inverse
    centre = (
        Occurrence(each.part, tuple(origin.after(position) for position in each.positions))
        for each in _centre_carriage(weaver)
    )
    screws = {name: (_screw(weaver, name, hand),) for name, hand in ((LEFT, -1), (RIGHT, 1))}
    return {**parts, CENTRE: tuple(centre), **screws}


def standing_parts(weaver: Weaver) -> Iterator[Occurrence]:
    """What stands in the case for the carriages: partition, nut, the sley's rod, springs."""
    yield _partition(weaver)
    if not weaver.params.with_arms:
        yield _nut(weaver)
    yield from _sley_rod(weaver)
    yield from _springs(weaver)


def _levels(weaver: Weaver) -> tuple[float, float]:
    """Bottom and top of the opener [m]."""
    tools = weaver.tool_bodies.tools
    high = tools.tool(UPPER_PLATE)
    return tools.tool(LOWER_PLATE).corner.imag, (high.corner + high.size).imag


def _centre_height(weaver: Weaver) -> float:
    return weaver.tool_bodies.tied + weaver.grippers.height


def _rods(weaver: Weaver) -> tuple[complex, complex]:
    """Axes of the side carriage's rods, x + i y [m]."""
    height = _levels(weaver)[1] - BELOW_TOP
    return complex(RODS[0], height), complex(RODS[1], height)


def _side_carriage(weaver: Weaver) -> Iterator[Occurrence]:
    """Cross bar with opener and grippers, drawbar, rods with collars, lugs of the jaws' rocker."""
    shape, by, track = weaver.shape, weaver.grippers, opener_track(weaver)
    holes: tuple[complex, ...] = ()
    if not weaver.params.with_arms:
        holes = tuple(complex(hand * by.axis, weaver.tool_bodies.tied + hand * by.lift / 2) for hand in (-1, 1))
    cheeks, pin = drawbar(weaver, track, shape.carriage + BAR)
    if weaver.params.with_arms:  # beside the opener, for its feet
        (bottom, top), (_, wide, high) = _levels(weaver), OPENER_FOOT
        levels = (bottom - high / 2, top + high / 2)
        cut = *cheeks, Placed(box(wide, high, BAR), tuple(placement(y=y, z=shape.carriage) for y in levels))
    else:
        cut = *cheeks, lugs(weaver, SIDE_GRASP, shape.carriage, (station(weaver, track), by.axis + LUG_END))
    yield _with(_at(_cross_bar(weaver, track, holes), 0j, shape.carriage), cut)
    yield pin
    behind = shape.partition + PARTITION + longest(weaver, track) - weaver.tool_bodies.tools.back
    rods, begin = _rods(weaver), shape.carriage + BAR
    yield _several(_made("carriage-rod", "rod of the side carriage", bar(ROD, behind + COLLAR - begin)), rods, begin)
    ring = tube(2.2 * ROD, 0.6 * ROD, COLLAR)
    yield _several(_made("carriage-collar", "collar of a carriage's rod", ring), rods, behind)
    if not weaver.params.with_arms:
        yield from jaw_springs(weaver, SIDE_GRASP)


def _cross_bar(weaver: Weaver, track: str, holes: tuple[complex, ...]) -> Part:
    """A plate across behind the opener, and below it a tab for drawbar and rocker."""
    bottom, top = _levels(weaver)
    plane = weaver.params.cam_thickness / 2
    side, low = station(weaver, track), weaver.shape.levers[track].pin.imag - DRAWBAR
    left, right = side - plane, max(side + plane, weaver.grippers.axis + LUG_END)
    half = max(weaver.tool_bodies.opener_half, 1 * mm - left, right + 1 * mm, RODS[1] + ROD)
    corners = [
        *(complex(left, low), complex(right, low), complex(right, bottom), complex(half, bottom)),
        *(complex(half, top), complex(-half, top), complex(-half, bottom), complex(left, bottom)),
    ]
    bores = [circle(hole, weaver.params.finger / 2) for hole in holes]
    if weaver.params.with_arms:
        bores.append(bar_hole(weaver.tool_bodies).contour)
    if holes:  # the centre gripper passes
        bores.append(
            polygon(rectangle(2 * weaver.params.finger, 2 * weaver.params.finger).points + 1j * _centre_height(weaver))
        )
    section = Profile(polygon(np.array(corners)), tuple(bores))
    return _plate("cross-bar", "cross bar of the side carriage", section, BAR)


def _centre_carriage(weaver: Weaver) -> Iterator[Occurrence]:
    """Block on the centre gripper, drawbar, rod through the partition, lugs of the jaws' rocker."""
    front, height = weaver.tool_bodies.tools.centre_carriage, _centre_height(weaver)
    plane, side = weaver.params.cam_thickness / 2, station(weaver, CENTRE_MOTION)
    low, axle = weaver.shape.levers[CENTRE_MOTION].pin.imag - DRAWBAR, rocker(weaver, CENTRE_GRASP).axle.imag
    inner, outer = side - plane, side + plane
    left, right = min(inner - 1 * mm, -3 * LUG), max(outer + 1 * mm, 3 * LUG)
    bottom, top = axle - 3 * mm, height + ABOVE_CENTRE + ROD
    shoulder = bottom + 9 * mm
    corners = [
        *(complex(inner, low), complex(outer, low), complex(outer, bottom), complex(right, bottom)),
        *(complex(right, shoulder), complex(HIGH, shoulder), complex(HIGH, top), complex(-HIGH, top)),
        *(complex(-HIGH, shoulder), complex(left, shoulder), complex(left, bottom), complex(inner, bottom)),
    ]
    bore = circle(1j * height, weaver.params.finger / 2)
    section = Profile(polygon(np.array(corners)), (bore,))
    block = _plate("centre-block", "carriage of the centre gripper", section, CENTRE_BAR)
    cheeks, pin = drawbar(weaver, CENTRE_MOTION, front)
    cut = *cheeks, lugs(weaver, CENTRE_GRASP, front, (-LUG, 1.5 * LUG))
    yield _with(_at(replace(block, notes=(Sentence("sheet.bonded"),)), 0j, front), cut)
    yield pin
    begin = weaver.shape.partition - NUT
    rod = _made("centre-rod", "rod of the centre gripper's carriage", bar(ROD, front - begin))
    yield _at(rod, 1j * (height + ABOVE_CENTRE), begin)
    yield from jaw_springs(weaver, CENTRE_GRASP)


def screw_id(name: str) -> str:
    """Id of the screw that turns a side gripper, by the id of its body."""
    return part_id(f"{'left' if name == LEFT else 'right'}-screw")


def _screw(weaver: Weaver, name: str, hand: int) -> Occurrence:
    """The twisted bar of a side gripper, in its frame: at each travel its section in the nut is level."""
    by, shape = weaver.grippers, weaver.shape
    begin = weaver.tool_bodies.end(name)
    straight = shape.partition + PARTITION + NUT / 2 - begin + by.opening
    stations = (0.0, straight, straight + by.crossing, straight + by.crossing + 2 * NUT)
    part = Part(
        screw_id(name),
        f"{'left' if hand < 0 else 'right'} side gripper's twisted bar",
        "machined link",
        TwistedBar(SCREW, stations, (0.0, 0.0, -hand * by.turn, -hand * by.turn)),
        STEEL,
        joins=(SIDE_GRIPPER,),
        throat=ROD_WELD,
    )
    return Occurrence(part, (placement(z=begin - weaver.tool_bodies.tip(name)),))


def _nut(weaver: Weaver) -> Occurrence:
    """A plate behind the partition with a square hole for each twisted bar."""
    by, tied, side = weaver.grippers, weaver.tool_bodies.tied, SCREW + 2 * IN_NUT
    holes = [complex(hand * by.axis, tied + hand * by.lift / 2) for hand in (-1, 1)]
    squares = apart([_around(hole, side / 2) for hole in holes])
    outline = rectangle(2 * by.axis + side + 4 * mm, by.lift + side + 3 * mm).points + 1j * tied
    plate = Prism(Profile(polygon(outline), tuple(each.contour for each in squares)), NUT)
    (wide, high, thick), half = EAR, float(outline.real.max())
    ears = (
        Placed(box(wide, high, thick), (placement(x, tied + high / 4),)) for x in (-half - wide / 2, half + wide / 2)
    )
    part = replace(_made("nut", "nut of the twisted bars", Sum((Placed(plate), *ears))), process="machined link")
    return _at(part, 0j, weaver.shape.partition + PARTITION)


def _partition(weaver: Weaver) -> Occurrence:
    """The plate across the case, with a hole for all that passes; lower at the right, where the handler's shaft is."""
    shape, at, by = weaver.shape, pivot(weaver), weaver.grippers
    track = opener_track(weaver)
    top = (shape.body + shape.size).imag - sheet(weaver)
    low = shape.levers[track].pin.imag + DRAWBAR + 8 * mm
    sley, bottom = shape.levers[SLEY], min(at.imag, low) - HANDLER_SHAFT
    over = sley.pivot.imag + abs(sley.pivot.real - shape.partition) * sley.lift / 2 / sley.arm + 2 * HALF
    beside = min(station(weaver, SLEY) + weaver.params.cam_thickness / 2 + 0.5 * mm, RODS[0] - ROD)
    inner = max(stack_width(weaver.params) / 2, RODS[1] + ROD, at.real + HANDLER_SHAFT)
    split = at.real - HANDLER_SHAFT
    left = [complex(-inner, top), complex(-inner, over), complex(beside, over)]
    corners = [
        *(complex(split, bottom), complex(inner, bottom), complex(inner, top)),
        *(left if over < top - SUPPORT and beside > -inner else [complex(beside, top)]),
        *(complex(beside, low), complex(split, low)),
    ]
    guides = [
        *(_around(rod, ROD / 2, round_=True) for rod in _rods(weaver)),
        _around(at, HANDLER_SHAFT / 2, round_=True),
    ]
    if weaver.params.with_arms:
        guides.append(bar_hole(weaver.tool_bodies))
    else:
        tied, height, room = weaver.tool_bodies.tied, _centre_height(weaver), SCREW / 2 * 1.5
        guides += [
            GuideHole(
                complex(-by.axis - room, tied - by.lift / 2 - room), complex(by.axis + room, tied + by.lift / 2 + room)
            ),
            _around(1j * height, weaver.params.finger / 2, round_=True),
            _around(1j * (height + ABOVE_CENTRE), (SPIGOT if _has_seat(weaver) else ROD) / 2, round_=True),
        ]
    plate = GuideHole(complex(beside, low), complex(inner, top))
    within = [guide for guide in apart(guides) if guide.within(plate) or guide.round]
    section = Profile(polygon(np.array(corners)), tuple(guide.contour for guide in within))
    return _at(_plate("partition", "plate across behind the carriages", section, PARTITION), 0j, shape.partition)


def _sley_block(weaver: Weaver) -> Iterator[Occurrence]:
    """The block on the sley's rod, with a lug to which the arm is screwed, and the cheeks of its lever's pin."""
    tool, plane, side = weaver.tool_bodies.tools.tool(SLEY_TOOL), weaver.params.cam_thickness / 2, station(weaver, SLEY)
    room, (before, lap, wide) = max(plane, 0.7 * ROD), SLEY_LUG
    arm = -weaver.tool_bodies.sley_arm + SLEY_ARM / 2
    hand = 1 if arm < side else -1  # of the lug beside the arm: where the rod is
    beside, edge = hand * arm + SLEY_ARM / 2, max(hand * side + room, hand * arm + SLEY_ARM / 2 + wide)
    far = min(hand * side - room, hand * arm - SLEY_ARM / 2)
    end = (tool.corner + tool.size).real
    lug = [complex(lap, beside), complex(-before, beside), complex(-before, edge)]
    corners = np.array([complex(SLEY_BLOCK, far), complex(SLEY_BLOCK, edge), *reversed(lug), complex(lap, far)])
    outline = polygon(corners if hand > 0 else np.conj(corners)[::-1])
    section = Profile(outline, (circle(complex(SLEY_BLOCK / 2, side), ROD / 2),))
    part = _plate("sley-block", "block of the sley", section, SLEY_HEIGHT)
    pin = complex(end + SLEY_BLOCK + SLEY_PIN, tool.corner.imag + SLEY_HEIGHT / 2)
    cheeks, in_lever = pinned(weaver, SLEY, pin, -SLEY_PIN)
    yield _with(Occurrence(part, (placement(0.0, tool.corner.imag, end).after(UPRIGHT),)), cheeks)
    yield in_lever


def _sley_rod(weaver: Weaver) -> Iterator[Occurrence]:
    """The rod of the sley's block, pressed into its support on the left side plate, to the upper plate; its spring."""
    tool, side = weaver.tool_bodies.tools.tool(SLEY_TOOL), station(weaver, SLEY)
    inner, wall = stack_width(weaver.params) / 2, ROD / 2 + LEAST_WALL
    depth = (tool.corner + tool.size).real + SLEY_BLOCK / 2
    foot = tool.corner.imag - longest(weaver, SLEY)
    top = (weaver.shape.body + weaver.shape.size).imag - sheet(weaver)
    right = side + max(weaver.params.cam_thickness / 2, wall)
    pressed = side + inner > wall  # else it stands on the support
    begin = foot - SUPPORT if pressed else foot
    rod = _made("sley-rod", "rod of the sley", bar(ROD, top - begin))
    yield Occurrence(rod, (placement(side, begin, depth).after(UPRIGHT),))
    seat = (circle(1j * (side - (right - inner) / 2), ROD / 2),) if pressed else ()
    section = Profile(rectangle(SLEY_BLOCK, right + inner), seat)
    support = _plate("sley-support", "support of the sley's rod", section, SUPPORT)
    yield Occurrence(support, (placement((right - inner) / 2, foot - SUPPORT, depth).after(UPRIGHT),))
    if (spring := spring_part(weaver, SLEY)) is not None:
        yield Occurrence(spring, (placement(side, foot, depth).after(UPRIGHT),))


def _springs(weaver: Weaver) -> Iterator[Occurrence]:
    """The springs on the partition about the carriages' rods, and that of the handler under the upper plate."""
    behind, track = weaver.shape.partition + PARTITION, opener_track(weaver)
    if (spring := spring_part(weaver, track)) is not None:
        yield _several(spring, _rods(weaver), behind)
    if (spring := spring_part(weaver, HANDLER)) is not None:
        under = (weaver.shape.body + weaver.shape.size).imag - sheet(weaver) - shortest(weaver, HANDLER)
        line = weaver.shape.axis.real
        yield Occurrence(spring, (placement(station(weaver, HANDLER), under, line).after(UPRIGHT),))
    if not _has_seat(weaver) or (spring := spring_part(weaver, CENTRE_MOTION)) is None:
        return
    end = weaver.tool_bodies.tools.centre_carriage - longest(weaver, CENTRE_MOTION)
    seat = _made(
        "spring-seat", "seat of the centre gripper's spring", bored(ROD, (SPIGOT, PARTITION), (SEAT, end - behind))
    )
    axis = 1j * (_centre_height(weaver) + ABOVE_CENTRE)
    yield _at(seat, axis, behind - PARTITION)
    yield _at(spring, axis, end)


def _has_seat(weaver: Weaver) -> bool:
    """Whether the centre gripper's spring stands on a seat, which then guides the rod through the partition."""
    return not weaver.params.with_arms and spring_part(weaver, CENTRE_MOTION) is not None


def _with(stands: Occurrence, cut: tuple[Placed, ...]) -> Occurrence:
    """A part at its one position, with what is cut from the same piece, in the axes of the head."""
    back, shape = stands.positions[0].inverse, stands.part.shape
    assert shape is not None
    others = (Placed(each.shape, tuple(back.after(position) for position in each.positions)) for each in cut)
    return replace(stands, part=replace(stands.part, shape=Sum((Placed(shape), *others))))


def _around(at: complex, half: float, *, round_: bool = False) -> GuideHole:
    return GuideHole(at - complex(half, half), at + complex(half, half), round_)


def _at(part: Part, at: complex, depth: float) -> Occurrence:
    """A part in the front view, x + i y, at a distance from the warps [m]."""
    return _several(part, (at,), depth)


def _several(part: Part, places: tuple[complex, ...], depth: float) -> Occurrence:
    return Occurrence(part, tuple(placement(at.real, at.imag, depth) for at in places))


def _plate(name: str, title: str, section: Profile, thickness: float) -> Part:
    """A plate of aluminium."""
    return Part(part_id(name), title, "machined link", Prism(section, thickness), ALUMINIUM)


def _made(name: str, title: str, shape: Shape) -> Part:
    return Part(part_id(name), title, "pin or bush", shape, STEEL)
