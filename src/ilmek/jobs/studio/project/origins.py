"""Of which files each file or folder in out/ was written, and which of these have changed since.

The studio notes digests of the files before it writes, so that a change during the work is seen, and one that was
undone is none. What the command line wrote has no note: there the times of the files are compared.
"""

import json
import posixpath
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from ilmek.errors import IlmekError
from ilmek.jobs.studio.project.folder import OWN, SUFFIX, ProjectFolder, digest_of, read_bytes, write_bytes

DEEPEST = 3
"""Largest number of files that name each other: a recipe, its loom, a table of the loom."""

LARGEST = 100_000_000
"""Size of a file [bytes] above which its time is compared in place of its digest."""


@dataclass(frozen=True, eq=False, slots=True)
class Origins:
    """What is noted of each file or folder in out/: time of its last change [ns], digests of the files by path."""

    folder: ProjectFolder
    notes: Mapping[str, object]

    def changed(self, target: str, source: str, time: int) -> tuple[str, ...]:
        """The paths of the files that have changed since a target was written of a source.

        time  of the last change of the target [ns]
        """
        note = self.notes.get(target)
        if isinstance(note, dict) and note.get("time") == time and isinstance(note.get("digests"), dict):
            digests = note["digests"]
            now = digests_of(self.folder, source)
            return tuple(path for path in now | digests if now.get(path) != digests.get(path))
        return tuple(
            path for path in inputs(self.folder, source) if (self.folder.base / path).stat().st_mtime_ns > time
        )


def read_origins(folder: ProjectFolder) -> Origins:
    """The notes of a project; none where they cannot be read."""
    try:
        found = json.loads(read_bytes(_file(folder), LARGEST) or b"{}")
    except (IlmekError, ValueError, RecursionError):
        found = {}
    return Origins(folder, found if isinstance(found, dict) else {})


def note_origin(folder: ProjectFolder, target: str, digests: Mapping[str, str], time: int) -> None:
    """Note of which files a target was written, at a time [ns]; notes of what has gone go. Raises OutputError."""
    with folder.locked():
        notes = {path: note for path, note in read_origins(folder).notes.items() if (folder.base / path).exists()}
        text = json.dumps({**notes, target: {"time": time, "digests": dict(digests)}})
        write_bytes(_file(folder), text.encode("ascii"))


def digests_of(folder: ProjectFolder, source: str) -> dict[str, str]:
    """The digests of a text file of the project and of the files that it names, by path."""
    return {path: _digest(folder.base / path) for path in inputs(folder, source)}


def inputs(folder: ProjectFolder, source: str) -> list[str]:
    """A text file of the project and the files of the project that it names, also through others; first the file."""
    inputs: list[str] = []
    wanted = [source]
    for _ in range(DEEPEST):
        inputs += [path for path in dict.fromkeys(wanted) if path not in inputs and _is_file(folder, path)]
        wanted = [name for path in wanted if path.endswith(SUFFIX) for name in _named(folder, path)]
    return inputs


def _is_file(folder: ProjectFolder, path: str) -> bool:
    try:
        return folder.path(path).is_file()
    except (IlmekError, OSError):
        return False


def _named(folder: ProjectFolder, path: str) -> Iterator[str]:
    """The texts of a file that may be paths of files: as they are, and relative to its folder."""
    try:
        data = tomllib.loads((read_bytes(folder.base / path) or b"").decode())
    except (IlmekError, ValueError, RecursionError):
        return
    home = posixpath.dirname(path)
    for text in _texts(data):
        name = text.removeprefix("@")
        yield posixpath.normpath(name)
        yield posixpath.normpath(posixpath.join(home, name))


def _texts(value: object) -> Iterator[str]:
    if isinstance(value, str) and "." in value and len(value) < 500:
        yield value
    elif isinstance(value, dict | list):
        for one in value.values() if isinstance(value, dict) else value:
            yield from _texts(one)


def _digest(file: Path) -> str:
    status = file.stat()
    return _kept_digest(file, status.st_mtime_ns, status.st_size)


@lru_cache(maxsize=1000)
def _kept_digest(file: Path, time: int, size: int) -> str:
    return str(time) if size > LARGEST else digest_of(file.read_bytes())


def _file(folder: ProjectFolder) -> Path:
    return folder.base / OWN / "written.json"
