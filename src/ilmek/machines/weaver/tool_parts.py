"""The head's tools as parts and bodies: grippers, opener, sley, pile handler and knife.

Axes of the head as in the scene: x along the row to the weaver's right, 0 in the middle of the pair; y along the warps,
up from the fell; z to the front, 0 at the axes of the warps.

A plate of the opener, in plan: a point enters between two warps on each side of the pair, and one between the pair,
where the pair is widened. Over the travel q the walls, which the warps touch, spread them evenly from where they stand
to where the tools work (`opener`); beyond it teeth of the width of `wall` hold them. Behind the teeth it is whole.
"""

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ilmek.machines.weaver.grippers import Grippers
from ilmek.machines.weaver.head_shape import LOWER_PLATE, SLEY_TOOL, UPPER_PLATE, HeadTool, HeadTools
from ilmek.machines.weaver.motions import CENTRE_MOTION, HANDLER, OPENER, SIDE_MOTION, SLEY
from ilmek.machines.weaver.opener import STEEL, Opener
from ilmek.machines.weaver.params import WeaverParams
from ilmek.part.part import Bought, Part
from ilmek.part.placement import ALONG_WIDTH, IDENTITY, IN_SIDE_VIEW, UPRIGHT, Placement, placement
from ilmek.part.profile import Profile, drilled
from ilmek.part.shapes import Placed, Prism, Shape, Sum, bar, box
from ilmek.part.tree import GROUND, Joint, JointKind, Occurrence, RigidBody
from ilmek.plane.contours import bounds, polygon, rounded_hull
from ilmek.records import record
from ilmek.report import Hole
from ilmek.units import format_quantity, mm

HANDLER_ARM = (12 * mm, 4 * mm)
"""Width and thickness of the pile handler's arm [m]; assumed by this project."""

SLEY_FOOT, SLEY_ARM, BESIDE_SLEY = 6 * mm, 3 * mm, 3 * mm
"""Depth of the sley's foot over the pair, at most, width of its arm, and from the opener to it [m]; assumed by this
project."""

KNIFE = (10 * mm, 2 * mm, 20 * mm)
"""Room of the cutter's blade with its slide, across, along the warps and to the front [m]; assumed by this project."""

BESIDE = 10 * mm
"""From the outermost wall of the opener to the pile handler's arm [m]; assumed by this project."""

_ALONG = (0.0, 0.0, 1.0)


def part_id(name: str) -> str:
    """Id of a part or a body of the head."""
    return f"weaver/{name}"


SIDE_GRIPPER, CENTRE_GRIPPER = part_id("side-gripper"), part_id("centre-gripper")
OPENER_PLATE, SLEY_BAR = part_id("opener-plate"), part_id("sley")
PILE_HANDLER, KNIFE_PART = part_id("pile-handler"), part_id("knife")
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
        tied = () if self.params.with_arms else (*self._side_grippers(parent), self._centre(parent))
        return (
            *tied,
            (opener_track, _sliding(PLATES, self._plates(), parent)),
            (SLEY, _sliding(SLEY_BODY, (self._sley(),), parent)),
            (HANDLER, self._handler(parent)),
        )

    def moved(self, track: str) -> float:
        """Mass that the cam of a track moves [kg]: the parameter's, or that of the tool where it is heavier."""
        return max(self.params.tool_mass, self.of_track(track))

    def of_track(self, track: str) -> float:
        """Mass of the parts that a track moves [kg]; of the handler as if all at its tip."""
        return _masses(self).get(track, 0.0)

    @property
    def tied(self) -> float:
        """Height at which the knot is tied [m]: the middle of both side grippers' rods."""
        params, by = self.params, self.grippers
        return float(params.opener.front_span + params.clearance + (by.lift + by.finger) / 2)

    def _side_grippers(self, parent: str) -> tuple[tuple[str, RigidBody], ...]:
        """Two alike, one turned half round: a rod to the front from its tip, and an arm across it to the outside."""
        by, reach = self.grippers, self.tools.tool("side grippers").size.real
        half = by.finger / 2
        rod = Placed(bar(by.finger, reach + half), (placement(z=-half),))
        arm = (Placed(bar(by.finger, by.arm - half), (placement(half).after(ALONG_WIDTH),)),) if by.arm > half else ()
        part = _made(SIDE_GRIPPER, "side gripper", "machined link", Sum((rod, *arm)), _round(by.finger))
        front = by.front + by.opening

        def body(name: str, hand: int) -> tuple[str, RigidBody]:
            turned = placement(about=_ALONG, angle=math.pi if hand < 0 else 0.0)
            origin = placement(hand * by.axis, self.tied + hand * by.lift / 2, front)
            joint = Joint(JointKind.SCREW, _ALONG)
            return SIDE_MOTION, RigidBody(name, (Occurrence(part, (turned,)),), parent, joint, (origin,))

        return body(LEFT, -1), body(RIGHT, 1)

    def _centre(self, parent: str) -> tuple[str, RigidBody]:
        by = self.grippers
        length = self.tools.tool("centre gripper").size.real
        size = f"square {format_quantity(by.finger, 'mm')}"
        part = _made(CENTRE_GRIPPER, "centre gripper", "steel bar", box(by.finger, by.finger, length), size)
        origin = placement(0.0, self.tied + by.height, by.stroke - by.depth)
        return CENTRE_MOTION, _sliding(CENTRE, (Occurrence(part),), parent, origin)

    def _plates(self) -> tuple[Occurrence]:
        """Both plates, alike."""
        low, high = self.tools.tool(LOWER_PLATE), self.tools.tool(UPPER_PLATE)
        thick = low.size.imag
        part = _made(
            OPENER_PLATE,
            "plate of the warp opener",
            "machined link",
            Prism(self._comb(low), thick),
            f"{format_quantity(thick, 'mm')} thick",
        )
        return (Occurrence(part, tuple(_upright(tool) for tool in (low, high))),)

    def _comb(self, tool: HeadTool) -> Profile:
        """A plate in plan, its x to the front from the points, its y along the row."""
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
        half = np.array(side)
        return Profile(polygon(np.concatenate([half, np.conj(half[::-1])])))

    def _sley(self) -> Occurrence:
        """A foot over the pair that passes before the opener's points; its arm goes beside the opener into the face."""
        tool, rest = self.tools.tool(SLEY_TOOL), self.tools.tool(LOWER_PLATE).corner.real
        half, outer, deep = self.grippers.axis, self.sley_arm, tool.size.real
        foot = min(max(rest - tool.corner.real - self.params.clearance, self.params.finger), SLEY_FOOT)
        inner = outer - SLEY_ARM
        corners = [1j * half, foot + 1j * half, foot - 1j * inner, deep - 1j * inner, deep - 1j * outer, -1j * outer]
        size = f"{format_quantity((half + outer) / mm, '')} x {format_quantity(tool.size.imag, 'mm')}"
        shape = Prism(Profile(polygon(np.array(corners))), tool.size.imag)
        part = _made(SLEY_BAR, "sley", "machined link", shape, size)
        return Occurrence(part, (_upright(tool),))

    @property
    def sley_arm(self) -> float:
        """From the middle of the pair to the outer side of the sley's arm, on the weaver's left [m]."""
        return max(self.opener_half, self.grippers.axis) + BESIDE_SLEY + SLEY_ARM

    @property
    def opener_half(self) -> float:
        """Half the width of a plate of the opener [m]."""
        return bounds(self._comb(self.tools.tool(LOWER_PLATE)).outline)[1].imag

    def _handler(self, parent: str) -> RigidBody:
        """The arm on its pinion's shaft, and the knife; how they are held is not designed."""
        params, (wide, thick) = self.params, HANDLER_ARM
        eye = params.pinion + wide / 2
        outline = rounded_hull(np.array([0j, 1j * self.radius]), eye)
        section = drilled(outline, [Hole(0j, params.pinion, "pinion")])
        arm = _made(PILE_HANDLER, "pile handler", "machined link", Prism(section, thick), f"{_mm(thick)} thick")
        across, along, deep = KNIFE
        knife = Part(
            KNIFE_PART,
            "knife with its slide",
            "machined link",
            shape=box(across, along, deep),
            purchase=Bought("blade and slide", params.forces.cutter_mass),
            envelope=True,
        )
        beside = self.opener.aside + BESIDE
        pivot = placement(beside + thick, self.tied, self.tools.face - eye).after(IN_SIDE_VIEW)
        below = placement(beside - across / 2, self.tied - along, self.tools.face - deep)
        return RigidBody(
            part_id("pile handler and knife"),
            (Occurrence(arm, (pivot,)), Occurrence(knife, (below,))),
            parent,
        )


class _Wall(NamedTuple):
    """From the middle of the pair to a wall [m]: where the warps begin to bear on it, and after the whole travel."""

    first: float
    last: float

    def at(self, share: float) -> float:
        """Where it is at a share of the travel [m]."""
        return self.first + share * (self.last - self.first)


@lru_cache(maxsize=8)
def _masses(made: ToolBodies) -> Mapping[str, float]:
    """Mass that each track moves [kg]."""
    masses: dict[str, float] = {}
    for track, body in made.bodies():
        masses[track] = masses.get(track, 0.0) + body.moments.zeroth
    return masses


def _sliding(name: str, occurrences: tuple[Occurrence, ...], parent: str, origin: Placement = IDENTITY) -> RigidBody:
    return RigidBody(name, occurrences, parent, Joint(JointKind.SLIDE, _ALONG), (origin,))


def _upright(tool: HeadTool, shift: float = 0.0) -> Placement:
    """Where a plate in plan lies: its x to the front from the tool's corner and a shift [m], its z up."""
    return placement(0.0, tool.corner.imag, tool.corner.real + shift).after(UPRIGHT)


def _made(name: str, title: str, process: str, shape: Shape, size: str) -> Part:
    return Part(name, title, process, size, shape, STEEL)


def _mm(length: float) -> str:
    return format_quantity(length, "mm")


def _round(diameter: float) -> str:
    return f"round {_mm(diameter)}"
