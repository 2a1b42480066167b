"""One target of the write protocol: a file, a folder, or a device or pipe."""

import contextlib
import errno
import os
import stat
from abc import ABC, abstractmethod
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from ilmek.errors import OutputError
from ilmek.io.output import disk, manifest, staging
from ilmek.io.output.staging import Staging

_MODES = 0o7777
_STREAMS = tuple(map(Path, ("/dev", "/dev/fd", "/proc/self/fd")))
"""Folders of streams; a regular file may stand behind one of them."""


def resolved(path: Path) -> Path:
    """The path without links. Raises OutputError for circular links, and for a name that the system does not take."""
    try:
        with contextlib.suppress(FileNotFoundError, NotADirectoryError):
            path.stat()
        return path.resolve()
    except PermissionError:
        return path.absolute()
    except (OSError, RuntimeError, ValueError) as error:
        circular = isinstance(error, RuntimeError) or getattr(error, "errno", None) == errno.ELOOP
        reason = "its links are circular" if circular else getattr(error, "strerror", None) or str(error)
        raise OutputError(f"{path} cannot be resolved: {reason}", do="choose another path") from None


def is_stream(path: Path) -> bool:
    """Whether a path is a device or a pipe, such as /dev/stdout."""
    return path.exists() and not path.is_dir() and (not path.is_file() or path.absolute().parent in _STREAMS)


@dataclass(slots=True, eq=False)
class Target(ABC):
    """What all targets share.

    path, label   as given, and its name in messages          target  the path without links
    force         replace what ilmek did not write            complete  its content is staged
    contains      the target is a folder                      existed  there is an old result
    new_id        device and number of the sealed new result  stuck    nothing that is staged may be removed
    """

    path: Path
    label: str
    target: Path
    force: bool
    complete: bool = False
    contains: bool = False
    existed: bool = False
    stuck: bool = False
    staging: Staging | None = None
    new_id: tuple[int, int] | None = None
    made: list[Path] = field(default_factory=list)

    @property
    def placed(self) -> bool:
        """Whether the new result is in place; read from the disk, so that no interrupt can make it false."""
        return self.new_id is not None and _id(self.target) == self.new_id

    def meets(self, path: Path) -> bool:
        """Whether a path is this target, or in it."""
        if path == self.target or (self.contains and self.target in path.parents):
            return True
        return path.exists() and self.target.exists() and path.samefile(self.target)

    def repair(self) -> None:
        """Repair what a killed run left beside the target."""
        staging.repair(self.target)

    def stage(self) -> Path:
        """The hidden folder in which the content is written. Raises OSError."""
        if self.staging is None:
            self.made += _make_parents(self.target.parent)
            self.staging = staging.new_staging(self.target)
        return self.staging.folder

    @abstractmethod
    def check(self) -> None:
        """Raise OutputError unless the target can be written; nothing is changed."""

    def fill(self, content: bytes) -> None:  # noqa: ARG002 - files take it
        """Stage the content of a file. Raises OSError; OutputError for a folder."""
        raise OutputError(f"{self.path} is a folder", do="give the name of a file")

    @abstractmethod
    def seal(self) -> None:
        """Sync what is staged. Raises OSError."""

    @abstractmethod
    def put(self) -> None:
        """Put what is staged in place. Raises OSError."""

    @abstractmethod
    def undo(self) -> None:
        """Put the old result in place again, durably. Raises OSError."""

    def old_result(self) -> Path | None:
        """Where the old result lies if it is not in place."""
        return None

    def rescue(self) -> str:
        """After an undo that failed: keep everything, the old result under a name that can be seen; what lies where."""
        old, staged = self.old_result(), self.staging
        if old is None or staged is None:
            self.stuck = not self.placed  # the undo may not be durable
            return f"the new result is in place: {self.path}" if self.placed else "nothing was written"
        if not self.placed:
            return f"the old result is kept: {old}; the next run with this output puts it back"
        self.stuck = True
        with contextlib.suppress(OSError):
            kept = staged.kept("" if self.contains else self.target.suffix)
            disk.rename(old, kept)
            old, self.stuck = kept, False
            disk.sync(self.target.parent)
        return f"the new result is in place: {self.path}; the old one is kept: {old}"

    def discard(self) -> None:
        """Remove what is staged, or the old result if the new one is in place; the lock is released."""
        placed, staged, self.staging = self.placed, self.staging, None  # whoever takes it removes it
        if staged is not None:
            try:
                if not self.stuck:
                    staging.remove(staged.folder)
                    if placed:  # else it is the only copy
                        staging.remove(staged.old)
            finally:
                staged.lock.release()
        if not placed:
            for folder in self.made:
                with contextlib.suppress(OSError):
                    disk.remove_folder(folder)
        self.made.clear()


@dataclass(slots=True, eq=False)
class FolderTarget(Target):
    """A folder with all its files."""

    contains: bool = True

    def check(self) -> None:
        """Raise OutputError unless the folder can be written; nothing is changed."""
        self.existed = os.path.lexists(self.target)
        if self.target.is_dir():
            self._check_replaceable()
        elif self.existed:
            raise OutputError(f"{self.path} exists and is not a folder", do="choose another output folder")
        above = _first_that_exists(self.target.parent)
        if not above.is_dir():
            raise OutputError(f"{self.path} cannot be made: {above} is not a folder", do="choose another output folder")
        if not os.access(above, os.W_OK | os.X_OK):
            raise OutputError(f"{self.path} cannot be made: {above} is not writable", do="choose another output folder")

    def _check_replaceable(self) -> None:
        if not self.force:
            raise OutputError(f"output folder {self.path} exists", do="choose another, or replace it with --force")
        if self.target in (Path.cwd(), *Path.cwd().parents):
            raise OutputError(f"output folder {self.path} is the folder you are in", do="choose another")
        try:
            listed = manifest.files(self.target) or {}
            foreign = [f"{n} (changed since)" if n in listed else n for n in manifest.foreign(self.target)]
        except OSError as error:
            raise OutputError(f"output folder {self.path} cannot be read ({error})", do="choose another") from None
        if foreign:
            shown = ", ".join(foreign[:3]) + (" ..." if len(foreign) > 3 else "")
            given = f"output folder {self.path} contains files that ilmek did not write: {shown}"
            raise OutputError(given, do="choose another; --force would lose them")

    def seal(self) -> None:
        """Copy the modes of the old result, write the manifest, sync every file and the folder."""
        work = self.stage()
        usual = (work / manifest.MANIFEST).stat().st_mode  # by the process's mask
        mode = (usual | (usual & 0o444) >> 2 | work.stat().st_mode & stat.S_ISGID) & _MODES
        if self.target.is_dir():
            mode = self.target.stat().st_mode & _MODES
            for new in work.iterdir():
                old = self.target / new.name
                if old.is_file() and new.name != manifest.MANIFEST:
                    new.chmod(old.stat().st_mode & _MODES)
        manifest.finish(work)
        disk.sync(work, mode)
        self.new_id = _id(work)

    def put(self) -> None:
        """Exchange the new folder with the old one, or rename it."""
        staged = self.staging
        assert staged is not None
        if not self.existed:
            disk.rename(staged.folder, self.target)
        elif not disk.exchange(staged.folder, self.target):
            disk.rename(self.target, staged.old)
            disk.sync(self.target.parent)
            disk.rename(staged.folder, self.target)
        sync_parents(self.target.parent, self.made)

    def undo(self) -> None:
        """Give each folder its name back. Raises OSError."""
        staged = self.staging
        assert staged is not None
        if staged.old.is_dir():
            if self.placed:
                disk.rename(self.target, staged.folder)
            disk.rename(staged.old, self.target)
        elif self.placed and not (self.existed and disk.exchange(staged.folder, self.target)):
            disk.rename(self.target, staged.folder)
        disk.sync(self.target.parent)  # before the new result is removed

    def old_result(self) -> Path | None:
        """The old folder under its name between two renames, or where the new one was staged."""
        staged = self.staging
        if staged is None or not self.existed:
            return None
        return staged.old if staged.old.is_dir() else staged.folder if self.placed else None


@dataclass(slots=True, eq=False)
class FileTarget(Target):
    """A single file."""

    def check(self) -> None:
        """Raise OutputError unless the file can be written; nothing is changed."""
        folder = self.target.parent
        self.existed = os.path.lexists(self.target)
        if self.path.is_dir():
            raise OutputError(f"{self.path} is a folder", do="give the name of a file")
        if not folder.is_dir():
            raise OutputError(f"{self.path} cannot be written: there is no folder {folder}", do="make the folder first")
        if not os.access(folder, os.W_OK | os.X_OK) or (self.existed and not os.access(self.target, os.W_OK)):
            raise OutputError(f"{self.path} cannot be written: it is not writable", do="choose another path")
        if self.existed and not self.force and not self._replaceable():
            given = f"{self.path} exists, and ilmek did not write it, or it was changed since"
            raise OutputError(given, do="choose another path, or replace it with --force")

    def _replaceable(self) -> bool:
        return self.target.stat().st_size == 0 or manifest.is_marked(self.target)

    @property
    def new(self) -> Path:
        """The staged file."""
        return self.stage() / f"new{self.target.suffix}"

    def fill(self, content: bytes) -> None:
        """Write the content into the staging folder."""
        disk.write(self.new, content)

    def seal(self) -> None:
        """Mark the file, copy the mode of the old one, sync it."""
        manifest.mark(self.new)
        disk.sync(self.new, self.target.stat().st_mode & _MODES if self.existed else None)
        self.new_id = _id(self.new)

    def put(self) -> None:
        """Exchange the new file with the old one, or rename it."""
        if not self.existed:
            disk.rename(self.new, self.target)
        elif not disk.exchange(self.new, self.target):
            disk.keep(self.target, self._old)
            disk.replace(self.new, self.target)
        sync_parents(self.target.parent, ())

    @property
    def _old(self) -> Path:
        return self.stage() / f"old{self.target.suffix}"

    def undo(self) -> None:
        """Put the old file in place again, or remove the new one. Raises OSError."""
        if self.placed:
            if not self.existed:
                disk.rename(self.target, self.new)
            elif self._old.exists():
                disk.replace(self._old, self.target)
            else:
                disk.exchange(self.new, self.target)
            disk.sync(self.target.parent)  # before the new result is removed

    def old_result(self) -> Path | None:
        """The old file where the new one was staged, or its second name."""
        if self.staging is None or not (self.existed and self.placed):
            return None
        return self._old if self._old.exists() else self.new


@dataclass(slots=True, eq=False)
class StreamTarget(Target):
    """A device or a pipe: written directly, before anything is put in place."""

    content: bytes = b""
    begun: bool = False

    def repair(self) -> None:
        """Nothing: a stream has no staging folder."""

    def stage(self) -> Path:
        """The stream itself."""
        return self.path

    def check(self) -> None:
        """Raise OutputError unless it can be written."""
        if not os.access(self.path, os.W_OK):
            raise OutputError(f"{self.path} cannot be written: it is not writable", do="choose another path")

    def fill(self, content: bytes) -> None:
        """Keep the content."""
        self.content = content

    def seal(self) -> None:
        """Write the content, at the end where a file stands behind the stream."""
        with self.path.open("ab", buffering=0) as stream:
            left = memoryview(self.content)
            while left:
                left = left[stream.write(left) or 0 :]
                self.begun = True

    def put(self) -> None:
        """Nothing: the content has been written."""

    def undo(self) -> None:
        """Nothing: what a stream has taken cannot be taken back."""


def sync_parents(folder: Path, made: Iterable[Path]) -> None:
    """Sync the folder of a target, and the folders above those that were made for it."""
    disk.sync(folder)
    for new in made:
        disk.sync(new.parent)


def _id(path: Path) -> tuple[int, int] | None:
    """Device and number of a file or folder; None where there is none."""
    try:
        found = path.lstat()
    except OSError:
        return None
    return found.st_dev, found.st_ino


def _first_that_exists(folder: Path) -> Path:
    while not os.path.lexists(folder):
        folder = folder.parent
    return folder


def _make_parents(folder: Path) -> list[Path]:
    """Make the missing folders; returns them, the innermost first."""
    missing = [parent for parent in (folder, *folder.parents) if not parent.exists()]
    folder.mkdir(parents=True, exist_ok=True)
    return missing
