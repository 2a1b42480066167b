"""Faults that a proof finds in a programme, in the words of its text form."""

from collections.abc import Iterator
from enum import Enum

import numpy as np

from ilmek.arrays import BoolArray, Int64, IntArray
from ilmek.loom.operations import EMPTY, LoomSetup, RowOperations
from ilmek.loom.proof import kernel
from ilmek.records import value_record


class FaultyPart(Enum):
    """The part of a row that has a fault: the row itself, or a line of its text."""

    ROW = "row"
    KNOT = "knot"
    CHANGE = "change"
    END = "end"


@value_record
class RuleFault:
    """A rule that an operation breaks.

    row    of the loom, from 0     part, index  of the row: knots in the row's order, changes in the order of its stops
    what   given, and allowed; rows, knots, heads, tubes and yarns count from 1
    """

    row: int
    part: FaultyPart
    index: int
    what: str


def knot_faults(setup: LoomSetup, row: RowOperations, faults: Int64[np.ndarray, "n 6"]) -> Iterator[RuleFault]:
    """The faults of the knots of a row, from the rows that the kernel wrote."""
    for kind, head, first, last, one, other in faults.tolist():
        if kind == kernel.TWICE:
            yield from _twice(row, first, last)
        elif kind == kernel.MEETING:
            yield from _meeting(setup, row, (head, first), (one, last), other)
        else:
            yield RuleFault(
                row.number, FaultyPart.KNOT, first, _sentence(setup, row, (kind, head, first, last, one, other))
            )


def _sentence(setup: LoomSetup, row: RowOperations, fault: tuple[int, int, int, int, int, int]) -> str:
    kind, head, first, last, one, other = fault
    knots = _knots(row.columns[first : last + 1].astype(np.int64))
    if kind == kernel.OUTSIDE:
        return f"{knots} of head {head + 1}: the row has knots 1 to {setup.columns}"
    if kind == kernel.NO_TUBE:
        return f"{knots} of head {head + 1}, tube {one + 1}: the head has tubes 1 to {setup.tubes}"
    if kind == kernel.EMPTY_TUBE:
        return f"{knots} of head {head + 1}, tube {one + 1}: the tube has no yarn"
    if kind == kernel.OTHER_YARN:
        tube, yarn = divmod(one, 256)
        chart = "no knot" if other == EMPTY else f"yarn {other + 1}"
        return f"{knots} of head {head + 1}: tube {tube + 1} has yarn {yarn + 1}, the chart has {chart}"
    if kind == kernel.YARN_ENDS:
        return f"{knots} of head {head + 1}: the package of tube {one + 1} (yarn {other + 1}) has ended before"
    return (
        f"head {head + 1} goes from knot {one + 1} to knot {other + 1} before the row: "
        "that takes longer than the end of the row before"
    )


def _twice(row: RowOperations, first: int, last: int) -> Iterator[RuleFault]:
    """Each line that ties one of the knots."""
    for column in np.unique(row.columns[first : last + 1]).tolist():
        where = np.flatnonzero(row.columns == column).tolist()
        heads = " and ".join(str(head_of(row, index) + 1) for index in where)
        for index in where:
            what = f"knot {column + 1} is tied {len(where)} times in the row, by heads {heads}"
            yield RuleFault(row.number, FaultyPart.KNOT, index, what)


def _meeting(
    setup: LoomSetup, row: RowOperations, left: tuple[int, int], right: tuple[int, int], distance: int
) -> Iterator[RuleFault]:
    """The knots of both heads; a head that stands has none."""
    needed = (right[0] - left[0]) * setup.spacing
    near = f"{distance} knot{'' if distance == 1 else 's'}"
    what = (
        f"heads {left[0] + 1} and {right[0] + 1} come within {near} of each other in a phase; at least {needed} needed"
    )
    knots = [index for _, index in (left, right) if index != kernel.NO_KNOT]
    for index in knots:
        yield RuleFault(row.number, FaultyPart.KNOT, index, f"knot {int(row.columns[index]) + 1}: {what}")
    if not knots:
        yield RuleFault(row.number, FaultyPart.ROW, 0, what)


def missing_knots(number: int, done: BoolArray) -> Iterator[RuleFault]:
    """The knots of a row that no head ties. done: of each column, whether its knot is tied, or it has none."""
    missing = np.flatnonzero(~done)
    for run in np.split(missing, np.flatnonzero(np.diff(missing) != 1) + 1):
        if len(run):
            yield RuleFault(number, FaultyPart.ROW, 0, f"{_knots(run)} of the chart: no head ties {_them(run)}")


def head_of(row: RowOperations, index: int) -> int:
    """The head that ties a knot."""
    return int(np.searchsorted(row.starts, index, side="right")) - 1


def _knots(columns: IntArray) -> str:
    """Columns in words, from 1: knot 12, knots 12..40.

    >>> _knots(np.array([11])), _knots(np.array([11, 12, 13])), _knots(np.array([13, 12]))
    ('knot 12', 'knots 12..14', 'knots 14..13')
    """
    first, last = int(columns[0]) + 1, int(columns[-1]) + 1
    return f"knot {first}" if len(columns) == 1 else f"knots {first}..{last}"


def _them(columns: IntArray) -> str:
    return "it" if len(columns) == 1 else "them"
