"""The files of a project: listed, read, saved, undone, created, renamed, deleted.

Every change holds the lock of the project, so that two tabs, workers or studios change it one after the other. A text
that has an error is saved all the same, as work in progress, and its first error is reported.
"""

import tomllib
from dataclasses import dataclass, field
from typing import Any

from ilmek.errors import ParameterError, encodable
from ilmek.io.output import disk
from ilmek.io.toml_merge import merged_toml
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.project.check import FileError, file_error
from ilmek.jobs.studio.project.folder import (
    LARGEST_TEXT,
    MOST_FILES,
    ProjectFolder,
    cannot,
    digest_of,
    kind_of,
    read_bytes,
    write_bytes,
)
from ilmek.jobs.studio.project.history import History, move_history, read_history
from ilmek.records import JsonObject


@dataclass(frozen=True, slots=True)
class ProjectRequest:
    """The whole project.

    checked  whether the first error of each file is required; the first check takes some seconds
    """

    checked: bool = True


@dataclass(frozen=True, slots=True)
class PathRequest:
    """A text file of the project, by its path relative to the folder, with /."""

    path: str


@dataclass(frozen=True, eq=False, slots=True)
class SaveRequest:
    """A new state of a text file.

    data    its plain data; comments and order of the text are kept      text  or the whole text
    base    digest of the state that was changed; "": the file is new
    aside   into the history alone: the file stays as it is, and undo brings this state back
    """

    path: str
    base: str
    data: JsonObject | None = None
    text: str | None = None
    aside: bool = False


@dataclass(frozen=True, slots=True)
class NewRequest:
    """A new text file. text: its content; source: or the path of a file that is copied."""

    path: str
    text: str = ""
    source: str = ""


@dataclass(frozen=True, slots=True)
class RenameRequest:
    """A new path for a text file, of the same kind."""

    path: str
    new: str


@dataclass(frozen=True, slots=True)
class FileSummary:
    """A text file of the project.

    digest  of its content              size   [bytes]
    time    of its last change [s since 1970]      error  the first one; null: it can be used
    """

    path: str
    kind: str
    digest: str
    size: int
    time: float = 0.0
    error: FileError | None = None


@dataclass(frozen=True, slots=True)
class PictureSummary:
    """A picture of the project. size: [bytes]."""

    path: str
    size: int


@dataclass(frozen=True, slots=True)
class ProjectSummary:
    """A project: its folder, its text files by kind, and its pictures.

    problems  folders that cannot be read, each with what to do
    """

    name: str
    folder: str
    files: tuple[FileSummary, ...]
    pictures: tuple[PictureSummary, ...]
    problems: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class FileContent:
    """A text file.

    text        its content                       data  as plain data; null where it is no TOML
    digest      of the content; "": there is no such file
    error       the first one; null: it can be used
    undo, redo  whether there is a state before and after this one
    """

    path: str
    kind: str
    text: str
    data: JsonObject | None
    digest: str
    error: FileError | None = None
    undo: bool = False
    redo: bool = False


@dataclass(frozen=True, slots=True)
class SavedFile:
    """The answer to a change.

    saved  False: another program or tab changed the file since `base`; nothing was written
    file   as it is now on the disc
    """

    saved: bool
    file: FileContent


@dataclass(frozen=True, slots=True)
class Changed:
    """The files that a request changed."""

    paths: tuple[str, ...] = field(default=())


def project(request: ProjectRequest, context: Context) -> ProjectSummary:
    """The files of the project, each with its first error; a folder that is closed is reported, the rest opens."""
    folder = ProjectFolder(context.folder.resolve())
    files = []
    paths = folder.texts()
    for number, path in enumerate(paths):
        context.progress(number / len(paths))
        files.append(_summary(folder, path, checked=request.checked))
    pictures = tuple(PictureSummary(path, (folder.base / path).stat().st_size) for path in folder.pictures())
    return ProjectSummary(folder.base.name, str(folder.base), tuple(files), pictures, folder.closed())


def _summary(folder: ProjectFolder, path: str, *, checked: bool) -> FileSummary:
    kind = kind_of(path) or ""
    try:
        content = read_bytes(folder.base / path) or b""
        time = (folder.base / path).stat().st_mtime
    except Exception as error:  # of one file; the rest opens
        return FileSummary(path, kind, "", 0, error=FileError(str(error)))
    digest = digest_of(content)
    error_of_file = file_error(folder.base, path, digest) if checked else None
    return FileSummary(path, kind, digest, len(content), time, error_of_file)


def read_file(request: PathRequest, context: Context) -> FileContent:
    """A text file: text, data, digest, first error.

    One that is not there has a digest of ""; one that has gone can be undone. Raises ParameterError for another path.
    """
    return _content(ProjectFolder(context.folder.resolve()), request.path)


def save_file(request: SaveRequest, context: Context) -> SavedFile:
    """Save a text file, if it still is what was changed. Raises ParameterError, OutputError."""
    folder = ProjectFolder(context.folder.resolve())
    path = folder.text_path(request.path)
    with folder.locked():
        old = read_bytes(path)
        if request.aside:
            return _set_aside(folder, request, old)
        if (digest_of(old) if old is not None else "") != request.base:
            return SavedFile(False, _content(folder, request.path))
        content = _new_content(request, old or b"")
        if content != old:
            _change(folder, request.path, content)
        return SavedFile(True, _content(folder, request.path))


def _set_aside(folder: ProjectFolder, request: SaveRequest, old: bytes | None) -> SavedFile:
    """Put a state into the history, before the file as it is; the caller holds the lock."""
    history = _history(folder, request.path)
    current = history.current
    history.add(_text(_new_content(request, old or b"")))
    history.add(current)
    return SavedFile(True, _content(folder, request.path))


def _new_content(request: SaveRequest, old: bytes) -> bytes:
    if (request.data is None) == (request.text is None):
        raise ParameterError(f"{request.path}: data or text is required", do="give one of them")
    text = request.text or "" if request.data is None else merged_toml(_text(old), request.data)
    return _checked(request.path, text)


def _checked(path: str, text: str) -> bytes:
    try:
        content = text.encode("utf-8")
    except UnicodeEncodeError:
        raise ParameterError(f"{path}: the text is not Unicode", do="remove halves of surrogate pairs") from None
    if len(content) > LARGEST_TEXT:
        raise ParameterError(f"{path} would have {len(content):,} bytes", allowed=f"at most {LARGEST_TEXT:,}")
    return content


def undo(request: PathRequest, context: Context) -> FileContent:
    """Bring back the state of a file before the current one; also a deleted file. Nothing where there is none."""
    return _moved(request.path, -1, context)


def redo(request: PathRequest, context: Context) -> FileContent:
    """Bring back the state of a file that was undone last. Nothing where there is none."""
    return _moved(request.path, 1, context)


def _moved(path: str, step: int, context: Context) -> FileContent:
    folder = ProjectFolder(context.folder.resolve())
    file = folder.text_path(path)
    with folder.locked():
        history = _history(folder, path)
        moves = history.next_text(step)
        if moves is not None:
            text = history.states[history.at + moves]
            write_bytes(file, _bytes(text or ""))
            history.move(moves)
        return _content(folder, path)


def new_file(request: NewRequest, context: Context) -> FileContent:
    """Create a text file, empty, of a text or as a copy. Raises ParameterError where there is one of this path."""
    folder = ProjectFolder(context.folder.resolve())
    path = folder.text_path(request.path)
    with folder.locked():
        _require_free(path, request.path)
        if len(folder.texts()) >= MOST_FILES:
            raise ParameterError("the project has too many files", allowed=f"{MOST_FILES:,}")
        content = _checked(request.path, request.text)
        if request.source:
            copied = read_bytes(folder.text_path(request.source))
            if copied is None:
                raise ParameterError(f"{request.source} is not there")
            content = copied
        _change(folder, request.path, content)
        return _content(folder, request.path)


def rename_file(request: RenameRequest, context: Context) -> Changed:
    """Rename a text file; its history goes with it. Raises ParameterError where the new path is taken."""
    folder = ProjectFolder(context.folder.resolve())
    old, new = folder.text_path(request.path), folder.text_path(request.new)
    if kind_of(request.path) != kind_of(request.new):
        raise ParameterError(f"{request.new} is of another kind", do=f"keep the folder of {request.path}")
    with folder.locked():
        _require_free(new, request.new)
        try:
            new.parent.mkdir(exist_ok=True)
            disk.rename(old, new)
            disk.sync(new.parent)
        except FileNotFoundError:
            raise ParameterError(f"{request.path} is not there") from None
        except OSError as error:
            raise cannot("be renamed", old, error) from None
        move_history(folder.base, request.path, request.new)
    return Changed((request.path, request.new))


def delete_file(request: PathRequest, context: Context) -> Changed:
    """Delete a text file; undo brings it back. Raises ParameterError where there is none."""
    folder = ProjectFolder(context.folder.resolve())
    path = folder.text_path(request.path)
    with folder.locked():
        history = _history(folder, request.path)
        if history.current is None:
            raise ParameterError(f"{request.path} is not there")
        try:
            disk.unlink(path)
            disk.sync(path.parent)
        except OSError as error:
            raise cannot("be deleted", path, error) from None
        history.add(None)
    return Changed((request.path,))


def _require_free(path: Any, name: str) -> None:
    if path.exists() or path.is_symlink():
        raise ParameterError(f"{name} exists already", do="take another name")


def _change(folder: ProjectFolder, path: str, content: bytes) -> None:
    """Write a file with the state before in its history; the caller holds the lock."""
    history = _history(folder, path)
    write_bytes(folder.base / path, content)
    history.add(_text(content))


def _history(folder: ProjectFolder, path: str) -> History:
    """The history of a file with the file as its current state; the caller holds the lock."""
    history = read_history(folder.base, path)
    content = read_bytes(folder.base / path)
    history.add(None if content is None else _text(content))
    return history


def _content(folder: ProjectFolder, path: str) -> FileContent:
    kind = kind_of(path)
    content = read_bytes(folder.text_path(path))
    if content is None:
        gone = FileError(f"{path} is not there", do="it was deleted or renamed; undo brings it back")
        history = read_history(folder.base, path)
        can_undo = history.current is not None or history.can(-1)
        return FileContent(path, kind or "", "", None, "", gone if can_undo else None, undo=can_undo)
    text, digest = _text(content), digest_of(content)
    history = read_history(folder.base, path)
    changed = history.current != text
    return FileContent(
        path,
        kind or "",
        encodable(text),
        _data(text),
        digest,
        file_error(folder.base, path, digest),
        undo=history.at >= 0 if changed else history.can(-1),
        redo=not changed and history.can(1),
    )


def _data(text: str) -> JsonObject | None:
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError):
        return None


def _text(content: bytes) -> str:
    return content.decode("utf-8", "surrogateescape")


def _bytes(text: str) -> bytes:
    return text.encode("utf-8", "surrogateescape")
