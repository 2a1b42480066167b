"""Tables of a report: rows of SI numbers and texts under columns with units."""

import re
from dataclasses import dataclass

from ilmek.records import value_record


@dataclass(frozen=True, slots=True)
class Column:
    """A table's column: heading and the unit its SI numbers are shown in ("" for text and plain numbers)."""

    heading: str
    unit: str = ""
    digits: int = 4


@dataclass(frozen=True, slots=True)
class Cell:
    """A table's cell as it is printed, and whether it is a number."""

    text: str
    is_number: bool


@value_record
class Table:
    """Rows of SI numbers and texts under columns.

    brief  True: short, and worth being shown on a terminal too
    """

    name: str
    title: str
    columns: tuple[Column, ...]
    rows: tuple[tuple[float | int | str, ...], ...]
    brief: bool = False


_HEADING = re.compile(r"(.*?)(?:\s*\[([^\]]*)\](?:\s*(\d+))?)?$")


def columns(*headings: str | Column) -> tuple[Column, ...]:
    """Columns by their headings, the unit in brackets behind, and after it the number of significant digits.

    headings  one by one, or several in a text as in a table's head, divided by " | "

    >>> columns("link | length [mm] | mass of one [kg] 3")[1:]
    (Column(heading='length', unit='mm', digits=4), Column(heading='mass of one', unit='kg', digits=3))
    """
    written = (heading.split(" | ") if isinstance(heading, str) else (heading,) for heading in headings)
    return tuple(_column(one) if isinstance(one, str) else one for part in written for one in part)


def _column(written: str) -> Column:
    matched = _HEADING.match(written)
    assert matched is not None
    heading, unit, digits = matched.groups()
    return Column(heading, unit or "", int(digits or 4))
