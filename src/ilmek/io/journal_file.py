"""A journal on a disc: an append-only file of which a known part is durable.

    append    behind the end; of a write that fails nothing counts, and its part is cut off again
    sync      everything that was appended is durable (fdatasync)
    truncate  what a power cut left behind the last whole record is cut off, durably

After a failed sync a system may count pages as written that are not [P. Rebello et al., Can applications recover from
fsync failures?, USENIX ATC 2020]. What is not certainly durable is therefore kept, and written again before the next
sync.
"""

import os
from pathlib import Path
from typing import Any, Protocol

from ilmek.errors import LoomError
from ilmek.io.closable import Closable
from ilmek.io.output import disk

LARGEST_JOURNAL = 4_000_000_000
"""Largest size of a journal that is read [bytes]: more than 100 bytes a knot of the largest programme."""

_SYNC: Any = getattr(os, "fdatasync", os.fsync)


class RawFile(Protocol):
    """The calls of a system on one open file; a test puts a disc that loses writes in their stead."""

    def size(self) -> int:
        """Length of the file [bytes]."""

    def read(self) -> bytes:
        """The whole content."""

    def write(self, data: bytes, offset: int) -> int:
        """Write at an offset; the number of bytes that were written, which may be fewer. Raises OSError."""

    def truncate(self, length: int) -> None:
        """Cut the file to a length. Raises OSError."""

    def sync(self) -> None:
        """Make the content durable. Raises OSError."""

    def close(self) -> None:
        """Close the file."""


class SystemFile:
    """A file of the operating system, opened for reading and writing. Raises OSError."""

    def __init__(self, path: Path, *, create: bool = False) -> None:
        flags = os.O_RDWR | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)
        self._handle = os.open(path, flags | (os.O_CREAT | os.O_EXCL if create else 0), 0o600)

    def size(self) -> int:
        """Length of the file [bytes]."""
        return os.fstat(self._handle).st_size

    def read(self) -> bytes:
        """The whole content."""
        with open(self._handle, "rb", closefd=False) as file:
            file.seek(0)
            return file.read()

    def write(self, data: bytes, offset: int) -> int:
        """Write at an offset; the number of bytes that were written. Raises OSError."""
        os.lseek(self._handle, offset, os.SEEK_SET)
        return os.write(self._handle, data)

    def truncate(self, length: int) -> None:
        """Cut the file to a length. Raises OSError."""
        os.ftruncate(self._handle, length)

    def sync(self) -> None:
        """Make the content durable. Raises OSError."""
        if hasattr(disk.fcntl, "F_FULLFSYNC"):  # the usual call of macOS leaves the data in the cache of the disk
            disk.fcntl.fcntl(self._handle, disk.fcntl.F_FULLFSYNC)
        else:
            _SYNC(self._handle)

    def close(self) -> None:
        """Close the file."""
        if self._handle >= 0:
            os.close(self._handle)
            self._handle = -1


class JournalFile(Closable):
    """A journal of which the first `durable` bytes are certainly on the disc."""

    def __init__(self, file: RawFile, name: str = "the journal") -> None:
        self._file, self._name = file, name
        self.length = self.durable = file.size()
        self._unsynced = bytearray()
        self._rewrite = self._tail = False

    def read(self) -> bytes:
        """The whole content. Raises LoomError beyond LARGEST_JOURNAL, and OSError."""
        require_size(self._name, self.length)
        return self._file.read()

    def append(self, data: bytes) -> None:
        """Write behind the end. Raises OSError; then nothing of the data counts."""
        if self._tail:  # of a write that failed, and could not be cut off at once
            self._file.truncate(self.length)
            self._tail = False
        try:
            self._write(data, self.length)
        except OSError:
            self._cut_tail()
            raise
        self._unsynced += data
        self.length += len(data)

    def sync(self) -> None:
        """Make everything durable that was appended. Raises OSError; the next call then writes it again."""
        if not self._unsynced and not self._rewrite:
            return
        if self._rewrite:
            self._write(bytes(self._unsynced), self.durable)
        try:
            self._file.sync()
        except OSError:
            self._rewrite = True
            raise
        self._rewrite = False
        self.durable = self.length
        self._unsynced.clear()

    def truncate(self, size: int) -> None:
        """Cut off what is behind a number of bytes, durably. Raises OSError."""
        self._file.truncate(size)
        self._file.sync()
        self.length = self.durable = size
        self._unsynced.clear()

    def close(self) -> None:
        """Close the file; nothing is synced."""
        self._file.close()

    def _write(self, data: bytes, offset: int) -> None:
        done = self._file.write(data, offset)
        while done < len(data):  # a disc that becomes full takes a part, and refuses the rest
            done += self._file.write(data[done:], offset + done)

    def _cut_tail(self) -> None:
        self._tail = True
        try:
            self._file.truncate(self.length)
        except OSError:
            return
        self._tail = False


def require_size(name: object, size: int) -> None:
    """Raise LoomError for a journal beyond LARGEST_JOURNAL."""
    if size > LARGEST_JOURNAL:
        raise LoomError(f"{name} has {size:,} bytes", allowed=f"at most {LARGEST_JOURNAL // 1_000_000:,} MB")
