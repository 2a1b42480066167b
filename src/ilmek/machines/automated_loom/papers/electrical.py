"""The electrical plan of a loom: supply, motors with fuses and wires, sensors, terminals, safety circuit.

    servo     I = P / (sqrt(3) U e),  U 230 V of three phases       stepper   I = P / (U e),  U 48 V of its amplifier
    supply    I = sum P / e / (sqrt(3) U),  U 400 V, all at their rated power

e is efficiency times power factor, 0.75; all assumed by this project.
"""

import math
from collections.abc import Iterator, Mapping

from ilmek.elements.field_devices import AMPLIFIERS, RELAY, SUPPLY
from ilmek.elements.motors import STEPPER
from ilmek.elements.wiring import fuse_for, protective_section, section_for
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.signals import signals_of
from ilmek.machines.automated_loom.equipment.stopping import stopping_time
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.papers.circuit_diagrams import safety_circuit, single_line
from ilmek.machines.automated_loom.papers.safety_functions import safety_functions
from ilmek.machines.automated_loom.papers.values import value_of
from ilmek.machines.automated_loom.standing_frame import AMPLIFIER
from ilmek.machines.weaver.tree import HEAD
from ilmek.part.part import Part
from ilmek.records import record
from ilmek.report import Column, Paper, PaperSection, Report, Table
from ilmek.sentences import Sentence
from ilmek.units import format_quantity

MAINS, SERVO_VOLTS, STEPPER_VOLTS, EFFICIENCY = 400.0, 230.0, 48.0, 0.75

CONTROL_POWER = 24.0 * 10.0
"""Of the supply of the control [W], between two phases of 230 V."""

SENSING = frozenset(("sensor", "load cell", "yarn sensor", "light barrier"))
SAFE = frozenset(("emergency stop", "interlock", "light grid", "button", "safety relay"))
"""Processes of sensors, and of devices of the safety circuit."""


@record
class MotorCircuit:
    """Motors of a part, by their sign in the plan: pieces, cables that lie together."""

    sign: str
    part: Part
    number: int
    together: int

    @property
    def power(self) -> float:
        """Rated power of each [W]."""
        assert self.part.purchase is not None
        return self.part.purchase.power

    @property
    def current(self) -> float:
        """At the rated power [A]."""
        volts = STEPPER_VOLTS if self.part.process == STEPPER else math.sqrt(3) * SERVO_VOLTS
        return self.power / (volts * EFFICIENCY)

    @property
    def fuse(self) -> float:
        """Rating of its fuse [A]."""
        return fuse_for(self.current)

    @property
    def amplifier(self) -> float:
        """Rated current of its amplifier [A]; nan above the series."""
        return next((rated for rated in AMPLIFIERS if rated >= self.current), math.nan)

    @property
    def section(self) -> float:
        """Section of its wires [mm²]."""
        return section_for(self.fuse, self.together)


def motor_circuits(loom: LoomDesign) -> tuple[MotorCircuit, ...]:
    """The circuits of all motors; the cables of those on a head lie together in its energy chain."""
    tree = loom_tree(loom)
    ridden = tree.carried_by(HEAD) if loom.heads else ()
    on_head = {own.part.id for name in ridden for own in tree.body(name).occurrences}
    motors = [
        (part, number) for part, number in tree.occurrences() if part.purchase is not None and part.purchase.drives
    ]
    together = sum(number // loom.heads for part, number in motors if part.id in on_head)
    return tuple(
        MotorCircuit(f"-M{sign}", part, number, together if part.id in on_head else 1)
        for sign, (part, number) in enumerate(motors, 1)
    )


def electrical(loom: LoomDesign, report: Report) -> Paper:
    """Supply, motors, sensors, terminals, safety circuit."""
    circuits = motor_circuits(loom)
    return Paper(
        "electrical",
        Sentence("electric.title"),
        Sentence("electric.lead"),
        (
            _supply(report, circuits),
            _motors(circuits),
            _sensors(loom),
            _terminals(loom),
            _safety(loom, report),
        ),
    )


def connected_load(circuits: tuple[MotorCircuit, ...]) -> float:
    """Apparent power of all motors at their rated power [VA]."""
    return math.fsum(one.number * one.power for one in circuits) / EFFICIENCY


def _supply(report: Report, circuits: tuple[MotorCircuit, ...]) -> PaperSection:
    load = connected_load(circuits)
    current = load / (math.sqrt(3) * MAINS)
    fuse = fuse_for(current)
    section = section_for(fuse)
    rows = [
        (Sentence("electric.mains"), f"3 x {MAINS:g} V, N, PE"),
        (Sentence("electric.connected"), f"{load / 1e3:.3g} kVA"),
        (Sentence("electric.mean"), format_quantity(value_of(report, "power_mean"), "W", 3)),
        (Sentence("electric.main-current"), f"{current:.3g} A"),
        (Sentence("electric.main-fuse"), f"3 x {fuse:g} A gG"),
        (Sentence("electric.main-wire"), f"5 x {section:g} mm² Cu, PE {protective_section(section):g} mm²"),
    ]
    if math.isnan(section):  # more than one cable
        del rows[-2:]
    title = Sentence("electric.supply")
    heads = Column(Sentence("electric.what")), Column(Sentence("electric.value"))
    picture = single_line(
        f"3 × {MAINS:g} V N PE",
        f"{fuse:g} A",
        [
            (
                "2~" if one.part.process == STEPPER else "3~",
                f"{one.number} × {one.fuse:g} A",
                f"{one.amplifier:g} A, STO",
                f"4 × {one.section:g} mm²",
                f"{one.number} × {one.part.title}",
                f"{format_quantity(one.power, 'W', 3)}, {one.current:.3g} A",
            )
            for one in circuits
        ],
        (f"{fuse_for(CONTROL_POWER / SERVO_VOLTS / EFFICIENCY):g} A", Sentence("electric.control", supply=SUPPLY.name)),
    )
    return PaperSection(
        title, (Sentence("electric.supply-how"),), Table("supply", title, heads, tuple(rows)), figure=picture
    )


def _motors(circuits: tuple[MotorCircuit, ...]) -> PaperSection:
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
            one.sign,
            one.part.title,
            one.part.purchase.row if one.part.purchase else "",
            one.number,
            one.power,
            one.current,
            one.amplifier,
            one.fuse,
            one.section,
            one.together,
        )
        for one in circuits
    )
    title = Sentence("electric.motors")
    return PaperSection(title, (Sentence("electric.motors-how"),), Table("motors", title, heads, rows))


def _sensors(loom: LoomDesign) -> PaperSection:
    sensors = [part.id for part, _ in loom_tree(loom).occurrences() if part.process in SENSING]
    signs = {part: f"-B{number}" for number, part in enumerate(sensors, 11)}
    return _devices(loom, Sentence("electric.sensors"), SENSING, signs)


def _devices(loom: LoomDesign, title: str, kinds: frozenset[str], signs: Mapping[str, str]) -> PaperSection:
    """Devices of some kinds with their signs, by their ids, and the signals that they give."""
    given = dict[str, list[str]]()
    for name, parts in signals_of(loom.heads, loom.weavers):
        for part in parts:
            given.setdefault(part, []).append(name)
    rows = tuple(
        (signs.get(part.id, ""), part.title, part.purchase.row, number, ", ".join(given.get(part.id, ())))
        for part, number in loom_tree(loom).occurrences()
        if part.process in kinds and part.purchase is not None
    )
    heads = (
        Column(Sentence("electric.sign")),
        Column(Sentence("electric.device")),
        Column(Sentence("electric.designation")),
        Column(Sentence("electric.pieces")),
        Column(Sentence("electric.signals")),
    )
    return PaperSection(title, (), Table("devices", title, heads, rows))


def terminal_rows(loom: LoomDesign) -> Iterator[tuple[str, int, str, str]]:
    """Each signal of the control with an address: its name, its terminal and level, its parts."""
    there = {part.id for part, _ in loom_tree(loom).occurrences()}
    for number, (name, parts) in enumerate(signals_of(loom.heads, loom.weavers)):
        yield name, number // 2 + 1, "ab"[number % 2], " ".join(part for part in parts if part in there)


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


def _safety(loom: LoomDesign, report: Report) -> PaperSection:
    functions, stops = tuple(safety_functions(loom, report)), stopping_time(loom)
    signs = {own.part: "-" + own.sign + ("1" if own.number == 1 else f"1 … {own.number}") for own in functions}
    signs |= {signals.RELAY: "-K1", signals.RESET: "-S0"}
    made = _devices(loom, Sentence("electric.safety"), SAFE, signs)
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
    (axes,) = (number for part, number in loom_tree(loom).occurrences() if part.id == AMPLIFIER)
    picture = safety_circuit(devices, axes, addresses[signals.RELAY])
    return PaperSection(made.title, (text, Sentence("electric.residual")), made.table, figure=picture)
