"""What goes into the controller and what comes out: the whole of its face.

    outputs = controller.react(inputs)

The caller carries the outputs out in this order, and stops at the first that fails: halt, append, sync, speed, orders,
questions. A failed append or sync goes back as `StoreFailed`: orders that depend on it are never sent.
"""

from enum import StrEnum
from typing import TypeAlias

from ilmek.loom.control.alarms import ActiveAlarm, JournalFault
from ilmek.loom.control.journal import AlarmAction
from ilmek.loom.control.packml import PackCommand, PackMode, PackState, Refusal
from ilmek.loom.control.ports import ChangePackages, EndRow, Order, PortReport, Tie
from ilmek.records import record, value_record


class WeavingStep(StrEnum):
    """How much is woven by one start in maintenance mode."""

    ROW = "row"
    KNOT = "knot"


Operation: TypeAlias = Tie | EndRow | ChangePackages
"""An operation of the programme."""


@value_record
class Commanded:
    """A command of an operator or of another system."""

    command: PackCommand


@value_record
class ModeChosen:
    """A mode to change to; step: of maintenance mode."""

    mode: PackMode
    step: WeavingStep = WeavingStep.ROW


@value_record
class JogRequested:
    """An axis is to move by a distance [m or rad], in manual mode."""

    axis: str
    distance: float


@value_record
class SpeedChosen:
    """A speed, as a fraction of the programme's."""

    factor: float


@value_record
class Acknowledged:
    """An operator has seen an alarm and removed its cause; number: of the alarm, None: of all."""

    number: int | None = None


@value_record
class Answered:
    """An operator's answer to a request: whether the operation is in the carpet."""

    request: int
    yes: bool


@value_record
class RowsTakenOut:
    """An operator has taken out the row in work and whole rows before it; they are to be woven again."""

    rows: int


@value_record
class Sensed:
    """The sensor's answer to a question: whether the operation is in the carpet; None: it cannot tell."""

    operation: Tie | EndRow
    found: bool | None


@value_record
class StoreFailed:
    """The journal could not be written or synchronised."""

    fault: JournalFault
    note: str = ""


ControlInput: TypeAlias = (
    Commanded
    | ModeChosen
    | JogRequested
    | SpeedChosen
    | Acknowledged
    | Answered
    | RowsTakenOut
    | Sensed
    | StoreFailed
    | PortReport
)


@value_record
class OperatorRequest:
    """A question to the operator that is answered by yes or no: is the operation in the carpet?"""

    number: int
    operation: Operation
    text: str


@value_record
class StateChanged:
    """The machine is in another state, or mode."""

    state: PackState
    mode: PackMode
    time: int


@value_record
class AlarmChanged:
    """An alarm was raised, ended or acknowledged."""

    alarm: ActiveAlarm
    action: AlarmAction
    time: int


ControlEvent: TypeAlias = StateChanged | AlarmChanged


@record
class ControlOutputs:
    """What the caller carries out, in this order.

    halt       call `LoomPort.halt` first, then `receive`, and give what it reports, even nothing, to `react`; also at
               the first reaction: what an earlier controller began must not end behind its questions
    append     bytes for the journal            sync       make the journal durable
    speed      `LoomPort.set_speed`; None: unchanged
    orders     send them, only after append and sync have succeeded
    questions  ask `LoomPort.knotted` or `ended`, and return a `Sensed` for each
    requests   new ones to the operator         events     for views and history
    refusals   of commands and requests in `inputs`
    """

    halt: bool = False
    append: bytes = b""
    sync: bool = False
    speed: float | None = None
    orders: tuple[Order, ...] = ()
    questions: tuple[Tie | EndRow, ...] = ()
    requests: tuple[OperatorRequest, ...] = ()
    events: tuple[ControlEvent, ...] = ()
    refusals: tuple[Refusal, ...] = ()


@value_record
class HeadStatus:
    """A head: its next knots in this row as (column, tube), how many of the row are tied, whether it ties one now."""

    upcoming: tuple[tuple[int, int], ...]
    tied: int
    tying: bool


@record
class ControllerStatus:
    """The controller as views and other systems show it.

    row, phase   in work; row: number of rows when the carpet is woven      knots  in the carpet
    uncertain    operations that may be in the carpet without a record, none of them in progress
    retries      knots that were tried again at once       faults   operations that the loom reported as failed
    speed        as a fraction of the programme's                          time   of the loom [ns]
    operation    the row's end or the change in progress; None: knots are tied, or nothing is
    """

    state: PackState
    mode: PackMode
    step: WeavingStep
    row: int
    phase: int
    knots: int
    uncertain: int
    retries: int
    faults: int
    speed: float
    time: int
    heads: tuple[HeadStatus, ...]
    operation: EndRow | ChangePackages | None
    alarms: tuple[ActiveAlarm, ...]
    requests: tuple[OperatorRequest, ...]
    complete: bool
