"""Entries of a file of tables, asked for one by one; what does not fit is named by its line and its key."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, NoReturn

from ilmek.cams.laws import law_of
from ilmek.cams.laws.law import Law
from ilmek.errors import IlmekError, MechanismError, ParameterError
from ilmek.io.line_numbers import Path
from ilmek.io.schema import SourceText, key_faults, read_quantity, shown

_MISSING = object()


@dataclass(frozen=True, slots=True)
class FileEntry:
    """A table of a file, where it stands in it, and the file."""

    data: Any
    path: Path
    sheet: SourceText

    def __post_init__(self) -> None:
        if not isinstance(self.data, Mapping):
            self.refuse(ParameterError(f"{shown(self.data)} is not a table"))

    def refuse(self, error: IlmekError, key: str = "") -> NoReturn:
        """Raise the error once more, with the line and the key."""
        self.sheet.refuse((*self.path, key) if key else self.path, error)

    @contextmanager
    def blamed(self) -> Iterator[None]:
        """While inside, an error of the model gets the line of this table; one that has a line already keeps it."""
        try:
            yield
        except MechanismError:
            raise
        except IlmekError as error:
            self.refuse(error)

    def keys(self, *known: str, needs: tuple[str, ...] = ()) -> None:
        """Refuse a key that is unknown, naming the nearest, or missing."""
        table = {key: value for key, value in self.data.items() if key != "$schema"}
        for key, error in key_faults(table, known, needs=needs):
            self.refuse(error, key)

    def has(self, key: str) -> bool:
        """Whether the key is there."""
        return key in self.data

    def entries(self) -> Iterator[tuple[str, "FileEntry"]]:
        """The tables in it by name."""
        for key, value in self.data.items():
            yield key, FileEntry(value, (*self.path, key), self.sheet)

    def table(self, key: str) -> "FileEntry":
        """A table in it; empty where it is not there."""
        return FileEntry(self.data.get(key, {}), (*self.path, key), self.sheet)

    def rows(self, key: str) -> list["FileEntry"]:
        """A list of tables in it; empty where it is not there."""
        rows = self.data.get(key, [])
        if not isinstance(rows, list):
            self.refuse(ParameterError(f"{shown(rows)} is not a list of tables", do=f"write [[{key}]]"), key)
        return [FileEntry(row, (*self.path, key, place), self.sheet) for place, row in enumerate(rows)]

    def text(self, key: str, default: str | None = None) -> str:
        """A text."""
        value = self.data.get(key, default)
        if not isinstance(value, str):
            self.refuse(ParameterError(f"{shown(value)} is not text in quotes"), key)
        return value

    def flag(self, key: str) -> bool:
        """True or false; false where it is not there."""
        value = self.data.get(key, False)
        if not isinstance(value, bool):
            self.refuse(ParameterError(f"{shown(value)} is neither true nor false"), key)
        return value

    def whole(self, key: str) -> int:
        """A whole number; 0 where it is not there."""
        value = self.data.get(key, 0)
        if isinstance(value, bool) or not isinstance(value, int) or abs(value) > 1000:
            self.refuse(ParameterError(f"{shown(value)} is not a small whole number"), key)
        return value

    def quantity(self, key: str, unit: str, default: object = _MISSING) -> float:
        """A number in SI, or a text with its unit."""
        value = self.data.get(key, default)
        if value is _MISSING:
            self.refuse(ParameterError(f"has no {key!r}", allowed=f"a quantity in {unit}"))
        if value is default and isinstance(value, float):
            return value
        return self._number(value, unit, key)

    def pairs(self, key: str, unit: str) -> list[tuple[float, float]]:
        """A list of pairs of quantities."""
        rows = self.data[key]
        if not isinstance(rows, list) or any(not isinstance(row, list) or len(row) != 2 for row in rows):
            self.refuse(ParameterError(f"{shown(rows)} is not a list of pairs", allowed="[[start, end], ...]"), key)
        return [(self._number(row[0], unit, key), self._number(row[1], unit, key)) for row in rows]

    def law(self, key: str) -> Law:
        """A law by its name, or by a table with its name and parameters."""
        value = self.data[key]
        table = {"name": value} if isinstance(value, str) else value
        inner = FileEntry(table, (*self.path, key), self.sheet)
        name = inner.text("name")
        with inner.blamed():
            return law_of(name, {given: number for given, number in inner.data.items() if given != "name"})

    def _number(self, value: Any, unit: str, key: str) -> float:
        try:
            return read_quantity(value, unit)
        except IlmekError as error:
            self.refuse(error, key)
