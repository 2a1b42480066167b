"""Which files of a project have changed since the last look, whoever changed them. Only the standard library."""

import os
from collections.abc import Iterator
from pathlib import Path

from ilmek.jobs.studio.project.folder import KINDS, OUT, PICTURES

Stamp = tuple[int, int, int]
"""Time of the last change [ns], size [bytes] and number of a file."""

MOST_WATCHED = 5_000
"""Largest number of files that are watched."""

INTERVAL = 0.5
"""Time between two looks of the server [s]."""


class ProjectWatch:
    """The files of a folder as they were at the last look."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._seen = self._stamps()

    def changes(self) -> tuple[str, ...]:
        """Paths of the files that came, went or changed since the last look, relative to the folder, with /."""
        found = self._stamps()
        changed = {path for path in found.keys() | self._seen.keys() if found.get(path) != self._seen.get(path)}
        self._seen = found
        return tuple(sorted(changed))

    def _stamps(self) -> dict[str, Stamp]:
        stamps: dict[str, Stamp] = {}
        for folder in (*KINDS, PICTURES, OUT):
            for path, stamp in self._folder_stamps(folder, deep=folder == OUT):
                stamps[path] = stamp
                if len(stamps) >= MOST_WATCHED:
                    return stamps
        return stamps

    def _folder_stamps(self, folder: str, deep: bool) -> Iterator[tuple[str, Stamp]]:
        if (self._folder / folder).is_symlink():
            return
        try:
            entries = list(os.scandir(self._folder / folder))
        except OSError:
            return
        for entry in entries:
            path = f"{folder}/{entry.name}" if folder else entry.name
            if entry.name.startswith("."):
                continue
            try:
                if entry.is_file(follow_symlinks=False):
                    status = entry.stat(follow_symlinks=False)
                    yield path, (status.st_mtime_ns, status.st_size, status.st_ino)
                elif deep and entry.is_dir(follow_symlinks=False) and path.count("/") < 4:
                    yield from self._folder_stamps(path, deep)
            except OSError:
                continue
