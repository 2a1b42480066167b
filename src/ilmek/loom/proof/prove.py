"""The proof of a programme: every rule on every operation, row by row, and its time by the rules of time.

The state between two rows is the position of each head, the tube aligned, the yarn and the knots left in each tube, and
the rows woven from each bobbin of weft.
"""

import math

import numpy as np

from ilmek.arrays import IntArray
from ilmek.errors import LoomError
from ilmek.loom.operations import (
    EMPTY,
    ROW_ENDS,
    WEFT_OF,
    LoomProgramme,
    LoomSetup,
    OperationTimes,
    RowEnd,
    RowOperations,
    Stop,
)
from ilmek.loom.proof.faults import FaultyPart, RuleFault, knot_faults, missing_knots
from ilmek.loom.proof.kernel import (
    CHANGES,
    IDLE,
    MOVED,
    NO_KNOT,
    ProofFindings,
    ProofRules,
    ProofState,
    ProofTable,
    begin_row,
    prove_phases,
)
from ilmek.progress import SILENT, Progress
from ilmek.records import record

MOST_FAULTS = 1000
"""Largest number of faults that are listed; all are counted."""

_ROUNDING = 1e-9
"""Relative rounding of a length of yarn: a package for exactly n knots gives n."""

_MOST_LEFT = 2**62
"""Knots left in a package that never ends."""

_NANO = 1_000_000_000

_END_NAMES = {
    RowEnd.STRAIGHT_WEFT: "straight weft",
    RowEnd.FIRST_BEAT: "first beat",
    RowEnd.SINUOUS_WEFT: "sinuous weft",
    RowEnd.SECOND_BEAT: "second beat",
    RowEnd.TAKE_UP: "take-up",
}


@record
class ProvedTotals:
    """Totals of a programme, recomputed from its operations.

    time     of the carpet without faults [ns]      knots         tied
    changes  of the tube aligned                    moved         knot pitches, from knot to knot within a row
    idle     pitches beyond the step of each knot   stops         in which packages are changed
    wefts    changes of bobbins of weft             packages      changes of packages of pile yarn
    """

    time: int
    knots: int
    changes: int
    moved: int
    idle: int
    stops: int
    wefts: int
    packages: int


@record
class Proof:
    """The outcome of a proof: the first MOST_FAULTS faults in the order of rows, the number of all, and the totals."""

    faults: tuple[RuleFault, ...]
    count: int
    totals: ProvedTotals

    @property
    def ok(self) -> bool:
        """Whether no rule is broken."""
        return self.count == 0


def prove(programme: LoomProgramme, progress: Progress = SILENT) -> Proof:
    """Prove a programme on its operations.

    Raises LoomError for a description that no loom can have, and as `programme.operations`.
    """
    _require_setup(programme.setup)
    prover = _Prover(programme.setup)
    for number in range(programme.setup.rows):
        prover.add(number, programme.operations(number), programme.chart_row(number))
        if number % 16 == 15:
            progress((number + 1) / programme.setup.rows)
    progress(1.0)
    return Proof(tuple(prover.faults), prover.count, prover.totals())


class _Prover:
    """Proves row after row."""

    def __init__(self, setup: LoomSetup) -> None:
        times, shape = setup.times, (setup.heads, setup.tubes)
        self.setup = setup
        self.faults: list[RuleFault] = []
        self.count = self.time = self.knots = self.stops = self.wefts = self.packages = 0
        self._rules = ProofRules(
            int(setup.spacing),
            *(nanoseconds(time) for time in (times.knot, times.colour_change, times.travel, times.row_ends[-1])),
        )
        self._state = ProofState(
            np.full(setup.heads, NO_KNOT, np.int64),
            np.full(setup.heads, NO_KNOT, np.int64),
            np.array(setup.loading, np.uint8),
            np.zeros(shape, np.int64),
            np.full(setup.columns, -1, np.int32),
            np.zeros((3, setup.heads), np.int64),
        )
        for head in range(setup.heads):
            for tube in range(setup.tubes):
                self._load(head, tube, int(setup.loading[head, tube]), float(setup.packages[head, tube]))
        self._rows_on = [0] * len(setup.wefts)
        self._found = ProofFindings(np.zeros((MOST_FAULTS, 6), np.int64), np.zeros(1, np.int64))

    def add(self, number: int, row: RowOperations, chart: IntArray) -> None:
        """Prove the next row."""
        if self._is_whole(number, row, chart):
            self._prove_knots(row, np.ascontiguousarray(chart))
        self._prove_ends(row)

    def totals(self) -> ProvedTotals:
        """The totals of the rows so far."""
        sums = self._state.sums.sum(axis=1).tolist()
        counted = (self.stops, self.wefts, self.packages)
        return ProvedTotals(self.time, self.knots, sums[CHANGES], sums[MOVED], sums[IDLE], *counted)

    def _is_whole(self, number: int, row: RowOperations, chart: IntArray) -> bool:
        """Whether the arrays of a row belong together; a row where they do not is proved no further."""
        knots, setup, tied = len(row.columns), self.setup, chart[chart != EMPTY]
        what = ""
        if row.number != number:
            what = f"is numbered {row.number + 1}, must be {number + 1}"
        elif row.heads != setup.heads or (row.counts < 0).any() or int(row.counts.sum()) != knots:
            what = f"has knots of {row.heads} heads, {int(row.counts.sum())} by its counts and {knots} in all"
        elif len(row.tubes) != knots or len(chart) != setup.columns:
            what = f"has {knots} knots, {len(row.tubes)} tubes and {len(chart)} knots of the chart"
        elif len(tied) != setup.knots_of(number):
            what = f"has {len(tied)} knots in its chart, must have {setup.knots_of(number)}"
        elif int(tied.max(initial=0)) >= len(setup.yarns):
            what = f"has yarn {int(tied.max()) + 1} in its chart, the list has yarns 1 to {len(setup.yarns)}"
        if what:
            self._note(RuleFault(number, FaultyPart.ROW, 0, f"the row {what}"))
        return not what

    def _prove_knots(self, row: RowOperations, chart: IntArray) -> None:
        offsets = np.zeros((row.heads, row.phases + 1), np.int64)
        np.cumsum(row.counts, axis=1, out=offsets[:, 1:])
        offsets += row.starts[:-1, None]
        columns, tubes = np.ascontiguousarray(row.columns, np.int32), np.ascontiguousarray(row.tubes, np.uint8)
        table = ProofTable(row.number, columns, tubes, offsets, np.ascontiguousarray(chart, np.uint8))
        begin_row(table, self._state, self._rules, self._found)
        begun = change = 0
        for stop in row.stops:
            phase = min(max(stop.phase, begun), row.phases)
            self.time += int(prove_phases(table, (begun, phase), self._state, self._rules, self._found))
            if stop.row != row.number or stop.phase != phase:
                what = f"a stop before phase {stop.phase + 1} of row {stop.row + 1} is not in the order of the row"
                self._note(RuleFault(row.number, FaultyPart.CHANGE, change, what))
            self._stop(row.number, stop, change)
            begun, change = phase, change + len(stop.wefts) + len(stop.tubes)
        self.time += int(prove_phases(table, (begun, row.phases), self._state, self._rules, self._found))
        self.knots += len(columns)
        self._take_faults(row)
        done = (self._state.tied == row.number) | (chart == EMPTY)
        if not done.all():
            for fault in missing_knots(row.number, done):
                self._note(fault)

    def _take_faults(self, row: RowOperations) -> None:
        count = int(self._found.total[0])
        if count:
            self._found.total[0] = 0
            listed = self._found.faults[: min(count, MOST_FAULTS)]
            self.count += count - len(listed)
            if len(self.faults) >= MOST_FAULTS:
                self.count += len(listed)
                return
            for fault in knot_faults(self.setup, row, listed):
                self._note(fault)

    def _stop(self, number: int, stop: Stop, index: int) -> None:
        """Change packages and bobbins; index: of the first change in the row."""
        setup, times = self.setup, self.setup.times
        for position, weft in enumerate(stop.wefts, index):
            what = "" if 0 <= weft < len(setup.wefts) else f"bobbin {weft + 1}: the loom has {len(setup.wefts)}"
            if weft in stop.wefts[: position - index]:
                what = f"bobbin {weft + 1} is changed twice in a stop"
            if what:
                self._note(RuleFault(number, FaultyPart.CHANGE, position, what))
                continue
            self._rows_on[weft] = 0
            self.time += nanoseconds(setup.wefts[weft].time)
        for position, change in enumerate(stop.tubes, index + len(stop.wefts)):
            self.time += nanoseconds(times.tube_change)
            what = self._refusal(change.head, change.tube, change.yarn, change.length)
            if what:
                self._note(RuleFault(number, FaultyPart.CHANGE, position, what))
            else:
                self._load(change.head, change.tube, change.yarn, change.length)
        self.stops += 1
        self.wefts += len(stop.wefts)
        self.packages += len(stop.tubes)

    def _refusal(self, head: int, tube: int, yarn: int, length: float) -> str:
        """Why a package cannot be put on a tube; "": it can."""
        setup = self.setup
        if not 0 <= head < setup.heads or not 0 <= tube < setup.tubes:
            return f"head {head + 1}, tube {tube + 1}: the loom has {setup.heads} heads of {setup.tubes} tubes"
        if not 0 <= yarn < len(setup.yarns):
            return f"yarn {yarn + 1}: the list has yarns 1 to {len(setup.yarns)}"
        return "" if 0 < length < math.inf else f"a package of {length:g} m: more than 0 m needed"

    def _load(self, head: int, tube: int, yarn: int, length: float) -> None:
        self._state.loading[head, tube] = yarn
        knots = 0.0 if yarn == EMPTY else length / self.setup.knot_yarn[yarn] * (1 + _ROUNDING)
        self._state.left[head, tube] = int(min(knots, _MOST_LEFT))

    def _prove_ends(self, row: RowOperations) -> None:
        """Prove the wefts, beats and take-up of a row."""
        if row.ends != ROW_ENDS:
            index = next(
                (at for at, pair in enumerate(zip(row.ends, ROW_ENDS, strict=False)) if pair[0] != pair[1]), -1
            )
            index = min(len(row.ends), len(ROW_ENDS)) if index < 0 else index
            needed = _END_NAMES[ROW_ENDS[index]] if index < len(ROW_ENDS) else "nothing more"
            part = (FaultyPart.END, index) if index < len(row.ends) else (FaultyPart.ROW, 0)
            given = _END_NAMES[RowEnd(row.ends[index])] if index < len(row.ends) else "nothing"
            self._note(RuleFault(row.number, *part, f"{given} at the end of the row, must be {needed}"))
        for index, end in enumerate(row.ends):
            if WEFT_OF.get(end, len(self._rows_on)) < len(self._rows_on):
                self._weave_weft(row.number, index, WEFT_OF[end])
        self.time += self._rules.row_end

    def _weave_weft(self, number: int, index: int, weft: int) -> None:
        self._rows_on[weft] += 1
        bobbin = self.setup.wefts[weft]
        if self._rows_on[weft] == bobbin.rows + 1:
            what = f"the bobbin of {bobbin.yarn} has ended: it lasts {bobbin.rows} rows, and is not changed after them"
            self._note(RuleFault(number, FaultyPart.END, index, what))

    def _note(self, fault: RuleFault) -> None:
        self.count += 1
        if len(self.faults) < MOST_FAULTS:
            self.faults.append(fault)


def nanoseconds(time: float) -> int:
    """A time [s] in whole nanoseconds."""
    return round(_NANO * time)


def _require_setup(setup: LoomSetup) -> None:
    """Raise LoomError for a description that no loom can have."""
    shape, yarns = (setup.heads, setup.tubes), len(setup.yarns)
    loaded = setup.loading[setup.loading != EMPTY]
    sound = {
        "sizes": min(setup.rows, setup.columns, setup.heads, setup.tubes, setup.spacing) >= 1,
        "loading": setup.loading.shape == shape and bool((loaded < yarns).all()),
        "packages": setup.packages.shape == shape and bool((np.isfinite(setup.packages) & (setup.packages >= 0)).all()),
        "yarn of a knot": len(setup.knot_yarn) == yarns and all(0 < one < math.inf for one in setup.knot_yarn),
        "times": _are_times(setup.times) and all(0 <= weft.time < math.inf for weft in setup.wefts),
    }
    for name, holds in sound.items():
        if not holds:
            raise LoomError(f"the programme's {name} cannot be those of a loom", allowed="as `ilmek weave` writes them")


def _are_times(times: OperationTimes) -> bool:
    ends = times.row_ends
    all_times = (times.knot, times.colour_change, times.travel, times.tube_change, *ends)
    return len(ends) == len(ROW_ENDS) and list(ends) == sorted(ends) and all(0 <= time < math.inf for time in all_times)
