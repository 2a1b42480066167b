"""A report on a terminal: results, brief tables, checks."""

import math
from collections.abc import Sequence

from ilmek.cli.language import worded
from ilmek.cli.terminal import say, show_checks, show_table
from ilmek.cli.verdict import CHECKS, WEAVES, show_verdict
from ilmek.errors import ParameterError
from ilmek.report import Check, Choice, Column, Report, Table, result_text, rounded
from ilmek.sentences import Sentence
from ilmek.units import format_number, from_si, printed_unit


def headline_of(report: Report) -> str:
    """The headline of a report's verdict."""
    return WEAVES if WEAVES in report.headline else CHECKS


def show_report(report: Report) -> None:
    """Print the verdict with its reasons, results, brief tables, choices and checks."""
    say(worded(report.title))
    show_verdict(report.all_checks, headline_of(report), report.nearest)
    shown = [(r.name, result_text(r.value, r.unit), r.meaning) for r in report.results if r.shown]
    show_table(("result", "value", "meaning"), shown, right=(1,), words=(2,))
    more = [result.name for result in report.results if not result.shown]
    more += [f"{child.key}.*" for child in report.children]
    if more:
        say(Sentence("terminal.with-json", names=", ".join(more)))
    for table in report.tables:
        if table.brief:
            show_report_table(table)
    if report.all_choices:
        show_choices(report.all_choices)
    if report.all_checks:
        show_checks(report.all_checks)
    show_self_tests(report.all_self_tests)


def tables_named(report: Report, name: str) -> tuple[Table, ...]:
    """The tables of a report with a name, or a name that ends so: `cost` of `loom-cost`.

    Raises ParameterError, naming all tables, where there is none.
    """
    tables = tuple(table for table in report.tables if f"-{table.name}".endswith(f"-{name}"))
    if tables:
        return tables
    names = ", ".join(table.name for table in report.tables) or "none"
    raise ParameterError(f"no table {name!r} in the report of {report.machine}", allowed=f"its tables: {names}")


def show_self_tests(tests: Sequence[Check]) -> None:
    """Print the tests of the computation in one line: how many pass, or those that do not; nothing without tests."""
    failed = [test.name for test in tests if not test.ok]
    if failed:
        say(Sentence("terminal.tests-failed", failed=len(failed), count=len(tests), names="; ".join(failed)))
    elif tests:
        say(Sentence("terminal.tests-one" if len(tests) == 1 else "terminal.tests", count=len(tests)))


def show_choices(choices: Sequence[Choice]) -> None:
    """Print what was chosen of what was left open, and why nothing cheaper was."""
    rows = [(choice.name, choice.chosen, choice.decided_by, choice.next_cheaper, choice.failed) for choice in choices]
    show_table(("choice", "chosen", "decided by", "next cheaper", "fails"), rows, words=(2, 4))


def show_report_table(table: Table) -> None:
    """Print a table of the report, numbers in the units of their columns."""
    say(worded(table.title))
    units = [printed_unit(column.unit) for column in table.columns]
    headings = [
        f"{worded(column.heading)} ({unit})" if unit else column.heading
        for column, unit in zip(table.columns, units, strict=True)
    ]
    rows = [[cell_text(cell, column) for cell, column in zip(row, table.columns, strict=True)] for row in table.rows]
    show_table(headings, rows)


def cell_text(cell: float | int | str, column: Column) -> str:
    """A cell without its unit, which is in the heading; rounding noise is 0."""
    if isinstance(cell, str):
        return cell
    if isinstance(cell, float):
        cell = rounded(cell, column.unit)
    return format_number(from_si(cell, column.unit), column.digits) if math.isfinite(cell) else "–"
