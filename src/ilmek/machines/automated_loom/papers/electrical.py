"""The electrical plan of a loom: supply, motors with fuses and wires, sensors, terminals, cabinet, safety circuit.

What feeds what is `equipment.power_plan`, what stands in the cabinet `equipment.circuit`.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from ilmek.elements.cabinet_devices import WARMER
from ilmek.elements.field_devices import RELAY
from ilmek.elements.motor_loads import CONTROL_VOLTS, MAINS, PHASE, STEPPER_VOLTS
from ilmek.elements.wiring import protective_section, section_for
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.circuit import CIRCUIT
from ilmek.machines.automated_loom.equipment.power_plan import MotorCircuit, PowerPlan
from ilmek.machines.automated_loom.equipment.signals import signals_of
from ilmek.machines.automated_loom.equipment.stopping import stopping_time
from ilmek.machines.automated_loom.equipment.surroundings import CONTROL
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.papers.braking import braking_section
from ilmek.machines.automated_loom.papers.circuit_diagrams import FedRow, MotorRow, safety_circuit, single_line
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
    numbers_of,
    plan_of,
    run_of,
    signs_of,
    terminal_rows,
)
from ilmek.machines.automated_loom.standing_frame import AMPLIFIER
from ilmek.part.shapes import shape_box
from ilmek.report import Column, Paper, PaperSection, Report, Table
from ilmek.sentences import Sentence
from ilmek.units import format_quantity, mm

SAFE = frozenset(("emergency stop", "interlock", "actuator", "light grid", "button", "safety relay", "enabling device"))
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
            *_channels(loom),
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
        (Sentence("electric.main-current"), f"{plan.current:.3g} A"),
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
    return PaperSection(title, (Sentence("electric.supply-how"),), Table("supply", title, heads, rows), figure=picture)


_VOLTS = (MAINS, PHASE, STEPPER_VOLTS, CONTROL_VOLTS)


def _drawn(one: MotorCircuit, held: Mapping[str, str]) -> MotorRow:
    load, brake = one.load, held.get(one.part.id, "")
    return MotorRow(
        one.sign[1:],
        one.number,
        f"{load.phases}~",
        f"{one.number * load.poles} × {load.fuse:g} A",
        f"{load.amplifier:g} A, STO",
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
    )
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
        )
        for motor in plan.motors
    )
    title = Sentence("electric.motors")
    return PaperSection(title, (Sentence("electric.motors-how"),), Table("motors", title, heads, rows))


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
        )
        for own in plan.sources
    )
    braking = (Sentence("electric.braking"),) if plan.steppers else ()
    return PaperSection(title, (*texts, *braking), Table("feeds", title, heads, rows))


def _channels(loom: LoomDesign) -> Iterator[PaperSection]:
    """A row for each run of inputs of a module that read pieces of one sensor."""
    titles = {part.id: part.title for part, _ in loom_tree(loom).occurrences()}
    signs, runs = signs_of(loom), dict[tuple[str, str], list[tuple[int, int]]]()
    for module, number, name, piece in channels(loom):
        runs.setdefault((module, name), []).append((number, piece))
    rows = tuple(
        (module, run_of([own[0] for own in run]), signs[name], titles[name], run_of([own[1] for own in run]))
        for (module, name), run in runs.items()
    )
    heads = (
        Column(Sentence("electric.module")),
        Column(Sentence("electric.inputs")),
        Column(Sentence("electric.sign")),
        Column(Sentence("electric.device")),
        Column(Sentence("electric.piece")),
    )
    title = Sentence("electric.channels")
    if rows:
        yield PaperSection(title, (Sentence("electric.channels-how"),), Table("channels", title, heads, rows))


def _sensors(loom: LoomDesign) -> PaperSection:
    return _devices(loom, Sentence("electric.sensors"), SENSING, signs_of(loom), connected_at(loom))


def _devices(
    loom: LoomDesign, title: str, kinds: frozenset[str], signs: Mapping[str, str], at: Mapping[str, str] | None = None
) -> PaperSection:
    """Devices of some kinds with their signs, by their ids, the signals that they give, and where each is connected."""
    given = dict[str, list[str]]()
    for name, parts in signals_of(loom.heads, loom.weavers):
        for part in parts:
            given.setdefault(part, []).append(name)
    rows = tuple(
        (
            signs.get(part.id, ""),
            part.title,
            part.purchase.row,
            number,
            ", ".join(given.get(part.id, ())),
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
        Column(Sentence("electric.terminal")),
        Column(Sentence("electric.level")),
        Column(Sentence("electric.parts")),
    )
    table = Table("terminals", title, heads, tuple(terminal_rows(loom)))
    return PaperSection(title, (Sentence("electric.terminals-how"),), table)


def _cabinet(loom: LoomDesign, plan: PowerPlan) -> PaperSection:
    """What stands in the cabinet, its size, mass and heat."""
    tree = loom_tree(loom)
    (cabinet,) = (part for part, _ in tree.occurrences() if part.id == CONTROL)
    inside = [own.part for own in tree.body(CIRCUIT).occurrences]
    numbers = numbers_of(loom)
    amplifiers = [part for part, _ in tree.occurrences() if part.id == AMPLIFIER]
    rows = tuple(
        (SIGNS.get(part.id, ""), part.title, bought_of(part).row, numbers[part.id]) for part in (*amplifiers, *inside)
    )
    heads = (
        Column(Sentence("electric.sign")),
        Column(Sentence("electric.device")),
        Column(Sentence("electric.designation")),
        Column(Sentence("electric.pieces")),
    )
    assert cabinet.shape is not None
    size = " × ".join(f"{own / mm:.0f}" for own in np.ptp(shape_box(cabinet.shape), axis=0).tolist())
    mass = sum(numbers[part.id] * part.mass for part in inside if part.mass > 0) + cabinet.mass
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
    text = Sentence(
        "electric.safety-how",
        relay=RELAY.name,
        circuit=format_quantity(stops.circuit, "s", 3),
        whole=format_quantity(stops.whole, "s", 3),
        axis=stops.axis,
    )
    addresses = {
        part: f"X1:{number}{level}" for _, number, level, parts in terminal_rows(loom) for part in parts.split()[:1]
    }
    devices = [(own.sign, own.number, addresses.get(own.part, "")) for own in functions]
    picture = safety_circuit(devices, SIGNS[signals.ENABLING], numbers_of(loom)[AMPLIFIER], addresses[signals.RELAY])
    texts = text, Sentence("electric.enabling-how", sign=SIGNS[signals.ENABLING]), Sentence("electric.residual")
    return PaperSection(made.title, texts, made.table, figure=picture)


_SAFE_SIGNS = signals.RELAY, signals.RESET, signals.ENABLING
