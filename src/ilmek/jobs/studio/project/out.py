"""What was written into out/: listed with what has changed since, packed, removed."""

import os
import secrets
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from io import BytesIO
from itertools import islice
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile

from ilmek.errors import ParameterError
from ilmek.jobs.studio.answers import Binary, Context
from ilmek.jobs.studio.project.folder import OUT, ProjectFolder, cannot, natural
from ilmek.jobs.studio.project.origins import read_origins
from ilmek.jobs.studio.project.products import sources
from ilmek.jobs.studio.project.tasks import Changed, PathRequest, ProjectRequest

MOST_LISTED = 2_000
"""Largest number of files that are listed."""

DEEPEST = 4
"""Largest depth of folders below out/ that are listed."""


LARGEST_ARCHIVE = 300_000_000
"""Largest size of the files of an archive [bytes]; the answer is made in memory."""


@dataclass(frozen=True, slots=True)
class OutFile:
    """A file below out/. size: [bytes]; time: of its last change [s since 1970]."""

    path: str
    size: int
    time: float


@dataclass(frozen=True, slots=True)
class OutEntry:
    """A file or a folder in out/ with its files, hidden ones left out; size: of all of them [bytes].

    source   the text file of which it was written; "": unknown
    changed  the files that have changed since it was written: `source`, and files that it names
    """

    path: str
    size: int
    time: float
    files: tuple[OutFile, ...]
    source: str = ""
    changed: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class OutList:
    """What was written, the newest first."""

    entries: tuple[OutEntry, ...]


def written(request: ProjectRequest, context: Context) -> OutList:
    """The files and folders in out/, what they were written of, and whether that has changed since.

    Raises ParameterError where out/ is a link, OutputError for a folder that is closed.
    """
    folder = ProjectFolder(context.folder.resolve())
    origins, known = read_origins(folder), sources(folder.texts())
    entries: list[OutEntry] = []
    left = MOST_LISTED
    for top in _scanned(folder.path(OUT)):
        found = list(islice(_files(top, 0), left))
        left -= len(found)
        if found:
            name = f"{OUT}/{top.name}"
            times = [status.st_mtime_ns for _, status in found]
            source = known.get(name, "")
            files = tuple(_out_file(folder.base, path, status) for path, status in found)
            changed = origins.changed(name, source, max(times)) if source else ()
            entries.append(OutEntry(name, sum(file.size for file in files), max(times) / 1e9, files, source, changed))
    return OutList(tuple(sorted(entries, key=lambda entry: (-entry.time, natural(entry.path)))))


def _out_file(base: Path, path: str, status: os.stat_result) -> OutFile:
    return OutFile(Path(path).relative_to(base).as_posix(), status.st_size, status.st_mtime)


def last_change(path: Path) -> int:
    """The time of the last change of a file, or of the files of a folder [ns]; hidden ones left out."""
    if path.is_file():
        return path.stat().st_mtime_ns
    return max((status.st_mtime_ns for top in _scanned(path) for _, status in _files(top, 1)), default=0)


def _scanned(folder: Path) -> list[os.DirEntry[str]]:
    try:
        return sorted(
            (one for one in os.scandir(folder) if not one.name.startswith(".")), key=lambda one: natural(one.name)
        )
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
                # At once: a list that is read meanwhile has the whole folder or nothing of it.
                hidden = path.with_name(f".{path.name}.{secrets.token_hex(4)}.deleted")
                shutil.rmtree(path.rename(hidden))
            else:
                path.unlink()
        except OSError as error:
            raise cannot("be deleted", path, error) from None
    return Changed((request.path,))


def archive(request: PathRequest, context: Context) -> Binary:
    """The files of a folder in out/ as ZIP. Raises ParameterError where there is none, or it is too large."""
    folder = ProjectFolder(context.folder.resolve())
    path = folder.path(request.path)
    files = [(Path(file), status.st_size) for top in _scanned(path) for file, status in _files(top, 1)]
    if path.parent != folder.base / OUT or not files:
        raise ParameterError(f"{request.path} is no folder in {OUT}/")
    if (size := sum(one for _, one in files)) > LARGEST_ARCHIVE:
        given = f"{request.path} has {size:,} bytes"
        raise ParameterError(given, allowed=f"at most {LARGEST_ARCHIVE:,}", do="copy the folder itself")
    with BytesIO() as packed:
        with ZipFile(packed, "w", ZIP_DEFLATED, compresslevel=1, strict_timestamps=False) as archived:
            for file, _ in files:
                archived.write(file, f"{path.name}/{file.relative_to(path).as_posix()}")
        return Binary("application/zip", packed.getvalue())
