"""The temporary folder beside an output folder, and the removal of those that killed runs left behind.

A run holds a lock on its temporary folder; the system releases it however the run ends. A folder that can be locked
therefore has no owner, and the next run with the same output removes it. A run uses a new folder only if it holds its
lock and the folder still exists; otherwise another run has removed it.

Without locks (some network file systems, Windows) nothing is removed.
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
"""Locks of files and folders; None on Windows."""

_TRIES = 20


@contextlib.contextmanager
def work_folder(target: Path) -> Iterator[Path]:
    """A new, empty, hidden, locked folder beside `target`; removed at the end if it still exists."""
    for _ in range(_TRIES):
        work = target.parent / f".{_stem(target)}.{secrets.token_hex(4)}.part"
        work.mkdir()
        try:
            with locked(work) as mine:
                if mine:
                    yield work
                    return
        finally:
            shutil.rmtree(work, ignore_errors=True)
    raise OSError(f"no temporary folder could be made beside {target}")


@contextlib.contextmanager
def locked(folder: Path) -> Iterator[bool]:
    """Hold a folder's lock. Yields False if another run holds it or the folder is gone, True if there are no locks."""
    try:
        handle = os.open(folder, os.O_RDONLY)
    except FileNotFoundError:
        yield False
        return
    except OSError:  # Windows cannot open folders
        yield True
        return
    try:
        yield _lock(handle) is not False and _is_at(handle, folder)
    finally:
        os.close(handle)


def _stem(target: Path) -> str:
    """The name, or a digest of it if it is too long for a suffix."""
    return target.name if len(os.fsencode(target.name)) <= 200 else sha256(os.fsencode(target.name)).hexdigest()[:32]


def _lock(handle: int) -> bool | None:
    """Whether the lock was free; None if there are no locks."""
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


def clean_up(target: Path) -> None:
    """Remove folders that killed runs left beside `target`: unfinished ones and a replaced one if `target` exists."""
    ours = re.compile(rf"\.{re.escape(_stem(target))}\.[0-9a-f]{{8}}\.(part|old)")
    try:
        left = [entry for entry in target.parent.iterdir() if ours.fullmatch(entry.name)]
    except OSError:
        return
    for folder in left:
        if folder.is_symlink() or not folder.is_dir() or (folder.suffix == ".old" and not target.is_dir()):
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
