"""Files that only the user can have written: a cache folder closed to others, its entries, and how it is kept small.

Entries are trusted by whoever reads them, so they are read only from a folder that belongs to the user and is closed to
everybody else, below folders that nobody else can rename or replace. Without such a folder nothing is kept. Each entry
begins with a checksum: one that is incomplete, damaged or of someone else is removed.
"""

import hashlib
import os
import stat
import tempfile
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

CHECKSUM = hashlib.sha256().digest_size
"""Bytes of the checksum that an entry begins with."""

LARGEST_ENTRY = 20_000_000
"""Largest size of an entry that is read or written [bytes]; the largest kernel takes 0.5 MB."""

LARGEST_FOLDER = 200_000_000
"""Size of all entries beyond which those unused for longest are removed [bytes]; all kernels take about 15 MB."""

DAY = 86400.0
UNUSED, USED, LEFT = 90 * DAY, DAY, DAY / 24
"""Times after which an unused entry is removed, a use is noted again, what an interrupted run left is removed [s]."""

ENTRY = ".kernel"
"""How the names of entries end."""

_POSIX = os.name == "posix"
_LINKS = 40
"""Links followed on the path of the folder."""

_pruned: set[Path] = set()


class DamagedEntryError(Exception):
    """An entry is incomplete, damaged, or not of the user."""


def private_folder(name: str) -> Path | None:
    """The user's cache folder ilmek/`name`, made where missing; None if others could have written in it.

    The cache is `$XDG_CACHE_HOME` if that is an absolute path, else `~/.cache`. The folder must belong to the user and
    be closed to others. Each folder above it must belong to the user or to root, and may be writable by others only
    with the sticky bit. On a system without owners (Windows) the home folder is relied on.
    """
    with suppress(OSError, RuntimeError):  # no home, a file instead of a folder, or a disc that cannot be written
        given = Path(os.environ.get("XDG_CACHE_HOME", ""))
        cache = given if given.is_absolute() else Path.home() / ".cache"
        if not cache.is_absolute():
            return None
        folder = cache / "ilmek" / name
        for one in (*reversed(folder.parents), folder):
            if not one.exists():
                one.mkdir(mode=0o700, exist_ok=True)
        found = folder.lstat()
        closed = not _POSIX or (found.st_uid == os.geteuid() and not stat.S_IMODE(found.st_mode) & 0o077)
        if stat.S_ISDIR(found.st_mode) and closed and os.access(folder, os.W_OK) and _only_trusted_above(folder):
            return folder
    return None


def _only_trusted_above(folder: Path, links: int = 0) -> bool:
    """Whether nobody but the user and root can replace a folder on this path, or where its links point."""
    if not _POSIX:
        return True
    for above in reversed(folder.parents):
        found = above.lstat()
        if found.st_uid not in (0, os.geteuid()) or links > _LINKS:
            return False
        if stat.S_ISLNK(found.st_mode):
            inside = above.parent.resolve() / above.readlink() / "any"
            if not _only_trusted_above(inside, links + 1):
                return False
        elif found.st_mode & _writable_by_others(found) and not found.st_mode & stat.S_ISVTX:
            return False
    return True


def _writable_by_others(found: os.stat_result) -> int:
    """The bits of a mode that let others write; a group of root or of the user alone (same number) is not others."""
    return stat.S_IWOTH if found.st_gid in (0, os.geteuid()) else stat.S_IWOTH | stat.S_IWGRP


def read_entry(path: Path) -> bytes | None:
    """The content of an entry; None if there is none or it cannot be read. Links are not followed.

    Raises DamagedEntryError if it is no regular file of the user that nobody else can write, too large, or its checksum
    does not hold.
    """
    flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    try:
        number = os.open(path, flags)
    except FileNotFoundError:
        return None
    except OSError as error:  # a link, or a disc that cannot be read
        if path.is_symlink():
            raise DamagedEntryError("a link") from error
        return None
    with os.fdopen(number, "rb") as entry:
        found = os.fstat(number)
        foreign = _POSIX and (found.st_uid != os.geteuid() or found.st_mode & (stat.S_IWGRP | stat.S_IWOTH))
        if foreign or not stat.S_ISREG(found.st_mode) or found.st_size > LARGEST_ENTRY:
            raise DamagedEntryError("no file of the user")
        try:
            kept = entry.read(LARGEST_ENTRY)
        except OSError:
            return None
    if hashlib.sha256(kept[CHECKSUM:]).digest() != kept[:CHECKSUM]:
        raise DamagedEntryError("its checksum does not hold")
    with suppress(OSError):
        if time.time() - found.st_mtime > USED:
            os.utime(path)
    return kept[CHECKSUM:]


def write_entry(path: Path, content: bytes) -> None:
    """Write an entry: complete or not at all. What cannot be written is not kept; that is no error.

    It is not synced: after a power cut the checksum of an incomplete entry does not hold.
    """
    if len(content) + CHECKSUM > LARGEST_ENTRY:
        return
    with suppress(OSError):
        with tempfile.NamedTemporaryFile(dir=path.parent, delete=False) as written:
            try:
                written.write(hashlib.sha256(content).digest() + content)
                written.close()
                Path(written.name).replace(path)
            except BaseException:
                with suppress(OSError):
                    Path(written.name).unlink()
                raise
        if path.parent not in _pruned:
            _pruned.add(path.parent)
            prune(path.parent)


def remove_entry(path: Path) -> None:
    """Remove an entry, whatever it is, unless it is a folder or cannot be removed."""
    with suppress(OSError):
        path.unlink()


def prune(folder: Path) -> None:
    """Remove what interrupted runs left, entries unused for 90 days, and beyond 200 MB those unused for longest."""
    now, size = time.time(), 0
    for path, found in sorted(_files(folder), key=lambda one: one[1].st_mtime, reverse=True):
        size += found.st_size
        if now - found.st_mtime > (UNUSED if path.suffix == ENTRY else LEFT) or size > LARGEST_FOLDER:
            remove_entry(path)
    for inner, _, _ in os.walk(folder, topdown=False):
        if inner != str(folder):
            with suppress(OSError):  # not empty
                Path(inner).rmdir()


def _files(folder: Path) -> Iterator[tuple[Path, os.stat_result]]:
    for inner, _, names in os.walk(folder):
        for path in (Path(inner, name) for name in names):
            with suppress(OSError):  # another run removed it
                yield path, path.lstat()
