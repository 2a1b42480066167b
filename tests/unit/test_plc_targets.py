"""The text of the control program for each target: what compilers disagree about is not in it."""

import re

import pytest
from small_programme import small_programme
from structured_text import Machine, Parser

from ilmek.io.plc.project import plc_project
from ilmek.io.plc.scl import scl_body
from ilmek.io.plc.targets import TARGETS
from ilmek.io.plc.units import PlcProject
from ilmek.loom.control.alarms import ALARMS
from ilmek.machines.automated_loom.equipment.signals import signals_of

STANDARD = set(
    re.findall(
        r"\w+",
        """ABS ACOS ADD AND ASIN
    AT ATAN BY CASE CONCAT COS CTD CTU CTUD DELETE DIV DO DT ELSE ELSIF EN END ENO EQ EXIT EXP
    EXPT F_TRIG FIND FOR FROM FUNCTION GE GT IF INSERT INT LE LEFT LEN LIMIT LN LOG LT MAX MID MIN MOD MOVE MUL MUX NE
    NOT OF ON OR PROGRAM PT R_TRIG READ REPEAT REPLACE RESOURCE RETAIN RETURN RIGHT ROL ROR RS SEL SHL SHR SIN SQRT SR
    STEP STRUCT SUB TAN TASK THEN TIME TO TOD TOF TON TP TRUE TRUNC TYPE UNTIL VAR WHILE WITH WRITE XOR""",
    )
)
"""Keywords, and functions and blocks that IEC 61131-3 has already."""


def project(heads: int) -> PlcProject:
    return plc_project(small_programme(4, 24, heads, 3))


def text_of(heads: int, target: str) -> str:
    return TARGETS[target].files(project(heads))["loom.scl" if target == "tia" else "loom.st"].decode()


def without_remarks(text: str) -> str:
    return re.sub(r"\(\*.*?\*\)|//[^\n]*", "", text, flags=re.DOTALL)


@pytest.mark.parametrize("heads", [1, 3])
@pytest.mark.parametrize("target", TARGETS)
def test_the_text_has_nothing_that_compilers_disagree_about(target: str, heads: int) -> None:
    text = without_remarks(text_of(heads, target))
    loops = re.findall(r"FOR #?\w+ := (\d+) TO (#?\w+) DO", text)
    assert loops
    assert len(loops) == len(re.findall(r"\bFOR\b", text))
    assert all(not last.isdigit() or int(first) < int(last) for first, last in loops), "a pass or none"
    assert not re.search(r"\bRETURN\b", text)
    assert not re.search(r"\bNOT\s*\(", text), "a function for some"
    assert not re.search(r"\d+, *\d+ *:(?!=)", text), "a list of labels"
    assert max(map(len, re.findall(r"[A-Za-z_]\w*", text))) <= 31
    if target != "tia":
        assert all(line.startswith("TYPE") for line in text.splitlines() if "ARRAY[" in line), "an array without a name"


def test_no_name_is_one_of_the_standard() -> None:
    named = {variable.name.upper() for unit in project(2).units for variable in unit.variables}
    named |= {unit.name.upper() for unit in project(2).units}
    assert not named & STANDARD


@pytest.mark.parametrize("target", ["codesys", "twincat", "openplc"])
def test_the_program_of_the_task_reads_and_writes_the_signals(target: str) -> None:
    machine = Machine(text_of(2, target))
    assert machine.tasks == {"MAIN": "T#10ms"}
    main = machine.instance("Main")
    safe = {"DoorClosedSignal": True, "HeadsClearSignal": True, "BeaterBackSignal": True, "ShedClosedSignal": True,
            "GrippersOpen0": True, "GrippersOpen1": True}  # fmt: skip
    machine.run(main, **safe)
    assert not machine.read(main, "HaltSignal")
    machine.run(main, EmergencyStopSignal=True)
    assert machine.read(main, "HaltSignal")
    assert machine.read(main, "Alarm") == ALARMS["emergency stop"].number
    located = re.findall(r"(\w+) AT (%[\w.]+) : (\w+)", text_of(2, target))
    assert len(located) == len({address for _, address, _ in located}) == len(signals_of(2))


def test_scl_has_the_same_statements_with_marked_names() -> None:
    """Without its marks each body is that of the model; every name has one, but formal arguments and members."""
    units = project(2).units
    names = {unit.name for unit in units}
    for unit in units:
        local = {variable.name for variable in unit.variables} | ({unit.name} if unit.returns else set())
        body = scl_body(unit.body, local, names)
        assert body.replace("#", "").replace('"', "") == unit.body.replace("#", "")
        bare = re.sub(r"\(\*.*?\*\)|DWORD#16#\w+|#\w+(\.\w+)*|\"\w+\"|\w+ (:=|=>)", "", body, flags=re.DOTALL)
        bare = re.sub(r"\.\w+", "", bare)
        unmarked = set(re.findall(r"[A-Za-z_]\w*", bare)) - STANDARD
        assert {name for name in unmarked if "_TO_" not in name} <= {
            "END_IF",
            "END_FOR",
            "END_CASE",
            "END_WHILE",
            "FALSE",
        }


def test_scl_maps_each_signal_once() -> None:
    text = text_of(2, "tia")
    cycle = text[text.index('FUNCTION "LoomCycle"') :]
    before, behind = cycle.split('"LoomData"();')
    read = re.findall(r'("LoomData"\.[\w\[\]]+) := (%I[\w.]+);', before)
    written = re.findall(r'(%Q[\w.]+) := ("LoomData"\.[\w\[\]]+);', behind)
    assert len({one for pair in (*read, *written) for one in pair}) == 2 * len(signals_of(2))


def test_the_interpreter_refuses_what_it_does_not_know() -> None:
    with pytest.raises(Exception, match="expected"):
        Parser("FUNCTION_BLOCK A VAR X : INT END_VAR END_FUNCTION_BLOCK").parse()
