"""The temporary folder beside an output folder, and the cleaning up of those whose run was killed.

A run holds a lock on its folder as long as it lives; the system lets go of it however the run ends. So a folder that
can be locked belongs to nobody, and the next run to the same place removes it. A run takes a new folder only once it
holds its lock and still finds it there: one that a cleaner was quicker to lock is left to the cleaner.

Where locks do not exist (some network file systems, Windows) nothing is cleaned.
"""

import contextlib
import importlib.util
import os
import re
import secrets
import shutil
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path
from typing import Any

_LOCKS: Any = importlib.import_module("fcntl") if importlib.util.find_spec("fcntl") else None
"""Locks of files and folders; not on Windows."""

_TRIES = 20


@contextlib.contextmanager
def work_folder(place: Path) -> Iterator[Path]:
    """A new, empty, hidden folder beside `place`, locked; removed at the end, if it is still there."""
    for _ in range(_TRIES):
        work = place.parent / f".{_stem(place)}.{secrets.token_hex(4)}.part"
        work.mkdir()
        try:
            with locked(work) as mine:
                if mine:
                    yield work
                    return
        finally:
            shutil.rmtree(work, ignore_errors=True)
    raise OSError(f"no temporary folder could be kept beside {place}")


@contextlib.contextmanager
def locked(folder: Path) -> Iterator[bool]:
    """Hold a folder's lock; False where another holds it or it is gone; True where there are no locks."""
    try:
        handle = os.open(folder, os.O_RDONLY)
    except FileNotFoundError:
        yield False
        return
    except OSError:  # Windows opens no folders
        yield True
        return
    try:
        yield _lock(handle) is not False and _is_at(handle, folder)
    finally:
        os.close(handle)


def _stem(place: Path) -> str:
    """The name, or, where it leaves no room for more letters, one made of it."""
    return place.name if len(os.fsencode(place.name)) <= 200 else sha256(os.fsencode(place.name)).hexdigest()[:32]


def _lock(handle: int) -> bool | None:
    """Whether the lock was free; None where there are no locks."""
    if _LOCKS is None:
        return None
    try:
        _LOCKS.flock(handle, _LOCKS.LOCK_EX | _LOCKS.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        return None
    return True


def _is_at(handle: int, folder: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(handle), folder.lstat())
    except OSError:
        return False


def clean_up(place: Path) -> None:
    """Remove what killed runs left beside `place`: unfinished folders, and, where `place` stands, its predecessor."""
    ours = re.compile(rf"\.{re.escape(_stem(place))}\.[0-9a-f]{{8}}\.(part|old)")
    try:
        left = [entry for entry in place.parent.iterdir() if ours.fullmatch(entry.name)]
    except OSError:
        return
    for folder in left:
        if folder.is_symlink() or not folder.is_dir() or (folder.suffix == ".old" and not place.is_dir()):
            continue
        with contextlib.suppress(OSError):
            _remove_if_free(folder)


def _remove_if_free(folder: Path) -> None:
    handle = os.open(folder, os.O_RDONLY)
    try:
        if _lock(handle):
            shutil.rmtree(folder, ignore_errors=True)
    finally:
        os.close(handle)
