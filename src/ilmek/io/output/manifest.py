"""The manifest of an output folder: names, sizes and digests of its files.

    {"ilmek": 1, "files": {"chart.png": {"size": 1234, "sha256": "..."}}}

Only a file that its manifest lists, and that has not changed since, is ever removed. A single output file carries its
digest as an extended attribute instead, where the file system has such.
"""

import contextlib
import hashlib
import io
import json
import os
import re
import stat
from pathlib import Path
from typing import TypeAlias

from ilmek.io.output import disk

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
_UNFINISHED = json.dumps({"ilmek": _VERSION, "unfinished": True})
_DIGEST = re.compile("[0-9a-f]{64}")


def begin(folder: Path) -> None:
    """Mark a folder as unfinished: everything in it was written by the run that holds its lock. Raises OSError."""
    (folder / MANIFEST).write_text(_UNFINISHED, encoding="ascii")
    disk.sync(folder / MANIFEST)
    disk.sync(folder)


def is_unfinished(folder: Path) -> bool:
    """Whether a folder is marked as unfinished, or was left while the mark was written."""
    try:
        only = [entry.name for entry in folder.iterdir()] == [MANIFEST]
        bare = only and (folder / MANIFEST).lstat().st_size < len(_UNFINISHED)
    except OSError:
        return False
    return bare or _read(folder).get("unfinished") is True


def finish(folder: Path) -> None:
    """Sync all files in a folder, write their manifest, and sync the folder.

    Raises OSError, also for an entry that is not a file.
    """
    names = sorted(entry.name for entry in folder.iterdir() if entry.name != MANIFEST)
    listed = {name: dict(zip(("size", "sha256"), _entry(folder / name), strict=True)) for name in names}
    for name in names:
        disk.sync(folder / name)
    work = folder / f"{MANIFEST}{PART}"
    work.write_text(json.dumps({"ilmek": _VERSION, "files": listed}, indent=1), encoding="ascii")
    disk.sync(work)
    disk.replace(work, folder / MANIFEST)
    disk.sync(folder)


def files(folder: Path) -> dict[str, Entry]:
    """The entries of a folder's manifest; none if it has no valid one."""
    listed = _read(folder).get("files")
    if not isinstance(listed, dict):
        return {}
    return {name: entry for name, given in listed.items() if _is_name(name) and (entry := _parsed(given)) is not None}


def foreign(folder: Path) -> list[str]:
    """Names in a folder that its manifest does not list as they are: foreign or changed files. Raises OSError."""
    listed = files(folder)
    known = {MANIFEST} if listed or is_unfinished(folder) else set()
    return sorted(e.name for e in folder.iterdir() if e.name not in known and not _matches(e, listed.get(e.name)))


def is_whole(folder: Path) -> bool:
    """Whether a folder has a manifest, and every file of it is there as it was written."""
    listed = files(folder)
    return bool(listed) and all(_matches(folder / name, entry) for name, entry in listed.items())


def remove(folder: Path) -> bool:
    """Remove the files that match the manifest, and the folder if nothing else is in it; whether it is gone."""
    with contextlib.suppress(OSError):
        kept = foreign(folder)
        folder.chmod(folder.stat().st_mode | stat.S_IRWXU)  # a folder that its user has closed to himself
        for entry in list(folder.iterdir()):
            if entry.name not in kept and (entry.name != MANIFEST or not kept):
                entry.unlink()
        folder.rmdir()
    return not folder.exists()


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
    """The manifest's data; nothing for a missing or invalid one."""
    try:
        with _opened(folder / MANIFEST) as file:
            text = file.read(LARGEST + 1)
        data = json.loads(text) if len(text) <= LARGEST else None
    except (OSError, ValueError, RecursionError):
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
    try:
        return entry is not None and path.lstat().st_size == entry[0] and _entry(path) == entry
    except OSError:
        return False


def _entry(path: Path) -> Entry:
    """Size and digest of a regular file. Raises OSError."""
    with _opened(path) as file:
        digest = hashlib.file_digest(file, "sha256").hexdigest()
        return os.fstat(file.fileno()).st_size, digest


def _opened(path: Path) -> io.BufferedReader:
    """A regular file, opened without following a link and without waiting. Raises OSError."""
    handle = os.open(path, os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0))
    if not stat.S_ISREG(os.fstat(handle).st_mode):
        os.close(handle)
        raise OSError(f"{path} is not a regular file")
    return os.fdopen(handle, "rb")
