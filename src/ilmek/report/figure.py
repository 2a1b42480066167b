"""Figures as plain data: plots, drawings to scale, machines in motion, cyclograms. Values are SI.

The look of a curve, stroke, lane or kind is the number of its colour, marker and dashes, -1: none of its own. Whoever
draws figures gives their labels looks, see `viz.looks`.
"""

from dataclasses import dataclass
from typing import TypeAlias

from ilmek.arrays import ComplexArray, FloatArray, IntArray
from ilmek.records import record
from ilmek.report.shown import Shown


@dataclass(frozen=True, slots=True)
class Axis:
    """A plot's axis: label, and the unit its SI data are shown in."""

    label: str
    unit: str = ""


@record
class Series:
    """A curve: SI abscissae and ordinates of one length."""

    label: str
    x: FloatArray
    y: FloatArray
    dashed: bool = False
    look: int = -1


@dataclass(frozen=True, slots=True)
class Mark:
    """A named abscissa: a vertical line in a plot."""

    x: float
    label: str


@record
class Plot(Shown):
    """Curves over one axis; plots, animations and cyclograms over a quantity of the same label share a cursor."""

    name: str
    title: str
    x: Axis
    y: Axis
    series: tuple[Series, ...]
    marks: tuple[Mark, ...] = ()
    note: str = ""


@record
class Stroke:
    """A polyline of a drawing [m]. Its role sets how it is drawn.

    role  outline (thick), link (thick, coloured), ground (hatched grey), guide (hatched beside a slider), path (thin,
          coloured), construction (thin dashed), dimension (thin with arrows at both ends), yarn
    """

    points: ComplexArray
    role: str
    label: str = ""
    closed: bool = False
    filled: bool = False
    look: int = -1


@dataclass(frozen=True, slots=True)
class Dot:
    """A named point of a drawing [m].

    role   pin (moving joint), pivot (joint on the ground), point, block (a slider)
    along  direction of the guide of a block
    """

    at: complex
    label: str
    role: str = "pin"
    along: complex = 1.0


@record
class Drawing(Shown):
    """A drawing to scale: strokes and dots [m], shown in `unit`."""

    name: str
    title: str
    strokes: tuple[Stroke, ...]
    dots: tuple[Dot, ...] = ()
    unit: str = "mm"
    note: str = ""


@record
class MovingStroke:
    """A line that moves: its points [m] at every frame, (frames, points).

    role  outline (thick), link (thick, coloured), wheel (pitch circle with a radius that shows its turn, coloured),
          path (thin, coloured), yarn
    """

    points: ComplexArray
    role: str
    label: str = ""
    closed: bool = False
    look: int = -1


@record
class MovingDot:
    """A point that moves [m], (frames).

    role   pin, point, or block: a slider, drawn along its guide
    along  unit directions of the guide, (frames), of a block
    """

    at: ComplexArray
    label: str
    role: str = "pin"
    along: ComplexArray | None = None


@record
class Reading:
    """A number shown beside a machine that moves: its SI values at the frames, shown in `unit`."""

    label: str
    values: FloatArray
    unit: str = ""


@record
class Animation(Shown):
    """A machine in motion, to scale: what stands still, and what moves over the frames of one run.

    still    name, title, and all that does not move: ground, pivots, traced paths
    drive    what a person turns: label and unit      at  its value at the frames [SI], ascending, evenly apart
    closes   the frame after the last is the first again, a step later; otherwise the machine goes to and fro
    start    the frame shown first, and alone where nothing can move
    period   time of a run of the real machine [s]; None: it has no speed of its own
    """

    still: Drawing
    drive: Axis
    at: FloatArray
    strokes: tuple[MovingStroke, ...]
    dots: tuple[MovingDot, ...]
    closes: bool = True
    start: int = 0
    period: float | None = None
    readings: tuple[Reading, ...] = ()

    @property
    def name(self) -> str:
        """The drawing's name."""
        return self.still.name

    @property
    def title(self) -> str:
        """The drawing's title."""
        return self.still.title

    @property
    def note(self) -> str:
        """The drawing's note."""
        return self.still.note


@dataclass(frozen=True, slots=True)
class Move:
    """A motion of a lane: from `begin` to `finish` [SI] over master angles [rad], by the law of a name."""

    name: str
    start: float
    end: float
    begin: float
    finish: float
    law: str


@dataclass(frozen=True, slots=True)
class Shade:
    """A window of a lane: master angles [rad], what it is, and whether it is one that must not be."""

    start: float
    end: float
    label: str = ""
    bad: bool = False


@record
class Lane:
    """One track of a cyclogram: position of an actuator over the master angle.

    angle     master angle [rad], ascending from 0 to 2 pi     position  0 to 1 of the stroke
    events    named master angles [rad]
    moves     its motions, where they are known, in order, and the `unit` their positions are shown in
    motion    position [SI], velocity and acceleration [SI, s] at the angles; empty where they are not known
    shades    windows to be shaded
    """

    name: str
    actuator: str
    angle: FloatArray
    position: FloatArray
    events: tuple[Mark, ...] = ()
    moves: tuple[Move, ...] = ()
    unit: str = ""
    shades: tuple[Shade, ...] = ()
    motion: tuple[FloatArray, ...] = ()
    look: int = -1


@dataclass(frozen=True, slots=True)
class Link:
    """What must come after what: from a place to a place, each the number of a lane and a master angle [rad]."""

    first: tuple[int, float]
    then: tuple[int, float]
    label: str
    ok: bool = True


@record
class Timing(Shown):
    """A cyclogram to draw: lanes over one turn of the master shaft, which takes `period` [s].

    links  between instants of the lanes
    drive  the angle of a turn: figures over a drive of the same name share a cursor
    """

    name: str
    title: str
    period: float
    lanes: tuple[Lane, ...]
    note: str = ""
    links: tuple[Link, ...] = ()
    drive: Axis = Axis("master angle", "deg")


@record
class GanttLane:
    """A lane of a Gantt chart: spans of time, in order of their begin, each of a kind (a number, see `Gantt`)."""

    name: str
    starts: FloatArray
    ends: FloatArray
    kinds: IntArray


@record
class Gantt(Shown):
    """What lanes are busy with over time, in spans.

    kinds  names of the kinds of spans; those that no lane has are left out of the legend
    pale   number of kinds, the first ones, that are drawn pale: what is usual
    """

    name: str
    title: str
    x: Axis
    lanes: tuple[GanttLane, ...]
    kinds: tuple[str, ...]
    note: str = ""
    pale: int = 0
    looks: tuple[int, ...] = ()


@record
class StackedBars(Shown):
    """Horizontal bars, each of parts side by side, one for each kind; SI values by kind of each bar."""

    name: str
    title: str
    x: Axis
    bars: tuple[str, ...]
    kinds: tuple[str, ...]
    values: tuple[FloatArray, ...]
    note: str = ""
    looks: tuple[int, ...] = ()


Figure: TypeAlias = Plot | Drawing | Animation | Timing | Gantt | StackedBars
