"""The order of a carpet's operations: which are done, and which may begin now.

Heads tie their knots of a phase freely and wait for each other at its end; stops and the operations after the knots
come one at a time. A row's operations are read once.
"""

from itertools import pairwise

from ilmek.errors import LoomError
from ilmek.loom.control.exchange import Operation
from ilmek.loom.control.ports import ChangePackages, EndRow, StandAside, Tie
from ilmek.loom.operations import LoomProgramme, RowEnd, Stop
from ilmek.loom.standing import asides

ROWS_BACK = 20
"""Most whole rows that are taken out at once: a length of carpet that is still before the cloth beam (assumed)."""

LOOM = -1
"""Key of an operation of the whole loom, where a head's is its number."""


def key_of(operation: Operation | StandAside) -> int:
    """Who carries an operation out: the number of the head, or LOOM."""
    return operation.head if isinstance(operation, Tie | StandAside) else LOOM


class RowWork:
    """The operations of a row as plain lists: of each head its columns and tubes, of each phase where heads end it.

    aside  of each phase, where the heads stand that tie no knot in it
    """

    __slots__ = ("aside", "columns", "ends", "limits", "stops", "tubes")

    def __init__(self, programme: LoomProgramme, number: int) -> None:
        row = programme.operations(number)
        starts = row.starts.tolist()
        columns, tubes = row.columns.tolist(), row.tubes.tolist()
        self.columns = [columns[begin:end] for begin, end in pairwise(starts)]
        self.tubes = [tubes[begin:end] for begin, end in pairwise(starts)]
        self.limits: list[list[int]] = row.counts.cumsum(axis=1).T.tolist()
        self.ends: tuple[RowEnd, ...] = row.ends
        self.stops: tuple[Stop, ...] = row.stops
        self.aside = asides(row, programme.setup.columns)


class Sequence:
    """The position in a programme: everything before it is in the carpet.

    row, phase  in work            upcoming  number of each head's next knot in the row
    stops_done, ends_done          of the row
    aside       heads that are still to stand aside in the phase, and where
    stop_row                       first row that needs nothing but the packages of the last stop
    """

    __slots__ = ("_left", "_programme", "_work", "aside", "ends_done", "phase", "row", "stop_row", "stops_done",
                 "upcoming")  # fmt: skip

    def __init__(self, programme: LoomProgramme, row: int = 0, stop_row: int = 0) -> None:
        self._programme, self.stop_row = programme, stop_row
        self._begin(row)

    def copy(self) -> "Sequence":
        """The same position, to be moved on by itself."""
        made = Sequence.__new__(Sequence)
        for name in Sequence.__slots__:
            setattr(made, name, getattr(self, name))
        made.upcoming, made.aside = self.upcoming.copy(), self.aside.copy()
        return made

    def position(self) -> tuple[int, ...]:
        """The position as numbers: equal for equal positions of one programme."""
        return (self.row, self.phase, self.stops_done, self.ends_done, *self.upcoming)

    @property
    def finished(self) -> bool:
        """Whether the carpet is woven."""
        return self.row >= self._programme.setup.rows

    @property
    def knots(self) -> int:
        """Knots in the carpet."""
        return self._programme.setup.knots_before(self.row) + sum(self.upcoming)

    def of_head(self, head: int) -> Tie | None:
        """The knot that a head ties next in this phase; None: it waits for the others, or for the loom."""
        if not self._left or self._stop() is not None:
            return None
        number, work = self.upcoming[head], self._work
        if number >= work.limits[self.phase][head]:
            return None
        return Tie(head, self.row, number, work.columns[head][number], work.tubes[head][number])

    def stand_aside(self, head: int) -> StandAside | None:
        """The move of a head without a knot in this phase, out of the reach of the others."""
        if head not in self.aside or not self._left or self._stop() is not None:
            return None
        return StandAside(head, self.row, self.phase, self.aside[head])

    def stood(self, order: StandAside) -> None:
        """A head stands aside; of a phase that is over it does not matter."""
        if order == self.stand_aside(order.head):
            del self.aside[order.head]

    def of_loom(self) -> EndRow | ChangePackages | None:
        """The operation of the whole loom that is next; None: the heads tie, or the carpet is woven."""
        stop = self._stop()
        if stop is not None:
            return ChangePackages(stop)
        if self._left or self.finished:
            return None
        return EndRow(self.row, self._work.ends[self.ends_done])

    def frontier(self) -> tuple[Operation, ...]:
        """All operations that may begin now."""
        whole = self.of_loom()
        if whole is not None:
            return (whole,)
        if self.finished:
            return ()
        found = (self.of_head(head) for head in range(len(self.upcoming)))
        return tuple(one for one in found if one is not None)

    def upcoming_of(self, head: int, most: int) -> tuple[tuple[int, int], ...]:
        """The next knots of a head in this row, as (column, tube)."""
        if self.finished:
            return ()
        begin = self.upcoming[head]
        columns, tubes = self._work.columns[head], self._work.tubes[head]
        return tuple(zip(columns[begin : begin + most], tubes[begin : begin + most], strict=True))

    def done(self, operation: Operation) -> bool:
        """An operation of the frontier is in the carpet. Whether all heads have waited for it, or now do.

        Raises LoomError for an operation that is not in the frontier.
        """
        if isinstance(operation, Tie):
            if operation != self.of_head(operation.head):
                raise LoomError(f"{operation!r} is not the next knot of its head")
            self.upcoming[operation.head] += 1
            self._left -= 1
            if self._left:
                return False
        elif operation != self.of_loom():
            raise LoomError(f"{operation!r} is not the next operation of the loom")
        elif isinstance(operation, ChangePackages):
            self.stops_done += 1
            self.stop_row = operation.stop.row + (operation.stop.phase > 0)
        else:
            self.ends_done += 1
        self._advance()
        return True

    @property
    def most_back(self) -> int:
        """Whole rows that may be taken out before the row in work; -1: not even that row.

        Not beyond the last change of packages: the rows before it need the packages that were taken off.
        """
        return -1 if self.row < self.stop_row else min(ROWS_BACK, self.row - self.stop_row)

    def take_out(self, rows: int) -> None:
        """The row in work and whole rows before it were taken out. Raises LoomError for more than `most_back`."""
        if not 0 <= rows <= self.most_back:
            raise LoomError(f"{rows} rows back", allowed=f"up to {self.most_back}")
        self._begin(self.row - rows)

    def _stop(self) -> Stop | None:
        if self.finished or self.stops_done >= len(self._work.stops):
            return None
        stop = self._work.stops[self.stops_done]
        return stop if stop.phase <= self.phase else None

    def _begin(self, row: int) -> None:
        self.row, self.phase, self.stops_done, self.ends_done = row, 0, 0, 0
        heads = self._programme.setup.heads
        self.upcoming, self._left, self.aside = [0] * heads, 0, {}
        if row < self._programme.setup.rows:
            self._work = RowWork(self._programme, row)
            self._left, self.aside = sum(self._work.limits[0]), self._work.aside[0].copy()
            self._advance()

    def _advance(self) -> None:
        """To the next phase with knots or a stop, to the operations after the knots, or to the next row."""
        work = self._work
        while not self._left and self._stop() is None and self.phase + 1 < len(work.limits):
            before = sum(work.limits[self.phase])
            self.phase += 1
            self._left, self.aside = sum(work.limits[self.phase]) - before, work.aside[self.phase].copy()
        if not self._left and self._stop() is None and self.ends_done >= len(work.ends):
            self._begin(self.row + 1)
