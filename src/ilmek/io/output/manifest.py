"""The manifest of an output folder: names, sizes and digests of its files.

    {"ilmek": 1, "files": {"chart.png": {"size": 1234, "sha256": "..."}}}

Only a file that its manifest lists, and that has not changed since, is ever removed. A single output file carries its
digest as an extended attribute instead, where the file system has such.
"""

import contextlib
import errno
import hashlib
import json
import os
import re
import shutil
import stat
import time
from pathlib import Path
from typing import TypeAlias

from ilmek.io.output import disk
from ilmek.io.regular_file import open_regular

Entry: TypeAlias = tuple[int, str]
"""Size [bytes] and SHA-256 of a file."""

MANIFEST = ".ilmek"
"""The file in each output folder that holds the manifest."""

MARK = "user.ilmek.sha256"
"""The extended attribute of an output file: its digest, in hexadecimal digits."""

LARGEST = 10_000_000
"""Largest size of a manifest [bytes]."""

PART, OLD = ".part", ".old"
"""Suffixes of unfinished files and folders, and of an old result in a swap without atomic exchange."""

_VERSION = 1
_DIGESTS: dict[tuple[int, ...], str] = {}
"""Digests of unchanged files: an old result is read once, not again when it is replaced and when it is removed."""
_MOST_DIGESTS = 10_000
_SETTLED = 2.0
"""Age from which a change of a file is sure to change its times [s]; FAT has steps of 2 s."""
_UNFINISHED = json.dumps({"ilmek": _VERSION, "unfinished": True})
_DIGEST = re.compile("[0-9a-f]{64}")


def begin(folder: Path) -> None:
    """Mark a folder as unfinished: everything in it was written by the run that holds its lock. Raises OSError."""
    disk.write(folder / MANIFEST, _UNFINISHED.encode("ascii"))
    disk.sync(folder / MANIFEST)
    disk.sync(folder)


def is_unfinished(folder: Path) -> bool:
    """Whether a folder is marked as unfinished, or was left while the mark was written. Raises OSError."""
    read = _read(folder)
    if read:
        return read.get("unfinished") is True
    only = [entry.name for entry in folder.iterdir()] == [MANIFEST]
    return only and (folder / MANIFEST).lstat().st_size <= len(_UNFINISHED)


def finish(folder: Path) -> None:
    """Sync all files in a folder, write their manifest, and sync the folder.

    Raises OSError, also for an entry that is not a file, and for more files than a manifest may list.
    """
    names = sorted(entry.name for entry in folder.iterdir() if entry.name != MANIFEST)
    listed = {name: dict(zip(("size", "sha256"), _entry(folder / name), strict=True)) for name in names}
    for name in names:
        disk.sync(folder / name)
    work = folder / f"{MANIFEST}{PART}"
    text = json.dumps({"ilmek": _VERSION, "files": listed}, indent=1)
    if len(text) > LARGEST:
        raise OSError(errno.EFBIG, f"{len(names)} files are too many for a manifest")
    disk.write(work, text.encode("ascii"))
    disk.sync(work)
    disk.replace(work, folder / MANIFEST)
    disk.sync(folder)


def files(folder: Path) -> dict[str, Entry] | None:
    """The entries of a folder's manifest; None if it has no valid one. Raises OSError."""
    listed = _read(folder).get("files")
    if not isinstance(listed, dict):
        return None
    return {name: entry for name, given in listed.items() if _is_name(name) and (entry := _parsed(given)) is not None}


def foreign(folder: Path) -> list[str]:
    """Names in a folder that its manifest does not list as they are: foreign or changed files. Raises OSError."""
    listed = files(folder)
    known = {MANIFEST} if listed is not None or is_unfinished(folder) else set()
    entries = listed or {}
    return sorted(e.name for e in folder.iterdir() if e.name not in known and not _matches(e, entries.get(e.name)))


def is_whole(folder: Path) -> bool:
    """Whether a folder has a manifest, and every file of it is there as it was written. Raises OSError."""
    listed = files(folder)
    return listed is not None and all(_matches(folder / name, entry) for name, entry in listed.items())


def clear(folder: Path) -> None:
    """Remove a folder with all that is in it, its manifest last: what a killed run leaves of it is still described.

    Raises OSError.
    """
    folder.chmod(folder.stat().st_mode | stat.S_IRWXU)  # a folder that its user has closed to himself
    for entry in list(folder.iterdir()):
        if entry.is_dir() and not entry.is_symlink():
            shutil.rmtree(entry)
        elif entry.name != MANIFEST:
            with contextlib.suppress(FileNotFoundError):  # a temporary file of the run that is being ended
                disk.unlink(entry)
    disk.sync(folder)
    if os.path.lexists(folder / MANIFEST):
        disk.unlink(folder / MANIFEST)
    disk.remove_folder(folder)


def mark(path: Path) -> None:
    """Mark a file as written by ilmek, where the file system can."""
    if hasattr(os, "setxattr"):
        with contextlib.suppress(OSError):
            os.setxattr(path, MARK, _entry(path)[1].encode("ascii"))


def is_marked(path: Path) -> bool:
    """Whether a file is marked and has not changed since."""
    if not hasattr(os, "getxattr"):
        return False
    try:
        return os.getxattr(path, MARK).decode("ascii", "replace") == _entry(path)[1]
    except OSError:
        return False


def _read(folder: Path) -> dict[str, object]:
    """The manifest's data; nothing for a missing or invalid one. Raises OSError for one that cannot be read."""
    if not _is_file(folder / MANIFEST):
        return {}
    file, _ = open_regular(folder / MANIFEST, follow=False)
    with file:
        text = file.read(LARGEST + 1)
    try:
        data = json.loads(text) if len(text) <= LARGEST else None
    except (ValueError, RecursionError):
        return {}
    return data if isinstance(data, dict) and data.get("ilmek") == _VERSION else {}


def _is_name(name: object) -> bool:
    return isinstance(name, str) and name not in ("", ".", "..", MANIFEST) and not {"/", "\\", "\0"} & set(name)


def _parsed(given: object) -> Entry | None:
    if not isinstance(given, dict):
        return None
    size, digest = given.get("size"), given.get("sha256")
    if isinstance(size, int) and isinstance(digest, str) and _DIGEST.fullmatch(digest):
        return size, digest
    return None


def _matches(path: Path, entry: Entry | None) -> bool:
    return entry is not None and _is_file(path) and path.lstat().st_size == entry[0] and _entry(path) == entry


def _is_file(path: Path) -> bool:
    """Whether there is a regular file, and no link to one. Raises OSError where that cannot be seen."""
    try:
        return stat.S_ISREG(path.lstat().st_mode)
    except (FileNotFoundError, NotADirectoryError):
        return False


def _entry(path: Path) -> Entry:
    """Size and digest of a regular file, computed again only if the file may have changed. Raises OSError."""
    file, _ = open_regular(path, follow=False)
    with file:
        found = os.fstat(file.fileno())
        key = (found.st_dev, found.st_ino, found.st_size, found.st_mtime_ns, found.st_ctime_ns)
        digest = _DIGESTS.get(key) or hashlib.file_digest(file, "sha256").hexdigest()
        if time.time() - max(found.st_mtime, found.st_ctime) > _SETTLED:
            if len(_DIGESTS) >= _MOST_DIGESTS:
                _DIGESTS.clear()
            _DIGESTS[key] = digest
        return found.st_size, digest
