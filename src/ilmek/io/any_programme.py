"""A programme from either of its forms: the file `.ilmek` or its text `.txt`."""

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TypeAlias

from ilmek.errors import ParameterError
from ilmek.io.programme_file import ProgrammeFile, open_programme, write_programme
from ilmek.io.programme_text import ProgrammeText, header_lines, open_programme_text, write_programme_text
from ilmek.io.programme_text_rows import RowReader, RowText, RowWriter
from ilmek.loom.operations import LoomProgramme
from ilmek.progress import SILENT, Progress

OpenProgramme: TypeAlias = ProgrammeFile | ProgrammeText
"""An open programme of either form, a `loom.operations.LoomProgramme`: close it, or use it as a context manager."""

TEXT = ".txt"
"""Ending of the text form; a file of any other ending is read as a programme file."""

_WRITERS = {".ilmek": write_programme, TEXT: write_programme_text}


def open_any_programme(path: Path, *, lenient: bool = False, progress: Progress = SILENT) -> OpenProgramme:
    """Open a programme of either form; by its ending. It is checked whole, every row included, before this returns.

    lenient  as in `open_programme` and `open_programme_text`: for the proof, which names what is wrong
    Raises LoomError, naming the file, and of a text the line.
    """
    if path.suffix.lower() == TEXT:
        return open_programme_text(path, lenient=lenient, progress=progress)
    return open_programme(path, lenient=lenient, progress=progress)


def require_form(path: Path) -> None:
    """Raise ParameterError unless a programme can be written into a file of that ending."""
    if path.suffix.lower() not in _WRITERS:
        raise ParameterError(f"{path} ends in {path.suffix!r}", allowed=" or ".join(_WRITERS))


def write_any_programme(path: Path, form: str, programme: LoomProgramme, *, progress: Progress = SILENT) -> None:
    """Write a programme into a new file. form: its ending. Raises as the writers of both forms."""
    _WRITERS[form.lower()](path, programme, progress=progress)


def row_texts(programme: OpenProgramme, numbers: Iterable[int]) -> Iterator[RowText]:
    """Some rows with the lines of the text: of the text itself, or of the text that a programme file would become.

    numbers  of the rows, ascending
    """
    if isinstance(programme, ProgrammeText):
        yield from map(programme.row_text, numbers)
        return
    setup, needed = programme.setup, list(numbers)
    line = sum(1 for _ in header_lines(setup)) + 1
    reader, writer = RowReader(setup), RowWriter(setup)
    for number in range(max(needed, default=-1) + 1):
        text = writer.text(programme.operations(number), programme.chart_row(number))
        if number in needed:
            yield reader.read(number, text, line)
        line += text.count(b"\n")
