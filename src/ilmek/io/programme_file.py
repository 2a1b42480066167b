"""The loom's programme as one file, `.ilmek`: an SQLite database with a compressed blob for each row.

    meta    key, value                loom, carpet, yarns, times, cyclograms, digest; as JSON (`io.programme_meta`)
    chart   number, data              loom row (0 at the carpet's bottom edge), zlib of a byte per knot: its yarn
    row     number, phases, ends, data    its explicit operations (`io.programme_rows`)
    change  row, phase, number, weft, head, tube, yarn, length    changes of packages in the stops

A file that can be opened is whole and well-formed, and has its digest; whether its operations weave the chart is proved
elsewhere. It is written into the staging folder of an output (`ilmek.io.output`), which makes it complete or nothing.
"""

import contextlib
import sqlite3
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ilmek.arrays import FloatArray, UInt8
from ilmek.errors import IlmekError, LoomError
from ilmek.io.closable import Closable
from ilmek.io.programme_meta import meta_texts, read_meta
from ilmek.io.programme_rows import change_records, packed, packed_row, read_stops, unpacked, unpacked_row
from ilmek.io.sqlite_readonly import DamagedDatabase, ReadOnlyDatabase, SqliteHeader
from ilmek.loom.account import HeadWork, ProgrammeAccount, stop_duration
from ilmek.loom.explicit import programme_digest
from ilmek.loom.operations import EMPTY, LoomProgramme, LoomSetup, RowOperations, Stop
from ilmek.progress import SILENT, Progress

APPLICATION, VERSION = 0x696C6D6B, 3
"""Application id (the letters `ilmk`) and version of the format, in the file's header."""

_PAGE = 8192
_AGAIN = "write the programme again with `ilmek weave`"
TABLES = {
    "meta": "CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID",
    "chart": "CREATE TABLE chart (number INTEGER PRIMARY KEY, data BLOB NOT NULL)",
    "row": "CREATE TABLE row (number INTEGER PRIMARY KEY, phases INTEGER NOT NULL, ends BLOB NOT NULL, "
    "data BLOB NOT NULL)",
    "change": "CREATE TABLE change (row INTEGER, phase INTEGER, number INTEGER, weft INTEGER, head INTEGER, "
    "tube INTEGER, yarn INTEGER, length REAL, PRIMARY KEY (row, phase, number)) WITHOUT ROWID",
}
"""The tables of the file; a file with others is refused."""

LARGEST_FILE = 1_000_000_000
"""Largest size of a file [bytes]: MOST_KNOTS knots take up to 800 MB where they cannot be compressed."""

MOST_CHANGES = 1_000_000
"""Largest number of packages that are changed: years of an operator."""

_CHANGES = "SELECT phase, weft, head, tube, yarn, length FROM change WHERE row = ? ORDER BY phase, number"


@dataclass(frozen=True, slots=True)
class Totals:
    """Totals of the carpet, from the operations and the chart.

    duration  weaving time with its stops [s]      changes  of the tube      travel  pitches moved by all heads
    counts    knots of each yarn in the chart
    """

    duration: float
    knots: int
    changes: int
    travel: int
    counts: tuple[int, ...]

    @property
    def changes_per_knot(self) -> float:
        """Colour changes per knot."""
        return self.changes / max(self.knots, 1)


def write_programme(path: Path, programme: LoomProgramme, *, progress: Progress = SILENT) -> None:
    """Write a programme to a new file.

    Raises OSError or sqlite3.Error if it cannot be written, and the error of a setup that could not be read again.
    """
    setup = programme.setup
    texts = meta_texts(setup, "0" * 64)
    with contextlib.closing(sqlite3.connect(path, isolation_level=None)) as connection:
        # Nobody reads the file before the rename: no journal is needed.
        for pragma in (f"page_size={_PAGE}", "journal_mode=OFF", "synchronous=OFF", f"application_id={APPLICATION}"):
            connection.execute(f"PRAGMA {pragma}").fetchall()
        connection.execute(f"PRAGMA user_version={VERSION}")
        connection.execute("BEGIN")
        for statement in TABLES.values():
            connection.execute(statement)
        writer = _Writer(connection, programme)
        texts["digest"] = f'"{programme_digest(writer, progress)}"'
        connection.executemany("INSERT INTO meta VALUES (?, ?)", texts.items())
        connection.execute("COMMIT")


class _Writer:
    """Writes each row of a programme when its digest is computed, so that a row is made once."""

    def __init__(self, connection: sqlite3.Connection, programme: LoomProgramme) -> None:
        self._connection, self._programme, self.setup = connection, programme, programme.setup
        self.digest = ""

    def operations(self, number: int) -> RowOperations:
        """The operations of a row, written."""
        row = self._programme.operations(number)
        stored = (number, row.phases, bytes(map(int, row.ends)), packed_row(row))
        self._connection.execute("INSERT INTO row VALUES (?, ?, ?, ?)", stored)
        self._connection.executemany("INSERT INTO change VALUES (?, ?, ?, ?, ?, ?, ?, ?)", change_records(row.stops))
        return row

    def chart_row(self, number: int) -> UInt8[np.ndarray, " columns"]:
        """A row of the chart, written."""
        line = self._programme.chart_row(number)
        self._connection.execute("INSERT INTO chart VALUES (?, ?)", (number, packed(line.tobytes())))
        return line


def open_programme(path: Path, *, lenient: bool = False, progress: Progress = SILENT) -> "ProgrammeFile":
    """Open a programme for reading; close it, or use it as a context manager.

    The file may come from anybody: it is checked whole, every row included, before this returns.
    lenient  open a file whose rows have another digest than it states too: `ProgrammeFile.stated_digest`
    Raises LoomError if the file is missing, no programme, of another format, too large, truncated or damaged, and where
    its rows have another digest.
    """
    _check_header(path)
    with _as_loom_error(path):
        database = ReadOnlyDatabase(path, TABLES)
    try:
        with _as_loom_error(path):
            stored = database.select("SELECT key, value FROM meta LIMIT 99")
            setup, digest = read_meta({_text(key): _text(value) for key, value in stored})
            file = ProgrammeFile(path, database, setup, digest, progress)
            if not lenient and file.digest != digest:
                raise LoomError(f"{path}: its digest is not that of its rows", allowed="a whole programme", do=_AGAIN)
            return file
    except BaseException:
        database.close()
        raise


class ProgrammeFile(Closable):
    """An open programme, `loom.operations.LoomProgramme`, with its totals and the work of each head.

    digest     of its rows                                  stated_digest  as the file states it
    row_times  of each loom row with its end, without stops [s]     stopped  the rows with stops before their phases
    """

    def __init__(
        self, path: Path, database: ReadOnlyDatabase, setup: LoomSetup, digest: str, progress: Progress
    ) -> None:
        self.path, self.setup, self.stated_digest, self._database = path, setup, digest, database
        self.stopped = self._stopped()
        reading = _Reading(self)
        self.digest = programme_digest(reading, progress)
        self.row_times: FloatArray = np.array(reading.times)
        self.work: HeadWork = reading.account.work
        work, stops = self.work, reading.stop_time
        self.totals = Totals(
            float(self.row_times.sum()) + stops,
            int(work.knots.sum()),
            int(work.changes.sum()),
            int(work.travel.sum()),
            tuple(reading.counts.tolist()),
        )

    def operations(self, number: int) -> RowOperations:
        """The operations of a loom row. Raises LoomError beyond the carpet, or if it is damaged."""
        self.setup.require_row(number)
        with _as_loom_error(self.path):
            changes = self._database.select(_CHANGES, int(number)) if number in self.stopped else iter(())
            stops = read_stops(self.setup, number, changes)
            stored = next(
                self._database.select("SELECT phases, ends, data FROM row WHERE number = ?", int(number)), None
            )
        if stored is None:
            raise self._damaged(f"row {number} is missing")
        phases, ends, data = stored
        row = unpacked_row(self.setup, number, (phases, ends, data), stops)
        if row is None:
            raise self._damaged(f"row {number} is damaged")
        return row

    def chart_row(self, number: int) -> UInt8[np.ndarray, " columns"]:
        """Yarn of each knot of a loom row. Raises LoomError as `operations`."""
        self.setup.require_row(number)
        with _as_loom_error(self.path):
            stored = next(self._database.select("SELECT data FROM chart WHERE number = ?", int(number)), None)
        if stored is None:
            raise self._damaged(f"row {number} of the chart is missing")
        raw = unpacked(stored[0], self.setup.columns)
        line: UInt8[np.ndarray, " columns"] = np.frombuffer(raw or b"", np.uint8)
        if len(line) != self.setup.columns or line.max(initial=0, where=line != EMPTY) >= len(self.setup.yarns):
            raise self._damaged(f"row {number} of the chart is damaged")
        return line

    def stops(self) -> Iterator[Stop]:
        """All stops, in order."""
        for number in self.stopped:
            yield from self.operations(number).stops

    def close(self) -> None:
        """Close the file; rows that were read stay usable."""
        self._database.close()

    def _stopped(self) -> dict[int, None]:
        """The rows with stops, in order. Raises LoomError for rows, and changes of packages, beyond the carpet."""
        rows = self.setup.rows
        for table, key in (("row", "number"), ("chart", "number"), ("change", "row")):
            query = f"SELECT {key} FROM {table} WHERE {key} < 0 OR {key} >= ? LIMIT 1"
            if next(self._database.select(query, rows), None) is not None:
                raise self._damaged("it has more rows than the carpet")
        found: dict[int, None] = {}
        for count, (row,) in enumerate(self._database.select("SELECT row FROM change ORDER BY row")):
            if count == MOST_CHANGES or type(row) is not int:
                raise self._damaged("it has too many changes of packages, or one before no row")
            found[row] = None
        return found

    def _damaged(self, reason: str) -> LoomError:
        return LoomError(f"{self.path}: {reason}", allowed="a whole programme", do=_AGAIN)


class _Reading:
    """Sums up each row of a file when its digest is computed, so that a row is read once."""

    def __init__(self, file: ProgrammeFile) -> None:
        self._file, self.setup, self.digest = file, file.setup, file.stated_digest
        self.account = ProgrammeAccount(file.setup.heads, file.setup.times)
        self.times: list[float] = []
        self.stop_time = 0.0
        self.counts = np.zeros(len(file.setup.yarns), np.int64)

    def operations(self, number: int) -> RowOperations:
        """The operations of a row, summed up."""
        row, setup = self._file.operations(number), self.setup
        self.times.append(self.account.add(row))
        self.stop_time += sum(stop_duration(stop, setup.wefts, setup.times.tube_change) for stop in row.stops)
        return row

    def chart_row(self, number: int) -> UInt8[np.ndarray, " columns"]:
        """A row of the chart, counted."""
        line = self._file.chart_row(number)
        self.counts += np.bincount(line[line != EMPTY], minlength=len(self.counts))
        return line


def _check_header(path: Path) -> None:
    """Raise LoomError unless the file exists, is a programme of a known version, and is complete."""
    header = SqliteHeader(path)
    if header.application != APPLICATION:
        given = f"{path} is no loom programme"
        do = "give that file" if header.length else "the file is empty; write it again"
        raise LoomError(given, allowed="a file that `ilmek weave` wrote: programme.ilmek", do=do)
    if header.version > VERSION:
        newer = f"{path} has format {header.version}"
        raise LoomError(newer, allowed=f"this ilmek reads up to format {VERSION}", do="use a newer ilmek")
    if header.version < VERSION:
        older = f"{path} has format {header.version}"
        raise LoomError(older, allowed=f"this ilmek reads format {VERSION}", do=_AGAIN)
    if header.length > LARGEST_FILE:
        raise LoomError(f"{path} has {header.length} bytes", allowed=f"at most {LARGEST_FILE // 1_000_000} MB")
    if header.length < header.expected_length:
        short = f"{path} is truncated: {header.length} of {header.expected_length} bytes"
        raise LoomError(short, allowed="a whole programme", do=_AGAIN)
    if not header.plain or not header.expected_length:
        raise LoomError(f"{path} is damaged (its header)", allowed="a whole programme", do=_AGAIN)


def _text(stored: object) -> str:
    """A text as stored; a damaged file may have any other value instead."""
    try:
        return stored.decode() if isinstance(stored, bytes) else ""
    except UnicodeDecodeError as error:
        raise DamagedDatabase("a text is not UTF-8") from error


@contextlib.contextmanager
def _as_loom_error(path: Path) -> Iterator[None]:
    """Errors of the description, the database and a row as an error of the file."""
    try:
        yield
    except (DamagedDatabase, IlmekError) as error:
        if isinstance(error, LoomError) and error.do == _AGAIN:
            raise
        raise LoomError(f"{path} is damaged ({error})", allowed="a whole programme", do=_AGAIN) from error
