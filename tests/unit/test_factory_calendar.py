"""Working time of shifts, breaks and holidays."""

import itertools

import pytest
from small_factory import DAY_SHIFT, LATE_SHIFT, calendars

from ilmek.errors import LoomError
from ilmek.factory.axes import work_axes
from ilmek.factory.calendar import DAY, MOST_DAYS, Calendar, Shift, calendar, with_free_days, with_overtime
from ilmek.factory.model import Loom

WEEKEND = {5, 6}


def test_a_shift_has_its_breaks_and_its_days() -> None:
    own = calendar([DAY_SHIFT], 0, frozenset({1}))
    assert own.windows[:4] == ((360, 600), (630, 840), (2 * DAY + 360, 2 * DAY + 600), (2 * DAY + 630, 2 * DAY + 840))
    assert {start // DAY % 7 for start, _ in own.windows} == {0, 1, 2, 3, 4}
    assert not any(DAY <= start < 2 * DAY for start, _ in own.windows)  # the holiday


def test_a_night_shift_begins_on_its_day_and_ends_on_the_next() -> None:
    night = Shift("night", frozenset({6, 0}), 22 * 60, 30 * 60)
    own = calendar([night], 0, frozenset())
    assert own.windows[:3] == ((0, 360), (1320, 1800), (6 * DAY + 1320, 7 * DAY + 360))


def test_touching_shifts_are_one_window() -> None:
    weaving, attended = calendars(DAY_SHIFT, LATE_SHIFT)
    assert weaving.windows[1] == (630, 1320)
    assert attended.windows[1] == (630, 840)


@pytest.mark.parametrize("weekday", range(7))
def test_working_time_counts_every_minute(weekday: int) -> None:
    own = calendars(DAY_SHIFT, LATE_SHIFT, weekday=weekday)[0]
    worked = [any(start <= minute < end for start, end in own.windows[:30]) for minute in range(5 * DAY)]
    sums = [0, *itertools.accumulate(worked)]
    for time in range(0, 5 * DAY, 37):
        assert own.work(time) == sums[time]
        begun = own.begin(time)
        assert begun == next((minute for minute in range(time, 5 * DAY) if worked[minute]), begun)
        for minutes in (0, 1, 240, 700):
            end = own.finish(time, minutes)
            assert own.work(end) - own.work(time) == minutes
            assert minutes == 0 or own.work(end - 1) - own.work(time) == minutes - 1


def test_work_beyond_the_last_window_is_an_error() -> None:
    own = Calendar(((0, 60),))
    assert own.finish(0, 60) == 60
    with pytest.raises(LoomError, match=f"does not end within {MOST_DAYS} days"):
        own.finish(0, 61)
    with pytest.raises(LoomError):
        own.begin(60)


def test_overtime_follows_the_last_window_of_a_day() -> None:
    own = calendar([DAY_SHIFT], 0, frozenset())
    longer = with_overtime(own, 120, DAY + 1000)
    assert longer.windows[:5] == ((360, 600), (630, 960), (DAY + 360, DAY + 600), (DAY + 630, DAY + 960), (3240, 3480))
    nearly = with_overtime(calendar([Shift("all", frozenset(range(7)), 60, 1440)], 0, frozenset()), 120, 10**6)
    assert nearly.windows[0][1] == MOST_DAYS * DAY + 120 or len(nearly.windows) < len(own.windows)


def test_free_days_are_worked_in_the_hours_of_the_first_day() -> None:
    own = calendar([DAY_SHIFT], 0, frozenset({2}))
    more = with_free_days(own, 8 * DAY)
    worked = {start // DAY for start, _ in more.windows if start < 10 * DAY}
    assert worked == set(range(10)) - {12, 13}
    assert (5 * DAY + 630, 5 * DAY + 840) in more.windows


def test_the_axes_map_attended_time_to_weaving_time() -> None:
    own = calendars(DAY_SHIFT, LATE_SHIFT)
    (axes,) = work_axes([Loom("L", *own, cost=0, dressing=0, dressing_same=0, doffing=0)], 3 * DAY)
    attended, weaving = own[1], own[0]
    for minute in range(axes.attended_total):
        time = attended.time_of(minute, begins=True)
        passed = sum(gap for start, gap in zip(axes.starts, axes.gaps, strict=True) if minute >= start)
        assert minute + axes.offset + passed == weaving.work(time)
