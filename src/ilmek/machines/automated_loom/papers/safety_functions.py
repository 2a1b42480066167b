"""The safety functions of a loom: the level that its hazards require, and the level that their devices reach.

What is reached is the sum over the chain: all devices that open it, the relay, and every amplifier that it stops.
"""

from collections.abc import Iterator

from ilmek.elements.field_devices import AMPLIFIER_FAILURES, BUTTON, GRID, INTERLOCK, RELAY, STOP, FieldDevice
from ilmek.elements.performance_levels import contact_failures, reached_level
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.papers.values import value_of
from ilmek.machines.automated_loom.standing_frame import AMPLIFIER
from ilmek.records import record
from ilmek.report import Report
from ilmek.sentences import Sentence
from ilmek.units import hour

TESTED = 8.0
"""Time between two tests of an emergency stop [h]: once a shift; assumed by this project."""


@record
class SafetyFunction:
    """What stops all axes: its title, the sign, part and pieces of what starts it, its dangerous failures [1/h]."""

    title: str
    sign: str
    part: str
    number: int
    failures: float

    @property
    def level(self) -> str:
        """The performance level that it reaches; "": none."""
        return reached_level(self.failures)


def safety_functions(loom: LoomDesign, report: Report) -> Iterator[SafetyFunction]:
    """The safety functions of the devices that are in a loom."""
    numbers = {part.id: number for part, number in loom_tree(loom).occurrences()}
    stops = RELAY.failures + numbers[AMPLIFIER] * AMPLIFIER_FAILURES
    rows: tuple[tuple[str, str, str, FieldDevice, float], ...] = (
        (Sentence("risk.by-stop"), "S", signals.STOP, STOP, 1 / TESTED),
        (Sentence("risk.by-door"), "B", signals.INTERLOCK, INTERLOCK, 0.0),
        (Sentence("risk.by-grid"), "B", signals.GRID, GRID, 0.0),
        (Sentence("risk.by-hands"), "H", signals.HANDS, BUTTON, hour / value_of(report, "row_time")),
    )
    for title, sign, part, device, hourly in rows:
        if part in numbers:
            each = device.failures + (contact_failures(device.b10d, hourly) if device.b10d else 0.0)
            pieces = 1 if device is GRID else numbers[part]  # sender and receiver are one device
            yield SafetyFunction(title, sign, part, pieces, pieces * each + stops)
