"""The results file of a study: one SQLite file, a row a design, in the order of the designs.

    study   key, value      what was studied, as JSON: target, variables, results, limits, method, seed
    checks  id, name        the checks that occurred
    design  id, status, reason, a column for each variable and each result [SI], failed, worst, margins

`margins` are little-endian 32-bit floats in the order of `checks`, NaN for a check that the design does not have;
`status` is NULL for a design that was made. Rows are committed in blocks that depend on nothing but their numbers, so
that a study that was killed and goes on has the same file, bit for bit, as one that was not.
"""

import json
import sqlite3
from collections.abc import Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.errors import OutputError, ParameterError
from ilmek.studies.outcome import DONE, Outcome

COMMIT = 256
"""Rows of a transaction."""

FORMAT = 1
"""Version of the format."""


class StudyFile:
    """A results file that is open, for one writer. Use it in a `with` block.

    plan     what is studied, as plain data; of a file that exists it must be the same
    columns  names of variables, then of results
    """

    def __init__(
        self, path: Path, plan: Mapping[str, object], variables: Sequence[str], results: Sequence[str]
    ) -> None:
        self.path, self.variables = path, tuple(variables)
        self.results = tuple(f"{name} (result)" if name in variables else name for name in results)
        self._plan = {"format": FORMAT, **plan}
        self._checks: dict[str, int] = {}
        with self._clear():
            self._base = sqlite3.connect(path, isolation_level=None, timeout=1.0)
            self._prepare()

    def _prepare(self) -> None:
        base = self._base
        base.execute("PRAGMA locking_mode = EXCLUSIVE")
        if base.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]:
            self._compare()
            return
        base.execute("BEGIN IMMEDIATE")
        columns = ", ".join(f"{_quoted(name)} REAL" for name in (*self.variables, *self.results))
        base.execute("CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID")
        base.execute("CREATE TABLE checks (id INTEGER PRIMARY KEY, name TEXT NOT NULL)")
        base.execute(
            "CREATE TABLE design (id INTEGER PRIMARY KEY, status TEXT, reason TEXT, "
            f"{columns}, failed INTEGER, worst REAL, margins BLOB)"
        )
        base.executemany("INSERT INTO study VALUES (?, ?)", [(k, json.dumps(v)) for k, v in self._plan.items()])
        base.execute("COMMIT")

    def _compare(self) -> None:
        """Raise ParameterError unless the file is of the same study."""
        tables = {name for (name,) in self._base.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
        if not {"study", "checks", "design"} <= tables:
            raise ParameterError(f"{self.path} is no results file of a study", do="give another file")
        known = {key: json.loads(value) for key, value in self._base.execute("SELECT key, value FROM study")}
        for key in (*self._plan, *known):
            if known.get(key) != json.loads(json.dumps(self._plan.get(key))):
                raise ParameterError(
                    f"{self.path} is of another study: its {key} is {_brief(known.get(key))}",
                    allowed=f"that of this study is {_brief(self._plan.get(key))}",
                    do="give another file, or --force to begin anew",
                )
        self._checks = {name: number for number, name in self._base.execute("SELECT id, name FROM checks ORDER BY id")}

    def __enter__(self) -> "StudyFile":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            rows = len(self)
        finally:
            self._base.close()
        _set_counters(self.path, rows + 1)

    def __len__(self) -> int:
        """The number of designs that are committed."""
        count: int = self._base.execute("SELECT coalesce(max(id) + 1, 0) FROM design").fetchone()[0]
        return count

    def append(self, points: Float[np.ndarray, "n variables"], outcomes: Sequence[Outcome]) -> None:
        """Write the next designs in one transaction. Raises OutputError, as where the disc is full."""
        first, numbers = len(self), [self._row(outcome) for outcome in outcomes]
        width = len(self.variables) + len(self.results) + 6
        rows = [(first + n, *row[:2], *points[n].tolist(), *row[2:]) for n, row in enumerate(numbers)]
        with self._clear():
            self._base.execute("BEGIN IMMEDIATE")
            known = self._base.execute("SELECT count(*) FROM checks").fetchone()[0]
            added = list(self._checks.items())[known:]
            self._base.executemany("INSERT INTO checks VALUES (?, ?)", [(number, name) for name, number in added])
            self._base.executemany(f"INSERT INTO design VALUES ({', '.join('?' * width)})", rows)
            self._base.execute("COMMIT")

    def _row(self, outcome: Outcome) -> tuple[Any, ...]:
        """Status, reason, results, number of failed checks, worst margin, margins."""
        if outcome.status != DONE:
            return (outcome.status, outcome.reason, *(None for _ in self.results), None, None, None)
        margins = outcome.margins or {}
        for name in margins:
            self._checks.setdefault(name, len(self._checks))
        numbers = np.full(1 + max((self._checks[name] for name in margins), default=-1), np.nan, dtype="<f4")
        for name, value in margins.items():
            numbers[self._checks[name]] = np.clip(value, -1e30, 1e30)
        return (
            None,
            None,
            *(_stored(v) for v in outcome.results),
            outcome.failed,
            _stored(outcome.worst),
            numbers.tobytes(),
        )

    def designs(self, first: int = 0, last: int | None = None) -> "StudyRows":
        """The designs from a number up to another."""
        end = len(self) if last is None else last
        names = ", ".join(_quoted(name) for name in (*self.variables, *self.results))
        found = self._base.execute(
            f"SELECT status, failed, worst, {names} FROM design WHERE id >= ? AND id < ? ORDER BY id", (first, end)
        )
        count, split = max(min(end, len(self)) - first, 0), 2 + len(self.variables)
        numbers, made = np.empty((count, split + len(self.results))), np.empty(count, dtype=bool)
        for start in range(0, count, COMMIT):  # rows of Python take ten times the memory
            rows = found.fetchmany(COMMIT)
            made[start : start + COMMIT] = [row[0] is None for row in rows]
            numbers[start : start + COMMIT] = [[np.nan if v is None else v for v in row[1:]] for row in rows]
        return StudyRows(numbers[:, 2:split], numbers[:, split:], numbers[:, 0], numbers[:, 1], made)

    def margins(self, first: int = 0, last: int | None = None) -> Float[np.ndarray, "n checks"]:
        """Margins of the designs by check, in the order of `checks`; NaN where a design does not have it."""
        end = len(self) if last is None else last
        margins = np.full((max(end - first, 0), len(self._checks)), np.nan)
        rows = self._base.execute("SELECT id, margins FROM design WHERE id >= ? AND id < ?", (first, end))
        for number, blob in rows:
            if blob:
                values = np.frombuffer(blob, dtype="<f4")
                margins[number - first, : len(values)] = values
        return margins

    @property
    def checks(self) -> tuple[str, ...]:
        """The checks that occurred."""
        return tuple(self._checks)

    def reasons(self, most: int = 5) -> list[tuple[str, str, int]]:
        """Status, reason and number of the designs that were not made, the most frequent first."""
        text = "SELECT status, reason, count(*) AS n FROM design WHERE status IS NOT NULL GROUP BY status, reason"
        return list(self._base.execute(f"{text} ORDER BY n DESC, reason LIMIT ?", (most,)))

    def digest(self) -> str:
        """SHA-256 of all rows in their order: the same for the same study, whoever computed it."""
        found = sha256(json.dumps(self._plan, sort_keys=True).encode())
        for row in self._base.execute("SELECT * FROM design ORDER BY id"):
            found.update(repr(row).encode())
        return found.hexdigest()

    def _clear(self) -> "_Clear":
        return _Clear(self.path)


class _Clear:
    """Errors of SQLite as errors that a user can correct."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __enter__(self) -> None:
        return None

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if isinstance(error, sqlite3.Error):
            do = "let the other study end first" if "locked" in str(error) else "free some space, or give another file"
            raise OutputError(f"results file {self.path}: {error}", do=do) from None


class StudyRows:
    """Designs as arrays, a row a design: values of the variables, results, failed checks, worst margin, made or not."""

    def __init__(
        self, points: FloatArray, results: FloatArray, failed: FloatArray, worst: FloatArray, made: np.ndarray
    ) -> None:
        self.points, self.results, self.failed, self.worst, self.made = points, results, failed, worst, made

    @property
    def feasible(self) -> np.ndarray:
        """Whether each design was made and every check of it holds."""
        return np.asarray(self.made & (self.failed == 0))


_COUNTERS = (24, 92)
"""Offsets in the header of an SQLite file: the counter of its changes, and for which its size there is valid
[SQLite, Database File Format, 1.3.7 and 1.3.15].
"""


def _set_counters(path: Path, number: int) -> None:
    """Let the counters of changes follow from the rows: SQLite counts how often the file was opened for writing too."""
    with path.open("r+b") as file:
        for offset in _COUNTERS:
            file.seek(offset)
            file.write(number.to_bytes(4, "big"))


def _stored(value: float) -> float | None:
    return None if np.isnan(value) else float(value)


def _quoted(name: str) -> str:
    return '"' + name.replace('"', '""') + '"'


def _brief(value: object) -> str:
    text = json.dumps(value)
    return text if len(text) <= 80 else f"{text[:77]}..."
