"""The wood of a shuttle, its bobbin, and the tube of a rapier: parts that weigh what their shapes say.

Axes: x along the width to the weaver's right, 0 in the middle of a shuttle and at the tip of a rapier; y up along the
warps; z to the front. A shuttle's bay is a bored square bar with an end wall on each side, its noses are wedges in
plan.
"""

import math
from dataclasses import replace

import numpy as np

from ilmek.machines.weft.bobbin import BobbinSize
from ilmek.machines.weft.materials import BEECH, CARBON
from ilmek.machines.weft.params import WeftParams
from ilmek.part.part import Bought, Part
from ilmek.part.placement import ALONG_WIDTH, UPRIGHT, Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, bar, box, rectangle
from ilmek.plane.contours import circle, polygon
from ilmek.units import format_quantity


def part_id(name: str) -> str:
    """Id of a part or a body of the weft side."""
    return f"weft/{name}"


SHUTTLE_WOOD, FITTINGS, BOBBIN = part_id("shuttle"), part_id("fittings"), part_id("bobbin")
CARRIAGE, AXIS, MOTOR, BOX = part_id("carriage"), part_id("axis"), part_id("motor"), part_id("box")
RAPIER_TUBE, GRIPPER, NEEDLE = part_id("rapier"), part_id("gripper"), part_id("needle")


def shuttle_wood(params: WeftParams, size: BobbinSize) -> Part:
    """A shuttle for a bobbin, without what is fitted to it."""
    deep, long = size.diameter + 2 * params.wall, size.length
    bay = Placed(Prism(Profile(rectangle(deep, deep), (circle(0j, size.diameter / 2),)), long), (along(-long / 2),))
    ends = Placed(box(deep, deep, params.wall), (along(-long / 2 - params.wall), along(long / 2)))
    end = long / 2 + params.wall
    noses: tuple[Placed, ...] = ()
    if params.nose > 0:
        wedge = polygon(np.array([-deep / 2 + 0j, deep / 2 + 0j, 1j * params.nose]))
        standing = placement(end, -deep / 2).after(UPRIGHT)
        turned = placement(about=(0.0, 1.0, 0.0), angle=math.pi).after(standing)
        noses = (Placed(Prism(Profile(wedge), deep), (standing, turned)),)
    wood = replace(BEECH, density=params.shuttle_density)
    length = format_quantity(2 * (end + params.nose), "mm")
    text = f"{length} long, for a bobbin of {size.name}"
    return Part(SHUTTLE_WOOD, "shuttle", "machined link", text, Sum((bay, ends, *noses)), wood)


def fittings(params: WeftParams, size: BobbinSize) -> tuple[Part, tuple[Placement, ...]]:
    """What is fitted to a shuttle: half of it within each nose; its form is not designed."""
    deep, end = size.diameter + 2 * params.wall, size.length / 2 + params.wall
    long = max(params.nose / 2, params.wall / 2)
    part = Part(
        FITTINGS,
        "magnets, eyes and brake of a shuttle",
        "pin or bush",
        "half of them in each nose",
        box(deep / 3, deep / 3, long),
        purchase=Bought("magnets, eyes and brake", params.fittings / 2),
        envelope=True,
    )
    inside = 0.0 if params.nose > 0 else long
    return part, (along(end - inside), along(-end + inside - long))


def bobbin(params: WeftParams, size: BobbinSize) -> Part:
    """The core of a bobbin, along z from 0."""
    core = bar(size.core, size.length)
    return Part(BOBBIN, "bobbin of weft", "yarn tube", size.name, core, replace(BEECH, density=params.shuttle_density))


def hollow(tube: tuple[float, float, float]) -> Profile:
    """The section of a rapier's tube: height along x, width, wall [m]."""
    tall, wide, wall = tube
    return Profile(rectangle(tall, wide), (rectangle(tall - 2 * wall, wide - 2 * wall),))


def rapier_tube(params: WeftParams, tube: tuple[float, float, float], length: float) -> Part:
    """The tube of a rapier, along z from 0: height, width, wall and length [m]."""
    text = " x ".join(format_quantity(size, "mm", 3) for size in tube)
    made = replace(CARBON, density=params.rapier_density, modulus=params.rapier_modulus)
    return Part(RAPIER_TUBE, "rapier", "carbon tube", f"tube {text}", Prism(hollow(tube), length), made)


def along(x: float) -> Placement:
    """From a position along the width [m] to the right: the part's x up, its y to the front."""
    return placement(x).after(ALONG_WIDTH)
