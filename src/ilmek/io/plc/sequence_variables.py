"""Variables of the loom's block, and the structures by which the host gives carpets and rows.

A station is a head, or behind the last head the loom as a whole, which carries out the operations after the knots.
"""

from ilmek.io.plc.homing_logic import HOME_CODES
from ilmek.io.plc.interlock_logic import sensor_variables
from ilmek.io.plc.units import PlcArray, PlcStructure, PlcVariable
from ilmek.loom.control.interlocks import WATCHED, LoomAxis
from ilmek.loom.control.packml import PackMode, PackState
from ilmek.loom.operations import ROW_ENDS
from ilmek.records import value_record

DIGEST_WORDS = 8
"""Words of 32 bits of a programme's digest."""

NOT_ASIDE = -1
"""In the place of the warp pair at which a head stands aside: it ties in the phase."""

LAST_BEAT = 32_000
"""Number after which the counters of the heartbeat begin again at 0."""

ACCEPTED = 1
"""Status of a drive that has accepted its order; 0: it is ready for one; above: the number of a fault's alarm."""


@value_record
class ScanLimits:
    """Scans after which an operation may be done at the earliest, and must be done at the latest."""

    least: int
    most: int


@value_record
class PlcSize:
    """Sizes for which a program is written: heads, most phases and knots of a row; limits of the operations.

    home  of the homing of an axis
    """

    heads: int
    phases: int
    columns: int
    knot: ScanLimits
    row_ends: tuple[ScanLimits, ...]
    home: ScanLimits

    @property
    def stations(self) -> int:
        """Heads, and the loom behind them: the number of the last station is that of the heads."""
        return self.heads + 1


def structures(size: PlcSize) -> tuple[PlcStructure, ...]:
    """What the host gives, a carpet and a row, and what outlives a power failure."""
    return (
        PlcStructure(
            "LoomRecipe",
            (
                PlcVariable("Programme", PlcArray(DIGEST_WORDS, "DWORD"), "SHA-256 of the programme, first word first"),
                PlcVariable("Rows", "DINT", "of the carpet"),
                PlcVariable("Columns", "INT", f"warp pairs, at most {size.columns}"),
                PlcVariable("Tubes", "INT", "of a head"),
                PlcVariable("Row", "DINT", "last row that the host gave of this carpet, -1: none", "-1"),
            ),
        ),
        PlcStructure(
            "LoomRow",
            (
                PlcVariable("Number", "DINT", "row, 0 at the bottom edge", "-1"),
                PlcVariable("Before", "DINT", "knots of the rows before"),
                PlcVariable("Knots", "INT", "of the row"),
                PlcVariable("Phases", "INT", f"phases of the row, at most {size.phases}"),
                PlcVariable("Columns", PlcArray(size.columns, "INT"), "warp pair of each knot, head by head"),
                PlcVariable("Tubes", PlcArray(size.columns, "USINT"), "tube of each knot"),
                PlcVariable("First", PlcArray(size.heads, "INT"), "index of the first knot of each head"),
                PlcVariable("Limits", PlcArray(size.heads * size.phases, "INT"),
                            f"knots of head h to the end of phase p, at {size.phases} h + p"),
                PlcVariable("Aside", PlcArray(size.heads * size.phases, "INT"),
                            f"warp pair where head h stands without a knot in phase p, {NOT_ASIDE}: it ties"),
                PlcVariable("StopBefore", PlcArray(size.phases, "BOOL"), "packages are changed before the phase"),
                PlcVariable("Check", "DWORD", "CRC-32 of programme and row"),
            ),
        ),
        PlcStructure(
            "LoomPosition",
            (
                PlcVariable("Begun", "BOOL", "a carpet is in work"),
                PlcVariable("Carpet", "LoomRecipe", "that carpet"),
                PlcVariable("Row", "DINT", "row in work"),
                PlcVariable("Phase", "INT", "phase in work; the number of phases: the operations after the knots"),
                PlcVariable("StopRow", "DINT", "first row that needs the packages of the last stop"),
                PlcVariable("StopsDone", "INT", "phases whose stop is over"),
                PlcVariable("EndsDone", "INT", "operations after the knots that are in the carpet"),
                PlcVariable("Tied", PlcArray(size.heads, "INT"), "knots of each head in the row"),
                PlcVariable("Busy", PlcArray(size.stations, "BOOL"), "the operation of a station may be in the carpet"),
                PlcVariable("Column", PlcArray(size.heads, "INT"), "warp pair of the last order of each head"),
                PlcVariable("Knots", "DINT", "knots in the carpet, counted"),
                PlcVariable("Before", "DINT", "of them, those of the rows before"),
                PlcVariable("Alarm", "INT", "the gravest active alarm"),
            ),
        ),
    )  # fmt: skip


def block_inputs(size: PlcSize) -> tuple[PlcVariable, ...]:
    """Commands, sensors, the carpet's and the row's data, reports and answers."""
    per_head, codes = PlcArray(size.heads, "BOOL"), PlcArray(size.heads, "INT")
    return (
        PlcVariable("CntrlCmd", "INT", "number of the command"),
        PlcVariable("CmdChangeRequest", "BOOL", "carry it out at the rising edge"),
        PlcVariable("UnitMode", "INT", "mode to change to"),
        PlcVariable("UnitModeChangeRequest", "BOOL", "change it at the rising edge"),
        PlcVariable("StepKnot", "BOOL", "in maintenance mode: one knot of each head, else one row"),
        PlcVariable("Acknowledge", "BOOL", "rising edge: the operator has removed the cause of the alarm"),
        PlcVariable("GiveUp", "BOOL", "rising edge in Stopped: the carpet in work is given up"),
        PlcVariable("RowsBack", "INT", "whole rows that were taken out before the row in work, which was too"),
        PlcVariable("RowsBackKnots", "DINT", "knots of the rows before these"),
        PlcVariable("RowsBackRequest", "BOOL", "rising edge in Stopped: they are woven again"),
        PlcVariable("JogAxis", "INT", f"axis to move in manual mode, 1 to {len(LoomAxis)}, 0: none"),
        *sensor_variables(size.heads),
        PlcVariable("HostBeat", "INT", f"the host counts on, after {LAST_BEAT} from 0"),
        PlcVariable("Recipe", "LoomRecipe", "the carpet that is to be woven"),
        PlcVariable("RowData", "LoomRow", "the row that was requested"),
        PlcVariable("TieDone", per_head, "the knot is tied, until the order falls"),
        PlcVariable("TieStatus", codes, "0 ready, 1 the order is accepted, else the number of the fault's alarm"),
        PlcVariable("EndDone", "BOOL", "the operation after the knots is done, until the order falls"),
        PlcVariable("EndStatus", "INT", "0 ready, 1 the order is accepted, else the number of the fault's alarm"),
        PlcVariable("ChangeDone", "BOOL", "rising edge: the operator has changed the packages"),
        PlcVariable("TieAnswer", codes, "is the uncertain knot in the carpet: 1 no, 2 yes, 0 between answers"),
        PlcVariable("EndAnswer", "INT", "is the uncertain operation in the carpet: 1 no, 2 yes, 0 between answers"),
    )


def block_outputs(size: PlcSize) -> tuple[PlcVariable, ...]:
    """State, alarm, requests, orders and questions."""
    per_head, codes = PlcArray(size.heads, "BOOL"), PlcArray(size.heads, "INT")
    return (
        PlcVariable("StateCurrent", "INT", "state", str(int(PackState.STOPPED))),
        PlcVariable("UnitModeCurrent", "INT", "mode", str(int(PackMode.PRODUCTION))),
        PlcVariable("Refused", "BOOL", "the command or mode was refused"),
        PlcVariable("Alarm", "INT", "number of the gravest active alarm, 0: none"),
        PlcVariable("Halt", "BOOL", "every motion is to stop at once"),
        PlcVariable("RowRequest", "DINT", "row that the host is to give, -1: none", "-1"),
        PlcVariable("TieStart", per_head, "tie a knot, until it is done or has failed"),
        PlcVariable("TieColumn", codes, "at this warp pair; while asked: the knot in question"),
        PlcVariable("TieTube", PlcArray(size.heads, "USINT"), "from this tube"),
        PlcVariable("TieAside", per_head, "only go there, and tie no knot: out of the other heads' reach"),
        PlcVariable("EndStart", "BOOL", "carry out an operation after the knots, or home an axis"),
        PlcVariable(
            "EndCode",
            "INT",
            "its number: "
            + ", ".join(
                (
                    *(f"{int(end)} {_words(end.name)}" for end in ROW_ENDS),
                    *(f"{code} home {axis.value}" for axis, code in HOME_CODES.items()),
                )
            ),
        ),
        PlcVariable("ChangeStart", "BOOL", "the operator is to change packages"),
        PlcVariable("JogStart", "BOOL", "the axis may move"),
        PlcVariable("AskTie", per_head, "is the knot of the head in the carpet"),
        PlcVariable("AskEnd", "BOOL", "is the operation after the knots in the carpet"),
        PlcVariable("KnotsDone", "DINT", "knots in the carpet, counted"),
        PlcVariable("CarpetDone", "BOOL", "the carpet is woven"),
        PlcVariable("PlcBeat", "INT", f"the program counts its scans, after {LAST_BEAT} from 0"),
    )


def retained_variables() -> tuple[PlcVariable, ...]:
    """What outlives a power failure: two records, of which the last one written whole is valid."""
    return (
        PlcVariable("SavedEven", "LoomPosition"),
        PlcVariable("SavedOdd", "LoomPosition"),
        PlcVariable("OddIsLast", "BOOL", "the last whole record is SavedOdd"),
    )


def inner_variables(size: PlcSize) -> tuple[PlcVariable, ...]:
    """Blocks and values that a power failure may take."""
    flags, numbers = PlcArray(size.stations, "BOOL"), PlcArray(size.stations, "INT")
    return (
        PlcVariable("Model", "StateModel"),
        PlcVariable("Rules", "Interlocks"),
        PlcVariable("Now", "LoomPosition", "what is in the carpet"),
        PlcVariable("Work", "LoomRow", "the row in work"),
        PlcVariable("Home", PlcArray(len(LoomAxis), "BOOL"), "the axis is at home since power-up"),
        PlcVariable("RowReady", "BOOL", "that row is checked"),
        PlcVariable("Awake", "BOOL", "the last record is read"),
        *(PlcVariable(name, flags, meaning) for name, meaning in (
            ("Order", "the station is to work"), ("Accepted", "it has accepted the order"),
            ("Settling", "its signals of the last order have not fallen yet"), ("Done", "its report"),
            ("Asked", "its operation may be in the carpet"), ("Released", "the answer was 0 since then"))),
        PlcVariable("Status", numbers, "its report"),
        PlcVariable("Answer", numbers, "the answer about its operation"),
        PlcVariable("Elapsed", numbers, "scans since its order began or ended"),
        PlcVariable("Retried", PlcArray(size.heads, "BOOL"), "the knot was tried again"),
        PlcVariable("Stood", PlcArray(size.heads, "BOOL"), "the head stands aside in the phase in work"),
        PlcVariable("Seen", PlcArray(size.columns, "BOOL"), "the row has a knot on the warp pair"),
        *(PlcVariable(name, "INT") for name in
          ("Head", "Station", "Axis", "Index", "Pass", "Fault", "Least", "Most", "Waited", "Tube", "Before",
           "PhaseEnd", "HostBeatSeen", "BeatScans")),
        *(PlcVariable(name, "DINT") for name in ("Item", "Rest", "HostScans", "Sum")),
        PlcVariable("Crc", "DWORD"),
        *(PlcVariable(name, "BOOL") for name in
          ("Busy", "Waiting", "Asking", "StepDone", "Homing", "AllHome", "Complete", "MayBegin", "Plausible",
           "Loading", "ByAlarm", "AcknowledgeSeen", "GiveUpSeen", "RowsBackSeen", "ChangeSeen")),
        *(PlcVariable(watch_name(sensor), "BOOL", "the sensor has not changed in this operation")
          for sensor in WATCHED.values()),
    )  # fmt: skip


def watch_name(sensor: str) -> str:
    """Name of the flag that watches a sensor.

    >>> watch_name("beater_back")
    'WatchBeaterBack'
    """
    return f"Watch{''.join(part.capitalize() for part in sensor.split('_'))}"


def _words(name: str) -> str:
    return name.lower().replace("_", " ")
