"""The page of a factory's plan: Gantt picture, orders, what would save late ones, yarn to buy."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from markupsafe import Markup

from ilmek.report import Check, reasons
from ilmek.viz.page import render
from ilmek.viz.page_parts import Fact, FileNote
from ilmek.viz.plan_picture import PlanChart, draw_plan
from ilmek.viz.sections import PageVerdict
from ilmek.viz.style import FONTS

GOOD, BAD = "Every order is in time.", "Not every order is in time."


@dataclass(frozen=True, slots=True)
class PlanTable:
    """A table of texts: title, headings, rows; indices of the columns of numbers."""

    title: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    numbers: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class PlanPage:
    """Contents of the page of a plan.

    lead    line below the heading              facts     summary
    chart   Gantt picture; None without any     checks    of every order
    tables  in the order of the page            files     of the folder
    """

    lead: str
    facts: tuple[Fact, ...]
    chart: PlanChart | None
    checks: tuple[Check, ...]
    tables: tuple[PlanTable, ...] = ()
    warnings: tuple[str, ...] = ()
    files: Sequence[FileNote] = field(default=())


def plan_svg(chart: PlanChart) -> str:
    """The picture of a plan as the text of an `<svg>` element."""
    return draw_plan(chart).svg(chart.title, FONTS)


def plan_page(page: PlanPage) -> str:
    """The page of a plan as self-contained HTML."""
    return render(
        "plan.html.j2",
        title="Plan of the factory",
        lead=page.lead,
        page=page,
        picture=None if page.chart is None else Markup(plan_svg(page.chart)),
        verdict=PageVerdict(GOOD, BAD, len(page.checks), reasons(page.checks)),
    )
