"""Figures and tables of a report as plain data that the studio's client draws.

Values are SI, rounded to six significant digits; NaN is null. Points are x, y, x, y, … in one list. `look` is the
number of a colour, a marker and dashes: a body or quantity has one look in all figures of a report.
"""

from dataclasses import dataclass
from typing import TypeAlias

from ilmek.report.figure import Link, Mark, Move, Shade

Numbers: TypeAlias = list[float | None]


@dataclass(frozen=True, slots=True)
class ShownAxis:
    """An axis: label, and the unit its SI data are shown in."""

    label: str
    shown_unit: str


@dataclass(frozen=True, slots=True)
class ShownCurve:
    """A curve of a plot."""

    label: str
    look: int
    dashed: bool
    x: Numbers
    y: Numbers


@dataclass(frozen=True, eq=False, slots=True)
class ShownPlot:
    """Curves over one axis; figures over a quantity of the same label share a cursor."""

    x: ShownAxis
    y: ShownAxis
    curves: list[ShownCurve]
    marks: tuple[Mark, ...]


@dataclass(frozen=True, slots=True)
class ShownStroke:
    """A polyline of a drawing [m]; `role` sets how it is drawn. look: -1 where its role has a colour of its own."""

    points: Numbers
    role: str
    label: str
    closed: bool
    filled: bool
    look: int


@dataclass(frozen=True, slots=True)
class ShownDot:
    """A named point [m]; role: pin, pivot or point."""

    at: tuple[float, float]
    label: str
    role: str


@dataclass(frozen=True, eq=False, slots=True)
class ShownDrawing:
    """A drawing to scale."""

    strokes: list[ShownStroke]
    dots: list[ShownDot]
    shown_unit: str


@dataclass(frozen=True, eq=False, slots=True)
class MovingShape:
    """A line that moves. track: numbers of the tracks of its points.

    shape   where it keeps its shape: its points about the first track, the second track ahead of it on the x axis
    """

    tracks: list[int]
    shape: Numbers
    role: str
    label: str
    closed: bool
    look: int


@dataclass(frozen=True, slots=True)
class MovingPoint:
    """A point that moves: pin, point or block; ahead: the track of a point ahead of a block on its guide, -1: none."""

    track: int
    ahead: int
    label: str
    role: str


@dataclass(frozen=True, slots=True)
class ShownReading:
    """A number over the frames [SI], shown in a unit."""

    label: str
    shown_unit: str
    values: Numbers


@dataclass(frozen=True, eq=False, slots=True)
class ShownAnimation:
    """A machine in motion: what stands still, and what moves over the frames.

    tracks  of points, x, y, x, y, … over the frames [m]      at      value of the drive at the frames [SI]
    closes  the frame after the last is the first             period  of the real machine [s]; null: none
    """

    still: ShownDrawing
    drive: ShownAxis
    at: Numbers
    tracks: list[Numbers]
    shapes: list[MovingShape]
    points: list[MovingPoint]
    readings: list[ShownReading]
    closes: bool
    start: int
    period: float | None


@dataclass(frozen=True, eq=False, slots=True)
class ShownLane:
    """A track of a cyclogram: position 0 to 1 over the master angle [rad].

    motion  position [SI], velocity and acceleration [SI, s] at the angles; empty where they are not known
    """

    name: str
    actuator: str
    shown_unit: str
    look: int
    angle: Numbers
    position: Numbers
    events: tuple[Mark, ...]
    moves: tuple[Move, ...]
    shades: tuple[Shade, ...]
    motion: list[Numbers]


@dataclass(frozen=True, eq=False, slots=True)
class ShownTiming:
    """A cyclogram over one turn of the master shaft, which takes `period` [s]."""

    drive: ShownAxis
    period: float
    lanes: list[ShownLane]
    links: tuple[Link, ...]


@dataclass(frozen=True, eq=False, slots=True)
class ShownSpans:
    """A lane of a Gantt chart: spans of time [s] and the number of the kind of each."""

    name: str
    starts: Numbers
    ends: Numbers
    kinds: list[int]


@dataclass(frozen=True, eq=False, slots=True)
class ShownGantt:
    """What lanes are busy with over time; the first `pale` kinds are drawn pale."""

    x: ShownAxis
    lanes: list[ShownSpans]
    kinds: list[str]
    looks: list[int]
    pale: int


@dataclass(frozen=True, eq=False, slots=True)
class ShownBars:
    """Horizontal bars, each of parts side by side; values [SI] of each bar by kind."""

    x: ShownAxis
    bars: list[str]
    kinds: list[str]
    looks: list[int]
    values: list[Numbers]


@dataclass(frozen=True, eq=False, slots=True)
class ShownCloud:
    """Designs of a study: the values [SI] of each column, the kind of each design, the command that makes it."""

    columns: list[ShownAxis]
    values: list[Numbers]
    kinds: list[str]
    looks: list[int]
    kind: list[int]
    commands: list[str]


@dataclass(frozen=True, slots=True)
class ShownFigure:
    """A figure: one of its kinds, the others are null."""

    name: str
    title: str
    note: str
    plot: ShownPlot | None = None
    drawing: ShownDrawing | None = None
    animation: ShownAnimation | None = None
    timing: ShownTiming | None = None
    gantt: ShownGantt | None = None
    bars: ShownBars | None = None
    cloud: ShownCloud | None = None


@dataclass(frozen=True, slots=True)
class ShownColumn:
    """A column: heading, the unit its SI numbers are shown in, and their significant digits."""

    heading: str
    shown_unit: str
    digits: int


@dataclass(frozen=True, eq=False, slots=True)
class ShownTable:
    """Rows of SI numbers and texts."""

    name: str
    title: str
    columns: list[ShownColumn]
    rows: list[list[float | int | str | None]]
