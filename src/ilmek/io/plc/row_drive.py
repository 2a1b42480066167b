"""The drive of the operations after the knots, in structured text: the axes of a row as electronic cams.

    order -> approach: each axis of the operation moves to its cam's position at the begin of its span
          -> cam in: a virtual master turns through the span, the axes follow their cams -> done

The span of an operation, an angle of the row's turn, is that of the motions of its axes: a weft ends with the shed
closed, as the interlocks have it. A homing order moves the axes of its number to their switches. An order that falls in
between, and `Halt`, bring the master to a stop with the axes in their cams; after `Halt` the power goes off (stop
category 1 of IEC 60204-1). An axis with an error ends the order as a fault. The heads are moved by their own drives.
"""

import math

from ilmek.io.plc.cam_function import CamTableText, cam_tables
from ilmek.io.plc.homing_logic import FIRST_HOME, HOME_CODES
from ilmek.io.plc.motion_blocks import AXIS, motion_units
from ilmek.io.plc.sequence_variables import ACCEPTED
from ilmek.io.plc.units import PlcSection, PlcUnit, PlcVariable, cases
from ilmek.loom.control.alarms import ALARMS
from ilmek.loom.control.interlocks import ROW_END_AXES, LoomAxis
from ilmek.loom.control.ports import Fault
from ilmek.loom.operations import ROW_ENDS, LoomSetup, RowEnd
from ilmek.machines import WEFT_CARRIERS
from ilmek.machines.automated_loom.cyclogram import BEATER, EVEN, ODD, SLIDE, TAKE_UP, row_ends
from ilmek.timing.cyclogram import Cyclogram, Track
from ilmek.units import turn

DRIVE = "RowDrive"
"""Name of the block."""

TRACK_AXES = {
    EVEN: LoomAxis.SHED, ODD: LoomAxis.SHED, **dict.fromkeys(WEFT_CARRIERS, LoomAxis.SHUTTLE),
    BEATER: LoomAxis.BEATER, SLIDE: LoomAxis.BEATER, TAKE_UP: LoomAxis.TAKE_UP,
}  # fmt: skip
"""The axis of the loom that each track of a row belongs to; the others are not of this drive."""

MARGIN, MOST_LAG = 0.02, 0.05
"""What an axis may go beyond its cam, and its largest following error, as shares of the stroke."""

RAMP = 0.1
"""Time in which the master comes to its speed, and stops [s]."""

_IDLE, _APPROACH, _TURN, _HOME, _STOP, _ENDED = range(6)


def drive_units(setup: LoomSetup, cycle: float) -> tuple[PlcUnit, ...]:
    """The blocks of motion and of the drive for the cycle of a task [s]; none without a row's cyclogram.

    The drive calls the cams of the row, `ilmek.io.plc.cam_function`.
    """
    row = next((one for one in setup.cyclograms if one.name == "row"), None)
    return () if row is None else (*motion_units(cycle), _unit(setup, row, cam_tables((row,))))


def span(row: Cyclogram, end: RowEnd) -> tuple[float, float]:
    """Angles [rad] between which the axes of an operation move, in its half of the turn; the take-up in any.

    A beat and the take-up begin where the operation before them ends, so that they last as long as in the cyclogram.
    """
    early = end in {RowEnd.STRAIGHT_WEFT, RowEnd.FIRST_BEAT}
    moves = [
        part
        for track in row.tracks
        if TRACK_AXES.get(track.name) in ROW_END_AXES[end]
        for part in track.segments
        if end is RowEnd.TAKE_UP or ((part.start + part.end) / 2 < math.pi) == early
    ]
    first = min(part.start for part in moves)
    if LoomAxis.SHED not in ROW_END_AXES[end]:
        first = min(first, turn * row_ends(row)[end - 1] / row.period)
    return first, max(part.end for part in moves)


def _unit(setup: LoomSetup, row: Cyclogram, tables: tuple[CamTableText, ...]) -> PlcUnit:
    axes = [_Slave(track, table) for track, table in zip(row.tracks, tables, strict=True) if track.name in TRACK_AXES]
    spans = [span(row, end) for end in ROW_ENDS]
    begins = ((int(end), f"First := {spans[end][0]:.9f};\nLast := {spans[end][1]:.9f};") for end in ROW_ENDS)
    inputs = (
        PlcVariable("Start", "BOOL", "the order"), PlcVariable("Code", "INT", "its number"),
        PlcVariable("Halt", "BOOL"),
    )  # fmt: skip
    outputs = (
        PlcVariable("Done", "BOOL"), PlcVariable("Status", "INT", "as EndStatus"),
        PlcVariable("ErrorID", "INT", "of the last axis with an error"),
    )  # fmt: skip
    inner = [
        PlcVariable("Stage", "INT", "", str(_IDLE)),
        *(PlcVariable(name, "BOOL") for name in ("Seen", "Ready", "AllDone", "Begins", "Cammed", "Mine")),
        PlcVariable("First", "REAL"), PlcVariable("Last", "REAL"), PlcVariable("Master", AXIS),
        PlcVariable("PowerMaster", "McPower"), PlcVariable("Turn", "McMoveAbsolute"),
        PlcVariable("StopMaster", "McStop"),
    ]  # fmt: skip
    for axis in axes:
        inner += axis.variables
    body = "\n".join(
        (
            _order(cases("Code", begins), axes),
            _master(turn / setup.times.row_ends[-1]),
            *(axis.calls(setup) for axis in axes),
            _transitions(),
        )
    )
    sections = (PlcSection("VAR_INPUT", inputs), PlcSection("VAR_OUTPUT", outputs), PlcSection("VAR", tuple(inner)))
    return PlcUnit("FUNCTION_BLOCK", DRIVE, "the axes of the operations after the knots", sections, body)


def _master(speed: float) -> str:
    """The virtual master turns, or stops. speed: [rad/s]."""
    return f"""\
PowerMaster(Axis := Master, Enable := TRUE);
Turn(Axis := Master, Execute := Stage = {_TURN}, Position := Last, Velocity := {speed:.9f},
    Acceleration := {speed / RAMP:.9f});
StopMaster(Axis := Master, Execute := Stage = {_STOP}, Acceleration := {speed / RAMP:.9f});
Master.Actual := Master.Commanded;
Ready := TRUE;
AllDone := TRUE;
ErrorID := 0;"""


class _Slave:
    """The text of an axis that follows a track of the row."""

    def __init__(self, track: Track, table: CamTableText) -> None:
        self.name = table.name.removeprefix("CamRow")
        self.table, self.revolves = table, bool(track.revolves)
        self.stroke = max(table.points) - min(table.points)
        self.code = HOME_CODES[TRACK_AXES[track.name]]
        own = [end for end in ROW_ENDS if TRACK_AXES[track.name] in ROW_END_AXES[end]]
        self.mine = " OR ".join(f"Code = {int(end)}" for end in own)

    @property
    def variables(self) -> tuple[PlcVariable, ...]:
        kinds = {"Power": "McPower", "Reset": "McReset", "Home": "McHome", "Move": "McMoveAbsolute", "In": "McCamIn",
                 "Simulated": "SimulatedAxis", "Cam": self.table.name}  # fmt: skip
        blocks = (
            PlcVariable(f"{block}{self.name}", kind)
            for block, kind in kinds.items()
            if not (self.revolves and block in {"Home", "Move"})
        )
        return (PlcVariable(f"Axis{self.name}", AXIS), *blocks)

    @property
    def limits(self) -> str:
        margin = MARGIN * self.stroke
        low, high = min(self.table.points) - margin, max(self.table.points) + margin
        return (
            f"Axis{self.name}.Low := {low:.9f};\nAxis{self.name}.High := {high:.9f};\n"
            f"Axis{self.name}.MostLag := {MOST_LAG * self.stroke:.9f};"
        )

    def calls(self, setup: LoomSetup) -> str:
        """The blocks of the axis: in each scan, whatever the step."""
        name, axis = self.name, f"Axis := Axis{self.name}"
        velocity = self.stroke / setup.times.row_ends[-1] * len(ROW_ENDS)
        home = f"Stage = {_HOME} AND Code = {self.code}"
        set_here, work = (
            "",
            f"""\
Home{name}({axis}, Execute := {home}, Velocity := {velocity:.9f});
Move{name}({axis}, Execute := Stage = {_APPROACH} AND Mine, Position := Cam{name}.Position, Velocity := {velocity:.9f},
    Acceleration := {velocity / RAMP:.9f});
Ready := Ready AND (NOT Mine OR (Axis{name}.Homed AND Move{name}.Done));
AllDone := AllDone AND (Home{name}.Done OR Code <> {self.code});
""",
        )
        if self.revolves:  # its position is taken where it stands
            set_here, work = f"""\
IF Begins AND (Mine OR Code = {self.code}) THEN
    Axis{name}.Commanded := Cam{name}.Position;
    Axis{name}.Actual := Cam{name}.Position;
    Axis{name}.Homed := TRUE;
END_IF;
""", ""  # fmt: skip
        return f"""\
Mine := {self.mine};
Cam{name}(Angle := Master.Commanded);
Reset{name}({axis}, Execute := Start);
Power{name}({axis}, Enable := NOT Halt OR Stage = {_STOP});
{set_here}{work}In{name}({axis}, Execute := Mine AND (Stage = {_TURN} OR (Stage = {_STOP} AND Cammed)),
    Position := Cam{name}.Position);
Simulated{name}({axis});
IF Axis{name}.ErrorID <> 0 THEN
    ErrorID := Axis{name}.ErrorID;
END_IF;"""


def _order(begins: str, axes: list[_Slave]) -> str:
    limits = "\n".join(axis.limits for axis in axes)
    return f"""\
IF Master.High = 0.0 THEN
Master.High := {turn + 1:.9f};
Master.Low := -1.0;
Master.MostLag := 1.0;
Master.Homed := TRUE;
{limits}
END_IF;
Begins := FALSE;
IF Halt AND (Stage = {_APPROACH} OR Stage = {_TURN} OR Stage = {_HOME}) THEN
    Stage := {_STOP};
ELSIF Start AND NOT Seen AND NOT Halt THEN
    Begins := TRUE;
    Cammed := FALSE;
    Done := FALSE;
    Status := {ACCEPTED};
    Stage := {_HOME};
    IF Code < {FIRST_HOME} THEN
        Stage := {_APPROACH};
{begins}
        Master.Commanded := First;
        Master.Actual := First;
        Master.Rate := 0.0;
    END_IF;
ELSIF NOT Start AND Stage <> {_IDLE} AND Stage <> {_ENDED} THEN
    Stage := {_STOP};
ELSIF NOT Start THEN
    Stage := {_IDLE};
    Done := FALSE;
    Status := 0;
END_IF;
Seen := Start;"""


def _transitions() -> str:
    """What follows from the axes: the step after this one, or the end of the order."""
    return f"""\
IF ErrorID <> 0 AND Stage <> {_IDLE} AND Stage <> {_ENDED} THEN
    Stage := {_ENDED};
    Status := {ALARMS[Fault.TIMEOUT].number};
ELSIF Stage = {_APPROACH} AND Ready THEN
    Stage := {_TURN};
    Cammed := TRUE;
ELSIF (Stage = {_TURN} AND Turn.Done) OR (Stage = {_HOME} AND AllDone AND NOT Begins) THEN
    Stage := {_ENDED};
    Done := TRUE;
ELSIF Stage = {_STOP} AND StopMaster.Done THEN
    Stage := {_IDLE};
    Done := FALSE;
    Status := 0;
END_IF;"""
