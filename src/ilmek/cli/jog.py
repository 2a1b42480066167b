"""`ilmek jog`: move an axis of a run by hand, from another terminal."""

from pathlib import Path

import click

from ilmek.cli.options import json_option
from ilmek.cli.run_commands import journal_option, show_status
from ilmek.jobs.run.commands import JOG
from ilmek.loom.control.interlocks import JOG_LIMITS

EXAMPLES = f"""\b
Examples:
  ilmek mode manual --journal carpet/programme.journal
  ilmek resume --journal carpet/programme.journal
  ilmek jog carriage 20mm --journal carpet/programme.journal
  ilmek jog beater -- -3deg --journal carpet/programme.journal

Limits: {", ".join(f"{axis} {limit.distance:g} {limit.unit}" for axis, limit in JOG_LIMITS.items())}.
"""


@click.command(epilog=EXAMPLES)
@click.argument("axis", type=click.Choice([axis.value for axis in JOG_LIMITS]))
@click.argument("distance")
@journal_option
@json_option
def command(axis: str, distance: str, journal: Path, json_to: str | None) -> None:
    """Move AXIS by DISTANCE, in Execute of manual mode, as far as the interlocks allow."""
    show_status(journal, json_to, f"{JOG} {axis} {distance}")
