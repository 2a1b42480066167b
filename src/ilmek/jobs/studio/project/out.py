"""What was written into out/: listed and removed."""

import os
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ilmek.errors import ParameterError
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.project.folder import OUT, ProjectFolder, cannot
from ilmek.jobs.studio.project.tasks import Changed, PathRequest, ProjectRequest

MOST_LISTED = 2_000
"""Largest number of files that are listed."""

DEEPEST = 4
"""Largest depth of folders below out/ that are listed."""


@dataclass(frozen=True, slots=True)
class OutFile:
    """A file below out/. size: [bytes]; time: of its last change [s since 1970]."""

    path: str
    size: int
    time: float


@dataclass(frozen=True, slots=True)
class OutEntry:
    """A file or a folder in out/ with its files, hidden ones left out; size: of all of them [bytes]."""

    path: str
    size: int
    time: float
    files: tuple[OutFile, ...]


@dataclass(frozen=True, slots=True)
class OutList:
    """What was written, the newest first."""

    entries: tuple[OutEntry, ...]


def written(request: ProjectRequest, context: Context) -> OutList:
    """The files and folders in out/. Raises OutputError for a folder that is closed."""
    base = ProjectFolder(context.folder.resolve()).base
    entries: list[OutEntry] = []
    left = MOST_LISTED
    for top in _scanned(base / OUT):
        files = []
        for path, status in _files(top, 0):
            if left:
                left -= 1
                files.append(OutFile(Path(path).relative_to(base).as_posix(), status.st_size, status.st_mtime))
        if files:
            name = f"{OUT}/{top.name}"
            time = max(file.time for file in files)
            entries.append(OutEntry(name, sum(file.size for file in files), time, tuple(files)))
    return OutList(tuple(sorted(entries, key=lambda entry: (-entry.time, entry.path))))


def _scanned(folder: Path) -> list[os.DirEntry[str]]:
    try:
        return sorted((one for one in os.scandir(folder) if not one.name.startswith(".")), key=lambda one: one.name)
    except FileNotFoundError:
        return []
    except OSError as error:
        raise cannot("be read", folder, error) from None


def _files(entry: os.DirEntry[str], depth: int) -> Iterator[tuple[str, os.stat_result]]:
    if entry.is_file(follow_symlinks=False):
        yield entry.path, entry.stat(follow_symlinks=False)
    elif entry.is_dir(follow_symlinks=False) and depth < DEEPEST:
        for inner in _scanned(Path(entry.path)):
            yield from _files(inner, depth + 1)


def delete_written(request: PathRequest, context: Context) -> Changed:
    """Delete a file or folder in out/. Raises ParameterError where there is none, OutputError."""
    folder = ProjectFolder(context.folder.resolve())
    path = folder.path(request.path)
    if path.parent != folder.base / OUT or not path.exists():
        raise ParameterError(f"{request.path} is nothing in {OUT}/")
    with folder.locked():
        try:
            if path.is_dir():
                shutil.rmtree(path)
            else:
                path.unlink()
        except OSError as error:
            raise cannot("be deleted", path, error) from None
    return Changed((request.path,))
