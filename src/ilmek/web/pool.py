"""The pool of worker processes: gives them requests, follows their progress, ends those that take too long.

A worker answers one request at a time. A request waits until a worker is free; one with an affinity takes the worker
that served the same affinity last where that worker is free, else any; while the first view is prepared, its worker
takes no other requests, and none is started for later. Works that go on for long leave at least one
worker to the requests of people who wait, and a worker that ends is replaced.
"""

import asyncio
import contextlib
import itertools
import os
import signal
import sys
from collections import deque
from collections.abc import Callable, Coroutine
from dataclasses import dataclass, field

import msgspec

from ilmek.web.framing import (
    JSON,
    Ask,
    Cancel,
    Message,
    News,
    Prepared,
    Ready,
    Reply,
    StepMessage,
    decoded,
    encoded,
    error_body,
)

GRACE = 4.0
"""Time that a cancelled request has to end by itself before its worker is ended [s]."""

MEMORY = 8_000_000_000
"""Most memory of a worker [bytes]; on a smaller computer as much as that has."""

LEAST_MEMORY = 3_000_000_000
"""Memory that a worker may take on any computer, as libraries reserve much that they do not use [bytes]."""

MOST_WAITING = 200
"""Largest number of requests that wait for a worker."""

MOST_FAILED_STARTS = 3
"""Workers in a row that end before they are ready; then the requests that wait fail."""


@dataclass(slots=True, eq=False)
class Request:
    """A request that waits or is answered.

    limit   longest time of an answer [s]      long  a work that goes on, not a person who waits
    follow  called with each StepMessage and News of it
    """

    ask: Ask
    limit: float
    affinity: str
    long: bool
    follow: Callable[[StepMessage | News], None]
    answer: asyncio.Future[Reply]
    cancelled: bool = False


@dataclass(slots=True, eq=False)
class _Worker:
    process: asyncio.subprocess.Process
    started: bool = False
    ready: bool = False
    reserved: bool = False
    """It prepares for its affinity, or answers the first request of it, and takes no others."""
    request: Request | None = None
    affinity: str = ""
    limit: asyncio.TimerHandle | None = None


def worker_memory() -> int:
    """Memory that a worker may take: that of the computer, within LEAST_MEMORY and MEMORY [bytes]."""
    try:
        there = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError, OSError):  # not on Windows
        there = MEMORY
    return max(LEAST_MEMORY, min(MEMORY, there))


class PoolFull(Exception):
    """Too many requests wait."""


def _ignored(message: StepMessage | News) -> None:
    """Progress that nobody follows."""


@dataclass(eq=False, slots=True)
class Pool:
    """Worker processes; `start` before the first request, `close` at the end.

    project  folder of the project      size  most workers at a time      memory  of a worker [bytes]
    command  starts a worker            grace  see GRACE
    first    affinity of the requests that come first: a worker prepares for them from the start
    """

    project: str
    size: int = field(default_factory=lambda: max(3, min(8, os.cpu_count() or 1)))
    memory: int = field(default_factory=worker_memory)
    command: tuple[str, ...] = (sys.executable, "-m", "ilmek.web.worker")
    grace: float = GRACE
    first: str = ""
    _workers: list[_Worker] = field(default_factory=list)
    _waiting: deque[Request] = field(default_factory=deque)
    _numbers: "itertools.count[int]" = field(default_factory=lambda: itertools.count(1))
    _starting: int = 0
    _failed_starts: int = 0
    _closed: bool = False
    _tasks: set[asyncio.Task[None]] = field(default_factory=set)

    async def start(self) -> None:
        """Start the first workers; they get ready while the page loads."""
        affinities = ("", self.first)[: self.size]
        self._starting += len(affinities)
        await asyncio.gather(*map(self._add, affinities))

    async def close(self) -> None:
        """End all workers; what they do is lost."""
        self._closed = True
        for worker in self._workers:
            _kill(worker)
        for request in self._waiting:
            request.answer.cancel()
        while self._tasks:
            await asyncio.gather(*self._tasks, return_exceptions=True)

    def processes(self) -> list[int]:
        """The numbers of the workers' processes."""
        return [worker.process.pid for worker in self._workers]

    async def answer(
        self,
        function: str,
        body: bytes,
        *,
        limit: float,
        affinity: str = "",
        lax: bool = False,
        content: bytes | None = None,
        language: str = "",
        long: bool = False,
        follow: Callable[[StepMessage | News], None] = _ignored,
    ) -> Reply:
        """The answer of a worker. Where the caller is cancelled, so is the request. Raises PoolFull."""
        if len(self._waiting) >= MOST_WAITING or self._closed:
            raise PoolFull
        ask = Ask(next(self._numbers), function, body, self.project, lax, content, language)
        request = Request(ask, limit, affinity, long, follow, asyncio.get_running_loop().create_future())
        self._waiting.append(request)
        self._serve()
        try:
            return await request.answer
        except asyncio.CancelledError:
            self._cancel(request)
            raise

    def _cancel(self, request: Request) -> None:
        request.cancelled = True
        if request in self._waiting:
            self._waiting.remove(request)
        for worker in self._workers:
            if worker.request is request:
                self._later(_write(worker, Cancel(request.ask.number)))
                self._limit(worker, self.grace)

    def _later(self, work: Coroutine[object, object, None]) -> None:
        task = asyncio.ensure_future(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    def _serve(self) -> None:
        """Give waiting requests to free workers, and start workers while requests wait or none is left for the next."""
        if self._closed:
            return
        long = sum(1 for worker in self._workers if worker.request is not None and worker.request.long)
        for request in tuple(self._waiting):
            if request.long and long >= self.size - 1:
                continue
            worker = self._free(request.affinity)
            if worker is None:
                break
            self._waiting.remove(request)
            long += request.long
            self._give(worker, request)
        coming = self._starting + sum(1 for worker in self._workers if not worker.ready)
        prepared = bool(self._workers) and not any(worker.reserved for worker in self._workers)
        spare = prepared and self._free("") is None and self._failed_starts == 0
        wanted = len(self._waiting) or int(spare)
        for _ in range(min(wanted - coming, self.size - len(self._workers) - self._starting)):
            self._starting += 1
            self._later(self._add())

    def _free(self, affinity: str) -> _Worker | None:
        free = [
            worker
            for worker in self._workers
            if worker.ready and worker.request is None and (not worker.reserved or worker.affinity == affinity)
        ]
        return min(free, key=lambda worker: (worker.affinity != affinity, worker.affinity != ""), default=None)

    def _give(self, worker: _Worker, request: Request) -> None:
        worker.request, worker.affinity = request, request.affinity or worker.affinity
        self._limit(worker, request.limit)
        self._later(_write(worker, request.ask))

    def _limit(self, worker: _Worker, limit: float) -> None:
        """End a worker that has not answered its request within `limit` [s]."""
        if worker.limit is not None:
            worker.limit.cancel()
        worker.limit = asyncio.get_running_loop().call_later(limit, self._overdue, worker, limit)

    def _overdue(self, worker: _Worker, limit: float) -> None:
        if worker.request is not None:
            given = f"the request took longer than {limit:g} s and was ended"
            _kill(worker)
            self._finish(worker, _failed(worker.request, 503, given))

    async def _add(self, affinity: str = "") -> None:
        """Start a worker that is counted in `_starting` already; it prepares for requests of an affinity."""
        try:
            process = await asyncio.create_subprocess_exec(
                *self.command,
                str(self.memory),
                *([affinity] if affinity else ()),
                stdin=asyncio.subprocess.PIPE,
                stdout=asyncio.subprocess.PIPE,
                limit=2**24,
                start_new_session=True,  # Ctrl-C is for the server
                env={**os.environ, "NUMBA_NUM_THREADS": os.environ.get("NUMBA_NUM_THREADS", "2")},
            )
        except OSError as error:
            self._fail_waiting(f"no worker process can be started ({error.strerror})")
            return
        finally:
            self._starting -= 1
        worker = _Worker(process, affinity=affinity, reserved=affinity != "")
        if self._closed:
            _kill(worker)
        self._workers.append(worker)
        self._later(self._read(worker))

    async def _read(self, worker: _Worker) -> None:
        """Follow what a worker sends until it ends."""
        stream = worker.process.stdout
        assert stream is not None
        with contextlib.suppress(asyncio.IncompleteReadError, ConnectionError, msgspec.DecodeError):
            while True:
                size = int.from_bytes(await stream.readexactly(4), "little")
                self._receive(worker, decoded(await stream.readexactly(size)))
        _kill(worker)
        self._workers.remove(worker)
        if worker.request is not None:
            given = "the worker ended while it answered (the memory of one request is limited)"
            self._finish(worker, _failed(worker.request, 507, given))
        self._failed_starts = 0 if worker.started else self._failed_starts + 1
        if self._failed_starts >= MOST_FAILED_STARTS:
            self._fail_waiting("the worker processes end before they are ready; the terminal shows why")
        self._serve()
        await worker.process.wait()

    def _receive(self, worker: _Worker, message: Message) -> None:
        if isinstance(message, Ready):
            worker.started = worker.ready = True
            self._failed_starts = 0
            self._serve()
            return
        request = worker.request
        if isinstance(message, Prepared):
            worker.reserved = worker.reserved and request is not None
            self._serve()
            return
        if request is None or isinstance(message, Ask | Cancel) or message.number != request.ask.number:
            return
        if isinstance(message, Reply):
            self._finish(worker, message)
            self._serve()
        elif not request.cancelled:
            request.follow(message)

    def _finish(self, worker: _Worker, answer: Reply) -> None:
        request, worker.request, worker.reserved = worker.request, None, False
        if worker.limit is not None:
            worker.limit.cancel()
        if request is not None and not request.answer.done():
            request.answer.set_result(answer)

    def _fail_waiting(self, given: str) -> None:
        self._failed_starts = 0
        while self._waiting:
            request = self._waiting.popleft()
            if not request.answer.done():
                request.answer.set_result(_failed(request, 503, given))


async def _write(worker: _Worker, message: Message) -> None:
    assert worker.process.stdin is not None
    with contextlib.suppress(ConnectionError):
        worker.process.stdin.write(encoded(message))
        await worker.process.stdin.drain()


def _kill(worker: _Worker) -> None:
    """End a worker with the processes that it has started; it takes no request any more."""
    worker.ready = False
    with contextlib.suppress(ProcessLookupError, PermissionError):
        if hasattr(os, "killpg"):
            os.killpg(worker.process.pid, signal.SIGKILL)
        else:
            worker.process.kill()


def _failed(request: Request, status: int, given: str) -> Reply:
    return Reply(request.ask.number, status, JSON, error_body(given, do="try again, or take a smaller task"), 0.0)
