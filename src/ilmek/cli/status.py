"""`ilmek status`: the state of a run, from another terminal or afterwards."""

from pathlib import Path

import click

from ilmek.cli.options import json_option
from ilmek.cli.run_commands import examples, journal_option, show_status


@click.command(epilog=examples("status"))
@journal_option
@json_option
def command(journal: Path, json_to: str | None) -> None:
    """Show the state of the controller of a run; where none runs, what its journal has of the carpet."""
    show_status(journal, json_to)
