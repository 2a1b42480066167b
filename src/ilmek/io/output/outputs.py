"""The outputs of one call: all of them are written, or none (see `ilmek.io.output`)."""

import contextlib
import signal
import sqlite3
import threading
import weakref
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from types import FrameType, MappingProxyType, TracebackType
from typing import Any

from ilmek.errors import OutputError
from ilmek.io.output.target import FileTarget, FolderTarget, StreamTarget, Target, is_stream, resolved
from ilmek.progress import SILENT, Progress

_COMMIT = threading.Lock()
"""Held while results are exchanged, so that `abandon` reports truly what has been written."""

_PATIENCE = 20.0
"""Time that an interrupted run waits for a commit to end [s]."""

_OPEN: list["weakref.ref[Outputs]"] = []
_WRITTEN: list[Path] = []


class Outputs:
    """The files and folders that one call writes.

    force     replace folders that ilmek wrote, and files of any origin
    inputs    name of an input in messages -> its path; an output never replaces one without `force`
    progress  its stop flag is read before the commit

    with Outputs() as outputs:
        outputs.expect_file(page, "--report")       checked before any work
        with outputs.folder(path) as work:          written in a hidden folder
            (work / "chart.png").write_bytes(png)
        outputs.write(page, html)
    Here both are in place, or none.
    """

    def __init__(
        self, *, force: bool = False, inputs: Mapping[str, Path] = MappingProxyType({}), progress: Progress = SILENT
    ) -> None:
        self.force, self.progress = force, progress
        self._inputs = {label: resolved(path) for label, path in inputs.items() if path.exists()}
        self._targets: dict[Path, Target] = {}

    def expect_file(self, path: Path, label: str = "") -> None:
        """Check, before any work, that a file can be written at `path`; nothing is changed.

        label  the output's name in messages, like --report
        Raises OutputError for a folder, a path that is an input or another output of the call, a missing or closed
        folder, and, without `force`, for a file that ilmek did not write.
        """
        target = resolved(path)
        kind = StreamTarget if is_stream(path) else FileTarget
        self._expect(kind(path, label or str(path), target, self.force))

    def expect_folder(self, path: Path, label: str = "") -> None:
        """Check, before any work, that a folder can be written at `path`; nothing is changed.

        Raises OutputError for a folder that exists, with `force` only if it contains anything that ilmek did not
        write; for a path that is no folder, is or contains an input or another output of the call, or is closed.
        """
        self._expect(FolderTarget(path, label or str(path), resolved(path), self.force))

    @contextlib.contextmanager
    def folder(self, path: Path) -> Iterator[Path]:
        """A hidden folder, in which the files of the folder `path` are written.

        Raises OutputError as `expect_folder`, and for an OSError inside the block.
        """
        target = self._target(path, self.expect_folder)
        with self._as_output_error(target):
            with _COMMIT:
                work = target.stage()
            try:
                yield work
            except OutputError as error:  # it names the hidden folder
                given = error.given.replace(str(work), str(path))
                raise OutputError(given, allowed=error.allowed, do=error.do) from None
            target.complete = True

    @contextlib.contextmanager
    def file(self, path: Path) -> Iterator[Path]:
        """A hidden file, in which the content of the file `path` is written.

        Raises OutputError as `expect_file`, for a device or a pipe, and for an OSError inside the block.
        """
        target = self._target(path, self.expect_file)
        if not isinstance(target, FileTarget):
            raise OutputError(f"{path} is not a file", do="give the name of a file")
        with self._as_output_error(target):
            with _COMMIT:
                target.stage()
            yield target.new
            target.complete = True

    def write(self, path: Path, content: str | bytes) -> None:
        """Stage the content of a file. Raises OutputError as `expect_file`, and if it cannot be written."""
        target = self._target(path, self.expect_file)
        with self._as_output_error(target):
            with _COMMIT:
                target.stage()
            target.fill(content.encode("utf-8") if isinstance(content, str) else content)
            target.complete = True

    def commit(self) -> None:
        """Put everything that was staged in place. Raises OutputError, and Cancelled; then nothing is written."""
        complete = (target for target in self._targets.values() if target.complete)
        staged = sorted(complete, key=lambda target: isinstance(target, StreamTarget))  # what cannot be undone, last
        for target in staged:
            with self._as_output_error(target):
                target.seal()
        for target in staged:
            with self._as_output_error(target):
                target.check()
        self.progress(1.0)
        with _undisturbed():
            self._put(staged)
            _WRITTEN.extend(target.path for target in staged)
        for target in staged:
            target.discard()

    def discard(self) -> None:
        """Remove what is staged, and folders made for it. What is in place stays."""
        for target in list(self._targets.values()):  # a thread that is being ended may add one
            target.discard()

    @property
    def kept(self) -> list[Path]:
        """Outputs of the call that existed before it."""
        return [target.path for target in list(self._targets.values()) if target.existed]

    @property
    def streamed(self) -> list[Path]:
        """Devices and pipes that have been written."""
        return [t.path for t in list(self._targets.values()) if isinstance(t, StreamTarget) and t.begun]

    def __enter__(self) -> "Outputs":
        new_account()
        _OPEN.append(weakref.ref(self))
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            if kind is None:
                self.commit()
        finally:
            try:
                self.discard()
            finally:
                _OPEN[:] = [one for one in _OPEN if one() not in (None, self)]

    def _target(self, path: Path, expect: Callable[[Path], None]) -> Target:
        """The target of a path, checked by `expect` if it is new. Raises OutputError."""
        if resolved(path) not in self._targets:
            expect(path)
        return self._targets[resolved(path)]

    def _expect(self, target: Target) -> None:
        if not target.contains:  # that a file is an input says more than that it exists
            self._check_apart(target)
        with self._as_output_error(target):
            target.repair()
            target.check()
        if target.contains:
            self._check_apart(target)
        self._targets[target.target] = target

    def _check_apart(self, target: Target) -> None:
        """Raise OutputError for an output that is, or whose folder contains, another output or an input."""
        for other in self._targets.values():
            if target.meets(other.target) or other.meets(target.target):
                inside = target.target != other.target
                given = f"{target.label} {target.path} and {other.label} {other.path} are "
                raise OutputError(
                    given + ("one inside the other" if inside else "the same"), do="give each output its own path"
                )
        for label, path in self._inputs.items():
            if target.meets(path) and (target.contains or not self.force):
                allowed = "" if target.contains else ", or replace the input with --force"
                do = f"choose another path{allowed}"
                raise OutputError(f"{target.label} {target.path} would replace the input {label} {path}", do=do)

    def _put(self, staged: Sequence[Target]) -> None:
        """Put targets in place one by one; on a failure undo all."""
        done: list[Target] = []
        try:
            for target in staged:
                done.append(target)
                with self._as_output_error(target):
                    target.put()
        except BaseException as error:
            rescued = [text for target in reversed(done) if (text := _undone(target))]
            if rescued:
                given = error.given if isinstance(error, OutputError) else "the outputs cannot be written"
                raise OutputError(given, do="; ".join(rescued)) from error
            raise

    @contextlib.contextmanager
    def _as_output_error(self, target: Target) -> Iterator[None]:
        try:
            yield
        except (OSError, sqlite3.Error) as error:
            reason = getattr(error, "strerror", None) or str(error) or type(error).__name__
            kept = "; the old one is kept" if target.existed else ""
            done = f"{_nothing_but(self.streamed)} was written{kept}"
            raise OutputError(f"{target.path} cannot be written: {reason}", do=done) from error


def _undone(target: Target) -> str:
    """Put the old result in place again; what lies where if that fails, else nothing."""
    try:
        target.undo()
    except OSError:
        return target.rescue()
    return ""


@contextlib.contextmanager
def joined(outputs: Outputs | None, *, force: bool = False, progress: Progress = SILENT) -> Iterator[Outputs]:
    """The outputs of the caller, who commits them; without such, outputs that are committed at the end of the block."""
    if outputs is not None:
        yield outputs
        return
    with Outputs(force=force, progress=progress) as own:
        yield own


def write_file(path: Path, content: str | bytes) -> None:
    """Write one file, whole or not at all; an existing one is replaced. Raises OutputError."""
    with Outputs(force=True) as outputs:
        outputs.write(path, content)


def abandon() -> str:
    """Remove everything that this process has staged, for a process that ends now; returns what has been written.

    A commit that has begun is completed first; none begins after it.
    """
    if not _COMMIT.acquire(timeout=_PATIENCE):
        return "the new result was being put in place: it is whole, or the old one is"
    written = account()
    for outputs in _running():
        outputs.discard()
    return written


def account() -> str:
    """What the call that is running, or the last one, has written."""
    running = _running()
    kept = [path for outputs in running for path in outputs.kept]
    nothing = f"{_nothing_but([path for outputs in running for path in outputs.streamed])} was written"
    return results_written() or (f"{nothing}; the old result is kept: {_listed(kept)}" if kept else nothing)


def results_written() -> str:
    """The results that the call that is running, or the last one, has put in place; empty if none."""
    return f"the new result is in place: {_listed(_WRITTEN)}" if _WRITTEN else ""


def new_account() -> None:
    """Begin a call: what earlier ones have written is not of it."""
    if not _running():
        _WRITTEN.clear()


def _running() -> list[Outputs]:
    return [outputs for one in list(_OPEN) if (outputs := one()) is not None]


def _nothing_but(streamed: Sequence[Path]) -> str:
    """What was written where no file or folder was."""
    return f"only {_listed(streamed)}" if streamed else "nothing"


def _listed(paths: Sequence[Path]) -> str:
    return ", ".join(map(str, paths))


@contextlib.contextmanager
def _undisturbed() -> Iterator[None]:
    """Hold the lock of commits; signals that arrive in the main thread are handled after the block."""
    arrived: list[int] = []

    def later(number: int, _frame: FrameType | None) -> None:
        arrived.append(number)

    before: dict[int, Any] = {}
    if threading.current_thread() is threading.main_thread():
        numbers = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
        before = {number: signal.signal(number, later) for number in numbers if callable(signal.getsignal(number))}
    try:
        with _COMMIT:
            yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        for number in arrived:
            signal.raise_signal(number)
