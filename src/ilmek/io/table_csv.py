"""Columns of numbers as CSV."""

import csv
import io
import math
from collections.abc import Mapping

from ilmek.arrays import FloatArray


def csv_text(columns: Mapping[str, FloatArray]) -> str:
    """Columns by heading as CSV text with full precision; a number that is not finite is an empty cell.

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
