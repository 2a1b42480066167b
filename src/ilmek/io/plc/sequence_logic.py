"""The loom's block in structured text: reports, carpet, interlocks, questions, states, and what begins next.

The host gives one row at a time in `RowData`; the block weaves it: its phases with their stops, then the operations
after the knots. An operation is `Busy` from the scan of its order until it is certain whether it is in the carpet.
"""

from ilmek.io.plc.alarm_logic import alarm_units, raised
from ilmek.io.plc.carpet_logic import (
    crc_unit,
    giving_up,
    heartbeat,
    next_row,
    recipe_check,
    row_check,
    rows_back,
    saving,
    waking,
)
from ilmek.io.plc.homing_logic import home_guards, homing
from ilmek.io.plc.interlock_logic import KNOT, SENSOR_NAMES, TENSION_KNOWN, capitalised
from ilmek.io.plc.order_logic import questions, reports, watch_begins
from ilmek.io.plc.sequence_variables import (
    PlcSize,
    block_inputs,
    block_outputs,
    inner_variables,
    retained_variables,
)
from ilmek.io.plc.state_model import REACTIONS
from ilmek.io.plc.units import PlcSection, PlcUnit, cases, indented, loop
from ilmek.loom.control.alarms import ControlFault, JournalFault
from ilmek.loom.control.core import ASKING, ENDING
from ilmek.loom.control.interlocks import LoomAxis, Reaction
from ilmek.loom.control.packml import PackMode, PackState
from ilmek.loom.operations import ROW_ENDS

BLOCK = "Loom"
"""Name of the loom's block."""

PATIENCE = 200
"""Scans for which an operation after the knots waits for its sensors, 2 s: the heads retreat, the shed closes."""

EMERGENCY = "emergency stop"


def sequence_units(size: PlcSize) -> tuple[PlcUnit, ...]:
    """The functions of the alarms and of the check sum, and the loom's block."""
    sections = (
        PlcSection("VAR_INPUT", block_inputs(size)),
        PlcSection("VAR_OUTPUT", block_outputs(size)),
        PlcSection("VAR RETAIN", retained_variables()),
        PlcSection("VAR", inner_variables(size)),
    )
    parts = (
        waking(size),
        heartbeat(),
        reports(size),
        giving_up(size),
        rows_back(size),
        next_row(size),
        _alarms(size),
        homing(size.heads),
        questions(size),
        recipe_check(size),
        _state(size),
        row_check(size),
        _weaving(size),
        loop("Head", size.heads, "TieStart[Head] := Order[Head];\nTieColumn[Head] := Now.Column[Head];"),
        f"EndStart := Order[{size.heads}];",
        saving(),
    )
    meaning = "the loom: states, interlocks, alarms, the sequence of the rows"
    return *alarm_units(), crc_unit(), PlcUnit("FUNCTION_BLOCK", BLOCK, meaning, sections, "\n".join(parts))


def _any_order(stations: int) -> str:
    return f"Busy := FALSE;\n{loop('Station', stations, 'Busy := Busy OR Order[Station];')}"


def _alarms(size: PlcSize) -> str:
    """Sensors against the interlocks: motions in progress are ended by the guards; suspensions end by themselves."""
    sensors = ", ".join(f"{name} := {name}" for name in (*SENSOR_NAMES.values(), TENSION_KNOWN))
    guards = (
        (int(end), f"IF NOT Rules.Guard{name} THEN\n    {raised(f'Rules.Blocked{name}')}\nEND_IF;")
        for end, name in ((end, capitalised(end.name)) for end in ROW_ENDS)
    )
    return f"""\
(* interlocks and alarms *)
Rules({sensors});
IF (Acknowledge AND NOT AcknowledgeSeen)
    OR (ReactionOf(Alarm := Now.Alarm) = {REACTIONS[Reaction.SUSPEND]} AND NOT Rules.Slack) THEN
    Now.Alarm := 0;
END_IF;
AcknowledgeSeen := Acknowledge;
IF {SENSOR_NAMES["emergency_stop"]} THEN
    {raised(EMERGENCY)}
END_IF;
IF Rules.Contradiction THEN
    {raised(ControlFault.CONTRADICTION)}
END_IF;
{_any_order(size.heads)}
IF Busy AND NOT Rules.Guard{KNOT} THEN
    {raised(f"Rules.Blocked{KNOT}")}
END_IF;
IF Order[{size.heads}] THEN
{indented(cases("EndCode", (*guards, *home_guards())))}
END_IF;
"""


def _state(size: PlcSize) -> str:
    """The state model: acting states end when nothing is in progress any more; Execute when the carpet or step is."""
    ended = f"CarpetDone OR (StepDone AND UnitModeCurrent = {int(PackMode.MAINTENANCE)})"
    completions = {
        PackState.EXECUTE: f"Complete := UnitModeCurrent <> {int(PackMode.MANUAL)} AND NOT Busy AND ({ended});",
        **dict.fromkeys(sorted(ENDING), "Complete := NOT Busy;"),
        **dict.fromkeys(sorted(ASKING), f"Complete := NOT Waiting AND NOT Order[{size.heads}];"),
    }
    jogs = (
        (number, f"JogStart := Rules.PermitJog{capitalised(axis.value)}; (* {axis.value} *)")
        for number, axis in enumerate(LoomAxis, 1)
    )
    return f"""\
(* states *)
{_any_order(size.stations)}
IF StateCurrent = {int(PackState.EXECUTE)} THEN
    ByAlarm := ReactionOf(Alarm := Now.Alarm) = {REACTIONS[Reaction.SUSPEND]};
END_IF;
{cases("StateCurrent", ((int(state), line) for state, line in completions.items()), "Complete := TRUE;")}
Model(CntrlCmd := CntrlCmd, CmdChangeRequest := CmdChangeRequest, UnitMode := UnitMode,
    UnitModeChangeRequest := UnitModeChangeRequest, StateComplete := Complete,
    AlarmReaction := ReactionOf(Alarm := Now.Alarm),
    Forbidden := Homing OR (Now.Alarm > 0 AND UnitModeCurrent <> {int(PackMode.MANUAL)}),
    Resume := ByAlarm AND Now.Alarm = 0 AND StateCurrent = {int(PackState.SUSPENDED)},
    StateCurrent => StateCurrent, UnitModeCurrent => UnitModeCurrent, Refused => Refused);
Halt := StateCurrent = {int(PackState.ABORTING)} OR StateCurrent = {int(PackState.ABORTED)};
IF Halt THEN
{indented(loop("Station", size.stations, _withdrawn()))}
END_IF;
IF StateCurrent = {int(PackState.COMPLETE)} AND CarpetDone THEN
    Now.Begun := FALSE;
END_IF;
IF StateCurrent <> {int(PackState.EXECUTE)} THEN
    ChangeStart := FALSE;
{indented(loop("Head", size.heads, "Stood[Head] := FALSE;"))}
END_IF;
JogStart := FALSE;
IF UnitModeCurrent = {int(PackMode.MANUAL)} AND StateCurrent = {int(PackState.EXECUTE)} THEN
{indented(cases("JogAxis", jogs))}
END_IF;
"""


def _withdrawn() -> str:
    return "Settling[Station] := Settling[Station] OR Order[Station];\nOrder[Station] := FALSE;"


def _weaving(size: PlcSize) -> str:
    """What begins in state Execute: a stop, the next knot of each head, or an operation after the knots."""
    return f"""\
(* weaving *)
IF StateCurrent = {int(PackState.EXECUTE)} AND UnitModeCurrent <> {int(PackMode.MANUAL)} AND RowReady THEN
    IF Now.Phase >= Work.Phases THEN
{indented(indented(_row_ends(size)))}
    ELSIF Work.StopBefore[Now.Phase] AND Now.StopsDone <= Now.Phase THEN
        ChangeStart := TRUE;
    ELSE
        Waiting := FALSE;
{indented(indented(loop("Head", size.heads, _knot(size))))}
        IF NOT Waiting THEN
            Now.Phase := Now.Phase + 1;
{indented(indented(indented(loop("Head", size.heads, "Stood[Head] := FALSE;"))))}
        END_IF;
    END_IF;
END_IF;
"""


def _knot(size: PlcSize) -> str:
    """The next knot of a head, or its move aside; the phase ends when the signals of all heads have fallen.

    So the heads set off together into the next one, which keeps them apart on the way.
    """
    return f"""\
MayBegin := Now.Tied[Head] < Work.Limits[Head * {size.phases} + Now.Phase];
Index := Work.Aside[Head * {size.phases} + Now.Phase];
Waiting := Waiting OR MayBegin OR Order[Head] OR Settling[Head] OR (Index >= 0 AND NOT Stood[Head]);
IF MayBegin OR (Index >= 0 AND NOT Stood[Head]) THEN
    IF NOT Order[Head] AND NOT Now.Busy[Head] AND NOT Settling[Head] THEN
        IF Rules.Permit{KNOT}[Head] THEN
            TieAside[Head] := NOT MayBegin;
            Now.Column[Head] := Index;
            IF MayBegin THEN
                Index := Work.First[Head] + Now.Tied[Head];
                Now.Column[Head] := Work.Columns[Index];
                TieTube[Head] := Work.Tubes[Index];
                Now.Busy[Head] := TRUE;
            END_IF;
            Order[Head] := TRUE;
            Accepted[Head] := FALSE;
        ELSE
            {raised(f"Rules.Blocked{KNOT}")}
        END_IF;
    END_IF;
END_IF;
"""


def _row_ends(size: PlcSize) -> str:
    """Before the first operation the knots are counted: the row has all of its own."""
    loom = size.heads
    permits = (
        (int(end), f"MayBegin := Rules.Permit{name};\nFault := Rules.Blocked{name};")
        for end, name in ((end, capitalised(end.name)) for end in ROW_ENDS)
    )
    return f"""\
IF Now.Knots <> Now.Before + INT_TO_DINT(Work.Knots) THEN
    {raised(JournalFault.DAMAGED)}
ELSIF NOT Now.Busy[{loom}] AND NOT Settling[{loom}] AND Now.EndsDone < {len(ROW_ENDS)} THEN
    MayBegin := FALSE;
    Fault := 0;
{indented(cases("Now.EndsDone", permits))}
    IF MayBegin THEN
        EndCode := Now.EndsDone;
        Now.Busy[{loom}] := TRUE;
        Order[{loom}] := TRUE;
        Accepted[{loom}] := FALSE;
        Waited := 0;
{indented(indented(watch_begins()))}
    ELSE
        Waited := Waited + 1;
        IF Waited > {PATIENCE} THEN
            Waited := 0;
            {raised("Fault")}
        END_IF;
    END_IF;
END_IF;
"""
