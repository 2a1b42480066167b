"""Hazards of the bodies of a loom that move: energy, force, gaps, what reaches them, and how far they are from doors.

    F <= P / v            force of a motor of the rated power P that moves a body at the greatest speed v
A gap that closes below 25, 50, 100, 120, 180, 300 or 500 mm crushes a finger, toes, a hand, an arm, a leg, a head or a
body [ISO 13854, table 1, formerly EN 349]. The clearances in space report parts nearer than `HORIZON`.
"""

import math
from collections.abc import Iterable

from ilmek.elements.performance_levels import (
    HARMLESS_ENERGY,
    HARMLESS_FORCE,
    required_level,
)
from ilmek.elements.safety_distances import APPROACH, GRID_REACH, approach, through
from ilmek.machines.automated_loom.assembly import assembly
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.guards import MESH, WIRE, fence_of
from ilmek.machines.automated_loom.equipment.site import site_of
from ilmek.machines.automated_loom.in_space.scene import loom_tree, periods_of
from ilmek.machines.automated_loom.nearest_parts import HORIZON
from ilmek.machines.weaver.tree import HEAD
from ilmek.part.contacts import TOUCHING
from ilmek.part.moving_energy import moving_energies
from ilmek.part.tree import Tree
from ilmek.records import record
from ilmek.report import Column, PaperSection, Table
from ilmek.sentences import Sentence
from ilmek.units import format_quantity, in_mm, mm


def endangered(gap: float) -> str:
    """What a gap that closes to a distance [m] crushes, the smallest part of the body first; "" for none.

    >>> print(endangered(0.06), endangered(0.2), endangered(0.6) == "")
    hand head True
    """
    limits = (
        (25, Sentence("risk.finger")),
        (50, Sentence("risk.toes")),
        (100, Sentence("risk.hand")),
        (120, Sentence("risk.arm")),
        (180, Sentence("risk.leg")),
        (300, Sentence("risk.head")),
        (500, Sentence("risk.body")),
    )
    return next((part for least, part in limits if gap < least * mm), "")


_MOST_FORCE = 10e3
"""Above it the rated power over the speed says nothing: the motor turns far below its rated speed [N]."""


@record
class MovingHazard:
    """A body that moves [SI]: its mass with what it carries, speed and energy, force of its own motor (nan: none), gap.

    gap   least distance from what it moves against, at most `HORIZON`        often  F2 of ISO 13849-1
    """

    body: str
    mass: float
    speed: float
    energy: float
    force: float
    gap: float
    often: bool

    @property
    def level(self) -> str:
        """The performance level that what keeps people from it requires; what is not known to be harmless is not."""
        harmless = self.energy <= HARMLESS_ENERGY and self.force <= HARMLESS_FORCE
        return required_level(lasting=not harmless, often=self.often, avoidable=False)


def moving_hazards(loom: LoomDesign) -> tuple[MovingHazard, ...]:
    """The bodies that move, those of the highest energy first."""
    tree, near, energies = loom_tree(loom), _nearest(loom), moving_energies(loom_tree(loom), periods_of(loom))
    counts, motors = tree.counts(), {part.id: (part.purchase, number) for part, number in tree.occurrences()}
    hazards = []
    for name, own in energies.items():
        mass, speed, energy = carried_mass(tree, name), own.speed, own.energy
        if loom.heads and name == HEAD:  # along the row, which no turn of a drive shows
            speed = max(speed, loom.weaver.params.carriage_speed)
            energy = max(energy, mass * speed**2 / 2)
        bought, number = motors.get(tree.body(name).joint.motor, (None, 0))
        force = math.nan if bought is None else bought.power * number / counts[name] / speed
        force = force if force <= _MOST_FORCE else math.nan
        hazards.append(MovingHazard(name, mass, speed, energy, force, near.get(name, HORIZON), not loom.heads))
    return tuple(sorted(hazards, key=lambda own: -own.energy))


def required_of(hazards: Iterable[MovingHazard]) -> str:
    """The performance level that the worst of hazards requires."""
    return max(own.level for own in hazards)


def moving_section(loom: LoomDesign, hazards: Iterable[MovingHazard]) -> PaperSection:
    """The bodies that move, what they do to whom, and whether they are reached over or through the fence."""
    fence, tree = fence_of(site_of(loom)), loom_tree(loom)
    swept = {hazard.body: hazard for hazard in fence.hazards}
    rows = []
    for own in hazards:
        carrier = own.body
        while carrier not in swept:  # the equipment on a body sweeps what the body does
            carrier = tree.body(carrier).parent
        far, needed = fence.distance(swept[carrier]), max(fence.needed(swept[carrier]), through(MESH - WIRE))
        rows.append(
            (
                own.body.replace("/", ": "),
                own.mass,
                own.speed,
                own.energy,
                own.force,
                f"{own.gap / mm:.3g}" if own.gap < HORIZON else f"> {HORIZON / mm:g}",
                endangered(own.gap),
                own.level,
                far,
                needed,
                Sentence("risk.yes") if far < needed - 1e-6 else Sentence("risk.no"),
            )
        )
    heads = (
        Column(Sentence("risk.body-moves")),
        Column(Sentence("risk.mass"), "kg", 3),
        Column(Sentence("risk.speed"), "m/s", 3),
        Column(Sentence("risk.energy"), "J", 3),
        Column(Sentence("risk.force"), "N", 3),
        Column(Sentence("risk.gap")),
        Column(Sentence("risk.crushed")),
        Column(Sentence("risk.level-of")),
        Column(Sentence("risk.fence"), "mm"),
        Column(Sentence("risk.needed"), "mm"),
        Column(Sentence("risk.reached")),
    )
    guard = Sentence("risk.doors") if loom.heads else Sentence("risk.grid")
    height = format_quantity(fence.height, "m", 3)
    measure = Sentence("risk.measure", height=height, guard=guard, stop=format_quantity(fence.stopping.whole, "s", 3))
    harmless = Sentence("risk.harmless", energy=f"{HARMLESS_ENERGY:g} J", force=f"{HARMLESS_FORCE:g} N")
    texts = (Sentence("risk.moving-how"), harmless, measure, Sentence("risk.remains"))
    title = Sentence("risk.moving")
    return PaperSection(title, texts, Table("moving", title, heads, tuple(rows)))


def approach_section(loom: LoomDesign, hazards: Iterable[MovingHazard]) -> PaperSection:
    """How far each body that moves is from the doors or the light grid, against what its stopping time requires."""
    fence = fence_of(site_of(loom))
    swept = {hazard.body: hazard for hazard in fence.hazards}
    reach = 0.0 if loom.heads else GRID_REACH
    rows = []
    for own in hazards:
        if own.body in swept:
            time, far = fence.stopping.of(own.body), fence.front - float(swept[own.body].high[2])
            needed = approach(time, reach)
            enough = Sentence("risk.yes") if far >= needed - 1e-9 else Sentence("risk.no")
            rows.append((own.body.replace("/", ": "), time, far, needed, enough))
    heads = (
        Column(Sentence("risk.body-moves")),
        Column(Sentence("risk.stands"), "s", 3),
        Column(Sentence("risk.front"), "mm"),
        Column(Sentence("risk.needed"), "mm"),
        Column(Sentence("risk.enough")),
    )
    title = Sentence("risk.approach")
    how = Sentence("risk.approach-how", speed=format_quantity(APPROACH, "m/s"), reach=in_mm(reach))
    return PaperSection(title, (how,), Table("approach", title, heads, tuple(rows)))


def _nearest(loom: LoomDesign) -> dict[str, float]:
    """By the id of each body its least distance from parts against which it moves, touching ones left out [m]."""
    least: dict[str, float] = {}
    for near in assembly(loom).nearest:
        distance = near.approach.distance
        for body in near.approach.bodies if distance > TOUCHING else ():
            least[body] = min(distance, least.get(body, math.inf))
    return least


def carried_mass(tree: Tree, name: str) -> float:
    """Mass of a body with all that it carries [kg]."""
    counts = tree.counts()
    return math.fsum(counts[own] / counts[name] * tree.body(own).moments.zeroth for own in tree.carried_by(name))
