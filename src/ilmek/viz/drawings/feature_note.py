"""What stands under the dimension of a feature: control frames (ISO 1101), datum (ISO 5459), surface (ISO 21920).

Below the dimension of a feature of size they hold for its axis. Symbols are drawn as lines in cells 5 mm high, twice
the letter.
"""

import math
from typing import NamedTuple

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.part.tolerances import Characteristic
from ilmek.plane.contours import along, circle
from ilmek.report.sheet import ARROW, LineKind, SheetLine, SheetText
from ilmek.viz.drawings.picture import CAPITAL, SheetPicture
from ilmek.viz.font import text_width

LETTER, CELL = 2.5, 5.0
"""Height of letters and of a frame [mm]."""

_SYMBOL, _BESIDE = 6.0, 1.2
"""Width of the cell of a symbol; room beside a text [mm]."""


class ControlFrame(NamedTuple):
    """A feature control frame: what is limited, its zone as written, and the datums in their order."""

    characteristic: Characteristic
    zone: str
    datums: tuple[str, ...] = ()


class FeatureNote(NamedTuple):
    """What a sheet says of a feature besides its size.

    words    classes and deviations behind the size      frames   of its geometric tolerances
    datums   letters of which it is the datum            texture  of its surface, as written: `Ra 0.8`
    """

    words: str = ""
    frames: tuple[ControlFrame, ...] = ()
    datums: tuple[str, ...] = ()
    texture: str = ""

    @property
    def is_bare(self) -> bool:
        """Whether nothing hangs below the dimension."""
        return not (self.frames or self.datums or self.texture)

    def hanging(self) -> SheetPicture:
        """Frames below each other, then datums and the surface symbol beside them; upper left corner at 0."""
        lines: list[SheetLine] = []
        texts: list[SheetText] = []
        y = 0.0
        for frame in self.frames:
            y -= CELL
            _frame(frame, complex(0.0, y), lines, texts)
        x = 1.0
        for letter in self.datums:
            _datum(letter, complex(x + CELL / 2, y), lines, texts)
            x += CELL + 2.0
        if self.texture:
            foot = complex(x + 1.5, y - CELL - 1.0)
            lines += surface_mark(foot)
            texts.append(SheetText(foot + complex(3.2, 0.3), self.texture, LETTER))
        return SheetPicture(tuple(lines), tuple(texts), ())


def _frame(frame: ControlFrame, corner: complex, lines: list[SheetLine], texts: list[SheetText]) -> None:
    """A frame with its lower left corner."""
    cells = [_SYMBOL, *(text_width(words, LETTER / CAPITAL) + 2 * _BESIDE for words in (frame.zone, *frame.datums))]
    ends = np.cumsum([0.0, *(max(CELL, cell) for cell in cells)]).tolist()
    lines.append(_box(corner, complex(ends[-1], CELL)))
    lines += [SheetLine(LineKind.TOLERANCE, corner + x + np.array([0j, CELL * 1j])) for x in ends[1:-1]]
    middle = corner + complex(_SYMBOL, CELL) / 2
    lines += [SheetLine(LineKind.TOLERANCE, middle + points) for points in SYMBOLS[frame.characteristic]]
    for words, start, end in zip((frame.zone, *frame.datums), ends[1:], ends[2:], strict=False):
        at = corner + complex((start + end) / 2, (CELL - LETTER) / 2)
        texts.append(SheetText(at, words, LETTER, "center"))


def _datum(letter: str, top: complex, lines: list[SheetLine], texts: list[SheetText]) -> None:
    """A datum triangle on a line above, its leader, and the letter in its box."""
    triangle = top + np.array([-1.5, 1.5, -2j])
    low = top - complex(CELL / 2, 2.0 + 1.5 + CELL)
    lines.append(SheetLine(LineKind.TOLERANCE, triangle, closed=True))
    lines.append(SheetLine(LineKind.TOLERANCE, top + np.array([-2j, -3.5j])))
    lines.append(_box(low, complex(CELL, CELL)))
    texts.append(SheetText(low + complex(CELL / 2, (CELL - LETTER) / 2), letter, LETTER, "center"))


def _box(corner: complex, size: complex) -> SheetLine:
    sides = np.array([0j, size.real, size, 1j * size.imag])
    return SheetLine(LineKind.TOLERANCE, corner + sides, closed=True)


def surface_mark(foot: complex, *, basic: bool = False) -> list[SheetLine]:
    """The graphical symbol of a surface from which material is removed, or the basic one; ISO 21920-1."""
    slope = np.exp(1j * math.pi / 3)
    left, right = foot + 2.2 * slope * slope, foot + 4.4 * slope
    lines = [SheetLine(LineKind.TEXTURE, np.array([left, foot, right]))]
    return lines if basic else [*lines, SheetLine(LineKind.TEXTURE, np.array([left, left + 2.2]))]


def edge_mark(corner: complex, *, outer: bool) -> list[SheetLine]:
    """The graphical symbol of the state of edges at a corner of a part, outer or inner; ISO 13715."""
    body = np.array([-2.0, 0j, -2j]) if outer else np.array([2j, 0j, 2.0])
    bend = corner + 1.6 * (1 + 1j)
    mark = [corner + body, np.array([corner, bend]), np.array([bend + 1.5j, bend, bend + 3.0])]
    kinds = (LineKind.BREAK, LineKind.TEXTURE, LineKind.TEXTURE)
    return [SheetLine(kind, points) for kind, points in zip(kinds, mark, strict=True)]


def _ring(radius: float) -> ComplexArray:
    points = along(circle(0j, radius), 1e-3)
    return np.append(points, points[:1])


def _arrow(foot: complex) -> list[ComplexArray]:
    """An arrow upwards to the right, its head open."""
    tip = foot + 3.2 * np.exp(0.25j * math.pi)
    back = -0.5 * ARROW[0] * np.exp(0.25j * math.pi)
    return [np.array([foot, tip]), tip + back * np.array([np.exp(0.35j), 0j, np.exp(-0.35j)])]


_FEET = np.array([-2.2 - 1.2j, -0.4 - 1.2j])

SYMBOLS: dict[Characteristic, tuple[ComplexArray, ...]] = {
    Characteristic.FLATNESS: (np.array([-2.2 - 1j, 1.0 - 1j, 2.2 + 1j, -1.0 + 1j, -2.2 - 1j]),),
    Characteristic.CYLINDRICITY: (_ring(1.0), np.array([-2.1 - 1.6j, -0.3 + 1.6j]), np.array([0.3 - 1.6j, 2.1 + 1.6j])),
    Characteristic.POSITION: (_ring(1.2), np.array([-2, 2 + 0j]), np.array([-2j, 2j])),
    Characteristic.RUN_OUT: (*_arrow(-1.1 - 1.2j),),
    Characteristic.TOTAL_RUN_OUT: (*_arrow(complex(_FEET[0])), *_arrow(complex(_FEET[1])), _FEET),
}
"""Lines of the symbols about the middle of their cell [mm]; ISO 1101, table 2; ISO 7083."""
