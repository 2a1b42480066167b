"""`ilmek replay`: a recorded run once more."""

from pathlib import Path

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import force_option, json_option
from ilmek.cli.terminal import show_pairs
from ilmek.cli.verdict import CHECK_FAILS
from ilmek.jobs.replay import replay_run

EXAMPLES = """\b
Examples:
  ilmek run carpet/programme.ilmek --speed max --faults 7 --record run.txt
  ilmek replay run.txt carpet/programme.ilmek
  ilmek replay run.txt carpet/programme.ilmek --json -

Limits: recording 100 MB, 2,000,000 inputs; file 1,000 MB.
"""


@click.command(epilog=EXAMPLES)
@click.argument("recording", type=click.Path(path_type=Path), metavar="RECORDING")
@click.argument("programme", type=click.Path(path_type=Path), metavar="PROGRAMME.ilmek")
@force_option
@json_option
def command(recording: Path, programme: Path, force: bool, json_to: str | None) -> int:
    """Replay RECORDING, which `ilmek run --record` wrote, on the simulated loom, and compare its digest.

    The same orders and faults at the same times give the same reports, on every machine. Ends with 3 where they do not.
    """
    inputs = {"RECORDING": recording, "PROGRAMME": programme}
    with call_outputs({"--json": json_to}, force=force, inputs=inputs) as call:
        replay_result = replay_run(recording, programme, call.progress)
        call.give_json(replay_result.as_json)
    if not call.quiet:
        show_pairs(replay_result.in_words())
    return 0 if replay_result.ok else CHECK_FAILS
