"""The wood of a shuttle, its bobbin, and the tube of a rapier: parts that weigh what their shapes say.

Axes: x along the width to the weaver's right, 0 in the middle of a shuttle and at the tip of a rapier; y up along the
warps; z to the front. A shuttle's bay is a hollow square bar, open to the front, with an end wall on each side, its
noses are wedges in plan: the back glides along the warps at rest, in the pockets of the noses it has its magnets.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.elements.materials import BEECH, CARBON, NEODYMIUM
from ilmek.machines.weft.bobbin import BobbinSize
from ilmek.machines.weft.coupling import magnet_sides
from ilmek.machines.weft.params import WeftParams
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import ALONG_WIDTH, UPRIGHT, Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, bar, box, rectangle
from ilmek.plane.contours import circle, polygon
from ilmek.units import format_quantity, mm


def part_id(name: str) -> str:
    """Id of a part or a body of the weft side."""
    return f"weft/{name}"


SHUTTLE_WOOD, FITTINGS, BOBBIN = part_id("shuttle"), part_id("fittings"), part_id("bobbin")
CARRIAGE, AXIS, MOTOR, BOX = part_id("carriage"), part_id("axis"), part_id("motor"), part_id("box")
RAPIER_TUBE, GRIPPER, NEEDLE, WEFT_CUTTER = part_id("rapier"), part_id("gripper"), part_id("needle"), part_id("cutter")
MAGNET, BOX_MOTOR = part_id("magnet"), part_id("box-motor")


_ARC = 49
"""Points of the half circle of a bay."""


def shuttle_wood(params: WeftParams, size: BobbinSize) -> Part:
    """A shuttle for a bobbin, without what is fitted to it: its back is flat, its noses have pockets for magnets."""
    deep, long = size.diameter + 2 * params.wall, size.length
    bay = Placed(Prism(_bay(deep, size), long), (along(-long / 2),))
    wall = Prism(Profile(rectangle(deep, deep), (circle(0j, _eye(size) / 2),)), params.wall)
    ends = Placed(wall, (along(-long / 2 - params.wall), along(long / 2)))
    noses = [*_nose(params, size, 1), *_nose(params, size, -1)] if params.nose > 0 else []
    wood = replace(BEECH, density=params.shuttle_density)
    return Part(SHUTTLE_WOOD, "shuttle", "machined link", Sum((bay, ends, *noses)), wood)


def _bay(deep: float, size: BobbinSize) -> Profile:
    """The section of the bay, a square bar that is hollowed out round and open to the front for the bobbin."""
    half, radius = deep / 2, size.diameter / 2
    hollow = radius * np.exp(-1j * np.linspace(0.0, math.pi, _ARC))
    corners = np.array([complex(-half, -half), complex(half, -half), complex(half, half), complex(radius, half)])
    return Profile(polygon(np.concatenate([corners, hollow, [complex(-radius, half), complex(-half, half)]])))


def _nose(params: WeftParams, size: BobbinSize, side: int) -> Iterator[Placed]:
    """The nose to the right (side 1) or left (-1): a wedge in plan, within its height a pocket at the back."""
    deep, end = size.diameter + 2 * params.wall, size.length / 2 + params.wall
    back, (long, tall, thick) = -deep / 2, magnet_sides(params, size.diameter)
    plan = np.array([back, -back, back + 1j * params.nose])
    pocket = np.array([back + thick, -back, back + 1j * params.nose, back + 1j * long, back + thick + 1j * long])
    for corners, low, high in (
        (plan, -deep / 2, params.wall),
        (pocket, -tall / 2, tall),
        (plan, tall / 2, params.wall),
    ):
        outline = corners if side > 0 else np.conj(corners)[::-1]
        yield Placed(Prism(Profile(polygon(outline)), high), (placement(side * end, low).after(UPRIGHT),))


def _eye(size: BobbinSize) -> float:
    """Diameter of the eyes in the end walls [m]."""
    return size.diameter / 2


@lru_cache(maxsize=64)
def magnet(params: WeftParams, size: BobbinSize) -> Part:
    """A magnet of a shuttle or of its carriage: along the width, up, and from z = 0 to the front."""
    long, tall, thick = magnet_sides(params, size.diameter)
    text = " x ".join(format_quantity(side / mm, "") for side in (long, tall, thick)) + " mm"
    shape = box(long, tall, thick)
    return Part(MAGNET, "magnet", "magnet", shape, NEODYMIUM, size=text, fixing="bonded in its pocket")


def magnet_positions(params: WeftParams, size: BobbinSize) -> tuple[float, float]:
    """Middles of the magnets along the shuttle [m]."""
    middle = size.length / 2 + params.wall + magnet_sides(params, size.diameter)[0] / 2
    return -middle, middle


def fittings(params: WeftParams, size: BobbinSize) -> tuple[Part, tuple[Placement, ...]]:
    """What is fitted to a shuttle: an eye with its brake in each end wall; their form is not designed."""
    title = "eye and brake of a shuttle"
    shape = bar(_eye(size), params.wall)
    bought = Bought("eye and brake", params.fittings / 2)
    part = bought_part(FITTINGS, title, "tool", shape, bought, size="one in each end wall")
    end = size.length / 2
    return part, (along(end), along(-end - params.wall))


def bobbin(params: WeftParams, size: BobbinSize) -> Part:
    """The core of a bobbin, along z from 0."""
    core = bar(size.core, size.length)
    return Part(
        BOBBIN, "bobbin of weft", "yarn tube", core, replace(BEECH, density=params.shuttle_density), size=size.name
    )


def hollow(tube: tuple[float, float, float]) -> Profile:
    """The section of a rapier's tube: height along x, width, wall [m]."""
    tall, wide, wall = tube
    return Profile(rectangle(tall, wide), (rectangle(tall - 2 * wall, wide - 2 * wall),))


def rapier_tube(params: WeftParams, tube: tuple[float, float, float], length: float) -> Part:
    """The tube of a rapier, along z from 0: height, width, wall and length [m]."""
    made = replace(CARBON, density=params.rapier_density, modulus=params.rapier_modulus)
    return Part(RAPIER_TUBE, "rapier", "carbon tube", Prism(hollow(tube), length), made)


def along(x: float) -> Placement:
    """From a position along the width [m] to the right: the part's x up, its y to the front."""
    return placement(x).after(ALONG_WIDTH)
