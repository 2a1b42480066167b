"""The state of a run from another process: of the controller that runs, else of its journal; and commands to it."""

from pathlib import Path

import numpy as np

from ilmek.errors import LoomError
from ilmek.io.command_channel import request
from ilmek.io.journal_folder import CHANNEL, journal_bytes, require_journal, running_process
from ilmek.loom.control.journal import RecordKind, read_journal
from ilmek.loom.control.packml import PackState, state_name
from ilmek.loom.operations import RowEnd
from ilmek.records import JsonObject
from ilmek.report import Json
from ilmek.units import BILLION, format_quantity


def run_status(folder: Path) -> dict[str, Json]:
    """The state of a run, SI: a snapshot where a controller runs, else what the journal has.

    Raises LoomError for a folder without a journal, and for a damaged one.
    """
    require_journal(folder)
    found = request(folder / CHANNEL, "status")
    process = running_process(folder)
    if found is not None:
        return {"running": True, "process": process, "journal": str(folder), **found}
    return {"running": process is not None, "process": process, "journal": str(folder), **_of_journal(folder)}


def give(folder: Path, command: str) -> None:
    """Give a command to the controller that runs. Raises LoomError where it refuses, and where none runs."""
    require_journal(folder)
    found = request(folder / CHANNEL, command)
    if found is None:
        raise LoomError(
            f"{command}: no controller runs with the journal {folder}", do="start it with `ilmek run` or `ilmek serve`"
        )
    if not found.get("ok"):
        raise LoomError(f"{command} is refused: {found.get('reason', '')}")


def status_in_words(found: JsonObject) -> list[tuple[str, str]]:
    """A state as names and values."""
    process = f"process {found['process']}" if found["running"] else "none runs"
    pairs = [("controller", process), ("state", str(found["state"]))]
    if "total" in found:
        pairs += [
            ("row", f"{found['row']:,} of {found['rows']:,}"),
            ("knots", f"{found['knots']:,} of {found['total']:,}, {found['uncertain']:,} uncertain"),
            ("loom's clock", format_quantity(found["time"], "h")),
        ]
    pairs += [("asks", str(one)) for one in found.get("requests", ())]
    return [*pairs, *(("alarm", str(one["cause"])) for one in found.get("alarms", ()))]


def _of_journal(folder: Path) -> dict[str, Json]:
    """What a journal states about its carpet; uncertain: the most knots that may be tied without a record."""
    content = journal_bytes(folder)
    found = read_journal(content)
    if found is None:
        return {"state": state_name(PackState.STOPPED), "knots": 0, "uncertain": 0}
    header, kinds = found.header, found.records["kind"]
    states = found.records[kinds == RecordKind.STATE]
    back = found.records[kinds == RecordKind.ROWS_BACK][-1:]
    ended = int(back["row"].sum())  # rows that an operator has left on the loom
    woven = found.records[int(np.flatnonzero(kinds == RecordKind.ROWS_BACK)[-1]) :] if len(back) else found.records
    knots = ended * header.columns + int(np.count_nonzero(woven["kind"] == RecordKind.KNOT))
    ends = woven["code"][woven["kind"] == RecordKind.ROW_END]
    ended += int(np.count_nonzero(ends == RowEnd.TAKE_UP))
    moving = len(states) > 0 and bool(states["flag"][-1])
    return {
        "state": state_name(PackState.COMPLETE if ended == header.rows else PackState.STOPPED),
        "row": min(header.rows, ended + 1),
        "rows": header.rows,
        "knots": knots,
        "total": header.rows * header.columns,
        "uncertain": header.heads + header.group - 1 if moving else 0,
        "time": int(found.records["time"].max(initial=0)) / BILLION,
        "programme": header.programme,
        "commit": header.group,
    }
