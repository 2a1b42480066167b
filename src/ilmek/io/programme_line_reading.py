"""Compiled kernels that read the text form of a programme: lines from bytes, and a row from lines.

A line is matched against patterns: `#` is a whole number from 1, without leading zeros, `~` the rest of the line.
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import Int32, Int64, IntArray, UInt8
from ilmek.io.programme_rows import MOST_ENDS
from ilmek.loom.operations import EMPTY
from ilmek.num.compiled import compiled

PATTERNS = (
    "row #", "chart ~", "stop", "bobbin #", "package head # tube # yarn # of ~", "phase #", "head #", "tube #",
    "move #..#", "tie #..# tube #", "tie # tube #", "straight weft", "first beat", "sinuous weft", "second beat",
    "take-up",
)  # fmt: skip
"""The lines of a row; the index of a pattern is the kind of a line."""

(ROW, CHART, STOP, BOBBIN, PACKAGE, PHASE, HEAD, TUBE, MOVE, TIES, TIE, FIRST_END) = range(12)

LONGEST_LINE = 400
"""Largest number of characters of a line of a row."""


def _stages(first: int, last: int) -> int:
    """The kinds from `first` to `last` as bits."""
    return (1 << (last + 1)) - (1 << first)


_LAST_END = len(PATTERNS) - 1
_TIED = _stages(HEAD, TIE)
_AFTER = (
    0, _stages(ROW, CHART), _stages(CHART, CHART) | _stages(PHASE, TIE), _stages(STOP, BOBBIN), _stages(STOP, PACKAGE),
    _stages(CHART, TIE), _stages(PHASE, TIE), _TIED, _TIED, _TIED, _TIED,
    *[_stages(PHASE, _LAST_END)] * (_LAST_END - TIE),
)  # fmt: skip
# For each kind of line the kinds that may be before it, as bits.

_MOST_DIGITS = 9
_NEWLINE, _ZERO, _NUMBER, _REST, _STAR, _SPACE = 10, 48, 35, 126, 42, 32
_BEGIN, _END = 5, 6  # columns of a line behind its kind and its numbers: first byte, and the one behind the last

WRONG_ORDER, WRONG_CHART, TOO_MANY = 1, 2, 3
"""What is wrong with the first faulty line of a row."""

TUBE_LINE, NO_TUBE_LINE, MOVE_LINE, NO_MOVE_LINE, KNOT_RANGE, TUBE_RANGE = range(6)
"""Remarks on a line: it does not agree with the knots, or is missing before them; a knot or tube that there is not."""


def pattern_table() -> tuple[UInt8[np.ndarray, " bytes"], Int64[np.ndarray, " bounds"]]:
    """The patterns one after the other, and where each begins."""
    joined = "".join(PATTERNS).encode()
    return np.frombuffer(joined, np.uint8), np.cumsum([0, *map(len, PATTERNS)])


@compiled
def match_lines(
    text: UInt8[np.ndarray, " bytes"], patterns: UInt8[np.ndarray, " letters"], bounds: IntArray, lines: IntArray
) -> int:
    """Match each line of a text that ends with a newline; returns the number of lines matched.

    lines  int (lines, 7), filled: kind, four numbers, first byte, byte behind the last
    """
    at = count = 0
    while at < text.shape[0]:
        end = at
        while text[end] != _NEWLINE:
            end += 1
        kind = 0
        while kind < bounds.shape[0] - 1:
            begin = bounds[kind]
            near = text[at] == patterns[begin] and text[at + 1] == patterns[begin + 1]
            if near and _matches(text, (at, end), patterns[begin : bounds[kind + 1]], lines[count]):
                break
            kind += 1
        if kind == bounds.shape[0] - 1 or end - at > LONGEST_LINE:
            return count
        lines[count, 0], lines[count, _BEGIN], lines[count, _END] = kind, at, end
        count += 1
        at = end + 1
    return count


@compiled
def _matches(
    text: UInt8[np.ndarray, " bytes"], span: tuple[int, int], pattern: UInt8[np.ndarray, " letters"], line: IntArray
) -> bool:
    """Whether a line is of a pattern; its numbers are written into line[1:5]."""
    at, end = span
    numbers = 0
    for letter in pattern:
        if letter == _REST:
            line[_BEGIN - 1] = at
            return bool(at < end)
        if letter != _NUMBER:
            if at >= end or text[at] != letter:
                return False
            at += 1
            continue
        value, digits = _number(text, at, end)
        if digits == 0:
            return False
        numbers += 1
        line[numbers] = value
        at += digits
    return bool(at == end)


@compiled
def _number(text: UInt8[np.ndarray, " bytes"], at: int, end: int) -> tuple[int, int]:
    """A whole number from 1 and its digits; (0, 0) where there is none."""
    value = digits = 0
    while at + digits < end and _ZERO <= text[at + digits] <= _ZERO + 9 and digits <= _MOST_DIGITS:
        value = 10 * value + int(np.int64(text[at + digits])) - _ZERO
        digits += 1
    if digits == 0 or digits > _MOST_DIGITS or text[at] == _ZERO:
        return 0, 0
    return value, digits


class RowSizes(NamedTuple):
    """Sizes of a carpet and its loom, and the largest number of knots in a row."""

    columns: int
    heads: int
    tubes: int
    yarns: int
    most_knots: int


@compiled
def measure(
    text: UInt8[np.ndarray, " bytes"],
    lines: IntArray,
    sizes: RowSizes,
    chart: UInt8[np.ndarray, " columns"],
    counts: Int64[np.ndarray, "heads phases"],
) -> tuple[int, int, int]:
    """Check the order of a row's lines, fill its chart and the knots of each head and phase.

    Returns (phases, index of the first faulty line or -1, its fault); the index may be that behind the last line.
    """
    filled, phases, head, knots, ends = 0, 0, 0, 0, 0
    for index in range(1, lines.shape[0]):
        kind, number = lines[index, 0], lines[index, 1]
        follows = (_AFTER[kind] >> lines[index - 1, 0]) & 1 == 1
        if kind == CHART and follows:
            filled = _fill_chart(text, (lines[index, 4], lines[index, _END]), chart, filled, sizes.yarns)
        if filled < 0 or (kind != CHART and filled != sizes.columns):
            return phases, index, WRONG_CHART
        if kind == PHASE:
            follows = follows and number == phases + 1 and phases < counts.shape[1]
            phases, head = phases + 1, 0
        elif kind == HEAD:
            follows = follows and head < number <= sizes.heads
            head = number
        elif follows and TIES <= kind <= TIE:
            tied = _knots_of(lines[index])
            knots += tied
            if knots > sizes.most_knots:
                return phases, index, TOO_MANY
            counts[head - 1, phases - 1] += tied
        ends += kind >= FIRST_END
        if not follows or ends > MOST_ENDS:
            return phases, index, WRONG_ORDER
    whole = lines[lines.shape[0] - 1, 0] >= PHASE
    return phases, -1 if whole else lines.shape[0], 0 if whole else WRONG_ORDER


@compiled
def _knots_of(line: IntArray) -> int:
    """Knots of a tie."""
    return 1 if line[0] == TIE else abs(line[2] - line[1]) + 1


@compiled
def _fill_chart(
    text: UInt8[np.ndarray, " bytes"], span: tuple[int, int], chart: UInt8[np.ndarray, " columns"], at: int, yarns: int
) -> int:
    """Fill a chart from a column on by runs `knots*yarn`, 0: no knot; returns the next column, -1 for a faulty text."""
    begin, end = span
    while True:
        knots, digits = _number(text, begin, end)
        begin += digits
        if digits == 0 or begin >= end or text[begin] != _STAR or at + knots > chart.shape[0]:
            return -1
        yarn, digits = _number(text, begin + 1, end)
        if digits == 0 and begin + 1 < end and text[begin + 1] == _ZERO:
            digits = 1
        if digits == 0 or yarn > yarns:
            return -1
        chart[at : at + knots] = EMPTY if yarn == 0 else yarn - 1
        at += knots
        begin += 1 + digits
        if begin == end:
            return at
        if text[begin] != _SPACE:
            return -1
        begin += 1


class RowParts(NamedTuple):
    """What `fill` writes.

    columns, tubes  of the knots, head by head      ties  of each tie its first knot and its line, (ties, 2)
    remarks         line and remark, (most, 2)      noted  number of remarks, (1,)
    """

    columns: Int32[np.ndarray, " knots"]
    tubes: UInt8[np.ndarray, " knots"]
    ties: Int64[np.ndarray, "ties 2"]
    remarks: Int64[np.ndarray, "most 2"]
    noted: Int64[np.ndarray, "1"]


@compiled
def fill(lines: IntArray, sizes: RowSizes, counts: IntArray, aligned: IntArray, parts: RowParts) -> None:
    """Write the knots of a row whose order is checked, and the remarks on its lines.

    aligned  tube of each head's last knot, -1 before its first; changed
    """
    at, column = np.zeros(sizes.heads, np.int64), np.full(sizes.heads, -1, np.int64)
    for head in range(1, sizes.heads):
        at[head] = at[head - 1] + counts[head - 1].sum()
    ties, head = 0, -1
    pending = np.full(2, -1, np.int64)  # lines of the change of tube and of the move that wait for a tie
    for index in range(lines.shape[0]):
        kind = lines[index, 0]
        if TIES <= kind <= TIE:
            _compare(lines, index, (sizes.columns, sizes.tubes, aligned[head], column[head]), pending, parts)
            parts.ties[ties, 0], parts.ties[ties, 1] = at[head], index
            ties += 1
            first, tube = lines[index, 1] - 1, lines[index, 2 if kind == TIE else 3] - 1
            step = -1 if kind == TIES and lines[index, 2] < lines[index, 1] else 1
            for k in range(_knots_of(lines[index])):
                column[head] = first + k * step
                parts.columns[at[head]], parts.tubes[at[head]] = column[head], min(tube, 255)
                at[head] += 1
            aligned[head] = tube
        elif kind in (TUBE, MOVE) and pending[kind - TUBE] < 0:
            pending[kind - TUBE] = index
        else:
            _end_pending(pending, parts)
            if kind in (TUBE, MOVE):
                _remark(parts, index, TUBE_LINE if kind == TUBE else MOVE_LINE)
            head = lines[index, 1] - 1 if kind == HEAD else head


@compiled
def _compare(lines: IntArray, index: int, state: tuple[int, int, int, int], pending: IntArray, parts: RowParts) -> None:
    """Compare a tie with the change of tube and the move before it, and with the sizes of the loom.

    state  columns, tubes, tube and column of the head's last knot
    """
    columns, tubes, aligned, column = state
    single = lines[index, 0] == TIE
    first, last = lines[index, 1] - 1, lines[index, 1 if single else 2] - 1
    tube = lines[index, 2 if single else 3] - 1
    changes, moves = aligned >= 0 and aligned != tube, column >= 0 and abs(first - column) > 1
    change, move = pending[0], pending[1]
    if change >= 0 and not (changes and lines[change, 1] - 1 == tube):
        _remark(parts, change, TUBE_LINE)
    elif changes and change < 0:
        _remark(parts, index, NO_TUBE_LINE)
    if move >= 0 and not (moves and lines[move, 1] - 1 == column and lines[move, 2] - 1 == first):
        _remark(parts, move, MOVE_LINE)
    elif moves and move < 0:
        _remark(parts, index, NO_MOVE_LINE)
    if tube >= tubes:
        _remark(parts, index, TUBE_RANGE)
    if max(first, last) >= columns:
        _remark(parts, index, KNOT_RANGE)
    pending[0] = pending[1] = -1


@compiled
def _end_pending(pending: IntArray, parts: RowParts) -> None:
    """Remark changes and moves that no tie follows."""
    for which in range(2):
        if pending[which] >= 0:
            _remark(parts, pending[which], MOVE_LINE if which == 1 else TUBE_LINE)
            pending[which] = -1


@compiled
def _remark(parts: RowParts, line: int, what: int) -> None:
    at = parts.noted[0]
    if at < parts.remarks.shape[0]:
        parts.remarks[at, 0], parts.remarks[at, 1] = line, what
    parts.noted[0] += 1
