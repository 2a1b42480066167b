"""A row of a programme, and the changes of packages in its stops, as they are in a programme file.

The operations of a row are one blob, zlib of little-endian integers:

    counts   int32 (heads, phases): knots of each head in each phase
    moves    int32 (knots,): columns from the knot before, of the first from 0; byte by byte: all lowest bytes, then all
             second ones, and so on, which compresses best
    tubes    uint8 (knots,)

Nothing in a file is believed: whatever is read has its sizes, and all its numbers are in bounds.
"""

import zlib
from collections.abc import Iterable, Iterator
from itertools import groupby
from typing import Any

import numpy as np

from ilmek.arrays import UInt8
from ilmek.errors import LoomError
from ilmek.loom.operations import LONGEST_PACKAGE, LoomSetup, RowEnd, RowOperations, Stop, TubeChange

LEVEL = 1
"""Level of the compression: rows are mostly zeros."""

MOST_PHASES = 16
"""Largest number of phases of a row: four times those of any sharing of a row."""

MOST_ENDS = 100
"""Largest number of operations after the knots of a row: twenty times those of a row."""

MOST_MORE = 2
"""Most knots of a row over those of the chart's: a programme that ties a knot twice can be read, to be checked."""


def packed(data: bytes) -> bytes:
    """Data compressed as in a programme file."""
    return zlib.compress(data, LEVEL)


def unpacked(data: object, most: int) -> bytes | None:
    """What was packed, if it is whole and not longer than `most`; it is never unpacked beyond that."""
    inflate = zlib.decompressobj()
    try:
        raw = inflate.decompress(data, most + 1) if isinstance(data, bytes) else b""
    except zlib.error:
        return None
    return raw if len(raw) <= most and inflate.eof and not inflate.unused_data else None


def packed_row(row: RowOperations) -> bytes:
    """The knots of a row as a blob."""
    moves = np.diff(row.columns, prepend=np.int32(0)).astype("<i4")
    shuffled = np.ascontiguousarray(moves.view(np.uint8).reshape(-1, 4).T)
    return packed(b"".join((row.counts.astype("<i4").tobytes(), shuffled.tobytes(), row.tubes.tobytes())))


def unpacked_row(
    setup: LoomSetup, number: int, stored: tuple[object, object, object], stops: tuple[Stop, ...]
) -> RowOperations | None:
    """A row from its phases, ends and data as stored; None if it is damaged."""
    phases, ends, data = stored
    if type(phases) is not int or not 1 <= phases <= MOST_PHASES:
        return None
    if not isinstance(ends, bytes) or len(ends) > MOST_ENDS or any(end >= len(RowEnd) for end in ends):
        return None
    head = 4 * setup.heads * phases
    raw = unpacked(data, head + 5 * MOST_MORE * setup.columns)
    if raw is None or len(raw) < head or (len(raw) - head) % 5:
        return None
    knots = (len(raw) - head) // 5
    counts = np.frombuffer(raw, "<i4", setup.heads * phases).astype(np.int64).reshape(setup.heads, phases)
    planes: UInt8[np.ndarray, "4 knots"] = np.frombuffer(raw, np.uint8, 4 * knots, head).reshape(4, knots)
    moves = np.ascontiguousarray(planes.T).view("<i4").reshape(knots)
    columns = np.cumsum(moves, dtype=np.int32)
    tubes = np.frombuffer(raw, np.uint8, knots, head + 4 * knots)
    if counts.min() < 0 or counts.sum() != knots or any(stop.phase >= phases for stop in stops):
        return None
    if knots and (columns.min() < 0 or columns.max() >= setup.columns or tubes.max() >= setup.tubes):
        return None
    return RowOperations(number, columns, tubes, counts, tuple(RowEnd(end) for end in ends), stops)


def change_records(stops: Iterable[Stop]) -> Iterator[tuple[object, ...]]:
    """The changes of a row's stops as (row, phase, number, weft, head, tube, yarn, length), in order."""
    for (row, phase), ones in groupby(stops, key=lambda stop: (stop.row, stop.phase)):
        (stop,) = ones
        for number, weft in enumerate(stop.wefts):
            yield row, phase, number, weft, None, None, None, None
        for number, one in enumerate(stop.tubes, len(stop.wefts)):
            yield row, phase, number, None, one.head, one.tube, one.yarn, one.length


def read_stops(setup: LoomSetup, row: int, records: Iterable[tuple[object, ...]]) -> tuple[Stop, ...]:
    """The stops of a row from records (phase, weft, head, tube, yarn, length). Raises LoomError for a damaged one."""
    stops = []
    for phase, ones in groupby(records, key=lambda one: one[0]):
        changes = [_change(setup, one[1:]) for one in ones]
        if type(phase) is not int or not 0 <= phase < MOST_PHASES or None in changes:
            raise LoomError(f"a change of a package before row {row} is damaged")
        wefts = tuple(change for change in changes if isinstance(change, int))
        stops.append(Stop(row, phase, wefts, tuple(change for change in changes if isinstance(change, TubeChange))))
    return tuple(stops)


def _change(setup: LoomSetup, stored: tuple[Any, ...]) -> int | TubeChange | None:
    """The bobbin of weft, or the package, that is changed; None for a record that is damaged."""
    weft, *tube, length = stored
    if weft is not None:
        known = type(weft) is int and 0 <= weft < len(setup.wefts) and all(one is None for one in (*tube, length))
        return weft if known else None
    bounds = (setup.heads, setup.tubes, len(setup.yarns))
    if any(type(one) is not int or not 0 <= one < bound for one, bound in zip(tube, bounds, strict=True)):
        return None
    if type(length) is not float or not 0.0 <= length <= LONGEST_PACKAGE:
        return None
    head, of_head, yarn = tube
    return TubeChange(head, of_head, yarn, length)
