"""The risk file of a loom in the form of ISO 12100: hazards found from its bodies and energies, measures, what remains.

E = m g h,   T e l / 2,   F² / 2 k                  of what may fall, is strained, springs; moving [`moving_energy`]
"""

import math
from collections.abc import Iterable, Iterator

from ilmek.elements.field_devices import AMPLIFIER_FAILURES, ENABLING, MODE, RELAY
from ilmek.elements.holding_brakes import find_brake
from ilmek.elements.materials import GRAVITY
from ilmek.elements.performance_levels import (
    COVERED,
    limit_of,
    mean_years,
)
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.lifting_eyes import EYE_BOLT, eye_bolt_of
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.own_parts import RAIL, RETREAT_BRAKE
from ilmek.machines.automated_loom.papers.moving_hazards import (
    MovingHazard,
    approach_section,
    carried_mass,
    moving_hazards,
    moving_section,
    required_of,
)
from ilmek.machines.automated_loom.papers.safety_functions import TESTED, coverage_of, safety_functions, starters
from ilmek.machines.automated_loom.papers.transport import lifting_of, lifting_picture, lifting_rows
from ilmek.machines.automated_loom.papers.values import known, value_of
from ilmek.machines.automated_loom.papers.wiring import bought_of
from ilmek.part.catalogue import HOLDING_BRAKE
from ilmek.part.part import Part
from ilmek.part.poses import moments_at_rest
from ilmek.report import Check, Column, Paper, PaperSection, Report, Table, at_most
from ilmek.sentences import Sentence
from ilmek.units import format_quantity, in_mm


def risks(loom: LoomDesign, report: Report) -> Paper:
    """Hazards of moving bodies, stored energies, other hazards, the safety functions, transport."""
    hazards = moving_hazards(loom)
    return Paper(
        "risks",
        Sentence("risk.title"),
        Sentence("risk.lead"),
        (
            moving_section(loom, hazards),
            approach_section(loom, hazards),
            _energies(loom, report),
            _others(loom, report),
            _functions(loom, report, hazards),
            _failures(loom, report),
            _measures(loom),
            _transport(loom),
        ),
    )


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


def _failures(loom: LoomDesign, report: Report) -> PaperSection:
    """The failure rate of each device of the safety functions, and where it is from."""
    functions = {own.part: own for own in safety_functions(loom, report)}
    started = (
        (device, hourly, coverage_of(functions[part], device))
        for _, _, parts, device, hourly in starters(report)
        for part in parts
        if part in functions
    )
    rows = tuple(
        (
            device.name,
            device.b10d or math.nan,
            hourly if device.b10d else math.nan,
            mean_years(device.b10d, hourly) if device.b10d and hourly else math.nan,
            f"{covered:.0%}" if device.b10d else "–",
            math.nan if device.b10d else device.failures,
            Sentence("risk.source-table") if device.tabled else Sentence("risk.source-assumed"),
        )
        for device, hourly, covered in (
            *started,
            *((device, 1 / TESTED, COVERED) for device in (ENABLING, MODE)),
            (RELAY, 0.0, COVERED),
        )
    )
    amplifier = (
        Sentence("electric.amplifiers"),
        *3 * (math.nan,),
        "–",
        AMPLIFIER_FAILURES,
        Sentence("risk.source-assumed"),
    )
    heads = (
        Column(Sentence("electric.device")),
        Column("B10d", "", 3),
        Column(Sentence("risk.hourly"), "", 3),
        Column(Sentence("risk.mttfd"), "", 3),
        Column("DCavg"),
        Column("PFHd [1/h]", "", 3),
        Column(Sentence("setting.source")),
    )
    title = Sentence("risk.failure-rates")
    table = Table("failures", title, heads, (*rows, amplifier))
    return PaperSection(title, (Sentence("risk.failure-rates-how"),), table)


MEASURES = {
    "guard mesh": "risk.by-fence",
    "interlock": "risk.by-stops",
    "actuator": "risk.by-stops",
    "light grid": "risk.by-stops",
    "button": "risk.by-stops",
    "emergency stop": "risk.by-stops",
    "safety relay": "risk.by-stops",
    "enabling device": "risk.by-enabling",
    "mode selector": "risk.by-enabling",
    HOLDING_BRAKE: "risk.by-brake",
    "main switch": "risk.by-switch",
    "cabinet door": "risk.by-switch",
}
BY_ID = {EYE_BOLT: "risk.by-eyes"}
"""Measures that are bought parts: key of the measure's sentence by the process of the part, or by its id."""


def measures(loom: LoomDesign) -> Iterator[tuple[str, Part, int]]:
    """The devices of the measures: key of the sentence, part, pieces."""
    return (
        (key, part, number)
        for part, number in loom_tree(loom).occurrences()
        for key in [MEASURES.get(part.process, BY_ID.get(part.id, ""))]
        if key
    )


def _measures(loom: LoomDesign) -> PaperSection:
    """The devices that carry out the measures, each in the list of bought parts."""
    rows = tuple(
        (Sentence(key), part.title, part.designation, number)
        for key, part, number in sorted(measures(loom), key=lambda own: own[0])
    )
    heads = (
        Column(Sentence("risk.taken")),
        Column(Sentence("electric.device")),
        Column(Sentence("electric.designation")),
        Column(Sentence("electric.pieces")),
    )
    title = Sentence("risk.devices")
    return PaperSection(title, (Sentence("risk.devices-how"),), Table("measures", title, heads, rows))


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
        carried = carried_mass(tree, rail.id)
        if motion is not None:
            drop = float((rail.positions[0].rotation @ (motion.shift - motion.shift[0]).T)[1].min())
            (behind,) = (part for part, _ in tree.occurrences() if part.id == RETREAT_BRAKE)
            row = find_brake(bought_of(behind).row)
            prop = Sentence("risk.prop", torque=format_quantity(row.torque, "Nm", 3))
            yield Sentence("risk.rail-falls"), carried * GRAVITY * -drop, prop


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
        Column(Sentence("lift.eye")),
        Column(Sentence("lift.bears"), "kg", 4),
    )
    rows = tuple(lifting_rows(lifting, loom.side.floor, eye_bolt_of(loom)))
    title = Sentence("risk.transport")
    table, picture = Table("transport", title, heads, rows), lifting_picture(loom, lifting)
    return PaperSection(title, (Sentence("lift.how"), text, centre), table, figure=picture)
