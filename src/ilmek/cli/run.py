"""`ilmek run`: weave a programme on the simulated loom."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import file_option, force_option, json_option, picture_option
from ilmek.cli.running import run_options, work_shown
from ilmek.cli.settings import read_settings, setting_files
from ilmek.cli.terminal import note, show_pairs
from ilmek.cli.verdict import CHECK_FAILS
from ilmek.jobs.run.loom_run import LoomRun
from ilmek.jobs.run.order import RunOrder, read_run_order
from ilmek.jobs.run.picture import require_png

EXAMPLES = """\b
Examples:
  ilmek run carpet/programme.ilmek --speed 1000x
  ilmek run carpet/programme.ilmek --speed max --journal journal --json -
  ilmek run carpet/programme.ilmek --speed max --faults 7 --set gripper_miss=0.01 --picture carpet.png
  ilmek run carpet/programme.ilmek --new

Limits: file 1,000 MB; stops file 250 kB; journal 4,000 MB; 10,000 knots of a group commit.
"""


@click.command(epilog=EXAMPLES)
@click.argument("programme", type=click.Path(path_type=Path), metavar="PROGRAMME.ilmek")
@run_options
@picture_option
@file_option(
    "--record", "FILE.txt", "Write what the simulated loom was ordered and what happened to it, for `ilmek replay`."
)
@force_option
@json_option
def command(
    *,
    programme: Path,
    stops: Path | None,
    settings: tuple[str, ...],
    picture: Path | None,
    record: Path | None,
    force: bool,
    json_to: str | None,
    **run_order: Any,
) -> int:
    """Weave PROGRAMME on the simulated loom, knot by knot, under the controller with its journal.

    Ctrl-C stops the loom, and the same command goes on at the knot where it stopped; so it does after `kill -9` or a
    power cut. From another terminal: `ilmek status`, `hold`, `resume` and `stop`. At the end the carpet is compared
    with its chart.

    Exit code 0: the carpet is complete and equal to the chart; 3: a knot is wrong, or the run ended before.
    """
    order = read_run_order(programme, stops=stops, settings=read_settings(settings), **run_order)
    require_png(picture)
    order = replace(order, record=record is not None)
    to = {"--json": json_to, "--picture": picture, "--record": record}
    inputs = {"PROGRAMME": programme, "--stops": stops, **setting_files(settings)}
    with call_outputs(to, force=force, inputs=inputs, bar=False) as call:
        with LoomRun(order) as run:
            _weave(order, run)
            result = run.result()
            if picture is not None:
                call.outputs.write(picture, run.png(result))
            call.give("--record", run.recorded)
        call.give_json(result.as_json)
    if not call.quiet:
        show_pairs(result.in_words())
        call.show_files({"--picture": "picture", "--record": "recording"})
    return 0 if result.ok else CHECK_FAILS


def _weave(order: RunOrder, run: LoomRun) -> None:
    if run.complete:
        note(f"the carpet of {order.folder} is complete; --new begins another one")
        return
    if run.begun:
        note(f"goes on in row {run.snapshot().row + 1:,} after {run.begun:,} certain knots")
    work_shown(run, f"Ctrl-C stops, the same command goes on; ilmek hold|resume|stop --journal {order.folder}")
