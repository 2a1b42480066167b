"""A run: a programme, a journal and a loom, joined for as long as one process weaves.

One thread does everything that changes the controller: it takes what the loom reports, and twenty times a second the
commands of others. What others see is the snapshot that it made last.
"""

import queue
import threading
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType

from ilmek.drivers.twin_port import TwinPort
from ilmek.errors import LoomError
from ilmek.io.any_programme import OpenProgramme, open_any_programme
from ilmek.io.command_channel import CommandServer
from ilmek.io.journal_folder import CHANNEL, JournalFolder
from ilmek.io.programme_file import ProgrammeFile
from ilmek.io.recording_file import recording_text
from ilmek.io.woven_file import open_woven
from ilmek.jobs.check import check_programme
from ilmek.jobs.run.commands import RESUME, ROWS_BACK, give_command, lead_on, waits
from ilmek.jobs.run.operator import Operator
from ilmek.jobs.run.order import RunOrder
from ilmek.jobs.run.picture import carpet_png
from ilmek.jobs.run.result import COMPLETE, RunResult, snapshot_json
from ilmek.jobs.run.session import ControlSession
from ilmek.jobs.run.snapshots import SnapshotMaker
from ilmek.loom.control.packml import PackState
from ilmek.loom.control.view import Answer, Snapshot
from ilmek.loom.twin.comparison import compare
from ilmek.loom.twin.model import FaultRates, plant_model
from ilmek.loom.twin.recording import Recorder
from ilmek.progress import SILENT, Progress
from ilmek.report import Json

INTERVAL = 0.05
"""Time between two looks at the commands, and the longest wait for the loom [s]."""

PATIENCE = 10.0
"""Time in which the loop must take a command of another thread [s]."""

MOST_COMMANDS = 32
"""Largest number of commands that wait."""

STOP_TIME = 2.0
"""Time in which a stop waits for the operations in progress [s]; then they are halted, and queried on restart."""

_RETRY = 0.5
"""Time between two attempts to write a journal that could not be written [s]."""

_STANDS = (PackState.STOPPED, PackState.ABORTED, PackState.IDLE, PackState.COMPLETE)


class LoomRun:
    """A run, and its `ControllerView`. Closed at the end of a `with` block.

    begun     certain knots when it was opened     complete  whether the carpet was complete then
    Raises LoomError for a programme or journal that cannot be used, OutputError where the folder cannot be written.
    """

    def __init__(self, order: RunOrder, progress: Progress = SILENT) -> None:
        self.order = order
        self._commands: queue.Queue[tuple[str, list[Answer], threading.Event]] = queue.Queue(MOST_COMMANDS)
        self._stop, self._done = threading.Event(), threading.Event()
        self._due = self._retry = self._halt = 0.0
        self._ending = False
        with ExitStack() as stack:
            self.programme: OpenProgramme = open_any_programme(order.programme, progress=progress)
            stack.callback(self.programme.close)
            self.folder = stack.enter_context(JournalFolder(order.folder, new=order.new))
            if not self.folder.journal.length:
                _require_proved(order.programme, progress)
            elif not self.folder.woven.exists():
                raise LoomError(
                    f"{self.folder.path} has a journal but no carpet", do="restore the file woven, or begin with --new"
                )
            self.woven = stack.enter_context(open_woven(self.folder.woven, self.programme))
            rates = order.rates(self.programme.setup)
            self._recorder = self._recording(rates) if order.record else None
            self.port = TwinPort(
                self.programme.setup, self.woven, speed=order.speed, rates=rates, record=self._recorder
            )
            self._session = self._opened()
            if order.rows_back is not None:
                answer = self._given(f"{ROWS_BACK} {order.rows_back}")
                if not answer.ok:
                    raise LoomError(answer.reason)
            self._channel = CommandServer(self.folder.path / CHANNEL)
            stack.callback(self._channel.close)
            self._stack = stack.pop_all()
        self._operator = Operator(self.programme, self.port, self.woven, automatic=order.operator, weaving=order.start)
        row_times = self.programme.row_times if isinstance(self.programme, ProgrammeFile) else None
        self._maker = SnapshotMaker(self.programme, row_times)
        self._snapshot = self._maker.make(self._session)
        self.begun, self.complete = self._snapshot.knots, self._session.status().complete

    def snapshot(self) -> Snapshot:
        """The controller's state, at most `INTERVAL` old."""
        return self._snapshot

    def command(self, name: str) -> Answer:
        """Give a command from any other thread than that of `work`; the controller's answer."""
        answers: list[Answer] = []
        taken = threading.Event()
        try:
            self._commands.put_nowait((name, answers, taken))
        except queue.Full:
            return Answer(False, f"{MOST_COMMANDS} commands wait; try again")
        if not taken.wait(PATIENCE):
            return Answer(False, "the controller does not run")
        return answers[0]

    def stop(self) -> None:
        """Have `work` stop the loom and return; from any thread."""
        self._stop.set()

    def wait(self, timeout: float) -> bool:
        """Wait until `work` has returned, for so long [s] at most; whether it has."""
        return self._done.wait(timeout)

    def work(self, show: Callable[[Snapshot], object] = lambda _: None) -> None:
        """Run the controller until the carpet is complete or the run is stopped.

        show  called with each snapshot
        """
        try:
            self._attend(show)
            while not self._ended():
                self._lead()
                self._session.receive(INTERVAL)
                if time.monotonic() >= self._due:
                    self._attend(show)
            self._attend(show)
        finally:
            self._done.set()

    def result(self, progress: Progress = SILENT) -> RunResult:
        """The carpet compared with its chart, and the state of the controller."""
        now = self._snapshot
        state = COMPLETE if self._session.status().complete else now.state
        woven_result = compare(self.woven, self.programme, progress)
        return RunResult(now, state, self.begun, woven_result, str(self.folder.path))

    def recorded(self) -> str:
        """The inputs of the loom since the run began, as the text of a recording; "" where none are kept."""
        return "" if self._recorder is None else recording_text(self._recorder.recording(self.port.state))

    def png(self, result: RunResult) -> bytes:
        """The carpet as far as it is woven, as a PNG file."""
        return carpet_png(self.woven, self.programme, result.woven)

    def _recording(self, rates: FaultRates) -> Recorder:
        start = self.woven.restored(plant_model(self.programme.setup))
        return Recorder(self.programme, rates, start)

    def _opened(self) -> ControlSession:
        return ControlSession(self.programme, self.port, self.folder.journal, self.order.commit)

    def _ended(self) -> bool:
        state = self._session.state
        if state not in _STANDS:
            return False
        if self._ending:
            return True
        return state is PackState.COMPLETE and not self.order.serves

    def _lead(self) -> None:
        """What the operator does, and what follows from a stop or a journal that cannot be written."""
        if self._stop.is_set() and not self._ending:
            self._ending = True
            self._operator.weaving = False
            self._halt = time.monotonic() + STOP_TIME
            give_command(self._session, "stop")
        elif self._ending and time.monotonic() > self._halt:
            give_command(self._session, "abort")
        elif self._session.failure is not None:
            self._restore()
        elif self._session.state is not PackState.EXECUTE and not self._operator.see_to(self._session):
            self.stop()

    def _restore(self) -> None:
        """Go on with the journal when it can be written again."""
        now = time.monotonic()
        if now >= self._retry:
            self._retry = now + _RETRY
            try:
                self.folder.journal.sync()
                self._session = self._opened()
            except OSError:
                return

    def _attend(self, show: Callable[[Snapshot], object]) -> None:
        """Take the commands of others, and show the state."""
        self._due = time.monotonic() + INTERVAL
        answered = []
        while not self._commands.empty():
            name, answers, taken = self._commands.get_nowait()
            answers.append(self._commanded(name))
            answered.append(taken)
        self._channel.poll(self._handled)
        self._snapshot = self._maker.make(self._session)
        for taken in answered:  # who gave a command finds what came of it in the snapshot
            taken.set()
        show(self._snapshot)

    def _handled(self, name: str) -> dict[str, Json]:
        if name == "status":
            return snapshot_json(self._snapshot, self.programme.setup)
        answer = self._commanded(name)
        return {"ok": answer.ok, "reason": answer.reason}

    def _commanded(self, name: str) -> Answer:
        if self._ending:
            return Answer(False, "the run is stopping")
        if name == RESUME:
            self._operator.weaving, self._operator.waiting = True, False
            if waits(self._session):
                self._operator.repair(self._session)
            return lead_on(self._session)
        answer = self._given(name)
        if answer.ok:
            self._operator.commanded(name)
            if name == "stop" and not self.order.serves:
                self.stop()
        return answer

    def _given(self, name: str) -> Answer:
        """Give a command; rows that its operator has taken out are out of the simulated carpet."""
        before = self._session.status().row
        answer = give_command(self._session, name)
        if answer.ok and name.partition(" ")[0] == ROWS_BACK:
            self.woven.take_out(self._session.status().row, before)
        return answer

    def __enter__(self) -> "LoomRun":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._done.set()
        self._stack.close()


def _require_proved(file: Path, progress: Progress) -> None:
    """Raise LoomError for a programme that breaks a rule, with the line of its text form."""
    check_result = check_programme(file, progress=progress)
    if not check_result.ok:
        first = check_result.errors[0]
        more = f"`ilmek check {file}` lists all {check_result.count:,} errors"
        raise LoomError(f"{file}, line {first.line} of its text: {first.what}", do=more)
