"""Division of a knot chart into A4 sheets.

Sheets are numbered in the order of weaving: from the lower left, along the row, then up. Rows are counted from the
bottom and knots from the left, both from 1. A sheet shows its own knots and, shaded, the next 3 to the right and above.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from ilmek.errors import CarpetError
from ilmek.records import record
from ilmek.sentences import Sentence

OVERLAP = 3
"""Number of knots of the next sheet that are shown too."""

MOST_WALL_KNOTS = 4_000_000
"""Largest number of knots of a wall.pdf: 5 s, 4 MB and 300 MB of memory."""

_ROOM = (482.0, 694.0)
_SMALLEST = 7.4
"""Width and height of the area for knots on a sheet [pt]; least side of a knot's cell [pt]."""


@record
class ChartSheet:
    """One sheet: its number from 1, its own knots left..right-1 and rows low..high-1 (from 0, from the bottom), the
    knots and rows shown with the overlap, and its neighbours' numbers (0: none).
    """

    number: int
    left: int
    right: int
    low: int
    high: int
    shown_right: int
    shown_high: int
    neighbours: dict[str, int]

    @property
    def title(self) -> Sentence:
        """The part of the carpet shown, rows and knots counted from 1."""
        return Sentence("chart.part", low=self.low + 1, high=self.high, left=self.left + 1, right=self.right)


@dataclass(frozen=True, slots=True)
class SheetLayout:
    """The cut of a chart: sheets across and up, knots and rows of one sheet, width and height of a knot's cell [pt]."""

    rows: int
    columns: int
    across: int
    up: int
    sheet_columns: int
    sheet_rows: int
    cell_width: float
    cell_height: float

    @property
    def count(self) -> int:
        """Number of sheets."""
        return self.across * self.up

    def sheets(self) -> Iterator[ChartSheet]:
        """The sheets in order."""
        for number in range(1, self.count + 1):
            yield self.sheet(number)

    def sheet(self, number: int) -> ChartSheet:
        """The sheet with this number."""
        up, across = divmod(number - 1, self.across)
        left, low = across * self.sheet_columns, up * self.sheet_rows
        right, high = min(left + self.sheet_columns, self.columns), min(low + self.sheet_rows, self.rows)
        neighbours = {
            "left": number - 1 if across else 0,
            "right": number + 1 if across + 1 < self.across else 0,
            "below": number - self.across if up else 0,
            "above": number + self.across if up + 1 < self.up else 0,
        }
        shown = min(right + OVERLAP, self.columns), min(high + OVERLAP, self.rows)
        return ChartSheet(number, left, right, low, high, *shown, neighbours)


def cut(rows: int, columns: int, proportion: float) -> SheetLayout:
    """The cut of a chart of rows x columns whose knots are `proportion` times as high as wide.

    A sheet holds a multiple of 10 knots and rows, as many as leave the cells readable; the cells then fill the sheet.

    >>> plan = cut(450, 300, 1.0)
    >>> plan.sheet_columns, plan.sheet_rows, plan.count, plan.sheet(1).title
    (60, 90, 25, 'rows 1–90, knots 1–60')
    """
    width = _SMALLEST * max(1.0, 1.0 / proportion)
    sheet_columns = _tens(_ROOM[0] / width, columns)
    sheet_rows = _tens(_ROOM[1] / (width * proportion), rows)
    shown = min(columns, sheet_columns + OVERLAP), min(rows, sheet_rows + OVERLAP)
    width = min(_ROOM[0] / shown[0], _ROOM[1] / shown[1] / proportion, 24.0 / max(1.0, proportion))
    across, up = math.ceil(columns / sheet_columns), math.ceil(rows / sheet_rows)
    return SheetLayout(rows, columns, across, up, sheet_columns, sheet_rows, width, width * proportion)


def _tens(room: float, total: int) -> int:
    """Knots per sheet with space for `room` knots: all, or a multiple of 10, equal on all sheets."""
    if total <= room:
        return total
    most = max(10, int((room - OVERLAP) // 10) * 10)
    return math.ceil(total / math.ceil(total / most) / 10) * 10


def require_wall(knots: int) -> None:
    """Raise CarpetError for a chart of more than MOST_WALL_KNOTS knots, which makes no wall.pdf."""
    if knots > MOST_WALL_KNOTS:
        do = "leave --wall out; chart.pdf has many sheets"
        raise CarpetError(f"--wall: the chart has {knots:,} knots", allowed=f"at most {MOST_WALL_KNOTS:,}", do=do)
