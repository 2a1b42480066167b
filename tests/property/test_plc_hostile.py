"""The control program against stations that lie, hosts that err and power cuts in the middle of a scan.

Every knot and every operation after the knots gets into the carpet once, or the loom stops with an alarm; with an
operator who answers what the sensor says, the carpet is woven to its end. One lie is beyond the program: done without a
knot.
"""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from plc_loom import HONEST, Act, PlcLoom
from small_programme import small_programme

from ilmek.io.plc.host_data import HostRow, checked
from ilmek.jobs.plc.plant import hostile_drives
from ilmek.loom.control.alarms import ALARMS, ControlFault, JournalFault
from ilmek.loom.control.interlocks import LoomAxis
from ilmek.loom.control.packml import PackCommand, PackMode, PackState
from ilmek.loom.control.ports import Fault

UNEXPECTED, STUCK = ALARMS[ControlFault.UNEXPECTED].number, ALARMS[ControlFault.STUCK].number


@pytest.mark.matrix(light=5)
@pytest.mark.parametrize("seed", range(200))
def test_hostile_stations_and_power_cuts_lose_and_double_nothing(seed: int) -> None:
    random = np.random.default_rng(seed)
    heads = int(random.integers(1, 4))
    loom = PlcLoom(small_programme(3, 12, heads, 3, seed=seed, weft_rows=2))
    act_of = hostile_drives(seed)
    loom.next_act = act_of
    loom.home_act = lambda: act_of(heads)
    for _ in range(int(random.integers(1, 12))):
        loom.attend(int(random.integers(1, 80)))
        if random.random() < 0.2:
            loom.stations[random.integers(heads + 1)].unasked = int(random.integers(1, 4))
        if loom.read("CarpetDone"):
            break
        loom.power_cut(tied=bool(random.integers(2)), steps=int(random.integers(-1, 900)))
    loom.attend(12_000)
    assert loom.woven()
    assert loom.read("CarpetDone")


def test_power_fails_at_each_step_of_writing_the_record_of_a_knot() -> None:
    """A scan in which a knot is reported, cut off at one of its last steps: each step in its turn."""
    loom = PlcLoom(small_programme(5, 16, 1, 2))
    head = loom.stations[0]
    for back in range(60):
        while head.left - head.elapsed != 1 or not head.elapsed:
            loom.machine.steps = -1
            loom.attend(1)
            assert loom.scans < 3000
        used = -1 - loom.machine.steps
        loom.power_cut(tied=False, steps=used + 15 - back)
        assert loom.row < 5
    loom.attend(5000)
    assert loom.woven()


@pytest.mark.parametrize(
    ("act", "alarm"),
    [
        (Act(silent=True), Fault.TIMEOUT),
        (Act(tied=False, silent=True), Fault.TIMEOUT),
        (Act(fault=ALARMS[Fault.TIMEOUT].number), Fault.TIMEOUT),
        (Act(fault=ALARMS[Fault.PILE_BREAK].number), Fault.PILE_BREAK),
        (Act(early=True), ControlFault.UNEXPECTED),
        (Act(hasty=True), ControlFault.UNEXPECTED),
        (Act(fault=999), ControlFault.UNEXPECTED),
        (Act(stuck=1000), ControlFault.STUCK),
    ],
)
@pytest.mark.matrix(light=8)
@pytest.mark.parametrize("station", [0, 2])
def test_what_a_station_does_wrong_holds_the_loom_and_is_asked_for(act: Act, alarm: str, station: int) -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    acts = [HONEST, act]
    loom.next_act = lambda number: acts.pop(0) if number == station and acts else HONEST
    loom.start()
    loom.until("StateCurrent", int(PackState.HELD), 2000)
    assert loom.read("Alarm") == ALARMS[alarm].number
    assert loom.read("KnotsDone") in {len(loom.carpet), len(loom.carpet) - 1}
    if act.stuck:
        loom.stations[station].stuck = 0
    loom.attend(5000)
    assert loom.woven()


@pytest.mark.parametrize(
    "act",
    [
        Act(silent=True),
        Act(tied=False),
        Act(fault=ALARMS[Fault.TIMEOUT].number),
        Act(tied=False, early=True),
        Act(hasty=True),
    ],
)
def test_an_axis_that_is_not_homed_as_ordered_stops_the_loom_and_is_homed_again(act: Act) -> None:
    """After a power cut among the warps: grippers and heads are not at home, and a drive may state that they are."""
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.start()
    loom.until("KnotsDone", 3)
    while not any(0 < head.elapsed < head.left for head in loom.stations[:2]):
        loom.scan()
    loom.power_cut(tied=True)
    assert not all(loom.sensors["GrippersOpen"])
    acts = [act]
    loom.home_act = lambda: acts.pop() if acts else HONEST
    loom.homed.clear()
    loom.command = PackCommand.RESET
    loom.scan()
    loom.until("StateCurrent", int(PackState.STOPPED), 200)
    assert loom.read("Alarm") == ALARMS[ControlFault.NOT_HOME].number
    loom.attend(5000)
    assert loom.homed.index("grippers") < loom.homed.index("heads")
    assert loom.woven()


@pytest.mark.parametrize("scans", range(2, 60, 6))
def test_power_that_fails_while_axes_are_homed_begins_homing_anew(scans: int) -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.attend(120)
    loom.power_cut(tied=bool(scans % 4))
    loom.attend(scans)
    loom.power_cut(tied=bool(scans % 3))
    loom.homed.clear()
    loom.attend(5000)
    assert sorted(loom.homed) == sorted(axis.value for axis in LoomAxis)
    assert loom.woven()


def test_a_loom_that_is_not_at_home_does_not_start() -> None:
    """Manual mode needs no homing; the mode is changed in Idle, and Start is refused."""
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.scan(UnitMode=int(PackMode.MANUAL), UnitModeChangeRequest=True)
    loom.command = PackCommand.RESET
    loom.until("StateCurrent", int(PackState.IDLE), 50)
    loom.scan(UnitMode=int(PackMode.PRODUCTION), UnitModeChangeRequest=False)
    loom.scan(UnitModeChangeRequest=True)
    loom.command = PackCommand.START
    loom.scan()
    assert loom.read("Refused")
    assert loom.read("StateCurrent") == int(PackState.IDLE)


def test_a_report_without_an_order_holds_the_loom() -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.start()
    loom.until("KnotsDone", 3)
    loom.stations[2].unasked = 1
    loom.until("StateCurrent", int(PackState.HELD), 50)
    assert loom.read("Alarm") == UNEXPECTED
    loom.attend(5000)
    assert loom.woven()


def forged(row: HostRow, **changes: Any) -> HostRow:
    """A row that is not the programme's, with a check sum that fits it."""
    return checked(replace(row, **changes), small_programme(3, 12, 2, 2).digest)


BAD_ROWS = {
    "column changed": lambda row: replace(row, columns=[row.columns[0] ^ 1, *row.columns[1:]]),
    "tube changed": lambda row: replace(row, tubes=[*row.tubes[:-1], row.tubes[-1] ^ 1]),
    "check sum changed": lambda row: replace(row, check=row.check ^ 4),
    "row of another programme": lambda row: checked(row, "1" * 64),
    "column twice": lambda row: forged(row, columns=[row.columns[1], *row.columns[1:]]),
    "column beyond the carpet": lambda row: forged(row, columns=[12, *row.columns[1:]]),
    "negative column": lambda row: forged(row, columns=[-1, *row.columns[1:]]),
    "tube beyond the head": lambda row: forged(row, tubes=[200, *row.tubes[1:]]),
    "limits beyond the row": lambda row: forged(row, limits=[[30_000] * row.phases, *row.limits[1:]]),
    "negative limits": lambda row: forged(row, limits=[[-30_000] * row.phases, *row.limits[1:]]),
    "a head without its knots": lambda row: forged(row, limits=[[0] * row.phases, *row.limits[1:]]),
    "first knot beyond the row": lambda row: forged(row, first=[0, 30_000]),
    "first knot before the row": lambda row: forged(row, first=[-30_000, row.first[1]]),
    "no phase": lambda row: replace(forged(row, stop_before=[]), limits=[[], []]),
}


@pytest.mark.parametrize("name", BAD_ROWS)
def test_a_row_that_is_not_the_programmes_is_not_woven(name: str) -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.disturb_row = BAD_ROWS[name]
    loom.scan()
    loom.start()
    loom.until("StateCurrent", int(PackState.HELD), 100)
    assert loom.read("Alarm") == ALARMS[JournalFault.ROW_DAMAGED].number
    assert loom.carpet == {}
    loom.disturb_row = lambda row: row
    loom.attend(50)
    assert loom.carpet


def test_a_row_that_the_host_changes_while_it_is_woven_is_woven_as_it_was_checked() -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.start()
    loom.until("KnotsDone", 2)
    loom.host_silent = True
    loom.write({"RowData.Columns": loom.host_row(0).columns[::-1], "RowData.Number": -7})
    loom.until("KnotsDone", 12)
    loom.host_silent = False
    loom.attend(5000)
    assert loom.woven()


def test_a_host_that_gives_no_row_and_no_carpet_is_an_alarm() -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.host_silent = True
    loom.command = int(PackCommand.RESET)
    loom.until("Alarm", ALARMS[ControlFault.NO_HOST].number, 1100)
    assert loom.read("StateCurrent") == int(PackState.RESETTING)
    loom.host_silent = False
    loom.attend(100)
    assert 0 < loom.read("KnotsDone") < 13
    loom.host_silent = True
    loom.until("Alarm", ALARMS[ControlFault.NO_HOST].number, 1300)
    assert loom.read("KnotsDone") == 12
    loom.scan()
    assert loom.read("StateCurrent") == int(PackState.HOLDING)
    loom.host_silent = False
    loom.attend(5000)
    assert loom.woven()


@pytest.mark.parametrize(
    ("changes", "alarm"),
    [
        ({"Programme": (1,) * 8}, JournalFault.OTHER_PROGRAMME),
        ({"Rows": 4}, JournalFault.OTHER_PROGRAMME),
        ({"Columns": 11}, JournalFault.OTHER_PROGRAMME),
        ({"Row": -1}, JournalFault.BEHIND),
        ({"Row": 2}, JournalFault.BEHIND),
    ],
)
def test_a_carpet_goes_on_only_as_the_host_has_it(changes: dict[str, Any], alarm: str) -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.scan()
    loom.attend(230)
    assert loom.read("RowRequest") == 1
    loom.power_cut(tied=False)
    loom.disturb_recipe = lambda recipe: recipe | changes
    woven = sum(map(len, loom.carpet.values()))
    loom.attend(30)
    assert (loom.alarms[-1], sum(map(len, loom.carpet.values()))) == (ALARMS[alarm].number, woven)
    loom.disturb_recipe = lambda recipe: recipe
    loom.attend(5000)
    assert loom.woven()


def test_a_lost_record_stops_the_loom_and_weaves_nothing() -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.scan()
    loom.attend(300)
    woven = sum(map(len, loom.carpet.values()))
    assert woven > 12
    loom.power_cut(tied=False)
    loom.loom.values.update(loom.machine.instance("Loom").values)
    loom.attend(400)
    assert loom.alarms[-1] == ALARMS[JournalFault.BEHIND].number
    assert loom.read("StateCurrent") == int(PackState.RESETTING)
    assert sum(map(len, loom.carpet.values())) == woven


@pytest.mark.parametrize("scans", [0, 3, 8, 40, 130])
def test_an_emergency_stop_halts_in_every_state(scans: int) -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    if scans == 3:
        loom.host_silent = True
    loom.attend(scans)
    loom.sensors["EmergencyStop"] = True
    loom.scan()
    assert loom.read("Halt")
    assert loom.read("Alarm") == ALARMS["emergency stop"].number
    assert not any(loom.orders)
    loom.attend(10)
    assert loom.read("StateCurrent") in {int(PackState.ABORTED), int(PackState.ABORTING), int(PackState.CLEARING)}
    loom.sensors["EmergencyStop"], loom.host_silent = False, False
    loom.attend(5000)
    assert loom.woven()


@pytest.mark.parametrize(("scans", "rows", "woven"), [(60, 0, 0), (230, 0, 1), (230, 1, 0), (320, 2, 0)])
def test_rows_that_were_taken_out_are_woven_again(scans: int, rows: int, woven: int) -> None:
    """Also when the operation in progress was uncertain: it was taken out with its row."""
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.attend(scans)
    assert loom.row == rows + woven
    loom.power_cut(tied=True)
    loom.take_out(rows)
    loom.scan(RowsBack=rows, RowsBackKnots=12 * woven, RowsBackRequest=True)
    assert (loom.read("RowRequest"), loom.read("KnotsDone")) == (woven, 12 * woven)
    loom.scan(RowsBackRequest=False)
    loom.attend(5000)
    assert loom.woven()


def test_rows_are_not_taken_out_beyond_a_change_of_packages() -> None:
    loom = PlcLoom(small_programme(5, 12, 2, 2, weft_rows=2))
    loom.scan()
    while loom.row < 3:
        loom.attend(1)
    assert loom.changes == [2]
    loom.command = int(PackCommand.STOP)
    loom.until("StateCurrent", int(PackState.STOPPED))
    loom.host_silent = True  # its journal is not set back
    for rows, knots, request in ((2, 12, 3), (-1, 36, 3), (30_000, 0, 3), (1, 37, 3), (1, -1, 3), (1, 24, 2)):
        loom.scan(RowsBack=rows, RowsBackKnots=knots, RowsBackRequest=True)
        loom.scan(RowsBackRequest=False)
        assert loom.read("RowRequest") == request


def test_a_given_up_carpet_is_begun_anew() -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.attend(100)
    loom.command = int(PackCommand.STOP)
    loom.until("StateCurrent", int(PackState.STOPPED))
    loom.scan(GiveUp=True)
    assert loom.read("RowRequest") == -1
    loom.next_carpet(small_programme(3, 12, 2, 2, seed=4))
    loom.scan(GiveUp=False)
    loom.attend(5000)
    assert loom.woven()
