"""Paths from a CSV file of points, such as the motion of a gripper.

    x [mm],y [mm]
    3.0,4.0
    3.0,-1.5

The first line names the columns, each with a unit of length in brackets; other columns are allowed. The
output of `ilmek mechanism FILE --csv` can be read directly.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.errors import CarpetError, UnitError, restated, shortened
from ilmek.io.csv_lines import CsvLines, csv_lines, decimal_points
from ilmek.io.text_file import read_text
from ilmek.units import LONGEST, counted, parse_quantity, read_number

LARGEST = 20_000_000
"""Largest size of a path file [bytes]; `MOST_POINTS` lines of ten columns."""

MOST_POINTS = 100_000
"""Largest number of points of a path; a smooth motion needs some thousands."""


def read_path(path: Path, columns: tuple[str, str] | None = None) -> ComplexArray:
    """The points of a CSV file [m], in its order.

    columns  headings of x and y, with or without units; default: the only two columns, or those named x and y
    Raises CarpetError with the file and the line or column of the error.
    """
    wording = dict(noun="path, a CSV file of points", do="check its name")
    with restated(CarpetError, f"path {path}: ", of=CarpetError):
        lines = csv_lines(read_text(path, largest=LARGEST, error=CarpetError, **wording), CarpetError)
        chosen = _chosen(lines.header[1], columns)
        factors = np.array([_factor(lines.header[1][index]) for index in chosen])
        points = np.array(list(_points(lines, chosen)))
        if len(points) < 2:
            raise CarpetError(f"has {counted(len(points), 'point')}", allowed="two or more below the line of headings")
    across, upwards = (points * factors).T
    return np.asarray(across + 1j * upwards)


def _chosen(header: list[str], columns: tuple[str, str] | None) -> list[int]:
    """Indices of the columns of x and y."""
    names = [_parts(heading)[0] for heading in header]
    if columns is None and len(header) == 2:
        return [0, 1]
    chosen = columns or ("x", "y")
    for name in chosen:
        count = names.count(name) + (0 if name in names else header.count(name))
        if count != 1:
            given = f"{'no' if not count else 'more than one'} column {name!r}"
            allowed = f"columns: {', '.join(header[:12])}{', …' if len(header) > 12 else ''}"
            raise CarpetError(given, allowed=allowed, do="choose two with --columns X Y" if columns is None else "")
    return [names.index(name) if name in names else header.index(name) for name in chosen]


def _factor(heading: str) -> float:
    """The unit of a column [m]."""
    name, unit = _parts(heading)
    if not unit:
        raise CarpetError(f"column {name!r} has no unit", do=f"write {name} [mm] in the first line")
    with restated(CarpetError, f"column {name!r}: ", of=UnitError):
        return parse_quantity(f"1 {unit}", "mm")


def _points(lines: CsvLines, chosen: list[int]) -> Iterator[list[float]]:
    """The numbers of the two columns, line by line."""
    for count, (line, cells) in enumerate(lines.lines):
        if count == MOST_POINTS:
            raise CarpetError(f"has more than {MOST_POINTS} points", do="leave out some of them")
        yield [_number(cells, index, line, lines.delimiter) for index in chosen]


def _number(cells: list[str], index: int, line: int, delimiter: str) -> float:
    cell = cells[index] if index < len(cells) else ""
    value = read_number(decimal_points(cell, delimiter)) if len(cell) <= LONGEST else None
    if value is None:
        raise CarpetError(
            f"line {line}: {shortened(repr(cell))} is not a number", do="correct that cell, or leave out the line"
        )
    return value


def _parts(heading: str) -> tuple[str, str]:
    """Name and unit of a heading: `x [mm]` is x and mm."""
    if not heading.endswith(("]", ")")):
        return heading, ""
    closed = max(heading[:-1].rfind("]"), heading[:-1].rfind(")")) + 1
    begin = min((at for at in (heading.find(mark, closed) for mark in "[(") if at >= 0), default=-1)
    return (heading[:begin].rstrip(), heading[begin + 1 : -1].strip()) if begin >= 0 else (heading, "")
