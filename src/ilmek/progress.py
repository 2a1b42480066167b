"""Progress of long work, and its end before time.

Long work takes a `Progress` and calls it with the share that is done; a part of the work is given a part of it. The
caller hears the stage and the share of the whole job. Between two calls the caller can cancel: the next one raises
`Cancelled`, and the work unwinds as after any other error, so that no file is left half-written.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace


class Cancelled(Exception):
    """The work was cancelled by its caller."""


@dataclass(frozen=True, slots=True)
class Progress:
    """Where work reports how far it is. The default reports nothing and is never cancelled.

    report         called with the stage and the share of the whole job that is done, 0 to 1
    cancelled      whether the work is to end, like `threading.Event().is_set`
    stage          what is being done
    begin, finish  shares of the whole job between which this work lies

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
        """Report the share of this work that is done, 0 to 1. Raises Cancelled."""
        if self.cancelled():
            raise Cancelled(f"{self.stage}: cancelled" if self.stage else "cancelled")
        self.report(self.stage, self.begin + share * (self.finish - self.begin))

    def part(self, begin: float, finish: float, stage: str = "") -> "Progress":
        """The progress of the part of this work between two shares, which begins now. Raises Cancelled.

        stage  what is being done; default: the stage of the whole
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
