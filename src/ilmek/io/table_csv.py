"""Columns of numbers as CSV."""

import math
from collections.abc import Mapping

from ilmek.arrays import FloatArray
from ilmek.errors import IlmekError
from ilmek.io.csv_cells import csv_rows
from ilmek.progress import SILENT, Progress
from ilmek.report import Column, Table
from ilmek.units import format_number, from_si

MOST_NUMBERS = 2_000_000
"""Largest number of numbers of a table; its text has 40 MB as CSV and 90 MB as JSON."""

ROWS = 1000
"""Rows between two reports of progress."""


def csv_text(columns: Mapping[str, FloatArray], progress: Progress = SILENT) -> str:
    """Columns by heading as CSV text with full precision; a number that is not finite is an empty cell.

    Raises Cancelled.

    >>> import numpy as np
    >>> print(csv_text({"angle [rad]": np.array([0.1, 0.2]), "x [m]": np.array([1.0, np.nan])}), end="")
    angle [rad],x [m]
    0.1,1.0
    0.2,
    """
    parts, rows = [csv_rows([list(columns)])], min(map(len, columns.values()), default=0)
    for start in range(0, rows, ROWS):
        block = [map(_cell, column[start : start + ROWS].tolist()) for column in columns.values()]
        parts += [f"{','.join(row)}\n" for row in zip(*block, strict=True)]
        progress(min(1.0, (start + ROWS) / rows))
    return "".join(parts)


def rows_csv(table: Table) -> str:
    """A table of a report as CSV, its numbers in the units of its headings; one that is not finite is an empty cell.

    >>> from ilmek.report import columns
    >>> print(rows_csv(Table("cut", "Cut", columns("part | length [mm]"), (("rail", 1.5), ("post", math.nan)))), end="")
    part,length [mm]
    rail,1500
    post,
    """
    heads = [f"{column.heading} [{column.unit}]" if column.unit else column.heading for column in table.columns]
    rows = ([_written(value, column) for value, column in zip(row, table.columns, strict=True)] for row in table.rows)
    return csv_rows((heads, *rows))


def _written(value: float | int | str, column: Column) -> str | int:
    if not isinstance(value, float):
        return str(value) if isinstance(value, str) else value
    return format_number(from_si(value, column.unit), max(column.digits, 6)) if math.isfinite(value) else ""


def check_size(rows: int, columns: int, option: str, error: type[IlmekError]) -> None:
    """Raise `error` where a table has more than `MOST_NUMBERS` numbers; `option` sets its number of rows."""
    if rows * columns > MOST_NUMBERS:
        raise error(
            f"{option} {rows - 1} gives {rows * columns} numbers, {columns} per step",
            allowed=f"at most {MOST_NUMBERS}: {option} {MOST_NUMBERS // columns - 1}",
        )


def _cell(value: float | str) -> str:
    if isinstance(value, str):
        return value
    return repr(value) if math.isfinite(value) else ""
