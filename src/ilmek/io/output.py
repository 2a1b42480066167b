"""Output files and folders, complete or not written at all.

Files and folders are written under a temporary name beside the target and renamed at the end. An error, a full disk or
Ctrl-C before that leaves the target as it was. The next run with the same target removes what a killed run left behind
(see `work_folder`).
"""

import contextlib
import os
import secrets
import shutil
import sqlite3
import stat
from collections.abc import Iterator
from pathlib import Path

from ilmek.errors import OutputError
from ilmek.io.work_folder import clean_up, work_folder

MANIFEST = ".ilmek"
"""A file in each output folder that lists the files written by ilmek; only such a folder is ever replaced."""


@contextlib.contextmanager
def output_folder(path: Path, *, force: bool = False) -> Iterator[Path]:
    """A temporary folder, renamed to `path` when the block ends, and removed on an error.

    force  replace an existing folder if it is empty or contains only files that ilmek wrote
    Raises OutputError if `path` exists or cannot be written, and for an OSError inside the block.
    """
    check_free(path, force=force)
    target = _resolved(path)
    made: tuple[Path, ...] = ()
    clean_up(target)
    try:
        with _as_output_error(path):
            made = _make_parents(target.parent)
            with work_folder(target) as work:
                try:
                    yield work
                except OutputError as error:  # it names the temporary folder
                    given = error.given.replace(str(work), str(path))
                    raise OutputError(given, allowed=error.allowed, do=error.do) from None
                _write_manifest(work)
                check_free(path, force=force)
                _put(work, target)
    except BaseException:
        for folder in made:
            with contextlib.suppress(OSError):
                folder.rmdir()
        raise


def _resolved(path: Path) -> Path:
    """The path without links. Raises OutputError for circular links."""
    try:
        return path.resolve()
    except (OSError, RuntimeError):
        raise OutputError(f"{path} cannot be resolved: its links are circular", do="choose another path") from None


def check_free(path: Path, *, force: bool = False) -> None:
    """Raise OutputError unless a folder can be written at `path`; nothing is changed."""
    target = _resolved(path)
    if target.is_dir():
        _check_replaceable(path, target, force)
    elif os.path.lexists(target):
        raise OutputError(f"{path} exists and is not a folder", do="choose another output folder")
    above = _first_that_exists(target.parent)
    if not above.is_dir():
        raise OutputError(f"{path} cannot be made: {above} is not a folder", do="choose another output folder")
    if not os.access(above, os.W_OK | os.X_OK):
        raise OutputError(f"{path} cannot be made: {above} is not writable", do="choose another output folder")


def _check_replaceable(path: Path, target: Path, force: bool) -> None:
    if not force:
        raise OutputError(f"output folder {path} exists", do="choose another, or replace it with --force")
    if target in (Path.cwd(), *Path.cwd().parents):
        raise OutputError(f"output folder {path} is the folder you are in", do="choose another")
    try:
        present = sorted(entry.name for entry in target.iterdir())
        manifest = target / MANIFEST
        ours = {MANIFEST, *manifest.read_text(encoding="utf-8").split("\n")} if manifest.is_file() else set()
    except (OSError, UnicodeDecodeError) as error:
        raise OutputError(f"output folder {path} cannot be read ({error})", do="choose another") from None
    foreign = [name for name in present if name not in ours]
    if foreign:
        given = f"output folder {path} contains files that ilmek did not write: {', '.join(foreign[:3])}"
        raise OutputError(given + (" ..." if len(foreign) > 3 else ""), do="choose another; --force would lose them")


def _first_that_exists(folder: Path) -> Path:
    while not os.path.lexists(folder):
        folder = folder.parent
    return folder


def _make_parents(folder: Path) -> tuple[Path, ...]:
    """Make the missing folders; returns them, the innermost first."""
    missing = [parent for parent in (folder, *folder.parents) if not parent.exists()]
    folder.mkdir(parents=True, exist_ok=True)
    return tuple(missing)


def _write_manifest(work: Path) -> None:
    names = sorted(entry.name for entry in work.iterdir())
    (work / MANIFEST).write_text("\n".join(names), encoding="utf-8")


def _put(work: Path, target: Path) -> None:
    """Rename `work` to `target`; an existing folder is renamed first and removed last."""
    if not target.exists():
        work.rename(target)
        return
    aside = work.with_suffix(".old")
    target.rename(aside)
    try:
        work.rename(target)
    except BaseException:
        aside.rename(target)
        raise
    shutil.rmtree(aside, ignore_errors=True)


def check_file(path: Path) -> None:
    """Raise OutputError unless a file can be written at `path`; nothing is changed."""
    folder = _resolved(path).parent
    if path.is_dir():
        raise OutputError(f"{path} is a folder", do="give the name of a file")
    if not folder.is_dir():
        raise OutputError(f"{path} cannot be written: there is no folder {folder}", do="make the folder first")
    if not os.access(path if path.exists() else folder, os.W_OK):
        raise OutputError(f"{path} cannot be written: it is not writable", do="choose another path")


def write_whole(path: Path, content: str | bytes) -> None:
    """Write a file under a temporary name and rename it, so that an existing file is replaced only by a complete one.

    A device or pipe is written directly. Raises OutputError if the file cannot be written.
    """
    data = content.encode("utf-8") if isinstance(content, str) else content
    check_file(path)
    with _as_output_error(path):
        target = _resolved(path)
        if target.exists() and not stat.S_ISREG(target.stat().st_mode):
            path.write_bytes(data)
            return
        work = target.parent / f".{target.name}.{secrets.token_hex(4)}.part"
        try:
            work.write_bytes(data)
            work.replace(target)
        except BaseException:
            work.unlink(missing_ok=True)
            raise


@contextlib.contextmanager
def _as_output_error(path: Path) -> Iterator[None]:
    try:
        yield
    except (OSError, sqlite3.Error) as error:
        reason = getattr(error, "strerror", None) or str(error) or type(error).__name__
        raise OutputError(f"{path} cannot be written: {reason}", do="nothing was written") from error
