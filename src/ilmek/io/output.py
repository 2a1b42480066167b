"""Files out, whole or not at all.

A folder is filled under a temporary name beside its place and put there by one rename at the end; a single file too.
Whatever goes wrong before (an error, a full disk, Ctrl-C), the place is left as it was. What a run that was killed
outright leaves beside it, the next run to the same place removes (see `work_folder`).
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
"""A file in each output folder that lists what ilmek put there: only such a folder is ever replaced."""


@contextlib.contextmanager
def output_folder(path: Path, *, force: bool = False) -> Iterator[Path]:
    """A folder to fill, which becomes `path` when the block ends well, and vanishes when it does not.

    force  replace a folder that is there, provided that it is empty or holds only files that ilmek put there
    Raises OutputError where `path` is taken or cannot be written; an OSError inside becomes one too.
    """
    check_free(path, force=force)
    place = _resolved(path)
    made: tuple[Path, ...] = ()
    clean_up(place)
    try:
        with _as_output_error(path):
            made = _make_parents(place.parent)
            with work_folder(place) as work:
                try:
                    yield work
                except OutputError as error:  # of a file in it: a person knows the folder by its own name
                    said = error.given.replace(str(work), str(path))
                    raise OutputError(said, allowed=error.allowed, do=error.do) from None
                _write_manifest(work)
                check_free(path, force=force)
                _put(work, place)
    except BaseException:
        for folder in made:
            with contextlib.suppress(OSError):
                folder.rmdir()
        raise


def _resolved(path: Path) -> Path:
    """The path without links. Raises OutputError where links lead in a circle."""
    try:
        return path.resolve()
    except (OSError, RuntimeError):
        raise OutputError(f"{path} cannot be followed: its links lead in a circle", do="choose another place") from None


def check_free(path: Path, *, force: bool = False) -> None:
    """Raise OutputError unless a folder may be put at `path`; nothing is touched."""
    place = _resolved(path)
    if place.is_dir():
        _check_replaceable(path, place, force)
    elif os.path.lexists(place):
        raise OutputError(f"{path} exists and is not a folder", do="choose another output folder")
    above = _first_that_exists(place.parent)
    if not above.is_dir():
        raise OutputError(f"{path} cannot be made: {above} is not a folder", do="choose another output folder")
    if not os.access(above, os.W_OK | os.X_OK):
        raise OutputError(f"{path} cannot be made: {above} is not writable", do="choose another output folder")


def _check_replaceable(path: Path, place: Path, force: bool) -> None:
    if not force:
        raise OutputError(f"output folder {path} exists", do="choose another, or replace it with --force")
    if place in (Path.cwd(), *Path.cwd().parents):
        raise OutputError(f"output folder {path} is the folder you are in", do="choose another")
    try:
        there = sorted(entry.name for entry in place.iterdir())
        manifest = place / MANIFEST
        ours = {MANIFEST, *manifest.read_text(encoding="utf-8").split("\n")} if manifest.is_file() else set()
    except (OSError, UnicodeDecodeError) as error:
        raise OutputError(f"output folder {path} cannot be read ({error})", do="choose another") from None
    foreign = [name for name in there if name not in ours]
    if foreign:
        given = f"output folder {path} holds files that ilmek did not make: {', '.join(foreign[:3])}"
        raise OutputError(given + (" ..." if len(foreign) > 3 else ""), do="choose another; --force would lose them")


def _first_that_exists(folder: Path) -> Path:
    while not os.path.lexists(folder):
        folder = folder.parent
    return folder


def _make_parents(folder: Path) -> tuple[Path, ...]:
    """The folders that had to be made, the innermost first."""
    missing = [parent for parent in (folder, *folder.parents) if not parent.exists()]
    folder.mkdir(parents=True, exist_ok=True)
    return tuple(missing)


def _write_manifest(work: Path) -> None:
    names = sorted(entry.name for entry in work.iterdir())
    (work / MANIFEST).write_text("\n".join(names), encoding="utf-8")


def _put(work: Path, place: Path) -> None:
    """Rename `work` to `place`; what was there is set aside first and removed last."""
    if not place.exists():
        work.rename(place)
        return
    aside = work.with_suffix(".old")
    place.rename(aside)
    try:
        work.rename(place)
    except BaseException:
        aside.rename(place)
        raise
    shutil.rmtree(aside, ignore_errors=True)


def check_file(path: Path) -> None:
    """Raise OutputError unless a file can be put at `path`; nothing is touched."""
    folder = _resolved(path).parent
    if path.is_dir():
        raise OutputError(f"{path} is a folder", do="give the name of a file")
    if not folder.is_dir():
        raise OutputError(f"{path} cannot be written: there is no folder {folder}", do="make the folder first")
    if not os.access(path if path.exists() else folder, os.W_OK):
        raise OutputError(f"{path} cannot be written: it is not writable", do="choose another place")


def write_whole(path: Path, content: str | bytes) -> None:
    """Write a file by one rename at the end; an existing file is replaced only when the new one is complete.

    Raises OutputError where it cannot be written. A device or pipe is written to as it is.
    """
    data = content.encode("utf-8") if isinstance(content, str) else content
    check_file(path)
    with _as_output_error(path):
        place = _resolved(path)
        if place.exists() and not stat.S_ISREG(place.stat().st_mode):
            path.write_bytes(data)
            return
        work = place.parent / f".{place.name}.{secrets.token_hex(4)}.part"
        try:
            work.write_bytes(data)
            work.replace(place)
        except BaseException:
            work.unlink(missing_ok=True)
            raise


@contextlib.contextmanager
def _as_output_error(path: Path) -> Iterator[None]:
    try:
        yield
    except (OSError, sqlite3.Error) as error:
        said = getattr(error, "strerror", None) or str(error) or type(error).__name__
        raise OutputError(f"{path} cannot be written: {said}", do="nothing was written") from error
