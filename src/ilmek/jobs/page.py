"""The HTML page of a report."""

from ilmek.report import Report
from ilmek.report.left_out import made_or_left_out


def page_text(report: Report, left_out: list[str]) -> str | None:
    """A report as HTML; None if it cannot be made. A warning for each part that is left out is added to `left_out`.

    Figures and templates are imported here, because only a page needs them.
    """
    from ilmek.viz.page import machine_page

    return made_or_left_out("the report page", lambda: machine_page(report, left_out), left_out)
