"""Rows to weave by: the knots of each row as runs of one yarn, or each yarn once with all its knots (talim).

Rows are counted from 1 at the carpet's lower edge, the first that is woven; knots from 1 at the edge from which the row
is read. The runs of a row from left to right and from right to left are the same in reverse order.

A cell of a row has a code, which says all about its knots [`ilmek.carpet.overlay`]:

    y                   a knot of yarn y on the cell's two warps
    256 + y             the left or right half of a jufti knot of yarn y
    512 + 256 y + z     two half knots, yarn y on the left warp, yarn z on the right one

A cell without a knot has NO_KNOT in the place of its yarn. A run is a longest part of a row with one code.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ilmek.arrays import Int32
from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import NO_KNOT
from ilmek.carpet.overlay import HALF, JUFTI

SPLITS = ("runs", "colours")
"""How a row is split: into its runs, or into its colours, each once."""

DIRECTIONS = ("both", "right", "left", "alternate")
"""Directions in which a row is read: to the right, to the left, both, or odd rows right and even rows left."""

JUFTI_CODE, HALF_CODE = 256, 512
"""First codes of the two kinds of marks."""


class Run(NamedTuple):
    """A run of a row: its first cell from 0 at the left, number of cells, mark (0, HALF or JUFTI), yarn, and the second
    yarn of half knots.
    """

    first: int
    cells: int
    mark: int
    yarn: int
    second: int = 0

    @property
    def knots(self) -> int:
        """Number of knots, of half knots that of the cells."""
        return self.cells // 2 if self.mark == JUFTI else self.cells


class Span(NamedTuple):
    """Knots of one yarn beside each other: first cell from 0 at the left, number of cells, and part of a cell: "" for
    whole knots, L or R for half knots on left or right warps, j for jufti knots.
    """

    first: int
    cells: int
    part: str

    @property
    def knots(self) -> int:
        """Number of knots."""
        return self.cells // 2 if self.part == "j" else self.cells


def row_codes(chart: Chart, first: int, stop: int) -> Int32[np.ndarray, "rows columns"]:
    """The codes of the rows first to stop - 1, from 0 at the carpet's lower edge; the lowest row comes first."""
    top, bottom = chart.rows - stop, chart.rows - first
    codes = chart.knots[top:bottom].astype(np.int32)
    marks = chart.overlay.between(top, bottom)
    rows, columns, half = marks.rows - top, marks.columns, marks.kinds == HALF
    codes[rows[half], columns[half]] = HALF_CODE + 256 * codes[rows[half], columns[half]] + marks.seconds[half]
    rows, columns = rows[~half], columns[~half]
    codes[rows, columns] += JUFTI_CODE
    codes[rows, columns + 1] += JUFTI_CODE
    return np.ascontiguousarray(codes[::-1])


def runs_of(codes: Int32[np.ndarray, " columns"]) -> tuple[Run, ...]:
    """The runs of a row's codes, from left to right.

    >>> runs_of(np.array([3, 3, 258, 258, 258, 258, 516], dtype=np.int32))
    (Run(first=0, cells=2, mark=0, yarn=3, second=0), Run(first=2, cells=4, mark=2, yarn=2, second=0), \
Run(first=6, cells=1, mark=1, yarn=0, second=4))
    """
    starts = np.concatenate(([0], np.flatnonzero(np.diff(codes)) + 1))
    cells = np.diff(np.append(starts, len(codes))).tolist()
    return tuple(
        Run(first, count, *decoded(code))
        for first, count, code in zip(starts.tolist(), cells, codes[starts].tolist(), strict=True)
    )


def decoded(code: int) -> tuple[int, int, int]:
    """KnotMark (0, HALF or JUFTI), yarn and second yarn of a code."""
    if code >= HALF_CODE:
        return (HALF, *divmod(code - HALF_CODE, 256))
    return (JUFTI, code - JUFTI_CODE, 0) if code >= JUFTI_CODE else (0, code, 0)


def row_runs(chart: Chart, number: int) -> tuple[Run, ...]:
    """The runs of a row, counted from 1 at the carpet's lower edge, from left to right."""
    return runs_of(row_codes(chart, number - 1, number)[0])


def spans_by_yarn(runs: tuple[Run, ...]) -> dict[int, list[Span]]:
    """The knots of each yarn in a row, from left to right, the yarns in the order of the list."""
    found: dict[int, list[Span]] = {}
    for run in runs:
        if run.yarn == NO_KNOT:
            continue
        part = "L" if run.mark == HALF else "j" if run.mark == JUFTI else ""
        found.setdefault(run.yarn, []).append(Span(run.first, run.cells, part))
        if run.mark == HALF:
            found.setdefault(run.second, []).append(Span(run.first, run.cells, "R"))
    return dict(sorted(found.items()))


def span_text(span: Span, columns: int, rightward: bool) -> str:
    """The cells of a span as numbers from the edge where the row begins.

    >>> span_text(Span(0, 3, "L"), 10, True), span_text(Span(0, 1, ""), 10, False)
    ('1-3L', '10')
    """
    first = span.first + 1 if rightward else columns - span.first - span.cells + 1
    return f"{first}{f'-{first + span.cells - 1}' if span.cells > 1 else ''}{span.part}"


def directions(number: int, direction: str) -> Iterator[bool]:
    """The directions in which a row is read, True from left to right; `direction` of DIRECTIONS."""
    right = direction in ("both", "right") or (direction == "alternate" and number % 2 == 1)
    left = direction in ("both", "left") or (direction == "alternate" and number % 2 == 0)
    return (rightward for rightward, read in ((True, right), (False, left)) if read)
