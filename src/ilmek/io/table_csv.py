"""Columns of numbers as CSV."""

import math
from collections.abc import Mapping

from ilmek.arrays import FloatArray
from ilmek.io.csv_cells import csv_rows


def csv_text(columns: Mapping[str, FloatArray]) -> str:
    """Columns by heading as CSV text with full precision; a number that is not finite is an empty cell.

    >>> import numpy as np
    >>> print(csv_text({"angle [rad]": np.array([0.1, 0.2]), "x [m]": np.array([1.0, np.nan])}), end="")
    angle [rad],x [m]
    0.1,1.0
    0.2,
    """
    values = [[repr(value) if math.isfinite(value) else "" for value in column.tolist()] for column in columns.values()]
    return csv_rows([list(columns)]) + "".join(f"{','.join(row)}\n" for row in zip(*values, strict=True))
