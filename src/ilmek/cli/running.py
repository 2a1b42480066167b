"""What the commands share that weave on the simulated loom: options, screen, the line at the end."""

import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeVar

import click

from ilmek.cli.interrupts import before_end
from ilmek.cli.options import file_option, stops_option, text_option
from ilmek.cli.terminal import note
from ilmek.cli.waiting_notes import WaitingNotes
from ilmek.jobs.run.loom_run import STOP_TIME, LoomRun
from ilmek.loom.control.view import Snapshot

F = TypeVar("F", bound=Callable[..., Any])

_LONGEST_STOP = STOP_TIME + 1.0
"""Time that Ctrl-C gives a run to stop [s]; then the process ends as by `kill -9`, and nothing is lost either."""

_OPTIONS = (
    click.option(
        "--speed",
        default="1x",
        metavar="N|max",
        help="Speed of the simulated loom's clock: 1x, 1000x, max as fast as possible; default: 1x.",
    ),
    file_option(
        "--journal", "DIR", "Folder of the journal and the woven carpet; default: NAME.journal beside PROGRAMME."
    ),
    click.option("--new", is_flag=True, help="Begin another carpet; the one in the journal is removed."),
    click.option(
        "--rows-back",
        type=int,
        metavar="N",
        help="First weave again N whole rows, up to 20, and the row in work: they were taken out of the loom. Not "
        "beyond the last change of packages; default: none.",
    ),
    click.option(
        "--commit",
        type=int,
        metavar="N",
        help="Make the journal durable once for N knots; 1: each knot before the next begins. After a power cut the "
        "sensor finds the knots since; default: 1 up to a speed of 100x, 64 above it.",
    ),
    text_option(
        "--faults",
        "SEED",
        "Simulate breaks of yarn, weft and warp and missed grips, as `ilmek simulate` does; default: none.",
    ),
    stops_option,
    click.option(
        "--set", "settings", multiple=True, metavar="NAME=VALUE", help="Set a rate of --faults, like gripper_miss=0.01."
    ),
    click.option(
        "--operator",
        default="auto",
        metavar="auto|ask",
        help="auto: what fails is repaired at once. ask: the loom waits for `ilmek resume`; default: auto.",
    ),
)


def run_options(command: F) -> F:
    """Options of a run: speed, journal, faults, operator."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


def work_shown(run: LoomRun, hint: str) -> None:
    """Let a run work, shown on a terminal, until it ends or Ctrl-C stops it."""
    ended = threading.Event()

    def stopped() -> str:
        run.stop()
        ended.wait(_LONGEST_STOP)  # until the screen is cleared
        now = run.snapshot()
        if now.knots == now.total and now.row + 1 >= now.rows:
            return f"all {now.total:,} knots are tied"
        return f"{now.knots:,} of {now.total:,} knots are tied; the same command goes on in row {now.row + 1:,}"

    with before_end(stopped):
        try:
            with _screen(run, hint) as show:
                run.work(show)
        finally:
            ended.set()


@contextmanager
def _screen(run: LoomRun, hint: str) -> Iterator[Callable[[Snapshot], object]]:
    """What shows the snapshots of a run: a screen on a terminal; in a pipe notes while it waits."""
    if not sys.stderr.isatty():
        notes = WaitingNotes(note)
        yield lambda snapshot: notes.show(snapshot, time.monotonic())
        return
    from rich.console import Console

    from ilmek.cli.run_screen import RunScreen

    console = Console(stderr=True, markup=False, highlight=False)
    with RunScreen(console, run.programme.setup.yarns, hint) as screen:
        yield lambda snapshot: screen.show(snapshot, time.monotonic())
