"""A recorded run is replayed on the simulated loom."""

from pathlib import Path

from ilmek.io.any_programme import open_any_programme
from ilmek.io.recording_file import read_recording
from ilmek.loom.control.ports import Done, Failed, Tie
from ilmek.loom.twin.recording import replay
from ilmek.progress import SILENT, Progress
from ilmek.records import value_record
from ilmek.report import Json
from ilmek.units import BILLION, format_quantity


@value_record
class ReplayResult:
    """A replayed run.

    begin, end  of the loom's clock [s]      inputs, reports  of the loom, and how many of these are failures
    knots       tied                         digest, recorded  of the reports, and by the recording
    """

    inputs: int
    reports: int
    failures: int
    knots: int
    begin: float
    end: float
    digest: str
    recorded: str

    @property
    def ok(self) -> bool:
        """Whether the run was the recorded one."""
        return self.digest == self.recorded

    def as_json(self) -> dict[str, Json]:
        """The result, SI."""
        return {
            "ok": self.ok,
            "inputs": self.inputs,
            "reports": self.reports,
            "failures": self.failures,
            "knots": self.knots,
            "begin": self.begin,
            "end": self.end,
            "digest": self.digest,
            "recorded": self.recorded,
        }

    def in_words(self) -> list[tuple[str, str]]:
        """The result as names and values."""
        other = "" if self.ok else "; recorded: " + self.recorded
        return [
            ("verdict", "the recorded run" if self.ok else "NOT the recorded run: changed, or of another version"),
            ("inputs", f"{self.inputs:,}"),
            ("reports", f"{self.reports:,}, {self.failures:,} failures"),
            ("knots", f"{self.knots:,}"),
            ("loom's clock", f"{format_quantity(self.begin, 'h')} to {format_quantity(self.end, 'h')}"),
            ("digest", self.digest + other),
        ]


def replay_run(recording: Path, programme: Path, progress: Progress = SILENT) -> ReplayResult:
    """Replay a recording. Raises LoomError for files that cannot be read, and as `loom.twin.recording.replay`."""
    found = read_recording(recording)
    with open_any_programme(programme, progress=progress.part(0.0, 0.5)) as opened:
        reports = failures = knots = 0
        span = max(found.end - found.start[0], 1) if found.start else 1
        for state, some in replay(found, opened):
            reports += len(some)
            failures += sum(isinstance(one, Failed) for one in some)
            knots += sum(isinstance(one, Done) and isinstance(one.order, Tie) for one in some)
            progress(0.5 + 0.5 * min(max((state.time - found.start[0]) / span, 0.0), 1.0))
    digest, begin = state.digest.hex(), found.start[0] / BILLION
    return ReplayResult(len(found.inputs), reports, failures, knots, begin, state.time / BILLION, digest, found.digest)
