"""The arms of a head as they are made: links, needles with their jaws, pins; and their inertia.

The first link is a flat bar with round ends, the second one ends square where the blade of its needle is clamped. What
the elbow carries is bought; its mass is a parameter.
"""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import lru_cache

from ilmek.dynamics.inertia import Inertia
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation
from ilmek.machines.knotting_dyad.arm_drives import (
    NAME,
    ROOM,
    STEEL,
    drive_levels,
    elbow_belt,
    elbow_hub,
    sleeve,
)
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.jaw_parts import drive_of, for_blade, moving_parts, on_link
from ilmek.machines.knotting_dyad.jaws import Jaws, jaws_of
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.link_tree import Levels, LinkageParts, LinkSize, link_inertias, linkage_parts
from ilmek.part.flat_link import stepped_link
from ilmek.part.part import Bought, Part, Seat
from ilmek.part.placement import placement
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
    loads, jaws = carried(params, head, hole), jaws_of(params, head, hole)
    bottom = levels_of(params, hole).bottoms["link 2"] + params.link_thickness / 2
    all_of_second = (*loads["link 2"], *moved_to(bottom, moving_parts(params, head, jaws)))
    return link_inertias(arm_parts(params, head, hole), arm_mechanism(head), {**loads, "link 2": all_of_second})


@lru_cache(maxsize=8)
def arm_parts(params: KnottingDyadParams, head: Head, hole: float) -> LinkageParts:
    """Plates and pins of an arm; hole: diameter of the holes [m]."""
    levels = levels_of(params, hole)
    formed = {"link 2": _second_link(head, jaws_of(params, head, hole), levels.sizes["link 2"])}
    return linkage_parts(NAME, arm_mechanism(head), levels, formed, shafts={"O"}, of=OF)


def levels_of(params: KnottingDyadParams, hole: float) -> Levels:
    """The planes of the plate that stands and of the links."""
    material = replace(params.strength.of_links, density=params.density)
    size = LinkSize(params.link_width, params.link_thickness, hole, material)
    return Levels(LEVELS, {body: size for level in LEVELS for body in level})


def _second_link(head: Head, jaws: Jaws, size: LinkSize) -> Part:
    """The second link, from its elbow to the clamp of the needle."""
    clamp = complex(head.arm.second - head.section.needle_length)
    outline = for_blade(stepped_link(0j, clamp, size.width), head, jaws)
    return Part(
        f"{NAME}/link-2",
        f"link 2 {OF}",
        "machined link",
        Prism(drilled(outline, [Hole(0j, size.hole / 2)]), size.thickness),
        size.material,
        seats={"E": Seat(placement(), size.hole), "clamp": Seat(placement(clamp.real), size.width)},
    )


@lru_cache(maxsize=8)
def carried(params: KnottingDyadParams, head: Head, hole: float) -> dict[str, tuple[Occurrence, ...]]:
    """What the links carry beside their pins: the second one needle, hub and drive of its finger, the first the load of
    the elbow.
    """
    bottoms, length = levels_of(params, hole).bottoms, abs(head.arm.first)
    levels, middle = drive_levels(params, bottoms), bottoms["link 2"] + params.link_thickness / 2
    belted, jaws = params.elbow_drive == "belt", jaws_of(params, head, hole)
    return {
        "link 1": (
            sleeve(levels, hole),
            *((elbow_belt(levels, length),) if belted else ()),
            *_elbow_load(params.elbow_mass, length, middle),
        ),
        "link 2": (
            *elbow_hub(levels, hole, jaws.around, belted),
            *moved_to(middle, on_link(params, head, jaws)),
            *drive_of(jaws, placement(z=levels.elbow - ROOM)),
        ),
    }


def moved_to(z: float, occurrences: Iterable[Occurrence]) -> tuple[Occurrence, ...]:
    """Occurrences in a gripper's axes, whose needle's middle is at a height z [m]."""
    up = placement(z=z)
    return tuple(
        replace(occurrence, positions=tuple(up.after(own) for own in occurrence.positions))
        for occurrence in occurrences
    )


def _elbow_load(mass: float, x: float, z: float) -> Iterator[Occurrence]:
    """A bought part of a given mass [kg] on the line of its link: room of steel as a cube; none without mass."""
    if mass > 0:
        side = float((mass / STEEL.density) ** (1 / 3))
        purchase, room = Bought(format_quantity(mass, "g"), mass), box(side, side, side)
        part = Part(f"{NAME}/elbow-load", "load of an elbow", "tool", shape=room, purchase=purchase, envelope=True)
        yield Occurrence(part, (placement(x, z=z - side / 2),))
