"""Pages: self-contained HTML that opens from disk without a network, and can be printed.

The template engine escapes all texts. `machine_page` shows the report of one machine; `carpet_page` has the page of a
carpet, `loom_page` that of its loom.
"""

import re
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

import ilmek
from ilmek.errors import encodable
from ilmek.report import Report
from ilmek.sentences import DEFAULT, Sentence, headed, in_language, translated
from ilmek.viz.embedded import client
from ilmek.viz.number_format import amount, beside, cells, compared, count, fixed, number, quantity, words
from ilmek.viz.sections import PageVerdict, failures_first, judged, section, shown_first
from ilmek.viz.style import shown_unit, with_unit

TESTS = "Tests of the computation"
"""Title of the self-tests of a report."""

FIRST_CHECKS = 10
"""Number of checks that are shown at once, and all that fail: the figures are not pushed away."""

_TEMPLATES = Path(__file__).parent / "templates"


def machine_page(report: Report, left_out: list[str] | None = None, language: str = DEFAULT) -> str:
    """The page of a machine as self-contained HTML.

    left_out  list to which a warning is appended for each figure that cannot be drawn
    language  of the page's own words, the names of checks and choices; what else the report says is in its language
    """
    shown = section(1, report, [] if left_out is None else left_out)
    checks = failures_first(judged(report.all_checks, ()))
    ends = [("tests", TESTS)] if report.all_self_tests else []
    starts = shown.drawn_contents + ([("checks", "Checks")] if checks else [])
    starts += [("choices", "What was chosen")] if report.all_choices else []
    return render(
        "machine.html.j2",
        language=language,
        title=report.title,
        lead=report.lead,
        verdict=_verdict(report),
        choices=report.all_choices,
        section=shown,
        contents=[*starts, *shown.contents, *ends],
        checks=checks,
        tests=report.all_self_tests,
    )


def _verdict(report: Report) -> PageVerdict:
    loom = "weaves" in report.headline
    good = "The loom weaves its carpet." if loom else "Every check holds."
    bad = "The loom cannot weave its carpet." if loom else "Not every check holds."
    return PageVerdict(good, bad, len(report.all_checks), report.reasons, nearest=report.nearest)


def render(template: str, **values: object) -> str:
    """The page of a template, its own words in the `language` among the values; English without one."""
    with in_language(str(values.setdefault("language", DEFAULT))):
        return encodable(_environment().get_template(template).render(version=ilmek.__version__, **values))


def sentence(key: str, **values: object) -> str:
    """A sentence of the catalogue in the language that is spoken."""
    return translated(Sentence(key, **values))


def _squeezed(style: str) -> str:
    r"""A style sheet without the spaces that it does not need.

    >>> _squeezed("a, p :hover { color: red; }\n@media print { b { top: 0 } }")
    'a,p :hover{color:red;}@media print{b{top:0}}'
    """
    return re.sub(r"\s*([{};,])\s*|(?<=[a-z]:)\s+", r"\1", style.strip())


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
        "cells": cells,
        "compared": compared,
        "beside": beside,
        "first_checks": shown_first,
        "unit": shown_unit,
        "with_unit": with_unit,
        "squeezed": _squeezed,
    }
    environment.filters.update(filters)
    environment.globals.update(client=client, first_checks=FIRST_CHECKS, tests_title=TESTS, sentence=sentence, _=headed)
    return environment
