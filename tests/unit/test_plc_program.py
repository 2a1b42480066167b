"""The control program for PLCs, executed by an interpreter of structured text against a loom."""

import csv
import io
import re
from functools import cache
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from click.testing import CliRunner
from effort import examples
from hypothesis import given
from hypothesis import strategies as st
from plc_loom import HONEST, Act, PlcLoom
from small_programme import small_programme
from structured_text import Machine

from ilmek.cli import main
from ilmek.io.plc.cam_function import ERROR, cam_tables, cam_units
from ilmek.io.plc.interlock_logic import SENSOR_NAMES, TENSION_KNOWN, interlock_unit
from ilmek.io.plc.io_list import io_rows
from ilmek.io.plc.plcopen_xml import NAMESPACE, XHTML, plcopen_xml
from ilmek.io.plc.project import plc_project
from ilmek.io.plc.state_model import state_units
from ilmek.io.plc.targets import TARGETS, whole_program
from ilmek.io.plc.units import PlcProject, PlcUnit
from ilmek.io.programme_file import write_programme
from ilmek.loom.control.alarms import ALARMS
from ilmek.loom.control.interlocks import axes_of, usual_limits, violated
from ilmek.loom.control.packml import COMPLETED, PackCommand, PackMode, PackState, Refusal, commanded
from ilmek.loom.control.ports import EndRow, Fault, Sensors, Tie
from ilmek.loom.operations import RowEnd
from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.timing.track import sample
from ilmek.units import turn
from ilmek.weaving.tension import usual_tension

HEADS = 2
LIMITS = usual_limits(0.002)


@cache
def state_model() -> Machine:
    return machine_of(*state_units())


def machine_of(*units: PlcUnit) -> Machine:
    return Machine(PlcProject("parts", (), units, 0.01).text)


@pytest.mark.parametrize("mode", PackMode)
def test_every_command_leads_where_the_controller_goes(mode: PackMode) -> None:
    for state in PackState:
        for command in PackCommand:
            expected = commanded(mode, state, command)
            found = state_model().call("CommandedState", int(state), int(command), int(mode))
            assert found == (0 if isinstance(expected, Refusal) else int(expected)), (state, command)


def test_acting_states_complete_as_in_the_controller() -> None:
    for state in PackState:
        assert state_model().call("CompletedState", int(state)) == int(COMPLETED.get(state, state))


SENSOR_STATES = st.builds(
    Sensors,
    door_closed=st.booleans(),
    emergency_stop=st.booleans(),
    warp_tension=st.none() | st.floats(0, 40, width=32),
    grippers_open=st.tuples(st.booleans(), st.booleans()),
    heads_clear=st.booleans(),
    beater_back=st.booleans(),
    shed_closed=st.booleans(),
)


@cache
def rules() -> Machine:
    return machine_of(interlock_unit(HEADS, LIMITS))


@given(SENSOR_STATES)
@examples(150)
def test_interlocks_permit_what_the_controller_permits(sensors: Sensors) -> None:
    block = rules().instance("Interlocks")
    inputs = {name: getattr(sensors, field) for field, name in SENSOR_NAMES.items()}
    inputs |= {TENSION_KNOWN: sensors.warp_tension is not None, "WarpTension": sensors.warp_tension or 0.0}
    rules().run(block, **inputs)
    limits = LIMITS
    for operation in RowEnd:
        name = "".join(part.capitalize() for part in operation.name.split("_"))
        broken = violated(axes_of(EndRow(0, operation)), sensors, limits)
        assert rules().read(block, f"Permit{name}") == (not broken)
        assert rules().read(block, f"Blocked{name}") == (ALARMS[broken[0].name].number if broken else 0)
    permits = rules().read(block, "PermitKnot")
    for head in range(HEADS):
        assert permits[head] == (not violated(axes_of(Tie(head, 0, 0, 0, 0)), sensors, limits, head))


def test_cams_follow_the_cyclograms() -> None:
    cyclograms = design(AutomatedLoomParams(aim="price")).cyclograms
    tables = cam_tables(cyclograms)
    machine = machine_of(*cam_units(tables))
    tracks = [track for cyclogram in cyclograms for track in cyclogram.tracks]
    assert len(tables) == len(tracks) == len({table.name for table in tables})
    for table, track in zip(tables, tracks, strict=True):
        assert table.error <= ERROR * track.stroke
        angles = np.linspace(0.0, turn, 23)
        block = machine.instance(table.name)
        found = []
        for angle in angles:
            machine.run(block, Angle=float(angle))
            found.append(machine.read(block, "Position"))
        assert found == pytest.approx(sample(track, angles).position, abs=1.01 * ERROR * track.stroke)


@pytest.mark.parametrize(("heads", "yarns", "seed"), [(1, 2, 1), (2, 3, 2), (3, 4, 3)])
def test_the_program_weaves_the_carpet_of_its_chart(heads: int, yarns: int, seed: int) -> None:
    loom = PlcLoom(small_programme(4, 24, heads, yarns, seed=seed, weft_rows=2))
    loom.start()
    loom.until("StateCurrent", int(PackState.COMPLETE))
    assert loom.woven()
    assert (loom.changes, loom.read("KnotsDone"), loom.alarms) == ([2], 96, [])


def test_carpet_after_carpet_is_woven() -> None:
    """After Complete, Reset begins the next carpet when the host has begun its journal: the same, then a smaller."""
    loom = PlcLoom(small_programme(3, 24, 2, 3))
    weave(loom)
    loom.command = int(PackCommand.RESET)
    for _ in range(50):
        loom.scan()
    assert loom.read("StateCurrent") == int(PackState.RESETTING), "the host's journal is that of the woven carpet"
    loom.next_carpet(loom.programme)
    weave(loom)
    loom.next_carpet(small_programme(4, 12, 2, 2, seed=5))
    loom.command = int(PackCommand.RESET)
    weave(loom)
    assert loom.read("KnotsDone") == 48


def weave(loom: PlcLoom) -> None:
    """The carpet from the next scan on to its end."""
    loom.scan()
    loom.attend(5000)
    assert loom.woven()
    assert loom.read("StateCurrent") == int(PackState.COMPLETE)


def test_a_missed_grip_is_tried_again_once_then_the_loom_holds_and_asks() -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    missed = ALARMS[Fault.MISSED_GRIP].number
    loom.start()
    acts = [Act(tied=False, fault=missed), HONEST, Act(tied=False, fault=missed), Act(tied=False, fault=missed)]
    loom.next_act = lambda head: acts.pop(0) if head == 0 and acts else HONEST
    loom.until("KnotsDone", 4)
    assert loom.read("Alarm") == 0
    loom.until("StateCurrent", int(PackState.HELD))
    assert loom.read("Alarm") == missed
    loom.scan(Acknowledge=True)
    loom.command = int(PackCommand.UNHOLD)
    loom.scan(Acknowledge=False)
    loom.until("AskTie", [True, False])
    assert loom.read("TieColumn")[0] == loom.columns[0], "the question names the knot"
    weave(loom)


def test_the_door_aborts_and_the_knots_in_progress_are_asked_for() -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.start()
    loom.until("TieStart", [True, True])
    loom.sensors["DoorClosed"] = False
    loom.scan()
    assert loom.read("Halt")
    assert loom.read("Alarm") == ALARMS["door open"].number
    loom.sensors["DoorClosed"] = True
    loom.until("StateCurrent", int(PackState.ABORTED))
    loom.scan(Acknowledge=True)
    loom.command = int(PackCommand.CLEAR)
    loom.scan(Acknowledge=False)
    loom.until("StateCurrent", int(PackState.STOPPED))
    loom.command = int(PackCommand.RESET)
    loom.scan(TieAnswer=[1, 1])
    loom.until("AskTie", [True, True])
    for _ in range(5):
        loom.scan(TieAnswer=[1, 1])
    assert loom.read("AskTie") == [True, True], "an answer that was given before the question is none"
    loom.scan(TieAnswer=[0, 0])
    loom.scan(TieAnswer=[1, 1])
    loom.until("StateCurrent", int(PackState.IDLE))
    loom.command = int(PackCommand.START)
    loom.scan(TieAnswer=[0, 0])
    loom.until("StateCurrent", int(PackState.COMPLETE))
    assert loom.woven()


def test_low_tension_suspends_and_weaving_goes_on_by_itself() -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.start()
    loom.sensors["WarpTension"] = 1.0
    loom.until("StateCurrent", int(PackState.SUSPENDED))
    knots = loom.read("KnotsDone")
    for _ in range(5):
        loom.scan()
    assert loom.read("KnotsDone") == knots
    assert loom.read("Alarm") == ALARMS["warp tension low"].number
    loom.sensors["WarpTension"] = usual_tension(loom.programme.setup.warp_pitch)
    loom.until("StateCurrent", int(PackState.COMPLETE))


def test_maintenance_weaves_one_row_or_one_knot_of_each_head() -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.scan(UnitMode=int(PackMode.MAINTENANCE), UnitModeChangeRequest=True)
    loom.scan(UnitModeChangeRequest=False)
    loom.start()
    loom.until("StateCurrent", int(PackState.COMPLETE))
    assert (loom.read("RowRequest"), len(loom.ends)) == (1, 5)
    loom.command = int(PackCommand.RESET)
    loom.scan(StepKnot=True)
    loom.until("StateCurrent", int(PackState.IDLE))
    loom.command = int(PackCommand.START)
    loom.until("StateCurrent", int(PackState.COMPLETE))
    assert loom.read("KnotsDone") == len(loom.carpet) == 14


def test_a_head_that_does_not_retreat_holds_the_loom_before_the_weft() -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.start()
    loom.until("KnotsDone", 12)
    loom.heads_clear = False
    loom.until("StateCurrent", int(PackState.HELD))
    assert (loom.read("Alarm"), loom.ends) == (ALARMS["head between the warps"].number, [])
    loom.heads_clear = None
    loom.scan(Acknowledge=True)
    loom.command = int(PackCommand.UNHOLD)
    loom.scan(Acknowledge=False)
    loom.until("StateCurrent", int(PackState.COMPLETE))


def test_a_jog_moves_only_where_the_interlocks_allow() -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.scan(UnitMode=int(PackMode.MANUAL), UnitModeChangeRequest=True)
    loom.scan(UnitModeChangeRequest=False)
    loom.start()
    beater = 6
    loom.heads_clear = False
    loom.scan(JogAxis=beater)
    assert not loom.read("JogStart"), "the heads are in the comb's path"
    loom.heads_clear = True
    loom.scan()
    assert loom.read("JogStart")
    assert loom.carpet == {}


def test_a_command_is_carried_out_once_and_refused_where_the_state_forbids_it() -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.command = int(PackCommand.START)
    loom.scan()
    assert (loom.read("Refused"), loom.read("StateCurrent")) == (True, int(PackState.STOPPED))


def test_the_xml_contains_every_unit_with_its_text() -> None:
    bare = plc_project(small_programme())
    project = whole_program(bare, io_rows(bare.units[-1]))
    root = ET.fromstring(plcopen_xml(project))
    spaces = {"p": NAMESPACE, "x": XHTML}
    texts = {
        unit.get("name"): unit.findtext("p:body/p:ST/x:p", namespaces=spaces)
        for unit in root.findall("p:types/p:pous/p:pou", spaces)
    }
    assert texts == {unit.name: unit.body for unit in project.units}
    program = root.find("p:instances//p:pouInstance", spaces)
    assert program is not None
    assert program.get("typeName") == "Main"
    retained = root.findall(
        "p:types/p:pous/p:pou[@name='Loom']/p:interface/p:localVars[@retain='true']/p:variable", spaces
    )
    assert {one.get("name") for one in retained} == {"SavedEven", "SavedOdd", "OddIsLast"}


@pytest.mark.parametrize("target", TARGETS)
def test_every_signal_has_an_address_of_its_own(target: str) -> None:
    """Whether the controller counts bytes or words: no two signals share a bit."""
    rows = list(
        csv.DictReader(io.StringIO(TARGETS[target].files(plc_project(small_programme(heads=3)))["io.csv"].decode()))
    )
    addresses = [row["address"] for row in rows if row["address"]]
    assert len(addresses) == len(set(addresses))
    by_name = {row["variable"]: row for row in rows}
    assert by_name["TieStart[2]"]["direction"] == "output"
    assert by_name["WarpTension"]["address"].startswith("%ID")
    assert by_name["CntrlCmd"]["address"] == ""
    for letter in "IQ":
        spans = sorted(span(address, target) for address in addresses if address[1] == letter)
        assert all(first[1] <= then[0] for first, then in pairwise(spans))


def span(address: str, target: str) -> tuple[int, int]:
    """First bit of an address, and the one behind its last, by the manuals of the controllers."""
    kind, number = re.fullmatch(r"%[IQ]([XBWD]?)([\d.]+)", address).groups()  # type: ignore[union-attr]
    assert (kind == "") == (target == "tia" and "." in number)
    if "." in number:
        byte, bit = map(int, number.split("."))
        return 8 * byte + bit, 8 * byte + bit + 1
    size = {"B": 1, "W": 2, "D": 4}[kind]
    begin = 8 * int(number) * (1 if target in {"tia", "twincat"} else size)
    assert begin % (8 * min(size, 2)) == 0
    return begin, begin + 8 * size


def test_the_command_writes_the_program_and_the_rows_of_a_file(tmp_path: Path) -> None:
    programme = small_programme(4, 24, 2, 3)
    write_programme(tmp_path / "programme.ilmek", programme)
    done = CliRunner().invoke(main, ["plc", str(tmp_path / "programme.ilmek"), "--out", str(tmp_path / "plc")])
    assert done.exit_code == 0, done.output
    assert (tmp_path / "plc" / "loom.st").read_bytes() == TARGETS["codesys"].files(plc_project(programme))["loom.st"]
    rows = np.loadtxt(tmp_path / "plc" / "rows.csv", delimiter=",", skiprows=1, dtype=int)
    for number in range(4):
        row, knots = programme.operations(number), rows[rows[:, 0] == number]
        assert knots[:, 4].tolist() == row.columns.tolist()
        assert knots[:, 5].tolist() == row.tubes.tolist()
        assert knots[:, 6].sum() == sum(2 for _ in row.stops)


def test_a_file_that_is_no_programme_is_refused_and_nothing_is_written(tmp_path: Path) -> None:
    (tmp_path / "programme.ilmek").write_bytes(b"no programme")
    done = CliRunner().invoke(main, ["plc", str(tmp_path / "programme.ilmek"), "--out", str(tmp_path / "plc")])
    assert done.exit_code == 2
    assert not (tmp_path / "plc").exists()
