"""A programme with edited rows, for tests of what reads programmes."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ilmek.arrays import UInt8
from ilmek.loom.explicit import programme_digest
from ilmek.loom.operations import LoomProgramme, LoomSetup, RowOperations


class EditedProgramme:
    """A programme in memory, some rows of which are others."""

    def __init__(
        self, programme: LoomProgramme, rows: Mapping[int, RowOperations], setup: LoomSetup | None = None
    ) -> None:
        self._programme, self._rows = programme, rows
        self.setup = setup or programme.setup

    @property
    def digest(self) -> str:
        return programme_digest(self)

    def operations(self, number: int) -> RowOperations:
        return self._rows[number] if number in self._rows else self._programme.operations(number)

    def chart_row(self, number: int) -> UInt8[np.ndarray, " columns"]:
        return self._programme.chart_row(number)


def edited(
    programme: LoomProgramme,
    number: int = 0,
    edit: Callable[[RowOperations], RowOperations] | None = None,
    **setup: Any,
) -> EditedProgramme:
    """A programme with one row edited, and with other entries of its setup."""
    rows = {} if edit is None else {number: edit(programme.operations(number))}
    return EditedProgramme(programme, rows, replace(programme.setup, **setup) if setup else None)


def without_knot(row: RowOperations, index: int) -> RowOperations:
    """A row without one knot."""
    counts, head, phase = row.counts.copy(), *part_of(row, index)
    counts[head, phase] -= 1
    return replace(row, columns=np.delete(row.columns, index), tubes=np.delete(row.tubes, index), counts=counts)


def with_knot_twice(row: RowOperations, index: int) -> RowOperations:
    """A row with one knot tied again at once."""
    counts, head, phase = row.counts.copy(), *part_of(row, index)
    counts[head, phase] += 1
    columns, tubes = (np.insert(array, index, array[index]) for array in (row.columns, row.tubes))
    return replace(row, columns=columns, tubes=tubes, counts=counts)


def with_knot(row: RowOperations, index: int, *, column: int | None = None, tube: int | None = None) -> RowOperations:
    """A row with another column or tube of a knot."""
    columns, tubes = row.columns.copy(), row.tubes.copy()
    columns[index] = columns[index] if column is None else column
    tubes[index] = tubes[index] if tube is None else tube
    return replace(row, columns=columns, tubes=tubes)


def part_of(row: RowOperations, index: int) -> tuple[int, int]:
    """Head and phase of a knot."""
    where = np.searchsorted(np.cumsum(row.counts.ravel()), index, side="right")
    head, phase = np.unravel_index(where, row.counts.shape)
    return int(head), int(phase)


def swept(programme: LoomProgramme) -> EditedProgramme:
    """The programme of two heads with rows that do not depend on a compiler: each half is swept, to and fro; in the
    second row the second head begins its last half in the middle.
    """
    columns, rows = programme.setup.columns, {}
    for number in range(programme.setup.rows):
        line = np.arange(columns, dtype=np.int32).reshape(4, -1)
        order = line.ravel() if number % 2 == 0 else np.concatenate([line[half, ::-1] for half in (1, 0, 3, 2)])
        if number == 1:
            last = order[-(columns // 4) :]
            order[-(columns // 4) :] = np.concatenate([last[len(last) // 2 :], last[: len(last) // 2][::-1]])
        counts = np.full((2, 2), columns // 4)
        rows[number] = replace(
            programme.operations(number), columns=order, tubes=programme.chart_row(number)[order], counts=counts
        )
    return EditedProgramme(programme, rows)
