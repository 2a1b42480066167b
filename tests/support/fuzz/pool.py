"""Processes that run inputs. One that dies or hangs is a finding, and another takes its place."""

import faulthandler
import multiprocessing
import os
import re
import resource
import signal
import tempfile
import time
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing import connection
from multiprocessing.connection import Connection
from pathlib import Path
from traceback import format_exc

from kept import kept

from fuzz.case import Case
from fuzz.corpus import Corpus, make_corpus
from fuzz.execution import Run, Runner
from fuzz.inputs import make_case
from fuzz.oracles import Finding, judged

HANG = 10.0
"""Processor time of an input that counts as a hang [s]."""

LATE = 8.0
"""How much longer an input may take on the clock: the machine may be busy."""

ADDRESS_SPACE = 16_000_000_000
"""Largest address space of a process [bytes]: one that takes more gets a MemoryError."""

Task = int | Case


@dataclass
class Outcome:
    """What came of an input: findings with the case, if any; costs."""

    task: Task
    command: str = ""
    code: int | None = None
    findings: list[Finding] = field(default_factory=list)
    case: Case | None = None
    seconds: float = 0.0
    memory: int = 0

    @property
    def name(self) -> str:
        """The number of the input; its command line, where it has none."""
        return str(self.task) if isinstance(self.task, int) else self.task.line


@dataclass(frozen=True)
class Limits:
    """hang [s of processor time]; whether delays and memory count."""

    hang: float = HANG
    timing: bool = True


class Worker:
    """A process that runs one input at a time."""

    def __init__(self, limits: Limits) -> None:
        self.limits = limits
        self.stacks = Path(tempfile.mkstemp(suffix=".stacks")[1])
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self.process = context.Process(target=_work, args=(theirs, self.stacks, limits), daemon=True)
        self.process.start()
        theirs.close()
        self.task: Task | None = None
        self.began = self.used = 0.0

    def give(self, task: Task) -> None:
        self.task, self.began, self.used = task, time.monotonic(), self._processor()
        with suppress(OSError):
            self.pipe.send(task)

    def taken(self) -> Outcome | None:
        """The outcome, where the process has ended with it, died or hung; None while it runs."""
        assert self.task is not None
        with suppress(EOFError, OSError):
            if self.pipe.poll():
                outcome: Outcome = self.pipe.recv()
                self.task = None
                return outcome
        if self.process.is_alive():
            wall = time.monotonic() - self.began
            if self._processor() - self.used < self.limits.hang and wall < LATE * self.limits.hang:
                return None
            with suppress(OSError):
                os.kill(self.process.pid or 0, signal.SIGUSR1)  # writes the stacks
            time.sleep(0.2)
            kind, key = "hang", ""
        else:
            kind, key = "crash", f"signal {-(self.process.exitcode or 0)} "
        stacks = self.stacks.read_text(errors="replace")
        frames = re.findall(r'File "[^"]*/ilmek/([^"]+)", line \d+ in (\S+)', stacks)
        inner = [f"{file}:{name}" for file, name in frames if not file.startswith("cli/frame")]
        where = inner[0] if inner else ""
        return Outcome(self.task, findings=[Finding(kind, f"{key}in {where}", stacks[-4000:])])

    def end(self) -> None:
        self.process.kill()
        self.process.join()
        self.pipe.close()
        self.stacks.unlink(missing_ok=True)

    def _processor(self) -> float:
        """Processor time of the process [s]; the clock where the system does not tell it."""
        try:
            fields = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
            return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        except (OSError, IndexError):
            return time.monotonic()


def outcomes(tasks: Iterable[Task], jobs: int, limits: Limits, until: float = float("inf")) -> Iterator[Outcome]:
    """The outcome of each task, as they end; none is begun after `until` (monotonic clock)."""
    waiting = iter(tasks)
    workers: list[Worker] = []
    try:
        while True:
            idle = [worker for worker in workers if worker.task is None]
            while len(workers) - len(idle) < jobs and time.monotonic() < until:
                task = next(waiting, None)
                if task is None:
                    break
                worker = idle.pop() if idle else Worker(limits)
                if worker not in workers:
                    workers.append(worker)
                worker.give(task)
            busy = [worker for worker in workers if worker.task is not None]
            if not busy:
                return
            connection.wait([worker.pipe for worker in busy], timeout=0.5)
            for worker in busy:
                outcome = worker.taken()
                if outcome is None:
                    continue
                if worker.task is not None:  # it died or hangs
                    workers.remove(worker)
                    worker.end()
                yield outcome
    finally:
        for worker in workers:
            worker.end()


def _work(pipe: Connection, stacks: Path, limits: Limits) -> None:
    """Run tasks until the pipe is closed."""
    resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, resource.RLIM_INFINITY))
    with stacks.open("w") as dump, tempfile.TemporaryDirectory() as base:
        faulthandler.enable(dump, all_threads=True)
        faulthandler.register(signal.SIGUSR1, dump, all_threads=True)
        corpus: Corpus | None = None
        runner = Runner(Path(base))
        while True:
            try:
                task = pipe.recv()
            except (EOFError, OSError):
                return
            try:
                if isinstance(task, int):
                    corpus = corpus or kept(make_corpus)
                    case = make_case(corpus, task)
                else:
                    case = task
                pipe.send(_outcome(task, runner(case), limits))
            except Exception:
                pipe.send(Outcome(task, findings=[Finding("harness", "the harness itself failed", format_exc())]))


def _outcome(task: Task, run: Run, limits: Limits) -> Outcome:
    findings = judged(run, limits.timing)
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    return Outcome(task, run.case.command, run.code, findings, run.case if findings else None, run.seconds, memory)
