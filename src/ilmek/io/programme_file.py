"""The loom's programme as one file, `.ilmek`: an SQLite database with a compressed blob for each row.

    meta   key, value    carpet, loom, totals, and both cyclograms with their laws by name; as JSON
    row    number, time, data    loom row (0 at the carpet's bottom edge), its time [s], and zlib of
                                 colours (a byte per knot, by column) + keys (three bytes per part, see `loom.schedule`)

The file is written into the staging folder of an output (`ilmek.io.output`), which makes it complete or nothing.
"""

import contextlib
import sqlite3
import zlib
from collections.abc import Iterator
from dataclasses import fields
from pathlib import Path
from types import TracebackType

import numpy as np

from ilmek.arrays import FloatArray, IntArray, UInt8
from ilmek.errors import IlmekError, LoomError
from ilmek.io.programme_meta import Label, ProgrammeMeta, Totals, meta_texts, read_meta
from ilmek.io.sqlite_readonly import DamagedDatabase, ReadOnlyDatabase, SqliteHeader
from ilmek.loom.bobbins import Bobbin, ChangeStop, change_stops, stop_time
from ilmek.loom.programme import HeadWork, Programme, Times, least_time
from ilmek.loom.row import KnotRow, invalid_rows
from ilmek.loom.schedule import PASSES
from ilmek.loom.sharing import halves
from ilmek.progress import SILENT, Progress

APPLICATION, VERSION = 0x696C6D6B, 2
"""Application id (the letters `ilmk`) and version of the format, in the file's header."""

_LEVEL = 6
_PAGE = 8192
_AGAIN = "write the programme again with `ilmek weave`"
TABLES = {
    "meta": "CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID",
    "row": "CREATE TABLE row (number INTEGER PRIMARY KEY, time REAL NOT NULL, data BLOB NOT NULL)",
}
"""The tables of the file; a file with others is refused."""

LARGEST_FILE = 1_000_000_000
"""Largest size of a file [bytes]: MOST_KNOTS knots with keys take 200 to 800 MB where they cannot be compressed."""

_ROUNDING = 1e-9
"""Relative difference of sums that are taken in another order."""

_BLOCK = 1 << 21
"""Bytes of rows that are checked at once: they stay in the processor's cache."""


def write_programme(path: Path, programme: Programme, label: Label, *, progress: Progress = SILENT) -> None:
    """Write a programme to a new file.

    Raises OSError or sqlite3.Error if it cannot be written, LoomError if the label's yarns are not the programme's, and
    the error of a label that could not be read again.
    """
    if len(label.yarns) != programme.yarns:
        raise LoomError(f"{len(label.yarns)} yarns for a programme of {programme.yarns}")
    texts = meta_texts(programme, label)
    with contextlib.closing(sqlite3.connect(path, isolation_level=None)) as connection:
        # Nobody reads the file before the rename: no journal is needed.
        for pragma in (f"page_size={_PAGE}", "journal_mode=OFF", "synchronous=OFF", f"application_id={APPLICATION}"):
            connection.execute(f"PRAGMA {pragma}").fetchall()
        connection.execute(f"PRAGMA user_version={VERSION}")
        connection.execute("BEGIN")
        for statement in TABLES.values():
            connection.execute(statement)
        connection.executemany("INSERT INTO meta VALUES (?, ?)", texts.items())
        connection.executemany("INSERT INTO row VALUES (?, ?, ?)", _blobs(programme, progress))
        connection.execute("COMMIT")


def open_programme(path: Path, *, progress: Progress = SILENT) -> "ProgrammeFile":
    """Open a programme for reading; close it, or use it as a context manager.

    The file may come from anybody: it is checked whole, every row included, before this returns.
    Raises LoomError if the file is missing, no programme, of a newer format, too large, truncated or damaged, and where
    its numbers do not agree with each other.
    """
    _check_header(path)
    with _as_loom_error(path):
        database = ReadOnlyDatabase(path, TABLES)
    try:
        with _as_loom_error(path):
            stored = database.select("SELECT key, value FROM meta LIMIT 99")
            file = ProgrammeFile(path, database, read_meta({_text(key): _text(value) for key, value in stored}))
            _check_rows(file, progress)
            return file
    except BaseException:
        database.close()
        raise


class ProgrammeFile:
    """An open programme: its label, its totals, and its rows one by one.

    label, times, heads, edges, rows, columns    as in `Label` and `loom.programme.Programme`
    bobbins                                      of weft: when each is changed
    totals, work                                 totals of the carpet, and the work of each head
    """

    __slots__ = (
        "_database", "bobbins", "columns", "edges", "heads", "label", "path", "rows", "times", "totals", "work",
    )  # fmt: skip

    label: Label
    rows: int
    columns: int
    heads: int
    edges: IntArray
    times: Times
    bobbins: tuple[Bobbin, ...]
    totals: Totals
    work: HeadWork

    def __init__(self, path: Path, database: ReadOnlyDatabase, meta: ProgrammeMeta) -> None:
        self.path, self._database = path, database
        for one in fields(meta):
            setattr(self, one.name, getattr(meta, one.name))

    @property
    def stops(self) -> tuple[ChangeStop, ...]:
        """The stops in which bobbins of weft are changed."""
        return change_stops(self.bobbins, self.rows)

    def row(self, number: int) -> KnotRow:
        """Loom row `number`, 0 at the carpet's bottom edge. Raises LoomError beyond the carpet or if it is damaged."""
        plain = np.frombuffer(self.unpacked(number, self._stored(number)[1]), np.uint8)
        colours, keys = plain[: self.columns], plain[self.columns :].reshape(-1, 3)
        with _as_loom_error(self.path):
            return KnotRow(number, colours, keys, self.edges, self.heads)

    def row_time(self, number: int) -> float:
        """Time of a loom row with its wefts [s]. Raises LoomError as `row`."""
        time = self._stored(number)[0]
        if not isinstance(time, float):
            raise self.damaged(f"row {number} is damaged")
        return time

    def stored_rows(self) -> Iterator[tuple[int, object, object]]:
        """Number, time [s] and data of every row as stored, in order."""
        yield from self._database.select("SELECT number, time, data FROM row ORDER BY number")

    def unpacked(self, number: int, data: object) -> bytes:
        """Colours and keys of a row. Raises LoomError if their length is not that of a row."""
        expected = self.columns + 3 * (len(self.edges) - 1)
        inflate = zlib.decompressobj()
        try:
            raw = inflate.decompress(data, expected + 1) if isinstance(data, bytes) else b""
        except zlib.error:
            raw = b""
        if len(raw) != expected or not inflate.eof or inflate.unused_data:
            raise self.damaged(f"row {number} is damaged")
        return raw

    def damaged(self, reason: str) -> LoomError:
        """The error of a file that is damaged."""
        return LoomError(f"{self.path}: {reason}", allowed="a whole programme", do=_AGAIN)

    def _stored(self, number: int) -> tuple[object, object]:
        if not 0 <= number < self.rows:
            raise LoomError(f"row {number}", allowed=f"rows 0 to {self.rows - 1}")
        with _as_loom_error(self.path):
            found = next(self._database.select("SELECT time, data FROM row WHERE number = ?", int(number)), None)
        if found is None:
            raise self.damaged(f"row {number} is missing")
        return found[0], found[1]

    def close(self) -> None:
        """Close the file; rows that were read stay usable."""
        self._database.close()

    def __enter__(self) -> "ProgrammeFile":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def _blobs(programme: Programme, progress: Progress) -> Iterator[tuple[int, float, bytes]]:
    times = programme.row_times.tolist()
    for number in range(programme.rows):
        colours, keys = programme.knots[programme.rows - 1 - number], programme.keys[number]
        yield number, times[number], zlib.compress(colours.tobytes() + keys.tobytes(), _LEVEL)
        if number % 64 == 63:
            progress((number + 1) / programme.rows)
    progress(1.0)


def _check_header(path: Path) -> None:
    """Raise LoomError unless the file exists, is a programme of a known version, and is complete."""
    header = SqliteHeader(path)
    if header.application != APPLICATION:
        raise LoomError(
            f"{path} is no loom programme",
            allowed="a file that `ilmek weave` wrote: programme.ilmek",
            do="give that file" if header.length else "the file is empty; write it again",
        )
    if header.version > VERSION:
        newer = f"{path} has format {header.version}"
        raise LoomError(newer, allowed=f"this ilmek reads up to format {VERSION}", do="use a newer ilmek")
    if header.version < VERSION:
        older = f"{path} has format {header.version}"
        raise LoomError(older, allowed=f"this ilmek reads format {VERSION}", do=_AGAIN)
    if header.length > LARGEST_FILE:
        raise LoomError(f"{path} has {header.length} bytes", allowed=f"at most {LARGEST_FILE // 1_000_000} MB")
    if header.length < header.expected_length:
        expected = f"{header.expected_length} bytes; it has {header.length}"
        raise LoomError(f"{path} is truncated", allowed=expected, do=_AGAIN)
    if not header.plain or not header.expected_length:
        raise LoomError(f"{path} is damaged (its header)", allowed="a whole programme", do=_AGAIN)


def _text(stored: object) -> str:
    """A text as stored; a damaged file may have any other value instead."""
    try:
        return stored.decode() if isinstance(stored, bytes) else ""
    except UnicodeDecodeError as error:
        raise DamagedDatabase("a text is not UTF-8") from error


def _check_rows(file: ProgrammeFile, progress: Progress) -> None:
    """Raise LoomError unless the file has exactly its rows, each can be replayed, and the totals are theirs."""
    times = np.empty(file.rows)
    counts = np.zeros(len(file.label.yarns), np.int64)
    passes = np.zeros(len(file.edges) - 1, np.int64)
    block: list[bytes] = []
    size = max(1, _BLOCK // (file.columns + 3 * len(passes)))
    number = -1
    for number, (stored, time, data) in enumerate(file.stored_rows()):
        if number == file.rows or stored != number:
            raise file.damaged(f"row {number} is missing" if number < file.rows else "it has more rows than the carpet")
        if not isinstance(time, float):
            raise file.damaged(f"row {number} is damaged")
        times[number] = time
        block.append(file.unpacked(number, data))
        if len(block) == size or number + 1 == file.rows:
            _check_block(file, number + 1 - len(block), block, counts, passes)
            block.clear()
            progress((number + 1) / file.rows)
    if number + 1 < file.rows:
        raise file.damaged(f"row {number + 1} is missing")
    _check_times(file, times)
    by_head = passes.reshape(file.heads, halves(file.heads)).sum(axis=1)
    if file.totals.counts != tuple(counts.tolist()) or np.any(file.work.passes != by_head):
        raise file.damaged("the knots of its yarns, or the passes of its heads, are not those of its rows")


def _check_block(file: ProgrammeFile, first: int, block: list[bytes], counts: IntArray, passes: IntArray) -> None:
    """Check successive rows, and add their knots by yarn and their parts in passes."""
    plain: UInt8[np.ndarray, "rows bytes"] = np.frombuffer(b"".join(block), np.uint8).reshape(len(block), -1)
    colours, keys = plain[:, : file.columns], plain[:, file.columns :].reshape(len(block), -1, 3)
    invalid = invalid_rows(first, colours, keys, file.edges, len(counts))
    if invalid.any():
        raise file.damaged(f"row {first + int(invalid.argmax())} is damaged")
    counts += np.bincount(colours.ravel(), minlength=len(counts))
    passes += np.count_nonzero(keys[:, :, 0] == PASSES, axis=0)


def _check_times(file: ProgrammeFile, times: FloatArray) -> None:
    """Raise LoomError unless each row takes at least the time of its knots and wefts, and their sum is the duration."""
    least = least_time(1, file.columns, file.heads, file.times) * (1 - _ROUNDING)
    invalid = ~((times >= least) & (times <= file.totals.duration * (1 + _ROUNDING)))
    if invalid.any():
        raise file.damaged(f"row {int(invalid.argmax())} has an impossible time")
    woven = times.sum() + stop_time(file.bobbins, file.rows)
    if abs(woven - file.totals.duration) > _ROUNDING * file.totals.duration:
        raise file.damaged("the weaving time is not the sum of its rows and stops")


@contextlib.contextmanager
def _as_loom_error(path: Path) -> Iterator[None]:
    """Errors of the description, the database and a row as an error of the file."""
    try:
        yield
    except (DamagedDatabase, IlmekError) as error:
        if isinstance(error, LoomError) and error.do == _AGAIN:
            raise
        raise LoomError(f"{path} is damaged ({error})", allowed="a whole programme", do=_AGAIN) from error
