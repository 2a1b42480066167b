"""`ilmek check`: prove a programme from its file."""

from pathlib import Path

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import file_option, force_option, json_option
from ilmek.cli.terminal import note, say, show_pairs
from ilmek.cli.verdict import CHECK_FAILS
from ilmek.jobs.check import CheckResult, check_programme
from ilmek.units import BILLION, format_quantity

MOST_SHOWN = 20
"""Largest number of errors that are printed."""

EXAMPLES = """\b
Examples:
  ilmek check carpet/programme.ilmek
  ilmek check carpet/programme.ilmek --loom carpet/machine.json
  ilmek check edited.txt --json -

Limits: .ilmek 1,000 MB; .txt 10,000 MB; 1,000 errors in --json.
"""


@click.command(epilog=EXAMPLES)
@click.argument("file", type=click.Path(path_type=Path), metavar="FILE")
@file_option(
    "--loom",
    "FILE.json",
    "The loom that it must be for: machine.json of weave, or the JSON of design automated-loom.",
    "loom",
)
@force_option
@json_option
def command(file: Path, loom: Path | None, force: bool, json_to: str | None) -> int:
    """Prove the programme of FILE, .ilmek or .txt: each knot of the chart once and in its colour, no two heads meet.

    Also proved: yarn enough in each tube and on each bobbin until it is changed, wefts, beats and take-up in order, and
    the weaving time. Errors name the line of the text; of a .ilmek, the line that `ilmek convert` writes. Ends with 3
    where a rule is broken.
    """
    with call_outputs({"--json": json_to}, force=force, inputs={"FILE": file, "--loom": loom}) as call:
        check_result = check_programme(file, loom, progress=call.progress)
        call.give_json(check_result.as_json)
    if not call.quiet:
        show_check(check_result)
    elif not check_result.ok:
        note(_verdict(check_result))
    return 0 if check_result.ok else CHECK_FAILS


def show_check(found: CheckResult) -> None:
    """Print the verdict, the totals, and the first errors."""
    setup, totals = found.setup, found.totals
    say(_verdict(found))
    show_pairs(
        [
            ("rows", f"{setup.rows:,} of {setup.columns:,} knots; heads: {setup.heads}"),
            ("weaving time", format_quantity(totals.time / BILLION, "h")),
            ("changes of tube", f"{totals.changes:,}"),
            ("stops", f"{totals.stops:,}; bobbins changed: {totals.wefts:,}, packages: {totals.packages:,}"),
        ]
    )
    for error in found.errors[:MOST_SHOWN]:
        say(f"{found.file.name}, line {error.line}: {error.what}")
    if found.count > MOST_SHOWN:
        say(f"… {found.count - MOST_SHOWN:,} more: see --json")


def _verdict(found: CheckResult) -> str:
    knots = f"{found.totals.knots:,} knots"
    errors = "1 error" if found.count == 1 else f"{found.count:,} errors"
    return f"proved: {knots}" if found.ok else f"NOT proved: {errors} in {knots}"
