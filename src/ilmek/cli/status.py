"""`ilmek status`: the state of a run, from another terminal or afterwards."""

from pathlib import Path

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import file_option, force_option, json_option, picture_option
from ilmek.cli.run_commands import journal_option
from ilmek.cli.terminal import show_pairs
from ilmek.jobs.status import run_status, status_in_words

EXAMPLES = """\b
Examples:
  ilmek status --journal carpet/programme.journal
  ilmek status --journal carpet/programme.journal --json -
  ilmek status --journal carpet/programme.journal --picture carpet.png

Limits: journal 4,000 MB; file 1,000 MB.
"""


@click.command(epilog=EXAMPLES)
@journal_option
@picture_option
@file_option(
    "--programme", "PROGRAMME.ilmek", "Programme of the carpet, for --picture; default: NAME.ilmek beside NAME.journal."
)
@force_option
@json_option
def command(*, journal: Path, picture: Path | None, programme: Path | None, force: bool, json_to: str | None) -> None:
    """Show the state of the controller of a run; where none runs, what its journal has of the carpet."""
    with call_outputs({"--json": json_to, "--picture": picture}, force=force, bar=False) as call:
        if picture is not None:
            from ilmek.jobs.run.picture import journal_png, require_png  # a state alone is shown at once

            require_png(picture)
            call.outputs.write(picture, journal_png(journal, programme))
        found = run_status(journal)
        call.give_json(lambda: found)
    if not call.quiet:
        show_pairs(status_in_words(found))
        call.show_files({"--picture": "picture"})
