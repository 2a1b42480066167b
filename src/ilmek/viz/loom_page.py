"""The page of a loom that weaves a carpet: its machines with figures, results and checks, and what was chosen."""

from dataclasses import dataclass

from ilmek.progress import SILENT, Progress
from ilmek.report import Check, Choice, Report, reasons
from ilmek.viz.page import render
from ilmek.viz.sections import PageVerdict, failures_first, judged, section

GOOD, BAD = "The loom weaves this carpet.", "The loom cannot weave this carpet, and there is no programme."


@dataclass(frozen=True, slots=True)
class LoomInSpace:
    """The picture of a loom in space: the client that draws it and the scene's data, both compressed, as base64."""

    client: str
    data: str


@dataclass(frozen=True, slots=True)
class LoomPage:
    """Contents of the page of a loom.

    title, lead  heading and the line below it
    back         the page of the carpet
    reports      the loom and its machines, in the order of the page
    checks       checks that belong to no machine
    warnings     warnings that belong to no machine
    choices      what the loom chose of what was left open
    nearest      carpets that the loom could weave, in words, where it cannot weave this one
    space        the picture in space; default: none
    """

    title: str
    lead: str
    back: str
    reports: tuple[Report, ...] = ()
    checks: tuple[Check, ...] = ()
    warnings: tuple[str, ...] = ()
    choices: tuple[Choice, ...] = ()
    nearest: str = ""
    space: LoomInSpace | None = None


def loom_page(page: LoomPage, left_out: list[str] | None = None, progress: Progress = SILENT) -> str:
    """The page of a loom as self-contained HTML.

    left_out  list to which a warning is appended for each figure that cannot be drawn
    """
    left_out = [] if left_out is None else left_out
    sections = []
    for index, report in enumerate(page.reports, 1):
        sections.append(section(index, report, left_out))
        progress(index / len(page.reports))
    checks = judged(page.checks, page.reports)
    of_machines = (f"{report.title}: {warning}" for report in page.reports for warning in report.warnings)
    return render(
        "loom.html.j2",
        title=page.title,
        lead=page.lead,
        back=page.back,
        verdict=PageVerdict(GOOD, BAD, len(checks), reasons(check.named for check in checks), nearest=page.nearest),
        choices=page.choices,
        warnings=[*page.warnings, *of_machines, *left_out],
        sections=sections,
        space=page.space,
        checks=failures_first(checks),
    )
