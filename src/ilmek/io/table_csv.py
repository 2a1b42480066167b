"""Columns of numbers as CSV, for a spreadsheet or another program."""

import csv
import io
import math
from collections.abc import Mapping

from ilmek.arrays import FloatArray


def csv_text(columns: Mapping[str, FloatArray]) -> str:
    """Columns by heading as CSV text; every number to its last digit, an empty cell where it is not finite.

    >>> import numpy as np
    >>> print(csv_text({"angle [rad]": np.array([0.1, 0.2]), "x [m]": np.array([1.0, np.nan])}), end="")
    angle [rad],x [m]
    0.1,1.0
    0.2,
    """
    text = io.StringIO()
    lines = csv.writer(text, lineterminator="\n")
    lines.writerow(columns)
    for row in zip(*columns.values(), strict=True):
        lines.writerow(repr(float(value)) if math.isfinite(value) else "" for value in row)
    return text.getvalue()
