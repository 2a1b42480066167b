"""The ports between a controller and a loom: orders to its actuators, reports of its sensors.

A loom, real or simulated, stands behind `LoomPort`. Times are whole nanoseconds of the loom's own clock, so that a run
is the same on every processor.
"""

from collections.abc import Sequence
from enum import StrEnum
from typing import Protocol, TypeAlias

from ilmek.loom.operations import RowEnd, Stop
from ilmek.records import value_record


@value_record
class Tie:
    """A head goes to warp pair `column`, aligns tube `tube` and ties a knot; number: of the head's knots in the row."""

    head: int
    row: int
    number: int
    column: int
    tube: int


@value_record
class StandAside:
    """A head without a knot in a phase of a row goes to warp pair `column`, out of the others' reach, as they begin."""

    head: int
    row: int
    phase: int
    column: int


@value_record
class EndRow:
    """An operation after the knots of a row."""

    row: int
    operation: RowEnd


@value_record
class ChangePackages:
    """The operator is to change packages; the loom stands until it is reported as done."""

    stop: Stop


@value_record
class Jog:
    """An axis moves by a distance [m or rad], in manual mode."""

    axis: str
    distance: float


@value_record
class Home:
    """An axis goes to its switch and takes its position there, after power-up."""

    axis: str


Order: TypeAlias = Tie | StandAside | EndRow | ChangePackages | Jog | Home


class Fault(StrEnum):
    """What a loom reports instead of the end of an operation."""

    PILE_END = "pile yarn end"
    PILE_BREAK = "pile yarn break"
    MISSED_GRIP = "gripper miss"
    WEFT_BREAK = "weft break"
    WEFT_END = "weft end"
    WARP_BREAK = "warp break"
    TIMEOUT = "operation not finished in time"


@value_record
class Done:
    """An order was carried out, at a time [ns]."""

    order: Order
    time: int


@value_record
class Failed:
    """An order failed; after a first missed grip nothing of it is in the carpet, else that is asked. Time [ns]."""

    order: Order
    fault: Fault
    time: int


@value_record
class Sensors:
    """State of the sensors that the interlocks read.

    door_closed, emergency_stop    of the guard
    warp_tension                   of a warp, mean [N]; None: the sensor does not answer
    grippers_open                  of each head: no gripper is closed on warps
    heads_clear                    the heads have retreated from the comb's path
    beater_back                    the beater is at its rest
    shed_closed                    the warps are level
    """

    door_closed: bool
    emergency_stop: bool
    warp_tension: float | None
    grippers_open: tuple[bool, ...]
    heads_clear: bool
    beater_back: bool
    shed_closed: bool


@value_record
class SensorsChanged:
    """The sensors, from a time [ns] on."""

    sensors: Sensors
    time: int


PortReport: TypeAlias = Done | Failed | SensorsChanged


class LoomPort(Protocol):
    """A loom, real or simulated.

    Reports come in the order of their times. Changes of the sensors are reported: what an operation changes and changes
    back before its `Done`. Of knots this is not required; of a beat it is `beater_back`, of a weft `shed_closed`, else
    the controller takes the sensor for stuck.
    """

    def send(self, orders: Sequence[Order]) -> None:
        """Begin operations. A head, and the loom for an EndRow, must be idle."""

    def receive(self, timeout: float) -> tuple[PortReport, ...]:
        """What has happened since the last call, in order; waits for at most `timeout` [s] of the caller's clock."""

    def halt(self) -> None:
        """Bring every motion to a stop at once, the operations in progress unfinished; all axes are idle afterwards.

        What had ended before is still reported; what was cut off never is, and may or may not be in the carpet.
        """

    def set_speed(self, factor: float) -> None:
        """Speed of the operations that begin from now on, as a fraction of the programme's: > 0, 1 at first."""

    def sensors(self) -> Sensors:
        """The sensors now: the controller is given them first."""

    def knotted(self, row: int, column: int) -> bool | None:
        """Whether the sensor finds a knot on a warp pair of the row in work; None: it cannot tell."""

    def ended(self, row: int, operation: RowEnd) -> bool | None:
        """Whether an operation after the knots of a row has been carried out; None: the sensor cannot tell."""
