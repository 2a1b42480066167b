"""Pictures on paper that move as a whole, and the room of lines and texts; positions in mm of the paper."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.plane.contours import along
from ilmek.report import Contour
from ilmek.report.sheet import SheetDimension, SheetLine, SheetText
from ilmek.sentences import spoken
from ilmek.viz.font import text_width

CAPITAL = 0.729
"""Height of a capital over the size of the font."""

Box = tuple[float, float, float, float]
"""Left, lower, right and upper end [mm]."""


def words_width(words: str, height: float, *, bold: bool = False) -> float:
    """Width of a text with capitals of a height [mm]: of a sentence in its longest language."""
    return _widest(words, getattr(words, "key", ""), height / CAPITAL, bold)


@lru_cache(maxsize=16384)
def _widest(words: str, key: str, size: float, bold: bool) -> float:  # noqa: ARG001  sentences of a text by their key
    return max(text_width(text, size, bold) for text in spoken(words))


def text_box(text: SheetText) -> Box:
    """The room of a text [mm]."""
    width = words_width(text.words, text.height, bold=text.bold)
    start = {"left": 0.0, "center": -width / 2, "right": -width}[text.anchor]
    if not text.angle:
        x, y = text.position.real, text.position.imag
        return start + x, y - 0.33 * text.height, start + width + x, y + 1.05 * text.height
    corners = np.array([start - 0.33j * text.height, start + width + 1.05j * text.height]) * np.exp(1j * text.angle)
    corners = corners + text.position
    return (
        float(corners.real.min()), float(corners.imag.min()), float(corners.real.max()), float(corners.imag.max())
    )  # fmt: skip


def overlap(box: Box, other: Box, pad: float = 0.0) -> bool:
    """Whether two boxes come nearer than a distance."""
    return (
        box[0] < other[2] + pad and other[0] < box[2] + pad and box[1] < other[3] + pad and other[1] < box[3] + pad
    )  # fmt: skip


def joined_box(boxes: Sequence[Box]) -> Box:
    """The box around boxes."""
    sides = np.array(boxes)
    return float(sides[:, 0].min()), float(sides[:, 1].min()), float(sides[:, 2].max()), float(sides[:, 3].max())


def box_around(points: ComplexArray) -> Box:
    """The box around points."""
    return float(points.real.min()), float(points.imag.min()), float(points.real.max()), float(points.imag.max())


def line_points(line: SheetLine, error: float = 0.02) -> ComplexArray:
    """Points of a line, its arcs as chords within an error [mm]."""
    if line.bulges is None:
        points = line.points
        return np.append(points, points[:1]) if line.closed else points
    points = along(Contour(line.points, line.bulges), error)
    return np.append(points, points[:1])


@dataclass(frozen=True, eq=False)
class SheetPicture:
    """What a view draws, movable as a whole."""

    lines: tuple[SheetLine, ...]
    texts: tuple[SheetText, ...]
    dimensions: tuple[SheetDimension, ...]

    @cached_property
    def box(self) -> Box:
        """The room that it takes."""
        every = (*self.lines, *(line for dimension in self.dimensions for line in dimension.lines))
        points = [line_points(line) for line in every]
        boxes = [box_around(np.concatenate(points))] if points else []
        return joined_box([*boxes, *(text_box(text) for text in self.all_texts)])

    @property
    def all_texts(self) -> tuple[SheetText, ...]:
        """Its texts, those of the dimensions too."""
        return (*self.texts, *(dimension.text for dimension in self.dimensions))

    def moved(self, by: complex) -> "SheetPicture":
        """The same at another position."""
        return SheetPicture(
            tuple(_moved(line, by) for line in self.lines),
            tuple(replace(text, position=text.position + by) for text in self.texts),
            tuple(
                replace(
                    dimension,
                    points=(dimension.points[0] + by, dimension.points[1] + by),
                    line=dimension.line + by,
                    text=replace(dimension.text, position=dimension.text.position + by),
                    lines=tuple(_moved(line, by) for line in dimension.lines),
                    arrows=tuple((tip + by, direction) for tip, direction in dimension.arrows),
                )
                for dimension in self.dimensions
            ),
        )


def _moved(line: SheetLine, by: complex) -> SheetLine:
    return replace(line, points=line.points + by)


def millimetres(value: float) -> str:
    """A length in mm with at most three decimals.

    >>> millimetres(0.0597378), millimetres(0.02), millimetres(-1e-9)
    ('59.738', '20', '0')
    """
    text = f"{value * 1e3:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
