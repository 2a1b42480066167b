"""The woven carpet beside its chart: knots that are missing, double or in another yarn, operations missing or double.

A row is behind the loom as soon as an operation after its knots was carried out, or a later row was begun: what it
lacks then is missing. What is not yet woven of the row in work and of those above it is still to come.

The digest of a carpet is the SHA-256 of the yarns of its knots, one byte each, row by row from the bottom edge and from
the left; EMPTY where there is no knot. A carpet without faults has the digest of its chart.
"""

import hashlib
from enum import StrEnum

import numpy as np

from ilmek.arrays import UInt8
from ilmek.errors import LoomError
from ilmek.loom.operations import EMPTY, ROW_ENDS, LoomProgramme, RowEnd
from ilmek.loom.twin.woven import Woven
from ilmek.progress import SILENT, Progress
from ilmek.records import record, value_record

MOST_POSITIONS = 1000
"""Faults of which the positions are stated; all are counted."""

_Row = UInt8[np.ndarray, " columns"]


class WovenFaultKind(StrEnum):
    """What is wrong with a knot."""

    MISSING = "missing"
    DOUBLE = "double"
    WRONG_YARN = "wrong yarn"


@value_record
class WovenFault:
    """A knot that is not as the chart has it: loom row and warp pair, both from 0.

    yarn   of the knot, EMPTY: none      expected  by the chart      times  that a knot was tied
    """

    kind: WovenFaultKind
    row: int
    column: int
    yarn: int
    expected: int
    times: int


@value_record
class EndFault:
    """An operation after the knots of a row that was not carried out once; times: how often it was."""

    row: int
    operation: RowEnd
    times: int


@record
class WovenResult:
    """A woven carpet beside its chart.

    knots     warp pairs with a knot                       total     knots of the carpet
    to_come   knots that can still be tied in order        rows      complete, with all their operations
    missing, double, wrong   knots                         ends      operations missing or double
    faults    the first of them, row by row                end_faults  likewise, at most MOST_POSITIONS
    digest    of the yarns, see the module
    """

    knots: int
    total: int
    to_come: int
    rows: int
    missing: int
    double: int
    wrong: int
    ends: int
    faults: tuple[WovenFault, ...]
    end_faults: tuple[EndFault, ...]
    digest: str

    @property
    def complete(self) -> bool:
        """Whether nothing is to come: every knot is tied, every operation carried out, once and as in the chart."""
        return self.knots == self.total and not self.wrong + self.double + self.missing + self.ends


def compare(woven: Woven, programme: LoomProgramme, progress: Progress = SILENT) -> WovenResult:
    """A woven carpet beside the chart of its programme. Raises LoomError for carpets of different sizes."""
    setup = programme.setup
    if (woven.rows, woven.columns) != (setup.rows, setup.columns):
        raise LoomError(
            f"a woven carpet of {woven.columns} x {woven.rows} knots", allowed=f"{setup.columns} x {setup.rows}"
        )
    found = _Found(_work_row(woven))
    for row in range(setup.rows):
        found.add(row, woven, programme.chart_row(row))
        progress((row + 1) / setup.rows)
    counted = found.counted
    return WovenResult(
        knots=found.knots,
        total=setup.knots,
        to_come=found.to_come,
        rows=found.rows,
        missing=counted[WovenFaultKind.MISSING],
        double=counted[WovenFaultKind.DOUBLE],
        wrong=counted[WovenFaultKind.WRONG_YARN],
        ends=found.ends,
        faults=tuple(found.faults),
        end_faults=tuple(found.end_faults),
        digest=found.digest.hexdigest(),
    )


def chart_digest(programme: LoomProgramme) -> str:
    """The digest of a carpet woven without faults."""
    found = hashlib.sha256()
    for row in range(programme.setup.rows):
        found.update(np.ascontiguousarray(programme.chart_row(row), np.uint8).tobytes())
    return found.hexdigest()


def _work_row(woven: Woven) -> int:
    """The row in work: the last one with a knot or an operation; 0 before the first."""
    for row in range(woven.rows - 1, -1, -1):
        if woven.counts(row).any() or woven.ends(row).any():
            return row
    return 0


class _Found:
    """What a comparison has found up to a row."""

    def __init__(self, work_row: int) -> None:
        self.work_row, self.digest = work_row, hashlib.sha256()
        self.knots = self.to_come = self.rows = self.ends = 0
        self.counted = dict.fromkeys(WovenFaultKind, 0)
        self.faults: list[WovenFault] = []
        self.end_faults: list[EndFault] = []

    def add(self, row: int, woven: Woven, expected: _Row) -> None:
        counts, yarns, ends = woven.counts(row), woven.yarns(row), woven.ends(row)
        self.digest.update(yarns.tobytes())
        behind = row < self.work_row or bool(ends.any())
        tied, bare = counts > 0, expected == EMPTY
        self.knots += int(np.count_nonzero(tied))
        self.rows += bool(np.all(ends >= 1) and np.all(tied | bare))
        if not behind:
            self.to_come += int(np.count_nonzero(~tied & ~bare))
        kinds = (
            (WovenFaultKind.MISSING, ~tied & ~bare & behind),
            (WovenFaultKind.DOUBLE, counts > 1),
            (WovenFaultKind.WRONG_YARN, tied & (yarns != expected)),
        )
        for kind, wrong in kinds:
            if wrong.any():
                self._note(kind, row, np.flatnonzero(wrong), (counts, yarns, expected))
        self._note_ends(row, ends)

    def _note(self, kind: WovenFaultKind, row: int, columns: np.ndarray, of: tuple[_Row, _Row, _Row]) -> None:
        self.counted[kind] += len(columns)
        counts, yarns, expected = of
        for column in columns[: MOST_POSITIONS - len(self.faults)].tolist():
            of_knot = int(yarns[column]), int(expected[column]), int(counts[column])
            self.faults.append(WovenFault(kind, row, column, *of_knot))

    def _note_ends(self, row: int, ends: _Row) -> None:
        """An operation is missing if a later one, or one of a later row, was carried out."""
        last = len(ROW_ENDS) if row < self.work_row else int(np.flatnonzero(ends)[-1]) if ends.any() else 0
        for operation, times in zip(ROW_ENDS, ends.tolist(), strict=True):
            if times > 1 or (times == 0 and operation < last):
                self.ends += 1
                if len(self.end_faults) < MOST_POSITIONS:
                    self.end_faults.append(EndFault(row, operation, times))
