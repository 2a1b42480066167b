"""`ilmek mode`: choose the mode of a run, from another terminal."""

from pathlib import Path

import click

from ilmek.cli.options import json_option
from ilmek.cli.run_commands import journal_option, show_status
from ilmek.jobs.run.commands import MODES

EXAMPLES = """\b
Examples:
  ilmek mode manual --journal carpet/programme.journal
  ilmek mode production --journal carpet/programme.journal

Limits: the mode changes in Stopped, Idle and Aborted; journal 4,000 MB.
"""


@click.command(epilog=EXAMPLES)
@click.argument("mode", type=click.Choice(list(MODES)))
@journal_option
@json_option
def command(mode: str, journal: Path, json_to: str | None) -> None:
    """Choose MODE: weave the carpet, one row at each start, or move one axis at a time (`ilmek jog`)."""
    show_status(journal, json_to, mode)
