"""Results whose values are columns over samples, and records as rows: a DataFrame, a plot, a CSV file."""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from html import escape
from importlib import import_module
from typing import Any, Generic, TypeVar

from ilmek.arguments import Arguments
from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError
from ilmek.report.figure import Axis, Plot, Series
from ilmek.report.shown import Shown

Row = TypeVar("Row")

SHOWN_UNITS = {"rad": "deg", "m": "mm", "rad/s": "rpm"}
"""Units in which curves are drawn, where not in SI."""


class Framed(Shown, ABC):
    """A result whose values are columns over its samples."""

    __slots__ = ()

    @abstractmethod
    def table(self) -> Mapping[str, FloatArray]:
        """Columns by heading with the unit, SI and radians."""

    def frame(self) -> Any:
        """`table` as a DataFrame of pandas or polars, whichever is installed. Raises ParameterError without either."""
        return data_frame(self.table())

    def plot(self, *columns: str, over: str | None = None) -> Plot:
        """Columns as curves, which a notebook shows and `save("plot.svg")` writes.

        columns  headings, with or without their units; all of one unit       over  abscissa; default: the first column
        Raises ParameterError, with the nearest heading, for an unknown one, for none, and for different units.

        >>> import numpy as np
        >>> from ilmek import four_bar, solve
        >>> motion = solve(four_bar(0.300, 0.060, 0.200, 0.230), np.linspace(0, 6, 61), speed="150rpm")
        >>> plot = motion.plot("rocker angle", "coupler angle")
        >>> plot.y.unit, [series.label for series in plot.series]
        ('deg', ['rocker angle', 'coupler angle'])
        """
        table = self.table()
        headings = {heading.partition(" [")[0]: heading for heading in table} | {heading: heading for heading in table}
        known = list(dict.fromkeys(headings.values()))
        if not columns:
            raise ParameterError("no column is given for a plot", allowed=", ".join(known))
        given = Arguments("a plot")
        first, *curves = (
            headings[given.one_of("a column", name, headings)]
            for name in (known[0] if over is None else over, *columns)
        )
        units = {_split(heading)[1] for heading in curves}
        if len(units) > 1:
            raise ParameterError(f"{', '.join(curves)} in one plot", do="choose columns of one unit")
        words, unit = _split(first)
        series = tuple(Series(_split(heading)[0], table[first], table[heading]) for heading in curves)
        one_label = series[0].label if len(series) == 1 else ""
        title = f"{', '.join(curve.label for curve in series)} over {words}"
        return Plot("plot", title, Axis(words, _shown(unit)), Axis(one_label, _shown(units.pop())), series)


@dataclass(frozen=True, slots=True)
class RecordTable(Generic[Row]):
    """Records of one kind as the rows of a table: a sequence of them, with a column for each of some fields."""

    rows: tuple[Row, ...]
    fields: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[Row]:
        return iter(self.rows)

    def __getitem__(self, index: int) -> Row:
        return self.rows[index]

    def table(self) -> dict[str, list[Any]]:
        """Columns by field."""
        return {field: [getattr(row, field) for row in self.rows] for field in self.fields}

    def frame(self) -> Any:
        """`table` as a DataFrame of pandas or polars. Raises ParameterError without either."""
        return data_frame(self.table())

    def _repr_html_(self) -> str:
        lines = [self.fields, *zip(*self.table().values(), strict=True)]
        cells = ("".join(f"<td>{escape(str(cell))}</td>" for cell in line) for line in lines)
        return f"<table>{''.join(f'<tr>{line}</tr>' for line in cells)}</table>"


def data_frame(columns: Mapping[str, object]) -> Any:
    """Columns as a DataFrame of pandas or polars, whichever is installed. Raises ParameterError without either."""
    for library in ("pandas", "polars"):
        with suppress(ImportError):
            return import_module(library).DataFrame(dict(columns))
    raise ParameterError("a DataFrame needs pandas or polars", do="install one, or use table()")


def _split(heading: str) -> tuple[str, str]:
    words, _, unit = heading.removesuffix("]").partition(" [")
    return words, unit


def _shown(unit: str) -> str:
    return SHOWN_UNITS.get(unit, unit)
