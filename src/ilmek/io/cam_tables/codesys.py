"""CODESYS SoftMotion: an MC_CAM_REF of the type XYVA, a polynomial of the fifth degree from point to point.

Velocity and acceleration are derivatives by the master. No more than 128 points: so many does SMC_ReadCAM take by
default (gc_SMC_FILE_MAXCAMEL). The two columns X, Y that the cam editor imports are not written: it lays polynomials of
the fifth degree through them, which swing where there are many. [CODESYS, SM3_Basic: MC_CAM_REF, SMC_CAMXYVA]
"""

from ilmek.io.cam_tables.format import Format, comment, identifier, number, remarks, rows
from ilmek.io.cam_tables.sampling import SampledTable, SamplingRule
from ilmek.report import CamTable

MOST = 128
"""Points of a cam that a file may hold."""

_LIST = """\
VAR_GLOBAL
    {name}_points : ARRAY[0..{last}] OF SMC_CAMXYVA := [
        {points}];
    {name} : MC_CAM_REF := (byType := 3, xStart := 0.0, xEnd := 360.0, nElements := {count}, nTappets := 0,
        pce := ADR({name}_points), strCAMName := '{name}');
END_VAR
"""


def write(table: CamTable, sampled: SampledTable) -> str:
    """The list of global variables: points, and the cam that MC_CamTableSelect takes."""
    points = rows(table, sampled)
    said = [
        f"(dX := {number(x)}, dY := {number(y)}, dV := {number(v)}, dA := {number(a)})"
        for x, y, v, a in zip(points.x, points.y, points.v, points.a, strict=True)
    ]
    text = _LIST.format(
        name=identifier(table.name), last=len(said) - 1, count=len(said), points=",\n        ".join(said)
    )
    return comment(remarks(table, sampled)) + text


FORMAT = Format(
    "codesys",
    "st",
    "CODESYS SoftMotion: MC_CAM_REF of type XYVA",
    SamplingRule("quintic", most=MOST),
    write,
    "MC_CamIn with StartMode relative; periodic",
)
