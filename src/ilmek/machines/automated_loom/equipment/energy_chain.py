"""The energy chains of the heads under the rail, the arms of the heads to them, and the checks of the chains."""

from collections.abc import Iterator

from ilmek.elements.columns import STEEL
from ilmek.elements.energy_chains import GLIDING, EnergyChain, bend_needed, width_needed
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import ROOM, part_id
from ilmek.machines.automated_loom.in_space.maker import MachineTree
from ilmek.machines.automated_loom.on_rail import (
    ACROSS,
    ARM_DEPTH,
    CHAIN,
    PLAY,
    TROUGH,
    WALL,
    chain_lines,
    chain_part,
    chain_room,
    chain_under,
    share_of,
    trough_corners,
)
from ilmek.machines.automated_loom.own_parts import RAIL
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.machines.automated_loom.supports import rail_middle
from ilmek.machines.weaver.drive_parts import drive_front, drive_top, reducer_left
from ilmek.machines.weaver.head_shape import RAIL_AXIS
from ilmek.machines.weaver.tree import HEAD
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.shapes import Corner, Placed, Sum, box
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.report import Check, at_least, at_most
from ilmek.units import mm, turn

CHAIN_ARM = part_id("chain-arm")

FOOT = 12 * mm
"""How far the foot of the arm of a head reaches to the back under the bracket [m]; assumed by this project."""

ARM, TOE = (30 * mm, ARM_DEPTH), (8 * mm, 3 * mm)
"""Width and depth of the arm of a head to its chain, under the end of the bracket, and how far and how thick its lower
end reaches to the front [m]; assumed by this project.
"""


def _side(loom: LoomDesign) -> float:
    return parts_of_loom(loom).frame.guide[0].side


def energy_chain(loom: LoomDesign) -> EnergyChain:
    """The chain of a head."""
    return chain_under(loom, _side(loom))


def trough_box(loom: LoomDesign) -> tuple[Corner, Corner]:
    """Corners of the trough, in the axes of the scene while the heads knot [m]."""
    return trough_corners(loom, _side(loom))


def chain_trees(loom: LoomDesign) -> Iterator[MachineTree]:
    """Chains in the trough of the rail, and on each head the arm that moves the end of its chain."""
    yield MachineTree("automated-loom", Tree((_chains(loom),)), parent=RAIL)
    shape, end = loom.weaver.shape, float(trough_box(loom)[0][1]) + WALL + PLAY + energy_chain(loom).loop[0]
    top = shape.rail - RAIL_AXIS / 2
    toe = Placed(box(ARM[0], *TOE), (placement(y=-(ARM[1] + TOE[0]) / 2),))
    foot = Placed(box(ARM[0], FOOT, ARM[1]), (placement(y=(ARM[1] + FOOT) / 2, z=top - end - ARM[1]),))
    bent = Sum((Placed(box(*ARM, top - end)), toe, foot))
    arm = Part(CHAIN_ARM, "arm of a head to its energy chain", "laser-cut part", bent, STEEL)
    # Where the head's drive reaches so far to the front, or under the foot, to the left of it.
    deep = ARM[1] + (FOOT if drive_top(loom.weaver) > top - ARM[1] - ROOM else 0.0)
    beside = drive_front(loom.weaver) > shape.front - deep - ROOM
    x = min(0.0, reducer_left(loom.weaver) - ROOM - ARM[0] / 2) if beside else 0.0
    upright = placement(x, end, shape.front - ARM[1] / 2, about=(1.0, 0.0, 0.0), angle=-turn / 4)
    body = RigidBody(CHAIN_ARM, (Occurrence(arm, (upright,)),))
    yield MachineTree("automated-loom", Tree((body,)), parent=HEAD)


def _chains(loom: LoomDesign) -> RigidBody:
    """In the trough under the rail the room of the chain of each head."""
    (low, high), side, rail = trough_box(loom), _side(loom), rail_middle(loom)
    own, room = placement(0.0, rail.imag, rail.real).inverse, chain_room(loom, side)
    middle = placement(0.0, float(low[1]) + WALL + PLAY + energy_chain(loom).loop[0] / 2, float(high[2] + low[2]) / 2)
    starts = (placement(float(low[0]) + k * room) for k in range(loom.heads))
    pieces = tuple(own.after(middle).after(start).after(ACROSS) for start in starts)
    return RigidBody(part_id("chains"), (Occurrence(chain_part(loom, side), pieces),))


def chain_checks(loom: LoomDesign) -> tuple[Check, ...]:
    """Fill, bend, free length of the upper run, and the loop beside the neighbour's end and within the rail's ends."""
    row, lines, parts = energy_chain(loom), chain_lines(loom), (CHAIN,)
    past, cure = row.loop[1], "set fewer colours, or more heads"
    count = ", ".join(f"{line.number} {line.name}" for line in lines)
    ends = loom.task.rail_length - loom.task.cloth.width
    return (
        at_most(
            "energy chain: width of its lines",
            width_needed(row, lines),
            row.inner[0],
            "mm",
            f"inner width of {row.name}; {count} with the makers' room",
        ).with_cure(cure, *parts),
        at_least(
            "energy chain: bend radius",
            row.radius,
            bend_needed(lines),
            "mm",
            "8 times the thickest line, 10 times a thin one; makers: 7.5 to 10 times",
        ).with_cure(cure, *parts),
        at_most(
            "energy chain: travel",
            share_of(loom),
            GLIDING,
            "m",
            f"{row.name}: free up to {2 * row.free:g} m, beyond it glides on its lower run; makers",
        ).with_cure("set more heads", *parts),
        at_most(
            "energy chain: loop past its share",
            past,
            min(ends, loom.head_distance),
            "mm",
            "least distance of two heads, and what the rail is longer than the cloth",
        ).with_cure("set fewer colours, or fewer heads", *parts, TROUGH),
    )
