"""The loom's programme as one file, `.ilmek`: an SQLite database with a compressed blob for each row.

    meta   key, value    carpet, loom, totals, and both cyclograms with their laws by name; as JSON
    row    number, time, data    loom row (0 at the carpet's bottom edge), its time [s], and zlib of
                                 colours (a byte per knot, by column) + keys (three bytes per part, see `loom.schedule`)

The file is written under a temporary name and renamed at the end, so that it is complete or does not exist.
"""

import contextlib
import json
import os
import secrets
import sqlite3
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np

from ilmek.arrays import IntArray
from ilmek.cams.laws import law_of
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.errors import IlmekError, LoomError, OutputError
from ilmek.loom.programme import HeadWork, Programme, Times
from ilmek.loom.row import KnotRow
from ilmek.progress import SILENT, Progress
from ilmek.timing.cyclogram import Cyclogram, Track, TrackEvent, TrackSegment

APPLICATION, VERSION = 0x696C6D6B, 1
"""Application id (the letters `ilmk`) and version of the format, in the file's header."""

_LEVEL = 6
_PAGE = 8192
_AGAIN = "write the programme again with `ilmek weave`"
_CREATE = """
CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE row (number INTEGER PRIMARY KEY, time REAL NOT NULL, data BLOB NOT NULL);
"""


@dataclass(frozen=True, slots=True)
class Label:
    """Description of a programme: the carpet, its yarns in the order of the chart, the loom's warp pitch [m], and the
    cyclograms of a knot and of a row.
    """

    size: CarpetSize
    quality: Quality
    knot: str
    yarns: tuple[Yarn, ...]
    warp_pitch: float
    cyclograms: tuple[Cyclogram, ...] = ()


@dataclass(frozen=True, slots=True)
class Totals:
    """Totals of the carpet.

    duration  weaving time [s]
    travel    pitches moved by all heads
    counts    knots of each yarn
    """

    duration: float
    knots: int
    changes: int
    travel: int
    counts: tuple[int, ...]

    @property
    def changes_per_knot(self) -> float:
        """Colour changes per knot."""
        return self.changes / self.knots


def write_programme(path: Path, programme: Programme, label: Label, *, progress: Progress = SILENT) -> None:
    """Write a programme; on an error no file is left.

    Raises OutputError if the file cannot be written, LoomError if the label's yarns are not the programme's.
    """
    if len(label.yarns) != programme.yarns:
        raise LoomError(f"{len(label.yarns)} yarns for a programme of {programme.yarns}")
    work = path.parent / f".{path.name}.{secrets.token_hex(4)}.part"
    try:
        _fill(work, programme, label, progress)
        work.replace(path)
    except (OSError, sqlite3.Error) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise OutputError(f"{path} cannot be written: {reason}", do="nothing was written") from error
    finally:
        work.unlink(missing_ok=True)


def open_programme(path: Path) -> "ProgrammeFile":
    """Open a programme for reading; close it, or use it as a context manager.

    Raises LoomError if the file is missing, no programme, of a newer format, truncated or damaged.
    """
    _check_header(path)
    connection = sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro&immutable=1", uri=True)
    try:
        with _as_loom_error(path):
            meta = {key: json.loads(value) for key, value in connection.execute("SELECT key, value FROM meta")}
            return ProgrammeFile(path, connection, meta)
    except BaseException:
        connection.close()
        raise


class ProgrammeFile:
    """An open programme: its label, its totals, and its rows one by one.

    label, times, heads, edges, rows, columns    as in `Label` and `loom.programme.Programme`
    totals, work                                 totals of the carpet, and the work of each head
    """

    __slots__ = (
        "_connection",
        "_keys",
        "columns",
        "edges",
        "heads",
        "label",
        "path",
        "rows",
        "times",
        "totals",
        "work",
    )

    def __init__(self, path: Path, connection: sqlite3.Connection, meta: Mapping[str, Any]) -> None:
        self.path, self._connection = path, connection
        self.label = _label_from(meta)
        self.rows, self.columns, self.heads = int(meta["rows"]), int(meta["columns"]), int(meta["heads"])
        self.times = Times(**meta["times"])
        self.edges: IntArray = np.array(meta["edges"], np.int64)
        self._keys = (len(self.edges) - 1, 3)
        self.totals = Totals(**{**meta["totals"], "counts": tuple(meta["totals"]["counts"])})
        self.work = HeadWork(**{name: np.array(values) for name, values in meta["work"].items()})

    def row(self, number: int) -> KnotRow:
        """Loom row `number`, 0 at the carpet's bottom edge. Raises LoomError beyond the carpet or if it is damaged."""
        data = self._fetch("data", number)
        try:
            raw = zlib.decompress(data)
        except (zlib.error, TypeError):
            raw = b""
        if len(raw) != self.columns + self._keys[0] * self._keys[1]:
            raise LoomError(f"{self.path}: row {number} is damaged", do=_AGAIN)
        plain = np.frombuffer(raw, np.uint8)
        return KnotRow(number, plain[: self.columns], plain[self.columns :].reshape(self._keys), self.edges, self.heads)

    def row_time(self, number: int) -> float:
        """Time of a loom row with its wefts [s]. Raises LoomError as `row`."""
        return float(self._fetch("time", number))

    def _fetch(self, column: str, number: int) -> Any:
        if not 0 <= number < self.rows:
            raise LoomError(f"row {number}", allowed=f"rows 0 to {self.rows - 1}")
        try:
            found = self._connection.execute(f"SELECT {column} FROM row WHERE number = ?", (number,)).fetchone()
        except sqlite3.Error as error:
            raise LoomError(f"{self.path}: row {number} is damaged ({error})", do=_AGAIN) from error
        if found is None:
            raise LoomError(f"{self.path}: row {number} is missing", do=_AGAIN)
        return found[0]

    def close(self) -> None:
        """Close the file; rows that were read stay usable."""
        self._connection.close()

    def __enter__(self) -> "ProgrammeFile":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def _fill(work: Path, programme: Programme, label: Label, progress: Progress) -> None:
    with contextlib.closing(sqlite3.connect(work, isolation_level=None)) as connection:
        # Nobody reads the file before the rename: no journal is needed.
        for pragma in (f"page_size={_PAGE}", "journal_mode=OFF", "synchronous=OFF", f"application_id={APPLICATION}"):
            connection.execute(f"PRAGMA {pragma}").fetchall()
        connection.execute(f"PRAGMA user_version={VERSION}")
        connection.execute("BEGIN")
        for statement in _CREATE.strip().split("\n"):
            connection.execute(statement)
        meta = ((key, json.dumps(value, allow_nan=False)) for key, value in _meta(programme, label).items())
        connection.executemany("INSERT INTO meta VALUES (?, ?)", meta)
        connection.executemany("INSERT INTO row VALUES (?, ?, ?)", _blobs(programme, progress))
        connection.execute("COMMIT")
    with work.open("rb") as written:
        os.fsync(written.fileno())


def _blobs(programme: Programme, progress: Progress) -> Iterator[tuple[int, float, bytes]]:
    times = programme.row_times.tolist()
    for number in range(programme.rows):
        row = programme.row(number)
        yield number, times[number], zlib.compress(row.colours.tobytes() + row.keys.tobytes(), _LEVEL)
        if number % 64 == 63:
            progress((number + 1) / programme.rows)
    progress(1.0)


def _meta(programme: Programme, label: Label) -> dict[str, Any]:
    counts = np.zeros(programme.yarns, np.int64)
    for first in range(0, programme.rows, 256):
        counts += np.bincount(programme.knots[first : first + 256].ravel(), minlength=programme.yarns)
    work = {one.name: getattr(programme.work, one.name).tolist() for one in fields(HeadWork)}
    return {
        "size": asdict(label.size),
        "quality": asdict(label.quality),
        "knot": label.knot,
        "yarns": [asdict(yarn) for yarn in label.yarns],
        "warp_pitch": label.warp_pitch,
        "rows": programme.rows,
        "columns": programme.columns,
        "heads": programme.heads,
        "edges": programme.edges.tolist(),
        "times": asdict(programme.times),
        "totals": {
            "duration": programme.duration,
            "knots": int(counts.sum()),
            "changes": int(programme.work.changes.sum()),
            "travel": int(programme.work.travel.sum()),
            "counts": counts.tolist(),
        },
        "work": work,
        "cyclograms": [_cyclogram_record(cyclogram) for cyclogram in label.cyclograms],
    }


def _label_from(meta: Mapping[str, Any]) -> Label:
    yarns = tuple(
        Yarn(**{**record, "srgb": tuple(record["srgb"]), "lab": tuple(record["lab"])}) for record in meta["yarns"]
    )
    cyclograms = tuple(_cyclogram_from(record) for record in meta["cyclograms"])
    pitch = float(meta["warp_pitch"])
    return Label(CarpetSize(**meta["size"]), Quality(**meta["quality"]), meta["knot"], yarns, pitch, cyclograms)


def _cyclogram_record(cyclogram: Cyclogram) -> dict[str, Any]:
    """A cyclogram as plain data; a law by its name and parameters."""
    return {
        "name": cyclogram.name,
        "period": cyclogram.period,
        "tracks": [
            {
                "name": track.name,
                "actuator": track.actuator,
                "unit": track.unit,
                "revolves": track.revolves,
                "segments": [
                    {
                        **{key: getattr(part, key) for key in _SEGMENT},
                        "law": part.law.name,
                        "parameters": dict(part.law.parameters),
                    }
                    for part in track.segments
                ],
                "events": [asdict(event) for event in track.events],
            }
            for track in cyclogram.tracks
        ],
    }


_SEGMENT = ("name", "start", "end", "begin", "finish")


def _cyclogram_from(record: Mapping[str, Any]) -> Cyclogram:
    tracks = tuple(
        Track(
            track["name"],
            track["actuator"],
            tuple(_segment_from(part) for part in track["segments"]),
            tuple(TrackEvent(**event) for event in track["events"]),
            track["unit"],
            track["revolves"],
        )
        for track in record["tracks"]
    )
    return Cyclogram(record["name"], record["period"], tracks)


def _segment_from(part: Mapping[str, Any]) -> TrackSegment:
    law = law_of(part["law"], part["parameters"])
    return TrackSegment(**{key: part[key] for key in _SEGMENT}, law=law)


def _check_header(path: Path) -> None:
    """Raise LoomError unless the file exists, is a programme of a known version, and is complete."""
    try:
        if path.is_fifo():  # opening it would block
            raise LoomError(f"{path} cannot be read: Is a pipe", allowed="a programme written by ilmek")
        with path.open("rb") as file:
            header = file.read(100)
            length = os.fstat(file.fileno()).st_size
    except OSError as error:
        raise LoomError(f"{path} cannot be read: {error.strerror}", allowed="a programme written by ilmek") from error
    if not header.startswith(b"SQLite format 3\0") or len(header) < 100 or _number(header, 68, 4) != APPLICATION:
        raise LoomError(
            f"{path} is no loom programme",
            allowed="a file that `ilmek weave` wrote: programme.ilmek",
            do="give that file" if length else "the file is empty; write it again",
        )
    if _number(header, 60, 4) > VERSION:
        newer = f"{path} has format {_number(header, 60, 4)}"
        raise LoomError(newer, allowed=f"this ilmek reads up to format {VERSION}", do="use a newer ilmek")
    page = _number(header, 16, 2)
    expected = (65536 if page == 1 else page) * _number(header, 28, 4)
    if length < expected:
        raise LoomError(f"{path} is truncated", allowed=f"{expected} bytes; it has {length}", do=_AGAIN)


def _number(header: bytes, at: int, width: int) -> int:
    return int.from_bytes(header[at : at + width], "big")


@contextlib.contextmanager
def _as_loom_error(path: Path) -> Iterator[None]:
    try:
        yield
    except (sqlite3.Error, KeyError, TypeError, ValueError, AttributeError, IlmekError) as error:
        reason = str(error) or type(error).__name__
        raise LoomError(f"{path} is damaged ({reason})", allowed="a whole programme", do=_AGAIN) from error
