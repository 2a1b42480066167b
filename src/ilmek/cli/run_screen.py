"""The screen of `ilmek run`: state, row, heads with their yarns, alarms with their remedies, time left."""

from collections import deque
from collections.abc import Sequence

from rich import box
from rich.console import Console, Group, RenderableType
from rich.live import Live
from rich.progress_bar import ProgressBar
from rich.style import Style
from rich.table import Table
from rich.text import Text

from ilmek.carpet.yarn import Yarn
from ilmek.errors import printable, shortened
from ilmek.loom.control.view import AlarmView, HeadView, Snapshot
from ilmek.units import BILLION

FRAMES = 10.0
"""Pictures a second."""

_LATELY = 50
"""Pictures over which the speed is taken."""

MOST_HEADS, MOST_ALARMS = 24, 4
"""Largest numbers of heads and of alarms that are shown."""

_STYLES = {"Execute": "green", "Complete": "green", "Held": "yellow", "Suspended": "yellow", "Aborted": "red"}


class RunScreen:
    """The screen while a run goes on, on the terminal of a console."""

    def __init__(self, console: Console, yarns: Sequence[Yarn], hint: str) -> None:
        self._yarns, self._hint = yarns, hint
        self._live = Live(console=console, auto_refresh=False, transient=True)
        self._due = 0.0
        self._points: deque[tuple[float, int]] = deque(maxlen=_LATELY)

    def show(self, snapshot: Snapshot, now: float) -> None:
        """Draw a snapshot, if the last picture is old enough; now: time of a clock of the caller [s]."""
        if now >= self._due:
            self._due = now + 1 / FRAMES
            self._points.append((now, snapshot.knots))
            self._live.update(drawn(snapshot, self._yarns, self._hint, self._left(snapshot)), refresh=True)

    def _left(self, snapshot: Snapshot) -> str:
        """The time that is left of the person's clock, at the speed of the last seconds; "" while it is unknown."""
        (begin, before), (end, after) = self._points[0], self._points[-1]
        if after <= before or end <= begin:
            return ""
        return f"; here {clock_in_words(int(BILLION * (snapshot.total - after) * (end - begin) / (after - before)))}"

    def __enter__(self) -> "RunScreen":
        self._live.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._live.stop()


def drawn(snapshot: Snapshot, yarns: Sequence[Yarn], hint: str, left: str = "") -> RenderableType:
    """The picture of a snapshot; left: time that is left of the person's clock, in words."""
    bar = Table.grid()
    bar.add_row(ProgressBar(snapshot.total, snapshot.knots, width=60))
    parts: list[RenderableType] = [_headline(snapshot), bar, Text(_times(snapshot, left))]
    if snapshot.stop:
        parts.append(Text(f"change: {printable(snapshot.stop)}", style="yellow"))
    parts += [
        Text(f"? {printable(request)} `ilmek resume --answer yes|no`", style="yellow")
        for request in snapshot.requests[:1]
    ]
    parts.append(_heads(snapshot.heads, yarns))
    parts += [_alarm(alarm) for alarm in snapshot.alarms[:MOST_ALARMS]]
    if hidden := len(snapshot.alarms) - MOST_ALARMS:
        parts += [Text(f"… {hidden} more alarms")] if hidden > 0 else []
    if any(alarm.stops for alarm in snapshot.alarms):
        parts.append(Text("when the cause is removed, `ilmek resume` acknowledges the alarms and goes on"))
    parts.append(Text(printable(hint), style="dim"))
    return Group(*parts)


def clock_in_words(nanoseconds: int) -> str:
    """A time of the loom's clock.

    >>> clock_in_words(90_061_000_000_000), clock_in_words(61_500_000_000)
    ('25 h 1 min', '1 min 1 s')
    """
    seconds = nanoseconds // BILLION
    if seconds >= 3600:
        return f"{seconds // 3600:,} h {seconds % 3600 // 60} min"
    return f"{seconds // 60} min {seconds % 60} s" if seconds >= 60 else f"{seconds} s"


def _headline(snapshot: Snapshot) -> Text:
    row, knots = f"row {snapshot.row + 1:,} of {snapshot.rows:,}", f"knot {snapshot.knots:,} of {snapshot.total:,}"
    text = Text(snapshot.state, style=f"bold {_STYLES.get(snapshot.state, '')}".strip())
    return text.append(f"   {row}   {knots}   {snapshot.knots / snapshot.total:.1%}", style="default")


def _times(snapshot: Snapshot, here: str) -> str:
    speed = f"{60 * snapshot.speed:.0f} knots/min" if snapshot.speed else "stands"
    faults = f"   faults mended {snapshot.faults:,}" if snapshot.faults else ""
    time, left = clock_in_words(snapshot.time), clock_in_words(snapshot.left)
    return f"loom's clock {time}   left about {left}{here}   {speed}{faults}"


def _heads(heads: Sequence[HeadView], yarns: Sequence[Yarn]) -> RenderableType:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for heading in ("head", "warp pair", "tube"):
        table.add_column(heading, justify="right")
    table.add_column("yarn")
    table.add_column("of the row", justify="right")
    table.add_column("next")
    for number, head in enumerate(heads[:MOST_HEADS], 1):
        table.add_row(
            str(number),
            "" if head.column is None else f"{head.column + 1:,}",
            "" if head.tube is None else str(head.tube + 1),
            _yarn(head.yarn, yarns),
            f"{head.tied:,} / {head.knots:,}",
            _yarn(head.next_yarn, yarns),
        )
    if len(heads) > MOST_HEADS:
        table.add_row("…", f"{len(heads) - MOST_HEADS:,} more")
    return table


def _yarn(index: int | None, yarns: Sequence[Yarn]) -> Text:
    if index is None:
        return Text("")
    yarn = yarns[index]
    text = Text("  ", style=Style(bgcolor="rgb({},{},{})".format(*yarn.srgb)))
    name = shortened(" ".join(printable(yarn.name).split()), 24)
    return text.append(f" {name}", style=Style(bgcolor="default"))


def _alarm(alarm: AlarmView) -> Text:
    return Text(f"! {printable(alarm.cause)}", style="bold red" if alarm.stops else "yellow")
