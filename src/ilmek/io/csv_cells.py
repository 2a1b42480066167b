"""Rows of CSV whose texts no spreadsheet runs as a formula.

A spreadsheet runs a cell that begins with =, +, - or @. A text that begins so, and is not a number, is written with an
apostrophe before it, which spreadsheets take as the mark of a text; `read_cell` removes it.
"""

import csv
import io
import re
from collections.abc import Iterable, Sequence

from ilmek.units import read_number

_RUN = re.compile(r"[\s']*[=+\-@\uff0b\uff0d\uff1d\uff20]")
"""Begin of a text that a spreadsheet runs, also behind blanks and apostrophes, with ASCII or full-width signs."""

_RUN_INSIDE = re.compile(r"(;\s*)(?=[=+\-@\uff0b\uff0d\uff1d\uff20])")
"""Begin of a cell that a spreadsheet runs if it divides lines at semicolons; texts of ilmek have no line ends."""


def write_cell(text: str) -> str:
    """The text as a cell that no spreadsheet runs.

    >>> write_cell("=1+1"), write_cell("-2.5"), write_cell("coupler.P x [m]")
    ("'=1+1", '-2.5', 'coupler.P x [m]')
    """
    if read_number(text) is not None:
        return text
    guarded = f"'{text}" if _RUN.match(text) else text
    return _RUN_INSIDE.sub(r"\1'", guarded)


def read_cell(cell: str) -> str:
    """The text of a cell that `write_cell` may have written.

    >>> read_cell("'=1+1"), read_cell("'quoted'")
    ('=1+1', "'quoted'")
    """
    return cell[1:] if cell.startswith("'") and _RUN.match(cell) else cell


def csv_rows(rows: Iterable[Sequence[object]]) -> str:
    """The rows as CSV with commas; every text goes through `write_cell`, numbers are written as they are."""
    text = io.StringIO()
    lines = csv.writer(text, lineterminator="\n")
    lines.writerows([write_cell(cell) if isinstance(cell, str) else cell for cell in row] for row in rows)
    return text.getvalue()
