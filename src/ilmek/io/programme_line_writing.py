"""Compiled kernels that write the text form of a programme."""

import numpy as np

from ilmek.arrays import IntArray, UInt8
from ilmek.loom.operations import EMPTY
from ilmek.num.compiled import compiled

_NEWLINE, _ZERO, _STAR, _SPACE = 10, 48, 42, 32
_LETTERS_CHART = tuple(b"chart ")
_LETTERS_PHASE = tuple(b"phase ")
_LETTERS_HEAD = tuple(b"head ")
_LETTERS_TUBE = tuple(b"tube ")
_LETTERS_MOVE = tuple(b"move ")
_LETTERS_TIE = tuple(b"tie ")
_LETTERS_OF_TUBE = tuple(b" tube ")
_LETTERS_TO = tuple(b"..")

RUNS_IN_A_LINE = 16
"""Runs of colour in a line of the chart."""


@compiled
def write_chart(chart: UInt8[np.ndarray, " columns"], out: UInt8[np.ndarray, " bytes"]) -> int:
    """Write the chart of a row as runs, RUNS_IN_A_LINE a line; returns the number of bytes."""
    at = runs = begin = 0
    for column in range(1, chart.shape[0] + 1):
        if column < chart.shape[0] and chart[column] == chart[begin]:
            continue
        if runs % RUNS_IN_A_LINE == 0:
            at = _put(out, at, _LETTERS_CHART)
        else:
            out[at] = _SPACE
            at += 1
        at = _put_number(out, at, column - begin)
        out[at] = _STAR
        at = _put_number(out, at + 1, 0 if chart[begin] == EMPTY else int(np.int64(chart[begin])) + 1)
        runs += 1
        begin = column
        if runs % RUNS_IN_A_LINE == 0 or column == chart.shape[0]:
            out[at] = _NEWLINE
            at += 1
    return at


@compiled
def write_phase(
    knots: tuple[IntArray, IntArray, IntArray],
    phase: int,
    aligned: IntArray,
    column: IntArray,
    out: UInt8[np.ndarray, " bytes"],
) -> int:
    """Write a phase; returns the number of bytes.

    knots    columns, tubes, and index of the first knot of each head and phase, (heads, phases + 1)
    aligned  as in `fill`
    column   of each head's last knot in the row, -1 before its first; changed
    """
    columns, tubes, offsets = knots
    at = _put_line(out, 0, _LETTERS_PHASE, phase + 1)
    for head in range(offsets.shape[0]):
        k, end = offsets[head, phase], offsets[head, phase + 1]
        if k < end:
            at = _put_line(out, at, _LETTERS_HEAD, head + 1)
        while k < end:
            first, tube = int(np.int64(columns[k])), int(np.int64(tubes[k]))
            if 0 <= aligned[head] != tube:
                at = _put_line(out, at, _LETTERS_TUBE, tube + 1)
            if column[head] >= 0 and abs(first - column[head]) > 1:
                at = _put(out, at, _LETTERS_MOVE)
                at = _put_range(out, at, int(column[head]) + 1, first + 1)
                out[at] = _NEWLINE
                at += 1
            k = _run_end(columns, tubes, k, end)
            last = int(np.int64(columns[k - 1]))
            at = _put(out, at, _LETTERS_TIE)
            at = _put_number(out, at, first + 1) if first == last else _put_range(out, at, first + 1, last + 1)
            at = _put_line(out, at, _LETTERS_OF_TUBE, tube + 1)
            aligned[head], column[head] = tube, last
    return at


@compiled
def _run_end(columns: IntArray, tubes: IntArray, first: int, end: int) -> int:
    """The index behind a run of neighbouring knots in one direction from one tube."""
    k = first + 1
    if k == end or abs(columns[k] - columns[first]) != 1 or tubes[k] != tubes[first]:
        return k
    step = columns[k] - columns[first]
    while k < end and columns[k] - columns[k - 1] == step and tubes[k] == tubes[first]:
        k += 1
    return k


@compiled
def _put(out: UInt8[np.ndarray, " bytes"], at: int, letters: tuple[int, ...]) -> int:
    for letter in letters:
        out[at] = letter
        at += 1
    return at


@compiled
def _put_line(out: UInt8[np.ndarray, " bytes"], at: int, letters: tuple[int, ...], number: int) -> int:
    at = _put_number(out, _put(out, at, letters), number)
    out[at] = _NEWLINE
    return at + 1


@compiled
def _put_range(out: UInt8[np.ndarray, " bytes"], at: int, first: int, last: int) -> int:
    at = _put(out, _put_number(out, at, first), _LETTERS_TO)
    return int(_put_number(out, at, last))


@compiled
def _put_number(out: UInt8[np.ndarray, " bytes"], at: int, number: int) -> int:
    digits, rest = 1, number
    while rest >= 10:
        rest //= 10
        digits += 1
    for index in range(digits):
        out[at + digits - 1 - index] = _ZERO + number % 10
        number //= 10
    return at + digits
