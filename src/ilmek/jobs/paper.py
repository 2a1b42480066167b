"""What was read from squared paper: results, notes, and the page on which doubtful cells are corrected."""

from typing import Any

from ilmek.carpet.chart import Chart
from ilmek.units import counted

PAPER_PAGE = "paper.html"


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


def paper_results(chart: Chart) -> dict[str, Any] | None:
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
