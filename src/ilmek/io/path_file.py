"""Paths from a CSV file of points, such as the motion of a gripper.

    x [mm],y [mm]
    3.0,4.0
    3.0,-1.5

The first line names the columns, each with a unit of length in brackets; other columns are allowed. The
output of `ilmek mechanism FILE --csv` can be read directly.
"""

import math
import re
from pathlib import Path

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.errors import CarpetError, UnitError
from ilmek.io.csv_lines import CsvLines, csv_lines, decimal_points
from ilmek.io.text_file import read_text
from ilmek.units import parse_quantity

LARGEST = 100_000_000
"""Largest size of a path file [bytes]; some millions of points."""

_HEADING = re.compile(r"(.*?)\s*[\[(]\s*([^\])]*?)\s*[\])]$")


def read_path(path: Path, columns: tuple[str, str] | None = None) -> ComplexArray:
    """The points of a CSV file [m], in its order.

    columns  headings of x and y, with or without units; default: the only two columns, or those named x and y
    Raises CarpetError with the file and the line or column of the error.
    """
    wording = dict(noun="path, a CSV file of points", do="check its name")
    try:
        lines = csv_lines(read_text(path, largest=LARGEST, error=CarpetError, **wording), CarpetError)
        across, upwards = (_column(lines, index) for index in _chosen(lines.header[1], columns))
        if len(across) < 2:
            raise CarpetError(f"has {len(across)} points", allowed="two or more below the line of headings")
    except CarpetError as error:
        raise CarpetError(f"path {path}: {error.given}", allowed=error.allowed, do=error.do) from None
    return np.asarray(across) + 1j * np.asarray(upwards)


def _chosen(header: list[str], columns: tuple[str, str] | None) -> list[int]:
    """Indices of the columns of x and y."""
    names = [_parts(heading)[0] for heading in header]
    if columns is None and len(header) == 2:
        return [0, 1]
    chosen = columns or ("x", "y")
    for name in chosen:
        count = names.count(name) + (0 if name in names else header.count(name))
        if count != 1:
            raise CarpetError(
                f"{'no' if not count else 'more than one'} column {name!r}",
                allowed=f"columns: {', '.join(header[:12])}{', …' if len(header) > 12 else ''}",
                do="choose two with --columns X Y" if columns is None else "",
            )
    return [names.index(name) if name in names else header.index(name) for name in chosen]


def _column(lines: CsvLines, index: int) -> list[float]:
    """A column's numbers [m]."""
    name, unit = _parts(lines.header[1][index])
    if not unit:
        raise CarpetError(f"column {name!r} has no unit", do=f"write {name} [mm] in the first line")
    try:
        factor = parse_quantity(f"1 {unit}", "mm")
    except UnitError as error:
        raise CarpetError(f"column {name!r}: {error.given}", allowed=error.allowed, do=error.do) from None
    return [factor * _number(cells, index, line, lines.delimiter) for line, cells in lines.lines]


def _number(cells: list[str], index: int, line: int, delimiter: str) -> float:
    cell = cells[index] if index < len(cells) else ""
    try:
        value = float(decimal_points(cell, delimiter))
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise CarpetError(f"line {line}: {cell!r} is not a number", do="correct that cell, or leave out the line")
    return value


def _parts(heading: str) -> tuple[str, str]:
    """Name and unit of a heading: `x [mm]` is x and mm."""
    found = _HEADING.match(heading)
    return (found[1], found[2]) if found else (heading, "")
