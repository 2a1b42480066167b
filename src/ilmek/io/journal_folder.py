"""The folder of a journal: what a controller keeps of one carpet, and the lock that admits one controller alone.

The journal itself is append-only (`ilmek.io.journal_file`); beside it are the carpet on the simulated loom (`woven`),
the file that the running controller has locked (`lock`), and the socket of its command channel (`control`).
"""

import errno
import os
import stat
import time
from contextlib import suppress
from pathlib import Path

from ilmek.errors import LoomError, OutputError
from ilmek.io.closable import Closable
from ilmek.io.journal_file import JournalFile, SystemFile, require_size
from ilmek.io.output import disk
from ilmek.io.regular_file import open_regular

JOURNAL, WOVEN, LOCK, CHANNEL = "journal", "woven", "lock", "control"
"""The names in the folder."""

_TRIES, _PAUSE = 5, 0.01
"""Trials to lock, and the time between two [s]."""

_NAMES = {JOURNAL, WOVEN, LOCK, CHANNEL}


class JournalFolder(Closable):
    """A journal's folder, made if there is none, and locked until it is closed.

    new  remove the carpet that the folder has, and begin another one
    Raises LoomError where another process runs on it, for a carpet without its journal, and for a folder of something
    else; OutputError where it cannot be written.
    """

    def __init__(self, path: Path, *, new: bool = False) -> None:
        self.path = path
        self._lock = -1
        try:
            self._make()
            self._lock = _locked(path)
            if new:
                self._remove()
            self.journal = JournalFile(self._opened(), str(path / JOURNAL))
        except OSError as error:
            self._unlock()
            raise _unwritable(path, error) from error
        except BaseException:
            self._unlock()
            raise

    @property
    def woven(self) -> Path:
        """The file of the carpet on the simulated loom."""
        return self.path / WOVEN

    def close(self) -> None:
        """Close the journal and give up the lock."""
        self.journal.close()
        self._unlock()

    def _make(self) -> None:
        try:
            disk.make_folder(self.path)
        except FileExistsError:
            foreign = sorted({one.name for one in self.path.iterdir()} - _NAMES)
            if foreign and not (self.path / JOURNAL).exists():
                given = f"{self.path} is a folder of something else: it has {foreign[0]}"
                allowed = "a new folder, or one of a journal"
                raise LoomError(given, allowed=allowed, do="give another --journal") from None
        else:
            disk.sync(self.path.parent)

    def _opened(self) -> SystemFile:
        path = self.path / JOURNAL
        try:
            file = SystemFile(path)
        except FileNotFoundError:
            if os.path.lexists(self.woven):
                raise LoomError(
                    f"{self.path} has a carpet but no journal", do="restore the file journal, or begin with --new"
                ) from None
            file = SystemFile(path, create=True)
            disk.sync(self.path)
        return file

    def _remove(self) -> None:
        for name in (JOURNAL, WOVEN):  # a carpet without its journal is refused, a journal without its carpet too
            with suppress(FileNotFoundError):
                disk.unlink(self.path / name)
                disk.sync(self.path)

    def _unlock(self) -> None:
        if self._lock >= 0:
            os.close(self._lock)
            self._lock = -1


def require_journal(path: Path) -> None:
    """Raise LoomError unless a folder has a journal, a regular file."""
    try:
        regular = stat.S_ISREG((path / JOURNAL).stat(follow_symlinks=False).st_mode)
    except FileNotFoundError:
        raise LoomError(f"{path} has no journal", do="give the --journal of a call of `ilmek run`") from None
    except (OSError, ValueError) as error:
        raise LoomError(f"{path} cannot be read: {getattr(error, 'strerror', '') or error}") from None
    if not regular:
        raise LoomError(f"{path / JOURNAL} is no file", do="give the --journal of a call of `ilmek run`")


def journal_bytes(path: Path) -> bytes:
    """The journal of a folder, whether or not a controller runs on it. Raises LoomError."""
    require_journal(path)
    try:
        file, size = open_regular(path / JOURNAL, follow=False)
        with file:
            require_size(path / JOURNAL, size)
            return file.read(size)
    except OSError as error:
        raise LoomError(f"{path / JOURNAL} cannot be read: {error.strerror or error}") from error


def running_process(path: Path) -> int | None:
    """The number of the process that has locked a folder; None if there is none."""
    try:
        handle = os.open(path / LOCK, os.O_RDONLY)
    except OSError:
        return None
    try:
        disk.fcntl.flock(handle, disk.fcntl.LOCK_SH | disk.fcntl.LOCK_NB)
    except OSError:
        return _number(os.read(handle, 32))
    finally:
        os.close(handle)
    return None


def _locked(path: Path) -> int:
    """The handle of the lock, which has the number of this process. Raises LoomError, OSError."""
    if disk.fcntl is None:
        raise LoomError("this system cannot lock a journal", allowed="Linux, macOS")
    handle = os.open(path / LOCK, os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0), 0o600)
    try:
        if not _taken(handle):
            given = f"{path} is in use: process {_number(os.read(handle, 32))} weaves with this journal"
            do = f"stop it with `ilmek stop --journal {path}`, or give another --journal"
            raise LoomError(given, allowed="one controller", do=do)
        os.ftruncate(handle, 0)
        os.write(handle, f"{os.getpid()}\n".encode())
    except BaseException:
        os.close(handle)
        raise
    return handle


def _taken(handle: int) -> bool:
    """Lock a file; False where another process has locked it for longer than a moment. Raises OSError."""
    for _ in range(_TRIES):
        try:
            disk.fcntl.flock(handle, disk.fcntl.LOCK_EX | disk.fcntl.LOCK_NB)
        except OSError as error:
            if error.errno not in (errno.EWOULDBLOCK, errno.EACCES):
                raise
            time.sleep(_PAUSE)  # `running_process` locks it for a moment
        else:
            return True
    return False


def _number(text: bytes) -> int:
    return int(text) if text.strip().isdigit() else 0


def _unwritable(path: Path, error: OSError) -> OutputError:
    return OutputError(
        f"{path} cannot be written: {error.strerror or error}", do="give another --journal, or correct its permissions"
    )
