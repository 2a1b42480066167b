"""The page of a carpet: verdict, summary, pictures, yarn, statistics, files. Its loom has a page of its own."""

import numpy as np

from ilmek.arrays import Rgb
from ilmek.carpet.bill import YarnBill
from ilmek.carpet.chart import Chart
from ilmek.carpet.proposal import MatchedShade
from ilmek.carpet.statistics import ChartStatistics, PatchGroup
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.report import Axis, Check, Plot, Series, reasons
from ilmek.units import counted
from ilmek.viz.carpet_picture import DrawnCarpet
from ilmek.viz.number_format import count, fixed
from ilmek.viz.page import render
from ilmek.viz.page_parts import Fact, FileNote, carpet_facts, yarn_lines
from ilmek.viz.page_pictures import cut_picture, pictures
from ilmek.viz.sections import PageVerdict, drawn

_FIRST_REASONS = 3
"""Number of reasons that are shown at once: the carpet is not pushed out of the screen."""

_DENSE = 24
"""Number of yarns beyond which the lines of their table are set closer."""

_BARS = 500
"""Largest number of points of the figure over the rows."""


@record
class CarpetPage:
    """Contents of the page of a carpet.

    title, lead    heading and the line below it
    chart, bill    the carpet and its yarn
    statistics     of the chart
    symbols        the symbol of each yarn of `chart.yarns` in the printed chart; default: none
    source         the picture as fitted to the carpet; default: not shown
    whole          the picture before it was cropped to the carpet's proportions; default: it was not
    reading        how the picture was read: label, value and note of each line
    facts          further entries of the summary, after knots, colours and yarn (heads, weaving time, deadline)
    making         steps of making: name, time and cost of each, as shown
    good, bad      sentence where every check holds; where not
    checks         all checks, those of machines with the machine's name
    files          the files of the folder
    warnings       warnings, and notes on changes made to the picture
    loom           the page of the loom; default: none
    nearest        carpets that the loom could weave, in words, where it cannot weave this one
    proposed       shades proposed from the picture
    drawn          the carpet as drawn for carpet.png; default: it is drawn here
    """

    title: str
    lead: str
    chart: Chart
    bill: YarnBill
    statistics: ChartStatistics
    symbols: str = ""
    source: Rgb | None = None
    whole: Rgb | None = None
    reading: tuple[Fact, ...] = ()
    facts: tuple[Fact, ...] = ()
    making: tuple[tuple[str, str, str], ...] = ()
    good: str = "Every check holds."
    bad: str = "Not every check holds."
    checks: tuple[Check, ...] = ()
    files: tuple[FileNote, ...] = ()
    warnings: tuple[str, ...] = ()
    loom: str = ""
    nearest: str = ""
    proposed: tuple[MatchedShade, ...] = ()
    drawn: DrawnCarpet | None = None


def carpet_page(page: CarpetPage, left_out: list[str] | None = None, progress: Progress = SILENT) -> str:
    """The page of a carpet as self-contained HTML.

    left_out  list to which a warning is appended for each figure and picture that cannot be drawn
    """
    left_out = [] if left_out is None else left_out
    shown = pictures(
        page.chart, page.source, page.symbols, left_out, drawn=page.drawn, progress=progress.part(0.0, 0.8)
    )
    rows = drawn(_row_figure(page.statistics), left_out)
    lines = yarn_lines(page.chart, page.bill, page.symbols)
    progress(0.9)
    return render(
        "carpet.html.j2",
        title=page.title,
        lead=page.lead,
        verdict=PageVerdict(
            page.good, page.bad, len(page.checks), reasons(page.checks), _FIRST_REASONS, nearest=page.nearest
        ),
        facts=carpet_facts(page.chart, page.bill, page.facts, page.checks),
        warnings=[*page.warnings, *left_out],
        shown=shown,
        cut=None if page.whole is None else cut_picture(page.whole, page.chart.reading.fit, left_out),
        reading=page.reading,
        proposed=page.proposed,
        yarn=lines,
        dense=len(lines) > _DENSE,
        bill=page.bill,
        length=sum(need.length for need in page.bill.needs),
        to_buy=sum(need.to_buy for need in page.bill.needs),
        rows=rows,
        statistics=page.statistics,
        statistic_lines=_statistic_lines(page.statistics),
        files=page.files,
        loom=page.loom,
        making=page.making,
    )


def _statistic_lines(statistics: ChartStatistics) -> list[Fact]:
    rows = ", ".join(f"{count(row)} ({count(statistics.of_row(row))})" for row in statistics.hardest)
    patches = ", ".join(f"{count(patch.patches)} of {_sizes(patch)}" for patch in statistics.patches)
    return [
        Fact("Changes of colour in a row", fixed(statistics.mean_changes, 1.0, 1), "mean over the rows"),
        Fact("Hardest rows", rows or "none", "row, from the lower edge (changes)"),
        Fact("Small patches", patches, "of knots of one yarn that touch, also at a corner"),
    ]


def _sizes(group: PatchGroup) -> str:
    if group.least == group.most:
        return counted(group.most, "knot")
    return f"{group.least} to {group.most} knots"


def _row_figure(found: ChartStatistics) -> Plot:
    """Changes of colour over the rows; of many rows the mean and the largest of each group of rows."""
    x, y = Axis("row, from the lower edge"), Axis("changes of colour")
    rows, group = len(found.changes), -(-len(found.changes) // _BARS)
    title = "Changes of colour in each row"
    if group == 1:
        return Plot("row_changes", title, x, y, (Series("", np.arange(1.0, rows + 1), found.changes.astype(float)),))
    starts = np.arange(0, rows, group)
    sizes = np.diff(np.append(starts, rows))
    middle = starts + (sizes + 1) / 2
    most = np.maximum.reduceat(found.changes, starts).astype(float)
    mean = np.add.reduceat(found.changes, starts) / sizes
    note = f"Largest and mean of every {group} rows."
    return Plot("row_changes", title, x, y, (Series("largest", middle, most), Series("mean", middle, mean)), note=note)
