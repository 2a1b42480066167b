"""Orders to the stations and their reports, in structured text.

    order rises -> status 1: accepted -> done, or a fault's alarm as status -> order falls -> done and status fall

An order begins only when the signals of the one before have fallen. A report that comes before the order is accepted,
or before the operation can be over, and one without an order, is unexpected. After any of these, a fault or a time-out
the operation stays `Busy`: it may be in the carpet, and before weaving goes on sensor or operator are asked. Only the
first missed grip is taken at its word: the knot is tried again.
"""

from ilmek.io.plc.alarm_logic import raised
from ilmek.io.plc.homing_logic import FIRST_HOME, homed
from ilmek.io.plc.interlock_logic import SENSOR_NAMES
from ilmek.io.plc.sequence_variables import ACCEPTED, PlcSize, watch_name
from ilmek.io.plc.units import cases, indented, loop
from ilmek.loom.control.alarms import ALARMS, ControlFault
from ilmek.loom.control.core import ASKING
from ilmek.loom.control.interlocks import ROW_END_AXES, WATCHED
from ilmek.loom.control.ports import Fault
from ilmek.loom.operations import ROW_ENDS, RowEnd

ACCEPT_SCANS, SETTLE_SCANS = 100, 200
"""Scans in which an order is accepted, and in which the signals of the last order fall: 1 s and 2 s."""

NOT_IN_CARPET, IN_CARPET = 1, 2
"""Answers."""

_FAULTS = sorted(ALARMS[fault].number for fault in Fault)


def reports(size: PlcSize) -> str:
    """What the stations report."""
    most = cases("Now.EndsDone", ((end, _limits(size, end)) for end in ROW_ENDS))
    return f"""\
(* reports of the stations *)
StepDone := FALSE;
{loop("Head", size.heads, "Done[Head] := TieDone[Head];" + chr(10) + "Status[Head] := TieStatus[Head];")}
Done[{size.heads}] := EndDone;
Status[{size.heads}] := EndStatus;
{_watching()}
FOR Station := 0 TO {size.heads} DO
    Least := {size.knot.least};
    Most := {size.knot.most};
    IF Station = {size.heads} THEN
{indented(indented(most))}
    END_IF;
    IF Station = {size.heads} AND EndCode >= {FIRST_HOME} THEN
        Least := {size.home.least};
        Most := {size.home.most};
    END_IF;
    IF Station < {size.heads} THEN
        IF TieAside[Station] THEN
            Least := 0;
        END_IF;
    END_IF;
    Fault := 0;
    IF Order[Station] THEN
{indented(indented(_report(size)))}
    ELSIF NOT Done[Station] AND Status[Station] = 0 THEN
        Settling[Station] := FALSE;
        Elapsed[Station] := 0;
    ELSIF NOT Settling[Station] THEN
        Settling[Station] := TRUE;
        Fault := {ALARMS[ControlFault.UNEXPECTED].number};
    ELSIF Elapsed[Station] < {SETTLE_SCANS} THEN
        Elapsed[Station] := Elapsed[Station] + 1;
    ELSE
        Fault := {ALARMS[ControlFault.STUCK].number};
    END_IF;
    {raised("Fault")}
END_FOR;
IF ChangeStart AND ChangeDone AND NOT ChangeSeen THEN
    ChangeStart := FALSE;
    Now.StopsDone := Now.Phase + 1;
    Now.StopRow := Now.Row;
    IF Now.Phase > 0 THEN
        Now.StopRow := Now.Row + 1;
    END_IF;
END_IF;
ChangeSeen := ChangeDone;
"""


def _limits(size: PlcSize, end: RowEnd) -> str:
    return f"Least := {size.row_ends[end].least};\nMost := {size.row_ends[end].most};"


def _watching() -> str:
    lines = (f"{watch_name(sensor)} := {watch_name(sensor)} AND {SENSOR_NAMES[sensor]};" for sensor in WATCHED.values())
    return "\n".join(lines)


def watch_begins() -> str:
    """At the beginning of an operation after the knots: the sensors that must change in it."""
    lines = []
    for axis, sensor in WATCHED.items():
        moving = " OR ".join(f"EndCode = {int(end)}" for end in ROW_ENDS if axis in ROW_END_AXES[end])
        lines.append(f"{watch_name(sensor)} := {moving};")
    return "\n".join(lines)


def _report(size: PlcSize) -> str:
    """The report of a station that has an order."""
    watched = " OR ".join(watch_name(sensor) for sensor in WATCHED.values())
    return f"""\
Elapsed[Station] := Elapsed[Station] + 1;
Accepted[Station] := Accepted[Station] OR Status[Station] = {ACCEPTED};
IF Status[Station] >= {_FAULTS[0]} AND Status[Station] <= {_FAULTS[-1]} THEN
    Fault := Status[Station];
ELSIF Status[Station] <> 0 AND Status[Station] <> {ACCEPTED} THEN
    Fault := {ALARMS[ControlFault.UNEXPECTED].number};
ELSIF Done[Station] AND Accepted[Station] AND Elapsed[Station] >= Least THEN
    Order[Station] := FALSE;
    IF Station = {size.heads} AND EndCode >= {FIRST_HOME} THEN
{indented(indented(homed(size.heads)))}
        IF NOT Plausible THEN
            Fault := {ALARMS[ControlFault.NOT_HOME].number};
        END_IF;
    ELSE
        Now.Busy[Station] := FALSE;
{indented(indented(_counted(size)))}
    END_IF;
    IF Station < {size.heads} THEN
        Retried[Station] := FALSE;
        StepDone := StepDone OR (StepKnot AND NOT TieAside[Station]);
    ELSIF {watched} THEN
        Fault := {ALARMS[ControlFault.STUCK].number};
    END_IF;
ELSIF Done[Station] THEN
    Fault := {ALARMS[ControlFault.UNEXPECTED].number};
ELSIF Elapsed[Station] > Most OR (Elapsed[Station] > {ACCEPT_SCANS} AND NOT Accepted[Station]) THEN
    Fault := {ALARMS[Fault.TIMEOUT].number};
END_IF;
{_fault(size)}
IF NOT Order[Station] THEN
    Settling[Station] := TRUE;
    Elapsed[Station] := 0;
END_IF;
"""


def _fault(size: PlcSize) -> str:
    """An order that has failed falls; a first missed grip is tried again, any fault of homing is one alarm."""
    return f"""\
IF Fault > 0 THEN
    Order[Station] := FALSE;
    IF Station = {size.heads} AND EndCode >= {FIRST_HOME} THEN
        Fault := {ALARMS[ControlFault.NOT_HOME].number};
    END_IF;
    IF Station < {size.heads} THEN
        IF Fault = {ALARMS[Fault.MISSED_GRIP].number} AND NOT Retried[Station] THEN
            Retried[Station] := TRUE;
            Now.Busy[Station] := FALSE;
            Fault := 0;
        ELSE
            Retried[Station] := FALSE;
        END_IF;
    END_IF;
END_IF;"""


def _counted(size: PlcSize) -> str:
    """The operation of a station is in the carpet, or its head stands aside."""
    return f"""\
IF Station < {size.heads} THEN
    IF TieAside[Station] THEN
        Stood[Station] := TRUE;
    ELSE
        Now.Tied[Station] := Now.Tied[Station] + 1;
        Now.Knots := Now.Knots + 1;
    END_IF;
ELSE
    Now.EndsDone := Now.EndsDone + 1;
END_IF;"""


def questions(size: PlcSize) -> str:
    """Operations that may be in the carpet, resolved before weaving goes on; an answer counts when it was 0 before."""
    asking = " OR ".join(f"StateCurrent = {int(state)}" for state in sorted(ASKING))
    return f"""\
(* uncertain operations *)
Waiting := Homing;
Asking := ({asking}) AND NOT Homing AND NOT Order[{size.heads}];
{loop("Head", size.heads, "Answer[Head] := TieAnswer[Head];")}
Answer[{size.heads}] := EndAnswer;
FOR Station := 0 TO {size.heads} DO
    IF Asking AND Now.Busy[Station] AND NOT Order[Station] THEN
        Released[Station] := (Released[Station] AND Asked[Station]) OR Answer[Station] = 0;
        Asked[Station] := TRUE;
        IF Released[Station] AND Answer[Station] >= {NOT_IN_CARPET} AND Answer[Station] <= {IN_CARPET} THEN
            Now.Busy[Station] := FALSE;
            Asked[Station] := FALSE;
            IF Answer[Station] = {IN_CARPET} THEN
{indented(indented(indented(indented(_counted(size)))))}
            END_IF;
        END_IF;
        Waiting := Waiting OR Asked[Station];
    ELSE
        Asked[Station] := FALSE;
    END_IF;
END_FOR;
{loop("Head", size.heads, "AskTie[Head] := Asked[Head];")}
AskEnd := Asked[{size.heads}];
IF AskEnd THEN
    EndCode := Now.EndsDone;
END_IF;
"""
