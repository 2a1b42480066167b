"""The risk file of a loom in the form of ISO 12100: hazards found from its bodies and energies, measures, what remains.

    E = m g h,   T e l / 2,   F² / 2 k                  of what may fall, is strained, springs; moving [`moving_energy`]
    F <= P / v            force of a motor of the rated power P that moves a body at the greatest speed v
A gap that closes below 25, 50, 100, 120, 180, 300 or 500 mm crushes a finger, toes, a hand, an arm, a leg, a head or a
body [ISO 13854, table 1, formerly EN 349]. The clearances in space report parts nearer than `HORIZON`.
"""

import math
from collections.abc import Iterable, Iterator

from ilmek.elements.materials import GRAVITY
from ilmek.elements.performance_levels import HARMLESS_ENERGY, HARMLESS_FORCE, limit_of, required_level
from ilmek.elements.safety_distances import through
from ilmek.machines.automated_loom.assembly import assembly
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.guards import MESH, WIRE, fence_of
from ilmek.machines.automated_loom.equipment.site import site_of
from ilmek.machines.automated_loom.in_space.scene import loom_tree, periods_of
from ilmek.machines.automated_loom.nearest_parts import HORIZON
from ilmek.machines.automated_loom.own_parts import RAIL
from ilmek.machines.automated_loom.papers.safety_functions import safety_functions
from ilmek.machines.automated_loom.papers.transport import lifting_of, lifting_picture, lifting_rows
from ilmek.machines.automated_loom.papers.values import known, value_of
from ilmek.machines.weaver.tree import HEAD
from ilmek.part.contacts import TOUCHING
from ilmek.part.moving_energy import moving_energies
from ilmek.part.poses import moments_at_rest
from ilmek.part.tree import Tree
from ilmek.records import record
from ilmek.report import Check, Column, Paper, PaperSection, Report, Table, at_most
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


def risks(loom: LoomDesign, report: Report) -> Paper:
    """Hazards of moving bodies, stored energies, other hazards, the safety functions, transport."""
    hazards = moving_hazards(loom)
    return Paper(
        "risks",
        Sentence("risk.title"),
        Sentence("risk.lead"),
        (
            _moving(loom, hazards),
            _energies(loom, report),
            _others(loom, report),
            _functions(loom, report, hazards),
            _transport(loom),
        ),
    )


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
        mass, speed, energy = _carried(tree, name), own.speed, own.energy
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


def _moving(loom: LoomDesign, hazards: Iterable[MovingHazard]) -> PaperSection:
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


def _functions(loom: LoomDesign, report: Report, hazards: Iterable[MovingHazard]) -> PaperSection:
    """What each safety function reaches, against what the hazards require."""
    required = required_of(hazards)
    rows = tuple(
        (own.title, own.number, own.failures, own.level or "–", required, own.failures < limit_of(required))
        for own in safety_functions(loom, report)
    )
    heads = (
        Column(Sentence("risk.function")),
        Column(Sentence("electric.pieces")),
        Column(Sentence("risk.failures"), "", 3),
        Column(Sentence("risk.reaches")),
        Column(Sentence("risk.requires")),
        Column(Sentence("risk.enough")),
    )
    words = {True: Sentence("risk.yes"), False: Sentence("risk.no")}
    table = Table("functions", Sentence("risk.functions"), heads, tuple((*row[:-1], words[row[-1]]) for row in rows))
    frequency = "F1" if loom.heads else "F2"
    return PaperSection(
        table.title,
        (Sentence("risk.level", level=required, frequency=frequency), Sentence("risk.functions-how")),
        table,
    )


def safety_checks(loom: LoomDesign, report: Report) -> tuple[Check, ...]:
    """Whether each safety function reaches what the hazards require."""
    limit = limit_of(required_of(moving_hazards(loom)))
    cure = "order safety devices and amplifiers with fewer dangerous failures, or replace contacts more often"
    return tuple(
        at_most(
            f"dangerous failures in an hour: {own.title}", own.failures, limit, "1", "ISO 13849-1, table 2"
        ).with_cure(cure, own.part)
        for own in safety_functions(loom, report)
    )


def _carried(tree: Tree, name: str) -> float:
    """Mass of a body with all that it carries [kg]."""
    counts = tree.counts()
    return math.fsum(counts[own] / counts[name] * tree.body(own).moments.zeroth for own in tree.carried_by(name))


def _nearest(loom: LoomDesign) -> dict[str, float]:
    """By the id of each body its least distance from parts against which it moves, touching ones left out [m]."""
    least: dict[str, float] = {}
    for near in assembly(loom).nearest:
        distance = near.approach.distance
        for body in near.approach.bodies if distance > TOUCHING else ():
            least[body] = min(distance, least.get(body, math.inf))
    return least


def energies(loom: LoomDesign, report: Report) -> Iterator[tuple[str, float, str]]:
    """What stores energy, how much [J], and the measure."""
    if known(report, "hammer.weight_carried") is not None:
        brake = Sentence("risk.brake", torque=format_quantity(value_of(report, "hammer.brake_torque"), "Nm", 3))
        yield (
            Sentence("risk.comb-falls"),
            value_of(report, "hammer.weight_carried") * value_of(report, "beat_stroke"),
            brake,
        )
    strained = 0.5 * value_of(report, "tension") * value_of(report, "warp_strain") * value_of(report, "warp_length")
    yield Sentence("risk.warps"), strained * value_of(report, "warps"), Sentence("risk.slacken")
    if known(report, "tension_compensator.spring_force") is not None:
        force, rate, *number = (
            value_of(report, f"tension_compensator.{name}")
            for name in ("spring_force", "spring_rate", "springs_per_lever", "levers", "bars")
        )
        yield Sentence("risk.springs"), math.prod(number) * force**2 / (2 * rate), Sentence("risk.slacken")
    if loom.heads:
        tree = loom_tree(loom)
        rail, motion = tree.body(RAIL), tree.body(RAIL).joint.motion
        carried = _carried(tree, rail.id)
        if motion is not None:
            drop = float((rail.positions[0].rotation @ (motion.shift - motion.shift[0]).T)[1].min())
            yield Sentence("risk.rail-falls"), carried * GRAVITY * -drop, Sentence("risk.prop")


def _energies(loom: LoomDesign, report: Report) -> PaperSection:
    heads = Column(Sentence("risk.store")), Column(Sentence("risk.energy"), "J", 3), Column(Sentence("risk.taken"))
    title = Sentence("risk.energies")
    return PaperSection(title, (), Table("energies", title, heads, tuple(energies(loom, report))))


def _others(loom: LoomDesign, report: Report) -> PaperSection:
    cutting = known(report, "weaver.cutting_force")
    voltage = (Sentence("risk.electric"), Sentence("risk.electric-taken"), Sentence("risk.electric-left"))
    noise = (Sentence("risk.noise"), Sentence("risk.noise-taken"), Sentence("risk.noise-left"))
    dust = (Sentence("risk.dust"), Sentence("risk.dust-taken"), Sentence("risk.dust-left"))
    rows = [voltage, noise, dust]
    if loom.heads and cutting is not None:
        knives = Sentence("risk.knives", force=format_quantity(cutting, "N", 3))
        rows.insert(0, (knives, Sentence("risk.knives-taken"), Sentence("risk.knives-left")))
    heads = Column(Sentence("risk.hazard")), Column(Sentence("risk.taken")), Column(Sentence("risk.left"))
    title = Sentence("risk.others")
    return PaperSection(title, (), Table("others", title, heads, tuple(rows)))


def _transport(loom: LoomDesign) -> PaperSection:
    """Mass and mass centre of the loom without guards and creel, its lifting points and their loads."""
    lifting = lifting_of(loom)
    x, y, z = lifting.moments.centre.tolist()
    text = Sentence(
        "lift.masses",
        whole=format_quantity(moments_at_rest(loom_tree(loom)).zeroth, "kg"),
        lifted=format_quantity(lifting.moments.zeroth, "kg"),
    )
    centre = Sentence("lift.centre", x=in_mm(x), y=in_mm(y - loom.side.floor), z=in_mm(-z))
    heads = (
        Column(Sentence("lift.point")),
        Column(Sentence("lift.x"), "mm"),
        Column(Sentence("lift.y"), "mm"),
        Column(Sentence("lift.z"), "mm"),
        Column(Sentence("lift.load"), "kN", 3),
        Column(Sentence("lift.sling"), "kg", 3),
    )
    rows = tuple(lifting_rows(lifting, loom.side.floor))
    title = Sentence("risk.transport")
    table, picture = Table("transport", title, heads, rows), lifting_picture(loom, lifting)
    return PaperSection(title, (Sentence("lift.how"), text, centre), table, figure=picture)
