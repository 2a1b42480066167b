"""Files of secrets: only their owner reads or writes them."""

import os
import stat
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from ilmek.errors import LoomError, OutputError
from ilmek.io.output import disk
from ilmek.io.regular_file import open_regular

LARGEST_SECRET = 100_000
"""Largest size of a file of secrets or of a certificate [bytes]."""


def config_folder(name: str) -> Path:
    """The folder of the user's settings ilmek/`name`: below `$XDG_CONFIG_HOME` if that is absolute, else ~/.config."""
    given = Path(os.environ.get("XDG_CONFIG_HOME", ""))
    return (given if given.is_absolute() else Path("~/.config").expanduser()) / "ilmek" / name


def read_bounded(path: Path, noun: str, *, secret: bool = True) -> bytes:
    """The content of a regular file. Raises LoomError, for a secret also where others may read or write the file."""
    try:
        file, size = open_regular(path)
        with file:
            status = os.fstat(file.fileno())
            data = file.read(LARGEST_SECRET + 1) if size <= LARGEST_SECRET else b""
    except OSError as failed:
        raise LoomError(f"the {noun} file {path} cannot be read ({failed.strerror})") from None
    if not data or len(data) > LARGEST_SECRET:
        raise LoomError(f"the {noun} file {path} has {size:,} bytes", allowed=f"1 to {LARGEST_SECRET // 1000} kB")
    if secret and os.name == "posix":
        if stat.S_IMODE(status.st_mode) & 0o077:
            raise LoomError(f"others can read or write the {noun} file {path}", do=f"chmod 600 {path}")
        if status.st_uid not in (0, os.geteuid()):
            raise LoomError(f"the {noun} file {path} belongs to another user", do="give a file of yours")
    return data


@contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """One process or thread at a time in a folder of settings, so that what belongs together is of one of them.

    Raises OutputError where the folder cannot be made.
    """
    with ExitStack() as held:
        try:
            folder.mkdir(parents=True, mode=0o700, exist_ok=True)
            held.enter_context(disk.locked(folder / ".lock"))
        except OSError as failed:
            raise OutputError(f"{folder} cannot be written ({failed.strerror})") from None
        yield


def write_secret(path: Path, data: bytes) -> None:
    """Write a file for its owner alone, whole or not at all. Raises OutputError."""
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        path.parent.mkdir(parents=True, mode=0o700, exist_ok=True)
        part.unlink(missing_ok=True)
        with os.fdopen(os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        part.replace(path)
    except OSError as failed:
        with suppress(OSError):
            part.unlink()
        raise OutputError(f"{path} cannot be written ({failed.strerror})") from None
