"""The hidden folder beside a target in which its new content is written, and the repair of what killed runs left.

A run holds a lock on its staging folder; the system releases it however the run ends. A folder that can be locked
therefore has no owner. Without locks (some network file systems, Windows) nothing is repaired.
"""

import contextlib
import os
import re
import secrets
from hashlib import sha256
from pathlib import Path

from ilmek.io.output import disk, manifest
from ilmek.io.output.manifest import OLD, PART
from ilmek.records import record

_TRIES = 20


class Lock:
    """A lock of a folder; released with this object, also where an interrupt cuts the release off."""

    def __init__(self, folder: Path) -> None:
        self._handles: list[int] = []
        with contextlib.suppress(OSError):  # it is gone, or the system cannot open folders
            self._handles.append(os.open(folder, os.O_RDONLY))

    @property
    def opened(self) -> bool:
        """Whether the folder could be opened."""
        return bool(self._handles)

    def take(self) -> bool | None:
        """Whether the lock was free; None if there are no locks."""
        if disk.fcntl is None or not self._handles:
            return None
        try:
            disk.fcntl.flock(self._handles[0], disk.fcntl.LOCK_EX | disk.fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        except OSError:
            return None
        return True

    def is_at(self, folder: Path) -> bool:
        """Whether the folder still has this name."""
        try:
            return bool(self._handles) and os.path.samestat(os.fstat(self._handles[0]), folder.lstat())
        except OSError:
            return False

    def release(self) -> None:
        """Release the lock."""
        with contextlib.suppress(OSError, IndexError, AttributeError):
            os.close(self._handles.pop())

    __del__ = release


@record
class Staging:
    """A new, locked folder beside a target."""

    folder: Path
    lock: Lock

    @property
    def old(self) -> Path:
        """The name of the old result between two renames."""
        return self.folder.with_suffix(OLD)

    def kept(self, suffix: str = "") -> Path:
        """A name that can be seen, for what must not be removed."""
        return _visible(self.folder, suffix)


def new_staging(target: Path) -> Staging:
    """A new staging folder, marked as unfinished. Raises OSError."""
    for _ in range(_TRIES):
        folder = target.parent / f".{_stem(target)}.{secrets.token_hex(4)}{PART}"
        disk.make_folder(folder)
        lock = Lock(folder)
        # Another run may have taken the folder for one without an owner before it was locked.
        if not lock.opened or (lock.take() is not False and lock.is_at(folder)):
            return _begun(Staging(folder, lock))
    raise OSError(f"no temporary folder could be made beside {target}")


def _begun(staged: Staging) -> Staging:
    try:
        manifest.begin(staged.folder)
    except BaseException:
        with contextlib.suppress(OSError):
            manifest.clear(staged.folder)
        staged.lock.release()
        raise
    return staged


def repair(target: Path) -> None:
    """Complete or undo the swap of a killed run, and remove what such runs left beside `target`.

    A missing target whose old result has been renamed gets the new result if that is whole, else the old one again.
    Raises OSError if it cannot; then nothing is removed.
    """
    left = [folder for folder in _left(target) if folder.is_dir() and not folder.is_symlink()]
    for old in left:
        if old.suffix == OLD and not os.path.lexists(target):
            _finish_swap(old, target)
    for folder in left:
        if folder.suffix == PART or target.is_dir():
            _remove_if_free(folder)


def remove(folder: Path) -> None:
    """Remove a staging folder: an unfinished one, or an old result that its manifest describes.

    What its manifest does not describe is kept under a name that can be seen. What cannot be read or removed now is
    left to the next run.
    """
    if not folder.is_dir():
        return
    try:
        if not manifest.is_unfinished(folder) and manifest.foreign(folder):
            disk.rename(folder, _visible(folder))
            return
    except OSError:
        return
    for _ in range(_TRIES):  # an interrupted run may still be writing
        with contextlib.suppress(OSError):
            manifest.clear(folder)
        if not folder.exists():
            return


def _visible(folder: Path, suffix: str = "") -> Path:
    return folder.with_name(f"{folder.stem.strip('.')}.kept{suffix}")


def _left(target: Path) -> list[Path]:
    ours = re.compile(rf"\.{re.escape(_stem(target))}\.[0-9a-f]{{8}}({PART}|{OLD})")
    try:
        return [entry for entry in target.parent.iterdir() if ours.fullmatch(entry.name)]
    except OSError:
        return []


def _finish_swap(old: Path, target: Path) -> None:
    new = old.with_suffix(PART)
    lock = Lock(new if new.is_dir() else old)  # a run that lives holds the lock of the new folder
    if lock.take():
        disk.rename(new if manifest.is_whole(new) else old, target)
        disk.sync(target.parent)  # before the other one is removed
    lock.release()


def _remove_if_free(folder: Path) -> None:
    lock = Lock(folder)
    if lock.take():
        remove(folder)
    lock.release()


def _stem(target: Path) -> str:
    """The name, or a digest of it if it is too long for a suffix."""
    return target.name if len(os.fsencode(target.name)) <= 200 else sha256(os.fsencode(target.name)).hexdigest()[:32]
