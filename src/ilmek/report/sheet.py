"""A drawing sheet as data, without any file format: one declaration from which DXF and PDF are written.

Positions are complex, in mm of the paper from the lower left corner of the sheet; values of dimensions are SI.
Line kinds and widths: ISO 128-2, line group 0.5; letters: ISO 3098, their height is that of a capital.
"""

import math
from dataclasses import dataclass
from enum import StrEnum

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.records import record


class LineKind(StrEnum):
    """What a line of a drawing stands for."""

    VISIBLE = "visible"
    HIDDEN = "hidden"
    CENTRE = "centre"
    DIMENSION = "dimension"
    HATCH = "hatch"
    PATH = "path"
    FRAME = "frame"
    BREAK = "break"
    TOLERANCE = "tolerance"
    TEXTURE = "texture"
    WELD = "weld"
    CONTOUR = "contour"
    LEADER = "leader"
    DATUM = "datum"
    HARDENED = "hardened"


LINE_WIDTHS = {
    LineKind.VISIBLE: 0.5,
    LineKind.HIDDEN: 0.25,
    LineKind.CENTRE: 0.25,
    LineKind.DIMENSION: 0.25,
    LineKind.HATCH: 0.18,
    LineKind.PATH: 0.25,
    LineKind.FRAME: 0.7,
    LineKind.BREAK: 0.25,
    LineKind.TOLERANCE: 0.25,
    LineKind.TEXTURE: 0.25,
    LineKind.WELD: 0.35,
    LineKind.CONTOUR: 0.35,
    LineKind.LEADER: 0.18,
    LineKind.DATUM: 0.25,
    LineKind.HARDENED: 0.5,
}
"""Width of each kind of line [mm]; ISO 128-2, group 0.5, contours and leaders of assemblies 0.35; of the frame ISO
5457.
"""

LINE_DASHES: dict[LineKind, tuple[float, ...]] = {
    LineKind.HIDDEN: (3.0, 0.75),
    LineKind.CENTRE: (6.0, 0.75, 0.3, 0.75),
    LineKind.PATH: (6.0, 0.75, 0.3, 0.75, 0.3, 0.75),
    LineKind.HARDENED: (6.0, 0.75, 0.3, 0.75),
}
"""Dash, gap, ... of each broken kind [mm]; ISO 128-2: 12 d and 3 d hidden, 24 d, 3 d, a dot, 3 d centre; along what is
hardened the same, wide: ISO 15787.
"""


@record
class SheetLine:
    """A line through points; of arcs where it has bulges, one for each piece, as in a `Contour`."""

    kind: LineKind
    points: ComplexArray
    bulges: FloatArray | None = None
    closed: bool = False


@record
class SheetText:
    """A line of text on its baseline.

    position  of its anchor      height  of a capital [mm]      anchor  left, center or right
    angle     anticlockwise [rad]: 0, or a quarter turn: read from the right
    """

    position: complex
    words: str
    height: float = 2.5
    anchor: str = "left"
    angle: float = 0.0
    bold: bool = False
    light: bool = False


@record
class Schematic:
    """A diagram of a circuit: lines and texts, not to scale."""

    name: str
    title: str
    lines: tuple[SheetLine, ...]
    texts: tuple[SheetText, ...]


class DimensionKind(StrEnum):
    """How a dimension is measured."""

    LINEAR = "linear"
    ALIGNED = "aligned"
    ORDINATE = "ordinate"
    DIAMETER = "diameter"
    RADIUS = "radius"


@record
class SheetDimension:
    """A dimension: what it measures, and how it is drawn.

    value     the true one [m]                       points  the two points on the paper between which it is measured
    across    a linear or ordinate one: measured along y
    line      a point of the dimension line          text    as it is printed, with its tolerance
    lines     extension, dimension and leader lines  arrows  tips and directions of arrowheads
    count     features of this size
    """

    kind: DimensionKind
    value: float
    points: tuple[complex, complex]
    line: complex
    text: SheetText
    lines: tuple[SheetLine, ...] = ()
    arrows: tuple[tuple[complex, complex], ...] = ()
    across: bool = False
    count: int = 1


@record
class DrawingSheet:
    """A sheet.

    number  of the drawing            title  for people          paper  A4 ... A1, `width` x `height` [mm]
    scale   true length over that on the paper: 5 for 1:5        page   its number among those of this drawing
    stamp   across the sheet: NOT RELEASED; "": none
    """

    number: str
    title: str
    paper: str
    width: float
    height: float
    scale: float
    lines: tuple[SheetLine, ...]
    texts: tuple[SheetText, ...]
    dimensions: tuple[SheetDimension, ...] = ()
    page: int = 1
    pages: int = 1
    stamp: str = ""


@dataclass(frozen=True, slots=True)
class Issue:
    """Of all sheets of a book: owner, date and revision as given, never of a clock; whether nothing is released."""

    owner: str = "—"
    date: str = "—"
    revision: str = "—"
    unreleased: bool = False

    @property
    def given(self) -> bool:
        """Whether it has a revision or a date."""
        return (self.revision, self.date) != ("—", "—")


ARROW = 2.5, math.radians(20.0)
"""Length of an arrowhead [mm] and its full angle, filled."""


def arrowhead(tip: complex, direction: complex) -> tuple[complex, complex, complex]:
    """The corners of a filled arrowhead whose tip points along a direction."""
    length, angle = ARROW
    back = -length * direction / abs(direction)
    half = math.tan(angle / 2)
    return tip, tip + back * (1 + 1j * half), tip + back * (1 - 1j * half)
