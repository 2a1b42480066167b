"""The text form of a programme, `.txt`: one operation a line, to read, to edit and to compare.

    ilmek programme 1
    loom "…"                 the description, as JSON: a line for each key, of a list a line for each entry
    …
    row 1                    rows from the carpet's bottom edge, and all else from 1
    chart 12*3 4*1 5*0       12 knots of yarn 3, 4 of yarn 1, 5 cells without a knot
    phase 1
    head 1
    tie 1..12 tube 3
    …
    end

Text and programme are equal: a programme that is written and read again has the same digest. The grammar
is in `docs/reference/programme-text.md`. A text is read row by row, and never whole.
"""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from ilmek.arrays import UInt8
from ilmek.errors import IlmekError, LoomError, shortened
from ilmek.io.closable import Closable
from ilmek.io.programme_meta import KEYS, OPTIONAL, meta_texts, read_meta
from ilmek.io.programme_text_rows import LineRemark, RowReader, RowText, RowWriter
from ilmek.io.regular_file import open_regular
from ilmek.io.sqlite_readonly import LARGEST_VALUE
from ilmek.loom.explicit import programme_digest
from ilmek.loom.operations import EMPTY, LoomProgramme, LoomSetup, RowOperations
from ilmek.progress import SILENT, Progress

VERSION = 1
"""Version of the text form, in its first line."""

LARGEST_FILE = 10_000_000_000
"""Largest size of a text [bytes]: a knot has at most 60, the largest carpet 200 million knots."""

MOST_HEADER_LINES = 10_000
"""Largest number of lines of the description: yarns, the tubes of 1,000 heads, bobbins and cyclograms have fewer."""

MOST_REMARKS = 1000
"""Largest number of remarks on lines that are kept."""

_FIRST = b"ilmek programme "
_LISTS = ("yarns", "loading", "packages", "wefts", "cyclograms")
_KEYS = tuple(key for key in KEYS if key != "digest")
_ALL = (*_KEYS, *OPTIONAL)
_ENTRY = re.compile(r"(\w+)(?:\[(\d+)\])?")
_NO_DIGEST = json.dumps("0" * 64)
_KNOT_BYTES = 120
_MORE_BYTES = 1_000_000
_CHUNK = 1 << 20


def write_programme_text(path: Path, programme: LoomProgramme, *, progress: Progress = SILENT) -> None:
    """Write a programme as text into a new file. Raises OSError if it cannot be written, LoomError as `RowWriter`."""
    with path.open("wb") as file:
        for part in programme_text_parts(programme, progress):
            file.write(part)


def programme_text_parts(programme: LoomProgramme, progress: Progress = SILENT) -> Iterator[bytes]:
    """The text of a programme: its description, each of its rows, its end."""
    setup = programme.setup
    yield "".join(f"{line}\n" for line in header_lines(setup)).encode()
    writer = RowWriter(setup)
    for number in range(setup.rows):
        yield writer.text(programme.operations(number), programme.chart_row(number))
        progress((number + 1) / setup.rows)
    yield b"end\n"


def header_lines(setup: LoomSetup) -> Iterator[str]:
    """The lines of the description. Raises an IlmekError for a setup that would be refused when it is read."""
    yield f"{_FIRST.decode()}{VERSION}"
    texts = meta_texts(setup, "0" * 64)
    for key in (key for key in _ALL if key in texts):
        values = json.loads(texts[key]) if key in _LISTS else [json.loads(texts[key])]
        values = [[(yarn + 1) % (EMPTY + 1) for yarn in head] for head in values] if key == "loading" else values
        yield from (f"{key} {json.dumps(value, ensure_ascii=False)}" for value in values)


def open_programme_text(path: Path, *, lenient: bool = False, progress: Progress = SILENT) -> "ProgrammeText":
    """Open the text of a programme for reading; close it, or use it as a context manager.

    The file may come from anybody: it is checked whole, every row included, before this returns.
    lenient  keep remarks on lines in `ProgrammeText.remarks` instead of raising the first
    Raises LoomError "FILE, line N: ..." for a line that is wrong, and for a file that cannot be read or is too large.
    """
    try:
        file, size = open_regular(path)
    except OSError as error:
        raise LoomError(f"{path} cannot be read: {error.strerror}", allowed="the text of a programme") from None
    try:
        if size > LARGEST_FILE:
            raise LoomError(f"{path} has {size} bytes", allowed=f"at most {LARGEST_FILE // 1_000_000} MB")
        text = ProgrammeText(path, file, size, progress)
        if text.remarks and not lenient:
            first = text.remarks[0]
            raise text.error(LoomError(f"line {first.line}: {first.what}", do="correct that line"))
        return text
    except BaseException:
        file.close()
        raise


class ProgrammeText(Closable):
    """An open text of a programme, `loom.operations.LoomProgramme`.

    digest   SHA-256 of all operations and the chart
    lines    line of each key of the description; of a list, of its first entry
    remarks  on lines that do not agree with the operations around them, up to MOST_REMARKS
    """

    def __init__(self, path: Path, file: BinaryIO, size: int, progress: Progress = SILENT) -> None:
        self.path, self._file = path, file
        self.remarks: list[LineRemark] = []
        try:
            texts, self.lines, line = _read_header(file)
            self.setup: LoomSetup = _setup(texts, self.lines)
            self._reader = RowReader(self.setup)
            self._index = np.zeros((self.setup.rows + 1, 2), np.int64)
            opening = _Opening(self.setup, self._read_rows(line, size))
            self.digest = programme_digest(opening, progress)
            next(opening.rows, None)
        except IlmekError as error:
            raise self.error(error) from None
        self._latest: RowText | None = None

    def operations(self, number: int) -> RowOperations:
        """The operations of a loom row. Raises LoomError beyond the carpet, or if the file has changed."""
        return self.row_text(number).row

    def chart_row(self, number: int) -> UInt8[np.ndarray, " columns"]:
        """Yarn of each knot of a loom row. Raises LoomError as `operations`."""
        return self.row_text(number).chart

    def row_text(self, number: int) -> RowText:
        """A row and its lines. Raises LoomError as `operations`."""
        self.setup.require_row(number)
        if self._latest is None or self._latest.row.number != number:
            (begin, line), end = self._index[number].tolist(), int(self._index[number + 1, 0])
            self._file.seek(begin)
            data = self._file.read(end - begin)
            if len(data) < end - begin or not data.endswith(b"\n"):
                raise LoomError(f"{self.path} has changed while it was read", do="read it again")
            try:
                self._latest = self._reader.read(number, data, line)
            except IlmekError as error:
                raise self.error(error) from None
        return self._latest

    def error(self, error: IlmekError) -> LoomError:
        """An error of a line as one of the file."""
        return LoomError(f"{self.path}, {error.given}", allowed=error.allowed, do=error.do)

    def _read_rows(self, line: int, size: int) -> Iterator[RowText]:
        """Every row, checked, and behind the last one the end of the text; keeps where each row begins."""
        most = _KNOT_BYTES * self.setup.columns + _MORE_BYTES
        begin, number = self._file.tell(), 0
        for data in _row_texts(self._file, most, line):
            if data.startswith(b"end\n"):
                break
            if number == self.setup.rows:
                raise LoomError(f"line {line}: a row beyond the carpet", allowed=f"{self.setup.rows} rows, then `end`")
            self._index[number] = begin, line
            found = self._reader.read(number, data, line)
            self.remarks += found.remarks[: MOST_REMARKS - len(self.remarks)]
            begin, line, number = begin + len(data), line + found.lines, number + 1
            yield found
        else:
            raise LoomError(f"line {line}: the text ends without `end`", allowed="a whole text", do="write it again")
        if number < self.setup.rows or begin + len(b"end\n") < size:
            raise LoomError(f"line {line}: `end`", allowed=f"{self.setup.rows} rows, then `end`, then nothing more")
        self._index[number] = begin, line

    def close(self) -> None:
        """Close the file; rows that were read stay usable."""
        self._file.close()


class _Opening:
    """The rows of a text as they are read for the first time, one after the other, for its digest."""

    digest = ""

    def __init__(self, setup: LoomSetup, rows: Iterator[RowText]) -> None:
        self.setup, self.rows = setup, rows

    def operations(self, number: int) -> RowOperations:
        """The next row, which is row `number`."""
        self._latest = {number: next(self.rows)}
        return self._latest[number].row

    def chart_row(self, number: int) -> UInt8[np.ndarray, " columns"]:
        """The chart of the row that was read last."""
        return self._latest[number].chart


def _read_header(file: BinaryIO) -> tuple[dict[str, str], dict[str, int], int]:
    """The description as JSON texts by key, the line of each, and the number of the line after it."""
    if file.readline(len(_FIRST) + 20) != _FIRST + b"%d\n" % VERSION:
        allowed = f"`{_FIRST.decode()}{VERSION}`, as `ilmek convert` writes it"
        raise LoomError("line 1: no text of a programme, or of another version", allowed=allowed)
    found: dict[str, list[str]] = {}
    lines: dict[str, int] = {}
    for line in range(2, MOST_HEADER_LINES):
        begin = file.tell()
        data = file.readline(LARGEST_VALUE)
        if data.startswith(b"row "):
            file.seek(begin)
            _require_keys(found)
            texts = {
                key: f"[{','.join(found.get(key, ()))}]" if key in _LISTS else found[key][0]
                for key in _ALL
                if key in _KEYS or key in found
            }
            return texts | {"digest": _NO_DIGEST}, lines, line
        key, value = _entry(data, line)
        if key in found and key not in _LISTS:
            raise LoomError(f"line {line}: {key} is given again", allowed=f"first on line {lines[key]}")
        if list(found)[-1:] != [key] and key in found:
            raise LoomError(f"line {line}: {key} is not with its other lines", allowed=f"after line {lines[key]}")
        found.setdefault(key, []).append(value)
        lines.setdefault(key, line)
    raise LoomError(f"line {MOST_HEADER_LINES}: the description is too long", allowed=f"{MOST_HEADER_LINES} lines")


def _require_keys(found: dict[str, list[str]]) -> None:
    """Raise LoomError for a key that is missing."""
    missing = [key for key in _KEYS if key not in found and key not in _LISTS]
    if missing:
        raise LoomError(f"line 1: the description has no {missing[0]}", allowed=f"keys: {', '.join(_KEYS)}")


def _entry(data: bytes, line: int) -> tuple[str, str]:
    """Key and JSON text of a line of the description. Raises LoomError for another line."""
    try:
        text = data.decode()
        key, blank, value = text.removesuffix("\n").partition(" ")
        if not text.endswith("\n") or not blank or key not in _ALL:
            given = shortened(text[:200].strip().encode("ascii", "backslashreplace").decode())
            raise LoomError(f"line {line}: `{given}` is no line of the description", allowed=", ".join((*_KEYS, "row")))
        found = json.loads(value)
        return key, json.dumps(_from_zero(found, line)) if key == "loading" else value
    except (ValueError, RecursionError) as error:  # no UTF-8, no JSON, deeply nested brackets, a huge number
        raise LoomError(f"line {line} is not JSON ({shortened(str(error), 100)})", do="correct that line") from None


def _from_zero(loaded: object, line: int) -> list[int]:
    """The yarns of a head's tubes, from 0; given from 1, and 0 for an empty tube. Raises LoomError for others."""
    if not isinstance(loaded, list) or not all(type(yarn) is int and 0 <= yarn <= EMPTY for yarn in loaded):
        raise LoomError(f"line {line}: loading", allowed="the yarn of each tube of a head, 0 for none: [1, 2, 0]")
    return [(yarn - 1) % (EMPTY + 1) for yarn in loaded]


def _setup(texts: dict[str, str], lines: dict[str, int]) -> LoomSetup:
    """The description. Raises LoomError with the line of the entry that cannot be used."""
    try:
        return read_meta(texts)[0]
    except IlmekError as error:
        found = _ENTRY.match(error.given)
        key, index = found.groups() if found else ("", None)
        line = lines.get(key, 1) + (int(index) if index and key in _LISTS else 0)
        raise LoomError(f"line {line}: {error.given}", allowed=error.allowed, do=error.do) from None


def _row_texts(file: BinaryIO, most: int, line: int) -> Iterator[bytes]:
    """The text of each row, and the rest from `end` on. Raises LoomError for a row of more than `most` bytes."""
    kept: Any = bytearray()
    searched = 0
    while True:
        data = file.read(_CHUNK)
        kept += data
        while True:
            cut = _cut(kept, searched)
            if cut < 0:
                break
            row = bytes(kept[:cut])
            del kept[:cut]
            searched = 0
            yield row
            line += row.count(b"\n")
        searched = max(0, len(kept) - 5)
        if len(kept) > most:
            raise LoomError(f"line {line}: the row has more than {most} bytes", allowed="a row of the carpet")
        if not data:
            if kept:
                if not kept.endswith(b"\n"):
                    at = line + kept.count(b"\n")
                    raise LoomError(f"line {at}: the text ends within a line", do="write it again")
                yield bytes(kept)
            return


def _cut(kept: bytearray, start: int) -> int:
    """Index of the next row, or of `end`, behind the first line; -1 where there is none yet."""
    at = kept.find(b"\nrow ", start)
    at = kept.find(b"\nend", start) if at < 0 else at
    return at + 1 if at >= 0 else -1
