"""The sequence of a row in structured text, and the main program of the loom.

The host writes the operations of one row into `RowData` when the program requests it; the program executes the row: its
phases with their stops, the operations after the knots. Position and operations in progress are retained over a power
failure. An operation that was in progress then is uncertain: in state Resetting the program asks whether it is in the
carpet (`Ask...`), and the sensor or an operator answers (`...Answer`: 1 no, 2 yes). So every knot is tied once.

An order is a level: `TieStart[h]` stays until `TieDone[h]`, or `TieFault[h]` with the number of a fault's alarm.
"""

from ilmek.io.plc.interlock_logic import KNOT, OPERATIONS, SENSOR_NAMES, TENSION_KNOWN, capitalised
from ilmek.io.plc.sequence_variables import (
    PlcSize,
    inner_variables,
    program_inputs,
    program_outputs,
    retained_variables,
)
from ilmek.io.plc.state_model import REACTIONS
from ilmek.io.plc.units import INDENT, PlcSection, PlcUnit, PlcVariable
from ilmek.loom.control.alarms import ALARM_NUMBERS, ALARMS
from ilmek.loom.control.interlocks import LoomAxis, Reaction
from ilmek.loom.control.packml import PackMode, PackState
from ilmek.loom.control.ports import Fault
from ilmek.loom.operations import ROW_ENDS

NO_ANSWER, IN_CARPET = 0, 2

PATIENCE = 200
"""Scans for which an operation after the knots waits for its sensors, 2 s: the heads retreat, the shed closes."""


def sequence_units(size: PlcSize) -> tuple[PlcUnit, ...]:
    """The function of the reactions, and the program."""
    return _reaction(), _program(size)


def _reaction() -> PlcUnit:
    lines = ["ReactionOf := 0;", "CASE Alarm OF"]
    lines += [
        f"{INDENT}{number}: ReactionOf := {REACTIONS[kind.reaction]}; (* {kind.name} *)"
        for number, kind in sorted(ALARM_NUMBERS.items())
    ]
    lines.append("END_CASE;")
    inputs = PlcSection("VAR_INPUT", (PlcVariable("Alarm", "INT"),))
    meaning = "reaction to an alarm: 0 none, 1 suspend, 2 hold, 3 stop, 4 abort"
    return PlcUnit("FUNCTION", "ReactionOf", meaning, (inputs,), "\n".join(lines), "INT")


def _program(size: PlcSize) -> PlcUnit:
    sections = (
        PlcSection("VAR_INPUT", program_inputs(size.heads)),
        PlcSection("VAR_OUTPUT", program_outputs(size.heads)),
        PlcSection("VAR RETAIN", retained_variables(size.heads)),
        PlcSection("VAR", inner_variables(size.heads)),
    )
    body = "\n".join(
        (_reports(size), _next_row(size), _alarms(size), _uncertain(size), _state(size), _knots(size) + _row_ends())
    )
    return PlcUnit("PROGRAM", "Loom", "the loom: states, interlocks, alarms, the sequence of the rows", sections, body)


def _raise(number: str, levels: int = 0) -> str:
    """Raise an alarm unless a graver one is active; the number is an expression."""
    space = INDENT * levels
    return (
        f"{space}Found := {number};\n{space}IF ReactionOf(Found) > ReactionOf(Alarm) OR Alarm = 0 THEN\n"
        f"{space}{INDENT}Alarm := Found;\n{space}END_IF;"
    )


def _reports(size: PlcSize) -> str:
    """What the loom reports: an operation is in the carpet, or has failed and nothing of it is."""
    missed = ALARMS[Fault.MISSED_GRIP].number
    return f"""\
(* reports of the loom *)
StepDone := FALSE;
FOR Head := 0 TO {size.heads - 1} DO
    IF TieStart[Head] AND TieDone[Head] THEN
        Tied[Head] := Tied[Head] + 1;
        TieBusy[Head] := FALSE;
        TieStart[Head] := FALSE;
        Retried[Head] := FALSE;
        StepDone := StepDone OR StepKnot;
    ELSIF TieStart[Head] AND TieFault[Head] > 0 THEN
        TieBusy[Head] := FALSE;
        TieStart[Head] := FALSE;
        IF TieFault[Head] = {missed} AND NOT Retried[Head] THEN
            Retried[Head] := TRUE;
        ELSE
            Retried[Head] := FALSE;
{_raise("TieFault[Head]", 3)}
        END_IF;
    END_IF;
END_FOR;
IF EndStart AND EndDone THEN
    EndBusy := FALSE;
    EndStart := FALSE;
    EndsDone := EndsDone + 1;
ELSIF EndStart AND EndFault > 0 THEN
    EndBusy := FALSE;
    EndStart := FALSE;
{_raise("EndFault", 1)}
END_IF;
IF ChangeStart AND ChangeDone THEN
    ChangeStart := FALSE;
    StopsDone := Phase + 1;
END_IF;
"""


def _next_row(size: PlcSize) -> str:
    """The row is woven: to the next one. The knots in the carpet."""
    return f"""\
IF EndsDone = {len(ROW_ENDS)} THEN
    Row := Row + 1;
    Phase := 0;
    StopsDone := 0;
    EndsDone := 0;
    FOR Head := 0 TO {size.heads - 1} DO
        Tied[Head] := 0;
    END_FOR;
    StepDone := TRUE;
END_IF;
CarpetDone := Row >= {size.rows};
KnotsDone := Row * {size.columns};
FOR Head := 0 TO {size.heads - 1} DO
    KnotsDone := KnotsDone + INT_TO_DINT(Tied[Head]);
END_FOR;
"""


def _alarms(size: PlcSize) -> str:
    """Sensors against the interlocks: motions in progress are ended by the guards; suspensions end by themselves."""
    sensors = ", ".join(f"{name} := {name}" for name in (*SENSOR_NAMES.values(), TENSION_KNOWN))
    guards = [f"(NOT Rules.Guard{KNOT} AND Busy)"]
    lines = [
        f"    {number}: IF EndStart AND NOT Rules.Guard{name} THEN Found := Rules.Blocked{name}; END_IF;"
        for number, name in enumerate(capitalised(end.name) for end in ROW_ENDS)
    ]
    return f"""\
(* interlocks and alarms *)
Rules({sensors});
Busy := FALSE;
FOR Head := 0 TO {size.heads - 1} DO
    Busy := Busy OR TieStart[Head];
END_FOR;
IF Acknowledge OR ReactionOf(Alarm) = {REACTIONS[Reaction.SUSPEND]} THEN
    Alarm := 0;
END_IF;
Found := 0;
IF {" OR ".join(guards)} THEN
    Found := Rules.Blocked{KNOT};
END_IF;
CASE EndCode OF
{chr(10).join(lines)}
END_CASE;
IF Found > 0 THEN
    IF ReactionOf(Found) > ReactionOf(Alarm) OR Alarm = 0 THEN
        Alarm := Found;
    END_IF;
END_IF;
"""


def _uncertain(size: PlcSize) -> str:
    """Operations that were in progress at a power failure or a halt, resolved before weaving goes on."""
    return f"""\
(* uncertain operations *)
Waiting := FALSE;
FOR Head := 0 TO {size.heads - 1} DO
    AskTie[Head] := TieBusy[Head] AND NOT TieStart[Head] AND StateCurrent = {int(PackState.RESETTING)};
    IF AskTie[Head] THEN
        IF TieAnswer[Head] = {IN_CARPET} THEN
            Tied[Head] := Tied[Head] + 1;
        END_IF;
        IF TieAnswer[Head] > {NO_ANSWER} THEN
            TieBusy[Head] := FALSE;
            AskTie[Head] := FALSE;
        END_IF;
        Waiting := Waiting OR AskTie[Head];
    END_IF;
END_FOR;
AskEnd := EndBusy AND NOT EndStart AND StateCurrent = {int(PackState.RESETTING)};
IF AskEnd THEN
    IF EndAnswer = {IN_CARPET} THEN
        EndsDone := EndsDone + 1;
    END_IF;
    IF EndAnswer > {NO_ANSWER} THEN
        EndBusy := FALSE;
        AskEnd := FALSE;
    END_IF;
    Waiting := Waiting OR AskEnd;
END_IF;
"""


def _state(size: PlcSize) -> str:
    """The state model: acting states end when nothing is in progress any more; Execute when the carpet or step is."""
    ending = ", ".join(
        str(int(one)) for one in (PackState.STOPPING, PackState.HOLDING, PackState.SUSPENDING, PackState.COMPLETING)
    )
    return f"""\
(* states *)
Busy := EndStart OR ChangeStart;
FOR Head := 0 TO {size.heads - 1} DO
    Busy := Busy OR TieStart[Head];
END_FOR;
CASE StateCurrent OF
    {int(PackState.EXECUTE)}: Complete := CarpetDone OR (StepDone AND UnitModeCurrent = {int(PackMode.MAINTENANCE)});
    {ending}: Complete := ChangeStart OR NOT Busy;
    {int(PackState.RESETTING)}: Complete := NOT Waiting;
ELSE
    Complete := TRUE;
END_CASE;
Model(CntrlCmd := CntrlCmd, CmdChangeRequest := CmdChangeRequest, UnitMode := UnitMode,
    UnitModeChangeRequest := UnitModeChangeRequest, StateComplete := Complete, AlarmReaction := ReactionOf(Alarm),
    StateCurrent => StateCurrent, UnitModeCurrent => UnitModeCurrent, Refused => Refused);
Halt := StateCurrent = {int(PackState.ABORTING)} OR StateCurrent = {int(PackState.ABORTED)};
IF Halt THEN
    FOR Head := 0 TO {size.heads - 1} DO
        TieStart[Head] := FALSE;
    END_FOR;
    EndStart := FALSE;
END_IF;
IF StateCurrent <> {int(PackState.EXECUTE)} THEN
    ChangeStart := FALSE;
END_IF;
JogStart := FALSE;
IF UnitModeCurrent = {int(PackMode.MANUAL)} AND StateCurrent = {int(PackState.EXECUTE)} THEN
    CASE JogAxis OF
{_jogs()}
    END_CASE;
    RETURN;
END_IF;
"""


def _jogs() -> str:
    return "\n".join(
        f"        {number}: JogStart := Rules.PermitJog{capitalised(axis.value)}; (* {axis.value} *)"
        for number, axis in enumerate(LoomAxis, 1)
    )


def _knots(size: PlcSize) -> str:
    """What begins in state Execute while a phase is in work: a stop, or the next knot of each head."""
    return f"""\
(* weaving *)
RowRequest := Row;
IF StateCurrent <> {int(PackState.EXECUTE)} OR CarpetDone OR RowData.Number <> Row THEN
    RETURN;
END_IF;
Busy := EndStart;
FOR Head := 0 TO {size.heads - 1} DO
    Busy := Busy OR TieStart[Head];
END_FOR;
(* to the next phase, when every head has tied its knots *)
WHILE Phase < {size.phases} DO
    Waiting := RowData.StopBefore[Phase] AND StopsDone <= Phase;
    FOR Head := 0 TO {size.heads - 1} DO
        Waiting := Waiting OR Tied[Head] < RowData.Limits[Head * {size.phases} + Phase];
    END_FOR;
    IF Waiting THEN
        EXIT;
    END_IF;
    Phase := Phase + 1;
END_WHILE;
IF Phase < {size.phases} THEN
    IF RowData.StopBefore[Phase] AND StopsDone <= Phase THEN
        ChangeStart := TRUE;
        RETURN;
    END_IF;
    FOR Head := 0 TO {size.heads - 1} DO
        IF NOT TieStart[Head] AND NOT TieBusy[Head] AND Tied[Head] < RowData.Limits[Head * {size.phases} + Phase] THEN
            IF Rules.Permit{KNOT}[Head] THEN
                Index := RowData.First[Head] + Tied[Head];
                TieColumn[Head] := RowData.Columns[Index];
                TieTube[Head] := RowData.Tubes[Index];
                TieBusy[Head] := TRUE;
                TieStart[Head] := TRUE;
            ELSE
{_raise(f"Rules.Blocked{KNOT}", 4)}
            END_IF;
        END_IF;
    END_FOR;
"""


def _row_ends() -> str:
    """What begins behind the last phase: the operations after the knots, when their sensors permit."""
    permits = "\n".join(
        f"        {int(one)}: MayBegin := Rules.Permit{name}; Found := Rules.Blocked{name};"
        for one, name in ((end, capitalised(end.name)) for end in ROW_ENDS)
    )
    assert set(OPERATIONS) >= {capitalised(end.name) for end in ROW_ENDS}
    return f"""\
ELSIF NOT Busy AND NOT EndBusy THEN
    MayBegin := FALSE;
    Found := 0;
    CASE EndsDone OF
{permits}
    END_CASE;
    IF MayBegin THEN
        EndCode := EndsDone;
        EndBusy := TRUE;
        EndStart := TRUE;
        Waited := 0;
    ELSE
        Waited := Waited + 1;
        IF Waited > {PATIENCE} THEN
            Waited := 0;
{_raise("Found", 3)}
        END_IF;
    END_IF;
END_IF;
"""
