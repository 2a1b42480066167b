"""The electrical plan of a loom: supply, motors with fuses and wires, sensors, terminals, cabinet, safety circuit.

What feeds what is `equipment.power_plan`, what stands in the cabinet `equipment.circuit`.
"""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from ilmek.elements.cabinet_devices import WARMER
from ilmek.elements.field_devices import RELAY
from ilmek.elements.motor_loads import CONTROL_VOLTS, MAINS, PHASE, STEPPER_VOLTS
from ilmek.elements.wiring import protective_section, section_for
from ilmek.machines.automated_loom.cabinet import AMPLIFIER, CONTROL, MOUNTING_PLATE
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.circuit import CIRCUIT, HANDLE
from ilmek.machines.automated_loom.equipment.power_plan import MotorCircuit, PowerPlan
from ilmek.machines.automated_loom.equipment.site import site_of
from ilmek.machines.automated_loom.equipment.stopping import stopping_time
from ilmek.machines.automated_loom.equipment.terminals import TerminalLevel
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.papers.braking import braking_section
from ilmek.machines.automated_loom.papers.circuit_diagrams import (
    FedRow,
    MotorRow,
    SafeRelay,
    SafeSwitch,
    safety_circuit,
    single_line,
)
from ilmek.machines.automated_loom.papers.connections import (
    cable_table,
    channel_tables,
    protected_table,
    strip_table,
)
from ilmek.machines.automated_loom.papers.safety_functions import safety_functions
from ilmek.machines.automated_loom.papers.values import value_of
from ilmek.machines.automated_loom.papers.wiring import (
    SENSING,
    SIGNS,
    bought_of,
    braked,
    brakes,
    channels,
    connected_at,
    feeds,
    levels_of,
    listed,
    numbers_of,
    plan_of,
    signal_rows,
    signs_of,
)
from ilmek.part.shapes import shape_box
from ilmek.report import Column, Paper, PaperSection, Report, Table
from ilmek.sentences import Sentence
from ilmek.units import format_quantity, in_mm, mm

SAFE = frozenset(
    (
        "emergency stop",
        "interlock",
        "actuator",
        "light grid",
        "button",
        "safety relay",
        "enabling device",
        "mode selector",
    )
)
"""Processes of devices of the safety circuit."""


def electrical(loom: LoomDesign, report: Report) -> Paper:
    """Supply, what feeds what, motors, brakes, sensors, inputs, terminals, cabinet, safety circuit."""
    plan = plan_of(loom)
    return Paper(
        "electrical",
        Sentence("electric.title"),
        Sentence("electric.lead"),
        (
            _supply(loom, report, plan),
            _motors(plan),
            _sensors(loom),
            _terminals(loom),
            _safety(loom, report),
            _feeds(loom, plan),
            braking_section(loom),
            *_brakes(loom),
            *channel_tables(loom),
            strip_table(loom),
            protected_table(plan),
            cable_table(loom),
            _cabinet(loom, plan),
        ),
    )


def _supply(loom: LoomDesign, report: Report, plan: PowerPlan) -> PaperSection:
    fuse, section = plan.main_fuse, section_for(plan.main_fuse)
    sources = (
        (
            Sentence("electric.direct", volts=f"{own.row.volts:g} V"),
            f"{SIGNS[own.part]}: {own.number} × {own.row.name}, {format_quantity(own.load, 'W', 3)}",
        )
        for own in plan.sources
    )
    rows = (
        (Sentence("electric.mains"), f"3 x {MAINS:g} V, N, PE"),
        (Sentence("electric.connected"), f"{plan.connected / 1e3:.3g} kVA"),
        (Sentence("electric.mean"), format_quantity(value_of(report, "power_mean"), "W", 3)),
        (Sentence("electric.phases"), ", ".join(f"L{k} {own:.3g} A" for k, own in enumerate(plan.currents, 1))),
        (Sentence("electric.main-fuse"), f"F0: 3 x {fuse:g} A gG"),
        (Sentence("electric.main-wire"), f"5 x {section:g} mm² Cu, PE {protective_section(section):g} mm²"),
        *sources,
    )
    title = Sentence("electric.supply")
    heads = Column(Sentence("electric.what")), Column(Sentence("electric.value"))
    held = braked(loom)
    own = {volts: [_drawn(motor, held) for motor in plan.motors if motor.load.volts == volts] for volts in _VOLTS}
    picture = single_line(
        f"3 × {MAINS:g} V N PE",
        f"3 × {fuse:g} A",
        [*own[MAINS], *own[PHASE]],
        [
            FedRow(
                SIGNS[source.part],
                f"{source.number * source.row.phases} × {source.fused.rating:g} A",
                f"{source.number} × {source.row.amperes:g} A",
                Sentence("electric.direct", volts=f"{source.row.volts:g} V"),
                own[source.row.volts],
            )
            for source in plan.sources
        ],
    )
    (control,) = site_of(loom).near.of(CONTROL)
    height = in_mm(HANDLE * float(control.high[1] - control.low[1]))
    return PaperSection(
        title, (Sentence("electric.supply-how", height=height),), Table("supply", title, heads, rows), figure=picture
    )


_VOLTS = (MAINS, PHASE, STEPPER_VOLTS, CONTROL_VOLTS)


def _drawn(one: MotorCircuit, held: Mapping[str, str]) -> MotorRow:
    load, brake = one.load, held.get(one.part.id, "")
    return MotorRow(
        one.sign[1:],
        one.number,
        f"{load.phases}~",
        f"{one.number * load.poles} × {load.fuse:g} A",
        f"{load.amplifier:g} A, STO, SLS",
        f"{load.wires} × {one.section:g} mm²",
        f"{one.number} × {one.part.title}",
        f"{format_quantity(load.power, 'W', 3)}, {load.current:.3g} A" + (f", {brake}" if brake else ""),
    )


def _brakes(loom: LoomDesign) -> Iterator[PaperSection]:
    numbers = numbers_of(loom)
    rows = tuple(
        (sign, part.title, row.row, numbers[part.id], row.power, row.power / CONTROL_VOLTS, f"T{sign[1:]}: BR+, BR-")
        for _, sign, part in brakes(loom)
        for row in [bought_of(part)]
    )
    heads = (
        Column(Sentence("electric.sign")),
        Column(Sentence("electric.device")),
        Column(Sentence("electric.designation")),
        Column(Sentence("electric.pieces")),
        Column(Sentence("electric.power"), "W", 3),
        Column(Sentence("electric.current"), "", 3),
        Column(Sentence("electric.terminal")),
    )
    title = Sentence("electric.brakes")
    if rows:
        yield PaperSection(title, (Sentence("electric.brakes-how"),), Table("brakes", title, heads, rows))


def _motors(plan: PowerPlan) -> PaperSection:
    heads = (
        Column(Sentence("electric.sign")),
        Column(Sentence("electric.motor")),
        Column(Sentence("electric.designation")),
        Column(Sentence("electric.pieces")),
        Column(Sentence("electric.power"), "W", 3),
        Column(Sentence("electric.current"), "", 3),
        Column(Sentence("electric.amplifier"), "", 3),
        Column(Sentence("electric.fuse"), "", 3),
        Column(Sentence("electric.section"), "", 3),
        Column(Sentence("electric.together")),
        Column(Sentence("electric.phase")),
    )
    phases = plan.phasing
    rows = tuple(
        (
            motor.sign,
            motor.part.title,
            bought_of(motor.part).row,
            motor.number,
            motor.load.power,
            motor.load.current,
            motor.load.amplifier,
            motor.load.fuse,
            motor.section,
            motor.together,
            _phases(motor, phases),
        )
        for motor in plan.motors
    )
    title = Sentence("electric.motors")
    return PaperSection(title, (Sentence("electric.motors-how"),), Table("motors", title, heads, rows))


def _phases(motor: MotorCircuit, phases: Mapping[str, tuple[int, ...]]) -> str:
    """The phase of each piece in their order; "" of one on direct current."""
    if motor.load.volts == MAINS:
        return "L1 L2 L3"
    return " ".join(f"L{phase}" for phase in phases.get(motor.part.id, ()))


def _feeds(loom: LoomDesign, plan: PowerPlan) -> PaperSection:
    heads = (
        Column(Sentence("electric.consumer")),
        Column(Sentence("electric.pieces")),
        Column(Sentence("electric.volts"), "", 3),
        Column(Sentence("electric.all-power"), "W", 3),
        Column(Sentence("electric.fed-by")),
    )
    rows = tuple((own.part.title, own.number, own.volts, own.power, own.sign) for own in feeds(loom))
    title = Sentence("electric.feeds")
    texts = tuple(
        Sentence(
            "electric.source",
            sign=SIGNS[own.part],
            row=f"{own.number} × {own.row.name}",
            load=format_quantity(own.load, "W", 3),
            rated=format_quantity(own.number * own.row.rated, "W", 3),
            bar=f"{section_for(own.number * own.row.amperes):g}",
        )
        for own in plan.sources
    )
    braking = (Sentence("electric.braking"),) if plan.steppers else ()
    return PaperSection(title, (*texts, *braking), Table("feeds", title, heads, rows))


def _sensors(loom: LoomDesign) -> PaperSection:
    return _devices(loom, Sentence("electric.sensors"), SENSING, signs_of(loom), connected_at(loom))


def _devices(
    loom: LoomDesign, title: str, kinds: frozenset[str], signs: Mapping[str, str], at: Mapping[str, str] | None = None
) -> PaperSection:
    """Devices of some kinds with their signs, by their ids, the signals that they give, and where each is connected."""
    given = dict[str, list[str]]()
    for name, _, _, parts in signal_rows(loom):
        for part in parts.split():
            given.setdefault(part, []).append(name)
    rows = tuple(
        (
            signs.get(part.id, ""),
            part.title,
            part.purchase.row,
            number,
            listed(given.get(part.id, ())),
            *(() if at is None else (at.get(part.id, ""),)),
        )
        for part, number in loom_tree(loom).occurrences()
        if part.process in kinds and part.purchase is not None
    )
    heads = (
        Column(Sentence("electric.sign")),
        Column(Sentence("electric.device")),
        Column(Sentence("electric.designation")),
        Column(Sentence("electric.pieces")),
        Column(Sentence("electric.signals")),
        *(() if at is None else (Column(Sentence("electric.connected-at")),)),
    )
    return PaperSection(title, (), Table("devices", title, heads, rows))


def _terminals(loom: LoomDesign) -> PaperSection:
    title = Sentence("electric.terminals")
    heads = (
        Column(Sentence("electric.signal")),
        Column(Sentence("electric.input")),
        Column(Sentence("electric.terminal")),
        Column(Sentence("electric.parts")),
    )
    table = Table("terminals", title, heads, tuple(signal_rows(loom)))
    return PaperSection(title, (Sentence("electric.terminals-how"),), table)


def _cabinet(loom: LoomDesign, plan: PowerPlan) -> PaperSection:
    """What stands in the cabinet, its size, mass and heat."""
    tree = loom_tree(loom)
    (cabinet,) = (part for part, _ in tree.occurrences() if part.id == CONTROL)
    on_plate = [part for part, _ in tree.occurrences() if part.id in {MOUNTING_PLATE, AMPLIFIER}]
    inside = [*on_plate, *(own.part for own in tree.body(CIRCUIT).occurrences)]
    numbers = numbers_of(loom)
    rows = tuple((SIGNS.get(part.id, ""), part.title, bought_of(part).row, numbers[part.id]) for part in inside)
    heads = (
        Column(Sentence("electric.sign")),
        Column(Sentence("electric.device")),
        Column(Sentence("electric.designation")),
        Column(Sentence("electric.pieces")),
    )
    assert cabinet.shape is not None
    size = " × ".join(f"{own / mm:.0f}" for own in np.ptp(shape_box(cabinet.shape), axis=0).tolist())
    mass = math.fsum(numbers[part.id] * part.mass for part in inside) + cabinet.mass
    how = Sentence(
        "electric.cabinet-how",
        size=size,
        mass=format_quantity(mass, "kg", 3),
        heat=format_quantity(plan.heat, "W", 3),
        rise=f"{WARMER:g} K",
    )
    title = Sentence("electric.cabinet")
    return PaperSection(title, (how,), Table("cabinet", title, heads, rows))


def _safety(loom: LoomDesign, report: Report) -> PaperSection:
    functions, stops = tuple(safety_functions(loom, report)), stopping_time(loom)
    signs = {name: sign for own in functions for name, sign in own.signs.items()}
    made = _devices(loom, Sentence("electric.safety"), SAFE, signs | {name: SIGNS[name] for name in _SAFE_SIGNS})
    inputs = {own.part: own.address for own in channels(loom)}
    halts = inputs[signals.RELAY], inputs[signals.GUARD_RELAY]
    runs = dict[str, list[TerminalLevel]]()
    for level in levels_of(loom):
        if level.strip == "X3":
            runs.setdefault(level.part, []).append(level)
    ends = {part: f"{run[0].address} … {run[-1].number}{run[-1].level}" for part, run in runs.items()}
    text = Sentence(
        "electric.safety-how",
        relay=RELAY.name,
        circuit=format_quantity(stops.circuit, "s", 3),
        whole=format_quantity(stops.whole, "s", 3),
        axis=stops.axis,
        halt=" / ".join(halts),
        stops=SIGNS[signals.RELAY],
        guards=SIGNS[signals.GUARD_RELAY],
    )
    chains: tuple[list[SafeSwitch], list[SafeSwitch]] = [], []
    for own in functions:
        row = SafeSwitch(own.sign, own.number, " ".join(ends[part] for part in own.pieces))
        chains[own.relay == signals.GUARD_RELAY].append(row)
    setting = (SafeSwitch(SIGNS[part], 1, ends.get(part, "")) for part in _SETTING)
    relays = (
        SafeRelay(SIGNS[signals.RELAY], chains[0], halts[0]),
        SafeRelay(SIGNS[signals.GUARD_RELAY], chains[1], halts[1]),
    )
    picture = safety_circuit(*relays, *setting, amplifiers=numbers_of(loom)[AMPLIFIER])
    enabling = Sentence("electric.enabling-how", sign=SIGNS[signals.ENABLING], mode=SIGNS[signals.MODE])
    texts = text, enabling, Sentence("electric.residual")
    return PaperSection(made.title, texts, made.table, figure=picture)


_SAFE_SIGNS = signals.RELAY, signals.GUARD_RELAY, signals.RESET, signals.ENABLING, signals.MODE

_SETTING = signals.ENABLING, signals.MODE, signals.RESET
