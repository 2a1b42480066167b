"""The folder of a project: which files belong to it, their paths, reading, and atomic writing.

    carpet.toml   NAME.toml      recipes           machines/     synthesis/    machine files
    linkages/                    mechanisms        cyclograms/                 cyclograms
    yarns/                       yarn lists        pictures/                   pictures
    out/                         what was written  .studio/                    history; of the studio alone

No path leaves the folder: names are checked, and links are never followed. Only the standard library is needed.
"""

import contextlib
import errno
import hashlib
import os
import re
import secrets
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from ilmek.errors import IlmekError, OutputError, ParameterError, shortened
from ilmek.io.output import disk
from ilmek.io.regular_file import open_regular

OWN = ".studio"
"""The folder of the studio's own files."""

OUT = "out"
"""The folder of what the studio writes by the commands."""

PICTURES = "pictures"
"""The folder of the pictures."""

KINDS = {
    "": "carpet",
    "machines": "machine",
    "linkages": "linkage",
    "synthesis": "synthesis",
    "cyclograms": "cyclogram",
    "yarns": "yarns",
}
"""Kinds of the text files by their folder."""

SUFFIX = ".toml"
"""Ending of the text files."""

LARGEST_TEXT = 250_000
"""Largest size of a text file [bytes]."""

MOST_FILES = 2_000
"""Largest number of text files and pictures of a project."""

_NAME = re.compile(r"[\w][\w .()+,&=@~-]*")
_RESERVED = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\..*)?", re.IGNORECASE)
_ALLOWED = "letters, digits, space and . ( ) + , & = @ ~ - _; first a letter or digit; at most 100 characters"


def digest_of(content: bytes) -> str:
    """SHA-256 of a file's content, in hexadecimal digits."""
    return hashlib.sha256(content).hexdigest()


def check_name(name: str) -> str:
    """The name of a file or folder, if every system takes it. Raises ParameterError."""
    sound = _NAME.fullmatch(name) and len(name.encode()) <= 200 and len(name) <= 100 and name[-1] not in " ."
    if not sound or _RESERVED.fullmatch(name):
        raise ParameterError(f"{shortened(ascii(name))} cannot be the name of a file", allowed=_ALLOWED)
    return name


@dataclass(frozen=True, slots=True)
class ProjectFolder:
    """A project's folder."""

    base: Path

    def path(self, text: str) -> Path:
        """The path of a file of the project, given relative to it with /.

        Raises ParameterError for a path that leaves the folder, also through a link, and for names that no file has.
        """
        parts = text.split("/")
        odd = "\\" in text or any(part in ("", ".", "..") for part in parts)
        if odd or len(text) > 500 or len(parts) > 8:
            given = f"{shortened(ascii(text))} is no file of the project"
            raise ParameterError(given, allowed="a path below the project's folder, with /")
        path = self.base.joinpath(*map(check_name, parts))
        at = self.base
        for part in parts:
            at /= part
            if at.is_symlink():
                raise ParameterError(f"{text} is a link", do="copy the file into the project's folder")
        return path

    def text_path(self, text: str) -> Path:
        """The path of a text file that the studio edits. Raises ParameterError for another path."""
        path = self.path(text)
        if kind_of(text) is None:
            folders = ", ".join(f"{folder}/NAME{SUFFIX}" for folder in KINDS if folder)
            raise ParameterError(f"{text} is no text file of a project", allowed=f"NAME{SUFFIX}, {folders}")
        return path

    def texts(self) -> list[str]:
        """The paths of all text files, in the order of their kinds; those of folders that are closed are left out."""
        found = [name for folder in KINDS for name in self._names(folder) if name.endswith(SUFFIX)]
        return found[:MOST_FILES]

    def pictures(self) -> list[str]:
        """The paths of all pictures."""
        return self._names(PICTURES)[:MOST_FILES]

    def closed(self) -> tuple[str, ...]:
        """What is wrong with folders of the project that cannot be read, each with what to do."""
        found = []
        for folder in (*KINDS, PICTURES):
            try:
                _entries(self.base / folder)
            except IlmekError as error:
                found.append(str(error))
        return tuple(found)

    def _names(self, folder: str) -> list[str]:
        """The paths of the regular files of a folder with names that the studio takes; none of one that is closed."""
        try:
            entries = _entries(self.base / folder)
        except IlmekError:
            return []
        names = [entry.name for entry in entries if entry.is_file(follow_symlinks=False) and _is_taken(entry.name)]
        found = [f"{folder}/{name}" if folder else name for name in names]
        return sorted(found, key=lambda path: (path != "carpet.toml", natural(path)))

    @contextlib.contextmanager
    def locked(self) -> Iterator[None]:
        """Held while files are changed: changes of two tabs, workers or studios come one after the other."""
        own = self.base / OWN
        with contextlib.ExitStack() as held:
            try:
                own.mkdir(mode=0o700, exist_ok=True)
                held.enter_context(disk.locked(own / "lock"))
            except OSError as error:
                raise cannot("be written", own, error) from None
            yield


def natural(path: str) -> tuple[tuple[int | str, ...], str]:
    """Sort key of a path: as people count, without the ending first.

    >>> sorted(["copy-10.toml", "Copy-2.toml", "copy.toml", "copy-1.toml"], key=natural)
    ['copy.toml', 'copy-1.toml', 'Copy-2.toml', 'copy-10.toml']
    """
    stem = re.sub(r"\.[A-Za-z]\w*$", "", path).casefold()
    parts = enumerate(re.split(r"([0-9]+)", stem))
    return tuple(int(part) if at % 2 else part for at, part in parts), path


def kind_of(path: str) -> str | None:
    """The kind of a text file by its path; None for another file."""
    pure = PurePosixPath(path)
    folder = "" if len(pure.parts) == 1 else "/".join(pure.parts[:-1])
    return KINDS.get(folder) if pure.suffix == SUFFIX and not pure.name.startswith(".") else None


def _entries(folder: Path) -> list[os.DirEntry[str]]:
    """The entries of a folder of the project, if there is one. Raises ParameterError for a link, OutputError."""
    if folder.is_symlink():
        raise ParameterError(f"{folder} is a link", do="copy the folder into the project's folder")
    try:
        with os.scandir(folder) as entries:
            return list(entries)
    except FileNotFoundError:
        return []
    except OSError as error:
        raise cannot("be read", folder, error) from None


def _is_taken(name: str) -> bool:
    try:
        check_name(name)
    except ParameterError:
        return False
    return True


def read_bytes(path: Path, largest: int = LARGEST_TEXT) -> bytes | None:
    """The content of a regular file, no link; None if there is none. Raises ParameterError, OutputError."""
    try:
        file, size = open_regular(path, follow=False)
        with file:
            content = file.read(largest + 1)
    except FileNotFoundError:
        return None
    except OSError as error:
        raise cannot("be read", path, error) from None
    if len(content) > largest:
        raise ParameterError(f"{path.name} has {max(size, len(content)):,} bytes", allowed=f"at most {largest:,}")
    return content


def make_folder(path: Path) -> None:
    """Make a folder, if it is not there. Raises OutputError."""
    try:
        path.mkdir(exist_ok=True)
    except OSError as error:
        raise cannot("be made", path, error) from None


def write_bytes(path: Path, content: bytes) -> None:
    """Write a file, whole or not at all: beside it, synced, then renamed. Raises OutputError."""
    made = path.with_name(f".{path.name}.{secrets.token_hex(4)}.tmp")
    try:
        path.parent.mkdir(exist_ok=True)
        disk.write(made, content)
        disk.sync(made)
        with contextlib.suppress(FileNotFoundError):
            made.chmod(path.stat().st_mode & 0o777)
        disk.replace(made, path)
        disk.sync(path.parent)
    except OSError as error:
        raise cannot("be written", path, error) from None
    finally:
        with contextlib.suppress(OSError):
            made.unlink(missing_ok=True)


def cannot(do: str, path: Path, error: OSError) -> IlmekError:
    """The error for a file that the system refuses, with what to do."""
    remedies = {
        errno.ENOSPC: "free some space on the disc; your work stays in the browser until it is saved",
        errno.EDQUOT: "free some space of your share; your work stays in the browser until it is saved",
        errno.EACCES: "give yourself the permission, or open a project in another folder",
        errno.EPERM: "give yourself the permission, or open a project in another folder",
        errno.EROFS: "the disc is read-only: copy the project to another one",
        errno.EINVAL: "the studio takes regular files alone, no links, pipes or devices",
        errno.ELOOP: "the studio takes regular files alone, no links, pipes or devices",
    }
    given = f"{path} cannot {do} ({error.strerror or error})"
    return OutputError(given, do=remedies.get(error.errno or 0, "check the folder"))
