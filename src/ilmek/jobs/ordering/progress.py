"""How far a carpet is woven: by `ilmek call`, which remembers its row, or by the journal of the loom that weaves it."""

from datetime import date
from pathlib import Path

from ilmek.carpet.chart import Chart
from ilmek.errors import LoomError
from ilmek.io.call_state import DamagedStateError, chart_digest, read_state, state_file
from ilmek.io.carpet_record import read_record
from ilmek.io.journal_folder import JOURNAL
from ilmek.jobs.status import run_status
from ilmek.loom.control.packml import PackState, state_name
from ilmek.records import JsonObject, record


@record
class WovenRows:
    """Rows that are woven, the day on which the last of them was, ISO, and who counted them: call or journal."""

    rows: int
    day: str
    source: str

    def as_json(self) -> JsonObject:
        """As an entry of the record."""
        return {"rows": self.rows, "day": self.day, "source": self.source}


NOT_BEGUN = WovenRows(0, "", "")


def woven_rows(chart: Chart, run: Path | None) -> WovenRows:
    """The rows that are woven, by the journal in the folder of a run, else by a call of the chart.

    Raises LoomError for a folder without a journal, and for the run of another carpet.
    """
    if run is not None:
        return rows_of_run(run, chart.rows)[0]
    try:
        path = state_file(chart)
        state = read_state(path, chart.rows)
        return NOT_BEGUN if state is None or state.row < 2 else WovenRows(state.row - 1, _day(path), "call")
    except (OSError, DamagedStateError):
        return NOT_BEGUN


def rows_of_run(run: Path, rows: int) -> tuple[WovenRows, float]:
    """The rows that are woven by the journal in the folder of a run, and the loom's clock [s].

    rows  of the carpet
    Raises LoomError as `run_status`, and for the run of another carpet.
    """
    found = run_status(run)
    if found.get("rows", rows) != rows:
        given = f"the run in {run} weaves {found['rows']} rows, the carpet has {rows}"
        raise LoomError(given, do="give the run of this carpet")
    complete = found["state"] == state_name(PackState.COMPLETE)
    done = rows if complete else min(rows, int(str(found.get("row", 1)))) - 1
    woven = WovenRows(done, _day(run / JOURNAL), "journal") if done else NOT_BEGUN
    return woven, float(str(found.get("time", 0.0)))


def rows_by_day(woven: WovenRows, before: Path, chart: Chart) -> list[JsonObject]:
    """What the record of the same carpet that is replaced has of its rows, and what is woven since."""
    known: list[JsonObject] = []
    if before.is_file():
        found = read_record(before)[0]["record"]
        known = list(found.get("rows", ())) if found.get("design", {}).get("digest") == chart_digest(chart) else []
    last = known[-1]["rows"] if known else 0
    return [*known, woven.as_json()] if woven.rows > last else known


def _day(path: Path) -> str:
    return date.fromtimestamp(path.stat().st_mtime).isoformat()
