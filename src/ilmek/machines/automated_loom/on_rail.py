"""What the heads' rail carries beside the heads: bar and rail of their guide, belt, energy chains in a trough below it.

A chain is fixed in the middle of its head's share of the row. Its loop is ahead of the head by half the travel: it
reaches past the share by R + h / 2 where the head is at its right end; the moving end is half of that to the left of
its head. The chains are drawn as the room that they take at all positions of their heads, side by side in the trough.
All of it is as long as the rail, so it loads the rail as its own weight does.
"""

import math
from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from ilmek.elements.columns import STEEL
from ilmek.elements.energy_chains import ChainLines, EnergyChain, chain_for
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import ROOM, part_id
from ilmek.machines.automated_loom.supports import rail_middle
from ilmek.machines.weaver.carriage_drive import rail_belt
from ilmek.machines.weaver.carriage_guide import ON_RAIL
from ilmek.machines.weaver.case import ALUMINIUM
from ilmek.machines.weaver.drive_parts import drive_front
from ilmek.machines.weaver.head_shape import RAIL_AXIS
from ilmek.machines.weaver.tree import carriage_guide, drive_of
from ilmek.part import guides
from ilmek.part.folding import folded_section
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import ALONG_WIDTH, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Corner, Placed, Prism, Sum, box
from ilmek.part.tree import Occurrence, RigidBody
from ilmek.units import mm, turn

TROUGH, CHAIN = part_id("chain-trough"), part_id("energy-chain")
"""Ids of parts."""

CONDUITS, CONDUIT_SIZE, CONDUIT_MASS = "conduits", 5 * mm, 0.02
"""Name, outer diameter of a conduit of PTFE [m], mass per length [kg/m]."""

WALL, PLAY = 2 * mm, 1 * mm
"""Of the trough, also the inner radius of its bends; between it and a chain on all sides [m]; assumed by this project.
"""

FLANGE = 20 * mm
"""Width of the trough's flange, with which it is screwed to the rail [m]; assumed by this project."""

FOOT = 40 * mm
"""Length of the bracket of the fixed end of a chain [m]; assumed by this project."""

BEHIND = 17 * mm
"""Room of the trough behind the ends of the heads' brackets, before their drives [m]; assumed by this project."""

ARM_DEPTH = 5 * mm
"""Of the arm of a head to its chain [m]; assumed by this project."""


ACROSS = ALONG_WIDTH.after(placement(about=(0.0, 0.0, 1.0), angle=-turn / 4))
"""A part whose z points along the width, to the weaver's right: its x to the back, its y up."""


def guide_parts(loom: LoomDesign) -> Iterator[Occurrence]:
    """Bar and rail of the heads' guide, and the heads' belt, in the axes of the rail."""
    row, wide = carriage_guide(loom.weaver), loom.task.rail_length
    spacer = box(row.block, RAIL_AXIS - row.height, wide)
    under = Part(part_id("guide-bar"), "bar under the heads' guide", "machined link", spacer, ALUMINIUM)
    guide = guides.guide_rail(part_id("rail-guide"), "rail of the heads' guide", row, wide)
    yield Occurrence(under, (placement(-wide / 2, z=(row.height - RAIL_AXIS) / 2).after(ALONG_WIDTH),))
    yield Occurrence(guide, (placement(-wide / 2, z=row.height - RAIL_AXIS).after(ON_RAIL),))
    yield from rail_belt(loom.weaver, drive_of(loom.weaver), row.block / 2, loom.heads)


@lru_cache(maxsize=4)
def chain_lines(loom: LoomDesign) -> tuple[ChainLines, ...]:
    """What a chain carries: a conduit for each tube, a cable for each motor, each sensor and the encoder of a head."""
    parts = [line for name in loom.head.children for line in loom.machines[name].parts]
    motors = sum(line.number for line in parts if line.drives)
    sensors = sum(line.number for line in parts if line.kind == "sensor")
    return (
        ChainLines(CONDUITS, loom.weaver.params.tubes, CONDUIT_SIZE, 0.2, 8.0, CONDUIT_MASS),
        ChainLines("motor cables", motors, 7.5 * mm, 0.1, 8.0, 0.09),
        ChainLines("sensor cables", sensors + 1, 5 * mm, 0.1, 10.0, 0.035),
    )


def share_of(loom: LoomDesign) -> float:
    """Travel of a head along the row [m]."""
    return loom.task.cloth.width / loom.heads


def chain_under(loom: LoomDesign, side: float) -> EnergyChain:
    """The chain of a head, no wider than its room before the drive of the head, with some of it before the rail.

    side  of the rail [m]
    """
    return chain_for(chain_lines(loom), RAIL_AXIS + side + BEHIND - 2 * (WALL + PLAY))


def trough_corners(loom: LoomDesign, side: float) -> tuple[Corner, Corner]:
    """Corners of the trough under the heads' rail, in the axes of the scene while the heads knot [m]: it reaches back
    to the arms of the heads, not into their drives, and the flange of its front is below the rail.

    side  of the rail [m]
    """
    row, shape, rail = chain_under(loom, side), loom.weaver.shape, rail_middle(loom)
    below, front = rail.imag - side / 2, rail.real + side
    wide, (high, past) = row.outer[0] + 2 * (WALL + PLAY), row.loop
    back = max(min(shape.front - ARM_DEPTH - WALL - 2 * PLAY, front - wide), drive_front(loom.weaver) + ROOM)
    long = (loom.task.cloth.width + past) / 2
    top = min(below, shape.rail - RAIL_AXIS / 2 - loom.params.clearance)
    return np.array([-long, top - high - 2 * (WALL + PLAY), back]), np.array([long, below, back + wide])


def trough_part(loom: LoomDesign, side: float) -> Part:
    """The trough under a rail of a side [m], its rear wall as high as a run; x to the back, from the front of the rail;
    y up from the bottom.
    """
    low, high = trough_corners(loom, side)
    (long, tall, wide), rear = map(float, high - low), chain_under(loom, side).outer[1]
    outside = np.array([complex(FLANGE, tall), 1j * tall, 0j, complex(wide), complex(wide, rear)])
    section = Prism(Profile(folded_section(outside, WALL, WALL)), long)
    return Part(TROUGH, "trough of the energy chains", "laser-cut part", section, STEEL)


def trough(loom: LoomDesign, side: float) -> Occurrence:
    """The trough on a rail of a side [m], in its axes: it is welded to the rail before anything is screwed to that."""
    low, high = trough_corners(loom, side)
    middle = rail_middle(loom)
    corner = placement(float(low[0]), float(low[1]) - middle.imag, float(high[2]) - middle.real)
    return Occurrence(trough_part(loom, side), (corner.after(ACROSS),))


def chain_room(loom: LoomDesign, side: float) -> float:
    """Of a chain along the trough under a rail of a side [m]."""
    low, high = trough_corners(loom, side)
    return float(high[0] - low[0]) / loom.heads


def chain_part(loom: LoomDesign, side: float) -> Part:
    """The chain of a head with its cables, without its conduits, under a rail of a side [m]."""
    row = chain_under(loom, side)
    filled = sum(line.number * line.line_mass for line in chain_lines(loom) if line.name != CONDUITS)
    long, long_room = row.length(share_of(loom)), chain_room(loom, side) - PLAY
    under = placement(y=-(row.loop[0] + PLAY) / 2)  # the bracket of its fixed end, on the trough
    return bought_part(
        CHAIN,
        "energy chain of a head with its cables",
        "energy chain",
        Sum((Placed(box(row.outer[0], row.loop[0], long_room)), Placed(box(row.outer[0], PLAY, FOOT), (under,)))),
        Bought(row.name, (row.line_mass + filled) * long, length=long),
        fixing="its end brackets, each with two screws M5, on trough and arm",
    )


@lru_cache(maxsize=4)
def _guide_mass(loom: LoomDesign) -> float:
    """Mass of bar, rail and belt of the heads' guide [kg]."""
    return RigidBody("guide", tuple(guide_parts(loom))).moments.zeroth


@lru_cache(maxsize=64)
def rail_cargo(loom: LoomDesign, side: float) -> float:
    """Mass of a length of what lies along a rail of a side [m], with the conduits in the chains [kg/m]."""
    conduits = loom.weaver.params.tubes * CONDUIT_MASS * chain_under(loom, side).length(share_of(loom))
    chains = loom.heads * (chain_part(loom, side).mass + conduits)
    return math.fsum((_guide_mass(loom), trough_part(loom, side).mass, chains)) / loom.task.rail_length
