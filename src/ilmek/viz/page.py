"""Reports as self-contained HTML pages: they open from disk without a network, and can be printed.

`machine_page` shows a machine's report, `carpet_page` a carpet with its loom. The template engine escapes all texts;
figures come from `svg`, pictures from `carpet_picture`.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

import ilmek
from ilmek.carpet.bill import YarnBill
from ilmek.carpet.chart import Chart
from ilmek.errors import encodable
from ilmek.progress import SILENT, Progress
from ilmek.report import Animation, Check, Choice, Figure, Reason, Report, Timing, in_words, reasons
from ilmek.report.left_out import made_or_left_out
from ilmek.viz.animation import SECONDS
from ilmek.viz.number_format import amount, cells, count, fixed, number, quantity, sign, words
from ilmek.viz.page_parts import Fact, FileNote, carpet_facts, pictures, yarn_lines
from ilmek.viz.style import shown_unit, with_unit
from ilmek.viz.svg import svg

_TEMPLATES = Path(__file__).parent / "templates"


@dataclass(frozen=True, slots=True)
class CarpetPage:
    """Contents of the page of a carpet.

    title, lead    heading and the line below it
    chart, bill    the carpet and its yarn
    symbols        the symbol of each yarn of `chart.yarns` in the printed chart; default: none
    facts          further entries of the summary, after knots, colours and yarn (heads, weaving time, deadline)
    reports        the machines, in the order of the page
    checks         checks that belong to no machine
    files          the other files of the folder
    warnings       warnings, and notes on changes made to the picture
    choices        what the loom chose of what was left open
    nearest        carpets that the loom could weave, in words, where it cannot weave this one
    """

    title: str
    lead: str
    chart: Chart
    bill: YarnBill
    symbols: str = ""
    facts: tuple[Fact, ...] = ()
    reports: tuple[Report, ...] = ()
    checks: tuple[Check, ...] = ()
    files: tuple[FileNote, ...] = ()
    warnings: tuple[str, ...] = ()
    choices: tuple[Choice, ...] = ()
    nearest: str = ""


@dataclass(frozen=True, slots=True)
class _Verdict:
    """The verdict at the top of a page: its sentences, the number of checks, the reasons where it is no."""

    good: str
    bad: str
    checks: int
    reasons: tuple[Reason, ...]
    nearest: str = ""


@dataclass(frozen=True, slots=True)
class _Drawn:
    """A figure and its SVG. Kinds: "", "wide" (whole width), "moves" (animated), "wide timed" (with a cursor)."""

    figure: Figure
    svg: Markup
    kind: str


@dataclass(frozen=True, slots=True)
class _Section:
    """A machine's part of a page."""

    id: str
    report: Report
    figures: tuple[_Drawn, ...]


@dataclass(frozen=True, slots=True)
class _Judged:
    """A check and the machine it belongs to."""

    machine: str
    check: Check


def carpet_page(page: CarpetPage, left_out: list[str] | None = None, progress: Progress = SILENT) -> str:
    """The page of a carpet as self-contained HTML.

    left_out  list to which a warning is appended for each figure and picture that cannot be drawn
    """
    left_out = [] if left_out is None else left_out
    shown = pictures(page.chart, left_out, progress.part(0.0, 0.5))
    sections = []
    for index, report in enumerate(page.reports, 1):
        sections.append(_section(index, report, left_out))
        progress(0.5 + 0.5 * index / len(page.reports))
    judged = [_Judged("", check) for check in page.checks]
    judged += [_Judged(report.title, check) for report in page.reports for check in report.checks]
    warnings = [*page.warnings, *(f"{r.title}: {warning}" for r in page.reports for warning in r.warnings), *left_out]
    return _render(
        "carpet.html.j2",
        title=page.title,
        lead=page.lead,
        facts=carpet_facts(page.chart, page.bill, page.facts, [one.check for one in judged]),
        verdict=_Verdict(
            "The loom weaves this carpet.",
            "The loom cannot weave this carpet, and there is no programme.",
            len(judged),
            reasons(_named(one) for one in judged),
            page.nearest,
        ),
        choices=page.choices,
        warnings=warnings,
        pictures=shown,
        yarn=yarn_lines(page.chart, page.bill, page.symbols),
        bill=page.bill,
        length=sum(need.length for need in page.bill.needs),
        priced=any(need.price is not None for need in page.bill.needs),
        sections=sections,
        moves=any(_holds(section, "moves") for section in sections),
        timed=any(_holds(section, "wide timed") for section in sections),
        checks=_failures_first(judged),
        files=page.files,
    )


def machine_page(report: Report, left_out: list[str] | None = None) -> str:
    """The page of a machine as self-contained HTML; `left_out` as of `carpet_page`."""
    section = _section(1, report, [] if left_out is None else left_out)
    return _render(
        "machine.html.j2",
        title=report.title,
        lead="",
        verdict=_machine_verdict(report),
        choices=report.all_choices,
        section=section,
        moves=_holds(section, "moves"),
        timed=_holds(section, "wide timed"),
        checks=_failures_first([_Judged(report.title, check) for check in report.all_checks]),
    )


def _machine_verdict(report: Report) -> _Verdict:
    loom = "weaves" in report.headline
    good = "The loom weaves its carpet." if loom else "Every check holds."
    bad = "The loom cannot weave its carpet." if loom else "Not every check holds."
    return _Verdict(good, bad, len(report.all_checks), report.reasons, report.nearest)


def _section(index: int, report: Report, left_out: list[str]) -> _Section:
    return _Section(f"m{index}", report, tuple(_drawn(figure, left_out) for figure in report.figures))


def _drawn(figure: Figure, left_out: list[str]) -> _Drawn:
    """A figure, or where it cannot be drawn the reason in its place."""
    drawn = made_or_left_out(f"figure {figure.title!r}", lambda: svg(figure), left_out)
    if drawn is None:
        return _Drawn(figure, Markup("<p>{}</p>").format(left_out[-1]), "")
    return _Drawn(figure, Markup(drawn), _kind(figure))


def _kind(figure: Figure) -> str:
    if isinstance(figure, Timing):
        return "wide timed" if figure.laws else "wide"
    return "moves" if isinstance(figure, Animation) else ""


def _holds(section: _Section, kind: str) -> bool:
    return any(drawn.kind == kind for drawn in section.figures)


def _named(judged: _Judged) -> Check:
    """The check with its machine's title before its name."""
    return replace(judged.check, name=f"{judged.machine}: {judged.check.name}") if judged.machine else judged.check


def _failures_first(judged: Sequence[_Judged]) -> list[_Judged]:
    return sorted(judged, key=lambda one: one.check.ok)


def _render(template: str, **values: object) -> str:
    return encodable(_environment().get_template(template).render(version=ilmek.__version__, **values))


@lru_cache(maxsize=1)
def _environment() -> Environment:
    """The template engine: all texts are escaped, a missing name is an error."""
    environment = Environment(
        loader=FileSystemLoader(_TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    filters: Mapping[str, object] = {
        "number": number,
        "quantity": quantity,
        "count": count,
        "fixed": fixed,
        "amount": amount,
        "words": words,
        "sign": sign,
        "cells": cells,
        "judged": in_words,
        "unit": shown_unit,
        "with_unit": with_unit,
    }
    environment.filters.update(filters)
    environment.globals["seconds"] = SECONDS
    return environment
