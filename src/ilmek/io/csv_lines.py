"""The lines of a CSV file with commas, semicolons or tabs: a header, then rows; comments stand above the header."""

import csv
import io
import re
from collections.abc import Iterator
from typing import NamedTuple

from ilmek.errors import IlmekError
from ilmek.io.csv_cells import read_cell

MOST_COLUMNS = 10_000
"""Largest number of columns of a CSV file."""

LONGEST_LINE = 500_000
"""Largest number of characters of a line of a CSV file; 10,000 columns need less."""


class CsvLines(NamedTuple):
    """Header and non-empty lines, each with its number in the file and its cells; the lines are read one by one."""

    delimiter: str
    header: tuple[int, list[str]]
    lines: Iterator[tuple[int, list[str]]]


def csv_lines(text: str, error: type[IlmekError]) -> CsvLines:
    r"""The lines of a CSV text; the delimiter is the most frequent in the header. Lines with # above it are comments.

    Raises `error` with the line for misplaced quotes, for cells beyond the header and for comments below it, and for
    lines beyond the limits; for lines below the header while they are read.

    >>> table = csv_lines("# mm\nx;y\n1,5;2\n", IlmekError)
    >>> table.delimiter, table.header, list(table.lines)
    (';', (2, ['x', 'y']), [(3, ['1,5', '2'])])
    """
    heading = next((line for line in _without_comments(text, error) if line.strip()), "")
    delimiter = max(",;\t", key=heading.count)
    filled = _filled(text, delimiter, error)
    header = next(filled, (1, []))
    return CsvLines(delimiter, header, _fitting(filled, len(header[1]), error))


def _without_comments(text: str, error: type[IlmekError]) -> Iterator[str]:
    """The lines; comments above the header are empty."""
    above = True
    for number, line in enumerate(io.StringIO(text, newline=None), start=1):
        if len(line) > LONGEST_LINE:
            raise error(f"line {number} is too long", allowed=f"at most {LONGEST_LINE} characters")
        comment = above and line.lstrip().startswith("#")
        above = above and (comment or not line.strip())
        yield "\n" if comment else line


def _filled(text: str, delimiter: str, error: type[IlmekError]) -> Iterator[tuple[int, list[str]]]:
    """Number and cells of every line that is not empty."""
    lines = _without_comments(text, error)
    reader = csv.reader(lines, delimiter=delimiter, skipinitialspace=True, strict=True)
    try:
        for cells in reader:
            if len(cells) > MOST_COLUMNS:
                raise error(f"line {reader.line_num} has {len(cells)} cells", allowed=f"at most {MOST_COLUMNS}")
            stripped = [read_cell(cell.strip()) for cell in cells]
            if any(stripped):
                yield reader.line_num, stripped
    except csv.Error as failed:
        raise error(f"line {reader.line_num}: {failed}", do="correct that line") from None


def _fitting(
    lines: Iterator[tuple[int, list[str]]], columns: int, error: type[IlmekError]
) -> Iterator[tuple[int, list[str]]]:
    """The lines below a header of a number of columns."""
    for number, cells in lines:
        if len(cells) == 1 < columns and cells[0].startswith("#"):
            raise error(f"line {number} is a comment below the headings", do="put comments above the headings")
        if any(cells[columns:]):
            raise error(
                f"line {number} has {len(cells)} cells",
                allowed=f"{columns} columns",
                do="put quotes around a cell that holds a delimiter",
            )
        yield number, cells[:columns]


def decimal_points(number: str, delimiter: str) -> str:
    """A number with a decimal point; a comma is a decimal sign unless it is the delimiter."""
    return number if delimiter == "," else re.sub(r"(\d),(\d)", r"\1.\2", number)
