"""CODESYS SoftMotion: an MC_CAM_REF of the type XYVA, with a polynomial of the fifth degree between two points.

Velocity and acceleration are derivatives with respect to the master. SMC_ReadCAM accepts at most 128 points by default
(gc_SMC_FILE_MAXCAMEL). The two columns X, Y of the cam editor's import are not written: its polynomials of the fifth
degree through many points oscillate. [CODESYS, SM3_Basic: MC_CAM_REF, SMC_CAMXYVA]
"""

from ilmek.io.cam_tables.format import Format, Remarks, comment, identifier, number, rows
from ilmek.io.cam_tables.sampling import SampledTable, SamplingRule
from ilmek.report import CamTable

MOST = 128
"""Largest number of points of a cam."""

_LIST = """\
VAR_GLOBAL
    {name}_points : ARRAY[0..{last}] OF SMC_CAMXYVA := [
        {points}];
    {name} : MC_CAM_REF := (byType := 3, xStart := 0.0, xEnd := 360.0, nElements := {count}, nTappets := 0,
        pce := ADR({name}_points), strCAMName := '{name}');
END_VAR
"""


def write(table: CamTable, sampled: SampledTable, remarks: Remarks) -> str:
    """The list of global variables: the points, and the cam for MC_CamTableSelect."""
    points = rows(table, sampled)
    entries = [
        f"(dX := {number(x)}, dY := {number(y)}, dV := {number(v)}, dA := {number(a)})"
        for x, y, v, a in zip(points.x, points.y, points.v, points.a, strict=True)
    ]
    text = _LIST.format(
        name=identifier(table.name, "xyva"),
        last=len(entries) - 1,
        count=len(entries),
        points=",\n        ".join(entries),
    )
    return comment(remarks) + text


FORMAT = Format(
    "codesys",
    "st",
    "CODESYS SoftMotion: MC_CAM_REF of type XYVA",
    SamplingRule("quintic", most=MOST),
    write,
    "MC_CamTableSelect Periodic := TRUE, MC_CamIn StartMode := relative; the type XYVA fixes the interpolation",
)
