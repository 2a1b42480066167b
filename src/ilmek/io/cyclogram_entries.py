"""Entries of a cyclogram's file: tables, and motion laws."""

from dataclasses import dataclass

from ilmek.cams.laws import law_of
from ilmek.cams.laws.law import Law
from ilmek.errors import ParameterError
from ilmek.io.file_entry import FileEntry

MOST_LAW_NUMBERS = 100
"""Largest number of numbers of a law; a spline through so many points takes some milliseconds."""


@dataclass(frozen=True, slots=True)
class CyclogramEntry(FileEntry):
    """A table of a cyclogram's file."""

    def law(self, key: str) -> Law:
        """A motion law, given by its name or by a table with its name and parameters."""
        value = self.data[key]
        table = {"name": value} if isinstance(value, str) else value
        inner = CyclogramEntry(table, (*self.path, key), self.source)
        name = inner.text("name")
        numbers = sum(len(one) if isinstance(one, list) else 1 for one in inner.data.values())
        if numbers > MOST_LAW_NUMBERS:
            inner.refuse(ParameterError(f"has {numbers} numbers", allowed=f"at most {MOST_LAW_NUMBERS}"))
        with inner.located():
            return law_of(name, {given: number for given, number in inner.data.items() if given != "name"})
