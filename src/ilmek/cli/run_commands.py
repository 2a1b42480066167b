"""What `ilmek status`, `hold`, `resume` and `stop` share."""

from pathlib import Path

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import json_option
from ilmek.cli.terminal import show_pairs
from ilmek.jobs.status import give, run_status, status_in_words
from ilmek.report.json import Json

journal_option = click.option(
    "--journal", type=click.Path(path_type=Path), required=True, metavar="DIR", help="Folder of the run's journal."
)


def examples(name: str) -> str:
    """The epilog of a command."""
    return f"""\b
Examples:
  ilmek {name} --journal carpet/programme.journal
  ilmek {name} --journal carpet/programme.journal --json -

Limits: journal 4,000 MB.
"""


def run_command(name: str, text: str) -> click.Command:
    """A command that is given to the controller of a run; then its state is shown."""

    @click.command(name, help=text, epilog=examples(name))
    @journal_option
    @json_option
    def command(journal: Path, json_to: str | None) -> None:
        show_status(journal, json_to, name)

    return command


def show_status(journal: Path, json_to: str | None, command: str) -> None:
    """Give a command, and show the state of a run."""
    found: dict[str, Json] = {}
    with call_outputs({"--json": json_to}, bar=False) as call:
        give(journal, command)
        found = run_status(journal)
        call.give_json(lambda: found)
    if not call.quiet:
        show_pairs(status_in_words(found))
