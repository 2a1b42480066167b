"""`ilmek cyclogram`: a cyclogram from a file, checked, optimised, tabulated and drawn."""

from functools import partial
from pathlib import Path

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.language import worded
from ilmek.cli.options import file_option, force_option, json_option
from ilmek.cli.settings import read_settings, setting_files
from ilmek.cli.terminal import say, show_checks, show_table
from ilmek.cli.verdict import exit_code, note_verdict, show_verdict
from ilmek.io.cyclogram_file import cyclogram_writer
from ilmek.io.table_csv import MOST_NUMBERS, csv_text
from ilmek.jobs.cyclogram import GOALS, binding_words, columns, find, report, solve
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

Limits: file 250 kB; 50 tracks, 100 motions, 200 events, relations, exclusions; 2,000,000 numbers in a table.
"""


@click.command(epilog=EXAMPLES)
@click.argument("file", metavar="FILE|MACHINE")
@click.option("--set", "settings", multiple=True, metavar="NAME=VALUE", help="Set a parameter of the machine.")
@click.option("--solve", "goal", type=click.Choice(tuple(GOALS)), help="Minimise peak acceleration or cycle time.")
@click.option("--report", "page_to", type=click.Path(path_type=Path), metavar="FILE.html", help="Write a report page.")
@click.option("--csv", "csv_to", metavar="-|FILE", help="Write all motions as CSV; - writes to standard output.")
@click.option(
    "--steps",
    type=click.IntRange(1, MOST_NUMBERS),
    default=360,
    show_default=True,
    help="Steps of the CSV table per turn.",
)
@file_option("--out", "FILE.toml", "Write the cyclogram, as given or solved.", "file_to")
@force_option
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
    force: bool,
    json_to: str | None,
) -> int:
    """Check the cyclogram of FILE (TOML or JSON) or of a MACHINE; with --solve, retime its motions.

    Ends with 3 where a check fails.
    """
    write = None if file_to is None else cyclogram_writer(file_to)
    files = {"--json": json_to, "--csv": csv_to, "--report": page_to, "--out": file_to}
    inputs = {"FILE": Path(file), **setting_files(settings)}
    with call_outputs(files, force=force, inputs=inputs) as call:
        given = find(file, read_settings(settings))
        solution = solve(given, goal, call.progress) if goal else None
        found = solution.cyclogram if solution else given
        shown = report(found, solution)
        call.give_page("--report", shown)
        if write is not None:
            call.give("--out", partial(write, found))
        call.give_json(shown.as_json)
        call.give("--csv", lambda: csv_text(columns(found, steps), call.progress.part(0.0, 1.0, "table")))
    if not call.quiet:
        _show(shown, solution)
        for option, kind in (("--report", "report"), ("--out", "cyclogram"), ("--csv", "table")):
            if option in call.files:
                say(f"{kind}: {call.files[option]}")
    else:
        note_verdict(shown.checks)
    return exit_code(shown.checks)


def _show(shown: Report, solution: Solution | None) -> None:
    """Print motions, checks, and the result of the solver."""
    say(worded(shown.title))
    show_verdict(shown.checks)
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
