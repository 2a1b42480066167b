"""Layout of rows.pdf: each row of knots is a strip of cells on one line of a page, wider carpets have several strips.

The page is A4 across where the row fits at LEAST_CELL a knot, else A3 across: 480 knots fit on one line. Above a strip
each run has its count over the yarn's symbol, a run of one knot its symbol alone, in SMALLEST type or larger. Where the
labels are wider than their runs, they stand on several levels; a label of the width w on cells of the width c needs at
most ceil(w / c) levels, because two on one level are less than w apart only if their runs are.
"""

import math
from dataclasses import dataclass

from ilmek.io.chart.symbols import ADVANCE

LEAST_CELL, MOST_CELL = 2.15, 12.0
"""Least and greatest width of a knot's cell [pt]."""

SMALLEST, LARGEST = 6.0, 9.0
"""Least and greatest size of the labels' type [pt]."""

A4, A3 = (841.89, 595.28), (1190.55, 841.89)
"""Width and height of the pages [pt]."""

MARGIN, LEFT, RIGHT = 24.0, 62.0, 36.0
"""Margin of a page, and space beside a strip for box and row number, left, and row number, right [pt]."""

HEAD, FOOT = 44.0, 16.0
"""Height of the lines above and below the strips [pt]."""

STRIP, RULER, COLOURS, GAP = 9.0, 8.0, 7.5, 6.0
"""Heights of the cells, a line of numbers below them, the line of colours and the gap between strips [pt]."""

LABEL_GAP = 0.6
"""Least gap between two labels on one level [pt]."""


@dataclass(frozen=True, slots=True)
class RowsLayout:
    """Where the strips of a chart stand.

    width, height  of the page [pt]       cell    width of a knot's cell [pt]
    parts          strips of a row        part_columns  knots of a strip
    size           of the labels' type [pt]             levels  of labels
    rulers         lines of numbers below a strip       lines   strips of a page
    """

    rows: int
    columns: int
    width: float
    height: float
    cell: float
    parts: int
    part_columns: int
    size: float
    levels: int
    rulers: int
    lines: int

    @property
    def count(self) -> int:
        """Number of pages with strips."""
        return -(-self.rows * self.parts // self.lines)

    @property
    def level(self) -> float:
        """Height of a level of labels, two lines [pt]."""
        return 2.04 * self.size

    @property
    def pitch(self) -> float:
        """Distance of the strips [pt]."""
        return strip_pitch(self.levels, self.size, self.rulers)


def strip_pitch(levels: int, size: float, rulers: int) -> float:
    """Distance of strips [pt] of levels of labels in a size of type and lines of numbers below."""
    return levels * 2.04 * size + STRIP + rulers * RULER + COLOURS + GAP


def rows_layout(rows: int, columns: int, *, marked: bool = False, rulers: int = 2) -> RowsLayout:
    """The layout of a chart of rows x columns.

    marked  whether there are half knots or jufti knots, whose labels are twice as wide
    rulers  lines of numbers below a strip

    >>> plan = rows_layout(700, 480)
    >>> plan.width > 1000, plan.parts, round(plan.cell, 2), plan.size, plan.levels
    (True, 1, 2.18, 6.0, 2)
    """
    width, height = next((page for page in (A4, A3) if _room(page) >= columns * LEAST_CELL), A3)
    room = _room((width, height))
    most = int(room / LEAST_CELL)
    parts = math.ceil(columns / most)
    part_columns = columns if parts == 1 else min(most // 10 * 10, math.ceil(columns / parts / 10) * 10)
    parts = math.ceil(columns / part_columns)
    cell = min(MOST_CELL, room / part_columns)
    signs = 2 if marked else 1
    size = min(LARGEST, max(SMALLEST, (cell - LABEL_GAP) / (signs * ADVANCE)))
    levels = max(1, math.ceil((signs * ADVANCE * size + LABEL_GAP) / cell - 1e-9)) + (parts > 1)
    lines = max(1, int((height - 2 * MARGIN - HEAD - FOOT) / strip_pitch(levels, size, rulers)))
    return RowsLayout(rows, columns, width, height, cell, parts, part_columns, size, levels, rulers, lines)


def _room(page: tuple[float, float]) -> float:
    return page[0] - 2 * MARGIN - LEFT - RIGHT
