"""The head's tools as parts and bodies: grippers, opener, sley and pile handler.

Axes of the head as in the scene: x along the row to the weaver's right, 0 in the middle of the pair; y along the warps,
up from the fell; z to the front, 0 at the axes of the warps.

A plate of the opener, in plan: a point enters between two warps on each side of the pair, and one between the pair,
where the pair is widened. Over the travel q the walls, which the warps touch, spread them evenly from where they stand
to where the tools work (`opener`); beyond it teeth of the width of `wall` hold them. Behind the teeth it is whole.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ilmek.elements.materials import MATERIALS
from ilmek.machines.weaver.grippers import Grippers
from ilmek.machines.weaver.head_shape import (
    BAR,
    COLLARS,
    HANDLER_ARM,
    LOWER_PLATE,
    OPENER_FOOT,
    SLEY_TOOL,
    UPPER_PLATE,
    HeadTool,
    HeadTools,
)
from ilmek.machines.weaver.jaw_hinge import JawHinge
from ilmek.machines.weaver.motions import CENTRE_MOTION, HANDLER, OPENER, SIDE_MOTION, SLEY
from ilmek.machines.weaver.opener import STEEL, Opener
from ilmek.machines.weaver.params import WeaverParams
from ilmek.machines.weaver.rods import wall_of
from ilmek.machines.weaver.widths import stack_width
from ilmek.part.part import Part
from ilmek.part.placement import ALONG_WIDTH, IDENTITY, UPRIGHT, Placement, placement
from ilmek.part.profile import Profile, drilled
from ilmek.part.shapes import Placed, Prism, Shape, Sum, bar, box, tube
from ilmek.part.tree import GROUND, Axis, Joint, JointKind, Occurrence, RigidBody
from ilmek.plane.contours import bounds, polygon, rounded_hull
from ilmek.records import record
from ilmek.report import Hole
from ilmek.units import mm

HANDLER_SHAFT = 4 * mm
"""Diameter of the pile handler's shaft [m]; assumed by this project."""

JAW, WIRE = 8 * mm, 0.9 * mm
"""Length of a side gripper's jaws, and diameter of their wires, at most [m]; assumed by this project."""

SLEY_FOOT, SLEY_ARM, BESIDE_SLEY = 6 * mm, 3 * mm, 3 * mm
"""Depth of the sley's foot over the pair, at most, width of its arm, and from the opener to it [m]; assumed by this
project."""

SLEY_LUG = 5 * mm, 2 * mm, 6 * mm
"""How far the lug of the sley's block beside the arm reaches before and behind its front, and its width [m]; assumed by
this project.
"""

CARRIED = 0.1
"""Mass of carriage, lever and follower beside a tool for which a cam is designed [kg]; a check compares it."""

CENTRE_BAR, WINDOW = 8 * mm, 4 * mm
"""Thickness of the centre gripper's carriage, and room about the jaws' collars in the opener's plates [m]; assumed by
this project."""

HARD_DRAWN, BRAZED = MATERIALS["hard-drawn stainless steel"], 0.1 * mm
"""Capillary tube, and throat of what is brazed to it [m]."""

_ALONG = (0.0, 0.0, 1.0)

TO_THE_TIP = placement(about=(0.0, 1.0, 0.0), angle=math.pi / 2)
"""The axes of the centre jaws' hinge in their gripper's."""


def part_id(name: str) -> str:
    """Id of a part or a body of the head."""
    return f"weaver/{name}"


SIDE_GRIPPER, CENTRE_GRIPPER = part_id("side-gripper"), part_id("centre-gripper")
OPENER_PLATE, SLEY_BAR = part_id("opener-plate"), part_id("sley")
PILE_HANDLER = part_id("pile-handler")
"""Ids of the parts."""

LEFT, RIGHT = part_id("left side gripper"), part_id("right side gripper")
CENTRE, PLATES, SLEY_BODY = part_id("centre gripper"), part_id("warp opener"), part_id("sley's slide")
"""Ids of the bodies that the knot's cyclogram moves."""


@record
class ToolBodies:
    """What a head's tools are designed from; drawn: length of the pile yarn of a knot, radius: of the handler [m]."""

    params: WeaverParams
    grippers: Grippers
    opener: Opener
    tools: HeadTools
    radius: float

    def bodies(self, parent: str = GROUND) -> tuple[tuple[str, RigidBody], ...]:
        """Each body with the track that moves it; parent: id of the body that guides them."""
        opener_track = OPENER if self.params.with_arms else SIDE_MOTION
        tied = () if self.params.with_arms else (*self._side_grippers(), self._centre(parent))
        return (
            (opener_track, _sliding(PLATES, self._plates(), parent)),
            *tied,
            (SLEY, _sliding(SLEY_BODY, (self._sley(),), parent, axis=(0.0, 1.0, 0.0))),
        )

    def moved(self, track: str) -> float:
        """Mass that the cam of a track may move [kg]: the parameter's, or more where the tool is heavy."""
        return max(self.params.tool_mass, self.of_track(track) + CARRIED)

    def of_track(self, track: str) -> float:
        """Mass of the parts that a track moves [kg]; of the handler as if all at its tip."""
        return _masses(self).get(track, 0.0)

    @property
    def tied(self) -> float:
        """Height at which the knot is tied [m]: the middle of both side grippers' rods."""
        params, by = self.params, self.grippers
        return float(params.opener.front_span + params.clearance + (by.lift + by.finger) / 2)

    def frame(self, name: str) -> Placement:
        """The frame of a carriage in the head's, by the id of its body."""
        return placement(0.0, self.tied + self.grippers.height, self.tip(CENTRE)) if name == CENTRE else IDENTITY

    def tip(self, name: str) -> float:
        """Where the tip of a gripper is at rest [m from the warps], by the id of its body."""
        by = self.grippers
        if name == CENTRE:
            return by.stroke - by.depth
        return by.front + by.opening + (by.stagger if name == RIGHT else 0.0)

    def end(self, name: str) -> float:
        """Where the rod of a side gripper ends at rest [m from the warps], by the id of its body."""
        return self.tools.carriage + BAR + self.tip(name) - self.tip(LEFT)

    @property
    def jaw(self) -> float:
        """Length of a side gripper's jaws [m]."""
        return min(JAW, 0.6 * max(self.grippers.arm - self.grippers.finger / 2, 0.0))

    def _side_grippers(self) -> tuple[tuple[str, RigidBody], ...]:
        """Two alike, one turned half round: a tube to the front from its tip, an arm brazed across it to the outside.

        They turn in the carriage of the opener. The arm's end is half as thick, beside the jaws' finger.
        """
        by, half, jaw = self.grippers, self.grippers.finger / 2, self.jaw
        length = self.end(LEFT) - self.tip(LEFT)
        rod = Placed(tube(by.finger, wall_of(self.params), length + half), (placement(z=-half),))
        members: list[Placed] = []
        if by.arm - jaw > half:
            members.append(Placed(bar(by.finger, by.arm - jaw - half), (placement(half).after(ALONG_WIDTH),)))
        pinned: tuple[Occurrence, ...] = ()
        if jaw > 0:
            hinge, root = JawHinge(jaw, by.finger), by.arm - jaw
            members.append(Placed(box(jaw, half, by.finger), (placement(by.arm - jaw / 2, -half / 2, -half),)))
            members.append(_moved(hinge.lugs, placement(root + hinge.root, half / 2)))
            pin = hinge.pin(part_id("side-finger-pin"), "pin of the side jaws' finger")
            pinned = (Occurrence(pin, (placement(root + hinge.root, half / 2, -half),)),)
        arm = (Occurrence(_brazed("side", SIDE_GRIPPER, members)),) if members else ()
        own = Occurrence(_capillary(SIDE_GRIPPER, "side gripper", rod)), *arm, *pinned
        joint = Joint(JointKind.PIN, _ALONG)

        def body(name: str, hand: int) -> tuple[str, RigidBody]:
            turned = placement(about=_ALONG, angle=math.pi if hand < 0 else 0.0)
            origin = placement(hand * by.axis, self.tied + hand * by.lift / 2, self.tip(name))
            parts = tuple(replace(one, positions=tuple(turned.after(at) for at in one.positions)) for one in own)
            return SIDE_MOTION, RigidBody(name, parts, PLATES, joint, (origin,))

        return body(LEFT, -1), body(RIGHT, 1)

    def _centre(self, parent: str) -> tuple[str, RigidBody]:
        """A tube to its carriage; brazed to its tip a head, half as thick beside the jaws' finger."""
        by, origin = self.grippers, self.frame(CENTRE)
        length, hinge = self.tools.centre_carriage + CENTRE_BAR - self.tip(CENTRE), JawHinge(JAW, by.finger)
        rod = Placed(tube(by.finger, wall_of(self.params), length - JAW), (placement(z=JAW),))
        jaw = Placed(box(by.finger, by.finger / 2, JAW), (placement(0.0, -by.finger / 4),))
        at = placement(0.0, by.finger / 4, JAW - hinge.root).after(TO_THE_TIP)
        head = _brazed("centre", CENTRE_GRIPPER, (jaw, _moved(hinge.lugs, at)))
        pin = hinge.pin(part_id("centre-finger-pin"), "pin of the centre jaws' finger")
        own = Occurrence(_capillary(CENTRE_GRIPPER, "centre gripper", rod)), Occurrence(head)
        parts = *own, Occurrence(pin, (at.after(placement(z=-by.finger / 2)),))
        return CENTRE_MOTION, _sliding(CENTRE, parts, parent, origin)

    def _plates(self) -> tuple[Occurrence]:
        """Both plates, alike, with feet on their carriage."""
        low, high = self.tools.tool(LOWER_PLATE), self.tools.tool(UPPER_PLATE)
        thick = low.size.imag
        part = _made(
            OPENER_PLATE,
            "plate of the warp opener",
            "machined link",
            Sum((Placed(Prism(self._comb(low), thick)), *self._feet(low))),
        )
        over = _upright(high, 0.0).after(placement(z=thick, about=(1.0, 0.0, 0.0), angle=math.pi))
        return (Occurrence(replace(part, yarns=True), (_upright(low), over)),)

    def _feet(self, plate: HeadTool) -> Iterator[Placed]:
        """One at each side of a plate towards the other; under one that is narrow, for arms, one on its outer side."""
        deep, wide, high = OPENER_FOOT
        back, aside = plate.size.real - deep / 2, self.opener_half - wide / 2
        if self.params.with_arms:
            yield Placed(box(deep, min(wide, 2 * self.opener_half), high), (placement(back, 0.0, -high),))
            return
        for y in (-aside, aside):
            yield Placed(box(deep, wide, wide), (placement(back, y, plate.size.imag),))

    def _comb(self, tool: HeadTool) -> Profile:
        """A plate in plan, its x to the front from the points, its y along the row; of grippers open at its end."""
        made, tip, deep = self.opener, self.params.opener.tip, tool.size.real
        pitch, radius = made.pitch, made.diameter / 2
        root = min(max(made.reach, made.travel), 0.9 * deep)
        ramp = min(made.travel, 0.9 * root)
        lead = min(pitch / 2, 0.1 * ramp)
        share = lead / ramp
        centre = _Wall(max(pitch / 2 - radius, tip), max(made.pair / 2 - radius, tip)) if made.pair > pitch else None
        inside = centre or _Wall(0.0, 0.0)
        outer = _Wall(
            max(1.5 * pitch - radius, inside.first + 2 * tip), max(made.aside - radius, inside.last + made.wall)
        )
        inner = _Wall(
            max(outer.first - made.wall, min(pitch / 2 + radius, outer.first - tip), inside.first + tip / 2),
            max(outer.last - made.wall, inside.last + tip / 2),
        )
        middle = (inner.first + outer.first) / 2
        side = [
            *(root + 1j * inner.last, ramp + 1j * inner.last, lead + 1j * inner.at(share), 1j * (middle - tip / 2)),
            *(1j * (middle + tip / 2), lead + 1j * outer.at(share), ramp + 1j * outer.last, deep + 1j * outer.last),
        ]
        if centre:
            side = [0.5j * tip, lead + 1j * centre.at(share), ramp + 1j * centre.last, root + 1j * centre.last, *side]
        notch = self.grippers.axis + WINDOW
        if not self.params.with_arms and notch < outer.last - WINDOW:  # in which the rocker of the jaws moves
            side += [deep + 1j * notch, deep - COLLARS + 1j * notch]
        half = np.array(side)
        return Profile(polygon(np.concatenate([half, np.conj(half[::-1])])))

    def _sley(self) -> Occurrence:
        """A foot over the pair that passes before the opener's points; its arm goes beside the opener into the face."""
        tool, rest = self.tools.tool(SLEY_TOOL), self.tools.tool(LOWER_PLATE).corner.real
        half, outer, deep = self.grippers.axis, self.sley_arm, tool.size.real
        if self.params.with_arms:
            rest = min(rest, self.params.arms.rest - self.params.arms.grip)
        foot = min(max(rest - tool.corner.real - self.params.clearance, self.params.finger), SLEY_FOOT)
        inner = outer - SLEY_ARM
        end = deep + SLEY_LUG[1]
        corners = [1j * half, foot + 1j * half, foot - 1j * inner, end - 1j * inner, end - 1j * outer, -1j * outer]
        shape = Prism(Profile(polygon(np.array(corners))), tool.size.imag)
        part = replace(_made(SLEY_BAR, "sley", "machined link", shape), yarns=True)
        return Occurrence(part, (_upright(tool),))

    @property
    def sley_arm(self) -> float:
        """From the middle of the pair to the outer side of the sley's arm, on the weaver's left [m]."""
        params = self.params
        cam = stack_width(params) / 2 - 2 * params.cam_gap - params.cam_thickness  # the next one beside its own
        arms = params.arms.beside if params.with_arms else 0.0
        tools = max(self.opener_half + BESIDE_SLEY, self.grippers.axis + BESIDE_SLEY)
        return max(tools, max(cam, arms) + params.clearance) + SLEY_ARM

    @property
    def opener_half(self) -> float:
        """Half the width of a plate of the opener [m]."""
        return bounds(self._comb(self.tools.tool(LOWER_PLATE)).outline)[1].imag

    @property
    def handler_arm(self) -> Part:
        """The pile handler's arm along x from its shaft."""
        radius, thick = HANDLER_ARM
        outline = rounded_hull(np.array([0j, self.radius + 0j]), radius)
        section = drilled(outline, [Hole(0j, HANDLER_SHAFT / 2, "shaft")])
        return _handler_part(Prism(section, thick))


@lru_cache(maxsize=8)
def _handler_part(shape: Prism) -> Part:
    return _made(PILE_HANDLER, "pile handler", "machined link", shape)


def _moved(member: Placed, position: Placement) -> Placed:
    """A member of a sum elsewhere."""
    return replace(member, positions=tuple(position.after(own) for own in member.positions))


def wire_of(params: WeaverParams) -> float:
    """Diameter of the jaws' wires [m]."""
    return min(WIRE, 0.45 * params.finger)


class _Wall(NamedTuple):
    """From the middle of the pair to a wall [m]: where the warps begin to bear on it, and after the whole travel."""

    first: float
    last: float

    def at(self, share: float) -> float:
        """Where it is at a share of the travel [m]."""
        return self.first + share * (self.last - self.first)


@lru_cache(maxsize=8)
def _masses(bodies: ToolBodies) -> Mapping[str, float]:
    """Mass that each track moves [kg]."""
    masses: dict[str, float] = {}
    for track, body in bodies.bodies():
        masses[track] = masses.get(track, 0.0) + body.moments.zeroth
    return {**masses, HANDLER: bodies.handler_arm.mass}


def _sliding(
    name: str, occurrences: tuple[Occurrence, ...], parent: str, origin: Placement = IDENTITY, axis: Axis = _ALONG
) -> RigidBody:
    return RigidBody(name, occurrences, parent, Joint(JointKind.SLIDE, axis), (origin,))


def _upright(tool: HeadTool, shift: float = 0.0) -> Placement:
    """Where a plate in plan lies: its x to the front from the tool's corner and a shift [m], its z up."""
    return placement(0.0, tool.corner.imag, tool.corner.real + shift).after(UPRIGHT)


def _capillary(name: str, title: str, rod: Placed) -> Part:
    """The tube of a gripper, drawn; a sum, of which the slot of its wire makes more members."""
    return Part(name, title, "steel tube", Sum((rod,)), HARD_DRAWN, machined=True)


def _brazed(kind: str, tube: str, members: Sequence[Placed]) -> Part:
    """The head of a gripper, brazed to its tube."""
    shape, title = Sum(tuple(members)), f"head of the {kind} gripper"
    return Part(part_id(f"{kind}-head"), title, "machined link", shape, STEEL, joins=(tube,), throat=BRAZED)


def _made(name: str, title: str, process: str, shape: Shape) -> Part:
    return Part(name, title, process, shape, STEEL)
