"""The neutral table: CSV with a heading, for a spreadsheet or a controller with linear interpolation.

The remarks before the heading begin with #.
"""

from ilmek.io.cam_tables.format import Format, Remarks, rows
from ilmek.io.cam_tables.sampling import SampledTable, SamplingRule
from ilmek.io.table_csv import csv_text
from ilmek.report import CamTable


def write(table: CamTable, sampled: SampledTable, remarks: Remarks) -> str:
    """Master angle, position, and its derivatives with respect to the master angle, with units in the heading."""
    unit, points = table.unit, rows(table, sampled)
    head = "".join(f"# {remark}\n" for remark in remarks)
    return head + csv_text(
        {
            "master [deg]": points.x,
            f"position [{unit}]": points.y,
            f"velocity [{unit}/deg]": points.v,
            f"acceleration [{unit}/deg^2]": points.a,
        }
    )


FORMAT = Format(
    "neutral",
    "csv",
    "CSV: master angle, position, velocity, acceleration",
    SamplingRule("linear"),
    write,
    "linear interpolation between the points, cyclic, relative start",
)
