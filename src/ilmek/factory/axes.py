"""The axes of working time on which the solver counts.

Looms with the same calendars share them. Of such looms there are two axes: the weaving time, without pauses, and the
attended time, part of it. An interval of the attended time begins at `starts` on its own axis, and at `starts` + the
sum of the `gaps` so far on the axis of weaving; while such a gap lasts the loom weaves and nobody is there.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from ilmek.factory.calendar import Calendar
from ilmek.factory.model import Loom


@dataclass(frozen=True, slots=True)
class WorkAxes:
    """Calendars of some looms up to a horizon, and the attended intervals on both axes.

    looms   indices             weaving, attended  their calendars
    starts  of each attended interval but the first, on the attended axis
    gaps    of weaving time before each of these; `offset`: before the first
    ends    on the axis of weaving, of the interval before each of these
    """

    looms: tuple[int, ...]
    weaving: Calendar
    attended: Calendar
    horizon: int
    offset: int
    starts: tuple[int, ...]
    gaps: tuple[int, ...]
    ends: tuple[int, ...]

    @property
    def weaving_total(self) -> int:
        """Weaving time up to the horizon."""
        return self.weaving.work(self.horizon)

    @property
    def attended_total(self) -> int:
        """Attended time up to the horizon."""
        return self.attended.work(self.horizon)


def work_axes(looms: Sequence[Loom], horizon: int) -> tuple[WorkAxes, ...]:
    """The axes of all looms, one for each pair of calendars."""
    groups: dict[tuple[Calendar, Calendar], list[int]] = {}
    for index, loom in enumerate(looms):
        groups.setdefault((loom.weaving, loom.attended), []).append(index)
    return tuple(_axes(members, *calendars, horizon) for calendars, members in groups.items())


def _axes(members: list[int], weaving: Calendar, attended: Calendar, horizon: int) -> WorkAxes:
    offset, before, starts, gaps, ends = 0, 0, [], [], []
    found = False
    for start, end in attended.windows:
        if start >= horizon:
            break
        woven, met = weaving.work(start), attended.work(start)
        if not found:
            offset, found = woven, True
        elif woven > before:
            starts.append(met)
            gaps.append(woven - before)
            ends.append(before)
        before = weaving.work(end)
    return WorkAxes(tuple(members), weaving, attended, horizon, offset, tuple(starts), tuple(gaps), tuple(ends))


def time_before(calendar: Calendar, due: int) -> int:
    """What is added to a working time up to the due date for the instant at which it ends: least where it is later."""
    index = max((k for k, (start, _) in enumerate(calendar.windows) if start < due), default=0)
    return calendar.windows[index][0] - calendar.before[index]


def gaps_after(calendar: Calendar, due: int, horizon: int) -> list[tuple[int, int]]:
    """The working time at which each window after the due date begins, and the pause before it [min]."""
    return [
        (calendar.before[k], calendar.windows[k][0] - calendar.windows[k - 1][1])
        for k in range(1, len(calendar.windows))
        if due <= calendar.windows[k][0] < horizon
    ]
