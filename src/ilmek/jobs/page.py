"""The HTML page of a report."""

from ilmek.report import Report


def page_text(report: Report) -> str:
    """A report as HTML. Figures and templates are imported here, because only a page needs them."""
    from ilmek.viz.page import machine_page

    return machine_page(report)
