"""The rows to weave by, and the chart on one sheet: which of these files are written, and their writing."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from ilmek.carpet.chart import Chart
from ilmek.io.chart.printing import PLAIN, Printing
from ilmek.io.chart.rows_colours_pdf import colour_pages, write_colours_pdf
from ilmek.io.chart.rows_pdf import chart_rows_layout, write_rows_pdf
from ilmek.io.chart.rows_text import write_rows_text
from ilmek.io.chart.wall import wall_sheet, write_wall_pdf
from ilmek.jobs.order import MOST_PRINTED, MOST_SHEETS, CarpetOrder
from ilmek.progress import SILENT, Progress
from ilmek.report.left_out import made_or_left_out
from ilmek.units import format_number

MOST_ROW_KNOTS = 5_000_000
"""Largest number of knots of which rows are written by default."""


@dataclass(frozen=True, slots=True)
class RowsPlan:
    """Which files are written for the weaver beside the chart.

    split  runs, colours or none      pages  of rows.pdf with rows      notes  on files that are left out
    """

    split: str
    pages: int
    names: tuple[str, ...]
    notes: tuple[str, ...]


def rows_plan(chart: Chart, order: CarpetOrder) -> RowsPlan:
    """What is written for a chart: what the order requires, else what is not too large; no rows.pdf with --no-pdf."""
    files = order.files
    names = ["wall.pdf"] if files.wall else []
    notes = []
    if files.wall:
        notes.append(_wall_note(chart))
    split = files.rows or ("runs" if chart.knots.size <= MOST_ROW_KNOTS else "none")
    if split == "none":
        if files.rows is None:
            notes.append(f"the rows of {chart.knots.size:,} knots are left out; --rows runs writes them")
        return RowsPlan(split, 0, tuple(names), tuple(notes))
    if order.pdf is False:
        return RowsPlan(split, 0, (*names, "rows.txt"), tuple(notes))
    most = MOST_SHEETS if files.rows is None else MOST_PRINTED
    pages = _pages(chart, split, files.rows_direction, most)
    if pages <= most:
        names.append("rows.pdf")
    else:
        remedy = f"--rows {split} writes it" if pages <= MOST_PRINTED else f"at most {MOST_PRINTED:,} are written"
        notes.append(f"rows.pdf would have more than {most:,} pages and is left out; {remedy}")
    return RowsPlan(split, pages, (*names, "rows.txt"), tuple(notes))


def _wall_note(chart: Chart) -> str:
    sheet = wall_sheet(chart)
    width, length = (format_number(100 * side, 3) for side in sheet.lengths)
    smaller = f"; a viewer that ignores its unit of {sheet.unit} points shows it {sheet.unit} times smaller"
    return f"wall.pdf is {width} × {length} cm{smaller if sheet.unit > 1 else ''}"


def _pages(chart: Chart, split: str, direction: str, most: int) -> int:
    """Pages of rows.pdf with rows; those split by colours are counted up to `most` + 1."""
    if split == "colours":
        return sum(1 for _ in islice(colour_pages(chart, direction), most + 1))
    return chart_rows_layout(chart, direction).count


def write_rows(
    chart: Chart,
    order: CarpetOrder,
    folder: Path,
    left_out: list[str],
    progress: Progress = SILENT,
    *,
    printing: Printing = PLAIN,
) -> tuple[str, ...]:
    """Write the files of `rows_plan` into a folder; returns their names. A PDF that cannot be made is added to
    `left_out`. Raises OSError.
    """
    plan, direction = rows_plan(chart, order), order.files.rows_direction
    parts = iter(
        progress.part(share, share + 0.3, name) for share, name in zip((0.0, 0.35, 0.7), plan.names, strict=False)
    )

    def make(name: str, part: Progress) -> Callable[[], None]:
        path = folder / name
        if name == "wall.pdf":
            return lambda: write_wall_pdf(path, chart, part, printing=printing)
        if name == "rows.txt":
            return lambda: write_rows_text(path, chart, plan.split, direction, part, printing=printing)
        if plan.split == "colours":
            return lambda: write_colours_pdf(path, chart, direction, plan.pages, part, printing=printing)
        return lambda: write_rows_pdf(path, chart, direction, part, printing=printing)

    written = []
    for name, part in zip(plan.names, parts, strict=True):
        before = len(left_out)
        made_or_left_out(name, make(name, part), left_out)
        if len(left_out) > before:
            (folder / name).unlink(missing_ok=True)
        else:
            written.append(name)
    return tuple(written)
