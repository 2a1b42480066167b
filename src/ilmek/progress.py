"""Progress and cancellation of long work.

Long work takes a `Progress` and calls it with the completed share; parts of the work get parts of it. The caller
receives the stage and the share of the whole job. After a cancellation by the caller the next call raises `Cancelled`,
and the work ends as after any other error, so that no file is left incomplete.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace


class Cancelled(Exception):
    """The work was cancelled by its caller."""


@dataclass(frozen=True, slots=True)
class Progress:
    """Receiver of the progress of work. The default reports nothing and is never cancelled.

    report         called with the stage and the completed share of the whole job, 0 to 1
    cancelled      whether the work must end, for example `threading.Event().is_set`
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

    report: Callable[[str, float], object] = lambda stage, share: None  # noqa: ARG005 - names of the signature
    cancelled: Callable[[], bool] = lambda: False
    stage: str = ""
    begin: float = 0.0
    finish: float = 1.0

    def __call__(self, share: float) -> None:
        """Report the completed share of this work, 0 to 1. Raises Cancelled."""
        if self.cancelled():
            raise Cancelled(f"{self.stage}: cancelled" if self.stage else "cancelled")
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
