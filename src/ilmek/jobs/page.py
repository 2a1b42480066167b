"""The HTML page of a report."""

from ilmek.jobs.studio.words import spoken
from ilmek.report import Report
from ilmek.report.left_out import made_or_left_out
from ilmek.sentences import DEFAULT, in_language


def page_text(report: Report, left_out: list[str], language: str = DEFAULT) -> str | None:
    """A report as HTML in a language; None if it cannot be made. A warning for each part that is left out is added to
    `left_out`.

    Figures and templates are imported here, because only a page needs them.
    """
    from ilmek.viz.page import machine_page

    with in_language(language):
        said = spoken(report)
    return made_or_left_out("the report page", lambda: machine_page(said, left_out, language), left_out)
