"""Measured curves as CSV: the first column is what the machine's curve is over, each further one a curve.

The header names them with their units: `crank angle [deg], main shaft [N*m]`. Commas, semicolons or tabs; comments
with # above the header; empty cells are no sample of that curve.
"""

import math
import re
from pathlib import Path

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError, restated
from ilmek.io.csv_lines import csv_lines, decimal_points
from ilmek.io.text_file import read_text
from ilmek.records import record
from ilmek.units import Unit, parse_unit, read_number

LARGEST = 20_000_000
"""Largest size of a file [bytes]."""

_HEADING = re.compile(r"(?P<name>[^\[\]]+?)\s*(?:\[(?P<unit>[^\[\]]*)\])?")


@record
class MeasuredCurve:
    """A curve as measured: its name, SI samples in the order of the file, the units of both.

    x, y  [SI]      over  name of the first column
    """

    name: str
    over: str
    x: FloatArray
    y: FloatArray
    units: tuple[Unit, Unit]


def read_measured(path: Path) -> tuple[MeasuredCurve, ...]:
    """The curves of a file. Raises ParameterError, with the line, for what is none."""
    with restated(ParameterError, f"{path}: ", of=ParameterError):
        text = read_text(path, noun="CSV file", largest=LARGEST, error=ParameterError, do="check its name")
        table = csv_lines(text, ParameterError)
        number, header = table.header
        if len(header) < 2:
            raise ParameterError(
                f"line {number} names {len(header)} column", allowed="what is measured over, then a curve or more"
            )
        names, units = zip(*(_heading(cell, number) for cell in header), strict=True)
        rows = [
            [_value(cell, table.delimiter, line, name) for cell, name in zip(cells, names, strict=False)]
            for line, cells in table.lines
        ]
        curves = []
        for column, (name, unit) in enumerate(zip(names[1:], units[1:], strict=True), 1):
            pairs = np.array([(row[0], row[column]) for row in rows if len(row) > column], dtype=float).reshape(-1, 2)
            x, y = pairs[np.isfinite(pairs).all(axis=1)].T
            if x.size < 3:
                raise ParameterError(f"column {name!r} has {x.size} samples", allowed="at least 3")
            curves.append(MeasuredCurve(name, names[0], x * units[0].factor, y * unit.factor, (units[0], unit)))
        return tuple(curves)


def _heading(cell: str, line: int) -> tuple[str, Unit]:
    """Name and unit of a column."""
    found = _HEADING.fullmatch(cell.strip())
    if found is None:
        raise ParameterError(f"line {line}: the heading {cell!r}", allowed="a name with its unit: torque [N*m]")
    return found["name"], parse_unit((found["unit"] or "").strip())


def _value(cell: str, delimiter: str, line: int, name: str) -> float:
    """The number of a cell; NaN: it is empty."""
    if not cell:
        return math.nan
    number = read_number(decimal_points(cell, delimiter))
    if number is None or not math.isfinite(number):
        raise ParameterError(f"line {line}: {name} is {cell!r}", allowed="a number, or an empty cell")
    return float(number)
