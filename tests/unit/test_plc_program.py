"""The control program for PLCs, executed by an interpreter of structured text against a loom."""

import csv
import io
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
from plc_loom import SENSORS, PlcLoom
from small_programme import small_programme
from structured_text import Machine

from ilmek.cli import main
from ilmek.io.plc.cam_function import ERROR, cam_tables, cam_units
from ilmek.io.plc.interlock_logic import SENSOR_NAMES, TENSION_KNOWN, interlock_unit
from ilmek.io.plc.io_list import io_csv
from ilmek.io.plc.plcopen_xml import NAMESPACE, XHTML, plcopen_xml
from ilmek.io.plc.project import plc_project
from ilmek.io.plc.state_model import state_units
from ilmek.io.programme_file import write_programme
from ilmek.loom.control.alarms import ALARMS
from ilmek.loom.control.interlocks import axes_of, usual_limits, violated
from ilmek.loom.control.packml import COMPLETED, PackCommand, PackMode, PackState, Refusal, commanded
from ilmek.loom.control.ports import EndRow, Fault, Sensors, Tie
from ilmek.loom.operations import ROW_ENDS, RowEnd
from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.timing.track import sample
from ilmek.units import turn

HEADS = 2
LIMITS = usual_limits(0.002)


@cache
def state_model() -> Machine:
    return Machine("\n".join(one.text for one in state_units()))


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
    return Machine(interlock_unit(HEADS, LIMITS).text)


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
    machine = Machine("\n".join(one.text for one in cam_units(tables)))
    tracks = [track for cyclogram in cyclograms for track in cyclogram.tracks]
    assert len(tables) == len(tracks) == len({table.name for table in tables})
    for table, track in zip(tables, tracks, strict=True):
        assert table.error <= ERROR * track.stroke
        angles = np.linspace(0.0, turn, 23)
        found = [machine.call(table.name, float(angle)) for angle in angles]
        assert found == pytest.approx(sample(track, angles).position, abs=1.01 * ERROR * track.stroke)


@pytest.mark.parametrize(("heads", "yarns", "seed"), [(1, 2, 1), (2, 3, 2), (3, 4, 3)])
def test_the_program_weaves_the_carpet_of_its_chart(heads: int, yarns: int, seed: int) -> None:
    programme = small_programme(4, 24, heads, yarns, seed=seed, weft_rows=2)
    loom = PlcLoom(programme)
    loom.start()
    loom.until("StateCurrent", int(PackState.COMPLETE))
    for row in range(4):
        tied = [loom.carpet[row, column] for column in range(24)]
        assert [len(one) for one in tied] == [1] * 24
        assert [one[0] for one in tied] == programme.chart_row(row).tolist()
    assert loom.ends == [(row, int(end)) for row in range(4) for end in ROW_ENDS]
    assert loom.changes == [2]
    assert loom.read("KnotsDone") == 96


@pytest.mark.matrix(light=7)
@pytest.mark.parametrize("seed", range(20))
def test_power_cuts_lose_and_double_nothing(seed: int) -> None:
    random = np.random.default_rng(seed)
    programme = small_programme(3, 12, 2, 3, seed=seed, weft_rows=2)
    loom = PlcLoom(programme)
    for _ in range(random.integers(1, 8)):
        weave(loom, int(random.integers(1, 40)))
        loom.power_cut(tied=bool(random.integers(2)))
    weave(loom, 1000)
    assert loom.read("CarpetDone")
    assert loom.ends == [(row, int(end)) for row in range(3) for end in ROW_ENDS]
    for row in range(3):
        assert [loom.carpet[row, column] for column in range(12)] == [[one] for one in programme.chart_row(row)]


def weave(loom: PlcLoom, scans: int) -> None:
    """Scans at whose beginning an operator resets and starts the loom; up to the end of the carpet."""
    commands = {int(PackState.STOPPED): int(PackCommand.RESET), int(PackState.IDLE): int(PackCommand.START)}
    for _ in range(scans):
        state = loom.read("StateCurrent")
        if state == int(PackState.COMPLETE):
            return
        loom.command = commands.get(state, 0)
        loom.scan(**answer(loom))


def answer(loom: PlcLoom) -> dict[str, object]:
    """What the sensors answer to the questions of the program: whether the knot or operation is in the carpet."""
    row, answers = loom.read("Row"), []
    if row >= loom.programme.setup.rows:
        return {}
    operations = loom.programme.operations(row)
    for head, asked in enumerate(loom.read("AskTie")):
        at = int(operations.starts[head]) + loom.read("Tied")[head]
        answers.append(0 if not asked else 1 + ((row, int(operations.columns[at])) in loom.carpet))
    end = 1 + ((row, loom.read("EndsDone")) in loom.ends) if loom.read("AskEnd") else 0
    return {"TieAnswer": answers, "EndAnswer": end}


def test_a_missed_grip_is_tried_again_once_then_the_loom_holds() -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    missed = ALARMS[Fault.MISSED_GRIP].number
    loom.start()
    loom.fail(0, missed)
    loom.until("KnotsDone", 4)
    assert loom.read("Alarm") == 0
    loom.until("TieStart", [True, True])
    loom.fail(0, missed)
    for _ in range(40):
        if loom.read("Alarm"):
            break
        if 0 not in loom._fail:
            loom.fail(0, missed)
        loom.scan()
    assert loom.read("Alarm") == missed
    loom._fail.clear()
    loom.until("StateCurrent", int(PackState.HELD))
    loom.scan(Acknowledge=True)
    loom.command = int(PackCommand.UNHOLD)
    loom.scan(Acknowledge=False)
    loom.until("StateCurrent", int(PackState.COMPLETE))
    assert all(len(one) == 1 for one in loom.carpet.values())


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
    loom.until("AskTie", [True, True])
    loom.scan(TieAnswer=[1, 1])
    loom.until("StateCurrent", int(PackState.IDLE))
    loom.command = int(PackCommand.START)
    loom.scan(TieAnswer=[0, 0])
    loom.until("StateCurrent", int(PackState.COMPLETE))
    assert all(len(one) == 1 for one in loom.carpet.values())


def test_low_tension_suspends_and_weaving_goes_on_by_a_command() -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.start()
    loom.sensors["WarpTension"] = 1.0
    loom.until("StateCurrent", int(PackState.SUSPENDED))
    knots = loom.read("KnotsDone")
    for _ in range(5):
        loom.scan()
    assert loom.read("KnotsDone") == knots
    loom.sensors["WarpTension"] = SENSORS["WarpTension"]
    loom.command = int(PackCommand.UNSUSPEND)
    loom.until("StateCurrent", int(PackState.COMPLETE))


def test_maintenance_weaves_one_row_or_one_knot_of_each_head() -> None:
    loom = PlcLoom(small_programme(3, 12, 2, 2))
    loom.scan(UnitMode=int(PackMode.MAINTENANCE), UnitModeChangeRequest=True)
    loom.scan(UnitModeChangeRequest=False)
    loom.start()
    loom.until("StateCurrent", int(PackState.COMPLETE))
    assert (loom.read("Row"), len(loom.ends)) == (1, 5)
    loom.command = int(PackCommand.RESET)
    loom.scan(StepKnot=True)
    loom.until("StateCurrent", int(PackState.IDLE))
    loom.command = int(PackCommand.START)
    loom.until("StateCurrent", int(PackState.COMPLETE))
    assert 12 < loom.read("KnotsDone") <= 14


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
    project = plc_project(small_programme())
    root = ET.fromstring(plcopen_xml(project))
    spaces = {"p": NAMESPACE, "x": XHTML}
    texts = {
        unit.get("name"): unit.findtext("p:body/p:ST/x:p", namespaces=spaces)
        for unit in root.findall("p:types/p:pous/p:pou", spaces)
    }
    assert texts == {unit.name: unit.body for unit in project.units}
    program = root.find("p:instances//p:pouInstance", spaces)
    assert program is not None
    assert program.get("typeName") == "Loom"
    retained = root.findall(
        "p:types/p:pous/p:pou[@name='Loom']/p:interface/p:localVars[@retain='true']/p:variable", spaces
    )
    assert {"Row", "Tied", "TieBusy"} <= {one.get("name") for one in retained}


def test_every_signal_has_an_address_of_its_own() -> None:
    program = plc_project(small_programme(heads=3)).units[-1]
    rows = list(csv.DictReader(io.StringIO(io_csv(program))))
    addresses = [row["address"] for row in rows if row["address"]]
    assert len(addresses) == len(set(addresses))
    by_name = {row["variable"]: row for row in rows}
    assert by_name["TieStart[2]"]["direction"] == "output"
    assert by_name["WarpTension"]["address"].startswith("%ID")
    assert by_name["CntrlCmd"]["address"] == ""
    spans = sorted(span(address) for address in addresses if address[1] == "I")
    assert all(first[1] <= then[0] for first, then in pairwise(spans))


def span(address: str) -> tuple[float, float]:
    """First bit of an address, and the one behind its last."""
    kind, number = address[2], address[3:]
    if kind == "X":
        byte, bit = map(int, number.split("."))
        return 8 * byte + bit, 8 * byte + bit + 1
    size = {"B": 1, "W": 2, "D": 4}[kind]
    return 8 * size * int(number), 8 * size * (int(number) + 1)


def test_the_command_writes_the_program_and_the_rows_of_a_file(tmp_path: Path) -> None:
    programme = small_programme(4, 24, 2, 3)
    write_programme(tmp_path / "programme.ilmek", programme)
    done = CliRunner().invoke(main, ["plc", str(tmp_path / "programme.ilmek"), "--out", str(tmp_path / "plc")])
    assert done.exit_code == 0, done.output
    assert (tmp_path / "plc" / "loom.st").read_text() == plc_project(programme).text
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
