"""TwinCAT NC camming: a table of positions, and a motion function.

The table of positions has uneven steps. MC_CamIn interpolates it linearly unless its Options set the cyclic spline,
MC_INTERPOLATIONTYPE_SPLINE: the points suffice for straight lines, and the error of the spline is stated beside. The
motion function connects its points by polynomials of the fifth degree, of the kind motion to motion, with velocity and
acceleration as derivatives with respect to the master. [Beckhoff, TF5050: MC_CAM_REF, MC_MotionFunctionPoint]
"""

from ilmek.io.cam_tables.format import Format, Remarks, comment, identifier, number, rows, wrapped
from ilmek.io.cam_tables.sampling import SampledTable, SamplingRule
from ilmek.report import CamTable

_LIST = """\
VAR_GLOBAL
    {name}_points : {type} := [
    {points}];
    {name} : MC_CAM_REF := (pArray := ADR({name}_points), ArraySize := SIZEOF({name}_points),
        TableType := {table}, NoOfRows := {rows}, NoOfColumns := {columns});
END_VAR
"""


def write_positions(table: CamTable, sampled: SampledTable, remarks: Remarks) -> str:
    """The table of positions: master and slave, point after point."""
    points = rows(table, sampled)
    pairs = [f"{number(x)}, {number(y)}" for x, y in zip(points.x, points.y, strict=True)]
    text = _LIST.format(
        name=identifier(table.name, "positions"),
        type=f"ARRAY[1..{len(pairs)}, 1..2] OF LREAL",
        points=wrapped(pairs, 4),
        table="MC_TABLETYPE_NONEQUIDISTANT",
        rows=len(pairs),
        columns=2,
    )
    return comment(remarks) + text


def write_motion(table: CamTable, sampled: SampledTable, remarks: Remarks) -> str:
    """The motion function: a point with its derivatives, and the polynomial to the next."""
    points = rows(table, sampled)
    entries = [
        f"(PointIndex := {index}, FunctionType := MOTIONFUNCTYPE_POLYNOM5_MM, PointType := MOTIONPOINTTYPE_MOTION,"
        f" RelIndexNextPoint := 1, MasterPos := {number(x)}, SlavePos := {number(y)}, SlaveVelo := {number(v)},"
        f" SlaveAcc := {number(a)}, SlaveJerk := 0.0)"
        for index, (x, y, v, a) in enumerate(zip(points.x, points.y, points.v, points.a, strict=True), start=1)
    ]
    text = _LIST.format(
        name=identifier(table.name, "motion"),
        type=f"ARRAY[1..{len(entries)}] OF MC_MotionFunctionPoint",
        points=wrapped(entries, 1),
        table="MC_TABLETYPE_MOTIONFUNCTION",
        rows=len(entries),
        columns=1,
    )
    return comment(remarks) + text


POSITIONS = Format(
    "twincat-positions",
    "st",
    "TwinCAT: table of positions, uneven steps",
    SamplingRule("linear", better="spline", least=5),
    write_positions,
    "MC_CamIn cyclic, relative start; Options.InterpolationType := MC_INTERPOLATIONTYPE_SPLINE for the smaller error",
    better="MC_INTERPOLATIONTYPE_SPLINE",
)

MOTION = Format(
    "twincat-motion",
    "st",
    "TwinCAT: motion function",
    SamplingRule("quintic"),
    write_motion,
    "MC_CamIn cyclic, relative start; the points fix the interpolation",
)
