"""Kollmorgen KAS: the CSV that its cam editor imports, interpolated by a cyclic spline.

The import divides both columns by their largest value; the scales to set are therefore 360 and the largest position. A
motion that is never above 0 has no such value: it is written mirrored, and its scale is negative.
[Kollmorgen KAS, Import Cam Profile]
"""

from ilmek.io.cam_tables.format import Format, Remarks, number, rows
from ilmek.io.cam_tables.sampling import SampledTable, SamplingRule
from ilmek.report import CamTable
from ilmek.units import parse_unit


def scales(table: CamTable, sampled: SampledTable) -> dict[str, float]:
    """Scales of master [deg] and slave (in the table's unit) that restore the table after the import."""
    positions = sampled.nodes.s / parse_unit(table.unit).factor
    highest = float(positions.max())
    return {"master_scale": 360.0, "slave_scale": highest if highest > 0 else float(positions.min())}


def write(table: CamTable, sampled: SampledTable, remarks: Remarks) -> str:  # noqa: ARG001 - its import knows no comments
    """The rows X;Y;SPLINE between the table's marks."""
    points = rows(table, sampled)
    sign = 1.0 if points.y.max() > 0 else -1.0
    lines = [f"{number(x)};{number(sign * y)};SPLINE" for x, y in zip(points.x, points.y, strict=True)]
    return "\n".join(["CYCLIC;YES;", "TABLE_BEGIN;;", *lines, "TABLE_END;;", ""])


FORMAT = Format(
    "kollmorgen",
    "csv",
    "Kollmorgen KAS: cam profile to import",
    SamplingRule("spline", least=5),
    write,
    "scale of the input master_scale, of the output slave_scale, both offsets 0; the file sets cyclic splines",
    scales,
    headless=True,
)
