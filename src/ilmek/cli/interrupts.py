"""Commands that answer Ctrl-C at once, whatever they are doing.

A command runs in a thread of its own; the main thread waits for it, and for signals. A signal ends the process within a
moment, also inside a compiled kernel or a library that cannot be interrupted: a result that is just being put in place
is completed, everything else is removed, and one line states which of both happened. This is the same as `kill -9`
followed by the repair that the next run does, so that there is only one course of events to get right.
"""

import contextlib
import os
import select
import signal
import sys
import threading
from collections.abc import Callable, Iterable, Iterator
from types import FrameType
from typing import Any, NoReturn

import click

from ilmek.errors import printable, shortened

STACK = 64 * 2**20
"""Stack of the command's thread [bytes], as large as that of a main thread on every system."""

SIGNALS = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))
_USUAL = (signal.SIG_DFL, signal.default_int_handler)
_LONGEST = 2000
"""Largest number of characters of an error line; the longest list of parameters has 1,200."""

_ERRORS: list[int] = []
"""A handle of the error stream of its own: from the usual one, messages of a library that decodes are caught."""

_RESTORES: list[Callable[[], str]] = []
"""What is done before a signal ends the process, to stop a loom or set back a terminal; it returns what is kept."""

_POLL = 0.1
"""Interval in which the main thread looks for signals that another thread has received [s]."""


def supervised(run: Callable[[], object]) -> object:
    """The value of `run`, computed in a thread; its errors are raised here.

    Where the program around this one handles signals itself, `run` is called directly.
    """
    _output("new_account")
    if threading.current_thread() is not threading.main_thread():
        return run()
    with _handled() as numbers:
        return _in_thread(run) if numbers else run()


def handle(numbers: Iterable[int]) -> None:
    """Let signals end the process, from now on."""
    if not _ERRORS:
        with contextlib.suppress(OSError, ValueError, AttributeError):  # no error stream
            _ERRORS.append(os.dup(sys.stderr.fileno()))
    for number in numbers:
        signal.signal(number, _end)


@contextlib.contextmanager
def before_end(restore: Callable[[], str]) -> Iterator[None]:
    """Call `restore` where a signal ends the process inside of the block, and state what it returns: what is kept.

    It is called in the main thread while the command goes on in its own.
    """
    _RESTORES.append(restore)
    try:
        yield
    finally:
        _RESTORES.pop()


def leave(message: str, status: int) -> NoReturn:
    """Print one line on the error stream, with the results that are in place, and exit with `status`."""
    for number in SIGNALS:
        if signal.getsignal(number) is _end:
            signal.signal(number, signal.SIG_IGN)  # the outcome is settled
    placed = _output("results_written")
    if placed and placed not in message:
        message = f"{message}; {placed}"
    with contextlib.suppress(OSError):
        click.echo(_line(message), err=True, nl=False)
    sys.exit(status)


def interrupted(number: int = signal.SIGINT) -> NoReturn:
    """Exit after an interrupt with a line that states what has been written."""
    leave(f"interrupted; {_output('account')}", 128 + number)


def _in_thread(run: Callable[[], object]) -> object:
    values: list[object] = []
    errors: list[BaseException] = []

    def work() -> None:
        try:
            values.append(run())
        except BaseException as error:
            errors.append(error)

    before = threading.stack_size(STACK)
    worker = threading.Thread(target=work, name="command", daemon=True)
    worker.start()
    threading.stack_size(before)
    while worker.is_alive():
        worker.join(_POLL)  # not without end: another thread may have received the signal
    if errors:
        raise errors[0]
    return values[0]


@contextlib.contextmanager
def _handled() -> Iterator[list[int]]:
    """Handle signals in the block; yields those that were not handled otherwise or ignored before."""
    before: dict[int, Any] = {n: handler for n in SIGNALS if (handler := signal.getsignal(n)) in (*_USUAL, _end)}
    try:
        handle(before)
        yield list(before)
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _end(number: int, _frame: FrameType | None) -> NoReturn:
    """Remove what the command has staged, state what has been written, end the process.

    This is the handler itself, and raises nothing: there is no instant at which an exception could be lost or arrive
    where nobody expects it. It runs in the main thread, which holds no lock while a command works in its own.
    """
    try:
        for other in SIGNALS:
            signal.signal(other, signal.SIG_IGN)  # one is enough
        account = _output("abandon")
        for restore in _RESTORES:
            with contextlib.suppress(Exception):
                account = restore()  # the last one is stated
        line = _line(f"interrupted; {account}")
        for errors in _ERRORS:
            if os.isatty(errors):
                line = f"\r\x1b[2K\x1b[?25h{line}"  # on the line of the progress bar, with the cursor that it hid
            # Written directly: the command's thread may hold the lock of the stream.
            if _writable(errors):
                os.write(errors, line.encode(sys.stderr.encoding, "replace"))
    finally:
        os._exit(128 + number)


def _writable(handle: int) -> bool:
    """Whether a stream takes a line without waiting for its reader."""
    return os.name == "nt" or handle in select.select([], [handle], [], _POLL)[1]


def _output(function: str) -> str:
    """What has been written, from `account`, `abandon` or `results_written` of ilmek.io.output."""
    output = sys.modules.get("ilmek.io.output")  # a command that has not loaded it has written nothing
    found = getattr(output, function, None)
    return str(found()) if found is not None else "" if function == "results_written" else "nothing was written"


def _line(message: str) -> str:
    """A message of the program in one line; control characters become spaces."""
    return f"ilmek: {' '.join(printable(shortened(message, _LONGEST)).split())}\n"
