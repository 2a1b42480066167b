"""Lenze Cam Loader: ASCII, one point per line, linear interpolation.

The optional third column, the motor's torque for acceleration, is not written: it depends on the drive, not on the cam.
[Lenze, Global Drive Cam Loader, 4.2.1]
"""

from ilmek.io.cam_tables.format import Format, Remarks, number, rows
from ilmek.io.cam_tables.sampling import SampledTable, SamplingRule
from ilmek.report import CamTable


def write(table: CamTable, sampled: SampledTable, remarks: Remarks) -> str:
    """Master and slave, separated by a blank, ascending; the first lines have the remarks."""
    points = rows(table, sampled)
    notes = [f" // {remark}" for remark in remarks]
    notes += [""] * (len(points.x) - len(notes))
    lines = zip(points.x, points.y, notes, strict=False)
    return "".join(f"{number(x)} {number(y)}{remark}\n" for x, y, remark in lines)


FORMAT = Format(
    "lenze",
    "txt",
    "Lenze Cam Loader: motion profile",
    SamplingRule("linear", least=6),
    write,
    "cyclic, relative start; the loader interpolates linearly",
)
