"""Tables of a file, read one by one; errors name the line and the key."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, NoReturn, TypeVar

from ilmek.errors import IlmekError, MechanismError, ParameterError
from ilmek.io.line_numbers import Path
from ilmek.io.schema import SourceText, key_faults, read_quantity, shown
from ilmek.params import Setting

E = TypeVar("E", bound="FileEntry")

_MISSING = object()


@dataclass(frozen=True, slots=True)
class FileEntry:
    """A table of a file, its path in the file, and the file."""

    data: Any
    path: Path
    source: SourceText

    def __post_init__(self) -> None:
        if not isinstance(self.data, Mapping):
            self.refuse(ParameterError(f"{shown(self.data)} is not a table"))

    def refuse(self, error: IlmekError, key: str = "") -> NoReturn:
        """Raise the error again with the line and the key."""
        self.source.refuse((*self.path, key) if key else self.path, error)

    @contextmanager
    def located(self) -> Iterator[None]:
        """Add the line of this table to errors raised inside that have no line yet."""
        try:
            yield
        except MechanismError:
            raise
        except IlmekError as error:
            self.refuse(error)

    def keys(self, *known: str, needs: tuple[str, ...] = ()) -> None:
        """Raise an error for an unknown key, with the nearest known one, or for a missing key."""
        table = {key: value for key, value in self.data.items() if key != "$schema"}
        for key, error in key_faults(table, known, needs=needs):
            self.refuse(error, key)

    def has(self, key: str) -> bool:
        """Whether the key exists."""
        return key in self.data

    def entries(self: E) -> Iterator[tuple[str, E]]:
        """The inner tables by name."""
        for key, value in self.data.items():
            yield key, type(self)(value, (*self.path, key), self.source)

    def settings(self, prefix: str = "") -> Iterator[tuple[str, Setting]]:
        """The settings of this table and its inner tables by dotted name."""
        for key, value in self.data.items():
            if isinstance(value, Mapping):
                yield from type(self)(value, (*self.path, key), self.source).settings(f"{prefix}{key}.")
            elif isinstance(value, str | int | float):
                yield f"{prefix}{key}", value
            else:
                self.refuse(ParameterError(f"{shown(value)} is not a value", do='write it like "8mm", 8 or true'), key)

    def table(self: E, key: str) -> E:
        """An inner table; empty if it is missing."""
        return type(self)(self.data.get(key, {}), (*self.path, key), self.source)

    def rows(self: E, key: str) -> list[E]:
        """An inner list of tables; empty if it is missing."""
        rows = self.data.get(key, [])
        if not isinstance(rows, list):
            self.refuse(ParameterError(f"{shown(rows)} is not a list of tables", do=f"write [[{key}]]"), key)
        return [type(self)(row, (*self.path, key, index), self.source) for index, row in enumerate(rows)]

    def text(self, key: str, default: str | None = None) -> str:
        """A text."""
        value = self.data.get(key, default)
        if not isinstance(value, str):
            self.refuse(ParameterError(f"{shown(value)} is not text in quotes"), key)
        return value

    def flag(self, key: str) -> bool:
        """True or false; default: false."""
        value = self.data.get(key, False)
        if not isinstance(value, bool):
            self.refuse(ParameterError(f"{shown(value)} is neither true nor false"), key)
        return value

    def whole(self, key: str) -> int:
        """A whole number of at most 1000 in magnitude; default: 0."""
        value = self.data.get(key, 0)
        if isinstance(value, bool) or not isinstance(value, int) or abs(value) > 1000:
            self.refuse(ParameterError(f"{shown(value)} is not a whole number", allowed="-1000 to 1000"), key)
        return value

    def quantity(self, key: str, unit: str, default: object = _MISSING) -> float:
        """A quantity [SI], given as a number in SI or a text with its unit."""
        value = self.data.get(key, default)
        if value is _MISSING:
            self.refuse(ParameterError(f"has no {key!r}", allowed=f"a quantity in {unit}"))
        if value is default and isinstance(value, float):
            return value
        return self._number(value, unit, key)

    def pairs(self, key: str, unit: str) -> list[tuple[float, float]]:
        """A list of pairs of quantities [SI]."""
        rows = self.data[key]
        if not isinstance(rows, list) or any(not isinstance(row, list) or len(row) != 2 for row in rows):
            self.refuse(ParameterError(f"{shown(rows)} is not a list of pairs", allowed="[[start, end], ...]"), key)
        return [(self._number(row[0], unit, key), self._number(row[1], unit, key)) for row in rows]

    def _number(self, value: object, unit: str, key: str) -> float:
        try:
            return read_quantity(value, unit)
        except IlmekError as error:
            self.refuse(error, key)
