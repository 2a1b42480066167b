"""Rows that an operator has taken out are woven again: controller, journal and simulated carpet."""

import numpy as np
import pytest
from fake_loom import FakeLoom, MemoryStore, run, step
from small_programme import small_programme

from ilmek.loom.control.controller import Controller
from ilmek.loom.control.exchange import Commanded, RowsTakenOut
from ilmek.loom.control.opening import open_journal
from ilmek.loom.control.packml import PackCommand, PackState
from ilmek.loom.control.ports import ChangePackages, EndRow, Order, SensorsChanged, Tie
from ilmek.loom.operations import LoomProgramme


class WeavingLoom(FakeLoom):
    """A loom from which rows can be taken out; every order is counted."""

    def __init__(self) -> None:
        super().__init__()
        self.sent: list[Order] = []

    def send(self, orders: tuple[Order, ...]) -> None:  # type: ignore[override]
        super().send(orders)
        self.sent += orders

    def take_out(self, row: int) -> None:
        """All from a row on."""
        self.woven = [one for one in self.woven if not isinstance(one, Tie | EndRow) or one.row < row]


def started(programme: LoomProgramme, loom: FakeLoom, store: MemoryStore) -> Controller:
    controller = Controller(programme, open_journal(store.read(), programme, nonce=1))
    step(controller, loom, store, (SensorsChanged(loom.sensors(), 0),))
    return controller


def weave(controller: Controller, loom: FakeLoom, store: MemoryStore, operations: int) -> None:
    """Start, end so many operations, and stop."""
    for command in (PackCommand.RESET, PackCommand.START):
        step(controller, loom, store, (Commanded(command),))
    for _ in range(operations):
        step(controller, loom, store, loom.receive())
    step(controller, loom, store, (Commanded(PackCommand.STOP),))
    run(controller, loom, store)


@pytest.mark.parametrize("seed", range(30))
def test_rows_are_taken_out_at_random_and_each_knot_is_in_the_carpet_once(seed: int) -> None:
    random = np.random.default_rng(seed)
    heads = 1 + seed % 3
    programme = small_programme(8, 12, heads, 3, seed=seed)
    loom, store = WeavingLoom(), MemoryStore()
    controller, taken = started(programme, loom, store), 0
    while not controller.status().complete:
        weave(controller, loom, store, int(random.integers(1, 60)))
        status = controller.status()
        if status.state is PackState.STOPPED and taken < 6:
            most, rows = controller.state.sequence.most_back, int(random.integers(0, 5))
            refusals = step(controller, loom, store, (RowsTakenOut(rows),)).refusals
            assert bool(refusals) == (rows > most)
            if not refusals:
                taken += 1
                loom.take_out(status.row - rows)
                assert controller.status().row == status.row - rows
        if random.integers(2):
            controller = started(programme, loom, store)
    wanted = {(row, column): 1 for row in range(8) for column in range(12)}
    ties = [(one.row, one.column) for one in loom.woven if isinstance(one, Tie)]
    assert {place: ties.count(place) for place in ties} == wanted
    ends = [(one.row, int(one.operation)) for one in loom.woven if isinstance(one, EndRow)]
    assert ends == [(row, end) for row in range(8) for end in range(5)]
    assert taken > 0
    assert started(programme, loom, store).status().complete


def test_rows_behind_a_change_of_packages_are_refused_also_after_a_restart() -> None:
    programme = small_programme(8, 12, 2, 3, seed=3, weft_rows=3)
    loom, store = WeavingLoom(), MemoryStore()
    controller = started(programme, loom, store)
    while not any(isinstance(one, ChangePackages) for one in loom.woven):
        weave(controller, loom, store, 1)
    weave(controller, loom, store, 20)
    changed = next(one.stop for one in loom.woven if isinstance(one, ChangePackages))
    row = controller.status().row
    first = changed.row + (changed.phase > 0)
    for _ in range(2):
        refused = step(controller, loom, store, (RowsTakenOut(row - first + 1),)).refusals
        assert "rows back" in refused[0].given
        controller = started(programme, loom, store)
    assert not step(controller, loom, store, (RowsTakenOut(row - first),)).refusals
    assert controller.status().row == first


def test_rows_are_refused_while_the_loom_weaves() -> None:
    programme = small_programme(4, 6, 1, 2)
    loom, store = WeavingLoom(), MemoryStore()
    controller = started(programme, loom, store)
    for command in (PackCommand.RESET, PackCommand.START):
        step(controller, loom, store, (Commanded(command),))
    assert step(controller, loom, store, (RowsTakenOut(0),)).refusals[0].allowed == "allowed in Stopped"


def test_rows_that_are_still_in_the_carpet_are_found_by_the_sensor_and_not_tied_again() -> None:
    programme = small_programme(4, 6, 1, 2)
    loom, store = WeavingLoom(), MemoryStore()
    controller = started(programme, loom, store)
    weave(controller, loom, store, 20)
    step(controller, loom, store, (RowsTakenOut(1),))  # and they were not
    step(controller, loom, store, (Commanded(PackCommand.RESET),))
    assert [alarm.kind.number for alarm in controller.status().alarms] == [307]
    weave(controller, loom, store, 0)
    ties = [one for one in loom.sent if isinstance(one, Tie)]
    assert len(set(ties)) == len(ties)
