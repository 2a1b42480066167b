"""A value of a programme's description, checked as it is read."""

from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np

from ilmek.arrays import IntArray
from ilmek.errors import LoomError, is_printable
from ilmek.io.schema import shown

LONGEST_NAME = 200
"""Largest number of characters of a name of a yarn, a carpet size, a track, a motion or an event."""

_GREATEST = 1e9
"""Bound of positions, prices and other numbers without a closer one."""


@dataclass(frozen=True, slots=True)
class MetaEntry:
    """A value of the description and its path, for messages. Every method raises LoomError for another value."""

    path: str
    value: Any

    def refuse(self, allowed: str) -> NoReturn:
        """Raise LoomError with the path, the value in short, and what is allowed."""
        given = "a table" if isinstance(self.value, dict) else shown(self.value)
        if isinstance(self.value, list):
            given = f"a list of {len(self.value)}"
        raise LoomError(f"{self.path} is {given}", allowed=allowed)

    def number(self, low: float = -_GREATEST, high: float = _GREATEST) -> float:
        """A finite number."""
        if type(self.value) not in (int, float) or not low <= self.value <= high:
            self.refuse(f"a number from {low:g} to {high:g}")
        return float(self.value)

    def whole(self, low: int, high: int) -> int:
        """A whole number."""
        if type(self.value) is not int or not low <= self.value <= high:
            self.refuse(f"a whole number from {low} to {high}")
        return self.value

    def text(self, *, least: int = 0) -> str:
        """A text of printable characters."""
        if not isinstance(self.value, str) or not least <= len(self.value) <= LONGEST_NAME:
            self.refuse(f"a text of {least} to {LONGEST_NAME} characters")
        if not is_printable(self.value):
            self.refuse("printable characters")
        return self.value

    def one_of(self, *known: str) -> str:
        """One of some texts."""
        if self.value not in known:
            self.refuse(", ".join(known))
        return str(self.value)

    def table(self, *keys: str, optional: tuple[str, ...] = ()) -> dict[str, "MetaEntry"]:
        """A table with exactly these keys, and with those that are optional, whose default is null."""
        if not isinstance(self.value, dict) or set(self.value) - set(optional) != set(keys):
            self.refuse(f"a table with {', '.join((*keys, *optional))}")
        return {key: MetaEntry(f"{self.path}.{key}", self.value.get(key)) for key in (*keys, *optional)}

    def rows(self, least: int, most: int) -> list["MetaEntry"]:
        """A list."""
        if not isinstance(self.value, list) or not least <= len(self.value) <= most:
            self.refuse(f"a list of {least} to {most}")
        return [MetaEntry(f"{self.path}[{index}]", one) for index, one in enumerate(self.value)]

    def wholes(self, count: int, high: int) -> IntArray:
        """A list of whole numbers from 0."""
        return np.array([row.whole(0, high) for row in self.rows(count, count)], np.int64)
