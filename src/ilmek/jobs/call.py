"""Calling of a chart row by row: where it begins, its steps, and what is remembered."""

from dataclasses import dataclass, field
from pathlib import Path

from ilmek.carpet.calling import CallStep, row_steps
from ilmek.carpet.chart import Chart
from ilmek.errors import ParameterError
from ilmek.io.call_state import CallState, DamagedStateError, read_state, state_file, write_state
from ilmek.sentences import Sentence

DIRECTIONS = ("right", "left", "alternate")


@dataclass(slots=True, eq=False)
class Calling:
    """A chart that is called.

    chart      the chart             row   that is called, from 1; one more than the rows where all are done
    by         runs or colours       step  of the row, from 0
    direction  right, left or alternate
    notes      what the weaver must know of the begin
    """

    chart: Chart
    by: str
    direction: str
    row: int = 1
    step: int = 0
    notes: list[str] = field(default_factory=list)
    _file: Path | None = None
    _row_steps: tuple[int, tuple[CallStep, ...]] = (0, ())

    @property
    def done(self) -> bool:
        """Whether all rows are called."""
        return self.row > self.chart.rows

    @property
    def steps(self) -> tuple[CallStep, ...]:
        """The steps of the present row."""
        if self._row_steps[0] != self.row:
            self._row_steps = self.row, row_steps(self.chart, self.row, self.by, self.direction)
        return self._row_steps[1]

    def forward(self) -> None:
        """Go to the next step; after the last one of a row to the next row."""
        if not self.done:
            self.step += 1
            if self.step >= len(self.steps):
                self.row, self.step = self.row + 1, 0

    def back(self) -> None:
        """Go to the step before, of the row before where it is the first."""
        if self.step:
            self.step -= 1
        elif self.row > 1:
            self.row -= 1
            self.step = len(self.steps) - 1

    def next_row(self) -> None:
        """Go to the first step of the next row."""
        if not self.done:
            self.row, self.step = self.row + 1, 0

    def row_before(self) -> None:
        """Go to the first step of the row, or of the row before if it is there."""
        if not self.step and self.row > 1:
            self.row -= 1
        self.step = 0

    def remember(self) -> None:
        """Keep where the call is. Where this is not possible, a note says so, once."""
        if self._file is None:
            return
        try:
            write_state(self._file, CallState(self.row, self.step, self.by, self.direction))
        except OSError as error:
            self.notes.append(f"{self._file.parent} cannot be written ({error.strerror}): the row is not remembered")
            self._file = None


def begin_calling(chart: Chart, by: str, direction: str, from_row: int | None = None, *, keep: bool = True) -> Calling:
    """A call from a row, default: from where the last one of this chart stopped, else from row 1.

    keep  remember where it stops
    Raises ParameterError for a row that is not in the chart.
    """
    if from_row is not None and not 1 <= from_row <= chart.rows:
        raise ParameterError(f"--from-row {from_row}", allowed=f"rows 1 to {chart.rows}, from the lower edge")
    calling = Calling(chart, by, direction, from_row or 1)
    if not keep:
        return calling
    try:
        calling._file = state_file(chart)
        state = read_state(calling._file, chart.rows)
    except OSError as error:
        calling._file = None
        calling.notes.append(f"the row is not remembered: {error.strerror or error}")
        return calling
    except DamagedStateError:
        if from_row is None:
            calling.notes.append(f"{calling._file} is damaged: the call begins with row 1")
        return calling
    if from_row is None and state is not None:
        _resume(calling, state)
    return calling


def _resume(calling: Calling, state: CallState) -> None:
    """Go to where a call of the chart stopped."""
    if state.row > calling.chart.rows:
        calling.notes.append(Sentence("call.again"))
        return
    calling.row = state.row
    if (state.by, state.direction) == (calling.by, calling.direction) and state.step < len(calling.steps):
        calling.step = state.step
    if (calling.row, calling.step) != (1, 0):
        calling.notes.append(Sentence("call.goes-on", row=calling.row, step=calling.step + 1))
