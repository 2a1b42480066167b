"""Calls of the operating system that the write protocol is made of; nothing else in ilmek renames or syncs.

Every change of a name goes through this module, so that a test can record the changes and simulate a power cut.
"""

import ctypes
import errno
import functools
import importlib.util
import os
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

fcntl: Any = importlib.import_module("fcntl") if importlib.util.find_spec("fcntl") else None
"""Locks and special syncs; None on Windows."""

_HERE = -100  # AT_FDCWD: paths are relative to the current folder
_NO_REPLACE, _EXCHANGE = 1, 2
_UNSUPPORTED = (errno.ENOSYS, errno.EINVAL, errno.ENOTSUP)


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Hold a lock that one process or thread has at a time; on Windows there is none. Raises OSError."""
    handle = os.open(path, os.O_RDWR | os.O_CREAT, 0o600)
    try:
        if fcntl is not None:
            fcntl.flock(handle, fcntl.LOCK_EX)
        yield
    finally:
        os.close(handle)


def make_folder(path: Path, mode: int = 0o700) -> None:
    """A new folder; default: closed to other users. Raises OSError."""
    path.mkdir(mode)


def write(path: Path, content: bytes) -> None:
    """Write a file. Raises OSError."""
    path.write_bytes(content)


def unlink(path: Path) -> None:
    """Remove the name of a file. Raises OSError."""
    path.unlink()


def remove_folder(path: Path) -> None:
    """Remove an empty folder. Raises OSError."""
    path.rmdir()


def sync(path: Path, mode: int | None = None) -> None:
    """Write a file, or the names in a folder, to the disk.

    mode  permissions that it gets before; they may close it to its owner
    Raises OSError.
    """
    if os.name == "nt" and path.is_dir():  # Windows cannot open folders
        return
    handle = os.open(path, os.O_RDONLY)
    try:
        if mode is not None:
            path.chmod(mode)
        # The usual call of macOS leaves the data in the cache of the disk.
        if hasattr(fcntl, "F_FULLFSYNC"):
            fcntl.fcntl(handle, fcntl.F_FULLFSYNC)
        else:
            os.fsync(handle)
    finally:
        os.close(handle)


def exchange(first: Path, second: Path) -> bool:
    """Exchange two names of one file system atomically; False where the system cannot. Raises OSError."""
    return _renameat2(first, second, _EXCHANGE)


def rename(source: Path, target: Path) -> None:
    """Rename to a name that must be free. Raises FileExistsError if it is not, and OSError."""
    if not _renameat2(source, target, _NO_REPLACE):
        if os.path.lexists(target):
            raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST), str(target))
        source.rename(target)


def replace(source: Path, target: Path) -> None:
    """Rename a file to a name that may exist. Raises OSError."""
    source.replace(target)


def keep(source: Path, copy: Path) -> None:
    """A second name of a file; where the system has no such names (FAT), a synced copy. Raises OSError."""
    try:
        os.link(source, copy)
    except OSError as error:
        if error.errno not in (*_UNSUPPORTED, errno.EPERM, errno.EMLINK, errno.EXDEV):
            raise
        shutil.copy2(source, copy)
        sync(copy)


def _renameat2(source: Path, target: Path, flag: int) -> bool:
    call = _call()
    if call is None:
        return False
    if call(_HERE, os.fsencode(source), _HERE, os.fsencode(target), flag) == 0:
        return True
    code = ctypes.get_errno()
    if code in _UNSUPPORTED:
        return False
    raise OSError(code, os.strerror(code), str(source), None, str(target))


@functools.cache
def _call() -> Callable[[int, bytes, int, bytes, int], int] | None:
    """The C library's `renameat2`; None where it has none."""
    found = getattr(ctypes.CDLL(None, use_errno=True), "renameat2", None) if os.name == "posix" else None
    if found is not None:
        found.argtypes = (ctypes.c_int, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_uint)
    return found
