"""The HTML page of a report."""

from pathlib import Path

from ilmek.io.output import write_whole
from ilmek.report import Report


def write_page(path: Path | None, report: Report) -> None:
    """Write a report as HTML. Nothing is written for `path` None or on an error. Raises OutputError.

    Figures and templates are imported here, because only a page needs them.
    """
    if path is not None:
        from ilmek.viz.page import machine_page

        write_whole(path, machine_page(report))
