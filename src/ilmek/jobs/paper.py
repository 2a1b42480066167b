"""What was read from squared paper: results, notes, and the page on which doubtful cells are corrected."""

from ilmek.carpet.chart import Chart
from ilmek.carpet.paper.cells import MOST_ALTERNATING
from ilmek.carpet.paper.sheet import PaperReading
from ilmek.report import Check, Json
from ilmek.report.check import at_most
from ilmek.sentences import Sentence
from ilmek.units import counted

PAPER_PAGE = "paper.html"

MOST_BEYOND, MOST_BEYOND_OPEN, LEAST_END = 0.35, 0.03, 0.93
"""Largest share of the cells beside a grid in which lines may go on: where its last lines are there, and where there is
less than LEAST_END of one."""

MOST_BESIDE = 0.5
"""Largest share of a side beside which a colour of the drawing goes on in whole cells."""

MOST_UNEVEN = 0.18
"""Largest distance of a line from where a smooth sheet has it, of the pitch: a line too many or too few gives more."""

MOST_ON_EVERY_SECOND = 0.95
"""Largest share of the changes of colour on every second line: all are there where each cell was taken for four."""

MOST_DOUBTFUL = 0.1
"""Largest share of doubtful cells: a picture with more is no sheet, or one that is better drawn again."""


def paper_checks(chart: Chart) -> tuple[Check, ...]:
    """The checks of the sheet that a chart was read from; none: it was not."""
    paper = chart.reading.paper
    return () if paper is None else reading_checks(paper)


def reading_checks(paper: PaperReading) -> tuple[Check, ...]:
    """Whether most cells are sure; unless the grid was stated, whether lines and drawing end where it ends, its lines
    are even, all of them are there, and its cells are no quarters of cells.
    """
    rows, columns = paper.grid
    doubts, grid = paper.doubts / paper.numbers.size, {"columns": columns, "rows": rows}
    cure = Sentence("check.paper-doubtful-cure", **grid)
    sure = _at_most("doubtful", doubts, MOST_DOUBTFUL, cure)
    if paper.stated:
        return (sure,)
    cells, cure = paper.cells, Sentence("check.paper-cure", **grid)
    ends = _at_most("beyond", cells.beyond, MOST_BEYOND if cells.end >= LEAST_END else MOST_BEYOND_OPEN, cure)
    whole = _at_most("beside", paper.beside, MOST_BESIDE, cure)
    even = _at_most("uneven", cells.uneven, MOST_UNEVEN, cure)
    every = _at_most("alternating", cells.alternating, MOST_ALTERNATING, cure)
    single = _at_most("second", paper.on_every_second, MOST_ON_EVERY_SECOND, cure)
    return sure, ends, whole, even, every, single


def _at_most(name: str, share: float, limit: float, cure: str) -> Check:
    """A check of a share by its key."""
    key = f"check.paper-{name}"
    return at_most(Sentence(key), share, limit, "%", Sentence(f"{key}-source")).with_cure(cure)


def paper_files(chart: Chart) -> tuple[str, ...]:
    """The file of the page: where a sheet was read that has the chart's grid and doubtful cells."""
    paper = chart.reading.paper
    shown = paper is not None and paper.doubts > 0 and paper.grid == chart.knots.shape
    return (PAPER_PAGE,) if shown else ()


def paper_notes(chart: Chart) -> tuple[str, ...]:
    """A note on the doubtful cells."""
    paper = chart.reading.paper
    if paper is None or not paper.doubts:
        return ()
    doubts = counted(paper.doubts, "cell")
    return (f"{doubts} of the squared paper may be wrong: the folder's {PAPER_PAGE} shows picture and reading",)


def paper_results(chart: Chart) -> dict[str, Json] | None:
    """The JSON of a sheet: its grid and its doubtful cells; None: no sheet was read.

    Rows are counted from 1 at the lower edge, columns from 1 at the left, as in edits.
    """
    paper = chart.reading.paper
    if paper is None:
        return None
    rows, columns = paper.grid
    shown = [
        {"row": rows - row, "column": column + 1, "confidence": float(paper.confidence[row, column])}
        for row, column in paper.shown.tolist()
    ]
    return {"rows": rows, "columns": columns, "doubtful": paper.doubts, "cells": shown}
