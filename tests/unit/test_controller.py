"""The controller with a loom that does what it is ordered to."""

import pytest
from fake_loom import FakeLoom, MemoryStore, all_operations, run, step
from small_programme import small_programme

from ilmek.loom.control.controller import Controller
from ilmek.loom.control.exchange import Commanded, ControlInput
from ilmek.loom.control.opening import open_journal
from ilmek.loom.control.packml import PackCommand, PackState
from ilmek.loom.control.ports import SensorsChanged

PROGRAMME = small_programme()
RESET, START = Commanded(PackCommand.RESET), Commanded(PackCommand.START)


def begun(loom: FakeLoom, store: MemoryStore, *inputs: ControlInput, group: int = 1) -> Controller:
    journal = open_journal(store.read(), PROGRAMME, group=group, nonce=7)
    store.truncate(journal.size)
    controller = Controller(PROGRAMME, journal)
    step(controller, loom, store, (SensorsChanged(loom.sensors(), loom.time), *inputs))
    return controller


@pytest.mark.parametrize("group", [1, 7])
def test_a_carpet_is_woven_once_and_whole(group: int) -> None:
    loom, store = FakeLoom(), MemoryStore()
    controller = begun(loom, store, RESET, group=group)
    step(controller, loom, store, (START,))
    run(controller, loom, store)
    assert controller.state.state is PackState.COMPLETE
    assert len(loom.woven) == len(set(loom.woven))
    assert set(loom.woven) == all_operations(PROGRAMME)
    assert controller.status().knots == PROGRAMME.setup.knots
