"""Blocks that move an axis, in structured text: power, home, move, cam in, stop, reset; and an axis without a drive.

They behave as the blocks of PLCopen, Function blocks for motion control, part 1, version 2.0, of similar names, as far
as the loom needs it: an order begins at the rising edge of `Execute` and ends as `Done` or `Error`. Where a target has
a library of motion blocks, its axis and blocks take the place of these. Positions are in m or rad.

An axis ends an order with one of ERRORS, and then has no power until it is reset. Its actual position follows the one
that is commanded; where the drive is simulated, by FOLLOWS of the difference in each scan.
"""

from enum import IntEnum

from ilmek.io.plc.units import PlcSection, PlcStructure, PlcUnit, PlcVariable, indented

AXIS = "McAxis"
"""Name of the structure of an axis."""

FOLLOWS = 0.8
"""Share of its distance that a simulated axis goes in a scan."""


class AxisError(IntEnum):
    """Why an axis has no power."""

    FOLLOWING = 1
    LIMIT = 2
    DRIVE = 3


def axis_structure() -> PlcStructure:
    """An axis: positions, limits, state."""
    return PlcStructure(
        AXIS,
        (
            PlcVariable("Commanded", "REAL", "position that the drive is to have"),
            PlcVariable("Actual", "REAL", "position that its encoder shows"),
            PlcVariable("Rate", "REAL", "change of the commanded position in the last scan"),
            PlcVariable("Low", "REAL", "least position"),
            PlcVariable("High", "REAL", "greatest position"),
            PlcVariable("MostLag", "REAL", "largest following error"),
            PlcVariable("Powered", "BOOL"),
            PlcVariable("Homed", "BOOL"),
            PlcVariable("Switch", "BOOL", "the axis is at its switch, position 0"),
            PlcVariable("DriveFault", "BOOL", "the drive reports a fault"),
            PlcVariable("ErrorID", "INT", "; ".join(f"{int(one)} {one.name.lower()}" for one in AxisError)),
        ),
    )


def motion_units(cycle: float) -> tuple[PlcUnit, ...]:
    """The function blocks for the cycle of a task [s]."""
    execute = (PlcVariable("Execute", "BOOL", "rising edge: begin"),)
    goal = (PlcVariable("Position", "REAL"), PlcVariable("Velocity", "REAL", "positive, of a second"))
    acceleration = PlcVariable("Acceleration", "REAL", "positive, of a second squared")
    return (
        _block("McPower", "checks an axis and gives it power", (PlcVariable("Enable", "BOOL"),), _POWER),
        _block("McReset", "takes the error of an axis away", execute, _RESET),
        _block("McHome", "moves an axis to its switch", (*execute, goal[1]), _started(_HOME.format(cycle=cycle))),
        _block("McMoveAbsolute", "moves an axis to a position", (*execute, *goal, acceleration),
               _started(_MOVE.format(cycle=cycle)), ("Rest", "Speed")),
        _block("McCamIn", "has an axis follow a cam while Execute is true", (*execute, goal[0]), _CAM),
        _block("McStop", "brings an axis to a stop", (*execute, acceleration), _started(_STOP.format(cycle=cycle)),
               ("Most",)),
        _block("SimulatedAxis", "the drive of an axis that has none", (), _SIMULATED, ("Moved", "Where")),
    )  # fmt: skip


def _block(name: str, meaning: str, inputs: tuple[PlcVariable, ...], body: str, reals: tuple[str, ...] = ()) -> PlcUnit:
    sections = [PlcSection("VAR_IN_OUT", (PlcVariable("Axis", AXIS),))]
    if inputs:
        sections.append(PlcSection("VAR_INPUT", inputs))
        sections.append(
            PlcSection("VAR_OUTPUT", tuple(PlcVariable(flag, "BOOL") for flag in ("Done", "Busy", "Error")))
        )
    inner = (PlcVariable("Before", "BOOL"), *(PlcVariable(real, "REAL") for real in reals))
    return PlcUnit("FUNCTION_BLOCK", name, meaning, (*sections, PlcSection("VAR", inner)), body)


def _started(work: str) -> str:
    """A body that works from the rising edge of Execute until it is done, and ends where the axis has no power."""
    return f"""\
Busy := Execute AND (Busy OR NOT Before);
Done := Done AND Execute;
Error := Error AND Execute;
IF NOT Before THEN
    Done := FALSE;
    Error := FALSE;
END_IF;
Before := Execute;
IF Busy AND NOT Axis.Powered THEN
    Busy := FALSE;
    Error := TRUE;
ELSIF Busy THEN
{indented(work)}
END_IF;
"""


_POWER = f"""\
IF Axis.ErrorID = 0 AND Axis.DriveFault THEN
    Axis.ErrorID := {AxisError.DRIVE:d};
ELSIF Axis.ErrorID = 0 AND Axis.Powered AND ABS(Axis.Commanded - Axis.Actual) > Axis.MostLag THEN
    Axis.ErrorID := {AxisError.FOLLOWING:d};
ELSIF Axis.ErrorID = 0 AND Axis.Homed AND (Axis.Commanded < Axis.Low OR Axis.Commanded > Axis.High) THEN
    Axis.ErrorID := {AxisError.LIMIT:d};
END_IF;
Axis.Powered := Enable AND Axis.ErrorID = 0;
IF NOT Axis.Powered THEN
    Axis.Commanded := Axis.Actual;
    Axis.Rate := 0.0;
END_IF;
Done := Axis.Powered;
Busy := Enable;
Error := Axis.ErrorID <> 0;
"""

_RESET = """\
IF Execute AND NOT Before AND NOT Axis.DriveFault THEN
    Axis.ErrorID := 0;
END_IF;
Before := Execute;
Done := Execute AND Axis.ErrorID = 0;
"""

_HOME = """\
IF Axis.Switch THEN
    Axis.Commanded := 0.0;
    Axis.Actual := 0.0;
    Axis.Homed := TRUE;
    Busy := FALSE;
    Done := TRUE;
ELSE
    Axis.Homed := FALSE;
    Axis.Rate := -Velocity * {cycle};
    Axis.Commanded := Axis.Commanded + Axis.Rate;
END_IF;"""

_MOVE = """\
Rest := Position - Axis.Commanded;
Speed := MIN(MIN(ABS(Axis.Rate) / {cycle} + Acceleration * {cycle}, Velocity), SQRT(2.0 * Acceleration * ABS(Rest)));
IF Speed * {cycle} >= ABS(Rest) OR ABS(Rest) < 0.000001 THEN
    Axis.Rate := 0.0;
    Axis.Commanded := Position;
    Busy := FALSE;
    Done := TRUE;
ELSE
    Axis.Rate := Speed * {cycle};
    IF Rest < 0.0 THEN
        Axis.Rate := -Axis.Rate;
    END_IF;
    Axis.Commanded := Axis.Commanded + Axis.Rate;
END_IF;"""

_CAM = """\
Busy := Execute AND Axis.Powered;
Error := Execute AND NOT Axis.Powered;
IF Busy THEN
    Axis.Rate := Position - Axis.Commanded;
    Axis.Commanded := Position;
END_IF;
Done := Busy;
"""

_STOP = """\
Most := Acceleration * {cycle} * {cycle};
IF ABS(Axis.Rate) <= Most THEN
    Axis.Rate := 0.0;
    Busy := FALSE;
    Done := TRUE;
ELSIF Axis.Rate > 0.0 THEN
    Axis.Rate := Axis.Rate - Most;
ELSE
    Axis.Rate := Axis.Rate + Most;
END_IF;
Axis.Commanded := Axis.Commanded + Axis.Rate;"""

_SIMULATED = f"""\
IF NOT Before THEN
    Before := TRUE;
    Where := (Axis.High - Axis.Low) / 20.0;
END_IF;
Moved := 0.0;
IF Axis.Powered THEN
    Moved := (Axis.Commanded - Axis.Actual) * {FOLLOWS};
END_IF;
Axis.Actual := Axis.Actual + Moved;
Where := Where + Moved;
Axis.Switch := Where <= 0.0;
"""
