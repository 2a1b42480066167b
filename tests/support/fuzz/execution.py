"""Runs one input as a process would run it, in a folder of its own, and records what it did."""

import io
import os
import resource
import shutil
import sys
import tempfile
import threading
import time
import traceback
import warnings
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from fuzz.case import Case
from ilmek.cli import main
from ilmek.num.compiled import Kernel


@dataclass
class Run:
    """What came of an input.

    code        exit code; None if an exception came through
    error       its traceback
    raw         bytes that libraries wrote to the standard streams of the process
    before, after  contents of the folder, None for folders
    first_shown time until something was on the error stream [s]; of processor time as `seconds`
    grown       growth of the largest memory ever used [bytes]
    """

    case: Case
    code: int | None = None
    stdout: str = ""
    stderr: str = ""
    error: str = ""
    raw: bytes = b""
    warnings: list[str] = field(default_factory=list)
    before: dict[str, bytes | None] = field(default_factory=dict)
    after: dict[str, bytes | None] = field(default_factory=dict)
    left: list[str] = field(default_factory=list)
    seconds: float = 0.0
    first_shown: float = float("inf")
    grown: int = 0


class Stream(io.TextIOWrapper):
    """A standard stream in memory that may be a terminal and knows when it was first written."""

    def __init__(self, terminal: bool) -> None:
        super().__init__(io.BytesIO(), encoding="utf-8", errors="surrogateescape", newline="")
        self.terminal, self.first = terminal, float("inf")

    def isatty(self) -> bool:
        return self.terminal

    def write(self, text: str, /) -> int:
        self.first = min(self.first, time.process_time())
        return super().write(text)

    def text(self) -> str:
        self.flush()
        buffer: Any = self.buffer
        return buffer.getvalue().decode("utf-8", "replace")


class Runner:
    """Runs inputs one after the other in folders below `base`."""

    def __init__(self, base: Path) -> None:
        self.folder, self.temporary = base / "within" / "run", base / "temporary"
        self.raw = base / "raw"
        self.temporary.mkdir(parents=True)
        os.environ["TMPDIR"] = tempfile.tempdir = str(self.temporary)
        number = os.open(self.raw, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o600)
        for stream in (1, 2):
            os.dup2(number, stream)
        self.arrays: set[str] = set()
        _check_arrays(self.arrays)

    def __call__(self, case: Case) -> Run:
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        case.lay_out(self.folder)
        run = Run(case, before=contents(self.folder))
        out, err = Stream(case.terminal), Stream(case.terminal)
        os.truncate(self.raw, 0)
        threads, memory = threading.active_count(), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        with ExitStack() as stack:
            stack.enter_context(_inside(self.folder, case.environment))
            stack.enter_context(_streams(out, err))
            stack.enter_context(_noticed(run.warnings))
            began = time.process_time()
            _main(run)
            run.seconds = time.process_time() - began
        run.stdout, run.stderr, run.first_shown = out.text(), err.text(), err.first - began
        run.raw, run.after = self.raw.read_bytes(), contents(self.folder)
        run.grown = 1024 * (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - memory)
        until = time.monotonic() + 1.0
        while threading.active_count() > threads and time.monotonic() < until:
            time.sleep(0.01)
        if threading.active_count() > threads:
            run.left.append(f"thread {threading.enumerate()[-1].name}")
        run.warnings += [f"kernel {one}" for one in sorted(self.arrays)]
        self.arrays.clear()
        for path in self.temporary.iterdir():
            run.left.append(f"temporary {path.name}")
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        return run


def _check_arrays(found: set[str]) -> None:
    """From now on, note every kernel that is called with an array that is not contiguous or not of plain numbers."""
    usual = Kernel.__call__

    def checked(kernel: Any, *arguments: Any) -> object:
        for index, one in enumerate(arguments):
            if isinstance(one, np.ndarray) and not (
                one.flags.c_contiguous and one.flags.aligned and one.dtype.isnative
            ):
                found.add(f"{kernel.__module__}.{kernel.__qualname__} argument {index} is not contiguous")
        return usual(kernel, *arguments)

    Kernel.__call__ = checked  # type: ignore[method-assign]


def _main(run: Run) -> None:
    try:
        main.main(list(run.case.arguments), prog_name="ilmek")
        run.code = 0
    except SystemExit as error:
        code = error.code
        run.code = code if isinstance(code, int) else 0 if code is None else 1
    except BaseException:
        run.error = traceback.format_exc()


def contents(folder: Path) -> dict[str, bytes | None]:
    """The contents of all files below a folder; None for folders, b"" for links and devices."""
    found: dict[str, bytes | None] = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        found[name] = None if path.is_dir() else path.read_bytes() if path.is_file() else b""
    return found


@contextmanager
def _inside(folder: Path, environment: Mapping[str, str]) -> Iterator[None]:
    before = dict(os.environ)
    os.chdir(folder)
    os.environ.update(environment)
    try:
        yield
    finally:
        os.chdir(folder.parent)
        for name in environment:
            os.environ.pop(name, None)
            if name in before:
                os.environ[name] = before[name]


@contextmanager
def _streams(out: Stream, err: Stream) -> Iterator[None]:
    before = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = out, err
    try:
        yield
    finally:
        sys.stdout, sys.stderr = before


@contextmanager
def _noticed(found: list[str]) -> Iterator[None]:
    """Record warnings of Python and errors that nothing can raise, instead of showing them."""

    def warned(message: Any, category: Any, filename: str, lineno: int, *_: Any) -> None:
        found.append(f"{category.__name__} {Path(filename).name}:{lineno} {message}")

    def unraised(one: Any) -> None:
        found.append(f"unraisable {one.exc_type.__name__} {one.exc_value}")

    hook, thread_hook = sys.unraisablehook, threading.excepthook
    sys.unraisablehook, threading.excepthook = unraised, unraised
    try:
        with warnings.catch_warnings():
            warnings.resetwarnings()
            for category in (DeprecationWarning, PendingDeprecationWarning, ImportWarning, ResourceWarning):
                warnings.simplefilter("ignore", category)
            warnings.showwarning = warned
            yield
    finally:
        sys.unraisablehook, threading.excepthook = hook, thread_hook
