"""The controller on the plant: its interlocks against a loom whose doors open, whose sensors lie, whose yarn breaks."""

from collections.abc import Callable

import pytest
from fake_loom import MemoryStore
from small_programme import small_programme

from ilmek.drivers.twin_port import TwinPort
from ilmek.loom.control.alarms import ControlFault
from ilmek.loom.control.controller import Controller
from ilmek.loom.control.exchange import Acknowledged, Answered, Commanded, ControlInput, ControlOutputs, Sensed
from ilmek.loom.control.opening import open_journal
from ilmek.loom.control.packml import PackCommand, PackState
from ilmek.loom.control.ports import EndRow, Fault, SensorsChanged, Tie
from ilmek.loom.operations import RowEnd
from ilmek.loom.twin.comparison import chart_digest, compare
from ilmek.loom.twin.model import NO_FAULTS, FaultRates, plant_model
from ilmek.loom.twin.state import (
    Act,
    Door,
    EmergencyStop,
    Injected,
    Repaired,
    SensorFault,
    Tension,
    first_state,
)
from ilmek.loom.twin.woven import Woven, woven_size

PROGRAMME = small_programme(4, 12, 2, 3, weft_rows=2)
START = (PackCommand.RESET, PackCommand.START)
GO_ON = {
    PackState.ABORTED: (PackCommand.CLEAR, *START),
    PackState.STOPPED: START,
    PackState.IDLE: (PackCommand.START,),
    PackState.HELD: (PackCommand.UNHOLD,),
    PackState.SUSPENDED: (PackCommand.UNSUSPEND,),
}


class Weaving:
    """A controller that weaves on the plant."""

    def __init__(self, rates: FaultRates = NO_FAULTS) -> None:
        self.woven = Woven(PROGRAMME.setup, bytearray(woven_size(PROGRAMME.setup)))
        self.woven.keep(first_state(plant_model(PROGRAMME.setup)))
        self.port, self.store = TwinPort(PROGRAMME.setup, self.woven, rates=rates), MemoryStore()
        self.controller = Controller(PROGRAMME, open_journal(b"", PROGRAMME, nonce=3))
        self.alarms: set[str] = set()
        self.react(SensorsChanged(self.port.sensors(), self.port.time))

    @property
    def state(self) -> PackState:
        return self.controller.status().state

    def react(self, *inputs: ControlInput) -> None:
        answers: tuple[ControlInput, ...] = inputs
        while answers:
            outputs = self.controller.react(answers)
            answers = self.carry_out(outputs)
        self.alarms |= {one.kind.name for one in self.controller.status().alarms}

    def command(self, command: PackCommand) -> None:
        """Give a command; after a reset the axes go home."""
        self.react(Commanded(command))
        self.weave(lambda: self.state is not PackState.RESETTING)

    def carry_out(self, outputs: ControlOutputs) -> tuple[ControlInput, ...]:
        found: list[ControlInput] = []
        if outputs.halt:
            self.port.halt()
            found += self.port.receive(0.0)
        self.store.append(outputs.append)
        self.port.send(outputs.orders)
        for one in outputs.questions:
            if isinstance(one, Tie):
                found.append(Sensed(one, self.port.knotted(one.row, one.column)))
            else:
                found.append(Sensed(one, self.port.ended(one.row, one.operation)))
        if outputs.halt and not found:
            return self.carry_out(self.controller.react(()))
        return tuple(found)

    def weave(self, until: Callable[[], bool] = lambda: False) -> None:
        """Go on until nothing happens any more."""
        while not until():
            reports = self.port.receive(0.0)
            if not reports:
                return
            self.react(*reports)

    def resume(self) -> None:
        """What an operator does: he cures the loom, acknowledges, answers, and lets it go on."""
        self.port.act(Repaired(), Door(True), EmergencyStop(False), Tension(False))
        self.react(*self.port.receive(0.0))
        self.react(Acknowledged())
        for command in GO_ON.get(self.state, ()):
            self.command(command)
            for one in self.controller.status().requests:
                self.react(Answered(one.number, self.true(one.operation)))

    def true(self, operation: object) -> bool:
        """Whether an operation is in the carpet, by the eye of the operator."""
        if isinstance(operation, Tie):
            return self.woven.times_tied(operation.row, operation.column) > 0
        return isinstance(operation, EndRow) and self.woven.times_ended(operation.row, operation.operation) > 0

    def finish(self) -> None:
        for _ in range(60):
            self.weave()
            if self.state is PackState.COMPLETE:
                break
            self.resume()
        result = compare(self.woven, PROGRAMME)
        assert self.state is PackState.COMPLETE
        assert result.complete, result.faults
        assert result.digest == chart_digest(PROGRAMME)


def started(rates: FaultRates = NO_FAULTS) -> Weaving:
    weaving = Weaving(rates)
    for command in START:
        weaving.command(command)
    return weaving


def knots(weaving: Weaving, count: int) -> Callable[[], bool]:
    return lambda: weaving.controller.status().knots >= count


def test_without_faults_the_carpet_is_whole_and_no_alarm_is_raised() -> None:
    weaving = started()
    weaving.finish()
    assert weaving.alarms == set()


ACTS: list[tuple[Act, str]] = [
    (Door(False), "door open"),
    (EmergencyStop(True), "emergency stop"),
    (Tension(True), "warp tension low"),
    (SensorFault("warp_tension", None), "warp tension unknown"),
    (SensorFault("heads_clear", False), "head in the comb's path"),
    (SensorFault("beater_back", False), "beater not back"),
    (SensorFault("shed_closed", False), "shed open"),
    (SensorFault("grippers_open 1", False), "gripper closed on warps"),
]


@pytest.mark.parametrize(("act", "alarm"), ACTS, ids=lambda one: str(one) if isinstance(one, str) else "")
@pytest.mark.parametrize("count", [1, 12, 29])
def test_what_an_interlock_forbids_stops_the_loom_and_loses_nothing(act: Act, alarm: str, count: int) -> None:
    weaving = started()
    weaving.weave(knots(weaving, count))
    weaving.port.act(act)
    weaving.weave(lambda: weaving.state in GO_ON)
    weaving.weave()
    assert weaving.alarms
    assert weaving.alarms <= {alarm, ControlFault.CONTRADICTION}
    assert weaving.state in GO_ON
    before = [weaving.woven.counts(row).sum() for row in range(4)]
    weaving.weave()
    assert [weaving.woven.counts(row).sum() for row in range(4)] == before
    weaving.finish()


@pytest.mark.parametrize("fault", [one for one in Fault if not one.startswith("weft")])
def test_a_knot_that_fails_is_tied_once_in_the_end(fault: Fault) -> None:
    weaving = started()
    weaving.port.act(Injected(fault, 1, 5), Injected(fault, 2, 7), Injected(fault, 2, 7))
    weaving.finish()


@pytest.mark.parametrize(
    ("fault", "operation"),
    [
        (Fault.WEFT_BREAK, RowEnd.STRAIGHT_WEFT),
        (Fault.WEFT_END, RowEnd.SINUOUS_WEFT),
        (Fault.WARP_BREAK, RowEnd.FIRST_BEAT),
        (Fault.TIMEOUT, RowEnd.TAKE_UP),
    ],
)
def test_an_operation_that_fails_is_carried_out_once_in_the_end(fault: Fault, operation: RowEnd) -> None:
    weaving = started()
    weaving.port.act(Injected(fault, 1, operation=operation))
    weaving.finish()
    assert fault in weaving.alarms


@pytest.mark.parametrize("sensor", ["beater_back", "shed_closed"])
def test_a_sensor_that_is_stuck_at_rest_is_found_out(sensor: str) -> None:
    weaving = started()
    weaving.port.act(SensorFault(sensor, True))
    weaving.weave()
    assert weaving.state is not PackState.COMPLETE
    assert weaving.alarms
    weaving.finish()


@pytest.mark.parametrize("seed", range(3))
def test_a_carpet_of_many_faults_is_whole(seed: int) -> None:
    weaving = started(FaultRates(seed, 0.01, 0.03, 0.05, 0.05, 0.03, 0.03))
    weaving.finish()
    assert weaving.alarms
