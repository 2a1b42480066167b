"""The risk file of a loom in the form of ISO 12100: hazards found from its bodies and energies, measures, what remains.

    E = m v² / 2,   J w² / 2,   m g h,   T e l / 2,   F² / 2 k      of what moves, turns, may fall, is strained, springs
    F = m g / (2 cos 30°)                               of each of two slings, 60° between them
    tan a = |z| / (h - y)                               slope at which the loom hangs: its mass centre is z before and
                                                        h - y under the slings
A gap that closes below 25, 50, 100, 120, 180, 300 or 500 mm crushes a finger, toes, a hand, an arm, a leg, a head or a
body [ISO 13854, table 1, formerly EN 349]. The clearances in space report parts nearer than `HORIZON`.
"""

import math
from collections.abc import Iterator

from ilmek.elements.materials import GRAVITY
from ilmek.elements.safety_distances import through
from ilmek.machines.automated_loom.assembly import assembly
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.creel_parts import CREEL, YARN_DUCT
from ilmek.machines.automated_loom.equipment.guards import GUARDS, MESH, WIRE, fence_of
from ilmek.machines.automated_loom.equipment.site import site_of
from ilmek.machines.automated_loom.equipment.surroundings import surroundings
from ilmek.machines.automated_loom.frame import part_id
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.nearest_parts import HORIZON
from ilmek.machines.automated_loom.own_parts import RAIL
from ilmek.machines.automated_loom.papers.values import known, value_of
from ilmek.part.contacts import TOUCHING
from ilmek.part.poses import moments_at_rest
from ilmek.part.tree import Tree
from ilmek.report import Column, Paper, PaperSection, Report, Table
from ilmek.sentences import Sentence
from ilmek.units import deg, format_quantity, in_mm, mm

SLINGS = 60 * deg
"""Angle between two slings [rad]: the usual limit."""

_TILT = 3 * deg
"""Slope of the hanging loom above which it needs a third sling [rad]; assumed by this project."""


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
    """Hazards of moving bodies, stored energies, other hazards, transport."""
    return Paper(
        "risks",
        Sentence("risk.title"),
        Sentence("risk.lead"),
        (_moving(loom), _energies(loom, report), _others(loom, report), _transport(loom)),
    )


def _moving(loom: LoomDesign) -> PaperSection:
    fence, tree = fence_of(site_of(loom)), loom_tree(loom)
    near = _nearest(loom)
    rows = []
    for hazard in fence.hazards:
        gap = near.get(hazard.body)
        mass = _carried(tree, hazard.body)
        needed = max(fence.needed(hazard), through(MESH - WIRE))
        far = fence.distance(hazard)
        rows.append(
            (
                hazard.body.replace("/", ": "),
                mass,
                f"> {in_mm(HORIZON)}" if gap is None else in_mm(gap),
                Sentence("risk.from", part=endangered(HORIZON if gap is None else gap)),
                far,
                needed,
                Sentence("risk.no") if far >= needed - 1e-6 else Sentence("risk.yes"),
            )
        )
    heads = (
        Column(Sentence("risk.body-moves")),
        Column(Sentence("risk.mass"), "kg", 3),
        Column(Sentence("risk.gap")),
        Column(Sentence("risk.crushed")),
        Column(Sentence("risk.fence"), "mm"),
        Column(Sentence("risk.needed"), "mm"),
        Column(Sentence("risk.reached")),
    )
    guard = Sentence("risk.doors") if loom.heads else Sentence("risk.grid")
    level = Sentence("risk.level", level="d" if loom.heads else "e", frequency="F1" if loom.heads else "F2")
    height = format_quantity(fence.height, "m", 3)
    measure = Sentence("risk.measure", height=height, guard=guard, stop=format_quantity(fence.stopping.whole, "s", 3))
    title = Sentence("risk.moving")
    texts = (Sentence("risk.moving-how"), measure, level, Sentence("risk.remains"))
    return PaperSection(title, texts, Table("moving", title, heads, tuple(rows)))


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
    stands = Sentence("risk.stops", stop=format_quantity(fence_of(site_of(loom)).stopping.whole, "s", 3))
    cams = 0.5 * value_of(report, "shedding.inertia") * loom.shedding.params.speed**2
    yield Sentence("risk.cams-turn"), cams, stands
    carrier = known(report, "weft.moving_mass"), known(report, "weft.speed_max")
    if None not in carrier:
        yield Sentence("risk.carrier-runs"), 0.5 * carrier[0] * carrier[1] ** 2, stands
    if known(report, "hammer.weight_carried") is not None:
        comb, speed = value_of(report, "hammer.moving_mass"), value_of(report, "hammer.speed_max")
        yield Sentence("risk.comb-moves"), 0.5 * comb * speed**2, stands
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
        turned = 0.5 * value_of(report, "weaver.cam_inertia") * value_of(report, "weaver.cam_speed") ** 2
        yield Sentence("risk.head-turns"), loom.heads * turned, stands
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
    """Mass and mass centre of the loom without guards and creel, and how it hangs on slings at its upper beam."""
    tree, near = loom_tree(loom), surroundings(loom)
    apart = frozenset((*GUARDS, CREEL, YARN_DUCT))
    left = frozenset(name for own in apart if own in {body.id for body in tree.bodies} for name in tree.carried_by(own))
    moved = moments_at_rest(tree, left)
    columns = near.of(part_id("column"))
    top, axis = (float(value) for value in (columns[0].high[1], (columns[0].low[2] + columns[0].high[2]) / 2))
    x, y, z = (float(value) for value in moved.centre)
    tilt = math.atan2(abs(z - axis), top - y)
    not_weighed = sum(number for part, number in tree.occurrences() if math.isnan(part.mass))
    rows = (
        (Sentence("risk.whole"), format_quantity(moments_at_rest(tree).zeroth, "kg")),
        (Sentence("risk.transported"), format_quantity(moved.zeroth, "kg")),
        (Sentence("risk.not-weighed"), str(not_weighed)),
        (Sentence("risk.centre-height"), in_mm(y - loom.side.floor)),
        (Sentence("risk.centre-across"), in_mm(x)),
        (Sentence("risk.centre-front"), in_mm(z - axis)),
        (Sentence("risk.sling"), format_quantity(moved.zeroth * GRAVITY / (2 * math.cos(SLINGS / 2)), "kN", 3)),
        (Sentence("risk.tilt"), format_quantity(tilt, "deg", 3)),
    )
    texts = [Sentence("risk.transport-how")]
    if tilt > _TILT:
        texts.append(Sentence("risk.third-sling"))
    heads = Column(Sentence("electric.what")), Column(Sentence("electric.value"))
    title = Sentence("risk.transport")
    return PaperSection(title, tuple(texts), Table("transport", title, heads, rows))
