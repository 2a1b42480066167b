"""The electrical plan of a loom: supply, motors with fuses and wires, sensors, terminals, safety circuit.

    servo     I = P / (sqrt(3) U e),  U 230 V of three phases       stepper   I = P / (U e),  U 48 V of its amplifier
    supply    I = sum P / e / (sqrt(3) U),  U 400 V, all at their rated power

e is efficiency times power factor, 0.75; all assumed by this project.
"""

import math
from collections.abc import Iterator

from ilmek.elements.field_devices import RELAY
from ilmek.elements.motors import STEPPER
from ilmek.elements.wiring import fuse_for, protective_section, section_for
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.signals import signals_of
from ilmek.machines.automated_loom.equipment.stopping import stopping_time
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.papers.values import value_of
from ilmek.part.part import Part
from ilmek.records import record
from ilmek.report import Column, Paper, PaperSection, Report, Table
from ilmek.sentences import Sentence
from ilmek.units import format_quantity

MAINS, SERVO_VOLTS, STEPPER_VOLTS, EFFICIENCY = 400.0, 230.0, 48.0, 0.75

SENSING = frozenset(("sensor", "load cell", "yarn sensor", "light barrier"))
SAFE = frozenset(("emergency stop", "interlock", "light grid", "button", "safety relay"))
"""Processes of sensors, and of devices of the safety circuit."""


@record
class MotorCircuit:
    """Motors of a part: pieces, cables that lie together, current of each [A]."""

    part: Part
    number: int
    together: int
    power: float

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
    def section(self) -> float:
        """Section of its wires [mm²]."""
        return section_for(self.fuse, self.together)


def motor_circuits(loom: LoomDesign) -> tuple[MotorCircuit, ...]:
    """The circuits of all motors; the cables of those on a head lie together in its energy chain."""
    motors = [
        (part, number, part.purchase.power)
        for part, number in loom_tree(loom).occurrences()
        if part.purchase is not None and part.purchase.drives
    ]
    on_head = sum(number // loom.heads for part, number, _ in motors if _on_head(part)) if loom.heads else 1
    return tuple(MotorCircuit(part, number, on_head if _on_head(part) else 1, power) for part, number, power in motors)


def _on_head(part: Part) -> bool:
    return part.id.startswith("weaver/")


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
            _devices(loom, Sentence("electric.sensors"), SENSING),
            _terminals(loom),
            _safety(loom),
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
    return PaperSection(title, (Sentence("electric.supply-how"),), Table("supply", title, heads, tuple(rows)))


def _motors(circuits: tuple[MotorCircuit, ...]) -> PaperSection:
    heads = (
        Column(Sentence("electric.motor")),
        Column(Sentence("electric.designation")),
        Column(Sentence("electric.pieces")),
        Column(Sentence("electric.power"), "W", 3),
        Column(Sentence("electric.current"), "", 3),
        Column(Sentence("electric.fuse"), "", 3),
        Column(Sentence("electric.section"), "", 3),
        Column(Sentence("electric.together")),
    )
    rows = tuple(
        (
            one.part.title,
            one.part.purchase.row if one.part.purchase else "",
            one.number,
            one.power,
            one.current,
            one.fuse,
            one.section,
            one.together,
        )
        for one in circuits
    )
    title = Sentence("electric.motors")
    return PaperSection(title, (Sentence("electric.motors-how"),), Table("motors", title, heads, rows))


def _devices(loom: LoomDesign, title: str, kinds: frozenset[str]) -> PaperSection:
    """Devices of some kinds with the signals that they give."""
    signals = dict[str, list[str]]()
    for name, parts in signals_of(loom.heads, loom.weavers):
        for part in parts:
            signals.setdefault(part, []).append(name)
    rows = tuple(
        (part.title, part.purchase.row, number, ", ".join(signals.get(part.id, ())))
        for part, number in loom_tree(loom).occurrences()
        if part.process in kinds and part.purchase is not None
    )
    heads = (
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


def _safety(loom: LoomDesign) -> PaperSection:
    made, stops = _devices(loom, Sentence("electric.safety"), SAFE), stopping_time(loom)
    text = Sentence(
        "electric.safety-how",
        relay=RELAY.name,
        circuit=format_quantity(stops.circuit, "s", 3),
        whole=format_quantity(stops.whole, "s", 3),
        axis=stops.axis,
    )
    return PaperSection(made.title, (text, Sentence("electric.residual")), made.table)
