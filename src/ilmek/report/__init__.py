"""What a design says: results, checks, tables and figures, as plain data.

A machine returns a `Report`; the command line, the web page and the JSON are made from it and know nothing else of the
machine. Values are SI; the unit beside a value is the one to show it in.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.report.workshop import CamTable, Contour, Hole, Plate

__all__ = [
    "Animation",
    "Axis",
    "CamTable",
    "Check",
    "Column",
    "Contour",
    "Dot",
    "Drawing",
    "Figure",
    "Hole",
    "Json",
    "Lane",
    "LawCurve",
    "Link",
    "Mark",
    "Move",
    "MovingDot",
    "MovingStroke",
    "Plate",
    "Plot",
    "Reading",
    "Report",
    "Result",
    "Series",
    "Shade",
    "Stroke",
    "Table",
    "Timing",
    "at_least",
    "at_most",
    "check_as_json",
    "plain",
]

Json: TypeAlias = float | int | bool | str | Mapping[str, Any] | Sequence[Any] | None
"""What JSON can hold; what is inside of groups is Json again, which a checker at run time cannot follow."""


@dataclass(frozen=True, slots=True)
class Check:
    """A judgement: `value` against `limit` [SI, shown in `unit`], and where the limit comes from."""

    name: str
    value: float
    limit: float
    unit: str
    ok: bool
    source: str
    relation: str = "<="


def at_most(name: str, value: float, limit: float, unit: str, source: str) -> Check:
    """The check value <= limit; NaN fails."""
    return Check(name, float(value), float(limit), unit, bool(value <= limit), source, "<=")


def at_least(name: str, value: float, limit: float, unit: str, source: str) -> Check:
    """The check value >= limit; NaN fails."""
    return Check(name, float(value), float(limit), unit, bool(value >= limit), source, ">=")


@dataclass(frozen=True, slots=True)
class Result:
    """A number (or text, or group of them) that a design answers with; `name` is stable and documented.

    shown  False: for the JSON alone, where a table shows it better to a reader
    """

    name: str
    value: Json
    unit: str
    meaning: str
    shown: bool = True


@dataclass(frozen=True, slots=True)
class Column:
    """A table's column: heading and the unit its SI numbers are shown in ("" for text and plain numbers)."""

    heading: str
    unit: str = ""
    digits: int = 4


@dataclass(frozen=True, slots=True)
class Table:
    """Rows of SI numbers and texts under columns.

    brief  True: short, and worth being shown on a terminal too
    """

    name: str
    title: str
    columns: tuple[Column, ...]
    rows: tuple[tuple[float | int | str, ...], ...]
    brief: bool = False


@dataclass(frozen=True, slots=True)
class Axis:
    """A plot's axis: label, and the unit its SI data are shown in."""

    label: str
    unit: str = ""


@dataclass(frozen=True, slots=True)
class Series:
    """A curve: SI abscissae and ordinates of one length."""

    label: str
    x: FloatArray
    y: FloatArray
    dashed: bool = False


@dataclass(frozen=True, slots=True)
class Mark:
    """A named abscissa: a vertical line in a plot."""

    x: float
    label: str


@dataclass(frozen=True, slots=True)
class Plot:
    """Curves over one axis."""

    name: str
    title: str
    x: Axis
    y: Axis
    series: tuple[Series, ...]
    marks: tuple[Mark, ...] = ()
    note: str = ""


@dataclass(frozen=True, slots=True)
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


@dataclass(frozen=True, slots=True)
class Dot:
    """A named point of a drawing [m]; role: pin (moving joint), pivot (joint on the ground), point."""

    at: complex
    label: str
    role: str = "pin"


@dataclass(frozen=True, slots=True)
class Drawing:
    """A drawing to scale: strokes and dots [m], shown in `unit`."""

    name: str
    title: str
    strokes: tuple[Stroke, ...]
    dots: tuple[Dot, ...] = ()
    unit: str = "mm"
    note: str = ""


@dataclass(frozen=True, slots=True)
class MovingStroke:
    """A line that moves: its points [m] at every frame, (frames, points); roles as of `Stroke`, link or outline."""

    points: ComplexArray
    role: str
    label: str = ""
    closed: bool = False


@dataclass(frozen=True, slots=True)
class MovingDot:
    """A point that moves [m], (frames).

    role   pin, point, or block: a slider, drawn along its guide
    along  unit directions of the guide, (frames), of a block
    """

    at: ComplexArray
    label: str
    role: str = "pin"
    along: ComplexArray | None = None


@dataclass(frozen=True, slots=True)
class Reading:
    """A number shown beside a machine that moves: its SI values at the frames, shown in `unit`."""

    label: str
    values: FloatArray
    unit: str = ""


@dataclass(frozen=True, slots=True)
class Animation:
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
class LawCurve:
    """A motion law to draw: s, v and a on places u from 0 to 1; twice the same u where a or v jumps."""

    name: str
    u: FloatArray
    s: FloatArray
    v: FloatArray
    a: FloatArray


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


@dataclass(frozen=True, slots=True)
class Lane:
    """One track of a cyclogram: position of an actuator over the master angle.

    angle     master angle [rad], ascending from 0 to 2 pi     position  0 to 1 of the stroke
    events    named master angles [rad]
    moves     its motions, where they are known, in order, and the `unit` their positions are shown in
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


@dataclass(frozen=True, slots=True)
class Link:
    """What must come after what: from a place to a place, each the number of a lane and a master angle [rad]."""

    first: tuple[int, float]
    then: tuple[int, float]
    label: str
    ok: bool = True


@dataclass(frozen=True, slots=True)
class Timing:
    """A cyclogram to draw: lanes over one turn of the master shaft, which takes `period` [s].

    laws    of the lanes' moves      links  between instants of the lanes
    """

    name: str
    title: str
    period: float
    lanes: tuple[Lane, ...]
    note: str = ""
    laws: tuple[LawCurve, ...] = ()
    links: tuple[Link, ...] = ()


Figure: TypeAlias = Plot | Drawing | Animation | Timing


@dataclass(frozen=True, slots=True)
class Report:
    """Everything that a design says."""

    machine: str
    title: str
    parameters: Mapping[str, Json]
    results: tuple[Result, ...]
    checks: tuple[Check, ...]
    tables: tuple[Table, ...] = ()
    figures: tuple[Figure, ...] = ()
    warnings: tuple[str, ...] = ()
    plates: tuple[Plate, ...] = ()
    cam_tables: tuple[CamTable, ...] = ()

    @property
    def failed(self) -> tuple[Check, ...]:
        """The checks that do not hold."""
        return tuple(check for check in self.checks if not check.ok)

    def as_json(self) -> dict[str, Any]:
        """The contract of `--json`: machine, parameters, results, checks, warnings; SI, full precision."""
        return {
            "machine": self.machine,
            "parameters": plain(self.parameters),
            "results": {result.name: plain(result.value) for result in self.results},
            "checks": [check_as_json(check) for check in self.checks],
            "warnings": list(self.warnings),
        }


def check_as_json(check: Check) -> dict[str, Any]:
    """A check as plain data: name, value, limit, unit (to show it in), ok, source, relation."""
    return {name: plain(getattr(check, name)) for name in Check.__slots__}


def plain(value: Any) -> Any:
    """The value as JSON knows it: arrays become lists, complex numbers [x, y], numbers that are not finite None."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, complex):
        return [plain(value.real), plain(value.imag)]
    return None if isinstance(value, float) and not np.isfinite(value) else value
