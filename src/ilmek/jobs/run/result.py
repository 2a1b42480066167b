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
            "faulty": [
                {"row": fault.row + 1, "column": fault.column + 1, "fault": fault.kind} for fault in found.faults
            ],
            "time": now.time / BILLION,
            "repairs": now.faults,
            "begun": self.begun,
            "programme": now.programme,
            "journal": self.journal,
            "alarms": [{"name": alarm.name, "cause": alarm.cause, "remedy": alarm.remedy} for alarm in now.alarms],
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
            *(("alarm", alarm.cause) for alarm in now.alarms),
        ]


def snapshot_json(snapshot: Snapshot, setup: LoomSetup) -> dict[str, Json]:
    """A snapshot as JSON, SI; rows, warp pairs, heads and tubes count from 1, yarns are names."""
    names = [yarn.name for yarn in setup.yarns]

    def named(index: int | None) -> str | None:
        return None if index is None else names[index]

    def counted(index: int | None) -> int | None:
        return None if index is None else index + 1

    found = asdict(snapshot)
    found |= {"time": snapshot.time / BILLION, "left": snapshot.left / BILLION, "row": snapshot.row + 1}
    found["heads"] = [
        {
            "column": counted(head.column),
            "tube": counted(head.tube),
            "yarn": named(head.yarn),
            "tied": head.tied,
            "knots": head.knots,
            "next_yarn": named(head.next_yarn),
        }
        for head in snapshot.heads
    ]
    found["alarms"] = [{**asdict(alarm), "time": alarm.time / BILLION} for alarm in snapshot.alarms]
    found["yarns"] = [
        {"head": yarn.head + 1, "tube": yarn.tube + 1, "yarn": names[yarn.yarn], "left": yarn.left}
        for yarn in snapshot.yarns
    ]
    return found
