"""What closes a head's case, and joins it to its carriage: the face with the tools' guides, plates across, the bracket.

Axes of the scene: x along the row, y up from the fell, z to the front from the warps. The face stands before the side
plates, and guides each tool in a bore or slot of its own section. The plates across close the case at its bottom and
top, between the side plates. The bracket leads from the side plates, below the magazine, to the axis of the rail.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ilmek.elements.materials import MATERIALS
from ilmek.machines.weaver.cutter_motor import HUB
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.head_shape import LOWER_PLATE, RAIL_AXIS, SLEY_HEIGHT, SLEY_TOOL, UPPER_PLATE
from ilmek.machines.weaver.knife import PLAY, eye_at, eye_diameter, shaft_at
from ilmek.machines.weaver.motions import CENTRE_ARM
from ilmek.machines.weaver.stations import sheet
from ilmek.machines.weaver.tool_parts import HANDLER_SHAFT, SLEY_ARM, ToolBodies, part_id
from ilmek.machines.weaver.turning import pivot
from ilmek.machines.weaver.widths import case_width, stack_width
from ilmek.part.part import Part
from ilmek.part.placement import UPRIGHT, Placement, placement
from ilmek.part.profile import Profile, drilled
from ilmek.part.shapes import Placed, Prism, Shape, Sum, box, rectangle
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import circle, polygon
from ilmek.report import Contour, Hole
from ilmek.units import mm

ALUMINIUM = MATERIALS["aluminium alloy"]

FACE, CROSS_PLATE, TOP_PLATE, BRACKET = (
    part_id("face"),
    part_id("cross-plate"),
    part_id("top-plate"),
    part_id("bracket"),
)
"""Ids of the parts."""

EDGE, WEB = 6 * mm, 0.3 * mm
"""From a guide to the edge of the face, and between two guides, at least [m]; assumed by this project."""

BRACKET_WALL = 5 * mm
"""Wall of the bracket [m]; assumed by this project."""

BRACKET_ENDS = (20 * mm, 6 * mm, 8 * mm)
"""Height and thickness of the bracket's flange on the side plates, thickness of its plate on the carriage [m]; assumed
by this project.
"""


def closing_parts(weaver: Weaver) -> Iterator[Occurrence]:
    """Face, plates across and bracket of a head that has side plates."""
    thick = sheet(weaver)
    if thick <= 0:
        return
    shape = weaver.shape
    low, high = shape.body, shape.body + shape.size
    face = _made(FACE, "face of the head with the tools' guides", _face(weaver))
    yield Occurrence(face, (placement(z=low.real),))
    flat = box(stack_width(weaver.params), thick, shape.size.real - thick)
    heights = [low.imag + thick / 2, high.imag - thick / 2]
    across = _made(CROSS_PLATE, "plate across the head", flat)
    if weaver.params.with_arms and weaver.params.arms.servo_depth > 0:
        over = _made(TOP_PLATE, "plate over the head", _bored(weaver, thick))
        yield Occurrence(over, (_level(heights.pop()),))
    yield Occurrence(across, tuple(placement(y=y, z=low.real + thick) for y in heights))
    wide = case_width(weaver.params)
    wall = min(BRACKET_WALL, wide / 4)
    inner = rectangle(wide - 2 * wall, RAIL_AXIS - 2 * wall)
    long, (up, flange, end) = shape.front - high.real, BRACKET_ENDS
    section = Profile(rectangle(wide, RAIL_AXIS), (inner,))
    members = (
        Placed(Prism(section, long - end)),
        Placed(box(wide, up, flange), (placement(y=(RAIL_AXIS + up) / 2),)),
        Placed(box(wide, RAIL_AXIS, end), (placement(z=long - end),)),
    )
    bracket = _made(BRACKET, "bracket of the head on its carriage", Sum(members))
    yield Occurrence(bracket, (placement(y=shape.rail, z=high.real),))


def _level(height: float) -> Placement:
    """A plate in plan, its x to the front from the warps, at the height of its middle [m]."""
    return placement(0.0, height).after(UPRIGHT)


def _bored(weaver: Weaver, thick: float) -> Sum:
    """The plate over the case, in plan as the opener's, with bores for the shafts of the arms' servos."""
    shape, arms = weaver.shape, weaver.params.arms
    front, back = shape.body.real + thick, (shape.body + shape.size).real
    outline = rectangle(back - front, stack_width(weaver.params)).points + (front + back) / 2
    bores = [
        Hole(complex(depth, side * arms.servo_aside), arms.servo_shaft / 2)
        for depth in sorted({arms.servo_depth, arms.servo_depth + arms.servo_pitch})
        for side in (-1, 1)
    ]
    return Sum((Placed(Prism(drilled(polygon(outline), bores), thick), (placement(z=-thick / 2),)),))


class GuideHole(NamedTuple):
    """A guide in a plate, seen along the tools: its lower left and upper right corner [m]; round: a bore."""

    low: complex
    high: complex
    round: bool = False

    def meets(self, other: "GuideHole") -> bool:
        """Whether less than a web is between this guide and another."""
        apart = max(self.low.real - other.high.real, other.low.real - self.high.real)
        above = max(self.low.imag - other.high.imag, other.low.imag - self.high.imag)
        return max(apart, above) < WEB

    def within(self, room: "GuideHole") -> bool:
        """Whether it is in a room with a web around it."""
        low, high = self.low - room.low, room.high - self.high
        return min(low.real, low.imag, high.real, high.imag) >= WEB

    def with_other(self, other: "GuideHole") -> "GuideHole":
        """One window in place of two guides."""
        low = complex(min(self.low.real, other.low.real), min(self.low.imag, other.low.imag))
        return GuideHole(low, complex(max(self.high.real, other.high.real), max(self.high.imag, other.high.imag)))

    @property
    def contour(self) -> Contour:
        """Its edge in the face."""
        middle, size = (self.low + self.high) / 2, self.high - self.low
        if self.round:
            return circle(middle, size.imag / 2)
        return polygon(middle + rectangle(size.real, size.imag).points)


def _face(weaver: Weaver) -> Prism:
    """A plate over the case, wider where the opener or the sley needs it."""
    params, shape = weaver.params, weaver.shape
    axle = pivot(weaver)
    shaft = GuideHole(axle - complex(1, 1) * HANDLER_SHAFT / 2, axle + complex(1, 1) * HANDLER_SHAFT / 2, round=True)
    guides = apart((*_guides(weaver.tool_bodies), shaft, *_of_the_knife(weaver)))
    low = complex(min(guide.low.real for guide in guides), min(guide.low.imag for guide in guides))
    high = complex(max(guide.high.real for guide in guides), max(guide.high.imag for guide in guides))
    half = case_width(params) / 2
    side = max(half, EDGE - low.real, EDGE + high.real)
    bottom = min(shape.body.imag, low.imag - EDGE)
    top = max((shape.body + shape.size).imag, high.imag + EDGE)
    outline = np.array([complex(-side, bottom), complex(side, bottom), complex(side, top), complex(-side, top)])
    return Prism(Profile(polygon(outline), tuple(guide.contour for guide in guides)), sheet(weaver))


def _guides(by: ToolBodies) -> Iterator[GuideHole]:
    """Bores and slots, each of a tool's own section."""
    params, grippers, half = by.params, by.grippers, by.opener_half
    for name in (LOWER_PLATE, UPPER_PLATE):
        plate = by.tools.tool(name)
        yield GuideHole(complex(-half, plate.corner.imag), complex(half, (plate.corner + plate.size).imag))
    sley = by.tools.tool(SLEY_TOOL).corner.imag
    low, high = sley - params.sley_stroke, sley + SLEY_HEIGHT
    yield GuideHole(complex(-by.sley_arm, low), complex(SLEY_ARM - by.sley_arm, high))
    if params.with_arms:
        yield bar_hole(by)
        return
    finger = complex(1, 1) * grippers.finger / 2
    for hand in (-1, 1):
        rod = complex(hand * grippers.axis, by.tied + hand * grippers.lift / 2)
        yield GuideHole(rod - finger, rod + finger, round=True)
    centre = 1j * (by.tied + grippers.height)
    yield GuideHole(centre - finger, centre + finger)


def _of_the_knife(weaver: Weaver) -> Iterator[GuideHole]:
    """Bores for the eye of the yarn and for the hub of the cutter's eccentric."""
    for centre, radius in ((eye_at(weaver), eye_diameter(weaver) / 2), (shaft_at(weaver), HUB / 2 + PLAY)):
        yield GuideHole(centre - complex(radius, radius), centre + complex(radius, radius), round=True)


def bar_hole(by: ToolBodies) -> GuideHole:
    """The guide of the bar of the arms' centre gripper."""
    arm, arms = by.tools.tool(CENTRE_ARM), by.params.arms
    half = complex(arms.bar_width, arms.bar_height) / 2
    middle = 1j * (arm.corner + arm.size / 2).imag
    return GuideHole(middle - half, middle + half)


def apart(guides: Sequence[GuideHole]) -> tuple[GuideHole, ...]:
    """The guides, those without a web between them as one window, which guides nothing."""
    kept: list[GuideHole] = []
    for guide in guides:
        window = guide
        while (other := next((each for each in kept if each.meets(window)), None)) is not None:
            kept.remove(other)
            window = window.with_other(other)
        kept.append(window)
    return tuple(kept)


def _made(name: str, title: str, shape: Shape) -> Part:
    return Part(name, title, "machined link", shape, ALUMINIUM)
