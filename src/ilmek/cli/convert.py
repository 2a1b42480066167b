"""`ilmek convert`: a programme from its file to its text, and back."""

from pathlib import Path

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import force_option
from ilmek.cli.terminal import say
from ilmek.jobs.convert import convert_programme

EXAMPLES = """\b
Examples:
  ilmek convert carpet/programme.ilmek carpet.txt
  ilmek convert carpet.txt edited.ilmek

Limits: .ilmek 1,000 MB; .txt 10,000 MB; 10,000 lines before the first row, 400 characters in a line of a row.
"""


@click.command(epilog=EXAMPLES)
@click.argument("source", type=click.Path(path_type=Path), metavar="IN")
@click.argument("target", type=click.Path(path_type=Path), metavar="OUT")
@force_option
def command(source: Path, target: Path, force: bool) -> None:
    """Write the programme of IN as OUT, in the form of its ending: .ilmek, or .txt to read, edit and compare.

    The text has one operation a line. Nothing is lost in either direction: the digest stays.
    """
    with call_outputs({"OUT": target}, force=force, inputs={"IN": source}) as call:
        setup = convert_programme(source, target, outputs=call.outputs, progress=call.progress)
    say(f"programme: {target}, {setup.rows:,} rows of {setup.columns:,} knots")
