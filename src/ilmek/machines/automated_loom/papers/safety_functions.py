"""The safety functions of a loom: the level that its hazards require, and the level that their devices reach.

What is reached is the sum over the chain: all devices that open it, the relay, and every amplifier that it stops.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from ilmek.elements.field_devices import AMPLIFIER_FAILURES, BUTTON, GRID, INTERLOCK, RELAY, STOP, FieldDevice
from ilmek.elements.performance_levels import COVERED, contact_failures, masked, reached_level
from ilmek.machines.automated_loom.cabinet import AMPLIFIER
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.papers.values import value_of
from ilmek.records import record
from ilmek.report import Report
from ilmek.sentences import Sentence
from ilmek.units import hour

TESTED = 8.0
"""Time between two tests of an emergency stop [h]: once a shift; assumed by this project."""


@record
class SafetyFunction:
    """What stops all axes.

    title, sign  of it      pieces   of the parts that start it, by their ids      failures  dangerous ones [1/h]
    relay        id of the one whose channels they open
    """

    title: str
    sign: str
    relay: str
    pieces: Mapping[str, int]
    failures: float

    @property
    def part(self) -> str:
        """The first of its parts."""
        return next(iter(self.pieces))

    @property
    def number(self) -> int:
        """Pieces that start it; sender and receiver of a light grid are one."""
        return 1 if self.part == signals.GRID else sum(self.pieces.values())

    @property
    def signs(self) -> dict[str, str]:
        """Signs of its pieces by the ids of their parts."""
        ends = np.cumsum([*self.pieces.values()]).tolist()
        return {
            part: f"{self.sign}{end}" if number == 1 else f"{self.sign}{end - number + 1} … {end}"
            for end, (part, number) in zip(ends, self.pieces.items(), strict=True)
        }

    @property
    def level(self) -> str:
        """The performance level that it reaches; "": none."""
        return reached_level(self.failures)


def safety_functions(loom: LoomDesign, report: Report) -> Iterator[SafetyFunction]:
    """The safety functions of the devices that are in a loom."""
    numbers = {part.id: number for part, number in loom_tree(loom).occurrences()}
    stops = RELAY.failures + numbers[AMPLIFIER] * AMPLIFIER_FAILURES
    for title, sign, parts, device, hourly in starters(report):
        pieces = {part: numbers[part] for part in parts if part in numbers}
        if pieces:
            relay = signals.RELAY if device is STOP else signals.GUARD_RELAY
            bare = SafetyFunction(title, sign, relay, pieces, 0.0)
            contacts = contact_failures(device.b10d, hourly, coverage_of(bare, device)) if device.b10d else 0.0
            each = device.failures + contacts
            yield replace(bare, failures=bare.number * each + stops)


def coverage_of(function: SafetyFunction, device: FieldDevice) -> float:
    """Diagnostic coverage of the contacts of a function: in series those that are rarely used hide each other's."""
    return masked(function.number) if device is STOP else COVERED


def starters(report: Report) -> tuple[tuple[str, str, tuple[str, ...], FieldDevice, float], ...]:
    """What starts the safety functions: title, sign, parts, row, operations in an hour."""
    return (
        (Sentence("risk.by-stop"), "S", (signals.STOP, signals.BENCH_STOP), STOP, 1 / TESTED),
        (Sentence("risk.by-door"), "B", (signals.INTERLOCK,), INTERLOCK, 0.0),
        (Sentence("risk.by-grid"), "B", (signals.GRID,), GRID, 0.0),
        (Sentence("risk.by-hands"), "H", (signals.HANDS,), BUTTON, hour / value_of(report, "row_time")),
    )
