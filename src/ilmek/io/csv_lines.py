"""The lines of a CSV file with commas, semicolons or tabs; comments are ignored."""

import csv
import re
from typing import NamedTuple

from ilmek.errors import IlmekError


class CsvLines(NamedTuple):
    """Header and non-empty lines, each with its number in the file and its cells."""

    delimiter: str
    header: tuple[int, list[str]]
    lines: list[tuple[int, list[str]]]


def csv_lines(text: str, error: type[IlmekError]) -> CsvLines:
    r"""The lines of a CSV text; the delimiter is the most frequent in the first line. Lines with # are comments.

    Raises `error` with the line for misplaced quotes.

    >>> csv_lines("# mm\nx;y\n1,5;2\n", IlmekError)
    CsvLines(delimiter=';', header=(2, ['x', 'y']), lines=[(3, ['1,5', '2'])])
    """
    kept = ["" if line.startswith("#") else f"{line}\n" for line in re.split(r"\r\n?|\n", text.rstrip())]
    first = next((line for line in kept if line.strip()), "")
    delimiter = max(",;\t", key=first.count)
    reader = csv.reader(kept, delimiter=delimiter, skipinitialspace=True, strict=True)
    try:
        filled = [(reader.line_num, [cell.strip() for cell in cells]) for cells in reader if "".join(cells).strip()]
    except csv.Error as failed:
        raise error(f"line {reader.line_num}: {failed}", do="correct that line") from None
    return CsvLines(delimiter, filled[0] if filled else (1, []), filled[1:])


def decimal_points(number: str, delimiter: str) -> str:
    """A number with a decimal point; a comma is a decimal sign unless it is the delimiter."""
    return number if delimiter == "," else re.sub(r"(\d),(\d)", r"\1.\2", number)
