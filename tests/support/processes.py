"""Programs that a test starts, and conditions that it waits for.

    with start(ilmek("studio", folder)) as process: ...        # ended with all that it has started, whatever happens
    done = ended(ilmek("machines"))                            # status and streams

Each has a process group of its own, the sources of this checkout, and the usual answers to signals, also where this
test run ignores some (behind `nohup` or `&`).
"""

import contextlib
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

ROOT = Path(__file__).parents[2]
PATIENCE = 120.0
"""Longest wait for an event [s]. Nothing is proved by it: machines with other work are slow."""

Value = TypeVar("Value")
_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)
_INTERVAL = 0.005


def python(*words: object) -> list[str]:
    """The command of a Python program: `python("-c", script)`."""
    return [sys.executable, *map(str, words)]


def ilmek(*words: object) -> list[str]:
    """The command of ilmek: `ilmek("design", "cam")`."""
    return python("-m", "ilmek", *words)


def environment(changes: Mapping[str, str | None] | None = None) -> dict[str, str]:
    """The environment of a program: the sources of this checkout, and some changes; None: not set."""
    paths = [str(ROOT / "src"), str(ROOT / "tests" / "support")]
    changed = {**os.environ, "PYTHONPATH": os.pathsep.join(paths), **(changes or {})}
    return {name: value for name, value in changed.items() if value is not None}


@contextmanager
def start(
    command: Sequence[str], *, changes: Mapping[str, str | None] | None = None, **options: Any
) -> Iterator["subprocess.Popen[Any]"]:
    """A program while it runs; its streams are pipes of text where the options of Popen are not others."""
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    with _usual_signals():
        process = subprocess.Popen(command, env=environment(changes), start_new_session=True, **{**pipes, **options})
    try:
        yield process
    finally:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
        with process:  # closes its streams and waits
            pass


def ended(
    command: Sequence[str], *, changes: Mapping[str, str | None] | None = None, **options: Any
) -> "subprocess.CompletedProcess[Any]":
    """A program that has ended by itself."""
    with start(command, changes=changes, **options) as process:
        output, errors = process.communicate(timeout=PATIENCE)
    return subprocess.CompletedProcess(command, process.returncode, output, errors)


def printed(command: Sequence[str], **options: Any) -> str:
    """What a program prints that succeeds."""
    done = ended(command, **options)
    assert done.returncode == 0, done.stderr
    return str(done.stdout)


def until(condition: Callable[[], Value], missing: object = "the condition") -> Value:
    """The first value of a condition that is true, from another thread, process or the disc."""
    end = time.monotonic() + PATIENCE
    while not (value := condition()):
        assert time.monotonic() < end, f"{missing() if callable(missing) else missing} has not come"
        time.sleep(_INTERVAL)
    return value


@contextmanager
def _usual_signals() -> Iterator[None]:
    """Hand on no ignored signal: a program inherits that one is ignored, not that a handler does nothing."""
    ignored = [number for number in _SIGNALS if signal.getsignal(number) is signal.SIG_IGN]
    assert not ignored or threading.current_thread() is threading.main_thread(), "start it in the main thread"
    for number in ignored:
        signal.signal(number, lambda *_: None)
    try:
        yield
    finally:
        for number in ignored:
            signal.signal(number, signal.SIG_IGN)
