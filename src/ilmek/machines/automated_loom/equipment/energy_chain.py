"""The energy chains of the heads: their lines, the chain that takes these, the trough below the rail, and the checks.

A chain is fixed in the middle of its head's share of the row. Its loop is ahead of the head by half the travel: it
reaches past the share by R + h / 2 where the head is at its right end; the moving end is half of that to the left of
its head. The chains are drawn as the room that they take at all positions of their heads, side by side in the trough.
"""

from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from ilmek.elements.columns import STEEL
from ilmek.elements.energy_chains import GLIDING, ChainLines, EnergyChain, bend_needed, chain_for, width_needed
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.surroundings import GAP, surroundings
from ilmek.machines.automated_loom.frame import part_id
from ilmek.machines.automated_loom.in_space.heads import arms
from ilmek.machines.automated_loom.in_space.maker import MachineTree
from ilmek.machines.automated_loom.own_parts import RAIL
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.machines.weaver.drive_parts import drive_front
from ilmek.machines.weaver.head_shape import RAIL_AXIS
from ilmek.machines.weaver.tree import HEAD, head_tree
from ilmek.part.extents import Corner, shape_box
from ilmek.part.part import Bought, Part
from ilmek.part.placement import ALONG_WIDTH, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, box
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.plane.contours import polygon
from ilmek.report import Check, at_least, at_most
from ilmek.units import mm, turn

TROUGH, CHAIN, CHAIN_ARM = part_id("chain-trough"), part_id("energy-chain"), part_id("chain-arm")
"""Ids of parts."""

CONDUITS, CONDUIT_SIZE, CONDUIT_MASS = "conduits", 5 * mm, 0.02
"""Name, outer diameter of a conduit of PTFE [m], mass per length [kg/m]."""

WALL, PLAY = 2 * mm, 1 * mm
"""Of the trough, and between it and a chain on all sides [m]; assumed by this project."""

ARM, TOE = (30 * mm, 5 * mm), (8 * mm, 3 * mm)
"""Width and depth of the arm of a head to its chain, under the end of the bracket, and how far and how thick its lower
end reaches to the front [m]; assumed by this project.
"""

FLANGE = 20 * mm
"""Width of the trough's flange, with which it is screwed to the rail [m]; assumed by this project."""

BEHIND = 17 * mm
"""Room of the trough behind the ends of the heads' brackets, before their drives [m]; assumed by this project."""

ACROSS = ALONG_WIDTH.after(placement(about=(0.0, 0.0, 1.0), angle=-turn / 4))
"""A part whose z points along the width, to the weaver's right: its x to the back, its y up."""


@lru_cache(maxsize=4)
def chain_lines(loom: LoomDesign) -> tuple[ChainLines, ...]:
    """What a chain carries: a conduit for each tube, a cable for each motor, each sensor and the encoder of a head."""
    trees = head_tree(loom.weaver), *(branch.tree for branch in arms(loom))
    parts = [own for tree in trees for own in tree.occurrences()]
    motors = sum(number for part, number in parts if part.purchase and part.purchase.drives)
    sensors = sum(number for part, number in parts if part.process == "sensor")
    return (
        ChainLines(CONDUITS, loom.weaver.params.tubes, CONDUIT_SIZE, 0.2, 8.0, CONDUIT_MASS),
        ChainLines("motor cables", motors, 7.5 * mm, 0.1, 8.0, 0.09),
        ChainLines("sensor cables", sensors + 1, 5 * mm, 0.1, 10.0, 0.035),
    )


def share_of(loom: LoomDesign) -> float:
    """Travel of a head along the row [m]."""
    return loom.task.cloth.width / loom.heads


def energy_chain(loom: LoomDesign) -> EnergyChain:
    """The chain of a head, no wider than its room before the drive of the head, with some of it before the rail."""
    widest = RAIL_AXIS + parts_of_loom(loom).frame.rail.side + BEHIND - 2 * (WALL + PLAY)
    return chain_for(chain_lines(loom), widest)


def trough_box(loom: LoomDesign) -> tuple[Corner, Corner]:
    """Corners of the trough under the heads' rail, in the axes of the scene while the heads knot [m]: it reaches back
    to the arms of the heads, not into their drives, and the flange of its front is below the rail.
    """
    row, (body, rail, position) = energy_chain(loom), surroundings(loom).occurrence((part_id("rail"),))
    assert rail.shape is not None
    points = body.positions[0].after(position).points(np.array(shape_box(rail.shape)))
    below, front = float(points[:, 1].min()), float(points[:, 2].max())
    wide, (high, past) = row.outer[0] + 2 * (WALL + PLAY), row.loop
    back = max(min(loom.weaver.shape.front - ARM[1] - WALL - 2 * PLAY, front - wide), drive_front(loom.weaver) + GAP)
    long = (loom.task.cloth.width + past) / 2
    top = min(below, loom.weaver.shape.rail - RAIL_AXIS / 2 - loom.params.clearance)
    return np.array([-long, top - high - 2 * (WALL + PLAY), back]), np.array([long, below, back + wide])


def chain_trees(loom: LoomDesign) -> Iterator[MachineTree]:
    """Trough and chains on the rail, and on each head the arm that moves the end of its chain."""
    yield MachineTree("automated-loom", Tree((_chains(loom),)), parent=RAIL)
    shape, end = loom.weaver.shape, float(trough_box(loom)[0][1]) + WALL + PLAY + energy_chain(loom).loop[0]
    top = shape.rail - RAIL_AXIS / 2
    toe = Placed(box(ARM[0], *TOE), (placement(y=-(ARM[1] + TOE[0]) / 2),))
    bent = Sum((Placed(box(*ARM, top - end)), toe))
    arm = Part(CHAIN_ARM, "arm of a head to its energy chain", "laser-cut part", "", bent, STEEL)
    upright = placement(0.0, end, shape.front - ARM[1] / 2, about=(1.0, 0.0, 0.0), angle=-turn / 4)
    body = RigidBody(CHAIN_ARM, (Occurrence(arm, (upright,)),))
    yield MachineTree("automated-loom", Tree((body,)), parent=HEAD)


def _chains(loom: LoomDesign) -> RigidBody:
    """The trough under the rail, its rear wall as high as a run, and in it the room of the chain of each head."""
    (low, high), row, lines = trough_box(loom), energy_chain(loom), chain_lines(loom)
    body, _, _ = surroundings(loom).occurrence((part_id("rail"),))
    own, size = body.positions[0].inverse, high - low
    wide, tall, rear = float(size[2]), float(size[1]), row.outer[1]
    # x to the back, from the front of the rail; y up from the bottom.
    corners = (
        (0, 0),
        (wide, 0),
        (wide, rear),
        (wide - WALL, rear),
        (wide - WALL, WALL),
        (WALL, WALL),
        (WALL, tall - WALL),
        (FLANGE, tall - WALL),
        (FLANGE, tall),
        (0, tall),
    )
    section = Profile(polygon(np.array([complex(*corner) for corner in corners])))
    trough = Part(
        TROUGH, "trough of the energy chains", "laser-cut part", "folded sheet", Prism(section, float(size[0])), STEEL
    )
    share, (loop, _) = share_of(loom), row.loop
    long, filled = row.length(share), sum(one.number * one.line_mass for one in lines if one.name != CONDUITS)
    room = float(size[0]) / loom.heads
    chain = Part(
        CHAIN,
        "energy chain of a head with its cables",
        "energy chain",
        "",
        box(row.outer[0], loop, room - PLAY),
        purchase=Bought(row.name, (row.line_mass + filled) * long, length=long),
        envelope=True,
    )
    middle = placement(0.0, float(low[1]) + WALL + PLAY + loop / 2, float(high[2] + low[2]) / 2)
    starts = (placement(float(low[0]) + k * room) for k in range(loom.heads))
    corner = placement(float(low[0]), float(low[1]), float(high[2]))
    return RigidBody(
        part_id("chains"),
        (
            Occurrence(trough, (own.after(corner).after(ACROSS),)),
            Occurrence(chain, tuple(own.after(middle).after(start).after(ACROSS) for start in starts)),
        ),
    )


def chain_checks(loom: LoomDesign) -> tuple[Check, ...]:
    """Fill, bend, free length of the upper run, and the loop beside the neighbour's end and within the rail's ends."""
    row, lines, parts = energy_chain(loom), chain_lines(loom), (CHAIN,)
    past, cure = row.loop[1], "set fewer colours, or more heads"
    count = ", ".join(f"{one.number} {one.name}" for one in lines)
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
