"""Progress and cancellation of long work.

Long work takes a `Progress` and calls it with the completed share; parts of the work get parts of it. The caller
receives the stage and the share of the whole job. After a cancellation by the caller the next call raises `Cancelled`,
and the work ends as after any other error, so that no file is left incomplete.
"""

from collections.abc import Callable
from dataclasses import dataclass, fields, replace


class Cancelled(Exception):
    """The work was cancelled by its caller.

    >>> Progress(cancelled=lambda: True, stage="chart")(0.5)
    Traceback (most recent call last):
    ...
    ilmek.progress.Cancelled: chart: cancelled
    """


@dataclass(frozen=True, slots=True)
class Progress:
    """Receiver of the progress of work. The default reports nothing and is never cancelled.

    report         called with the stage and the completed share of the whole job, 0 to 1; default: nothing is
    cancelled      whether the work must end, for example `threading.Event().is_set`; default: never
    stage          name of the present stage
    begin, finish  shares of the whole job at the begin and end of this work

    >>> whole = Progress(lambda stage, share: print(stage, share))
    >>> chart = whole.part(0.25, 0.75, "chart")
    chart 0.25
    >>> chart(0.5)
    chart 0.5
    >>> Progress(cancelled=lambda: True)(0.5)
    Traceback (most recent call last):
    ...
    ilmek.progress.Cancelled: cancelled
    """

    report: Callable[[str, float], object] | None = None
    cancelled: Callable[[], bool] | None = None
    stage: str = ""
    begin: float = 0.0
    finish: float = 1.0

    def __repr__(self) -> str:
        """Only the fields that differ from their defaults; functions by their names."""
        values = {entry.name: getattr(self, entry.name) for entry in fields(self)}
        changed = [entry.name for entry in fields(self) if values[entry.name] != entry.default]
        shown = (f"{name}={getattr(values[name], '__name__', repr(values[name]))}" for name in changed)
        return f"Progress({', '.join(shown)})"

    def __call__(self, share: float) -> None:
        """Report the completed share of this work, 0 to 1. Raises Cancelled."""
        if self.cancelled is not None and self.cancelled():
            raise Cancelled(f"{self.stage}: cancelled" if self.stage else "cancelled")
        if self.report is not None:
            self.report(self.stage, self.begin + share * (self.finish - self.begin))

    def part(self, begin: float, finish: float, stage: str = "") -> "Progress":
        """The progress of the part of this work between two shares, from now on. Raises Cancelled.

        stage  name of the stage; default: the stage of the whole
        """
        length = self.finish - self.begin
        begun = replace(
            self,
            stage=stage or self.stage,
            begin=self.begin + begin * length,
            finish=self.begin + finish * length,
        )
        begun(0.0)
        return begun


SILENT = Progress()
"""Reports nothing and is never cancelled."""
