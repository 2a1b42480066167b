"""Homing in structured text, from the controller's table: an operation of the loom for each axis, in state Resetting.

The numbers of these operations follow those of the operations after the knots; the protocol is the same.
"""

from ilmek.io.plc.alarm_logic import raised
from ilmek.io.plc.interlock_logic import SENSOR_NAMES, capitalised
from ilmek.io.plc.units import cases, indented, loop
from ilmek.loom.control.alarms import ControlFault
from ilmek.loom.control.homing import HOMED
from ilmek.loom.control.interlocks import LoomAxis
from ilmek.loom.control.packml import PackMode, PackState

FIRST_HOME = 10
"""Number of the operation that homes the first axis."""

HOME_CODES = {axis: FIRST_HOME + number for number, axis in enumerate(LoomAxis)}
"""Number of the operation that homes each axis, in the order of the axes."""


def home_guards() -> tuple[tuple[int, str], ...]:
    """For each operation of homing what ends it: the interlocks of its axis."""
    names = ((code, f"Jog{capitalised(axis.value)}") for axis, code in HOME_CODES.items())
    return tuple(
        (code, f"IF NOT Rules.Guard{name} THEN\n    {raised(f'Rules.Blocked{name}')}\nEND_IF;") for code, name in names
    )


def homed(heads: int) -> str:
    """A drive has homed its axis: true if the axis is at its switch, by the inputs of the same scan."""
    grippers = loop("Head", heads, "Plausible := Plausible AND GrippersOpen[Head];")
    switches = (
        (HOME_CODES[axis], grippers if axis is LoomAxis.GRIPPERS else f"Plausible := {SENSOR_NAMES[switch]};")
        for axis, switch in HOMED.items()
        if switch
    )
    return f"""\
Plausible := TRUE;
{cases("EndCode", switches)}
Home[EndCode - {FIRST_HOME}] := Plausible;"""


def homing(loom: int) -> str:
    """In state Resetting, before the questions: the next axis. loom: number of the station that carries it out."""
    choices = []
    for axis in reversed(tuple(HOMED)):
        code, name = HOME_CODES[axis], capitalised(axis.value)
        others, again = ("", " OR NOT Rules.AllOpen") if axis is LoomAxis.GRIPPERS else ("Rules.AllOpen AND ", "")
        choices.append(f"""\
IF NOT Home[{code - FIRST_HOME}] THEN
    AllHome := FALSE;
END_IF;
IF (NOT Home[{code - FIRST_HOME}]{again}) AND {others}Rules.PermitJog{name} THEN
    Axis := {code};
END_IF;""")
    body = f"""\
IF NOT Order[{loom}] AND NOT Settling[{loom}] THEN
    IF Axis > 0 THEN
        EndCode := Axis;
        Order[{loom}] := TRUE;
        Accepted[{loom}] := FALSE;
    ELSE
        {raised(ControlFault.NOT_HOME)}
    END_IF;
END_IF;"""
    return f"""\
(* homing *)
Axis := 0;
AllHome := TRUE;
{chr(10).join(choices)}
Homing := NOT AllHome AND UnitModeCurrent <> {int(PackMode.MANUAL)};
IF Homing AND StateCurrent = {int(PackState.RESETTING)} THEN
{indented(body)}
END_IF;
"""
