"""The state of a controller, and what it has decided since it last answered."""

from dataclasses import dataclass, field

from ilmek.loom.control.alarms import ActiveAlarm
from ilmek.loom.control.exchange import ControlEvent, ControlOutputs, Operation, OperatorRequest, WeavingStep
from ilmek.loom.control.interlocks import LoomAxis, TensionLimits
from ilmek.loom.control.journal import MOST_LAG, encode_record
from ilmek.loom.control.opening import OpenedJournal
from ilmek.loom.control.packml import PackMode, PackState, Refusal
from ilmek.loom.control.ports import EndRow, Home, Jog, Order, Sensors, StandAside, Tie
from ilmek.loom.control.sequence import Sequence
from ilmek.records import value_record

AXIS = -2
"""Key of an axis that moves alone: a jog, or homing."""

MOST_UNSYNCED = 60_000
"""Records after which the journal is synchronised in any case."""


@value_record
class ControllerSettings:
    """What an operator may set.

    tension      limits of the warp tension; default: those of a usual warp
    watched      sensors that must change while their axis moves, of `interlocks.WATCHED`
    least_speed, most_speed    limits of the speed, as a fraction of the programme's
    """

    tension: TensionLimits | None = None
    watched: tuple[str, ...] = ("beater_back", "shed_closed")
    least_speed: float = 0.05
    most_speed: float = 1.0


USUAL_SETTINGS = ControllerSettings()


@value_record
class Doubt:
    """An operation of which it is not certain whether it is in the carpet.

    onward   if it is, the one after it is in doubt as well: the journal may lack several
    trusted  the journal excludes it; the sensor alone is asked
    sensor   its answer is awaited       request  number of the operator's; None: not asked
    """

    operation: Operation
    onward: bool
    trusted: bool = False
    sensor: bool = False
    request: int | None = None


@dataclass(slots=True, eq=False)
class ControllerState:
    """Everything that changes while a controller works.

    homed       axes that are at home since power-up
    progress    orders that were sent and have not ended, by key   doubts   uncertain operations, by key
    retried     keys whose operation missed its grip once          alarms   by name and head
    watch       sensors that have yet to change in the row's end in progress
    goal        row at which maintenance mode stops; allowance: operations that it may still begin, None: no limit
    halted      the loom was halted, and what it reports after it has been requested
    verified    the sensor was queried for the frontier since the journal was opened
    lag         records that are not durable                       pending  completions among them
    """

    sequence: Sequence
    seed: int
    crc: int
    records: int
    speed: float
    time: int
    state: PackState = PackState.STOPPED
    mode: PackMode = PackMode.PRODUCTION
    step: WeavingStep = WeavingStep.ROW
    goal: int = 0
    allowance: int | None = None
    homed: set[LoomAxis] = field(default_factory=set)
    progress: dict[int, Operation | StandAside | Jog | Home] = field(default_factory=dict)
    doubts: dict[int, Doubt] = field(default_factory=dict)
    retried: set[int] = field(default_factory=set)
    alarms: dict[tuple[str, int | None], ActiveAlarm] = field(default_factory=dict)
    requests: dict[int, OperatorRequest] = field(default_factory=dict)
    questions: int = 0
    sensors: Sensors | None = None
    watch: set[str] = field(default_factory=set)
    halted: bool = False
    verified: bool = False
    store_failed: bool = False
    suspended_by_alarm: bool = False
    lag: int = 0
    pending: int = 0
    retries: int = 0
    faults: int = 0
    tie_allowed: bool = False

    def copy(self) -> "ControllerState":
        """The same state, to go on by itself."""
        state = ControllerState(self.sequence.copy(), self.seed, self.crc, self.records, self.speed, self.time)
        for name in ControllerState.__slots__:
            value = getattr(self, name)
            if name != "sequence":
                setattr(state, name, value.copy() if isinstance(value, dict | set) else value)
        return state


def state_of(journal: OpenedJournal) -> ControllerState:
    """The state in which a controller begins with a journal."""
    state = ControllerState(
        journal.sequence.copy(), journal.seed, journal.crc, journal.records, journal.speed, journal.time
    )
    state.lag = journal.records  # whether the last of them are durable is not known before the next synchronisation
    return state


class Draft:
    """The outputs of one reaction, as they come together."""

    __slots__ = ("append", "events", "halt", "orders", "questions", "refusals", "requests", "speed", "sync")

    def __init__(self) -> None:
        self.append: list[bytes] = []
        self.sync = self.halt = False
        self.speed: float | None = None
        self.orders: list[Order] = []
        self.questions: list[Tie | EndRow] = []
        self.requests: list[OperatorRequest] = []
        self.events: list[ControlEvent] = []
        self.refusals: list[Refusal] = []

    def record(  # noqa: PLR0917
        self, state: ControllerState, kind: int, code: int, row: int, head: int, flag: int, number: int
    ) -> None:
        """Append a record to the journal, at the state's time."""
        if state.store_failed:
            return
        fields = (state.records, min(state.lag, MOST_LAG), kind, code, row, head, flag, number, state.time)
        data, state.crc = encode_record(state.seed, state.crc, fields)
        self.append.append(data)
        state.records += 1
        state.lag += 1

    def outputs(self) -> ControlOutputs:
        """The outputs."""
        return ControlOutputs(
            self.halt, b"".join(self.append), self.sync, self.speed, tuple(self.orders), tuple(self.questions),
            tuple(self.requests), tuple(self.events), tuple(self.refusals),
        )  # fmt: skip
