"""A run of the twin on the loom of the project: the carpet of a recipe is woven while others look on and command."""

import time
from dataclasses import dataclass
from pathlib import Path

from ilmek.errors import LoomError, ParameterError
from ilmek.io.command_channel import request as send_command
from ilmek.io.journal_folder import CHANNEL
from ilmek.io.programme_file import write_programme
from ilmek.jobs.run.loom_run import LoomRun
from ilmek.jobs.run.order import FAST, FAST_COMMIT, FASTEST, RunOrder
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.loom.scene import RECIPE, project_loom
from ilmek.jobs.studio.project.folder import OWN
from ilmek.loom.control.view import AlarmView, Answer, Snapshot
from ilmek.loom.explicit import CompiledProgramme
from ilmek.records import JsonObject, alike
from ilmek.units import BILLION

COMMANDS = ("hold", "resume", "stop", "acknowledge", "yes", "no")
EVERY = 0.1
"""Shortest time between two snapshots that are sent [s]."""


@dataclass(frozen=True, slots=True)
class RunRequest:
    """A run of the twin.

    file   a recipe of the project      speed   of the loom's clock, 1 to 1,000,000
    faults  seed of the simulated faults; null: none
    """

    file: str = RECIPE
    speed: float = 100.0
    faults: int | None = None


@dataclass(frozen=True, slots=True)
class LoomCommand:
    """A command to the run: hold, resume, stop, acknowledge, yes or no."""

    command: str


@dataclass(frozen=True, slots=True)
class RunNews:
    """The run at an instant; rows and warp pairs count from 0, from the bottom edge and from the left.

    time, left   of the loom's clock, until now and until the end by the programme [s]
    columns      of the knot in work of each head; null: none yet in this row
    tied, due    knots of the row that are tied, and all of the row
    stop         what the operator changes in the stop that the loom waits in; "": none
    """

    state: str
    row: int
    rows: int
    knots: int
    total: int
    time: float
    left: float
    speed: float
    faults: int
    stop: str
    columns: tuple[int | None, ...]
    tied: int
    due: int
    alarms: tuple[AlarmView, ...]
    requests: tuple[str, ...]
    commands: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class TwinRunEnd:
    """The end of a run: state, knots, and those that are missing, double or in a wrong yarn; the last news of it."""

    state: str
    knots: int
    total: int
    faults: int
    last: RunNews


def run(request: RunRequest, context: Context) -> TwinRunEnd:
    """Weave the carpet of a recipe on the twin, from its first row on; news come ten times a second.

    Raises ParameterError for a speed out of bounds or a file that is no recipe, LoomError where the loom cannot weave
    the carpet or another run goes on; Cancelled.
    """
    if not 0 < request.speed <= FASTEST:
        raise ParameterError(f"a clock of {request.speed:g} times", allowed=f"above 0, up to {FASTEST:g}")
    order = RunOrder(
        programme=_programme(request.file, context),
        journal=_journal(context.folder),
        new=True,
        speed=request.speed,
        commit=FAST_COMMIT if request.speed > FAST else 1,
        faults=request.faults,
    )
    due = 0.0

    def show(now: Snapshot) -> None:
        nonlocal due
        context.progress(now.knots / max(1, now.total))
        if time.monotonic() >= due:
            due = time.monotonic() + EVERY
            context.show(_news(now))

    with LoomRun(order) as woven:
        woven.work(show)
        result = woven.result()
    return TwinRunEnd(result.state, result.snapshot.knots, result.snapshot.total, result.faults, _news(result.snapshot))


def command(request: LoomCommand, context: Context) -> Answer:
    """Give a command to the run of the project. Raises ParameterError for an unknown one, LoomError without a run."""
    if request.command not in COMMANDS:
        raise ParameterError(f"the command {request.command!r}", allowed=", ".join(COMMANDS))
    answer: JsonObject | None = send_command(_journal(context.folder) / CHANNEL, request.command)
    if answer is None:
        raise LoomError("no run of this project goes on", do="start one")
    return Answer(bool(answer.get("ok")), str(answer.get("reason", "")))


def _journal(folder: Path) -> Path:
    return folder / OWN / "run.journal"


def _programme(file: str, context: Context) -> Path:
    """The programme of a recipe's carpet, written anew into the studio's own folder."""
    loom = project_loom(context.folder, file, context.progress)
    if loom.charted is None:
        raise ParameterError(f"{file} has no carpet to weave", allowed="a recipe", do=f"take {RECIPE}")
    loomed = loom.loomed
    if loomed is None or loomed.programme is None or loomed.setup is None:
        raise LoomError("the loom has no programme for this carpet", do="see its checks that fail")
    path = context.folder / OWN / "run.ilmek"
    path.parent.mkdir(mode=0o700, exist_ok=True)
    path.unlink(missing_ok=True)
    write_programme(path, CompiledProgramme(loomed.setup, loomed.programme), progress=context.progress)
    return path


def _news(now: Snapshot) -> RunNews:
    return alike(
        RunNews,
        now,
        time=now.time / BILLION,
        left=now.left / BILLION,
        columns=tuple(head.column for head in now.heads),
        tied=sum(head.tied for head in now.heads),
        due=sum(head.knots for head in now.heads),
    )
