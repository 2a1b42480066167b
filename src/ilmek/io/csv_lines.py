"""The lines of a CSV file, whoever wrote it: commas, semicolons or tabs, notes left out."""

import csv
import re
from typing import NamedTuple

from ilmek.errors import IlmekError


class CsvLines(NamedTuple):
    """Header and lines that hold anything, each with its number in the file and its cells."""

    delimiter: str
    header: tuple[int, list[str]]
    lines: list[tuple[int, list[str]]]


def csv_lines(text: str, error: type[IlmekError]) -> CsvLines:
    r"""The lines of a CSV text; the delimiter is what the first line has most of. Lines that begin with # are notes.

    Raises `error`, naming the line, where quotes are amiss.

    >>> csv_lines("# mm\nx;y\n1,5;2\n", IlmekError)
    CsvLines(delimiter=';', header=(2, ['x', 'y']), lines=[(3, ['1,5', '2'])])
    """
    said = ["" if line.startswith("#") else f"{line}\n" for line in re.split(r"\r\n?|\n", text.rstrip())]
    first = next((line for line in said if line.strip()), "")
    delimiter = max(",;\t", key=first.count)
    reader = csv.reader(said, delimiter=delimiter, skipinitialspace=True, strict=True)
    try:
        filled = [(reader.line_num, [cell.strip() for cell in cells]) for cells in reader if "".join(cells).strip()]
    except csv.Error as failed:
        raise error(f"line {reader.line_num}: {failed}", do="mend that line") from None
    return CsvLines(delimiter, filled[0] if filled else (1, []), filled[1:])


def decimal_points(number: str, delimiter: str) -> str:
    """A number with decimal points: where commas do not part the cells they may be the decimal sign."""
    return number if delimiter == "," else re.sub(r"(\d),(\d)", r"\1.\2", number)
