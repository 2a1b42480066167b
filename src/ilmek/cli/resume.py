"""`ilmek resume`: have a run go on, from another terminal."""

from pathlib import Path

import click

from ilmek.cli.options import json_option
from ilmek.cli.run_commands import examples, journal_option, show_status


@click.command(epilog=examples("resume"))
@journal_option
@click.option(
    "--answer",
    type=click.Choice(("yes", "no")),
    help="Answer the question of the controller that `ilmek status` shows, and nothing else.",
)
@json_option
def command(journal: Path, answer: str | None, json_to: str | None) -> None:
    """Have the loom of a run go on: its alarms are acknowledged, and the simulated loom is taken as repaired."""
    show_status(journal, json_to, answer or "resume")
