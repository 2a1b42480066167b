"""The lines of a CSV file with commas, semicolons or tabs; comments are ignored."""

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
    r"""The lines of a CSV text; the delimiter is the most frequent in the first line. Lines with # are comments.

    Raises `error` with the line for misplaced quotes and for lines beyond the limits; for lines below the header while
    they are read.

    >>> read = csv_lines("# mm\nx;y\n1,5;2\n", IlmekError)
    >>> read.delimiter, read.header, list(read.lines)
    (';', (2, ['x', 'y']), [(3, ['1,5', '2'])])
    """
    first = next((line for line in _kept(text, error) if line.strip()), "")
    delimiter = max(",;\t", key=first.count)
    filled = _filled(text, delimiter, error)
    return CsvLines(delimiter, next(filled, (1, [])), filled)


def _kept(text: str, error: type[IlmekError]) -> Iterator[str]:
    """The lines; comments are empty."""
    for number, line in enumerate(io.StringIO(text, newline=None), start=1):
        if len(line) > LONGEST_LINE:
            raise error(f"line {number} is too long", allowed=f"at most {LONGEST_LINE} characters")
        yield "\n" if line.startswith("#") else line


def _filled(text: str, delimiter: str, error: type[IlmekError]) -> Iterator[tuple[int, list[str]]]:
    """Number and cells of every line that is not empty."""
    reader = csv.reader(_kept(text, error), delimiter=delimiter, skipinitialspace=True, strict=True)
    try:
        for cells in reader:
            if len(cells) > MOST_COLUMNS:
                raise error(f"line {reader.line_num} has {len(cells)} cells", allowed=f"at most {MOST_COLUMNS}")
            stripped = [read_cell(cell.strip()) for cell in cells]
            if any(stripped):
                yield reader.line_num, stripped
    except csv.Error as failed:
        raise error(f"line {reader.line_num}: {failed}", do="correct that line") from None


def decimal_points(number: str, delimiter: str) -> str:
    """A number with a decimal point; a comma is a decimal sign unless it is the delimiter."""
    return number if delimiter == "," else re.sub(r"(\d),(\d)", r"\1.\2", number)
