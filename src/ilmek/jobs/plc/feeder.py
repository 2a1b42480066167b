"""The host of a PLC: gives the program the carpet and one row at a time, and compares both journals.

    beat      both sides count on; the program raises an alarm for a silent host, and the host ends for a silent program
    recipe    digest and size of the carpet, and the last row that the host gave
    row       when the program requests one, or refuses the one that it has: first into the journal, then to the PLC

A row is given only if it is the last one of the journal or the one behind it. Any other difference ends the host; the
program then stops with the alarm of a silent host.
"""

from collections.abc import Callable, Mapping
from typing import TypeAlias

from ilmek.errors import LoomError
from ilmek.io.plc.host_data import HostRow, digest_words, host_row
from ilmek.io.plc.sequence_variables import LAST_BEAT, NOT_ASIDE
from ilmek.jobs.plc.host_journal import HostJournal
from ilmek.loom.control.alarms import ALARMS, JournalFault
from ilmek.loom.control.packml import PackState
from ilmek.loom.control.sequence import ROWS_BACK
from ilmek.loom.operations import LoomProgramme

PlcValue: TypeAlias = bool | int | float | list[bool] | list[int]
PlcValues: TypeAlias = Mapping[str, PlcValue]
"""Values of variables of the program by their paths, as `RowData.Number`."""

SILENCE = 10.0
"""Time after which a program that does not count on is silent [s]."""

REQUEST = 1.0
"""Time for which a request for rows back stands, for all who look at it [s]."""

READ = ("PlcBeat", "RowRequest", "StateCurrent", "UnitModeCurrent", "Alarm", "KnotsDone", "CarpetDone",
        "RowData.Number")  # fmt: skip
"""What the host reads in each cycle."""

ARRAYS = ("Columns", "Tubes", "First", "Limits", "Aside", "StopBefore")
"""Arrays of `RowData`, of which the host reads the sizes."""


class HostError(LoomError):
    """The program and the host's journal differ, or the program is silent."""


class Feeder:
    """The host of one carpet.

    sizes  of the arrays of `RowData` in the program, by name      rows  a row of the programme as the host gives it
    """

    def __init__(
        self,
        programme: LoomProgramme,
        journal: HostJournal,
        sizes: Mapping[str, int],
        rows: Callable[[int], HostRow] | None = None,
    ) -> None:
        setup = programme.setup
        if sizes["Columns"] < setup.columns or sizes["First"] != setup.heads:
            raise LoomError(
                f"a PLC's program for {sizes['First']} heads and {sizes['Columns']} columns",
                allowed=f"{setup.heads} heads and at least {setup.columns} columns for this programme",
                do="write the program with `ilmek plc` for this programme or a larger one",
            )
        self.journal, self._setup, self._sizes = journal, setup, sizes
        self._digest = digest_words(programme.digest)
        self._rows = rows or (lambda number: host_row(programme, number))
        self._beat, self._given, self._refused = 0, -1, False
        self._counted: tuple[PlcValue, float] = (-1, 0.0)
        self._waits: float | None = None

    def step(self, now: float, plc: PlcValues) -> list[dict[str, PlcValue]]:
        """What the host writes, group after group. now: of its clock [s]; plc: the values of READ.

        Raises HostError.
        """
        self._heard(now, plc["PlcBeat"])
        request = whole(plc, "RowRequest")
        self._follow(now, request, whole(plc, "KnotsDone"))
        wanted, writes = self._wanted(request), list[dict[str, PlcValue]]()
        refused = plc["Alarm"] == ALARMS[JournalFault.ROW_DAMAGED].number
        lost = plc["RowData.Number"] != request or (refused and not self._refused)
        if wanted and (request != self._given or lost):
            if request != self.journal.row:
                self.journal.give(request)
            writes = self._row(request)
            self._given = request
        self._refused = refused
        self._beat = 0 if self._beat == LAST_BEAT else self._beat + 1
        back: dict[str, PlcValue] = {}
        if self.journal.awaited:
            first = self.journal.row
            knots = self._setup.knots_before(first)
            back = {"RowsBack": request - first, "RowsBackKnots": knots, "RowsBackRequest": True}
        return [{**self._recipe(), "RowsBackRequest": False, **back, "HostBeat": self._beat}, *writes]

    def take_out(self, rows: int, plc: PlcValues) -> None:
        """An operator has taken out the row in work and whole rows before it: the next steps tell the program.

        Raises LoomError in another state than Stopped, and for more rows than the take-up allows.
        """
        request = whole(plc, "RowRequest")
        if not 0 <= rows <= min(ROWS_BACK, request):
            raise LoomError(f"{rows} rows back in row {request + 1}", allowed=f"0 to {max(0, min(ROWS_BACK, request))}")
        if plc["StateCurrent"] != int(PackState.STOPPED):
            raise LoomError("rows back while the PLC is not in state Stopped", do="stop the loom first")
        self.journal.give(request - rows, awaited=True)
        self._given = -1

    def _follow(self, now: float, request: int, knots: int) -> None:
        """Rows were taken out: wait until the program is at the first of them. Raises HostError if it refuses."""
        row = self.journal.row
        if not self.journal.awaited:
            self._waits = None
            return
        since = self._waits = now if self._waits is None else self._waits
        if (request, knots) == (row, self._setup.knots_before(row)):
            if now - since >= REQUEST:
                self.journal.give(row)
        elif now - since > SILENCE:
            self.journal.give(request)
            raise HostError(
                f"the PLC does not weave {request - row} rows before row {request + 1} again",
                allowed="in state Stopped, whole rows since the last change of packages",
            )

    def _heard(self, now: float, beat: PlcValue) -> None:
        before, since = self._counted
        if beat != before or before == -1:
            self._counted = beat, now
        elif now - since > SILENCE:
            raise HostError(f"the PLC has not counted on for {SILENCE:g} s", do="check that its program runs")

    def _wanted(self, request: int) -> bool:
        """Whether the requested row is to be given."""
        row = self.journal.row
        if request < 0 or self.journal.awaited:
            return False
        if request not in (row, row + 1) or request >= self._setup.rows:
            raise HostError(
                f"the PLC requests row {request + 1}, and the host's journal gave row {row + 1} last",
                allowed=f"row {row + 1} or {row + 2}",
                do="look how far the carpet is woven; then --rows-back N, or --new with a carpet that is given up",
            )
        return True

    def _recipe(self) -> dict[str, PlcValue]:
        setup = self._setup
        return {
            "Recipe.Programme": list(self._digest), "Recipe.Rows": setup.rows, "Recipe.Columns": setup.columns,
            "Recipe.Tubes": setup.tubes, "Recipe.Row": self.journal.row,
        }  # fmt: skip

    def _row(self, number: int) -> list[dict[str, PlcValue]]:
        """The groups that give a row: no number, the row, its number."""
        row, sizes = self._rows(number), self._sizes
        phases = sizes["Limits"] // sizes["First"]
        if row.phases > phases:
            raise LoomError(f"row {number + 1} with {row.phases} phases", allowed=f"{phases} in this PLC's program")
        limits, aside = [0] * sizes["Limits"], [NOT_ASIDE] * sizes["Aside"]
        for whole_row, heads in ((limits, row.limits), (aside, row.aside)):
            for head, values in enumerate(heads):
                whole_row[head * phases : head * phases + len(values)] = values
        missing = [0] * (sizes["Columns"] - len(row.columns))
        content: dict[str, PlcValue] = {
            "Columns": row.columns + missing, "Tubes": row.tubes + missing, "First": row.first, "Limits": limits,
            "Aside": aside, "Before": row.before, "Knots": len(row.columns), "Phases": row.phases, "Check": row.check,
            "StopBefore": row.stop_before + [False] * (phases - row.phases),
        }  # fmt: skip
        return [
            {"RowData.Number": -1},
            {f"RowData.{name}": value for name, value in content.items()},
            {"RowData.Number": row.number},
        ]


def whole(plc: PlcValues, name: str) -> int:
    """A value that is a whole number."""
    value = plc[name]
    assert isinstance(value, int)
    return value
