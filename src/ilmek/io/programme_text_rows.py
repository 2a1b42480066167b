"""A row of the text form of a programme: its lines as operations, and operations as lines.

A `RowText` is read in two compiled passes: its lines are matched and their order is checked; then its knots are filled.
"""

import numpy as np

from ilmek.arrays import Int64, IntArray, UInt8
from ilmek.errors import IlmekError, LoomError, shortened
from ilmek.io import programme_line_reading as reading
from ilmek.io import programme_line_writing as writing
from ilmek.io.programme_line_reading import FIRST_END, RowParts, RowSizes
from ilmek.io.programme_rows import MOST_ENDS, MOST_MORE, MOST_PHASES
from ilmek.loom.operations import LONGEST_PACKAGE, LoomSetup, RowEnd, RowOperations, Stop, TubeChange
from ilmek.records import record

MOST_REMARKS = 100
"""Largest number of remarks on the lines of a row that are kept."""

_ALLOWED = "row, chart, stop, bobbin, package, phase, head, tube, move, tie, a weft, a beat, take-up, end"
_REMARKS = {
    reading.TUBE_LINE: "is not the change of tube before the next knot",
    reading.NO_TUBE_LINE: "needs a line `tube` before it: the head has another tube in line",
    reading.MOVE_LINE: "is not the move from the knot before to the next knot",
    reading.NO_MOVE_LINE: "needs a line `move` before it: the knot is not beside the one before",
    reading.KNOT_RANGE: "has a knot beyond the row",
    reading.TUBE_RANGE: "has a tube that the head does not have",
}


@record
class LineRemark:
    """A line that does not agree with the operations around it, or names a part that there is not."""

    line: int
    what: str


@record
class RowText:
    """A row read from its text, and the line of each of its parts.

    line     of the row itself, and `lines` their number
    ties     index of the first knot of each tie, and its line: (ties, 2), by knot
    changes  line of each change of a stop, in order      ends  line of each operation after the knots
    """

    row: RowOperations
    chart: UInt8[np.ndarray, " columns"]
    line: int
    lines: int
    ties: Int64[np.ndarray, "ties 2"]
    changes: tuple[int, ...]
    ends: tuple[int, ...]
    remarks: tuple[LineRemark, ...]


@record
class _RowLines:
    """The text of a row, the number of its first line in the file, and its lines as `match_lines` gives them."""

    data: bytes
    line: int
    table: Int64[np.ndarray, "lines 7"]

    def text(self, at: int) -> bytes:
        """A line, counted from 0."""
        return self.data[self.table[at, 5] : self.table[at, 6]]


class RowReader:
    """Reads the rows of a text one after the other.

    aligned  tube of each head's last knot, -1 before its first: what a line `tube` is compared with
    """

    def __init__(self, setup: LoomSetup) -> None:
        most = MOST_MORE * setup.columns
        self._setup = setup
        self._sizes = RowSizes(setup.columns, setup.heads, setup.tubes, len(setup.yarns), most)
        self._patterns = reading.pattern_table()
        self.aligned = np.full(setup.heads, -1, np.int64)

    def read(self, number: int, data: bytes, line: int) -> RowText:
        """Row `number` from its bytes, the first of which is of line `line` of the file.

        Raises LoomError "line N: ..." for text that is no row, or not this one.
        """
        text: UInt8[np.ndarray, " bytes"] = np.frombuffer(data, np.uint8)
        lines = _RowLines(data, line, np.empty((data.count(b"\n"), 7), np.int64))
        table = lines.table
        matched = int(reading.match_lines(text, *self._patterns, table))
        if matched < len(table):
            wrong = data.split(b"\n", matched + 1)[matched]
            raise _refused(line + matched, f"{_quoted(wrong)} is no line of a row", _ALLOWED)
        if table[0, 0] != reading.ROW or table[0, 1] != number + 1:
            raise _refused(line, _quoted(lines.text(0)), f"`row {number + 1}`: rows are in order, from the bottom edge")
        chart = np.empty(self._setup.columns, np.uint8)
        counts = np.zeros((self._setup.heads, MOST_PHASES), np.int64)
        phases, faulty, fault = reading.measure(text, table, self._sizes, chart, counts)
        if faulty >= 0:
            at = min(int(faulty), len(table) - 1)
            given = (
                f"{_quoted(lines.text(at))} cannot be here" if faulty < len(table) else f"row {number + 1} ends here"
            )
            raise _refused(line + at, given, self._needed(fault))
        return self._filled(number, lines, np.ascontiguousarray(counts[:, :phases]), chart)

    def _filled(
        self, number: int, found: "_RowLines", counts: IntArray, chart: UInt8[np.ndarray, " columns"]
    ) -> RowText:
        knots, kinds = int(counts.sum()), found.table[:, 0]
        ties = np.empty((np.count_nonzero((kinds == reading.TIE) | (kinds == reading.TIES)), 2), np.int64)
        noted = (np.empty((MOST_REMARKS, 2), np.int64), np.zeros(1, np.int64))
        parts = RowParts(np.empty(knots, np.int32), np.empty(knots, np.uint8), ties, *noted)
        reading.fill(found.table, self._sizes, counts, self.aligned, parts)
        remarks = [
            LineRemark(found.line + at, f"`{found.text(at).decode()}` {_REMARKS[what]}")
            for at, what in parts.remarks[: min(int(parts.noted[0]), MOST_REMARKS)].tolist()
        ]
        ties = ties[np.argsort(ties[:, 0], kind="stable")]
        ties[:, 1] += found.line
        stops, changes = self._stops(number, found, remarks)
        at_end = np.flatnonzero(kinds >= FIRST_END)
        ends = tuple(RowEnd(int(kinds[at]) - FIRST_END) for at in at_end)
        row = RowOperations(number, parts.columns, parts.tubes, counts, ends, stops)
        lines = (found.line, len(found.table))
        return RowText(row, chart, *lines, ties, changes, tuple((at_end + found.line).tolist()), tuple(remarks))

    def _stops(
        self, number: int, found: "_RowLines", remarks: list[LineRemark]
    ) -> tuple[tuple[Stop, ...], tuple[int, ...]]:
        """The stops of a row, and the line of each change in them; adds remarks on parts that there are not."""
        kinds, setup = found.table[:, 0], self._setup
        if not (kinds == reading.STOP).any():
            return (), ()
        stops: list[Stop] = []
        changes: list[int] = []
        wefts: list[int] = []
        tubes: list[TubeChange] = []
        stopped, phase = False, 0
        for at in np.flatnonzero((kinds >= reading.STOP) & (kinds <= reading.PHASE)).tolist():
            kind, one, two, three, rest, _, end = found.table[at].tolist()
            if kind == reading.PHASE:
                if stopped:
                    stops.append(Stop(number, phase, tuple(wefts), tuple(tubes)))
                phase, stopped, wefts, tubes = phase + 1, False, [], []
                continue
            if kind == reading.STOP:
                stopped = True
                continue
            known = one <= len(setup.wefts)
            if kind == reading.BOBBIN:
                wefts.append(one - 1)
            else:
                known = one <= setup.heads and two <= setup.tubes and three <= len(setup.yarns)
                tubes.append(TubeChange(one - 1, two - 1, three - 1, _length(found.data[rest:end], found.line + at)))
            changes.append(found.line + at)
            if not known:
                what = f"`{found.text(at).decode()}` names a part that the loom does not have"
                remarks.append(LineRemark(found.line + at, what))
        return tuple(stops), tuple(changes)

    def _needed(self, fault: int) -> str:
        """What is allowed instead of a faulty line."""
        setup = self._setup
        if fault == reading.WRONG_CHART:
            return f"the chart of a row has {setup.columns} knots of yarns 1 to {len(setup.yarns)}: `chart 12*3 4*1`"
        if fault == reading.TOO_MANY:
            return f"at most {MOST_MORE * setup.columns} knots in a row"
        return (
            f"chart, then for each phase (1, 2, ..., at most {MOST_PHASES}) a stop with its changes or none, and heads "
            f"1 to {setup.heads} in order, then at most {MOST_ENDS} wefts, beats and take-ups"
        )


def _length(text: bytes, line: int) -> float:
    """The length of a package: 250.0 m. Raises LoomError for another text."""
    number, blank, unit = text.decode("ascii", "replace").partition(" ")
    try:
        length = float(number) if (blank, unit) == (" ", "m") and "_" not in number else -1.0
    except ValueError:
        length = -1.0
    if not 0 <= length <= LONGEST_PACKAGE:
        raise _refused(line, f"a package of {_quoted(text)}", f"a length like 250.0 m, at most {LONGEST_PACKAGE:g} m")
    return length


def _quoted(data: bytes) -> str:
    return f"`{shortened(data.decode('utf-8', 'replace'))}`"


def _refused(line: int, given: str, allowed: str) -> IlmekError:
    return LoomError(f"line {line}: {given}", allowed=allowed, do="correct that line")


class RowWriter:
    """Writes rows one after the other as text."""

    def __init__(self, setup: LoomSetup) -> None:
        self._aligned = np.full(setup.heads, -1, np.int64)

    def text(self, row: RowOperations, chart: UInt8[np.ndarray, " columns"]) -> bytes:
        """The lines of a row. Raises LoomError for stops in an order that no text can have."""
        sizes = (32 * chart.size + 16, 64 * row.columns.size + 16 * row.counts.size + 16)
        out = np.empty(max(sizes), np.uint8)
        parts = [b"row %d\n" % (row.number + 1)]
        parts.append(out[: writing.write_chart(np.ascontiguousarray(chart), out)].tobytes())
        offsets = np.zeros((row.heads, row.phases + 1), np.int64)
        np.cumsum(row.counts, axis=1, out=offsets[:, 1:])
        offsets += row.starts[:-1, None]
        knots = (np.ascontiguousarray(row.columns), np.ascontiguousarray(row.tubes), offsets)
        column, stops = np.full(row.heads, -1, np.int64), list(row.stops)
        for phase in range(row.phases):
            if stops and stops[0].phase == phase:
                parts.append(_stop_text(stops.pop(0)))
            parts.append(out[: writing.write_phase(knots, phase, self._aligned, column, out)].tobytes())
        if stops or any(stop.row != row.number for stop in row.stops):
            raise LoomError(f"row {row.number + 1} has stops of another row, or not in the order of its phases")
        parts.extend(reading.PATTERNS[FIRST_END + end].encode() + b"\n" for end in row.ends)
        return b"".join(parts)


def _stop_text(stop: Stop) -> bytes:
    lines = ["stop", *(f"bobbin {weft + 1}" for weft in stop.wefts)]
    lines += [
        f"package head {tube.head + 1} tube {tube.tube + 1} yarn {tube.yarn + 1} of {tube.length!r} m"
        for tube in stop.tubes
    ]
    return "".join(f"{line}\n" for line in lines).encode()
