"""The loom as a plant: what its orders, an operator and faults make of it in a time.

    step(plant, state, inputs, dt) -> (state, reports)

The inputs act at the state's time, in their order; then the loom runs for dt nanoseconds. Whole numbers alone, and no
clock: the same inputs give the same state, reports and digest everywhere, and step(a) then step(b) is step(a + b).

    knot            knot + (another tube ? colour_change : 0) + travel * max(|columns apart| - 1, 0)
    after a row     operation i ends row_ends[i] after the last knot, if each begins when the one before has ended
    failure         an operation that fails lasts its whole time, and nothing of it is in the carpet

A head stands at its first knot of a row when the row begins. A head that stands aside gets there while the others go to
their knots: that is reported at once. An operation that does not end is reported after WATCHDOG
times its duration.
"""

from collections.abc import Sequence
from dataclasses import replace

from ilmek.errors import LoomError
from ilmek.loom.control.homing import at_home
from ilmek.loom.control.interlocks import LoomAxis
from ilmek.loom.control.ports import (
    ChangePackages,
    Done,
    EndRow,
    Failed,
    Fault,
    Home,
    Jog,
    PortReport,
    SensorsChanged,
    StandAside,
    Tie,
)
from ilmek.loom.twin.acts import acted, changed_packages, halted
from ilmek.loom.twin.events import chained
from ilmek.loom.twin.fates import after_end_fault, after_weft, end_fate, knot_fate, with_broken_warp
from ilmek.loom.twin.model import HOMING, JOG, WATCHDOG, Mark, PlantModel
from ilmek.loom.twin.state import (
    NOWHERE,
    Halt,
    LoomCondition,
    LoomWork,
    PlantHead,
    PlantInput,
    PlantState,
    PowerOn,
    gripping,
    sensors_of,
)


def step(
    plant: PlantModel, state: PlantState, inputs: Sequence[PlantInput], dt: int
) -> tuple[PlantState, tuple[PortReport, ...]]:
    """The state after dt [ns] with inputs at its begin, and what was reported, in order.

    Raises LoomError for a negative dt, for what no loom can do (an axis that is busy, a knot beyond the carpet), and
    for what would damage it.
    """
    if dt < 0:
        raise LoomError(f"a step of {dt} ns", allowed="0 ns or more: a loom's clock does not go back")
    run = _Run(plant, state)
    for one in inputs:
        run.take(one)
    run.advance(state.time + dt)
    return run.state(), tuple(run.reports)


class _Run:
    """A state that changes, within a step."""

    __slots__ = ("condition", "digest", "heads", "plant", "reports", "shown", "time")

    def __init__(self, plant: PlantModel, state: PlantState) -> None:
        self.plant, self.time, self.condition = plant, state.time, state.condition
        self.heads, self.shown, self.digest = list(state.heads), state.shown, state.digest
        self.reports: list[PortReport] = []

    def state(self) -> PlantState:
        return PlantState(self.time, tuple(self.heads), self.condition, self.shown, self.digest)

    def take(self, one: PlantInput) -> None:
        if type(one) is Tie:
            self.begin_knot(one)
        elif isinstance(one, StandAside):
            self.stand_aside(one)
        elif isinstance(one, EndRow | ChangePackages | Jog | Home):
            self.begin_work(one)
        elif isinstance(one, PowerOn):
            self.report_sensors()
        else:
            self.act(one)

    def begin_knot(self, order: Tie) -> None:
        plant, condition = self.plant, self.condition
        _require_knot(plant, order.head, order.row, order.column, order.tube)
        head = self.heads[order.head]
        if head.order is not None or condition.work is not None:
            raise _busy(f"head {order.head}")
        apart = 0 if order.number == 0 or head.column < 0 else abs(order.column - head.column) - 1
        if head.condition.closed and apart > 0:
            raise _closed(order.head)
        first = plant.times.travel * apart if apart > 0 else 0
        if head.tube not in (order.tube, NOWHERE):
            first += plant.times.colour_change
        fault, condition = knot_fate(plant, condition, head, order)
        self.condition = condition
        whole = first + plant.times.knot
        if condition.permille != 1000:
            first, whole = first * 1000 // condition.permille, whole * 1000 // condition.permille
        end = self.time + (whole if fault is not Fault.TIMEOUT else WATCHDOG * whole)
        self.heads[order.head] = PlantHead(
            head.column, head.tube, head.left, head.condition, order, self.time + first, end, fault
        )
        if end == self.time:
            self.advance(end)

    def stand_aside(self, order: StandAside) -> None:
        _require_knot(self.plant, order.head, order.row, order.column)
        head = self.heads[order.head]
        if head.order is not None or self.condition.work is not None:
            raise _busy(f"head {order.head}")
        if head.condition.closed:
            raise _closed(order.head)
        self.report(Done(order, self.time))

    def end_knot(self, index: int, head: PlantHead, order: Tie) -> None:
        condition, left, fault = head.condition, head.left, head.fault
        if fault is None:
            remaining = list(left)
            remaining[order.tube] -= self.plant.knot_yarn[condition.yarns[order.tube]]
            left = tuple(remaining)
            if condition.attempts or condition.closed:
                condition = replace(condition, attempts=0, closed=False)
            report: PortReport = Done(order, self.time)
        else:
            broken = condition.broken | (1 << order.tube if fault is Fault.PILE_BREAK else 0)
            condition = replace(condition, attempts=condition.attempts + 1, broken=broken, closed=False)
            if fault is Fault.WARP_BREAK:
                self.condition = with_broken_warp(self.condition, order.column)
            if fault is Fault.PILE_END:
                left = tuple(0 if tube == order.tube else length for tube, length in enumerate(left))
            report = Failed(order, fault, self.time)
        self.heads[index] = PlantHead(order.column, order.tube, left, condition)
        if self.shown:
            self.report_sensors()
        self.report(report)

    def begin_work(self, order: EndRow | ChangePackages | Jog | Home) -> None:
        plant, condition = self.plant, self.condition
        marks: tuple[Mark, ...] = ()
        fault: Fault | None = None
        if condition.work is not None or any(head.order is not None for head in self.heads):
            raise _busy("the loom")
        if isinstance(order, EndRow):
            _require_end(plant, condition, order)
            duration = plant.times.of_end(order.operation)
            marks = plant.marks[order.operation]
            fault, condition = end_fate(plant, condition, order)
        elif isinstance(order, Home):
            duration = 0 if at_home(LoomAxis(order.axis), sensors_of(plant, self.state())) else HOMING
        else:
            duration = plant.change_time(order.stop) if isinstance(order, ChangePackages) else JOG
        if isinstance(order, EndRow) and condition.permille != 1000:
            duration = duration * 1000 // condition.permille
            marks = tuple((time * 1000 // condition.permille, name, value) for time, name, value in marks)
        end = self.time + (duration if fault is not Fault.TIMEOUT else WATCHDOG * duration)
        coming = tuple((self.time + time, name, value) for time, name, value in marks)
        self.condition = replace(condition, work=LoomWork(order, end, fault, coming))
        self.advance(self.time)  # what lasts no time ends before the next input

    def end_work(self, work: LoomWork) -> None:
        condition, order, fault = replace(self.condition, work=None), work.order, work.fault
        if fault is not None:
            if isinstance(order, EndRow):
                condition = after_end_fault(condition, order.operation, fault)
        elif isinstance(order, EndRow):
            condition = replace(condition, attempts=0, wefts=after_weft(condition.wefts, order.operation))
        elif isinstance(order, ChangePackages):
            condition, heads = changed_packages(self.plant, condition, self.heads, order.stop)
            self.heads = list(heads)
        self.condition = condition
        if isinstance(order, Jog | Home):
            self.act(order)
        self.report(Done(order, self.time) if fault is None else Failed(order, fault, self.time))

    def pass_mark(self, work: LoomWork) -> None:
        (_, sensor, value), *rest = work.marks
        beater = value if sensor == "beater_back" else self.condition.beater_back
        shed = value if sensor == "shed_closed" else self.condition.shed_closed
        coming = replace(work, marks=tuple(rest))
        self.condition = replace(self.condition, work=coming, beater_back=beater, shed_closed=shed)
        self.report_sensors()

    def act(self, one: PlantInput) -> None:
        before = sensors_of(self.plant, self.state())
        self.condition, heads = acted(self.plant, self.condition, self.heads, one)
        self.heads = list(heads)
        left_closed = False
        if isinstance(one, Halt) or self.condition.emergency_stop:
            self.condition, heads = halted(self.condition, self.heads, self.time)
            self.heads, left_closed = list(heads), self.condition.between
        if self.shown or left_closed or sensors_of(self.plant, self.state()) != before:
            self.report_sensors()

    def advance(self, until: int) -> None:
        while True:
            work, soonest, at = self.condition.work, until, NOWHERE
            for index, head in enumerate(self.heads):
                if head.order is not None and (head.end < soonest or (at < 0 and head.end == soonest)):
                    soonest, at = head.end, index
            if at >= 0:
                self.time, head = soonest, self.heads[at]
                if head.order is not None:
                    self.end_knot(at, head, head.order)
            elif work is not None and (work.marks[0][0] if work.marks else work.end) <= until:
                self.time = work.marks[0][0] if work.marks else work.end
                (self.pass_mark if work.marks else self.end_work)(work)
            else:
                self.time = until
                return

    def report(self, one: PortReport) -> None:
        self.digest = chained(self.digest, one)
        self.reports.append(one)

    def report_sensors(self) -> None:
        self.shown = any(gripping(head, self.time) for head in self.heads)
        self.report(SensorsChanged(sensors_of(self.plant, self.state()), self.time))


def _require_knot(plant: PlantModel, head: int, row: int, column: int, tube: int = 0) -> None:
    setup = plant.setup
    inside = 0 <= row < setup.rows and 0 <= column < setup.columns
    if not inside or not 0 <= head < setup.heads or not 0 <= tube < setup.tubes:
        raise LoomError(
            f"a knot of row {row}, column {column}, head {head}, tube {tube}",
            allowed=f"{setup.rows} rows, {setup.columns} columns, {setup.heads} heads, {setup.tubes} tubes, from 0",
        )


def _require_end(plant: PlantModel, condition: LoomCondition, order: EndRow) -> None:
    if not 0 <= order.row < plant.setup.rows:
        raise LoomError(f"the end of row {order.row}", allowed=f"rows 0 to {plant.setup.rows - 1}")
    if condition.between:
        raise LoomError("a head is between the warps", do="bring the heads to their rest first")


def _closed(head: int) -> LoomError:
    return LoomError(f"head {head} moves with its gripper closed on warps", do="open the gripper first")


def _busy(axis: str) -> LoomError:
    return LoomError(f"{axis} is given an order while the one before is in progress", do="wait for its report")
