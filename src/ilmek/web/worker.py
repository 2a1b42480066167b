"""A worker process of the studio: answers one request after the other.

    python -m ilmek.web.worker MEMORY

Requests come by standard input, answers leave by standard output (see `framing`). What a library prints goes to the
error stream. Memory beyond MEMORY bytes is refused by the system, and the request ends with an error.
"""

import contextlib
import os
import sys
import threading
import time
import traceback
from importlib import import_module
from queue import SimpleQueue
from typing import Any, BinaryIO, get_type_hints

import msgspec

from ilmek.errors import IlmekError
from ilmek.jobs.studio.answers import Binary, Context
from ilmek.progress import Cancelled, Progress
from ilmek.web.framing import Answer, Ask, Cancel, Message, News, Step, encoded, read_message

JSON = "application/json"
REPORT_EVERY = 0.05
"""Shortest time between two reports of progress [s]."""


class Worker:
    """Reads requests in a thread, so that a cancellation arrives while a request is answered."""

    def __init__(self, requests: BinaryIO, answers: BinaryIO) -> None:
        self._requests, self._answers = requests, answers
        self._queue: SimpleQueue[Ask | None] = SimpleQueue()
        self._cancelled: set[int] = set()
        self._writing = threading.Lock()

    def run(self) -> None:
        """Answer requests until there are no more."""
        threading.Thread(target=self._read, daemon=True).start()
        while (ask := self._queue.get()) is not None:
            began = time.perf_counter()
            status, kind, body = self._answered(ask)
            self._cancelled.discard(ask.number)
            self._send(Answer(ask.number, status, kind, body, time.perf_counter() - began))

    def _read(self) -> None:
        while (message := read_message(self._requests)) is not None:
            if isinstance(message, Cancel):
                self._cancelled.add(message.number)
            elif isinstance(message, Ask):
                self._queue.put(message)
        self._queue.put(None)

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
                self._send(Step(number, stage, share))

        return Progress(report, lambda: number in self._cancelled)

    def _answered(self, ask: Ask) -> tuple[int, str, bytes]:
        """Status, media type and body of the answer."""
        try:
            function, request_type = resolved(ask.function)
            request = msgspec.json.decode(ask.body, type=request_type)
            context = Context(
                ask.project, self._progress(ask.number), lambda news: self._send(News(ask.number, encoded_json(news)))
            )
            context.progress(0.0)
            answer = function(request, context)
        except Cancelled:
            return 499, JSON, b"{}"
        except IlmekError as error:
            return 422, JSON, encoded_json({"error": {"given": error.given, "allowed": error.allowed, "do": error.do}})
        except msgspec.ValidationError as error:
            return 400, JSON, encoded_json({"error": {"given": str(error), "allowed": "", "do": ""}})
        except MemoryError:
            given = "the computer's memory for one request is not enough"
            return 507, JSON, encoded_json({"error": {"given": given, "allowed": "", "do": "take a smaller task"}})
        except Exception as error:
            traceback.print_exc()
            given = f"a fault of the studio: {type(error).__name__}: {error}"
            return 500, JSON, encoded_json({"error": {"given": given, "allowed": "", "do": "please report it"}})
        if isinstance(answer, Binary):
            return 200, answer.kind, answer.body
        return 200, JSON, encoded_json(answer)


def resolved(name: str) -> tuple[Any, type]:
    """The function of "module:name" below ilmek.jobs, and the type of its request."""
    module, _, attribute = name.partition(":")
    function = getattr(import_module(f"ilmek.jobs.{module}"), attribute)
    return function, get_type_hints(function)["request"]


def encoded_json(value: object) -> bytes:
    """JSON of records, mappings and lists; numbers that are not finite are null."""
    return msgspec.json.encode(value)


def limit_memory(most: int) -> None:
    """Have the system refuse memory beyond `most` bytes, where it can."""
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (most, most))


def main() -> None:
    """Answer the requests of standard input on standard output."""
    limit_memory(int(sys.argv[1]))
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    import_module("ilmek.jobs.studio.warm_up").warm_up()
    Worker(sys.stdin.buffer, answers).run()


if __name__ == "__main__":
    main()
