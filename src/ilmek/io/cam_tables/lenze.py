"""Lenze Cam Loader: ASCII, a point a line, straight lines between the points.

The optional third column, the motor's torque for acceleration, is left out: it belongs to the drive, not to the cam.
[Lenze, Global Drive Cam Loader, 4.2.1]
"""

from ilmek.io.cam_tables.format import Format, number, remarks, rows
from ilmek.io.cam_tables.sampling import SampledTable, SamplingRule
from ilmek.report import CamTable


def write(table: CamTable, sampled: SampledTable) -> str:
    """Master and slave with a blank between, ascending; the first lines carry the remarks."""
    points = rows(table, sampled)
    said = [f" // {remark}" for remark in remarks(table, sampled)]
    said += [""] * (len(points.x) - len(said))
    lines = zip(points.x, points.y, said, strict=False)
    return "".join(f"{number(x)} {number(y)}{remark}\n" for x, y, remark in lines)


FORMAT = Format(
    "lenze", "txt", "Lenze Cam Loader: motion profile", SamplingRule("linear", least=6), write, "relative start"
)
