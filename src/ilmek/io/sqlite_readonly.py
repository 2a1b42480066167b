"""SQLite files of others, opened so that nothing in them is executed, followed or believed.

The file is opened read-only and immutable, so that no journal beside it is replayed. Its schema is untrusted and must
be the given one, statement by statement: a view, a trigger, an index or a virtual table is refused before any query.
An authorizer allows nothing but reading the columns of the given tables, and each statement has a limit of steps.
"""

import sqlite3
from collections.abc import Iterator, Mapping
from pathlib import Path

from ilmek.errors import LoomError, shortened
from ilmek.io.regular_file import open_regular

LARGEST_VALUE = 2_000_000
"""Largest text, blob or row of a table [bytes]: more than a row of the widest carpet in the finest quality."""

MOST_STEPS = 20_000_000
"""Largest number of instructions of SQLite's virtual machine for one query: ten times those for all rows of the largest
carpet, 8 a row."""

_SLICE = 10_000
"""Instructions after which SQLite asks whether to continue."""

_HEADER = 100
_MAGIC = b"SQLite format 3\0"
_PAGE_SIZES = {512, 1024, 2048, 4096, 8192, 16384, 32768, 65536}
_LIMITS = {
    "LENGTH": LARGEST_VALUE,
    "SQL_LENGTH": 1000,
    "COLUMN": 8,
    "EXPR_DEPTH": 8,
    "COMPOUND_SELECT": 1,
    "VDBE_OP": 1000,
    "FUNCTION_ARG": 1,
    "ATTACHED": 0,
    "LIKE_PATTERN_LENGTH": 1,
    "VARIABLE_NUMBER": 1,
    "TRIGGER_DEPTH": 1,
    "WORKER_THREADS": 0,
}
_SETTINGS = {
    "DEFENSIVE": True,
    "TRUSTED_SCHEMA": False,
    "ENABLE_TRIGGER": False,
    "ENABLE_VIEW": False,
    "WRITABLE_SCHEMA": False,
}
_PRAGMAS = ("trusted_schema=OFF", "query_only=ON", "cell_size_check=ON", "mmap_size=0")


class DamagedDatabase(Exception):
    """A file that is no sound database of the expected tables."""


class SqliteHeader:
    """The header of an SQLite file, and the file's size [bytes].

    Raises LoomError, naming the file, for a file that cannot be read or is no regular file. A pipe, a device or a
    folder is not opened.
    """

    def __init__(self, path: Path) -> None:
        try:
            file, self.length = open_regular(path)
            with file:
                self._data = file.read(_HEADER)
        except OSError as error:
            raise LoomError(
                f"{path} cannot be read: {error.strerror}", do="give a programme written by ilmek"
            ) from error

    @property
    def application(self) -> int:
        """Application id; 0 for a file that is no SQLite database."""
        whole = len(self._data) == _HEADER and self._data.startswith(_MAGIC)
        return self._number(68, 4) if whole else 0

    @property
    def version(self) -> int:
        """Version of the application's format."""
        return self._number(60, 4)

    @property
    def expected_length(self) -> int:
        """Size of a complete file [bytes]; 0 for a page size that is not allowed."""
        page = {1: 65536}.get(self._number(16, 2), self._number(16, 2))
        return page * self._number(28, 4) if page in _PAGE_SIZES else 0

    @property
    def plain(self) -> bool:
        """Whether the file is in UTF-8 and without a write-ahead log."""
        return self._number(56, 4) == 1 and self._data[18:20] == b"\1\1"

    def _number(self, at: int, width: int) -> int:
        return int.from_bytes(self._data[at : at + width], "big")


class ReadOnlyDatabase:
    """An open SQLite file with exactly the given tables; `close` it.

    tables  the statement that created each table, by name
    Every method raises DamagedDatabase for a file with another schema, a damaged file, and a query beyond MOST_STEPS.
    Texts are read as bytes. It may be used in another thread than that which opened it, by one at a time.
    """

    __slots__ = ("_connection", "_slices")

    def __init__(self, path: Path, tables: Mapping[str, str]) -> None:
        self._slices = 0
        try:
            address = f"{path.resolve().as_uri()}?mode=ro&immutable=1"
            self._connection = sqlite3.connect(address, uri=True, check_same_thread=False)
        except (sqlite3.Error, OSError, RuntimeError) as error:
            raise DamagedDatabase(_reason(error)) from error
        try:
            self._restrict(tables)
            found = sorted(self.select("SELECT type, name, tbl_name, sql FROM sqlite_master LIMIT 8"))
            if found != sorted((b"table", name.encode(), name.encode(), sql.encode()) for name, sql in tables.items()):
                raise DamagedDatabase(f"other tables than {' and '.join(tables)}")
        except BaseException:
            self.close()
            raise

    def select(self, query: str, *parameters: int) -> Iterator[tuple[object, ...]]:
        """The rows of a query, one by one."""
        self._slices = 0
        try:
            for row in self._connection.execute(query, parameters):  # noqa: UP028 - `yield from` would close the cursor
                yield row
        except (sqlite3.Error, UnicodeDecodeError) as error:  # the latter: a message with a name of the file
            raise DamagedDatabase(_reason(error)) from error

    def close(self) -> None:
        """Close the file."""
        self._connection.close()

    def _restrict(self, tables: Mapping[str, str]) -> None:
        connection = self._connection
        connection.text_factory = bytes
        for name, limit in _LIMITS.items():
            connection.setlimit(getattr(sqlite3, f"SQLITE_LIMIT_{name}"), limit)
        for name, setting in _SETTINGS.items():
            option = getattr(sqlite3, f"SQLITE_DBCONFIG_{name}", None)  # Python 3.12
            if option is not None:
                getattr(connection, "setconfig")(option, setting)  # noqa: B009 - unknown to the types of Python 3.11
        try:
            for pragma in _PRAGMAS:
                connection.execute(f"PRAGMA {pragma}").fetchall()
        except (sqlite3.Error, UnicodeDecodeError) as error:
            raise DamagedDatabase(_reason(error)) from error
        readable = {"sqlite_master", *tables}

        def allowed(action: int, table: str | None, column: str | None, database: str | None, view: str | None) -> int:  # noqa: ARG001
            reads = action == sqlite3.SQLITE_READ and table in readable and view is None
            return sqlite3.SQLITE_OK if reads or action == sqlite3.SQLITE_SELECT else sqlite3.SQLITE_DENY

        connection.set_authorizer(allowed)
        connection.set_progress_handler(self._beyond_limit, _SLICE)

    def _beyond_limit(self) -> bool:
        self._slices += 1
        return self._slices * _SLICE > MOST_STEPS


def _reason(error: Exception) -> str:
    """What SQLite reports, in one short line without characters that a terminal would interpret."""
    if isinstance(error, UnicodeDecodeError):
        return "its schema is no text"
    text = str(error)
    return shortened(text if text.isprintable() else ascii(text), 100)
