"""The first error of a project's text file, found by the reader of the command line."""

import re
import tomllib
from dataclasses import dataclass, replace
from functools import lru_cache
from importlib import import_module
from pathlib import Path

from ilmek.errors import IlmekError
from ilmek.jobs.studio.project.folder import kind_of, read_bytes
from ilmek.jobs.studio.words import in_page
from ilmek.sentences import changed

_LINE = re.compile(r"\bline (\d+)")
_YARN = re.compile(r"\byarn (\d+) ")
_YARN_TABLE = re.compile(r"[ \t]*\[\[[ \t]*yarn[ \t]*\]\]")


@dataclass(frozen=True, slots=True)
class FileError:
    """The first error of a file: what was given, what is allowed, what to do, and the line where it is known.

    unfinished  it can be read, and lacks what its view names: points of a task, joints or a drive of a linkage
    """

    given: str
    allowed: str = ""
    do: str = ""
    line: int | None = None
    unfinished: bool = False


def file_error(base: Path, path: str, digest: str) -> FileError | None:
    """The first error of a text file of the project; None: it can be read.

    digest  of its content
    A recipe is read again whenever it is required: it depends on other files.
    """
    found = _read(base, path) if kind_of(path) == "carpet" else _kept(base, path, digest)
    if found is None:
        return None
    return replace(found, given=in_page(found.given), allowed=in_page(found.allowed), do=in_page(found.do))


@lru_cache(maxsize=1000)
def _kept(base: Path, path: str, digest: str) -> FileError | None:
    return _read(base, path)


def _read(base: Path, path: str) -> FileError | None:
    file = base / path
    try:
        _use_reader(kind_of(path) or "carpet", file)
    except IlmekError as error:
        parts = (error.given, error.allowed, error.do)
        given, allowed, do = (changed(part, lambda text: text.replace(f"{base}/", "")) for part in parts)
        return FileError(given, allowed, do, _line_of(given, file), _is_unfinished(kind_of(path), file))
    return None


def _is_unfinished(kind: str | None, file: Path) -> bool:
    """Whether a file with an error is half of what it is to be: a linkage that is not joined, a task without points."""
    if kind not in ("linkage", "synthesis"):
        return False
    rules = import_module("ilmek.jobs.studio.linkage.part" if kind == "linkage" else "ilmek.jobs.studio.synthesis.task")
    try:
        return bool(rules.is_unfinished(tomllib.loads(file.read_text(encoding="utf-8"))))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError):
        return False


def _use_reader(kind: str, file: Path) -> None:
    """Read a file as the command line does. The reader is imported here: the list of files comes without any."""
    match kind:
        case "carpet":
            import_module("ilmek.jobs.order").read_order(file)
        case "machine" | "synthesis":
            import_module("ilmek.jobs.machine_file").read_machine_order(str(file), {})
        case "linkage":
            import_module("ilmek.io.mechanism_file").read_mechanism(file).plan()
        case "cyclogram":
            import_module("ilmek.io.cyclogram_file").read_cyclogram(file)
        case "yarns":
            import_module("ilmek.io.yarn_file").read_yarns(file)


def _line_of(given: str, file: Path) -> int | None:
    """The line that a message names; of a yarn list, whose messages name the yarn, that of its table."""
    if line := _LINE.search(given):
        return int(line[1])
    if file.parent.name == "yarns" and (yarn := _YARN.search(given)):
        lines = (read_bytes(file) or b"").decode("utf-8", "replace").splitlines()
        tables = [number for number, one in enumerate(lines, start=1) if _YARN_TABLE.match(one)]
        return tables[int(yarn[1]) - 1] if int(yarn[1]) <= len(tables) else None
    return None
