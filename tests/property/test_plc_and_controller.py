"""The PLC program and the controller of `ilmek run` with the same scripted stations: their journals, event by event."""

from collections import defaultdict

import numpy as np
import pytest
from fake_loom import FakeLoom, MemoryStore, run, step
from plc_loom import HONEST, Act, PlcLoom
from small_programme import small_programme

from ilmek.loom.control.alarms import ALARM_NUMBERS, ALARMS
from ilmek.loom.control.controller import Controller
from ilmek.loom.control.exchange import Acknowledged, Commanded, RowsTakenOut
from ilmek.loom.control.journal import AlarmAction, RecordKind
from ilmek.loom.control.opening import journal_records, open_journal
from ilmek.loom.control.packml import PackCommand, PackState
from ilmek.loom.control.ports import ChangePackages, EndRow, Fault, Order, SensorsChanged, Tie
from ilmek.loom.operations import LoomProgramme

Event = tuple[str, int, int, int]
"""A knot (row, head, number of the head's knots), the end of an operation (row, code), an alarm (number), or the row
that is woven next after rows were taken out.
"""

Backs = list[tuple[int, int]]
"""After how many knots the loom is stopped, and whole rows that are then taken out with the row in work."""

FAULTS = {
    False: (Fault.PILE_END, Fault.PILE_BREAK, Fault.WARP_BREAK, Fault.TIMEOUT, Fault.MISSED_GRIP),
    True: (Fault.WEFT_BREAK, Fault.WEFT_END, Fault.TIMEOUT),
}


class Script:
    """What each station does with its orders, one after the other; the same for both controllers."""

    def __init__(self, seed: int, heads: int) -> None:
        random = np.random.default_rng(seed)
        self.acts = {station: [self._act(random, station == heads) for _ in range(120)] for station in range(heads + 1)}

    @staticmethod
    def _act(random: np.random.Generator, end: bool) -> Act:
        if random.random() > 0.15:
            return HONEST
        fault = FAULTS[end][random.integers(len(FAULTS[end]))]
        tied = fault is not Fault.MISSED_GRIP and bool(random.integers(2))
        if fault is Fault.TIMEOUT and random.integers(2):
            return Act(tied=tied, silent=True)
        return Act(tied=tied, fault=ALARMS[fault].number)

    def next_act(self, station: int) -> Act:
        return self.acts[station].pop(0) if self.acts[station] else HONEST


def take_out(controller: Controller, loom: FakeLoom, store: MemoryStore, knots: int, rows: int) -> None:
    """Weave up to a number of knots, stop, take out whole rows and the row in work, and start again."""
    while controller.status().knots < knots:
        step(controller, loom, store, loom.receive())
    step(controller, loom, store, (Commanded(PackCommand.STOP),))
    run(controller, loom, store)
    assert not step(controller, loom, store, (RowsTakenOut(rows),)).refusals
    row = controller.status().row
    loom.woven = [one for one in loom.woven if isinstance(one, Tie | EndRow) and one.row < row]
    step(controller, loom, store, (Commanded(PackCommand.RESET),))
    step(controller, loom, store, (Commanded(PackCommand.START),))


def controller_events(programme: LoomProgramme, script: Script, backs: Backs | None = None) -> list[Event]:
    """The journal of the controller; what a silent station does not report, its driver reports as a time-out."""
    heads, store = programme.setup.heads, MemoryStore()

    def fails(order: Order) -> Fault | None:
        if isinstance(order, ChangePackages):
            return None
        act = script.next_act(order.head if isinstance(order, Tie) else heads)
        number = ALARMS[Fault.TIMEOUT].number if act.silent else act.fault
        if number and act.tied:
            loom.woven.append(order)
        return Fault(ALARM_NUMBERS[number].name) if number else None

    loom = FakeLoom(fails)
    controller = Controller(programme, open_journal(b"", programme))
    step(controller, loom, store, (SensorsChanged(loom.sensors(), 0), Commanded(PackCommand.RESET)))
    step(controller, loom, store, (Commanded(PackCommand.START),))
    for knots, rows in backs or []:
        take_out(controller, loom, store, knots, rows)
    run(controller, loom, store)
    while controller.status().state is PackState.HELD:
        step(controller, loom, store, (Acknowledged(), Commanded(PackCommand.UNHOLD)))
        run(controller, loom, store)
    assert controller.status().state is PackState.COMPLETE
    assert sum(isinstance(one, Tie) for one in set(loom.woven)) == programme.setup.knots
    assert sum(isinstance(one, Tie) for one in loom.woven) == programme.setup.knots
    return journal_events(store)


def journal_events(store: MemoryStore) -> list[Event]:
    """What the journal of a controller states."""
    opened = journal_records(store.read())
    assert opened is not None
    events: list[Event] = []
    for one in opened[1]:
        if one.kind == RecordKind.KNOT:
            events.append(("knot", one.row, one.head, one.number))
        elif one.kind == RecordKind.ROW_END:
            events.append(("end", one.row, one.code, 0))
        elif one.kind == RecordKind.ROWS_BACK:
            events.append(("back", one.row, 0, 0))
        elif one.kind == RecordKind.ALARM and one.code == AlarmAction.RAISED:
            events.append(("alarm", one.number, 0, 0))
    return events


def plc_events(programme: LoomProgramme, script: Script, backs: Backs | None = None) -> list[Event]:
    """What the PLC's record of the carpet goes through, scan by scan."""
    loom = PlcLoom(programme)
    loom.next_act = script.next_act
    events: list[Event] = []
    before, left = (0, [0] * programme.setup.heads, 0, 0), list(backs or [])
    while not loom.read("CarpetDone"):
        if left and loom.read("KnotsDone") >= left[0][0]:
            rows = left.pop(0)[1]
            loom.command = PackCommand.STOP
            loom.until("StateCurrent", PackState.STOPPED)
            loom.take_out(rows)
            back = programme.setup.knots_before(loom.feeder.journal.row)
            loom.scan(RowsBack=rows, RowsBackKnots=back, RowsBackRequest=True)
            loom.scan(RowsBackRequest=False)
            events.append(("back", loom.read("Now.Row"), 0, 0))
            before = (loom.read("Now.Row"), [0] * programme.setup.heads, 0, 0)
        loom.attend(1)
        row, tied, ends, alarm = (loom.read(f"Now.{name}") for name in ("Row", "Tied", "EndsDone", "Alarm"))
        if row == before[0]:
            for head, (first, then) in enumerate(zip(before[1], tied, strict=True)):
                events += [("knot", row, head, number) for number in range(first, then)]
        last = ends if row == before[0] else 5
        events += [("end", before[0], code, 0) for code in range(before[2], last)]
        if alarm not in {0, before[3]}:
            events.append(("alarm", alarm, 0, 0))
        before = row, tied, ends, alarm
        assert loom.scans < 12_000
    assert loom.woven()
    return events


@pytest.mark.matrix(light=3)
@pytest.mark.parametrize("seed", range(40))
def test_journals_of_one_head_are_equal_event_by_event(seed: int) -> None:
    programme = small_programme(3, 12, 1, 3, seed=seed, weft_rows=2)
    events = plc_events(programme, Script(seed, 1))
    assert events == controller_events(programme, Script(seed, 1))
    assert any(event[0] == "alarm" for event in events)


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize("seed", range(40))
def test_journals_of_more_heads_are_equal_for_each_station(seed: int) -> None:
    """Heads tie at their own pace: the order of events is compared for each head and for the loom as a whole."""
    heads = 2 + seed % 2
    programme = small_programme(3, 12, heads, 3, seed=seed, weft_rows=2)
    journals = []
    for events in (plc_events(programme, Script(seed, heads)), controller_events(programme, Script(seed, heads))):
        stations: dict[int, list[Event]] = defaultdict(list)
        for event in events:
            if event[0] != "alarm":
                stations[event[2] if event[0] == "knot" else heads].append(event)
        journals.append(stations)
    assert journals[0] == journals[1]


def without_what_was_taken_out_unfinished(events: list[Event]) -> list[Event]:
    """A stop ends with the knots in progress, and one controller may have begun one more: that row is left out."""
    kept: list[Event] = []
    for event in events:
        if event[0] == "back":
            row = kept[-1][1]
            while kept[-1][1] == row and kept[-1][0] != "back":
                kept.pop()
        kept.append(event)
    return kept


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize("seed", range(20))
def test_rows_taken_out_are_woven_again_alike(seed: int) -> None:
    """The loom is stopped three times in the middle of a row, and rows are taken out."""
    programme = small_programme(6, 12, 1, 3, seed=seed, weft_rows=20)
    random = np.random.default_rng(seed)
    backs = [(12 * row + 5, int(random.integers(0, min(row, 3) + 1))) for row in (1, 3, 4)]
    honest = Script(seed, 1)
    honest.acts = {0: [], 1: []}
    journals = [
        without_what_was_taken_out_unfinished(events(programme, honest, backs))
        for events in (plc_events, controller_events)
    ]
    assert journals[0] == journals[1]
    assert [event[1] for event in journals[0] if event[0] == "back"] == [
        row - rows for row, (_, rows) in zip((1, 3, 4), backs, strict=True)
    ]
