"""A worker process of the studio: answers one request after the other.

    python -m ilmek.web.worker MEMORY [AFFINITY]

With an AFFINITY the worker prepares for requests of that name at once, without one when it is idle.
Requests come by standard input, answers leave by standard output (see `framing`). What a library prints goes to the
error stream. Memory beyond MEMORY bytes is refused by the system, and the request ends with an error. At the end of
standard input, which is the end of the server however it came, the worker ends at once with all its own processes.
"""

import contextlib
import gc
import os
import signal
import sys
import threading
import time
import traceback
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from importlib import import_module
from queue import Empty, SimpleQueue
from typing import Any, BinaryIO, NoReturn, get_type_hints

import msgspec

from ilmek.errors import IlmekError
from ilmek.jobs.studio.answers import Binary, Context
from ilmek.jobs.studio.words import in_page
from ilmek.progress import Cancelled, Progress
from ilmek.records import json_value
from ilmek.sentences import in_language
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
    encoded,
    error_body,
    read_message,
)

REPORT_EVERY = 0.05
"""Shortest time between two reports of progress [s]."""


IDLE = 1.5
"""Time without a request after which a worker prepares for the next [s]."""


Steps = Iterable[Callable[[], object]]


class Worker:
    """Reads requests in a thread, so that a cancellation arrives while a request is answered."""

    def __init__(self, requests: BinaryIO, answers: BinaryIO) -> None:
        self._requests, self._answers = requests, answers
        self._queue: SimpleQueue[Ask] = SimpleQueue()
        self._cancelled: set[int] = set()
        self._writing = threading.Lock()

    def run(self, first: Steps = (), later: Steps = ()) -> None:
        """Answer requests until the process ends.

        first  steps that prepare for the requests to come, done until the first comes      later  while none comes
        """
        self._send(Ready())
        for step in first:
            if not self._queue.empty():
                break
            _tried(step)
        gc.freeze()
        gc.enable()
        self._send(Prepared())
        steps = iter(later)
        while True:
            ask = self._next(steps)
            began = time.perf_counter()
            with in_language(ask.language):
                status, kind, body = self._answered(ask)
            self._cancelled.discard(ask.number)
            self._send(Reply(ask.number, status, kind, body, time.perf_counter() - began))

    def _next(self, steps: Iterator[Callable[[], object]]) -> Ask:
        """The next request."""
        while True:
            try:
                return self._queue.get(timeout=IDLE)
            except Empty:
                step = next(steps, None)
            if step is None:
                return self._queue.get()
            _prepared(step)

    def listen(self) -> None:
        """Read requests from now on."""
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        while (message := read_message(self._requests)) is not None:
            if isinstance(message, Cancel):
                self._cancelled.add(message.number)
            elif isinstance(message, Ask):
                self._queue.put(message)
        end()

    def _send(self, message: Message) -> None:
        with self._writing, contextlib.suppress(BrokenPipeError):
            self._answers.write(encoded(message))
            self._answers.flush()

    def _progress(self, number: int) -> Progress:
        last = 0.0

        def report(stage: str, share: float) -> None:
            nonlocal last
            now = time.monotonic()
            if now - last >= REPORT_EVERY:
                last = now
                self._send(StepMessage(number, stage, share))

        return Progress(report, lambda: number in self._cancelled)

    def _answered(self, ask: Ask) -> tuple[int, str, bytes]:
        """Status, media type and body of the answer."""
        try:
            function, request_type = resolved(ask.function)
            request = _request(ask, request_type)
            context = Context(
                ask.project,
                self._progress(ask.number),
                lambda news: self._send(News(ask.number, encoded_json(news))),
                lambda news: self._send(News(ask.number, encoded_json(news), everyone=True)),
            )
            context.progress(0.0)
            answer = function(request, context)
        except Exception as error:
            return _refused(error)
        if isinstance(answer, Binary):
            return 200, answer.kind, answer.body
        return 200, JSON, encoded_json(answer)


def _tried(step: Callable[[], object]) -> None:
    """Do a step that prepares; what fails is reported where a request needs it."""
    with contextlib.suppress(Exception):
        step()


def _prepared(step: Callable[[], object]) -> None:
    """Do a step that prepares while no request comes.

    What a worker has by then it keeps: later collections of garbage, of 0.1 s each with it, leave it out.
    """
    _tried(step)
    gc.collect()
    gc.freeze()


def _refused(error: Exception) -> tuple[int, str, bytes]:
    """Status, media type and body of the answer after an error."""
    if isinstance(error, IlmekError):
        return 422, JSON, error_body(in_page(error.given), allowed=in_page(error.allowed), do=in_page(error.do))
    if isinstance(error, Cancelled):
        return 499, JSON, b"{}"
    if isinstance(error, msgspec.ValidationError):
        return 400, JSON, error_body(str(error))
    if isinstance(error, MemoryError):
        return 507, JSON, error_body("the memory for one request is not enough", do="take a smaller task")
    traceback.print_exception(error)
    return 500, JSON, error_body(f"a fault of the studio: {type(error).__name__}: {error}", do="please report it")


def _request(ask: Ask, kind: type) -> Any:
    """The record of a request. Raises msgspec.ValidationError, also for text that is no JSON."""
    try:
        if ask.content is None:
            return msgspec.json.decode(ask.body, type=kind, strict=not ask.lax)
        fields = msgspec.json.decode(ask.body) | {"content": ask.content}
        return msgspec.convert(fields, kind, strict=False, builtin_types=(bytes,))
    except msgspec.ValidationError:
        raise
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise msgspec.ValidationError(f"the body is no JSON: {error}") from None
    except RecursionError:
        raise msgspec.ValidationError("the JSON of the body is nested too deeply") from None


@cache
def resolved(name: str) -> tuple[Any, Any]:
    """The function of "module:name" below ilmek.jobs (or of ilmek.web), and the type of its request."""
    module, _, attribute = name.partition(":")
    function = getattr(import_module(module if module.startswith("ilmek.web.") else f"ilmek.jobs.{module}"), attribute)
    return function, get_type_hints(function)["request"]


def end() -> NoReturn:
    """End this process and those that it has started, at once."""
    if os.name == "posix" and os.getpgid(0) == os.getpid():
        os.killpg(0, signal.SIGKILL)
    os._exit(1)


def encoded_json(value: object) -> bytes:
    """JSON of records, mappings, lists and arrays; numbers that are not finite are null."""
    return msgspec.json.encode(value, enc_hook=json_value)


def limit_memory(most: int) -> None:
    """Have the system refuse memory beyond `most` bytes, where it can."""
    with contextlib.suppress(ImportError, ValueError, OSError):
        resource = import_module("resource")  # not on Windows
        resource.setrlimit(resource.RLIMIT_AS, (most, most))


def widen_pipe(handle: int) -> None:
    """Have a pipe take a large answer in few pieces, where the system can."""
    with contextlib.suppress(ImportError, AttributeError, OSError):
        fcntl = import_module("fcntl")
        fcntl.fcntl(handle, fcntl.F_SETPIPE_SZ, 2**20)


def main() -> None:
    """Answer the requests of standard input on standard output."""
    gc.disable()  # until the first steps are done: what they import stays
    limit_memory(int(sys.argv[1]))
    widen_pipe(1)
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    worker = Worker(sys.stdin.buffer, answers)
    worker.listen()
    warm = import_module("ilmek.jobs.studio.warm_up")
    worker.run(warm.preparations_for(*sys.argv[2:]), warm.preparations())


if __name__ == "__main__":
    main()
