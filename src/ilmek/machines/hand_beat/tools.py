"""The weaver's tools on their shelf: comb, knife, scissors, bobbins of weft; each is lifted from it by a hand.

Axes of the shelf: x along it, y up from its upper side, z to the front, 0 at its rear edge.
"""

import math
from collections.abc import Iterator

import numpy as np

from ilmek.elements.columns import STEEL
from ilmek.machines.hand_beat.params import HandBeatParams
from ilmek.part.part import Bought, Part
from ilmek.part.placement import ALONG_WIDTH, Placement, placement
from ilmek.part.shapes import box, tube
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody
from ilmek.units import mm

HANDLE = 22 * mm, 2 * mm, 130 * mm
"""Diameter, wall and length of the comb's handle [m]; assumed by this project."""

SHELF, DEEP, LOOSE = 5 * mm, 260 * mm, 15 * mm
"""Thickness and depth of the shelf, and room between tools on it [m]; assumed by this project."""

TOOLS = (
    ("knife", "knife", "carpet knife", 0.15, (20 * mm, 12 * mm, 220 * mm), 1),
    ("scissors", "scissors", "carpet scissors", 0.3, (70 * mm, 12 * mm, 220 * mm), 1),
    ("bobbin", "bobbin of weft", "hand bobbin", 0.2, (30 * mm, 20 * mm, 220 * mm), 2),
)
"""Id, title, row of the catalogue, mass [kg], room along x, y and z [m], number; assumed by this project."""


def part_id(name: str) -> str:
    """Id of a part or body of the beat by hand."""
    return f"hand-beat/{name}"


def comb_parts(params: HandBeatParams, leaf: float, number: int) -> tuple[Occurrence, ...]:
    """The comb on its side: head about x from its middle, leaves to the front, handle to the rear; y up from below.

    leaf    thickness of a leaf [m]      number  of leaves, a warp pitch apart
    """
    high, deep, tall = params.head_height, params.head_depth, params.leaf_height
    wide = max((number - 1) * params.cloth.warp_pitch + leaf, HANDLE[0])
    head = Part(part_id("comb-head"), "head of the comb", "machined link", box(wide, high, deep), STEEL)
    plate, joins = box(leaf, tall, params.reach), (head.id,)
    blade = Part(part_id("comb-leaf"), "leaf of the comb", "laser-cut part", plate, STEEL, joins=joins)
    title, shape = "handle of the comb", tube(*HANDLE)
    grip = Part(part_id("comb-handle"), title, "turned part", shape, STEEL, joins=joins)
    along = (np.arange(number) - (number - 1) / 2) * params.cloth.warp_pitch
    return (
        Occurrence(head, (placement(0.0, high / 2, HANDLE[2]),)),
        Occurrence(blade, tuple(placement(float(x), tall / 2, HANDLE[2] + deep) for x in along)),
        Occurrence(grip, (placement(0.0, max(high, HANDLE[0]) / 2),)),
    )


def comb_wide(params: HandBeatParams, number: int) -> float:
    """Width of the comb's head on the shelf [m]."""
    return max(number * params.cloth.warp_pitch, HANDLE[0])


def shelf_length(comb: float = 0.0) -> float:
    """Length of the shelf for all tools beside each other [m]; comb: room of the comb, 0 without one."""
    sizes = [*((comb,) if comb else ()), *(size[0] for *_, size, count in TOOLS for _ in range(count))]
    return math.fsum(sizes) + (len(sizes) + 1) * LOOSE


def tool_bodies(shelf: Placement, comb: tuple[Occurrence, ...] = (), wide: float = 0.0) -> Iterator[RigidBody]:
    """The shelf, and the tools on it from left to right.

    shelf  its axes      comb, wide  parts of the comb and its room [m]; none where the beat is driven
    """
    long = shelf_length(wide)
    plate = Part(part_id("shelf"), "shelf of the tools", "laser-cut part", box(DEEP, SHELF, long), STEEL)
    lies = Occurrence(plate, (placement(-long / 2, -SHELF / 2, DEEP / 2).after(_FLAT),))
    yield RigidBody(part_id("shelf"), (lies,), positions=(shelf,))
    at = LOOSE - long / 2
    if comb:
        yield _lifted("comb", comb, "comb-handle", (shelf.after(placement(at + wide / 2, 0.0, LOOSE)),))
        at += wide + LOOSE
    for name, title, row, mass, size, count in TOOLS:
        part = Part(part_id(name), title, "hand tool", box(*size), purchase=Bought(row, mass), envelope=True, size=row)
        own = tuple(
            shelf.after(placement(at + size[0] / 2 + k * (size[0] + LOOSE), size[1] / 2, LOOSE)) for k in range(count)
        )
        yield _lifted(name, (Occurrence(part),), name, own)
        at += count * (size[0] + LOOSE)


_FLAT = ALONG_WIDTH.after(placement(about=(0.0, 0.0, 1.0), angle=np.pi / 2))
"""A box along the shelf: its x to the front, its y down."""


def _lifted(name: str, parts: tuple[Occurrence, ...], grasped: str, positions: tuple[Placement, ...]) -> RigidBody:
    """A tool on the shelf, by the part that a hand grasps."""
    seats = (f"{part_id(grasped)}:rest", part_id("shelf:top"))
    joint = Joint(JointKind.SLIDE, axis=(0.0, 1.0, 0.0), seats=seats, hand=part_id(grasped))
    return RigidBody(part_id(f"lifted {name}"), parts, joint=joint, positions=positions)
