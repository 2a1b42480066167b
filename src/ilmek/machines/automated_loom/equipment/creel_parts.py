"""The creel as bodies: its frame, pegs with packages, brakes; the conduits' duct."""

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from ilmek.elements.columns import STEEL, HollowSquare
from ilmek.elements.field_devices import BRAKE, CHANNELS, FIELD_INPUTS, YARN_SENSOR
from ilmek.elements.tubes import find_tube
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.creel import (
    BETWEEN,
    BRAKE_ID,
    CONDUIT,
    CORE,
    DUCT,
    DUCT_MASS,
    LEAST_DUCT,
    PACKAGE,
    PEG,
    Creel,
    creel_of,
    foot_under_duct,
)
from ilmek.machines.automated_loom.equipment.devices import TO_THE_BACK, TO_THE_LEFT, TO_THE_RIGHT, device, placed
from ilmek.machines.automated_loom.equipment.guards import POST
from ilmek.machines.automated_loom.equipment.surroundings import surroundings
from ilmek.machines.automated_loom.equipment.yarn_path import yarn_path
from ilmek.machines.automated_loom.frame import END_PLATE, end_plate, member, part_id
from ilmek.machines.automated_loom.in_space.maker import MachineTree
from ilmek.machines.automated_loom.on_rail import ACROSS, CONDUIT_MASS, CONDUIT_SIZE, WALL
from ilmek.part.part import WELDED, Bought, Part, bought_part
from ilmek.part.placement import ALONG_WIDTH, IDENTITY, UPRIGHT, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, box, tube
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.plane.contours import polygon
from ilmek.units import format_quantity, mm

CREEL, YARN_DUCT = part_id("creel"), part_id("yarn-duct")
"""Ids of the bodies that stand beside the loom."""

_SECTION = HollowSquare(POST, 3 * mm)

_PEG = find_tube("30x3")
"""Tube of a peg: loose in the core of its package, and narrower than its rail by the legs of its weld."""

_UPRIGHTS = 1.5
"""Greatest distance of two uprights [m]; assumed by this project."""


def creel_trees(loom: LoomDesign) -> Iterator[MachineTree]:
    """The creel with the duct on the floor."""
    creel = creel_of(loom)
    bodies = (
        RigidBody(CREEL, tuple(_creel(loom, creel))),
        RigidBody(YARN_DUCT, tuple(_duct(loom, creel))),
    )
    yield MachineTree("automated-loom", Tree(bodies))


def _creel(loom: LoomDesign, creel: Creel) -> Iterator[Occurrence]:
    """Frame, pegs with their packages, brakes with their sensors."""
    yield from _stand(loom, creel)
    long = creel.size
    peg = Part(PEG, "peg of a package", WELDED, tube(_PEG.outer, _PEG.wall, long), STEEL)
    winding = tube(creel.size, (creel.size - CORE) / 2, long)
    full = format_quantity(loom.params.package_mass, "kg", 3)
    package = bought_part(
        PACKAGE, "package of pile yarn", "yarn package", winding, Bought(full, loom.params.package_mass)
    )
    brake, sensor = (
        device(BRAKE_ID, "yarn brake", BRAKE),
        device(signals.YARN_STOP, "stop motion of a yarn", YARN_SENSOR),
    )
    inwards, outwards = (TO_THE_RIGHT, TO_THE_LEFT)[:: -creel.hand]
    on_pegs = tuple(placed(creel.base, y, z, inwards) for y, z in creel.axes)
    yield Occurrence(peg, on_pegs)
    yield Occurrence(package, on_pegs)
    yield Occurrence(brake, tuple(placed(creel.inner, y, z, outwards) for y, z in creel.axes))
    yield _yarn_inputs(loom, creel)
    above = (BRAKE.size[1] + YARN_SENSOR.size[1]) / 2
    yield Occurrence(sensor, tuple(placed(creel.inner, y + above, z, outwards) for y, z in creel.axes))


def _yarn_inputs(loom: LoomDesign, creel: Creel) -> Occurrence:
    """For each head the modules that read the sensors of its yarns, one over the other on the ends of the uprights."""
    number = loom.heads * math.ceil(creel.number / loom.heads / CHANNELS)
    part = device(signals.YARN_INPUTS, "inputs for the yarns of a head", FIELD_INPUTS)
    high, (begin, end) = FIELD_INPUTS.size[1] + BETWEEN, creel.ends
    each, out = max(1, int(_top(loom, creel) // high)), POST / 2
    xs = creel.base + 1.5 * creel.hand * POST, creel.inner
    stations = [(x, z, turned) for z, turned in ((end + out, IDENTITY), (begin - out, TO_THE_BACK)) for x in xs]
    return Occurrence(
        part,
        tuple(
            placed(x, loom.side.floor + (index % each + 0.5) * high, z, turned)
            for index in range(number)
            for x, z, turned in [stations[min(index // each, len(stations) - 1)]]
        ),
    )


def _top(loom: LoomDesign, creel: Creel) -> float:
    """Of the uprights over the floor [m]."""
    return creel.rows[-1] + creel.size / 2 + POST - loom.side.floor


def _stand(loom: LoomDesign, creel: Creel) -> Iterator[Occurrence]:
    """Rails behind the packages and behind the brakes, uprights between the columns, ties between both planes."""
    half, floor, out = POST / 2, loom.side.floor, creel.hand * POST
    begin, end = creel.ends
    rail = member("creel-rail", "rail of the creel", _SECTION, end - begin + POST)
    behind, before = creel.base + out / 2, creel.inner - out / 2
    yield Occurrence(rail, tuple(placement(x, y, begin - half) for x in (behind, before) for y in creel.rows))
    top = floor + _top(loom, creel)
    every = max(1, math.floor(_UPRIGHTS / creel.pitch))
    between = [(a + b) / 2 for a, b in pairwise(creel.columns)]
    stations = (begin, *between[every - 1 :: every], end)
    upright = member("creel-upright", "upright of the creel", _SECTION, top - floor)
    beside = behind + out, creel.inner + out / 2
    feet = tuple(placement(x, floor, z).after(UPRIGHT) for x in beside for z in stations)
    yield Occurrence(upright, feet)
    low, high = min(beside) + half, max(beside) - half
    tie = member("creel-tie", "tie of the creel", _SECTION, high - low)
    yield Occurrence(tie, tuple(placement(low, top - half, z).after(ALONG_WIDTH) for z in (stations[0], stations[-1])))


def _duct(loom: LoomDesign, creel: Creel) -> Iterator[Occurrence]:
    """The duct from the fence over the front foot, its stand, and the conduits, whose ends hang free."""
    (start, height, depth), side = creel.mouth, creel.duct
    foot, long = foot_under_duct(surroundings(loom), creel.hand), abs(creel.duct_end - start)
    left, mass = min(start, creel.duct_end), DUCT_MASS * side / LEAST_DUCT * long
    shape, size = Prism(_channel(side, side, WALL), long), format_quantity(side, "mm")
    duct = Part(
        DUCT,
        "duct of yarns and cables",
        "duct",
        shape,
        purchase=Bought("slotted duct", mass, length=long),
        fixing="two screws M6 with washers through the slots of its base into the plate of its stand",
        size=size,
    )
    yield Occurrence(duct, (placement(left, height, depth).after(ACROSS),))
    clear, middle = height - side / 2 - float(foot.high[1]), float(foot.low[0] + foot.high[0]) / 2
    if clear > END_PLATE:
        upright = placement(middle, float(foot.high[1]), depth).after(UPRIGHT)
        yield Occurrence(member("duct-stand", "stand of the duct", _SECTION, clear - END_PLATE), (upright,))
        plate = end_plate("duct-plate", "plate of the stand of the duct", _SECTION)
        yield Occurrence(plate, (upright.after(placement(z=clear - END_PLATE)),))
    within = side - 2 * WALL
    each = yarn_path(loom).conduit
    bundle = bought_part(
        CONDUIT,
        "bundle of the yarns' conduits",
        "conduit",
        box(within, 0.8 * within, long),
        Bought("PTFE", CONDUIT_MASS * creel.number * each, length=creel.number * each),
        size=f"{creel.number} tubes of PTFE, {format_quantity(CONDUIT_SIZE, 'mm')}",
    )
    yield Occurrence(bundle, (placement(left, height - 0.1 * within, depth).after(ACROSS),))


def _channel(wide: float, high: float, wall: float) -> Profile:
    """A channel that is open at its top, about the origin [m]."""
    x, y, inner = wide / 2, high / 2, wide / 2 - wall
    corners = [-x + 1j * y, -x - 1j * y, x - 1j * y, x + 1j * y, inner + 1j * y]
    corners += [inner - 1j * (y - wall), -inner - 1j * (y - wall), -inner + 1j * y]
    return Profile(polygon(np.array(corners)))
