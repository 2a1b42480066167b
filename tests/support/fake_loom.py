"""A loom for tests of the controller: it does what it is ordered to, event by event."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import Any

from ilmek.loom.control.controller import Controller
from ilmek.loom.control.exchange import ControlInput, ControlOutputs, Sensed
from ilmek.loom.control.ports import (
    ChangePackages,
    Done,
    EndRow,
    Failed,
    Fault,
    Home,
    Order,
    PortReport,
    Sensors,
    SensorsChanged,
    StandAside,
    Tie,
)
from ilmek.loom.operations import LoomProgramme, RowEnd

READY = Sensors(True, False, 15.0, (True,) * 16, True, True, True)
AWAY = {
    RowEnd.STRAIGHT_WEFT: "shed_closed",
    RowEnd.FIRST_BEAT: "beater_back",
    RowEnd.SINUOUS_WEFT: "shed_closed",
    RowEnd.SECOND_BEAT: "beater_back",
}
"""The sensor that changes, and returns, in an operation after the knots."""


class FakeLoom:
    """A `LoomPort`: operations end in the order in which they were sent, one at each call of `receive`."""

    def __init__(self, fails: Callable[[Order], Fault | None] = lambda _: None) -> None:
        self.fails = fails
        self.moving: list[Order] = []
        self.woven: list[Order] = []
        self.time = 0
        self.now = READY
        self.speed = 1.0
        self.knows = True

    def send(self, orders: Sequence[Order]) -> None:
        heads = [one.head for one in (*self.moving, *orders) if isinstance(one, Tie | StandAside)]
        assert len(heads) == len(set(heads)), "a head was not idle"
        if any(not isinstance(one, Tie | StandAside) for one in orders):
            assert not self.moving
            assert len(orders) == 1
        self.moving += orders

    def receive(self, timeout: float = 0.0) -> tuple[PortReport, ...]:  # noqa: ARG002
        if not self.moving:
            return ()
        order = self.moving.pop(0)
        self.time += 1_000_000
        fault = self.fails(order)
        if fault is not None:
            return (Failed(order, fault, self.time),)
        if not isinstance(order, Home | StandAside):
            self.woven.append(order)
        reports: list[PortReport] = []
        if isinstance(order, EndRow) and order.operation in AWAY:
            away: dict[str, Any] = {AWAY[order.operation]: False}
            reports.append(SensorsChanged(replace(self.now, **away), self.time))
            reports.append(SensorsChanged(self.now, self.time))
        return (*reports, Done(order, self.time))

    def halt(self) -> None:
        self.moving.clear()

    def set_speed(self, factor: float) -> None:
        self.speed = factor

    def sensors(self) -> Sensors:
        return self.now

    def knotted(self, row: int, column: int) -> bool | None:
        if not self.knows:
            return None
        return any(isinstance(one, Tie) and (one.row, one.column) == (row, column) for one in self.woven)

    def ended(self, row: int, operation: RowEnd) -> bool | None:
        return EndRow(row, operation) in self.woven if self.knows else None

    def answer(self, operation: Tie | EndRow) -> bool | None:
        """The sensor's answer to a question."""
        if isinstance(operation, Tie):
            return self.knotted(operation.row, operation.column)
        return self.ended(operation.row, operation.operation)

    def truth(self, operation: Order) -> bool:
        """Whether an operation is in the carpet: what an operator sees."""
        return operation in self.woven


class MemoryStore:
    """A `JournalStore` in memory."""

    def __init__(self, content: bytes = b"") -> None:
        self.content, self.durable, self.syncs = bytearray(content), len(content), 0

    def read(self) -> bytes:
        return bytes(self.content)

    def append(self, data: bytes) -> None:
        self.content += data

    def sync(self) -> None:
        self.durable = len(self.content)
        self.syncs += 1

    def truncate(self, size: int) -> None:
        del self.content[size:]
        self.durable = min(self.durable, size)


def carry_out(outputs: ControlOutputs, loom: FakeLoom, store: MemoryStore) -> tuple[ControlInput, ...]:
    """Do what a controller has decided; the sensor's answers, and reports of axes that are at home at once."""
    if outputs.halt:
        loom.halt()
    if outputs.append:
        store.append(outputs.append)
    if outputs.sync:
        store.sync()
    if outputs.speed is not None:
        loom.set_speed(outputs.speed)
    homes = [Done(order, loom.time) for order in outputs.orders if isinstance(order, Home)]
    if outputs.orders and not homes:
        loom.send(outputs.orders)
    return *homes, *(Sensed(one, loom.answer(one)) for one in outputs.questions)


def step(
    controller: Controller, loom: FakeLoom, store: MemoryStore, inputs: Iterable[ControlInput] = ()
) -> ControlOutputs:
    """A reaction to inputs, and to the sensor's answers that follow; the outputs of the first."""
    first = outputs = controller.react(inputs)
    while answers := carry_out(outputs, loom, store):
        outputs = controller.react(answers)
    return first


def run(controller: Controller, loom: FakeLoom, store: MemoryStore) -> None:
    """Weave until the loom has nothing in progress and nothing follows."""
    while True:
        reports = loom.receive()
        outputs = controller.react(reports)
        answers = carry_out(outputs, loom, store)
        while answers:
            outputs = controller.react(answers)
            answers = carry_out(outputs, loom, store)
        if not reports and not loom.moving and not outputs.halt:
            return


def all_operations(programme: LoomProgramme) -> set[Order]:
    """Every knot, row end and stop of a programme."""
    found: set[Order] = set()
    for number in range(programme.setup.rows):
        row = programme.operations(number)
        found |= {EndRow(number, one) for one in row.ends} | {ChangePackages(one) for one in row.stops}
        starts = row.starts.tolist()
        for head in range(row.heads):
            for index in range(starts[head], starts[head + 1]):
                column, tube = int(row.columns[index]), int(row.tubes[index])
                found.add(Tie(head, number, index - starts[head], column, tube))
    return found
