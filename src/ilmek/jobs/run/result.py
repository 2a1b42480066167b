"""What came of a run: the carpet compared with its chart, the controller's state; as texts and as JSON."""

from dataclasses import asdict

from ilmek.loom.control.view import Snapshot
from ilmek.loom.operations import LoomSetup
from ilmek.loom.twin.comparison import WovenResult
from ilmek.records import record
from ilmek.report import Json
from ilmek.units import BILLION, format_quantity

COMPLETE = "Complete"


@record
class RunResult:
    """A run at its end.

    snapshot  of the controller                                state    "Complete" when all is woven
    begun     certain knots when the run began                 journal  its folder
    woven     the carpet beside its chart
    """

    snapshot: Snapshot
    state: str
    begun: int
    woven: WovenResult
    journal: str

    @property
    def ok(self) -> bool:
        """Whether the carpet is complete and every knot is that of the chart, once."""
        return self.state == COMPLETE and self.woven.complete

    @property
    def faults(self) -> int:
        """Knots that are missing, double or in a wrong yarn."""
        return self.woven.missing + self.woven.double + self.woven.wrong

    def as_json(self) -> dict[str, Json]:
        """The result, SI; rows and warp pairs count from 1, rows from the bottom edge."""
        now, found = self.snapshot, self.woven
        return {
            "state": self.state,
            "knots": now.knots,
            "total": now.total,
            "digest": found.digest,
            "faults": self.faults,
            "missing": found.missing,
            "double": found.double,
            "wrong": found.wrong,
            "row_end_faults": found.ends,
            "faulty": [{"row": one.row + 1, "column": one.column + 1, "fault": one.kind} for one in found.faults],
            "time": now.time / BILLION,
            "repairs": now.faults,
            "begun": self.begun,
            "programme": now.programme,
            "journal": self.journal,
            "alarms": [{"name": one.name, "cause": one.cause, "remedy": one.remedy} for one in now.alarms],
        }

    def in_words(self) -> list[tuple[str, str]]:
        """The result as names and values."""
        now, found = self.snapshot, self.woven
        equal = "equal to the chart"
        if self.faults or found.ends:
            equal = f"{found.missing:,} missing, {found.double:,} tied twice, {found.wrong:,} in a wrong yarn, "
            equal += f"{found.ends:,} wefts, beats or take-ups missing or double"
        return [
            ("state", self.state),
            ("knots", f"{now.knots:,} of {now.total:,}, {equal}"),
            ("loom's clock", format_quantity(now.time / BILLION, "h")),
            ("repairs", f"{now.faults:,}"),
            ("digest", found.digest),
            ("journal", self.journal),
            *(("alarm", one.cause) for one in now.alarms),
        ]


def snapshot_json(snapshot: Snapshot, setup: LoomSetup) -> dict[str, Json]:
    """A snapshot as JSON, SI; rows, warp pairs, heads and tubes count from 1, yarns are names."""
    names = [one.name for one in setup.yarns]

    def named(index: int | None) -> str | None:
        return None if index is None else names[index]

    def counted(index: int | None) -> int | None:
        return None if index is None else index + 1

    found = asdict(snapshot)
    found |= {"time": snapshot.time / BILLION, "left": snapshot.left / BILLION, "row": snapshot.row + 1}
    found["heads"] = [
        {
            "column": counted(one.column),
            "tube": counted(one.tube),
            "yarn": named(one.yarn),
            "tied": one.tied,
            "knots": one.knots,
            "next_yarn": named(one.next_yarn),
        }
        for one in snapshot.heads
    ]
    found["alarms"] = [{**asdict(one), "time": one.time / BILLION} for one in snapshot.alarms]
    found["yarns"] = [
        {"head": one.head + 1, "tube": one.tube + 1, "yarn": names[one.yarn], "left": one.left}
        for one in snapshot.yarns
    ]
    return found
