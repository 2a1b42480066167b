"""Working time: the windows in which a loom weaves, and those in which it is attended, in whole minutes.

Minutes count from the midnight at which the plan begins, in local time; every day has 1440 of them. The working time
before an instant t is

    work(t) = sum over windows [a, b) of min(max(t - a, 0), b - a)

Work that is begun goes on after a break, a night or a holiday: it ends at the first t with work(t) = work(begin) + its
minutes.
"""

import itertools
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from ilmek.errors import LoomError

DAY = 1440
"""Minutes of a day."""

WEEK = 7

MOST_DAYS = 1830
"""Days after the begin of a plan within which it must end: five years."""

Window: TypeAlias = tuple[int, int]
"""Begin and end of a working window [min]."""


@dataclass(frozen=True, slots=True)
class Calendar:
    """Working windows in order, none touching the next [min]."""

    windows: tuple[Window, ...]
    starts: tuple[int, ...] = field(init=False, repr=False, compare=False)
    before: tuple[int, ...] = field(init=False, repr=False, compare=False)
    """Working time before each window [min], and after the last."""

    def __post_init__(self) -> None:
        lengths = [end - start for start, end in self.windows]
        object.__setattr__(self, "starts", tuple(start for start, _ in self.windows))
        object.__setattr__(self, "before", (0, *itertools.accumulate(lengths)))

    @property
    def total(self) -> int:
        """Working time of all windows [min]."""
        return self.before[-1]

    def work(self, time: int) -> int:
        """Working time before an instant [min]."""
        index = bisect_right(self.starts, time) - 1
        if index < 0:
            return 0
        start, end = self.windows[index]
        return self.before[index] + min(time, end) - start

    def begin(self, time: int) -> int:
        """The first instant from `time` on at which work is done. Raises LoomError after the last window."""
        return self.time_of(self.work(time), begins=True)

    def finish(self, time: int, minutes: int) -> int:
        """The instant at which work of so many minutes ends that is begun at `time` or as soon as possible.

        Work of 0 minutes ends at once. Raises LoomError after the last window.
        """
        return time if minutes == 0 else self.time_of(self.work(time) + minutes)

    def time_of(self, work: int, *, begins: bool = False) -> int:
        """The instant of a working time: the end of the window before a pause, or where it `begins` the next window.

        Raises LoomError beyond the last window.
        """
        find = bisect_right if begins else bisect_left
        index = max(find(self.before, work) - 1, 0)
        if index >= len(self.windows):
            raise LoomError(
                f"the plan does not end within {MOST_DAYS} days",
                allowed="what the looms can weave in that time",
                do="give fewer carpets, more looms or more shifts",
            )
        return self.windows[index][0] + work - self.before[index]


def joined_windows(windows: Iterable[Window]) -> tuple[Window, ...]:
    """The union of windows; those that touch are one.

    >>> joined_windows([(60, 120), (0, 60), (200, 300), (250, 280)])
    ((0, 120), (200, 300))
    """
    joined_windows: list[Window] = []
    for start, end in sorted(window for window in windows if window[0] < window[1]):
        if joined_windows and start <= joined_windows[-1][1]:
            joined_windows[-1] = joined_windows[-1][0], max(joined_windows[-1][1], end)
        else:
            joined_windows.append((start, end))
    return tuple(joined_windows)


def without(windows: Iterable[Window], breaks: Iterable[Window]) -> tuple[Window, ...]:
    """Windows less breaks.

    >>> without([(0, 480)], [(240, 270), (480, 600)])
    ((0, 240), (270, 480))
    """
    left = list(windows)
    for low, high in breaks:
        left = [
            part
            for start, end in left
            for part in ((start, min(end, low)), (max(start, high), end))
            if part[0] < part[1]
        ]
    return tuple(sorted(left))


@dataclass(frozen=True, slots=True)
class Shift:
    """A shift of the week.

    days      0 Monday to 6 Sunday, on which it begins
    start     minute of the day        end  minutes after the midnight of that day, above 1440 if it ends on the next
    breaks    pauses, in the same count
    attended  whether a carpet can be dressed and doffed in it; else the loom only weaves
    """

    name: str
    days: frozenset[int]
    start: int
    end: int
    breaks: tuple[Window, ...] = ()
    attended: bool = True

    def windows(self, days: Iterable[int], weekday: int, holidays: frozenset[int]) -> list[Window]:
        """The windows of the shifts that begin on some days of a plan [min].

        weekday   of day 0      holidays  days on which no shift begins
        """
        plain = without([(self.start, self.end)], self.breaks)
        return [
            (DAY * day + start, DAY * day + end)
            for day in days
            if (weekday + day) % WEEK in self.days and day not in holidays
            for start, end in plain
        ]


def calendar(shifts: Sequence[Shift], weekday: int, holidays: frozenset[int], *, attended: bool = False) -> Calendar:
    """The calendar of all shifts, or of the attended ones, from the midnight of day 0 to that of day MOST_DAYS.

    weekday  of day 0, 0 Monday      holidays  days of the plan without shifts
    """
    chosen = [shift for shift in shifts if shift.attended or not attended]
    days = range(-1, MOST_DAYS)
    windows = joined_windows(window for shift in chosen for window in shift.windows(days, weekday, holidays))
    return Calendar(tuple((max(start, 0), end) for start, end in windows if end > 0))


def with_overtime(own: Calendar, minutes: int, until: int) -> Calendar:
    """The calendar with overtime: on every day with work, the last window that begins on it lasts longer.

    minutes  of overtime a day; at most up to the next window
    until    instant after which there is none [min]
    """
    longer = []
    following = (*own.starts[1:], own.windows[-1][1] + minutes if own.windows else 0)
    for (start, end), then in zip(own.windows, following, strict=True):
        last = then // DAY > start // DAY
        longer.append((start, min(end + minutes, then)) if last and start < until else (start, end))
    return Calendar(joined_windows(longer))


def with_free_days(own: Calendar, until: int) -> Calendar:
    """The calendar with work on the days that have none, in the hours of the first day with work.

    until  instant after which there is none [min]
    """
    by_day: dict[int, list[Window]] = {}
    for start, end in own.windows:
        for day in range(start // DAY, -(-min(end, until) // DAY)):
            by_day.setdefault(day, []).append((max(start - DAY * day, 0), min(end - DAY * day, DAY)))
    if not by_day:
        return own
    first = min(by_day)
    free = (day for day in range(first, until // DAY + 1) if day not in by_day)
    more = ((DAY * day + start, DAY * day + end) for day in free for start, end in by_day[first])
    return Calendar(joined_windows([*own.windows, *more]))
