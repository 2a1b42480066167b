"""Variables of the main program, and the structure by which the host gives a row."""

from ilmek.io.plc.interlock_logic import sensor_variables
from ilmek.io.plc.units import PlcArray, PlcStructure, PlcVariable
from ilmek.loom.control.interlocks import LoomAxis
from ilmek.loom.control.packml import PackMode, PackState
from ilmek.loom.operations import ROW_ENDS
from ilmek.records import value_record


@value_record
class PlcSize:
    """Sizes for which a program is written: heads, most phases of a row, knots of a row, rows."""

    heads: int
    phases: int
    columns: int
    rows: int


def row_structure(size: PlcSize) -> PlcStructure:
    """The structure by which the host gives a row."""
    return PlcStructure(
        "LoomRow",
        (
            PlcVariable("Number", "DINT", "row, 0 at the bottom edge", "-1"),
            PlcVariable("Columns", PlcArray(0, size.columns - 1, "INT"), "warp pair of each knot, head by head"),
            PlcVariable("Tubes", PlcArray(0, size.columns - 1, "USINT"), "tube of each knot"),
            PlcVariable("First", PlcArray(0, size.heads - 1, "INT"), "index of the first knot of each head"),
            PlcVariable(
                "Limits", PlcArray(0, size.heads * size.phases - 1, "INT"), "knots of a head to the end of a phase"
            ),
            PlcVariable("StopBefore", PlcArray(0, size.phases - 1, "BOOL"), "packages are changed before the phase"),
        ),
    )


def program_inputs(heads: int) -> tuple[PlcVariable, ...]:
    """Commands, sensors, the row's data, reports and answers."""
    per_head = PlcArray(0, heads - 1, "BOOL")
    codes = PlcArray(0, heads - 1, "INT")
    return (
        PlcVariable("CntrlCmd", "INT", "number of the command"),
        PlcVariable("CmdChangeRequest", "BOOL", "carry it out at the rising edge"),
        PlcVariable("UnitMode", "INT", "mode to change to"),
        PlcVariable("UnitModeChangeRequest", "BOOL", "change it at the rising edge"),
        PlcVariable("StepKnot", "BOOL", "in maintenance mode: one knot of each head, else one row"),
        PlcVariable("Acknowledge", "BOOL", "the operator has removed the cause of the alarm"),
        PlcVariable("JogAxis", "INT", f"axis to move in manual mode, 1 to {len(LoomAxis)}, 0: none"),
        *sensor_variables(heads),
        PlcVariable("RowData", "LoomRow", "the row that was requested"),
        PlcVariable("TieDone", per_head, "the knot is tied"),
        PlcVariable("TieFault", codes, "number of the fault's alarm, 0: none"),
        PlcVariable("EndDone", "BOOL", "the operation after the knots is done"),
        PlcVariable("EndFault", "INT", "number of the fault's alarm, 0: none"),
        PlcVariable("ChangeDone", "BOOL", "the operator has changed the packages"),
        PlcVariable("TieAnswer", codes, "is the uncertain knot in the carpet: 1 no, 2 yes"),
        PlcVariable("EndAnswer", "INT", "is the uncertain operation in the carpet: 1 no, 2 yes"),
    )


def program_outputs(heads: int) -> tuple[PlcVariable, ...]:
    """State, alarm, requests, orders and questions."""
    per_head = PlcArray(0, heads - 1, "BOOL")
    codes = PlcArray(0, heads - 1, "INT")
    return (
        PlcVariable("StateCurrent", "INT", "state", str(int(PackState.STOPPED))),
        PlcVariable("UnitModeCurrent", "INT", "mode", str(int(PackMode.PRODUCTION))),
        PlcVariable("Refused", "BOOL", "the command or mode was refused"),
        PlcVariable("Alarm", "INT", "number of the gravest active alarm, 0: none"),
        PlcVariable("Halt", "BOOL", "every motion is to stop at once"),
        PlcVariable("RowRequest", "DINT", "row that the host is to give"),
        PlcVariable("TieStart", per_head, "tie a knot"),
        PlcVariable("TieColumn", codes, "at this warp pair"),
        PlcVariable("TieTube", PlcArray(0, heads - 1, "USINT"), "from this tube"),
        PlcVariable("EndStart", "BOOL", "carry out an operation after the knots"),
        PlcVariable("EndCode", "INT", "its number: " + ", ".join(f"{int(end)} {_words(end.name)}" for end in ROW_ENDS)),
        PlcVariable("ChangeStart", "BOOL", "the operator is to change packages"),
        PlcVariable("JogStart", "BOOL", "the axis may move"),
        PlcVariable("AskTie", per_head, "is the knot of the head in the carpet"),
        PlcVariable("AskEnd", "BOOL", "is the operation after the knots in the carpet"),
        PlcVariable("KnotsDone", "DINT", "knots in the carpet"),
        PlcVariable("CarpetDone", "BOOL", "the carpet is woven"),
    )


def retained_variables(heads: int) -> tuple[PlcVariable, ...]:
    """What outlives a power failure."""
    per_head = PlcArray(0, heads - 1, "BOOL")
    codes = PlcArray(0, heads - 1, "INT")
    return (
        PlcVariable("Row", "DINT", "row in work"),
        PlcVariable("Phase", "INT", "phase in work; the number of phases: the operations after the knots"),
        PlcVariable("StopsDone", "INT", "phases whose stop is over"),
        PlcVariable("EndsDone", "INT", "operations after the knots that are in the carpet"),
        PlcVariable("Tied", codes, "knots of each head in the row"),
        PlcVariable("TieBusy", per_head, "a knot is being tied"),
        PlcVariable("EndBusy", "BOOL", "an operation after the knots is being carried out"),
    )


def inner_variables(heads: int) -> tuple[PlcVariable, ...]:
    """Blocks and values within a scan."""
    per_head = PlcArray(0, heads - 1, "BOOL")
    return (
        PlcVariable("Model", "StateModel"),
        PlcVariable("Rules", "Interlocks"),
        PlcVariable("Head", "INT"),
        PlcVariable("Index", "INT"),
        PlcVariable("Found", "INT"),
        PlcVariable("Busy", "BOOL"),
        PlcVariable("Waiting", "BOOL"),
        PlcVariable("StepDone", "BOOL"),
        PlcVariable("Complete", "BOOL"),
        PlcVariable("MayBegin", "BOOL"),
        PlcVariable("Waited", "INT", "scans for which an operation after the knots has waited"),
        PlcVariable("Retried", per_head, "the knot was tried again"),
    )


def _words(name: str) -> str:
    return name.lower().replace("_", " ")
