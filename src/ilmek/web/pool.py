"""The pool of worker processes: gives them requests, follows their progress, ends those that take too long.

A worker answers one request at a time. A request waits until a worker is free; one with an affinity waits for the
worker that served the same affinity last only where that worker is free, else it takes any. Works that go on for long
leave at least one worker to the requests of people who wait.
"""

import asyncio
import contextlib
import itertools
import os
import sys
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

from ilmek.web.framing import Answer, Ask, Cancel, Message, News, Step, decoded, encoded

GRACE = 2.0
"""Time that a cancelled request has to end by itself before its worker is ended [s]."""

MEMORY = 8 * 2**30
"""Memory of a worker [bytes]."""

MOST_WAITING = 200
"""Largest number of requests that wait for a worker."""

JSON = "application/json"


@dataclass(slots=True)
class Request:
    """A request that waits or is answered.

    follow  called with each Step and News of it
    """

    ask: Ask
    limit: float
    affinity: str
    long: bool
    follow: Callable[[Step | News], None]
    answer: asyncio.Future[Answer]
    cancelled: bool = False


@dataclass(slots=True)
class _Worker:
    process: asyncio.subprocess.Process
    request: Request | None = None
    affinity: str = ""
    tasks: set[asyncio.Task[None]] = field(default_factory=set)


class PoolFull(Exception):
    """Too many requests wait."""


class Pool:
    """Worker processes; `start` before the first request, `close` at the end.

    size     most workers at a time      project  folder of the project
    """

    def __init__(self, project: str, size: int | None = None) -> None:
        self.size = size or max(3, min(8, os.cpu_count() or 1))
        self._project = project
        self._workers: list[_Worker] = []
        self._waiting: deque[Request] = deque()
        self._numbers = itertools.count(1)
        self._starting = 0
        self._closed = False
        self._jobs: set[asyncio.Task[None]] = set()

    async def start(self, workers: int = 2) -> None:
        """Start the first workers; they get ready while the page loads."""
        await asyncio.gather(*(self._add() for _ in range(min(workers, self.size))))

    async def close(self) -> None:
        """End all workers; what they do is lost."""
        self._closed = True
        for worker in self._workers:
            with contextlib.suppress(ProcessLookupError):
                worker.process.kill()
        for request in self._waiting:
            if not request.answer.done():
                request.answer.cancel()
        await asyncio.gather(*(worker.process.wait() for worker in self._workers))

    async def answer(
        self,
        function: str,
        body: bytes,
        *,
        limit: float,
        affinity: str = "",
        long: bool = False,
        follow: Callable[[Step | News], None] = lambda message: None,
    ) -> Answer:
        """The answer of a worker. Where the caller is cancelled, so is the request. Raises PoolFull."""
        if len(self._waiting) >= MOST_WAITING:
            raise PoolFull
        ask = Ask(next(self._numbers), function, body, self._project)
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
                self._later(self._end_cancelled(worker, request))

    async def _end_cancelled(self, worker: _Worker, request: Request) -> None:
        await self._write(worker, Cancel(request.ask.number))
        await asyncio.sleep(GRACE)
        if worker.request is request:
            self._kill(worker)

    def _later(self, work: object) -> None:
        task = asyncio.ensure_future(work)  # type: ignore[call-overload]
        self._jobs.add(task)
        task.add_done_callback(self._jobs.discard)

    def _serve(self) -> None:
        """Give waiting requests to free workers, and start workers while requests wait."""
        if self._closed:
            return
        busy_long = sum(1 for worker in self._workers if worker.request is not None and worker.request.long)
        for request in tuple(self._waiting):
            if request.long and busy_long >= self.size - 1:
                continue
            worker = self._free(request.affinity)
            if worker is None:
                break
            self._waiting.remove(request)
            busy_long += request.long
            worker.request, worker.affinity = request, request.affinity
            self._later(self._give(worker, request))
        if self._waiting and len(self._workers) + self._starting < self.size:
            self._later(self._add())

    def _free(self, affinity: str) -> _Worker | None:
        free = [worker for worker in self._workers if worker.request is None]
        return min(free, key=lambda worker: (worker.affinity != affinity, worker.affinity != ""), default=None)

    async def _give(self, worker: _Worker, request: Request) -> None:
        await self._write(worker, request.ask)
        await asyncio.sleep(request.limit)
        if worker.request is request:
            given = f"the request took longer than {request.limit:g} s and was ended"
            self._finish(worker, _failed(request, 503, given))
            self._kill(worker)

    async def _write(self, worker: _Worker, message: Message) -> None:
        assert worker.process.stdin is not None
        with contextlib.suppress(ConnectionError):
            worker.process.stdin.write(encoded(message))
            await worker.process.stdin.drain()

    async def _add(self) -> None:
        self._starting += 1
        try:
            process = await asyncio.create_subprocess_exec(
                sys.executable,
                "-m",
                "ilmek.web.worker",
                str(MEMORY),
                stdin=asyncio.subprocess.PIPE,
                stdout=asyncio.subprocess.PIPE,
                start_new_session=True,  # Ctrl-C is for the server
                env={**os.environ, "NUMBA_NUM_THREADS": os.environ.get("NUMBA_NUM_THREADS", "2")},
            )
        finally:
            self._starting -= 1
        worker = _Worker(process)
        self._workers.append(worker)
        if self._closed:
            process.kill()
            return
        self._later(self._read(worker))
        self._serve()

    async def _read(self, worker: _Worker) -> None:
        """Follow what a worker sends until it ends."""
        stream = worker.process.stdout
        assert stream is not None
        with contextlib.suppress(asyncio.IncompleteReadError, ConnectionError):
            while True:
                size = int.from_bytes(await stream.readexactly(4), "little")
                self._receive(worker, decoded(await stream.readexactly(size)))
        self._workers.remove(worker)
        if worker.request is not None:
            given = "the worker ended while it answered (the memory of one request is limited)"
            self._finish(worker, _failed(worker.request, 507, given))
        await worker.process.wait()
        self._serve()

    def _receive(self, worker: _Worker, message: Message) -> None:
        request = worker.request
        if request is None or isinstance(message, Ask | Cancel) or message.number != request.ask.number:
            return
        if isinstance(message, Answer):
            self._finish(worker, message)
            self._serve()
        elif not request.cancelled:
            request.follow(message)

    def _finish(self, worker: _Worker, answer: Answer) -> None:
        request, worker.request = worker.request, None
        if request is not None and not request.answer.done():
            request.answer.set_result(answer)

    def _kill(self, worker: _Worker) -> None:
        with contextlib.suppress(ProcessLookupError):
            worker.process.kill()


def _failed(request: Request, status: int, given: str) -> Answer:
    body = b'{"error":{"given":%s,"allowed":"","do":"try again, or take a smaller task"}}'
    return Answer(request.ask.number, status, JSON, body % _quoted(given), request.limit)


def _quoted(text: str) -> bytes:
    import json

    return json.dumps(text).encode()
