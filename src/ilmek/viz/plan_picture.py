"""The picture of a plan: what each loom weaves when, over dates (a Gantt chart).

A lane for each loom, white while it works and shaded while it is closed; a bar for each piece of work, with its
phases; a flag at each due date, red where it is missed. The upper axis has the dates.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.viz.font import text_width
from ilmek.viz.sheet import Sheet
from ilmek.viz.style import AXIS, GRID, INK, MUTED, PAPER, SMALL, STRONG, TEXT, colour, letters, tint

WIDTH = 960.0
_RIGHT, _TOP, _BOTTOM = 14.0, 34.0, 22.0
_LANE, _BAR = 40.0, 20.0
"""Height of a lane, and of its bars [pt]."""
_BAD, _CLOSED = "#c0392b", "#eceff2"
_DAY = 1440
_LEAST_DAY = 5.0
"""Width of a day from which its pauses are shaded; below it only whole days are [pt]."""
_LEAST_LABEL = 46.0
"""Distance of two dates on the axis [pt]."""
_STEPS = (1, 2, 7, 14, 28, 56, 112, 224, 448)
"""Days between two dates on the axis; from a week on they are Mondays."""


@dataclass(frozen=True, slots=True)
class PlanBar:
    """A piece of work on a lane.

    label   its name                    look    number of its colour
    phases  instants at which dressing begins, weaving begins, it ends, and the work on it ends [min]
    due     due date [min]
    """

    label: str
    look: int
    phases: tuple[int, int, int, int]
    due: int

    @property
    def late(self) -> bool:
        """Whether it ends after its due date."""
        return self.phases[-1] > self.due


@dataclass(frozen=True, slots=True)
class PlanLane:
    """A loom: its name, its working windows [min], and its bars in order."""

    name: str
    windows: tuple[tuple[int, int], ...]
    bars: tuple[PlanBar, ...]


@dataclass(frozen=True, slots=True)
class PlanChart:
    """Lanes from the top on, and the midnight from which minutes count."""

    title: str
    origin: datetime
    begin: int
    end: int
    lanes: tuple[PlanLane, ...]


def draw_plan(chart: PlanChart) -> Sheet:
    """The sheet of a chart."""
    left = 16.0 + max([30.0, *(text_width(lane.name, STRONG, bold=True) for lane in chart.lanes)])
    sheet = Sheet(WIDTH, _TOP + _LANE * len(chart.lanes) + _BOTTOM)
    pen = _Pen(sheet, chart, left, (WIDTH - left - _RIGHT) / max(chart.end - chart.begin, 1))
    for number, lane in enumerate(chart.lanes):
        _lane(pen, lane, sheet.height - _TOP - _LANE * (number + 1))
    _dates(pen)
    _legend(pen)
    return sheet


@dataclass(frozen=True, slots=True)
class _Pen:
    """A sheet with the scale of the time axis: left edge [pt], and points per minute."""

    sheet: Sheet
    chart: PlanChart
    left: float
    scale: float

    def x(self, minute: float) -> float:
        """The abscissa of an instant within the chart [pt]."""
        within = min(max(minute, self.chart.begin), self.chart.end)
        return self.left + (within - self.chart.begin) * self.scale

    def box(self, start: float, end: float, low: float, height: float) -> ComplexArray:
        """The corners of a rectangle between two instants."""
        a, b = self.x(start), self.x(end)
        return np.array([complex(a, low), complex(b, low), complex(b, low + height), complex(a, low + height)])

    @property
    def days(self) -> range:
        """The days of the chart."""
        return range(self.chart.begin // _DAY, -(-self.chart.end // _DAY))


def _lane(pen: _Pen, lane: PlanLane, low: float) -> None:
    chart, sheet = pen.chart, pen.sheet
    sheet.area(pen.box(chart.begin, chart.end, low, _LANE), facecolor=_CLOSED, zorder=0.5)
    for start, end in _open(pen, lane.windows):
        sheet.area(pen.box(start, end, low, _LANE), facecolor=PAPER, zorder=0.6)
    for minute in (chart.begin, chart.end):
        sheet.line(pen.x(minute) + 1j * np.array([low, low + _LANE]), color=AXIS, linewidth=0.6)
    for y in (low, low + _LANE):
        sheet.line(np.array([pen.x(chart.begin), pen.x(chart.end)]) + 1j * y, color=AXIS, linewidth=0.6)
    sheet.text(
        complex(pen.left - 8.0, low + 4.0 + _BAR / 2), lane.name, fontsize=STRONG, bold=True, ha="right",
        va="center_baseline",
    )  # fmt: skip
    for bar in lane.bars:
        _bar(pen, bar, low + 4.0)
    # One flag for equal carpets, red where one of them is late.
    flagged = {(bar.label, bar.due): bar for bar in sorted(lane.bars, key=lambda bar: bar.late)}
    shown = [bar for bar in flagged.values() if pen.chart.begin <= bar.due <= pen.chart.end]
    taken = {bar: (pen.x(bar.due) - 2.0, pen.x(bar.due) + 8.0) for bar in shown}
    written: list[tuple[float, float]] = []
    for bar in sorted(shown, key=lambda bar: (not bar.late, bar.due)):
        others = [span for other, span in taken.items() if other != bar]
        _due(pen, bar, low, [*others, *written], written)


def _open(pen: _Pen, windows: Sequence[tuple[int, int]]) -> Iterator[tuple[int, int]]:
    """The windows, or where days are narrow the days with work."""
    chart = pen.chart
    if _DAY * pen.scale >= _LEAST_DAY:
        yield from ((a, b) for a, b in windows if b > chart.begin and a < chart.end)
        return
    worked = {day for a, b in windows if b > chart.begin and a < chart.end for day in range(a // _DAY, -(-b // _DAY))}
    yield from ((day * _DAY, (day + 1) * _DAY) for day in sorted(worked))


def _bar(pen: _Pen, bar: PlanBar, low: float) -> None:
    """Dressing and doffing pale, weaving full; a red edge where it is late; its name where it fits."""
    shade, phases = colour(bar.look), bar.phases
    pen.sheet.area(pen.box(phases[0], phases[3], low, _BAR), facecolor=tint(shade, 0.30), zorder=1.2)
    pen.sheet.area(pen.box(phases[1], phases[2], low, _BAR), facecolor=tint(shade, 0.62), zorder=1.3)
    edge, width = (_BAD, 1.6) if bar.late else (letters(shade), 0.8)
    corners = pen.box(phases[0], phases[3], low, _BAR)
    pen.sheet.line(np.append(corners, corners[0]), color=edge, linewidth=width, zorder=2.6)
    room, middle = corners[1].real - corners[0].real, (corners[0] + corners[1]).real / 2
    words = fitting(bar.label, TEXT, room - 4.0)
    if words:
        at = complex(middle, low + _BAR / 2)
        pen.sheet.text(at, words, ha="center", va="center_baseline", color=INK, zorder=5)


def fitting(text: str, size: float, room: float) -> str:
    """The text, or as many of its letters and an ellipsis as fit; "" where fewer than three do."""
    if text_width(text, size) <= room:
        return text
    for length in range(len(text) - 1, 2, -1):
        words = f"{text[:length].rstrip()}…"
        if text_width(words, size) <= room:
            return words
    return ""


def _due(
    pen: _Pen, bar: PlanBar, low: float, taken: list[tuple[float, float]], written: list[tuple[float, float]]
) -> None:
    """A flag at the due date, with the name where no other flag and no other name of the lane is."""
    x, top = pen.x(bar.due), low + _LANE - 2.0
    shade = _BAD if bar.late else MUTED
    pen.sheet.line(x + 1j * np.array([low + 2.0, top]), color=shade, linewidth=1.0, zorder=3)
    pen.sheet.area(np.array([x, x + 6.0, x]) + 1j * np.array([top, top - 2.5, top - 5.0]), facecolor=shade, zorder=3)
    words = f"due {bar.label}"
    width = text_width(words, SMALL)
    for start in (x + 8.0, x - 3.0 - width):
        free = all(start + width < a or start > b for a, b in taken)
        if free and start > pen.left and start + width < WIDTH:
            pen.sheet.text(complex(start, top - 6.0), words, fontsize=SMALL, color=shade, va="baseline", zorder=5)
            written.append((start - 3.0, start + width + 3.0))
            break


def _dates(pen: _Pen) -> None:
    """The dates above the lanes, and a grid line at each; thinner lines at other midnights where they are apart."""
    sheet, chart = pen.sheet, pen.chart
    low, high = _BOTTOM, sheet.height - _TOP
    step = next((step for step in _STEPS if step * _DAY * pen.scale >= _LEAST_LABEL), _STEPS[-1])
    last = -np.inf
    for day in pen.days:
        minute = day * _DAY
        if not chart.begin <= minute <= chart.end:
            continue
        date, x = chart.origin + timedelta(minutes=minute), pen.x(minute)
        since = day if step < 7 else day + (chart.origin.weekday())
        if since % step == 0 and x - last >= 0.8 * _LEAST_LABEL and x < WIDTH - _RIGHT - 10.0:
            sheet.line(x + 1j * np.array([low, high + 3.0]), color=AXIS, linewidth=0.6, zorder=1.0)
            sheet.text(complex(x, high + 16.0), f"{date:%a}", fontsize=SMALL, color=MUTED, ha="center")
            sheet.text(complex(x, high + 6.0), f"{date.day} {date:%b}", fontsize=TEXT, ha="center")
            last = x
        elif _DAY * pen.scale >= _LEAST_DAY:
            sheet.line(x + 1j * np.array([low, high]), color=GRID, linewidth=0.5, zorder=0.9)


def _legend(pen: _Pen) -> None:
    """What bars, shades and flags mean."""
    x, low = pen.left, 5.0
    shade = colour(0)
    for words, face in (
        ("dressing, doffing", tint(shade, 0.30)),
        ("weaving", tint(shade, 0.62)),
        ("no shift", _CLOSED),
    ):
        corners = np.array([x, x + 14.0, x + 14.0, x]) + 1j * np.array([low, low, low + 8.0, low + 8.0])
        pen.sheet.area(corners, facecolor=face, edgecolor=AXIS, linewidth=0.5, zorder=2)
        pen.sheet.text(complex(x + 18.0, low + 1.2), words, fontsize=SMALL, color=MUTED)
        x += 32.0 + text_width(words, SMALL)
    pen.sheet.text(complex(x, low + 1.2), "flag: due date; red: late", fontsize=SMALL, color=MUTED)
    ends = (pen.chart.origin + timedelta(minutes=at) for at in (pen.chart.begin, pen.chart.end))
    years = "–".join(dict.fromkeys(str(end.year) for end in ends))
    pen.sheet.text(complex(WIDTH - _RIGHT, low + 1.2), years, fontsize=SMALL, color=MUTED, ha="right")
