"""The controller with a loom that does what it is ordered to."""

from dataclasses import astuple

import pytest
from fake_loom import READY, FakeLoom, MemoryStore, all_operations, carry_out, run, step
from small_programme import small_programme

from ilmek.loom.control.alarms import ControlFault, JournalFault
from ilmek.loom.control.controller import Controller
from ilmek.loom.control.exchange import (
    Acknowledged,
    Answered,
    Commanded,
    ControlInput,
    ModeChosen,
    SpeedChosen,
    StoreFailed,
    WeavingStep,
)
from ilmek.loom.control.homing import HOMED
from ilmek.loom.control.opening import journal_records, open_journal
from ilmek.loom.control.packml import MODE_STATES, PackCommand, PackMode, PackState, allowed_commands
from ilmek.loom.control.ports import Done, EndRow, Failed, Fault, Order, SensorsChanged, Tie
from ilmek.loom.control.state import Draft

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
    assert controller.status().state is PackState.COMPLETE
    assert len(loom.woven) == len(set(loom.woven))
    assert set(loom.woven) == all_operations(PROGRAMME)
    assert controller.status().knots == PROGRAMME.setup.knots


def weaving(loom: FakeLoom, store: MemoryStore, *, group: int = 1) -> Controller:
    controller = begun(loom, store, RESET, group=group)
    step(controller, loom, store, (START,))
    assert controller.status().state is PackState.EXECUTE
    return controller


def finish(controller: Controller, loom: FakeLoom, store: MemoryStore) -> None:
    """Weave to the end, and compare the carpet with the programme."""
    run(controller, loom, store)
    assert controller.status().state is PackState.COMPLETE
    assert sorted(map(repr_of, loom.woven)) == sorted(map(repr_of, all_operations(PROGRAMME)))
    opened = open_journal(store.read(), PROGRAMME)
    assert opened.sequence.finished
    assert not opened.uncertain


def repr_of(order: object) -> str:
    return str(astuple(order))  # type: ignore[call-overload]


def command(name: str) -> Commanded:
    return Commanded(PackCommand[name.upper()])


def alarms(controller: Controller) -> list[str]:
    return [one.kind.name for one in controller.status().alarms]


@pytest.mark.parametrize("number", range(0, 40, 5))
@pytest.mark.parametrize("name", ["hold", "stop", "suspend", "abort", "complete"])
def test_the_carpet_goes_on_after_any_command_at_any_time(name: str, number: int) -> None:
    loom, store = FakeLoom(), MemoryStore()
    controller = weaving(loom, store)
    for _ in range(number):
        step(controller, loom, store, loom.receive())
    step(controller, loom, store, (command(name),))
    run(controller, loom, store)
    going_on = {"hold": ["unhold"], "suspend": ["unsuspend"], "abort": ["clear", "reset", "start"]}
    for one in going_on.get(name, ["reset", "start"]):
        outputs = step(controller, loom, store, (command(one),))
        assert outputs.refusals == ()
    finish(controller, loom, store)


@pytest.mark.parametrize("fault", [one for one in Fault if one is not Fault.MISSED_GRIP])
def test_a_fault_holds_the_loom_until_it_is_repaired_acknowledged_and_unheld(fault: Fault) -> None:
    broken = [True]

    def fails(order: Order) -> Fault | None:
        end = isinstance(order, EndRow)
        return fault if broken[0] and end is fault.value.startswith("weft") else None

    loom, store = FakeLoom(fails), MemoryStore()
    controller = weaving(loom, store)
    while not alarms(controller):
        step(controller, loom, store, loom.receive())
    run(controller, loom, store)
    assert controller.status().state is PackState.HELD
    assert set(alarms(controller)) == {fault}
    broken[0] = False
    refused = step(controller, loom, store, (command("unhold"),)).refusals
    assert refused[0].given == f"Unhold with {fault}"
    step(controller, loom, store, (Acknowledged(), command("unhold")))
    assert alarms(controller) == []
    finish(controller, loom, store)


def test_a_missed_grip_is_tried_again_once_then_the_loom_holds() -> None:
    missed: list[Order] = []

    def fails(order: Order) -> Fault | None:
        if not isinstance(order, Tie) or order.row or order.column not in {0, 5, 7, 14, 21}:
            return None
        if missed.count(order) < (2 if order.column == 5 else 1):
            missed.append(order)
            return Fault.MISSED_GRIP
        return None

    loom, store = FakeLoom(fails), MemoryStore()
    controller = weaving(loom, store)
    run(controller, loom, store)
    assert controller.status().state is PackState.HELD
    alarm = controller.status().alarms[0]
    assert (alarm.kind.name, alarm.row) == (Fault.MISSED_GRIP, 0)
    assert "missed its warps twice" in alarm.text
    step(controller, loom, store, (Acknowledged(), command("unhold")))
    finish(controller, loom, store)
    assert controller.status().retries == len(missed) - 1


@pytest.mark.parametrize("tied", [False, True])
@pytest.mark.parametrize("knows", [False, True])
def test_an_operation_that_was_not_finished_in_time_is_asked_for(tied: bool, knows: bool) -> None:
    loom, store = FakeLoom(), MemoryStore()
    controller = weaving(loom, store)
    order = loom.moving.pop(0)
    if tied:
        loom.woven.append(order)
    loom.knows = knows
    step(controller, loom, store, (Failed(order, Fault.TIMEOUT, 5),))
    run(controller, loom, store)
    step(controller, loom, store, (Acknowledged(),))
    outputs = controller.react((command("unhold"),))
    assert outputs.questions == (order,)
    answers = carry_out(outputs, loom, store)
    outputs = controller.react(answers)
    carry_out(outputs, loom, store)
    assert len(outputs.requests) == (0 if knows else 1)
    if not knows:
        assert controller.status().state is PackState.UNHOLDING
        assert outputs.requests[0].text.startswith("is the knot of row 1 on warp pair")
        assert step(controller, loom, store, (Answered(99, True),)).refusals[0].allowed == "open requests are: 1"
        step(controller, loom, store, (Answered(1, tied),))
    finish(controller, loom, store)


@pytest.mark.parametrize("group", [1, 4, 50])
@pytest.mark.parametrize("knows", [False, True])
def test_a_controller_that_is_started_again_and_again_weaves_the_carpet_once(group: int, knows: bool) -> None:
    """Cut off after every few reports; of the journal only what was durable is left."""
    loom, store, reports, crashes = FakeLoom(), MemoryStore(), 1, 0
    loom.knows = knows
    controller = weaving(loom, store, group=group)
    while controller.status().state is not PackState.COMPLETE:
        for _ in range(reports):
            step(controller, loom, store, loom.receive())
        if controller.status().state is PackState.COMPLETE:
            break
        loom.woven += loom.moving[::2]
        loom.halt()
        crashes += 1
        reports = 1 + (7 * crashes) % 31
        store = MemoryStore(store.read()[: store.durable])
        controller = begun(loom, store, RESET, group=group)
        while controller.status().requests:
            request = controller.status().requests[0]
            step(controller, loom, store, (Answered(request.number, loom.truth(request.operation)),))
        assert controller.status().state is PackState.IDLE
        step(controller, loom, store, (START,))
    assert crashes > 5
    finish(controller, loom, store)


def test_after_a_clean_stop_nothing_is_asked_of_the_operator() -> None:
    loom, store = FakeLoom(), MemoryStore()
    controller = weaving(loom, store)
    for _ in range(5):
        step(controller, loom, store, loom.receive())
    step(controller, loom, store, (command("stop"),))
    run(controller, loom, store)
    loom.knows = False
    controller = begun(loom, store, RESET)
    assert controller.status().requests == ()
    assert controller.status().state is PackState.IDLE
    step(controller, loom, store, (START,))
    finish(controller, loom, store)


def test_a_journal_behind_the_carpet_is_noticed_and_nothing_is_tied_twice() -> None:
    """An older copy of the journal, of a clean stop: the sensor finds what it lacks."""
    loom, store = FakeLoom(), MemoryStore()
    controller = weaving(loom, store)
    step(controller, loom, store, (command("stop"),))
    run(controller, loom, store)
    old = store.read()
    step(controller, loom, store, (RESET,))
    step(controller, loom, store, (START,))
    for _ in range(9):
        step(controller, loom, store, loom.receive())
    step(controller, loom, store, (command("stop"),))
    run(controller, loom, store)
    store = MemoryStore(old)
    controller = begun(loom, store, RESET)
    assert set(alarms(controller)) == {JournalFault.BEHIND}
    assert controller.status().knots == sum(isinstance(one, Tie) for one in loom.woven)
    step(controller, loom, store, (Acknowledged(), START))
    finish(controller, loom, store)


def test_maintenance_weaves_one_row_or_one_knot_at_a_start() -> None:
    loom, store = FakeLoom(), MemoryStore()
    controller = begun(loom, store, ModeChosen(PackMode.MAINTENANCE, WeavingStep.KNOT), RESET)
    for number in range(1, 4):
        step(controller, loom, store, (START,))
        run(controller, loom, store)
        assert controller.status().state is PackState.COMPLETE
        assert len(loom.woven) == number
        step(controller, loom, store, (RESET,))
    step(controller, loom, store, (ModeChosen(PackMode.MAINTENANCE, WeavingStep.ROW), START))
    run(controller, loom, store)
    assert controller.state.sequence.position()[:2] == (1, 0)
    assert {one.row for one in loom.woven if isinstance(one, Tie)} == {0}
    assert step(controller, loom, store, (ModeChosen(PackMode.PRODUCTION),)).refusals
    step(controller, loom, store, (RESET,))
    step(controller, loom, store, (ModeChosen(PackMode.PRODUCTION), START))
    finish(controller, loom, store)


def test_a_missed_grip_of_a_single_knot_is_tried_again() -> None:
    missed: list[Order] = []

    def fails(order: Order) -> Fault | None:
        if missed:
            return None
        missed.append(order)
        return Fault.MISSED_GRIP

    loom, store = FakeLoom(fails), MemoryStore()
    controller = begun(loom, store, ModeChosen(PackMode.MAINTENANCE, WeavingStep.KNOT), RESET)
    step(controller, loom, store, (START,))
    run(controller, loom, store)
    assert (controller.status().state, loom.woven) == (PackState.COMPLETE, missed)


def test_the_speed_is_set_recorded_and_restored() -> None:
    loom, store = FakeLoom(), MemoryStore()
    controller = weaving(loom, store)
    assert step(controller, loom, store, (SpeedChosen(1.5),)).refusals[0].text == (
        "a speed of 1.5; 0.05 to 1 times the programme's"
    )
    step(controller, loom, store, (SpeedChosen(0.5),))
    assert loom.speed == 0.5
    step(controller, loom, store, loom.receive())
    again = FakeLoom()
    controller = begun(again, MemoryStore(store.read()))
    assert (again.speed, controller.status().speed) == (0.5, 0.5)


def test_reports_that_nobody_waits_for_hold_the_loom() -> None:
    loom, store = FakeLoom(), MemoryStore()
    controller = weaving(loom, store)
    knots = controller.status().knots
    for report in (Done(Tie(0, 3, 0, 0, 0), 9), Failed(Tie(0, 3, 0, 0, 0), Fault.PILE_END, 9)):
        step(controller, loom, store, (report,))
        assert controller.status().state is PackState.HOLDING
        assert alarms(controller) == [ControlFault.UNEXPECTED]
    assert controller.status().knots == knots


def test_a_report_that_comes_twice_counts_once() -> None:
    loom, store = FakeLoom(), MemoryStore()
    controller = weaving(loom, store)
    reports = loom.receive()
    step(controller, loom, store, reports)
    step(controller, loom, store, reports)
    assert controller.status().knots == 1
    run(controller, loom, store)
    step(controller, loom, store, (Acknowledged(), command("unhold")))
    finish(controller, loom, store)


def test_a_clock_that_goes_backwards_is_an_alarm_and_weaving_goes_on() -> None:
    loom, store = FakeLoom(), MemoryStore()
    controller = weaving(loom, store)
    for _ in range(6):
        step(controller, loom, store, loom.receive())
    loom.time = 0
    step(controller, loom, store, loom.receive())
    assert alarms(controller) == [ControlFault.CLOCK_BACKWARDS]
    assert controller.status().time == 6_000_000
    finish(controller, loom, store)
    found = journal_records(store.read())
    assert found is not None
    times = [one.time for one in found[1]]
    assert times == sorted(times)


@pytest.mark.parametrize("fault", [JournalFault.DISC_FULL, JournalFault.WRITE_FAILED])
def test_a_journal_that_cannot_be_written_stops_the_loom_and_the_next_controller_goes_on(fault: JournalFault) -> None:
    loom, store = FakeLoom(), MemoryStore()
    controller = weaving(loom, store)
    for _ in range(5):
        step(controller, loom, store, loom.receive())
    controller.react(loom.receive())  # its record is not written, its order not sent
    outputs = controller.react((StoreFailed(fault, "no space left"),))
    assert (outputs.halt, outputs.append, outputs.sync, outputs.orders) == (True, b"", False, ())
    loom.halt()
    outputs = controller.react(())
    assert (outputs.append, controller.status().state) == (b"", PackState.ABORTED)
    assert alarms(controller) == [fault]
    assert "journal" in step(controller, loom, store, (Acknowledged(), command("clear"))).refusals[0].text
    controller = begun(loom, store, RESET)
    step(controller, loom, store, (START,))
    finish(controller, loom, store)


def test_alarms_outlive_a_restart_until_they_are_acknowledged() -> None:
    loom, store = FakeLoom(lambda _: Fault.PILE_BREAK), MemoryStore()
    controller = weaving(loom, store)
    run(controller, loom, store)
    loom.fails = lambda _: None
    controller = begun(loom, store, RESET)
    assert alarms(controller) == [Fault.PILE_BREAK]
    assert controller.status().alarms[0].note == "before the restart"
    assert "acknowledge alarm 202" in step(controller, loom, store, (START,)).refusals[0].text
    step(controller, loom, store, (Acknowledged(202), START))
    finish(controller, loom, store)
    assert open_journal(store.read(), PROGRAMME).alarms == ()


def test_nothing_begins_before_the_sensors_are_known() -> None:
    loom, store = FakeLoom(), MemoryStore()
    controller = Controller(PROGRAMME, open_journal(b"", PROGRAMME))
    step(controller, loom, store, (RESET,))
    step(controller, loom, store, (START,))
    assert loom.moving == []
    assert (controller.status().state, alarms(controller)) == (PackState.RESETTING, [ControlFault.NO_SENSORS])


def test_a_flood_of_commands_writes_nothing_to_the_journal() -> None:
    loom, store = FakeLoom(), MemoryStore()
    controller = weaving(loom, store)
    size = len(store.content)
    flood: list[ControlInput] = [START, RESET, command("unhold"), Acknowledged(), SpeedChosen(1.0), Answered(1, True)]
    for _ in range(200):
        assert len(step(controller, loom, store, flood).refusals) == 4
    assert len(store.content) == size


@pytest.mark.parametrize("state", PackState)
@pytest.mark.parametrize("mode", PackMode)
def test_a_command_that_a_state_forbids_changes_nothing(mode: PackMode, state: PackState) -> None:
    if state not in MODE_STATES[mode]:
        return
    for one in PackCommand:
        controller = Controller(PROGRAMME, open_journal(b"", PROGRAMME))
        controller.react((SensorsChanged(READY, 0),))
        controller.state.state, controller.state.mode, controller.state.homed = state, mode, set(HOMED)
        draft = Draft()
        controller._commanded(Commanded(one), draft)
        allowed = one in allowed_commands(mode, state)
        assert bool(draft.refusals) is not allowed
        assert (controller.status().state is state) is not allowed
        assert bool(draft.append) is allowed


def test_the_first_reaction_halts_what_an_earlier_controller_began() -> None:
    assert Controller(PROGRAMME, open_journal(b"", PROGRAMME)).react(()).halt


def test_a_report_that_comes_while_the_operator_is_asked_answers_the_question() -> None:
    loom, store = FakeLoom(), MemoryStore()
    controller = weaving(loom, store)
    order = loom.moving.pop(0)
    loom.knows = False
    step(controller, loom, store, (Failed(order, Fault.TIMEOUT, 5),))
    run(controller, loom, store)
    step(controller, loom, store, (Acknowledged(), command("unhold")))
    assert controller.status().state is PackState.UNHOLDING
    loom.woven.append(order)
    step(controller, loom, store, (Done(order, loom.time),))
    assert (controller.status().state, controller.status().requests) == (PackState.EXECUTE, ())
    assert step(controller, loom, store, (Answered(1, True),)).refusals
    finish(controller, loom, store)


@pytest.mark.parametrize("late", [Done, Failed])
def test_reports_of_what_an_earlier_controller_began_count(late: type) -> None:
    loom, store = FakeLoom(), MemoryStore()
    weaving(loom, store)
    order = loom.moving[0]
    controller = begun(FakeLoom(), store)
    assert controller.status().uncertain == 2
    if late is Done:
        loom.woven.append(order)
        step(controller, loom, store, (Done(order, 7),))
    else:
        step(controller, loom, store, (Failed(order, Fault.MISSED_GRIP, 7),))
    loom.halt()
    assert controller.status().knots == (1 if late is Done else 0)
    step(controller, loom, store, (RESET,))
    step(controller, loom, store, (START,))
    finish(controller, loom, store)
