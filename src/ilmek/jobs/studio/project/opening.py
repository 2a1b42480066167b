"""A project is opened: an empty or missing folder is filled with the example, another one is checked."""

import contextlib
import os
from collections.abc import Iterator
from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path

from ilmek.errors import OutputError
from ilmek.io.output import disk
from ilmek.jobs.studio.project.folder import KINDS, OUT, OWN, SUFFIX, cannot, write_bytes

EXAMPLE = "example_project"
"""The example below ilmek.data."""

_FILLING = "filling"
"""Mark that the example is being copied; a kill leaves it, and the next start goes on."""


def open_project(path: Path) -> Path:
    """The folder of a project, ready for use, without links.

    An empty or missing folder is filled with the example. Raises OutputError for a file, for a folder in which is
    something else, and for one that cannot be read or written.
    """
    path = path.expanduser()
    try:
        path.mkdir(parents=True, exist_ok=True)
        folder = path.resolve()
        names = {entry.name for entry in os.scandir(folder)}
        own = folder / OWN
        if not names or (own / _FILLING).exists():
            own.mkdir(mode=0o700, exist_ok=True)
            (own / _FILLING).touch()
            _copy(resources.files("ilmek.data").joinpath(EXAMPLE), folder)
            (own / _FILLING).unlink()
        elif not _is_project(folder, names):
            do = f"give an empty or a new folder, or put a recipe, carpet{SUFFIX}, into it"
            raise OutputError(f"{path} is no project: it has other files", do=do)
        own.mkdir(mode=0o700, exist_ok=True)
        (folder / OUT).mkdir(exist_ok=True)  # commands that are shown write into it
        if not (own / ".gitignore").exists():
            (own / ".gitignore").write_text("*\n", encoding="utf-8")
        _check_writable(own)
    except FileExistsError:
        raise OutputError(f"{path} is a file", do="give a folder") from None
    except OSError as error:
        raise cannot("be opened as a project", path, error) from None
    return folder


@contextlib.contextmanager
def served_alone(folder: Path) -> Iterator[bool]:
    """Held while a studio serves a project: whether no other one does. Both may; saves wait for each other.

    Raises OutputError.
    """
    path = folder / OWN / "served"
    try:
        handle = os.open(path, os.O_RDWR | os.O_CREAT, 0o600)
    except OSError as error:
        raise cannot("be written", path, error) from None
    try:
        yield disk.fcntl is None or _is_first(handle)
    finally:
        os.close(handle)


def _is_first(handle: int) -> bool:
    """Whether nobody else has locked a file; it is locked, until it is closed or its process ends."""
    try:
        disk.fcntl.flock(handle, disk.fcntl.LOCK_EX | disk.fcntl.LOCK_NB)
        first = True
    except OSError:
        first = False
    with contextlib.suppress(OSError):  # another one is just looking, or the file system has no locks
        disk.fcntl.flock(handle, disk.fcntl.LOCK_SH | disk.fcntl.LOCK_NB)
    return first


def _is_project(folder: Path, names: set[str]) -> bool:
    if OWN in names or f"carpet{SUFFIX}" in names:
        return True
    return any(next((folder / kind).glob(f"*{SUFFIX}"), None) is not None for kind in KINDS if kind and kind in names)


def _copy(source: Traversable, target: Path) -> None:
    """Copy the files that are not there yet."""
    for entry in source.iterdir():
        if entry.is_dir():
            if not entry.name.startswith(("_", ".")):
                (target / entry.name).mkdir(exist_ok=True)
                _copy(entry, target / entry.name)
        elif not (target / entry.name).exists() and not entry.name.endswith((".py", ".pyc")):
            write_bytes(target / entry.name, entry.read_bytes())


def _check_writable(folder: Path) -> None:
    """Raise OSError for a folder in which no file can be written."""
    trial = folder / "writable"
    try:
        trial.write_bytes(b"\n")
    finally:
        with contextlib.suppress(OSError):
            trial.unlink(missing_ok=True)
