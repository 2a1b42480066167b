"""The page of a report, for a person to read."""

from pathlib import Path

from ilmek.io.output import write_whole
from ilmek.report import Report


def write_page(path: Path | None, report: Report) -> None:
    """Write the page of a report as HTML, whole or not at all; None writes nothing. Raises OutputError.

    The figures and the templates are imported here: without a page no command needs them.
    """
    if path is not None:
        from ilmek.viz.page import machine_page

        write_whole(path, machine_page(report))
