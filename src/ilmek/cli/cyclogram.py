"""`ilmek cyclogram`: a cyclogram from a file, checked, optimised, tabulated and drawn."""

from pathlib import Path

import click

from ilmek.cli.options import json_option
from ilmek.cli.settings import read_settings
from ilmek.cli.terminal import check_json, give_json, note, passed, progress_bar, say, show_checks, show_table
from ilmek.errors import ParameterError
from ilmek.io.cyclogram_file import write_cyclogram
from ilmek.io.output import check_file, write_whole
from ilmek.io.table_csv import csv_text
from ilmek.jobs.cyclogram import GOALS, binding_words, columns, find, report, solve
from ilmek.jobs.page import write_page
from ilmek.report import Report
from ilmek.timing.solver import Solution
from ilmek.units import format_number, format_quantity

EXAMPLES = """\b
Examples:
  ilmek cyclogram examples/press.toml
  ilmek cyclogram examples/press.toml --solve acceleration --report press.html
  ilmek cyclogram examples/press.toml --solve period --out quick.toml
  ilmek cyclogram examples/press.toml --csv motions.csv --steps 720
  ilmek cyclogram examples/press.toml --solve period --json -
  ilmek cyclogram weaver --solve acceleration
  ilmek cyclogram automated-loom:row --set heads=4 --out row.toml
"""


@click.command(epilog=EXAMPLES)
@click.argument("file", metavar="FILE|MACHINE")
@click.option("--set", "settings", multiple=True, metavar="NAME=VALUE", help="Set a parameter of the machine.")
@click.option("--solve", "goal", type=click.Choice(tuple(GOALS)), help="Minimise peak acceleration or cycle time.")
@click.option("--report", "page_to", type=click.Path(path_type=Path), metavar="FILE.html", help="Write a report page.")
@click.option("--csv", "csv_to", metavar="-|FILE", help="Write all motions as CSV; - writes to standard output.")
@click.option(
    "--steps",
    type=click.IntRange(1, 1_000_000),
    default=360,
    show_default=True,
    help="Steps of the CSV table per turn.",
)
@click.option(
    "--out",
    "file_to",
    type=click.Path(path_type=Path),
    metavar="FILE.toml",
    help="Write the cyclogram, as given or solved.",
)
@json_option
def command(
    *,
    file: str,
    settings: tuple[str, ...],
    goal: str | None,
    page_to: Path | None,
    csv_to: str | None,
    steps: int,
    file_to: Path | None,
    json_to: str | None,
) -> None:
    """Check the cyclogram of FILE (TOML or JSON) or of a MACHINE; with --solve, retime its motions."""
    _check_outputs(csv_to, page_to, file_to, json_to)
    given = find(file, read_settings(settings))
    with progress_bar() as progress:
        solution = solve(given, goal, progress) if goal else None
    found = solution.cyclogram if solution else given
    shown = report(found, solution)
    write_page(page_to, shown)
    if file_to is not None:
        write_cyclogram(file_to, found)
    table = csv_text(columns(found, steps)) if csv_to else ""
    quiet = give_json(json_to, shown.as_json()) if json_to else False
    if csv_to == "-":
        click.echo(table, nl=False)
    elif csv_to:
        write_whole(Path(csv_to), table)
    if not quiet and csv_to != "-":
        _show(shown, solution)
        for kind, path in (("report", page_to), ("cyclogram", file_to), ("table", csv_to)):
            if path is not None:
                say(f"{kind}: {path}")
    elif shown.failed:
        note(f"checks: {passed(shown.checks)}")


def _check_outputs(csv_to: str | None, page_to: Path | None, file_to: Path | None, json_to: str | None) -> None:
    """Raise before any work if an output cannot be written or two outputs share standard output."""
    check_json(json_to)
    if csv_to == json_to == "-":
        raise ParameterError("both --csv and --json go to standard output", do="give one of them a file")
    if file_to is not None and file_to.suffix.lower() not in (".toml", ".json"):
        raise ParameterError(f"--out {file_to} ends in {file_to.suffix!r}", allowed=".toml or .json")
    for path in (page_to, file_to, Path(csv_to) if csv_to not in (None, "-") else None):
        if path is not None:
            check_file(path)


def _show(shown: Report, solution: Solution | None) -> None:
    """Print motions, checks, and the result of the solver."""
    say(shown.title)
    for table in shown.tables:
        if table.name != "binding":
            rows = [tuple(_cell(cell) for cell in row) for row in table.rows]
            show_table([column.heading for column in table.columns], rows)
    if shown.checks:
        show_checks(shown.checks)
    if solution is not None:
        before, after = (format_quantity(value, solution.unit) for value in (solution.before, solution.after))
        times = format_number(solution.before / solution.after, 3)
        say(f"{solution.measure}: {before} -> {after}, {times} times less; least for this order")
        say("binding constraints, in the order of the turn:")
        for line in binding_words(solution):
            say(f"  {line}")


def _cell(cell: float | int | str) -> str:
    return cell if isinstance(cell, str) else format_quantity(cell, "deg")
