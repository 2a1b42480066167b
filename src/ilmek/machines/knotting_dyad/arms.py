"""The arms of a head as they are made: links, blades of the needles, grippers, pins; and their inertia.

The first link is a flat bar with round ends, the second one ends square where the blade of its needle is clamped. The
gripper at the tip, and what the elbow carries, are bought; their masses are parameters.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

from ilmek.dynamics.inertia import Inertia
from ilmek.elements.materials import MATERIALS
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation
from ilmek.machines.knotting_dyad.arm_drives import NAME, drive_levels, elbow_belt, elbow_pulley, sleeve
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.link_tree import Levels, LinkageParts, LinkSize, link_inertias, linkage_parts
from ilmek.part.flat_link import stepped_link
from ilmek.part.part import Bought, Part, Seat
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import drilled
from ilmek.part.shapes import Prism, box
from ilmek.part.tree import Occurrence
from ilmek.records import record
from ilmek.report import Hole
from ilmek.units import format_quantity

LEVELS = ((GROUND,), ("link 1",), ("link 2",))

SERVOS = (f"{NAME}/first-servo", f"{NAME}/second-servo")
"""Ids of the servos of first and second links."""

OF = "of an arm"
"""What links and pins belong to."""

BLADE, FLAT = MATERIALS["heat-treatable steel"], 1.2
"""Material of the blades; height of a gripper along the warps over a cube's of its mass, assumed by this project."""


@record
class Arm:
    """An arm as a mechanism, and the inertias of its links."""

    mechanism: Mechanism
    inertias: dict[str, Inertia]


def arm_mechanism(head: Head) -> Mechanism:
    """An arm with its pivot O in the origin, elbow E and tip P; inputs turn link 1, and 2 against it."""
    return Mechanism(
        name=NAME,
        bodies=(
            Body(GROUND, {"O": 0}),
            Body("link 1", {"O": 0, "E": abs(head.arm.first)}),
            Body("link 2", {"E": 0, "P": head.arm.second}),
        ),
        joints=(Pin("O", GROUND, "link 1"), Pin("E", "link 1", "link 2")),
        inputs=(Rotation("link 1", "O"), Rotation("link 2", "E")),
        branches={},
    )


def inertias(params: KnottingDyadParams, head: Head, hole: float) -> dict[str, Inertia]:
    """The links with all that is fixed in them; hole: diameter of their holes [m]."""
    return link_inertias(arm_parts(params, head, hole), arm_mechanism(head), carried(params, head, hole))


@lru_cache(maxsize=8)
def arm_parts(params: KnottingDyadParams, head: Head, hole: float) -> LinkageParts:
    """Plates and pins of an arm; hole: diameter of the holes [m]."""
    levels = levels_of(params, hole)
    formed = {"link 2": _second_link(head, levels.sizes["link 2"])}
    return linkage_parts(NAME, arm_mechanism(head), levels, formed, shafts={"O"}, of=OF)


def levels_of(params: KnottingDyadParams, hole: float) -> Levels:
    """The planes of the plate that stands and of the links."""
    material = replace(params.strength.of_links, density=params.density)
    size = LinkSize(params.link_width, params.link_thickness, hole, material)
    return Levels(LEVELS, {body: size for level in LEVELS for body in level})


def _second_link(head: Head, size: LinkSize) -> Part:
    """The second link, from its elbow to the clamp of the needle."""
    clamp = complex(head.arm.second - head.section.needle_length)
    outline = stepped_link(0j, clamp, size.width)
    section = f"{format_quantity(size.width, 'mm')} x {format_quantity(size.thickness, 'mm')}"
    return Part(
        f"{NAME}/link-2",
        f"link 2 {OF}",
        "machined link",
        f"{section}, {format_quantity(clamp.real, 'mm')}",
        Prism(drilled(outline, [Hole(0j, size.hole / 2)]), size.thickness),
        size.material,
        seats={"E": Seat(placement(), size.hole), "clamp": Seat(placement(clamp.real), size.width)},
    )


@lru_cache(maxsize=8)
def carried(params: KnottingDyadParams, head: Head, hole: float) -> dict[str, tuple[Occurrence, ...]]:
    """What the links carry beside their pins: blade and gripper of the second, the load of the elbow on the first."""
    tip = head.arm.second
    bottoms, length = levels_of(params, hole).bottoms, abs(head.arm.first)
    levels, middle = drive_levels(params, bottoms), bottoms["link 2"] + params.link_thickness / 2
    belted = params.elbow_drive == "belt"
    belt = (elbow_belt(levels, length),) if belted else ()
    pulley = (elbow_pulley(levels, hole),) if belted else ()
    blade = Occurrence(blade_part(params, head), (edgewise(params, tip - head.section.needle_length / 2, middle),))
    return {
        "link 1": (
            sleeve(levels, hole),
            *belt,
            *_loads("elbow-load", "load of an elbow", params.elbow_mass, length, middle),
        ),
        "link 2": (blade, *pulley, *_loads("gripper", "gripper of an arm", params.gripper_mass, tip, middle, FLAT)),
    }


@lru_cache(maxsize=8)
def blade_part(params: KnottingDyadParams, head: Head) -> Part:
    """The blade of a needle, cut from sheet: along x, its middle in the origin."""
    thick, broad, length = params.needle_diameter, params.needle_breadth, head.section.needle_length
    size = f"sheet {format_quantity(thick, 'mm')}, {format_quantity(broad, 'mm')} x {format_quantity(length, 'mm')}"
    return Part(f"{NAME}/needle", "blade of a needle", "laser-cut part", size, box(length, broad, thick), BLADE)


def edgewise(params: KnottingDyadParams, x: float, z: float) -> Placement:
    """A blade with its middle at x [m] on the line of its link, its breadth across the plane of motion about z [m]."""
    return placement(x, params.needle_diameter / 2, z, about=(1.0, 0.0, 0.0), angle=math.pi / 2)


def gripper_half(params: KnottingDyadParams) -> float:
    """Half the room of a gripper in any direction, however its needle is tilted [m]."""
    return _cube(params.gripper_mass) * max(math.hypot(1.0, 1 / FLAT), FLAT) / 2


def _cube(mass: float) -> float:
    """Side of a cube of steel of a mass [kg]."""
    return float((mass / BLADE.density) ** (1 / 3))


def _loads(  # noqa: PLR0917
    name: str, title: str, mass: float, x: float, z: float, flat: float = 1.0
) -> Iterator[Occurrence]:
    """A bought part of a given mass [kg] on the line of its link: room of steel as long as a cube; none without mass.

    flat  its height over the cube's, and the cube's width over its own; of a flat part x [m] is its end
    """
    if mass > 0:
        side = _cube(mass)
        purchase = Bought(format_quantity(mass, "g"), mass)
        room = box(side, side / flat, flat * side)
        part = Part(f"{NAME}/{name}", title, "tool", shape=room, purchase=purchase, envelope=True)
        middle = x if flat == 1.0 else x - side / 2
        yield Occurrence(part, (placement(middle, z=z - flat * side / 2),))
